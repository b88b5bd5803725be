//! Draw calls: the vertex and index arrays behind the primitive ids of a visibility buffer.
//!
//! The rasterizer identifies a triangle by an id and provides the weights of its vertices at a
//! pixel. A draw contains everything else that shading needs for a run of consecutive ids: one
//! primitive (in glTF, part of a mesh with one material) of one instance.
//!
//! ```text
//!   id        0 … 11        12 … 523        524 …
//!   draw    ┌──────────┐  ┌──────────────┐  ┌──────
//!           │ first_id │  │ first_id     │  │          triangle `id − first_id` of the primitive
//!           │ = 0      │  │ = 12         │  │
//! ```

use super::MaterialTextures;
use super::attributes::{PrimitiveIndices, UV, Vertex, VertexIndices, interpolate};
use super::fragment_lanes::FragmentLanes;
use super::lanes::{Lanes, Vec3Lanes, map_to_lanes};
use super::surface_geometry::TangentLanes;
use super::texture::UvLanes;
use model::{Material, Primitive, TextureInfo, Topology};
use std::borrow::Cow;

/// A draw call: one primitive of a mesh in one instance.
///
/// Vertices have been transformed to world space once per frame, because lights and environments
/// are in world space. The rasterizer uses separate screen positions.
#[derive(Clone, Debug)]
pub struct Draw<'a> {
    /// The id of the first point, line or triangle; the ids of the others follow.
    pub first_id: u32,
    /// The index among the primitives of the scene, counting each instance.
    pub part_id: u32,
    /// The indices, and the attributes that are not in [`vertices`](Self::vertices).
    pub primitive: &'a Primitive,
    /// The material of the primitive.
    pub material: &'a Material,
    /// The textures of the material.
    pub textures: MaterialTextures<'a>,
    /// The vertices in the world, indexed as in `primitive`; empty if no fragment of the draw is
    /// shaded.
    pub vertices: Vec<Vertex>,
    /// The tangents, for normal maps and anisotropy.
    pub tangents: Tangents,
    /// Whether shading interpolates vertex normals; otherwise each triangle has a flat normal.
    pub is_smooth: bool,
    /// The index of the texture coordinate set in `vertices`, if there is one.
    pub uv_set: Option<usize>,
    /// The linear vertex colors, if there are any.
    pub colors: Option<Cow<'a, [[f32; 4]]>>,
    /// The kind of surface.
    pub kind: DrawKind,
    /// Whether the transform to the world is a reflection, so that front faces are wound clockwise.
    pub flips_winding: bool,
    /// The scale from the mesh to the world, averaged over all directions if it is not uniform.
    pub world_scale: f32,
}

/// The kind of surface that a draw call draws.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum DrawKind {
    /// A surface of a model.
    #[default]
    Surface,
    /// The environment as a background, blurred as in a mirror with this roughness.
    Environment(f32),
    /// The backdrop, a gradient or an image. Positions are fractions of the picture's width and
    /// height.
    Backdrop,
    /// The ground as a shadow catcher, which is transparent except for the shadows on it.
    ShadowCatcher,
}

/// The tangents of a draw: unit vectors in world space in the direction of increasing u, with the
/// handedness of the tangent frame, 1 or −1, in w.
#[derive(Clone, Debug, Default)]
pub enum Tangents {
    /// No tangents are needed.
    #[default]
    None,
    /// One tangent per vertex.
    PerVertex(Vec<[f32; 4]>),
    /// Three tangents per triangle, one for each corner.
    PerCorner(Vec<[f32; 4]>),
}

/// All draws of a frame, ordered by id.
#[derive(Clone, Debug, Default)]
pub struct DrawList<'a> {
    /// The draws; the first begins at id 0.
    pub draws: Vec<Draw<'a>>,
}

impl<'a> DrawList<'a> {
    /// Finds, by binary search, the draw that an id belongs to, and returns it with the first id of
    /// the next draw.
    #[inline(always)]
    pub(crate) fn find_draw(&self, id: u32) -> (&Draw<'a>, u32) {
        // The last draw that begins at or before the id.
        let after = self.draws.partition_point(|draw| draw.first_id <= id);
        let end = self.draws.get(after).map_or(u32::MAX, |next| next.first_id);
        (&self.draws[after - 1], end)
    }

    /// Returns whether two triangles of a smooth draw share an edge with the same vertices, so that
    /// normals, colors and texture coordinates are continuous across it.
    ///
    /// Vertices that merely have equal positions, as at creases and texture seams, are not the
    /// same.
    pub(crate) fn is_continuous(&self, first_id: u32, second_id: u32) -> bool {
        let (draw, end) = self.find_draw(first_id);
        if !(draw.first_id..end).contains(&second_id) || !draw.is_smooth {
            return false;
        }
        if draw.primitive.topology != Topology::Triangles {
            return false;
        }
        let [first, second] =
            [first_id, second_id].map(|id| draw.primitive_vertices((id - draw.first_id) as usize));
        let mut shared = 0;
        for vertex in first {
            shared += usize::from(second.contains(&vertex));
        }
        shared >= 2
    }
}

impl Draw<'_> {
    /// Returns the vertices of a point, line or triangle. For points and lines, the last vertex is
    /// repeated, with weight 0.
    #[inline(always)]
    fn primitive_vertices(&self, primitive: usize) -> [usize; 3] {
        let indices = &self.primitive.indices;
        if self.primitive.topology == Topology::Triangles {
            let [a, b, c] = indices.as_chunks::<3>().0[primitive];
            return [a as usize, b as usize, c as usize];
        }
        let count = self.primitive.topology.vertices_per_item();
        [0, 1, 2].map(|k: usize| indices[primitive * count + k.min(count - 1)] as usize)
    }

    /// Returns the indices of the primitives with these ids, which must all be from this draw.
    #[inline(always)]
    pub(super) fn primitive_indices<const N: usize>(
        &self,
        ids: &[u32; N],
        is_single_primitive: bool,
    ) -> PrimitiveIndices<N> {
        if is_single_primitive {
            PrimitiveIndices::One((ids[0] - self.first_id) as usize)
        } else {
            let mut primitives = [0; N];
            for (primitive, id) in primitives.iter_mut().zip(ids) {
                *primitive = (id - self.first_id) as usize;
            }
            PrimitiveIndices::Each(primitives)
        }
    }

    /// Returns the indices of the vertices of these primitives.
    #[inline(always)]
    pub(super) fn vertex_indices<const N: usize>(
        &self,
        primitives: &PrimitiveIndices<N>,
    ) -> VertexIndices<N> {
        primitives.vertex_indices(
            #[inline(always)]
            |primitive| self.primitive_vertices(primitive),
        )
    }

    /// Returns the interpolated tangents, which may have any length, or zero if the draw has no
    /// tangents.
    #[inline(always)]
    pub(super) fn interpolate_tangents<const N: usize>(
        &self,
        primitives: &PrimitiveIndices<N>,
        weights: &[Lanes<N>; 3],
    ) -> TangentLanes<N> {
        let attributes = match &self.tangents {
            Tangents::None => return TangentLanes::NONE,
            Tangents::PerVertex(tangents) => {
                self.vertex_indices(primitives).fetch_attributes(tangents, 0)
            }
            Tangents::PerCorner(tangents) => primitives
                .vertex_indices(|triangle| [3 * triangle, 3 * triangle + 1, 3 * triangle + 2])
                .fetch_attributes(tangents, 0),
        };
        let [x, y, z, w] = interpolate(&attributes, weights);
        TangentLanes { vectors: Vec3Lanes { x, y, z }, w }
    }

    /// Returns the coordinates at which a texture is sampled, with their screen-space derivatives.
    #[inline(always)]
    pub(super) fn texture_coordinates<const N: usize>(
        &self,
        vertices: &VertexIndices<N>,
        fragments: &impl FragmentLanes<N>,
        info: &TextureInfo,
    ) -> UvLanes<N> {
        let attributes = if self.uv_set == Some(info.uv_set) {
            vertices.fetch_attributes(&self.vertices, UV)
        } else if let Some(set) = self.primitive.uvs.get(info.uv_set) {
            vertices.fetch_attributes(set, 0)
        } else {
            return UvLanes::ZERO;
        };
        // The texture transform (KHR_texture_transform).
        let [u, v] = interpolate(&attributes, &fragments.weights());
        let uv = map_to_lanes(&info.uv_matrix, |[a, b, c]| a * u + b * v + c);
        let dx = interpolate(&attributes, &fragments.weights_dx());
        let dy = interpolate(&attributes, &fragments.weights_dy());
        UvLanes {
            uv,
            dx: transform_uv_step(&info.uv_matrix, dx),
            dy: transform_uv_step(&info.uv_matrix, dy),
        }
    }
}

/// Transforms a derivative of texture coordinates, which is not affected by translation.
#[inline(always)]
fn transform_uv_step<const N: usize>(
    uv_matrix: &[[f32; 3]; 2],
    [u, v]: [Lanes<N>; 2],
) -> [Lanes<N>; 2] {
    map_to_lanes(uv_matrix, |[a, b, _]| a * u + b * v)
}
