//! The crate `raster` with the preceding stages and a shader written for this comparison, which
//! does exactly what the other peers do.

use super::look::Look;
use super::{AREA, Peer, Quantized};
use crate::scene::{Part, SIZE, Scene};
use clip::{Outcode, Volume, clip_triangle};
use homog::{Affine, Clip, ClipRange, HPoint, Ndc, Projective, Screen, World};
use projection::Convention;
use raster::{
    Clusters, CullMode, Frame, GUARD_BAND, MeshSelection, MeshTriangles, Opacity, Samples,
    ScreenVertex, SimdLevel, VertexProjection, signed_area,
};
use viewport::Viewport;

/// Our rasterizer with a scene.
pub struct Raster<'a> {
    look: Look<'a>,
    samples: Samples,
    threads: usize,
    baseline: bool,
    world_to_clip: Projective<World, Clip>,
    ndc_to_screen: Affine<Ndc, Screen>,
    volume: Volume,
    frame: Frame,
    positions: Vec<[f32; 3]>,
    /// The corners of the box around the positions.
    corners: [[f32; 3]; 8],
    /// The clusters of each part, built once like vertex buffers.
    clusters: Vec<Clusters>,
    /// The selected clusters of each part, for the current frame.
    selections: Vec<MeshSelection>,
    clip: Vec<HPoint<Clip>>,
    codes: Vec<Outcode>,
    screen: Vec<Option<ScreenVertex>>,
    /// Whether all vertices are on the screen, so that nothing needs clipping.
    whole: bool,
    pixels: Vec<[u8; 4]>,
}

impl<'a> Raster<'a> {
    /// Creates the rasterizer with `samples` per pixel and this many threads.
    pub fn new(scene: &'a Scene, samples: Samples, threads: usize) -> Result<Self, String> {
        let viewport = Viewport::image_for(SIZE.0, SIZE.1, ClipRange::CHAPTER)
            .map_err(|error| error.to_string())?;
        let band = |side: u32| 1.0 - (GUARD_BAND.start() + 1.0) / (0.5 * f64::from(side));
        let volume = Volume::CHAPTER.with_guard_band(band(SIZE.0), band(SIZE.1));
        let positions: Vec<[f32; 3]> = scene.vertices.iter().map(|v| v.position).collect();
        Ok(Self {
            look: Look::new(scene),
            samples,
            threads,
            baseline: false,
            world_to_clip: scene.world_to_clip(Convention::CHAPTER),
            ndc_to_screen: viewport.ndc_to_screen(),
            volume: volume.map_err(|error| error.to_string())?,
            frame: Frame::new(SIZE.0, SIZE.1, samples)
                .map_err(|error| error.to_string())?
                .with_threads(threads),
            corners: corners(&positions),
            clusters: scene.parts.iter().map(|part| clusters(scene, part, &positions)).collect(),
            selections: vec![MeshSelection::default(); scene.parts.len()],
            positions,
            clip: Vec::new(),
            codes: Vec::new(),
            screen: Vec::new(),
            whole: true,
            pixels: vec![[0; 4]; AREA],
        })
    }

    /// Creates a copy without the vector instructions that some processors lack.
    pub fn baseline(self) -> Self {
        let frame = self.frame.with_simd_level(SimdLevel::baseline());
        Self { frame, baseline: true, ..self }
    }

    /// Projects the vertices to the screen and, if some may need clipping, also to clip space.
    fn vertices(&mut self) {
        let simd_level = self.frame.simd_level();
        let mut corners = [HPoint::new(0.0, 0.0, 0.0, 1.0); 8];
        let mut codes = [Outcode::INSIDE; 8];
        let extent = self.volume.project_positions(
            self.world_to_clip,
            &self.corners,
            &mut corners,
            &mut codes,
        );
        self.whole = extent.is_inside();
        let viewer = HPoint::from(self.look.scene.camera.eye());
        let parts = self.look.scene.parts.iter().zip(&self.clusters).zip(&mut self.selections);
        for ((part, clusters), selection) in parts {
            selection.clear(self.positions.len());
            for cluster in clusters.as_slice() {
                if part.two_sided || !cluster.is_back_facing(viewer) {
                    selection.add_cluster(cluster);
                }
            }
        }
        if self.whole {
            let projection = VertexProjection {
                to_clip: self.world_to_clip,
                ndc_to_screen: self.ndc_to_screen,
                simd_level,
                threads: self.threads,
            };
            for selection in &self.selections {
                projection.project_selected_positions(&self.positions, selection, &mut self.screen);
            }
            return;
        }
        self.clip.resize(self.positions.len(), corners[0]);
        self.codes.resize(self.positions.len(), Outcode::INSIDE);
        self.volume.project_positions(
            self.world_to_clip,
            &self.positions,
            &mut self.clip,
            &mut self.codes,
        );
        self.screen.resize(self.positions.len(), None);
        ScreenVertex::divide_and_snap_points(
            &self.clip,
            self.ndc_to_screen,
            simd_level,
            &mut self.screen,
        );
        for (vertex, code) in self.screen.iter_mut().zip(&self.codes) {
            *vertex = vertex.filter(|_| code.is_inside());
        }
    }

    fn submit(&mut self) {
        self.frame.clear();
        let scene = self.look.scene;
        let selections = std::mem::take(&mut self.selections);
        for (part, selection) in scene.parts.iter().zip(&selections) {
            let first = (part.indices.start / 3) as u32;
            let triangles = scene.indices[part.indices.clone()].as_chunks::<3>().0;
            // Counter-clockwise triangles in the world have negative area on a screen whose y
            // points down.
            let cull = if part.two_sided { CullMode::Nothing } else { CullMode::Clockwise };
            let runs = selection.triangles();
            let mesh = MeshTriangles {
                vertices: &self.screen,
                triangles,
                first_id: first,
                opacity: Opacity::Opaque,
                cull,
            };
            self.frame.add_mesh_runs(mesh, runs);
            if self.whole {
                continue;
            }
            for (id, &corners) in runs
                .iter()
                .flat_map(|run| (first + run.start as u32..).zip(&triangles[run.clone()]))
            {
                if corners.iter().any(|&at| self.screen[at as usize].is_none()) {
                    self.cut(corners, id, part);
                }
            }
        }
        self.selections = selections;
    }

    /// Clips a triangle that extends beyond the near or far plane or the guard band.
    fn cut(&mut self, corners: [u32; 3], id: u32, part: &Part) {
        let points = corners.map(|at| self.clip[at as usize]);
        if !Outcode::trivially_rejects(&points.map(|point| self.volume.outcode(point))).is_inside()
        {
            return;
        }
        for piece in clip_triangle(points, &self.volume).triangles() {
            let corners = piece.map(|vertex| snap(self.ndc_to_screen, vertex.point));
            let [Some(p), Some(q), Some(r)] = corners else { continue };
            if part.two_sided || signed_area([p, q, r]) < 0 {
                let weights = piece.map(|vertex| vertex.weights.map(|weight| weight as f32));
                self.frame.add_clipped_triangle([p, q, r], weights, id, Opacity::Opaque);
            }
        }
    }
}

/// Returns the clusters of a part's triangles.
fn clusters(scene: &Scene, part: &Part, positions: &[[f32; 3]]) -> Clusters {
    let triangles = scene.indices[part.indices.clone()].as_chunks::<3>().0;
    Clusters::build(positions, triangles, !part.two_sided)
}

/// Returns the corners of the bounding box of positions.
fn corners(positions: &[[f32; 3]]) -> [[f32; 3]; 8] {
    let (mut least, mut greatest) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for position in positions {
        for axis in 0..3 {
            least[axis] = least[axis].min(position[axis]);
            greatest[axis] = greatest[axis].max(position[axis]);
        }
    }
    std::array::from_fn(|corner| {
        [0, 1, 2].map(|axis| if corner >> axis & 1 == 0 { least[axis] } else { greatest[axis] })
    })
}

fn snap(ndc_to_screen: Affine<Ndc, Screen>, point: HPoint<Clip>) -> Option<ScreenVertex> {
    ScreenVertex::snap(ndc_to_screen.transform_point(point.divide()?), point.w())
}

impl Peer for Raster<'_> {
    fn name(&self) -> String {
        let mut name = String::from("raster");
        if self.samples != Samples::One {
            name += &format!(" {}x", self.samples.count());
        }
        if self.threads > 1 {
            name += &format!(", {} threads", self.threads);
        }
        name + if self.baseline { ", baseline" } else { "" }
    }

    fn is_comparable(&self) -> bool {
        self.samples == Samples::One
    }

    fn draw(&mut self) {
        self.vertices();
        self.submit();
        self.frame.draw(&self.look, [0.0; 4], self.threads, &mut self.pixels, Quantized);
    }

    fn pixels(&mut self) -> Vec<[u8; 4]> {
        self.pixels.clone()
    }
}
