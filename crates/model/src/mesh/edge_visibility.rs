//! Edge visibility: the edges that a file marks for line drawings
//! (EXT_mesh_primitive_edge_visibility, CESIUM_primitive_outline).
//!
//! If a file does not mark edges, line drawings detect feature edges from the shape.

/// The marked triangle edges of a primitive.
///
/// An edge is drawn if either `visibility` or an entry of `lines` marks it.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct PrimitiveEdges {
    /// For each triangle of [`Primitive::indices`](crate::Primitive::indices), the visibility of
    /// its edges 0–1, 1–2 and 2–0. `None` if the file marks edges only by `lines`.
    pub visibility: Option<Vec<[EdgeVisibility; 3]>>,
    /// Edges that are always drawn, as pairs of vertices: outlines and line strings.
    pub lines: Vec<EdgeList>,
    /// Material of the edges, or `None` for the primitive's material.
    pub material: Option<usize>,
}

/// Edges with one material that are always visible.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct EdgeList {
    /// Two vertex indices per edge.
    pub vertex_pairs: Vec<[u32; 2]>,
    /// The material, or `None` for [`PrimitiveEdges::material`].
    pub material: Option<usize>,
}

/// The condition under which an edge is drawn, in order of increasing visibility.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub enum EdgeVisibility {
    /// Never.
    #[default]
    Hidden,
    /// If the edge separates a front face from a back face.
    Silhouette,
    /// Always.
    Hard,
    /// Always; another triangle marks the same edge as [`Hard`](Self::Hard).
    RepeatedHard,
}

impl EdgeVisibility {
    /// Decodes the lowest two bits of a byte (EXT_mesh_primitive_edge_visibility).
    #[must_use]
    pub const fn from_bits(bits: u8) -> Self {
        match bits & 3 {
            0 => Self::Hidden,
            1 => Self::Silhouette,
            2 => Self::Hard,
            _ => Self::RepeatedHard,
        }
    }
}
