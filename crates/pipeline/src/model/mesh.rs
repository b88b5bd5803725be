//! Meshes: arrays of vertices, and lists of points, lines or triangles over them.

/// A named group of primitives.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// The parts, each with one material.
    pub primitives: Vec<Primitive>,
    /// How much of each morph target is shown, unless a node says otherwise; targets beyond the list are not shown.
    pub weights: Vec<f32>,
}

/// Vertices with one material, and what to draw of them.
///
/// Strips, loops and fans have become plain lists, in the winding the specification gives them. Every array that is
/// present has one entry per vertex, every index is below the number of vertices, every position is finite.
#[derive(Clone, Debug, Default)]
pub struct Primitive {
    /// What the indices mean.
    pub topology: Topology,
    /// One index a point, two a line, three a triangle (counter-clockwise seen from the front).
    pub indices: Vec<u32>,
    /// Positions in the mesh's coordinates.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals; `None` where the file has none: faces are then flat.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Sets of texture coordinates, (0, 0) at the upper left of the image; `uvs[n]` is `TEXCOORD_n`.
    pub uvs: Vec<Vec<[f32; 2]>>,
    /// Vertex colours, linear, with alpha.
    pub colors: Option<Vec<[f32; 4]>>,
    /// Up to four joints of the skin for each vertex (the first set only).
    pub joints: Option<Vec<[u16; 4]>>,
    /// The weights of those joints.
    pub weights: Option<Vec<[f32; 4]>>,
    /// Differences that can be added to positions and normals.
    pub targets: Vec<MorphTarget>,
    /// The material's number in the model; `None` for the default material.
    pub material: Option<usize>,
}

/// Differences that are added, each times a weight, to the vertices of a primitive. Arrays that are present have one
/// entry per vertex.
#[derive(Clone, Debug, Default)]
pub struct MorphTarget {
    /// Differences of positions.
    pub positions: Option<Vec<[f32; 3]>>,
    /// Differences of normals.
    pub normals: Option<Vec<[f32; 3]>>,
}

impl Primitive {
    /// How many points, lines or triangles there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.indices.len() / self.topology.corners()
    }
}

/// What a list of indices draws.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Topology {
    /// A point for each index.
    Points,
    /// A line for each two indices.
    Lines,
    /// A triangle for each three indices.
    #[default]
    Triangles,
}

impl Topology {
    /// Indices per item: 1, 2 or 3.
    #[must_use]
    pub const fn corners(self) -> usize {
        match self {
            Self::Points => 1,
            Self::Lines => 2,
            Self::Triangles => 3,
        }
    }
}
