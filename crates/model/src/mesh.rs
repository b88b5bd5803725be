//! Meshes: arrays of vertices, and lists of points, lines or triangles over them.

mod edge_visibility;
mod tangents;

pub use edge_visibility::{EdgeList, EdgeVisibility, PrimitiveEdges};

use raster::Clusters;
use std::sync::OnceLock;

/// A named group of primitives.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// The parts, each with one material.
    pub primitives: Vec<Primitive>,
    /// How much of each morph target is shown, unless a node says otherwise; targets beyond the list are not shown.
    pub morph_weights: Vec<f32>,
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
    /// Unit tangents, and in w the side of the bitangent, 1 or −1. `None` where the file has none (see
    /// [`derived_tangents`](Self::derived_tangents)) and where no material of the primitive needs them.
    pub tangents: Option<Vec<[f32; 4]>>,
    /// Sets of texture coordinates, (0, 0) at the upper left of the image; `uvs[n]` is `TEXCOORD_n`.
    pub uvs: Vec<Vec<[f32; 2]>>,
    /// Vertex colours, linear, with alpha.
    pub colors: Option<Vec<[f32; 4]>>,
    /// Sets of four joints of the skin for each vertex.
    pub joint_indices: Vec<Vec<[u16; 4]>>,
    /// The weights of those joints, as many sets.
    pub joint_weights: Vec<Vec<[f32; 4]>>,
    /// Differences that can be added to the vertices.
    pub morph_targets: Vec<MorphTarget>,
    /// The material's number in the model; `None` for the default material.
    pub material: Option<usize>,
    /// The materials it has in variants of the model instead.
    pub material_variants: Vec<VariantMaterial>,
    /// The edges its maker wants to see, if the file says so.
    pub edges: Option<Box<PrimitiveEdges>>,
    /// What is worked out of the other fields when it is first asked for: nothing in a new primitive.
    pub derived: DerivedData,
}

/// What a primitive keeps that follows from its other fields. Who changes these must begin again with [`Derived::default`].
#[derive(Clone, Debug, Default)]
pub struct DerivedData {
    /// The clusters of its triangles, without and with cones around their normals.
    clusters: [OnceLock<Clusters>; 2],
    /// The tangents of its corners for the set of texture coordinates that was asked for first, if they can be derived.
    pub(super) tangents: OnceLock<(usize, Option<Vec<[f32; 4]>>)>,
}

/// The material of a primitive in a variant of the model.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct VariantMaterial {
    /// The variant's number in the model.
    pub variant: usize,
    /// The material's number in the model.
    pub material: usize,
}

/// Differences that are added, each times a weight, to the vertices of a primitive. Arrays that are present have one
/// entry per vertex.
#[derive(Clone, Debug, Default)]
pub struct MorphTarget {
    /// Differences of positions.
    pub positions: Option<Vec<[f32; 3]>>,
    /// Differences of normals.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Differences of tangents, without w.
    pub tangents: Option<Vec<[f32; 3]>>,
    /// Differences of texture coordinates, by set; sets that stay have none.
    pub uvs: Vec<Option<Vec<[f32; 2]>>>,
    /// Differences of vertex colours.
    pub colors: Option<Vec<[f32; 4]>>,
}

impl Primitive {
    /// How many points, lines or triangles there are.
    #[must_use]
    pub fn item_count(&self) -> usize {
        self.indices.len() / self.topology.vertices_per_item()
    }

    /// The clusters of its triangles, with cones where it matters which side they show.
    pub fn clusters(&self, cones: bool) -> &Clusters {
        let triangles = self.indices.as_chunks::<3>().0;
        self.derived.clusters[usize::from(cones)]
            .get_or_init(|| Clusters::build(&self.positions, triangles, cones))
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
    pub const fn vertices_per_item(self) -> usize {
        match self {
            Self::Points => 1,
            Self::Lines => 2,
            Self::Triangles => 3,
        }
    }
}
