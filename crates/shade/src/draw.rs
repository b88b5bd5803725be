//! Draws: the arrays behind the names of primitives.
//!
//! The rasteriser knows a triangle by a number and says how much each corner counts at a pixel. A draw holds what the
//! corners carry, for a run of such numbers: one primitive of one instance of one mesh.

use super::Maps;
use super::corners::{Corners, Items, UV, Vertex, blend};
use super::seen::Seen;
use model::{Material, Primitive, TextureUse, Topology};
use std::borrow::Cow;

/// One primitive of a mesh at one place of the world.
#[derive(Clone, Debug)]
pub struct Draw<'a> {
    /// The name of its first point, line or triangle; the others follow.
    pub first_id: u32,
    /// Its number among the primitives of the scene, as often as they are shown.
    pub part: u32,
    /// Indices, and what else the vertices carry.
    pub primitive: &'a Primitive,
    /// What it is made of.
    pub material: &'a Material,
    /// The textures of the material.
    pub maps: Maps<'a>,
    /// What its vertices carry; nothing where nothing of it counts.
    pub vertices: Vec<Vertex>,
    /// Which way textures of slopes lie on the surface.
    pub tangents: Tangents,
    /// Whether the vertices have normals that are to be seen; otherwise each triangle has one of its own.
    pub smooth: bool,
    /// The set of the texture coordinates that the vertices carry, if they carry any.
    pub uv_set: Option<usize>,
    /// The vertex colours, if there are any.
    pub colors: Option<Cow<'a, [[f32; 4]]>>,
    /// What it stands for.
    pub role: Role,
    /// Whether the way to the world mirrors, so that triangles run the other way round.
    pub mirrored: bool,
    /// How much longer things are in the world than in the mesh; the mean of all directions where they differ.
    pub scale: f32,
}

/// What a draw stands for.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum Role {
    /// A surface of a model.
    #[default]
    Surface,
    /// The environment behind everything, blurred so much, from 0 to 1.
    Backdrop(f32),
    /// What is painted behind everything; places are parts of the picture's width and height.
    Painting,
    /// The ground, of which only shadows are seen.
    Ground,
}

/// Which way the u of textures runs on a surface: unit vectors in the world, and in w the side of the bitangent, 1 or −1.
#[derive(Clone, Debug, Default)]
pub enum Tangents {
    /// Nothing asks for them.
    #[default]
    None,
    /// One for each vertex.
    OfVertices(Vec<[f32; 4]>),
    /// One for each corner of each triangle.
    OfCorners(Vec<[f32; 4]>),
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
    pub(crate) fn of(&self, id: u32) -> (&Draw<'a>, u32) {
        let after = self.draws.partition_point(|draw| draw.first_id <= id);
        let end = self.draws.get(after).map_or(u32::MAX, |next| next.first_id);
        (&self.draws[after - 1], end)
    }
}

impl Draw<'_> {
    /// The vertices of a point, line or triangle. Corners that it lacks repeat its last one; their weights are 0.
    #[inline(always)]
    fn vertices_of(&self, item: usize) -> [usize; 3] {
        let indices = &self.primitive.indices;
        if self.primitive.topology == Topology::Triangles {
            let [a, b, c] = indices.as_chunks::<3>().0[item];
            return [a as usize, b as usize, c as usize];
        }
        let count = self.primitive.topology.corners();
        [0, 1, 2].map(|k: usize| indices[item * count + k.min(count - 1)] as usize)
    }

    /// The primitives with these names, all of this draw.
    #[inline(always)]
    pub(super) fn items<const N: usize>(&self, ids: &[u32; N], are_of_one: bool) -> Items<N> {
        if are_of_one {
            return Items::One((ids[0] - self.first_id) as usize);
        }
        let mut items = [0; N];
        for lane in 0..N {
            items[lane] = (ids[lane] - self.first_id) as usize;
        }
        Items::Each(items)
    }

    /// The vertices of fragments of these primitives.
    #[inline(always)]
    pub(super) fn corners<const N: usize>(&self, items: &Items<N>) -> Corners<N> {
        items.corners(|item| self.vertices_of(item))
    }

    /// The tangents at fragments of these primitives, of any length; none where nothing is known of them.
    #[inline(always)]
    pub(super) fn tangents<const N: usize>(
        &self,
        items: &Items<N>,
        weights: &[[f32; N]; 3],
    ) -> [[f32; N]; 4] {
        match &self.tangents {
            Tangents::None => [[0.0; N]; 4],
            Tangents::OfVertices(all) => blend(&self.corners(items).carried(all, 0), weights),
            Tangents::OfCorners(all) => {
                let corners = items.corners(|item| [3 * item, 3 * item + 1, 3 * item + 2]);
                blend(&corners.carried(all, 0), weights)
            }
        }
    }

    /// The texture's coordinates, and their derivatives by the pixel's column and row.
    #[inline(always)]
    pub(super) fn uvs<const N: usize>(
        &self,
        corners: &Corners<N>,
        seen: &impl Seen<N>,
        used: &TextureUse,
    ) -> [[[f32; N]; 2]; 3] {
        let mut uvs = [[[0.0; N]; 2]; 3];
        let carried = if self.uv_set == Some(used.uv_set) {
            corners.carried(&self.vertices, UV)
        } else if let Some(set) = self.primitive.uvs.get(used.uv_set) {
            corners.carried(set, 0)
        } else {
            return uvs;
        };
        let [u, v] = blend(&carried, &seen.weights());
        for (axis, map) in used.uv_map.iter().enumerate() {
            for lane in 0..N {
                uvs[0][axis][lane] = map[0] * u[lane] + map[1] * v[lane] + map[2];
            }
        }
        uvs[1] = turned(&used.uv_map, &blend(&carried, &seen.weights_dx()));
        uvs[2] = turned(&used.uv_map, &blend(&carried, &seen.weights_dy()));
        uvs
    }
}

/// A step of texture coordinates after their map, which moves places but not steps.
#[inline(always)]
fn turned<const N: usize>(uv_map: &[[f32; 3]; 2], [u, v]: &[[f32; N]; 2]) -> [[f32; N]; 2] {
    let mut turned = [[0.0; N]; 2];
    for (axis, map) in uv_map.iter().enumerate() {
        for lane in 0..N {
            turned[axis][lane] = map[0] * u[lane] + map[1] * v[lane];
        }
    }
    turned
}
