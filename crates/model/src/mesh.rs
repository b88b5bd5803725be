//! Meshes: vertex attributes and index lists of triangles, lines or points.

mod edge_visibility;
mod tangents;

pub use edge_visibility::{EdgeList, EdgeVisibility, PrimitiveEdges};

use raster::Clusters;
use std::sync::OnceLock;

/// A mesh: a named group of primitives that a node carries as a unit.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// The primitives, each with one material.
    pub primitives: Vec<Primitive>,
    /// Default weights of the morph targets, for nodes that do not have their own. Targets beyond
    /// the list have weight 0.
    pub morph_weights: Vec<f32>,
}

/// A mesh primitive: vertex attributes, indices and a material; the unit of a draw call.
///
/// Strips, loops and fans have been expanded to plain lists, with the winding that the
/// specification defines. Every attribute that is present has one entry for each vertex, every
/// index is less than the number of vertices, and every position is finite: the importer has
/// dropped invalid items.
#[derive(Clone, Debug, Default)]
pub struct Primitive {
    /// Whether the indices form points, lines or triangles.
    pub topology: Topology,
    /// Vertex indices: one for each point, two per line, three per triangle. The front face is the
    /// one whose vertices run counter-clockwise.
    pub indices: Vec<u32>,
    /// Positions in the mesh's coordinates.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals; `None` if the file has none; faces are then shaded flat.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Unit tangents with the handedness of the bitangent, 1 or −1, in w.
    ///
    /// `None` if the file has none ([`mikktspace_tangents`](Self::mikktspace_tangents) generates
    /// them) or if no material of the primitive needs a tangent frame.
    pub tangents: Option<Vec<[f32; 4]>>,
    /// Sets of texture coordinates with (0, 0) at the upper left of the image; `uvs[n]` is
    /// `TEXCOORD_n`.
    pub uvs: Vec<Vec<[f32; 2]>>,
    /// Vertex colors, linear, with alpha (`COLOR_0`).
    pub colors: Option<Vec<[f32; 4]>>,
    /// Joint indices of the skin: sets of four for each vertex; entry n is `JOINTS_n`.
    pub joint_indices: Vec<Vec<[u16; 4]>>,
    /// Weights of those joints, in the same number of sets; entry n is `WEIGHTS_n`.
    pub joint_weights: Vec<Vec<[f32; 4]>>,
    /// Morph targets (blend shapes): deltas that are added to the vertices.
    pub morph_targets: Vec<MorphTarget>,
    /// Index of the material in the model; `None` for the default material.
    pub material: Option<usize>,
    /// Replacement materials for `material` in variants of the model.
    pub material_variants: Vec<VariantMaterial>,
    /// Edges that the file marks for line drawings, if it does.
    pub edges: Option<Box<PrimitiveEdges>>,
    /// Cache of data derived from the other fields; empty in a new primitive.
    pub derived: DerivedData,
}

/// Lazily computed data derived from the other fields of a primitive.
///
/// After changing those fields, reset this with [`DerivedData::default`]: the cache does not
/// notice.
#[derive(Clone, Debug, Default)]
pub struct DerivedData {
    /// Clusters of the triangles, without and with normal cones.
    clusters: [OnceLock<Clusters>; 2],
    /// MikkTSpace tangents for the first requested set of texture coordinates; `None` inside if the
    /// algorithm fails.
    pub(super) tangents: OnceLock<(usize, Option<Vec<[f32; 4]>>)>,
}

/// Material of a primitive in one variant of the model (KHR_materials_variants).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct VariantMaterial {
    /// Index of the variant in the model.
    pub variant: usize,
    /// Index of the material in the model.
    pub material: usize,
}

/// A morph target (blend shape): deltas that are added to the vertices of a primitive, times a
/// weight.
///
/// Arrays that are present have one entry for each vertex.
#[derive(Clone, Debug, Default)]
pub struct MorphTarget {
    /// Deltas of positions.
    pub positions: Option<Vec<[f32; 3]>>,
    /// Deltas of normals.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Deltas of tangents, without w.
    pub tangents: Option<Vec<[f32; 3]>>,
    /// Deltas of texture coordinates by set; `None` for sets that do not change.
    pub uvs: Vec<Option<Vec<[f32; 2]>>>,
    /// Deltas of vertex colors.
    pub colors: Option<Vec<[f32; 4]>>,
}

impl Primitive {
    /// Returns the bytes of all arrays.
    pub fn array_bytes(&self) -> usize {
        fn bytes<T>(array: &Option<Vec<T>>) -> usize {
            array.as_deref().map_or(0, size_of_val)
        }
        fn all_bytes<T>(arrays: &[Vec<T>]) -> usize {
            arrays.iter().map(|array| size_of_val(&**array)).sum()
        }
        let of_target = |target: &MorphTarget| {
            bytes(&target.positions)
                + bytes(&target.normals)
                + bytes(&target.tangents)
                + target.uvs.iter().map(bytes).sum::<usize>()
                + bytes(&target.colors)
        };
        size_of_val(&*self.indices)
            + size_of_val(&*self.positions)
            + bytes(&self.normals)
            + bytes(&self.tangents)
            + all_bytes(&self.uvs)
            + bytes(&self.colors)
            + all_bytes(&self.joint_indices)
            + all_bytes(&self.joint_weights)
            + self.morph_targets.iter().map(of_target).sum::<usize>()
    }

    /// Number of points, lines or triangles.
    #[must_use]
    pub fn item_count(&self) -> usize {
        self.indices.len() / self.topology.vertices_per_item()
    }

    /// Clusters of the triangles for culling, computed once; with normal cones if back faces are
    /// culled.
    pub fn clusters(&self, cones: bool) -> &Clusters {
        let triangles = self.indices.as_chunks::<3>().0;
        self.derived.clusters[usize::from(cones)]
            .get_or_init(|| Clusters::build(&self.positions, triangles, cones))
    }
}

/// Primitive topology: how indices are grouped.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Topology {
    /// Points: each index is one.
    Points,
    /// Line list: every two indices form a line.
    Lines,
    /// Triangle list: every three indices form a triangle.
    #[default]
    Triangles,
}

impl Topology {
    /// Number of indices for each point, line or triangle: 1, 2 or 3.
    #[must_use]
    pub const fn vertices_per_item(self) -> usize {
        match self {
            Self::Points => 1,
            Self::Lines => 2,
            Self::Triangles => 3,
        }
    }
}
