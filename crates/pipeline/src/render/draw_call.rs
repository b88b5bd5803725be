//! Submission of one draw call: back-face culling, clipping, snapping, and hand-over to the frame.
//!
//! ```text
//!  clusters inside the guard band ───────────────────────────────────────────► frame
//!  clusters that cross it ─► back-face culling ─► clip_triangle ─► ÷ w, snap ─► frame
//! ```
//!
//! Clipping happens in homogeneous space, before the divide (CL-3): a triangle that reaches behind
//! the eye has no meaningful picture after it.

use super::projected_mesh::ProjectedMesh;
use super::screen_transform::{ScreenTransform, all_vertices};
use clip::{Outcode, clip_triangle};
use glam::DVec3;
use homog::{Clip, HPoint};
use model::{Primitive, Topology};
use raster::{CullMode, Frame, MeshTriangles, Opacity, signed_area};
use std::ops::Range;

/// The width of line primitives in pixels. glTF leaves it open.
const LINE_WIDTH_PIXELS: f64 = 1.5;

/// The state of one draw call: its projected vertices and how its triangles enter the frame.
pub(super) struct DrawCall<'a> {
    /// The raster's transform and guard band.
    pub(super) transform: &'a ScreenTransform,
    /// The culled and projected vertices.
    pub(super) mesh: &'a ProjectedMesh,
    /// The frame that gets the primitives.
    pub(super) frame: &'a mut Frame,
    /// Opaque, alpha-tested or translucent.
    pub(super) opacity: Opacity,
    /// The winding of back faces, if they are culled.
    pub(super) cull_mode: CullMode,
    /// The side of point primitives in pixels.
    pub(super) point_size: f64,
}

impl DrawCall<'_> {
    /// Submits the selected points, lines and triangles of a primitive in their order, with
    /// consecutive ids from `first_id`: runs of triangles as they are, and between them those that
    /// may need clipping.
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

    /// A point is a square of constant size, drawn if its center is inside the guard band.
    fn submit_point(&mut self, vertex: u32, id: u32) {
        if let Some(center) = self.mesh.screen_vertices[vertex as usize] {
            self.frame.add_point(center, self.point_size, id, self.opacity);
        }
    }

    /// A line is clipped like a triangle, and drawn as a rectangle of constant width.
    fn submit_line(&mut self, ends: [u32; 2], id: u32) {
        let ends = ends.map(|vertex| self.mesh.clip_positions[vertex as usize]);
        let Some(visible) = self.transform.clip_line(ends) else { return };
        if let Some(ends) = self.transform.snap_vertices([visible.start, visible.end]) {
            let parameters = [visible.t0 as f32, visible.t1 as f32];
            self.frame.add_clipped_line(ends, parameters, LINE_WIDTH_PIXELS, id, self.opacity);
        }
    }

    /// Culls, clips and submits one triangle. The fragments of its parts carry barycentric weights
    /// of the original vertices.
    pub(super) fn submit_triangle(&mut self, vertices: [u32; 3], id: u32) {
        let ProjectedMesh { clip_positions, outcodes, screen_vertices, .. } = self.mesh;
        let vertices = vertices.map(|vertex| vertex as usize);
        if let Some(corners) = all_vertices(vertices.map(|vertex| screen_vertices[vertex])) {
            if passes_culling(self.cull_mode, -signed_area(corners).signum() as f64) {
                self.frame.add_triangle(corners, id, self.opacity);
            }
            return;
        }
        let points = vertices.map(|vertex| clip_positions[vertex]);
        let outcodes = vertices.map(|vertex| outcodes[vertex]);
        if !Outcode::trivially_rejects(&outcodes).is_inside()
            || !passes_culling(self.cull_mode, clip_space_orientation(points))
        {
            return;
        }
        // The clipped polygon as a triangle fan.
        for part in clip_triangle(points, &self.transform.guard_band).triangles() {
            if let Some(corners) = self.transform.snap_vertices(part.map(|vertex| vertex.point)) {
                let weights = part.map(|vertex| vertex.weights.map(|weight| weight as f32));
                self.frame.add_clipped_triangle(corners, weights, id, self.opacity);
            }
        }
    }
}

/// Back-face culling of one triangle by the sign of its [`clip_space_orientation`].
fn passes_culling(cull_mode: CullMode, orientation: f64) -> bool {
    match cull_mode {
        CullMode::Nothing => true,
        CullMode::Clockwise => orientation > 0.0,
        CullMode::CounterClockwise => orientation < 0.0,
    }
}

/// The winding of a triangle before the divide: positive if counter-clockwise in the picture, y up.
///
/// The determinant of the (x, y, w) of its vertices (Olano and Greer, *Triangle Scan Conversion
/// using 2D Homogeneous Coordinates*, 1997). Its sign is right also with vertices behind the eye,
/// where the divide would reverse it.
fn clip_space_orientation([p, q, r]: [HPoint<Clip>; 3]) -> f64 {
    let column = |point: HPoint<Clip>| DVec3::new(point.x(), point.y(), point.w());
    column(p).dot(column(q).cross(column(r)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counter_clockwise_is_positive_also_with_corners_behind_the_eye() {
        let corners =
            [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| HPoint::new(x, y, 0.0, 1.0));
        assert!(clip_space_orientation(corners) > 0.0);
        let [p, q, r] = corners;
        assert!(clip_space_orientation([p, r, q]) < 0.0);
        // A vertex moved through the eye's plane, along the line from another: the surface still
        // shows the same face.
        let behind = HPoint::from_raw(q.raw() - (r.raw() * 3.0 - q.raw() * 3.0));
        assert!(clip_space_orientation([p, behind, r]) > 0.0);
    }
}
