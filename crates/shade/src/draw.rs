//! Draws: the arrays behind the names of primitives.
//!
//! The rasteriser knows a triangle by a number and says how much each corner counts at a pixel. A draw holds what the
//! corners carry, for a run of such numbers: one primitive of one instance of one mesh.

use super::MaterialTextures;
use super::attributes::{PrimitiveIndices, UV, Vertex, VertexIndices, interpolate};
use super::fragment_lanes::FragmentLanes;
use model::{Material, Primitive, TextureInfo, Topology};
use std::borrow::Cow;

/// One primitive of a mesh at one place of the world.
#[derive(Clone, Debug)]
pub struct Draw<'a> {
    /// The name of its first point, line or triangle; the others follow.
    pub first_id: u32,
    /// Its number among the primitives of the scene, as often as they are shown.
    pub part_id: u32,
    /// Indices, and what else the vertices carry.
    pub primitive: &'a Primitive,
    /// What it is made of.
    pub material: &'a Material,
    /// The textures of the material.
    pub textures: MaterialTextures<'a>,
    /// What its vertices carry; nothing where nothing of it counts.
    pub vertices: Vec<Vertex>,
    /// Which way textures of slopes lie on the surface.
    pub tangents: Tangents,
    /// Whether the vertices have normals that are to be seen; otherwise each triangle has one of its own.
    pub is_smooth: bool,
    /// The set of the texture coordinates that the vertices carry, if they carry any.
    pub uv_set: Option<usize>,
    /// The vertex colours, if there are any.
    pub colors: Option<Cow<'a, [[f32; 4]]>>,
    /// What it stands for.
    pub kind: DrawKind,
    /// Whether the way to the world mirrors, so that triangles run the other way round.
    pub flips_winding: bool,
    /// How much longer things are in the world than in the mesh; the mean of all directions where they differ.
    pub world_scale: f32,
}

/// What a draw stands for.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum DrawKind {
    /// A surface of a model.
    #[default]
    Surface,
    /// The environment behind everything, blurred so much, from 0 to 1.
    Environment(f32),
    /// What is painted behind everything; places are parts of the picture's width and height.
    Backdrop,
    /// The ground, of which only shadows are seen.
    ShadowCatcher,
}

/// Which way the u of textures runs on a surface: unit vectors in the world, and in w the side of the bitangent, 1 or −1.
#[derive(Clone, Debug, Default)]
pub enum Tangents {
    /// Nothing asks for them.
    #[default]
    None,
    /// One for each vertex.
    PerVertex(Vec<[f32; 4]>),
    /// One for each corner of each triangle.
    PerCorner(Vec<[f32; 4]>),
}

/// All draws of a frame, in the order of their names.
#[derive(Clone, Debug, Default)]
pub struct DrawList<'a> {
    /// The draws; the first has the name 0.
    pub draws: Vec<Draw<'a>>,
}

impl<'a> DrawList<'a> {
    /// The draw that a name belongs to, and the first name that does not belong to it any more.
    #[inline(always)]
    pub(crate) fn find_draw(&self, id: u32) -> (&Draw<'a>, u32) {
        let after = self.draws.partition_point(|draw| draw.first_id <= id);
        let end = self.draws.get(after).map_or(u32::MAX, |next| next.first_id);
        (&self.draws[after - 1], end)
    }
}

impl Draw<'_> {
    /// The vertices of a point, line or triangle. Corners that it lacks repeat its last one; their weights are 0.
    #[inline(always)]
    fn primitive_vertices(&self, item: usize) -> [usize; 3] {
        let indices = &self.primitive.indices;
        if self.primitive.topology == Topology::Triangles {
            let [a, b, c] = indices.as_chunks::<3>().0[item];
            return [a as usize, b as usize, c as usize];
        }
        let count = self.primitive.topology.vertices_per_item();
        [0, 1, 2].map(|k: usize| indices[item * count + k.min(count - 1)] as usize)
    }

    /// The primitives with these names, all of this draw.
    #[inline(always)]
    pub(super) fn primitive_indices<const N: usize>(
        &self,
        ids: &[u32; N],
        are_of_one: bool,
    ) -> PrimitiveIndices<N> {
        if are_of_one {
            return PrimitiveIndices::One((ids[0] - self.first_id) as usize);
        }
        let mut items = [0; N];
        for lane in 0..N {
            items[lane] = (ids[lane] - self.first_id) as usize;
        }
        PrimitiveIndices::Each(items)
    }

    /// The vertices of fragments of these primitives.
    #[inline(always)]
    pub(super) fn vertex_indices<const N: usize>(
        &self,
        items: &PrimitiveIndices<N>,
    ) -> VertexIndices<N> {
        items.vertex_indices(|item| self.primitive_vertices(item))
    }

    /// The tangents at fragments of these primitives, of any length; none where nothing is known of them.
    #[inline(always)]
    pub(super) fn interpolate_tangents<const N: usize>(
        &self,
        items: &PrimitiveIndices<N>,
        weights: &[[f32; N]; 3],
    ) -> [[f32; N]; 4] {
        match &self.tangents {
            Tangents::None => [[0.0; N]; 4],
            Tangents::PerVertex(all) => {
                interpolate(&self.vertex_indices(items).fetch_attributes(all, 0), weights)
            }
            Tangents::PerCorner(all) => {
                let corners = items.vertex_indices(|item| [3 * item, 3 * item + 1, 3 * item + 2]);
                interpolate(&corners.fetch_attributes(all, 0), weights)
            }
        }
    }

    /// The texture's coordinates, and their derivatives by the pixel's column and row.
    #[inline(always)]
    pub(super) fn texture_coordinates<const N: usize>(
        &self,
        corners: &VertexIndices<N>,
        seen: &impl FragmentLanes<N>,
        used: &TextureInfo,
    ) -> [[[f32; N]; 2]; 3] {
        let mut uvs = [[[0.0; N]; 2]; 3];
        let carried = if self.uv_set == Some(used.uv_set) {
            corners.fetch_attributes(&self.vertices, UV)
        } else if let Some(set) = self.primitive.uvs.get(used.uv_set) {
            corners.fetch_attributes(set, 0)
        } else {
            return uvs;
        };
        let [u, v] = interpolate(&carried, &seen.weights());
        for (axis, map) in used.uv_matrix.iter().enumerate() {
            for lane in 0..N {
                uvs[0][axis][lane] = map[0] * u[lane] + map[1] * v[lane] + map[2];
            }
        }
        uvs[1] = transform_uv_step(&used.uv_matrix, &interpolate(&carried, &seen.weights_dx()));
        uvs[2] = transform_uv_step(&used.uv_matrix, &interpolate(&carried, &seen.weights_dy()));
        uvs
    }
}

/// A step of texture coordinates after their map, which moves places but not steps.
#[inline(always)]
fn transform_uv_step<const N: usize>(
    uv_map: &[[f32; 3]; 2],
    [u, v]: &[[f32; N]; 2],
) -> [[f32; N]; 2] {
    let mut turned = [[0.0; N]; 2];
    for (axis, map) in uv_map.iter().enumerate() {
        for lane in 0..N {
            turned[axis][lane] = map[0] * u[lane] + map[1] * v[lane];
        }
    }
    turned
}
