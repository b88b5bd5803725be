//! The vertex stage: what the vertices of one primitive carry to the shading, in the world.

use super::stage::to_point;
use glam::{DMat3, DVec3};
use homog::{Affine, Model, World};
use model::{self, Instance, Material, Posed, Primitive, Topology};
use raster::Selection;
use shade::{NORMAL, PLACE, Tangents, UV, Vertex};
use std::borrow::Cow;

/// The arrays that vertices are made of. What does not count is left out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts<'a> {
    pub(super) positions: Option<&'a [[f32; 3]]>,
    pub(super) normals: Option<&'a [[f32; 3]]>,
    pub(super) uvs: Option<&'a [[f32; 2]]>,
}

/// What a thread takes at once of many vertices: small models are done by one.
const SHARE: usize = 8192;

impl Parts<'_> {
    /// Writes those of so many vertices that are selected, by up to so many threads; none if nothing counts.
    pub(super) fn vertices(
        &self,
        count: usize,
        selections: [&Selection; 2],
        model_to_world: Affine<Model, World>,
        threads: usize,
        vertices: &mut Vec<Vertex>,
    ) {
        let Self { positions, normals, uvs } = *self;
        if positions.is_none() && normals.is_none() && uvs.is_none() {
            return vertices.clear();
        }
        vertices.resize(count, [0.0; 8]);
        raster::share(threads, vertices.chunks_mut(SHARE).enumerate(), |(number, vertices)| {
            let start = number * SHARE;
            for selection in selections {
                for run in selection.vertices_within(start..start + vertices.len()) {
                    self.from(start + run.start).write(model_to_world, &mut vertices[run]);
                }
            }
        });
    }

    /// The same without the first so many.
    fn from(&self, first: usize) -> Self {
        Self {
            positions: self.positions.and_then(|all| all.get(first..)),
            normals: self.normals.and_then(|all| all.get(first..)),
            uvs: self.uvs.and_then(|all| all.get(first..)),
        }
    }

    /// Writes the first vertices.
    fn write(&self, model_to_world: Affine<Model, World>, vertices: &mut [Vertex]) {
        let Self { positions, normals, uvs } = *self;
        for (vertex, &position) in vertices.iter_mut().zip(positions.unwrap_or_default()) {
            let place = model_to_world.point(to_point(position)).raw().as_vec3();
            vertex[PLACE..PLACE + 3].copy_from_slice(&place.to_array());
        }
        let turn = normal_map(model_to_world);
        for (vertex, &normal) in vertices.iter_mut().zip(normals.unwrap_or_default()) {
            vertex[NORMAL..NORMAL + 3].copy_from_slice(&turned(turn, normal));
        }
        for (vertex, uv) in vertices.iter_mut().zip(uvs.unwrap_or_default()) {
            vertex[UV..UV + 2].copy_from_slice(uv);
        }
    }
}

/// The set of texture coordinates that a material's textures are read by, or the first of them.
pub(super) fn uv_set(material: &Material, primitive: &Primitive) -> Option<usize> {
    let (_, used) = material.textures().next()?;
    (used.uv_set < primitive.uvs.len()).then_some(used.uv_set)
}

/// The tangents of a primitive's vertices or corners in the world, where its material asks for them: those of the file, or else
/// those that belong to the posed triangles (glTF 2.0 §3.7.2.1).
pub(super) fn tangents(
    model: &model::Model,
    instance: Instance,
    primitive: &Primitive,
    material: &Material,
    posed: &Posed<'_>,
    model_to_world: Affine<Model, World>,
) -> Tangents {
    if !material.needs_tangents() || primitive.topology != Topology::Triangles {
        return Tangents::None;
    }
    let turned = |tangents: &[[f32; 4]]| turned_tangents(tangents, model_to_world);
    if let Some(given) = model.posed_tangents(instance, primitive) {
        return Tangents::OfVertices(turned(&given));
    }
    let coat = material.extensions.clearcoat.as_deref().and_then(|coat| coat.normal_texture);
    let uv_set = material.normal_texture.or(coat).map_or(0, |normal| normal.texture.uv_set);
    let derived = match (&posed.positions, &posed.normals) {
        (Cow::Borrowed(_), None | Some(Cow::Borrowed(_))) => {
            primitive.derived_tangents(uv_set).map(|derived| turned(&derived))
        }
        (positions, normals) => Primitive {
            indices: primitive.indices.clone(),
            positions: positions.to_vec(),
            normals: normals.as_ref().map(|normals| normals.to_vec()),
            uvs: primitive.uvs.clone(),
            ..Primitive::default()
        }
        .derived_tangents(uv_set)
        .map(|derived| turned(&derived)),
    };
    derived.map_or(Tangents::None, Tangents::OfCorners)
}

/// Tangents in the world. In a mirror the bitangent, which is the product of normal and tangent, is on the other side.
fn turned_tangents(tangents: &[[f32; 4]], model_to_world: Affine<Model, World>) -> Vec<[f32; 4]> {
    let map = model_to_world.raw();
    let side = if model_to_world.determinant() < 0.0 { -1.0 } else { 1.0 };
    let turned = |&[x, y, z, w]: &[f32; 4]| {
        let along = map.transform_vector3(DVec3::new(f64::from(x), f64::from(y), f64::from(z)));
        let length = along.length();
        let unit = if length > 0.0 && length.is_finite() { along / length } else { DVec3::ZERO };
        let [x, y, z] = unit.as_vec3().to_array();
        [x, y, z, w * side]
    };
    tangents.iter().map(turned).collect()
}

/// The map of normals that belongs to a map of points, times a positive number: the inverse transposed, by cofactors.
pub(super) fn normal_map(map: Affine<Model, World>) -> DMat3 {
    let raw = map.raw();
    let [x, y, z] = [raw.x_axis, raw.y_axis, raw.z_axis].map(glam::DVec4::truncate);
    let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    let sign = if x.dot(cofactors.x_axis) < 0.0 { -1.0 } else { 1.0 };
    let columns = [cofactors.x_axis, cofactors.y_axis, cofactors.z_axis];
    let largest = columns.iter().fold(0.0_f64, |most, column| most.max(column.abs().max_element()));
    if largest > 0.0 && largest.is_finite() { cofactors * (sign / largest) } else { DMat3::ZERO }
}

/// The unit normal in the world; zero if it has no direction.
pub(super) fn turned(map: DMat3, normal: [f32; 3]) -> [f32; 3] {
    let turned = map * DVec3::from_array(normal.map(f64::from));
    let length = turned.length();
    let unit = if length > 0.0 && length.is_finite() { turned / length } else { DVec3::ZERO };
    unit.as_vec3().to_array()
}

#[cfg(test)]
mod tests {
    use super::*;
    use homog::Normal;

    #[test]
    fn normals_go_as_those_of_homog_also_in_mirrors_and_at_any_size() {
        let turn = Affine::<Model, Model>::rotation_x(0.7);
        for size in [[1.0, 2.0, 3.0], [-1e-40, 1e-40, 2e-40], [1e30, -2e30, 5e30]] {
            let map = turn.then(Affine::<Model, World>::scale(size[0], size[1], size[2]));
            for normal in [[0.0, 0.6, 0.8], [-0.48, 0.6, -0.64]] {
                let raw = DVec3::from_array(normal.map(f64::from));
                let right = map.normal(Normal::from_raw(raw)).normalized().unwrap().raw().as_vec3();
                let found = glam::Vec3::from_array(turned(normal_map(map), normal));
                assert!((right - found).abs().max_element() < 1e-6, "{right} {found}");
            }
        }
        let flat = Affine::<Model, World>::scale(0.0, 0.0, 0.0);
        assert_eq!(turned(normal_map(flat), [0.0, 0.0, 1.0]), [0.0; 3]);
    }
}
