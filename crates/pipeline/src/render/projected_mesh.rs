//! Frustum culling and the vertex transform of one draw call.
//!
//! A mesh is divided into clusters of neighboring triangles, each with a bounding box and a cone of
//! normals. Clusters that are outside the view volume or show only back faces are skipped entirely.
//! The vertices of the other clusters are projected. If a cluster crosses the guard band, its
//! vertices are also stored in clip space for clipping.
//!
//! ```text
//!  clusters ─► frustum culling ─► back-face culling by normal cones ─► unclipped │ to_clip
//! ```

use super::screen_transform::{Containment, ScreenTransform};
use clip::Outcode;
use core::ops::Range;
use homog::{Clip, HPoint, Model, Projective};
use model::{Primitive, SkinnedPrimitive, Topology};
use raster::{MeshSelection, ScreenVertex, SimdLevel, VertexProjection};
use std::borrow::Cow;

/// The projected vertices of one draw call after culling. The next draw call reuses the memory.
#[derive(Debug, Default)]
pub(super) struct ProjectedMesh {
    /// Triangles inside the guard band, drawn without clipping.
    pub(super) unclipped: MeshSelection,
    /// Points, lines and triangles that may need clipping.
    pub(super) to_clip: MeshSelection,
    /// Vertices in clip space, valid for the vertices of `to_clip`.
    pub(super) clip_positions: Vec<HPoint<Clip>>,
    /// Outcodes against the guard band, valid for the vertices of `to_clip`.
    pub(super) outcodes: Vec<Outcode>,
    /// Vertices on the rasterizer's grid; `None` outside the guard band.
    pub(super) screen_vertices: Vec<Option<ScreenVertex>>,
}

impl ProjectedMesh {
    /// Culls the clusters that are outside the frustum or show only back faces.
    ///
    /// `viewer` is the viewer in model space, or `None` if back faces are visible. Skinned and
    /// morphed meshes have no clusters, because their positions change with the pose. They are
    /// culled as a whole by their bounding box.
    pub(super) fn cull_clusters(
        &mut self,
        transform: &ScreenTransform,
        model_to_clip: Projective<Model, Clip>,
        primitive: &Primitive,
        skinned: &SkinnedPrimitive<'_>,
        viewer: Option<HPoint<Model>>,
    ) {
        let positions = &skinned.positions;
        self.unclipped.clear(positions.len());
        self.to_clip.clear(positions.len());
        if primitive.topology != Topology::Triangles {
            // Points and lines extend beyond the box around their vertices.
            return self.to_clip.add_all(primitive.item_count());
        }
        let Cow::Borrowed(_) = positions else {
            return match transform.classify_bounds(model_to_clip, position_bounds(positions)) {
                Containment::Outside => {}
                Containment::Inside => self.unclipped.add_all(primitive.item_count()),
                Containment::Intersecting => self.to_clip.add_all(primitive.item_count()),
            };
        };
        let clusters = primitive.clusters(viewer.is_some());
        let mesh_containment = transform.classify_bounds(model_to_clip, clusters.bounds());
        if mesh_containment == Containment::Outside {
            return;
        }
        for cluster in clusters.as_slice() {
            if viewer.is_some_and(|viewer| cluster.is_back_facing(viewer)) {
                continue;
            }
            // If the whole mesh is inside, so are its clusters.
            let containment = match mesh_containment {
                Containment::Inside => mesh_containment,
                _ => transform.classify_bounds(model_to_clip, cluster.bounds()),
            };
            match containment {
                Containment::Outside => {}
                Containment::Inside => self.unclipped.add_cluster(cluster),
                Containment::Intersecting => self.to_clip.add_cluster(cluster),
            }
        }
    }

    /// Transforms the selected vertices: model to clip space, perspective divide, viewport,
    /// snapping.
    ///
    /// One pass of SIMD code takes the vertices of unclipped triangles from positions to the grid.
    pub(super) fn project_vertices(
        &mut self,
        transform: &ScreenTransform,
        model_to_clip: Projective<Model, Clip>,
        positions: &[[f32; 3]],
        threads: usize,
    ) {
        let (ndc_to_screen, simd_level) = (transform.ndc_to_screen(), SimdLevel::best());
        let projection =
            VertexProjection { to_clip: model_to_clip, ndc_to_screen, simd_level, threads };
        let screen_vertices = &mut self.screen_vertices;
        projection.project_selected_positions(positions, &self.unclipped, screen_vertices);
        if self.to_clip.is_empty() {
            return;
        }
        self.clip_positions.resize(positions.len(), HPoint::new(0.0, 0.0, 0.0, 1.0));
        self.outcodes.resize(positions.len(), Outcode::INSIDE);
        for run in self.to_clip.vertices_within(0..positions.len()) {
            let clip = &mut self.clip_positions[run.clone()];
            let outcodes = &mut self.outcodes[run.clone()];
            let guard_band = transform.screen.volume();
            guard_band.project_positions(model_to_clip, &positions[run.clone()], clip, outcodes);
            let screen = &mut self.screen_vertices[run];
            ScreenVertex::divide_and_snap_points(clip, ndc_to_screen, simd_level, screen);
            // Outside the guard band a snapped position is off the grid; behind the eye it is
            // wrong.
            for (vertex, code) in screen.iter_mut().zip(outcodes) {
                *vertex = vertex.filter(|_| code.is_inside());
            }
        }
    }

    /// Returns the runs of selected triangles in mesh order, as pairs: unclipped runs, then the run
    /// to clip that follows them. The last pair has an empty run at `usize::MAX`.
    ///
    /// Mesh order ensures that translucent triangles of equal depth stay in file order.
    pub(super) fn triangle_runs(&self) -> impl Iterator<Item = (&[Range<usize>], Range<usize>)> {
        let mut remaining = self.unclipped.triangles();
        let to_clip = self.to_clip.triangles().iter().cloned();
        to_clip.chain(std::iter::once(usize::MAX..usize::MAX)).map(move |to_clip| {
            let before = remaining.partition_point(|run| run.start < to_clip.start);
            let unclipped;
            (unclipped, remaining) = remaining.split_at(before);
            (unclipped, to_clip)
        })
    }
}

/// Returns the bounding box of positions as minimum and maximum coordinates.
fn position_bounds(positions: &[[f32; 3]]) -> [[f32; 3]; 2] {
    let (mut min, mut max) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for position in positions {
        for axis in 0..3 {
            min[axis] = min[axis].min(position[axis]);
            max[axis] = max[axis].max(position[axis]);
        }
    }
    [min, max]
}
