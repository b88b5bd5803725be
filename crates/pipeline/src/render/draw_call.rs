//! Submits one draw call: culls back faces, clips, snaps, and adds the result to the frame.
//!
//! ```text
//!  clusters inside the guard band ───────────────────────────────────────────► frame
//!  clusters that cross it ─► back-face culling ─► clip_triangle ─► ÷ w, snap ─► frame
//! ```
//!
//! Clipping happens in homogeneous space, before the divide (CL-3). After the divide, the image of
//! a triangle that extends behind the eye would be meaningless.

use super::projected_mesh::ProjectedMesh;
use super::screen_transform::ScreenTransform;
use clip::Outcode;
use model::{Primitive, Topology};
use raster::{CullMode, Frame, MeshTriangles, Opacity, signed_area};
use std::ops::Range;

/// The width of line primitives in pixels. glTF does not specify it.
const LINE_WIDTH_PIXELS: f64 = 1.5;

/// The state of one draw call: its projected vertices, and the settings for adding its triangles to
/// the frame.
pub(super) struct DrawCall<'a> {
    /// The view transform and guard band of the raster.
    pub(super) transform: &'a ScreenTransform,
    /// The culled and projected vertices.
    pub(super) mesh: &'a ProjectedMesh,
    /// The frame that receives the primitives.
    pub(super) frame: &'a mut Frame,
    /// The opacity: opaque, alpha-tested or translucent.
    pub(super) opacity: Opacity,
    /// The winding of back faces, if they are culled.
    pub(super) cull_mode: CullMode,
    /// The side of point primitives in pixels.
    pub(super) point_size: f64,
}

impl DrawCall<'_> {
    /// Submits the points, lines and triangles that survived culling, in order. The id of each is
    /// `first_id` plus its index in the primitive. Runs of unclipped triangles alternate with runs
    /// that may need clipping.
    pub(super) fn submit(&mut self, primitive: &Primitive, first_id: u32) {
        let mesh = self.mesh;
        let triangles = primitive.indices.as_chunks::<3>().0;
        for (unclipped, to_clip) in mesh.triangle_runs() {
            let vertices = &mesh.screen_vertices;
            let (opacity, cull) = (self.opacity, self.cull_mode);
            let run = MeshTriangles { vertices, triangles, first_id, opacity, cull };
            self.frame.add_mesh_runs(run, unclipped);
            self.clip_and_submit(primitive, to_clip, first_id);
        }
    }

    /// Clips a run of points, lines or triangles and submits what remains.
    fn clip_and_submit(&mut self, primitive: &Primitive, run: Range<usize>, first_id: u32) {
        if run.is_empty() {
            return;
        }
        let count = primitive.topology.vertices_per_item();
        let indices = primitive.indices.get(run.start * count..run.end * count);
        let items = indices.unwrap_or_default().chunks_exact(count);
        for (id, vertices) in (first_id + run.start as u32..).zip(items) {
            match (primitive.topology, vertices) {
                (Topology::Points, &[p]) => self.submit_point(p, id),
                (Topology::Lines, &[p, q]) => self.submit_line([p, q], id),
                (Topology::Triangles, &[p, q, r]) => self.submit_triangle([p, q, r], id),
                _ => {}
            }
        }
    }

    /// Submits a point as a square of constant size if its center is inside the guard band.
    fn submit_point(&mut self, vertex: u32, id: u32) {
        if let Some(center) = self.mesh.screen_vertices[vertex as usize] {
            self.frame.add_point(center, self.point_size, id, self.opacity);
        }
    }

    /// Clips a line like a triangle, and submits it as a rectangle of constant width.
    fn submit_line(&mut self, ends: [u32; 2], id: u32) {
        let ends = ends.map(|vertex| self.mesh.clip_positions[vertex as usize]);
        self.frame.clip_line(&self.transform.screen, ends, LINE_WIDTH_PIXELS, id, self.opacity);
    }

    /// Culls, clips and submits one triangle. The fragments of its clipped parts carry barycentric
    /// weights of the original vertices.
    pub(super) fn submit_triangle(&mut self, vertices: [u32; 3], id: u32) {
        let ProjectedMesh { clip_positions, outcodes, screen_vertices, .. } = self.mesh;
        let vertices = vertices.map(|vertex| vertex as usize);
        if let [Some(p), Some(q), Some(r)] = vertices.map(|vertex| screen_vertices[vertex]) {
            if self.cull_mode.retains(signed_area([p, q, r])) {
                self.frame.add_triangle([p, q, r], id, self.opacity);
            }
            return;
        }
        if Outcode::trivially_rejects(&vertices.map(|vertex| outcodes[vertex])).is_inside() {
            let points = vertices.map(|vertex| clip_positions[vertex]);
            let (opacity, cull) = (self.opacity, self.cull_mode);
            self.frame.clip_triangle(&self.transform.screen, points, id, opacity, cull);
        }
    }
}
