//! Shadow receivers: offset positions that avoid the shadow terminator artifact.
//!
//! ```text
//!               n              the smooth surface that the vertex normals describe bulges
//!     ╲   .·´●`·.   ╱          over the flat triangle; its points ● are looked up in the
//!   n  ●´────┴────`●  n        shadow map instead of the triangle's points
//! ```
//!
//! Normals are smooth, but triangles are not. Near the border between light and shade, whole
//! triangles face away from a light that their vertex normals still face. Each would shadow itself
//! entirely. The position for the lookup is therefore moved onto the tangent planes of the
//! vertices, where the surface bulges (Hanika, *Hacking the shadow terminator*, Ray Tracing Gems
//! II, 2021).

use super::Draw;
use super::attributes::{NORMAL, VertexIndices, interpolate};
use super::fragment_lanes::FragmentLanes;
use super::lanes::Vec3Lanes;
use super::surface_geometry::SurfaceGeometry;

/// The positions and unit normals for looking up surfaces in shadow maps.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShadowReceiver<const N: usize> {
    /// The positions in the world, moved from the flat triangles onto the smooth surface.
    pub(super) positions: Vec3Lanes<N>,
    /// The shading normals, which define the receiver's plane on a shadow map.
    pub(super) normals: Vec3Lanes<N>,
}

impl<const N: usize> ShadowReceiver<N> {
    /// Computes the receivers for fragments of a draw, with positions on the smooth surface if
    /// there is one.
    ///
    /// The offset is 0 at the vertices, whose tangent planes pass through them.
    #[inline(always)]
    pub(super) fn from_geometry(
        draw: &Draw<'_>,
        vertices: &VertexIndices<N>,
        fragments: &impl FragmentLanes<N>,
        geometry: &SurfaceGeometry<N>,
    ) -> Self {
        let SurfaceGeometry { positions, normals, .. } = *geometry;
        if !draw.is_smooth {
            return Self { positions, normals };
        }
        let weights = fragments.weights();
        let vertex_positions = draw.vertex_positions(vertices);
        let vertex_normals = vertices.fetch_attributes::<_, 3>(&draw.vertices, NORMAL);
        // The vertex normals belong to the front, so either all or none of them point to the
        // visible side.
        let front = Vec3Lanes::from(interpolate(&vertex_normals, &weights));
        let sign = front.dot(normals).map(|cosine| if cosine < 0.0 { -1.0 } else { 1.0 });
        let mut moved = positions;
        for vertex in 0..3 {
            let normal = Vec3Lanes::from(vertex_normals[vertex]) * sign;
            let offset = positions - Vec3Lanes::from(vertex_positions[vertex]);
            // The signed height of the fragment over the vertex's tangent plane, at most 0.
            let depth = offset.dot(normal).min(0.0);
            // Move onto the tangent plane, weighted like the vertex.
            moved = moved - normal * (weights[vertex] * depth);
        }
        Self { positions: moved, normals }
    }
}
