//! Edge visibility: the edges that a file marks for line drawings
//! (EXT_mesh_primitive_edge_visibility, CESIUM_primitive_outline).
//!
//! If a file does not mark edges, drawings find feature edges from the shape.

/// Marked edges of the triangles of a primitive.
///
/// The two sources add up: an edge is drawn if `visibility` or an entry of `lines` says so.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct PrimitiveEdges {
    /// For each triangle of [`Primitive::indices`](crate::Primitive::indices) the visibility of its
    /// edges 0–1, 1–2 and 2–0. `None` if the file marks edges by `lines` only.
    pub visibility: Option<Vec<[EdgeVisibility; 3]>>,
    /// Edges that are always drawn, as pairs of vertices: outlines and line strings.
    pub lines: Vec<EdgeList>,
    /// Material of the edges; `None` for the primitive's material.
    pub material: Option<usize>,
}

/// Always visible edges with one material.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct EdgeList {
    /// Two vertex indices for each edge.
    pub vertex_pairs: Vec<[u32; 2]>,
    /// The material; `None` for [`PrimitiveEdges::material`].
    pub material: Option<usize>,
}

/// Condition under which an edge is drawn, from the least visible to the most.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub enum EdgeVisibility {
    /// Never.
    #[default]
    Hidden,
    /// If it separates a front face from a back face.
    Silhouette,
    /// Always.
    Hard,
    /// Always; another triangle has the same edge as [`Hard`](Self::Hard).
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
