//! The vertex stage: what the vertices of one primitive carry to the shading, in the world.

use super::screen_transform::model_point;
use glam::{DMat3, DVec3};
use homog::{Affine, Model, World};
use model::{self, Material, MeshInstance, Primitive, SkinnedPrimitive, Topology};
use raster::MeshSelection;
use shade::{NORMAL, POSITION, Tangents, UV, Vertex};
use std::borrow::Cow;

/// The arrays that vertices are made of. What does not count is left out.
#[derive(Clone, Copy, Debug)]
pub(super) struct VertexArrays<'a> {
    pub(super) positions: Option<&'a [[f32; 3]]>,
    pub(super) normals: Option<&'a [[f32; 3]]>,
    pub(super) uvs: Option<&'a [[f32; 2]]>,
}

/// What a thread takes at once of many vertices: small models are done by one.
const VERTICES_PER_TASK: usize = 8192;

impl VertexArrays<'_> {
    /// Writes those of so many vertices that are selected, by up to so many threads; none if nothing counts.
    pub(super) fn write_vertices(
        &self,
        count: usize,
        selections: [&MeshSelection; 2],
        model_to_world: Affine<Model, World>,
        threads: usize,
        vertices: &mut Vec<Vertex>,
    ) {
        let Self { positions, normals, uvs } = *self;
        if positions.is_none() && normals.is_none() && uvs.is_none() {
            return vertices.clear();
        }
        vertices.resize(count, [0.0; 8]);
        raster::for_each_parallel(
            threads,
            vertices.chunks_mut(VERTICES_PER_TASK).enumerate(),
            |(number, vertices)| {
                let start = number * VERTICES_PER_TASK;
                for selection in selections {
                    for run in selection.vertices_within(start..start + vertices.len()) {
                        self.starting_at(start + run.start)
                            .transform_vertices(model_to_world, &mut vertices[run]);
                    }
                }
            },
        );
    }

    /// The same without the first so many.
    fn starting_at(&self, first: usize) -> Self {
        Self {
            positions: self.positions.and_then(|all| all.get(first..)),
            normals: self.normals.and_then(|all| all.get(first..)),
            uvs: self.uvs.and_then(|all| all.get(first..)),
        }
    }

    /// Writes the first vertices.
    fn transform_vertices(&self, model_to_world: Affine<Model, World>, vertices: &mut [Vertex]) {
        let Self { positions, normals, uvs } = *self;
        for (vertex, &position) in vertices.iter_mut().zip(positions.unwrap_or_default()) {
            let position_in_world =
                model_to_world.transform_point(model_point(position)).raw().as_vec3();
            vertex[POSITION..POSITION + 3].copy_from_slice(&position_in_world.to_array());
        }
        let normal_to_world = normal_matrix(model_to_world);
        for (vertex, &normal) in vertices.iter_mut().zip(normals.unwrap_or_default()) {
            vertex[NORMAL..NORMAL + 3].copy_from_slice(&transform_normal(normal_to_world, normal));
        }
        for (vertex, uv) in vertices.iter_mut().zip(uvs.unwrap_or_default()) {
            vertex[UV..UV + 2].copy_from_slice(uv);
        }
    }
}

/// The set of texture coordinates that a material's textures are read by, or the first of them.
pub(super) fn material_uv_set(material: &Material, primitive: &Primitive) -> Option<usize> {
    let (_, used) = material.visible_textures().next()?;
    (used.uv_set < primitive.uvs.len()).then_some(used.uv_set)
}

/// The tangents of a primitive's vertices or corners in the world, where its material asks for them: those of the file, or else
/// those that belong to the posed triangles (glTF 2.0 §3.7.2.1).
pub(super) fn world_tangents(
    model: &model::Model,
    instance: MeshInstance,
    primitive: &Primitive,
    material: &Material,
    posed: &SkinnedPrimitive<'_>,
    model_to_world: Affine<Model, World>,
) -> Tangents {
    if !material.needs_tangents() || primitive.topology != Topology::Triangles {
        return Tangents::None;
    }
    let turned = |tangents: &[[f32; 4]]| transform_tangents(tangents, model_to_world);
    if let Some(given) = model.skin_tangents(instance, primitive) {
        return Tangents::PerVertex(turned(&given));
    }
    let clearcoat = material.extensions.clearcoat.as_deref().and_then(|coat| coat.normal_texture);
    let uv_set = material.normal_texture.or(clearcoat).map_or(0, |normal| normal.texture.uv_set);
    let derived = match (&posed.positions, &posed.normals) {
        (Cow::Borrowed(_), None | Some(Cow::Borrowed(_))) => {
            primitive.mikktspace_tangents(uv_set).map(|derived| turned(&derived))
        }
        (positions, normals) => Primitive {
            indices: primitive.indices.clone(),
            positions: positions.to_vec(),
            normals: normals.as_ref().map(|normals| normals.to_vec()),
            uvs: primitive.uvs.clone(),
            ..Primitive::default()
        }
        .mikktspace_tangents(uv_set)
        .map(|derived| turned(&derived)),
    };
    derived.map_or(Tangents::None, Tangents::PerCorner)
}

/// Tangents in the world. In a mirror the bitangent, which is the product of normal and tangent, is on the other side.
fn transform_tangents(
    tangents: &[[f32; 4]],
    model_to_world: Affine<Model, World>,
) -> Vec<[f32; 4]> {
    let map = model_to_world.raw();
    let handedness = if model_to_world.determinant() < 0.0 { -1.0 } else { 1.0 };
    let turned = |&[x, y, z, w]: &[f32; 4]| {
        let direction = map.transform_vector3(DVec3::new(f64::from(x), f64::from(y), f64::from(z)));
        let length = direction.length();
        let unit =
            if length > 0.0 && length.is_finite() { direction / length } else { DVec3::ZERO };
        let [x, y, z] = unit.as_vec3().to_array();
        [x, y, z, w * handedness]
    };
    tangents.iter().map(turned).collect()
}

/// The map of normals that belongs to a map of points, times a positive number: the inverse transposed, by cofactors.
pub(super) fn normal_matrix(map: Affine<Model, World>) -> DMat3 {
    let raw = map.raw();
    let [x, y, z] = [raw.x_axis, raw.y_axis, raw.z_axis].map(glam::DVec4::truncate);
    let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    let sign = if x.dot(cofactors.x_axis) < 0.0 { -1.0 } else { 1.0 };
    let columns = [cofactors.x_axis, cofactors.y_axis, cofactors.z_axis];
    let largest = columns.iter().fold(0.0_f64, |most, column| most.max(column.abs().max_element()));
    if largest > 0.0 && largest.is_finite() { cofactors * (sign / largest) } else { DMat3::ZERO }
}

/// The unit normal in the world; zero if it has no direction.
pub(super) fn transform_normal(map: DMat3, normal: [f32; 3]) -> [f32; 3] {
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
                let expected = map
                    .transform_normal(Normal::from_raw(raw))
                    .normalized()
                    .unwrap()
                    .raw()
                    .as_vec3();
                let actual = glam::Vec3::from_array(transform_normal(normal_matrix(map), normal));
                assert!((expected - actual).abs().max_element() < 1e-6, "{expected} {actual}");
            }
        }
        let collapsed = Affine::<Model, World>::scale(0.0, 0.0, 0.0);
        assert_eq!(transform_normal(normal_matrix(collapsed), [0.0, 0.0, 1.0]), [0.0; 3]);
    }
}
