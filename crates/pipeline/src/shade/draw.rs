//! Draws: the arrays behind the names of primitives.
//!
//! The rasteriser knows a triangle by a number and says how much each corner counts at a pixel. A draw holds what the
//! corners carry, for a run of such numbers: one primitive of one instance of one mesh.

use super::MipChain;
use crate::model::{Material, Primitive, TextureUse, Topology};
use raster::Fragment;

/// One primitive of a mesh at one place of the world.
#[derive(Clone, Debug)]
pub struct Draw<'a> {
    /// The name of its first point, line or triangle; the others follow.
    pub first_id: u32,
    /// Indices, texture coordinates and vertex colours.
    pub primitive: &'a Primitive,
    /// What it is made of.
    pub material: &'a Material,
    /// The texture of its base colour.
    pub base_color_texture: Option<&'a MipChain<'a>>,
    /// The texture of the light it gives off.
    pub emissive_texture: Option<&'a MipChain<'a>>,
    /// The vertices' places in the world.
    pub places: Vec<[f32; 3]>,
    /// The vertices' unit normals in the world, if the file has any.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Whether the way to the world mirrors, so that triangles run the other way round.
    pub mirrored: bool,
}

/// All draws of a frame, in the order of their names.
#[derive(Clone, Debug, Default)]
pub struct DrawList<'a> {
    /// The draws; the first has the name 0.
    pub draws: Vec<Draw<'a>>,
}

impl<'a> DrawList<'a> {
    /// The draw that a name belongs to.
    pub(crate) fn of(&self, id: u32) -> &Draw<'a> {
        let after = self.draws.partition_point(|draw| draw.first_id <= id);
        &self.draws[after - 1]
    }
}

impl Draw<'_> {
    /// Whether light falls on it: unlit materials, lines and points show their colour as it is.
    pub(super) fn is_lit(&self) -> bool {
        !self.material.unlit && self.primitive.topology == Topology::Triangles
    }

    /// The vertices of a named point, line or triangle. Corners that it lacks repeat its last one; their weights are 0.
    fn corners(&self, id: u32) -> [usize; 3] {
        let count = self.primitive.topology.corners();
        let start = (id - self.first_id) as usize * count;
        [0, 1, 2].map(|k: usize| self.primitive.indices[start + k.min(count - 1)] as usize)
    }

    /// The place in the world.
    pub(super) fn place(&self, fragment: &Fragment<'_>) -> [f32; 3] {
        blend(&self.places, self.corners(fragment.id), fragment.weights)
    }

    /// The vertex colour, if there is one.
    pub(super) fn color(&self, fragment: &Fragment<'_>) -> Option<[f32; 4]> {
        let colors = self.primitive.colors.as_ref()?;
        Some(blend(colors, self.corners(fragment.id), fragment.weights))
    }

    /// The texture's coordinates, and their derivatives by the pixel's column and row.
    pub(super) fn uvs(&self, fragment: &Fragment<'_>, used: &TextureUse) -> [[f32; 2]; 3] {
        let Some(uvs) = self.primitive.uvs.get(used.uv_set) else { return [[0.0; 2]; 3] };
        let corners = self.corners(fragment.id);
        let weights = [fragment.weights, fragment.weights_dx(), fragment.weights_dy()];
        let [[u, v], right, below] = weights.map(|weights| blend(uvs, corners, weights));
        let [a, b] = used.uv_map;
        let turned = |[u, v]: [f32; 2]| [a[0] * u + a[1] * v, b[0] * u + b[1] * v];
        [[a[0] * u + a[1] * v + a[2], b[0] * u + b[1] * v + b[2]], turned(right), turned(below)]
    }

    /// The unit normal on the side of the viewer, `to_viewer` leading there.
    ///
    /// Smooth if the file has normals and `flat` does not ask for the face's own. The face's own normal decides which side
    /// is seen: a smooth one may lean away from the viewer near the outline of a body and is right to do so.
    pub(super) fn normal(
        &self,
        fragment: &Fragment<'_>,
        flat: bool,
        to_viewer: [f32; 3],
    ) -> [f32; 3] {
        let face = self.face_normal(fragment.id);
        let seen_from_behind = dot(face, to_viewer) < 0.0;
        let normal = match &self.normals {
            Some(normals) if !flat => blend(normals, self.corners(fragment.id), fragment.weights),
            _ => face,
        };
        let normal = unit(normal).or_else(|| unit(face)).unwrap_or([0.0, 0.0, 1.0]);
        if seen_from_behind { normal.map(|c| -c) } else { normal }
    }

    /// Perpendicular to the triangle, on its front side; its length is twice the triangle's area.
    pub(crate) fn face_normal(&self, id: u32) -> [f32; 3] {
        let [a, b, c] = self.corners(id).map(|vertex| self.places[vertex]);
        let (ab, ac) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
        let normal = cross(ab, ac);
        if self.mirrored { normal.map(|c| -c) } else { normal }
    }
}

fn blend<const N: usize>(values: &[[f32; N]], corners: [usize; 3], weights: [f32; 3]) -> [f32; N] {
    let [a, b, c] = corners.map(|corner| values[corner]);
    std::array::from_fn(|k| a[k] * weights[0] + b[k] * weights[1] + c[k] * weights[2])
}

pub(super) fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn length(v: [f32; 3]) -> f32 {
    dot(v, v).sqrt()
}

/// The vector at length 1; `None` if it is too short or too long to have a direction.
fn unit(v: [f32; 3]) -> Option<[f32; 3]> {
    let length = length(v);
    (length > 0.0 && length.is_finite()).then(|| v.map(|c| c / length))
}
