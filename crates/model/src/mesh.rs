//! Meshes: vertex attributes and index lists of triangles, lines or points.

mod edge_visibility;
mod tangents;

pub use edge_visibility::{EdgeList, EdgeVisibility, PrimitiveEdges};

use raster::Clusters;
use std::sync::OnceLock;

/// A mesh: a named group of primitives that is attached to nodes as a unit.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// The primitives, each with one material.
    pub primitives: Vec<Primitive>,
    /// Default morph target weights, for nodes without weights. Targets beyond the list have weight
    /// 0.
    pub morph_weights: Vec<f32>,
}

/// A mesh primitive: vertex attributes, indices and a material. Each primitive is one draw call.
///
/// Strips, loops and fans have been expanded to plain lists, with the winding that the
/// specification defines. Every attribute that is present has one entry per vertex, every index is
/// less than the number of vertices, and every position is finite. The importer ensures this by
/// dropping invalid items.
#[derive(Clone, Debug, Default)]
pub struct Primitive {
    /// Whether the indices form points, lines or triangles.
    pub topology: Topology,
    /// Vertex indices: one per point, two per line, three per triangle. Triangles are
    /// counter-clockwise as seen from the front.
    pub indices: Vec<u32>,
    /// Positions in mesh coordinates.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals, or `None` if the file has none; faces are then shaded flat.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Unit tangents with the handedness of the bitangent, 1 or −1, in w.
    ///
    /// `None` if the file has none ([`mikktspace_tangents`](Self::mikktspace_tangents) generates
    /// them) or if no material of the primitive needs a tangent frame.
    pub tangents: Option<Vec<[f32; 4]>>,
    /// Texture coordinate sets, with (0, 0) at the upper left of the image; `uvs[n]` is
    /// `TEXCOORD_n`.
    pub uvs: Vec<Vec<[f32; 2]>>,
    /// Linear vertex colors with alpha (`COLOR_0`).
    pub colors: Option<Vec<[f32; 4]>>,
    /// Joint indices into the skin, in sets of four per vertex; entry n is `JOINTS_n`.
    pub joint_indices: Vec<Vec<[u16; 4]>>,
    /// Joint weights, in the same number of sets; entry n is `WEIGHTS_n`.
    pub joint_weights: Vec<Vec<[f32; 4]>>,
    /// Morph targets (blend shapes): deltas to add to the vertices.
    pub morph_targets: Vec<MorphTarget>,
    /// Index of the material in the model, or `None` for the default material.
    pub material: Option<usize>,
    /// Materials that replace `material` in variants of the model.
    pub material_variants: Vec<VariantMaterial>,
    /// Edges that the file marks for line drawings, if any.
    pub edges: Option<Box<PrimitiveEdges>>,
    /// A cache of data derived from the other fields; empty in a new primitive.
    pub derived: DerivedData,
}

/// Lazily computed data derived from the other fields of a primitive.
///
/// After changing those fields, reset the cache with [`DerivedData::default`], because it does not
/// detect changes.
#[derive(Clone, Debug, Default)]
pub struct DerivedData {
    /// Triangle clusters, without and with normal cones.
    clusters: [OnceLock<Clusters>; 2],
    /// MikkTSpace tangents for the first requested texture coordinate set; the inner value is
    /// `None` if the algorithm fails.
    pub(super) tangents: OnceLock<(usize, Option<Vec<[f32; 4]>>)>,
}

/// The material of a primitive in one variant of the model (KHR_materials_variants).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct VariantMaterial {
    /// Index of the variant in the model.
    pub variant: usize,
    /// Index of the material in the model.
    pub material: usize,
}

/// A morph target (blend shape): deltas that are multiplied by a weight and added to the vertices
/// of a primitive.
///
/// Arrays that are present have one entry per vertex.
#[derive(Clone, Debug, Default)]
pub struct MorphTarget {
    /// Position deltas.
    pub positions: Option<Vec<[f32; 3]>>,
    /// Normal deltas.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Tangent deltas, without w.
    pub tangents: Option<Vec<[f32; 3]>>,
    /// Texture coordinate deltas by set; `None` for sets that do not change.
    pub uvs: Vec<Option<Vec<[f32; 2]>>>,
    /// Vertex color deltas.
    pub colors: Option<Vec<[f32; 4]>>,
}

impl Primitive {
    /// Returns the size of all arrays in bytes.
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

    /// Returns the number of points, lines or triangles.
    #[must_use]
    pub fn item_count(&self) -> usize {
        self.indices.len() / self.topology.vertices_per_item()
    }

    /// Returns the triangle clusters for culling, with normal cones if back faces are culled. They
    /// are computed once.
    pub fn clusters(&self, cones: bool) -> &Clusters {
        let triangles = self.indices.as_chunks::<3>().0;
        self.derived.clusters[usize::from(cones)]
            .get_or_init(|| Clusters::build(&self.positions, triangles, cones))
    }
}

/// The primitive topology, which determines how indices are grouped.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Topology {
    /// Points: each index is a point.
    Points,
    /// Line list: every two indices form a line.
    Lines,
    /// Triangle list: every three indices form a triangle.
    #[default]
    Triangles,
}

impl Topology {
    /// Returns the number of indices per point, line or triangle: 1, 2 or 3.
    #[must_use]
    pub const fn vertices_per_item(self) -> usize {
        match self {
            Self::Points => 1,
            Self::Lines => 2,
            Self::Triangles => 3,
        }
    }
}
