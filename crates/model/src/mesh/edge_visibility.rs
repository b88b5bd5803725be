//! Which edges of a primitive its maker wants to see (EXT_mesh_primitive_edge_visibility, CESIUM_primitive_outline): for
//! drawings, which otherwise find edges from the shape.

/// The edges of the triangles of a primitive.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct PrimitiveEdges {
    /// For each triangle of [`Primitive::indices`](crate::Primitive::indices) its edges from the first corner to the second,
    /// the second to the third, the third to the first. `None` if the file names visible edges only by `lines`.
    pub visibility: Option<Vec<[EdgeVisibility; 3]>>,
    /// Edges that are always seen, as pairs of vertices: outlines and line strings.
    pub lines: Vec<EdgeList>,
    /// The material of the edges; `None` for that of the primitive.
    pub material: Option<usize>,
}

/// Edges with one material.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct EdgeList {
    /// Two vertices for each edge.
    pub vertex_pairs: Vec<[u32; 2]>,
    /// The material; `None` for that of all edges.
    pub material: Option<usize>,
}

/// When an edge is seen, from the least to the most.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub enum EdgeVisibility {
    /// Never.
    #[default]
    Hidden,
    /// Where it parts a triangle that faces the eye from one that does not.
    Silhouette,
    /// Always.
    Hard,
    /// Always, and another triangle has the same edge as [`Hard`](Self::Hard).
    RepeatedHard,
}

impl EdgeVisibility {
    /// The visibility that the lowest two bits of a number stand for.
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
