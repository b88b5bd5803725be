//! Models built from parts: a single part, or all parts moved apart, with their paths.

use super::explosion::ExplosionSettings;
use super::part::{Part, drawn_primitives, gather_parts};
use super::part_shapes::PartShapes;
use glam::{DMat3, DMat4, DVec3};
use homog::{Affine, Model as ModelSpace, Vector, World};
use model::{Material, Mesh, Model, ModelInstance, Node, Primitive, Topology};
use std::sync::Arc;

/// The name of the object with the paths of an exploded view.
pub(crate) const PATHS: &str = "paths";

/// Builds a model of a single part in its own coordinates, with its axes turned to the nearest
/// world axes.
///
/// A part that is tilted in the assembly is therefore drawn parallel to the world axes.
pub(crate) fn part_model(part: &Part, models: &[ModelInstance]) -> ModelInstance {
    let to_world = part.instance.node_to_model.then(models[part.model].model_to_world).raw();
    let (axes, scale) = orthonormal_axes(DMat3::from_mat4(to_world));
    let turned = nearest_axes(axes) * scale;
    let own = models[part.model].model.nodes[part.instance.node].skin;
    // Skinned positions are in the axes of the model, not in the axes of the node.
    let linear = if own.is_some() { DMat3::IDENTITY } else { turned };
    let to_world = Affine::from_raw(DMat4::from_mat3(linear));
    let mesh = part_mesh(part, models);
    let model = model_of_meshes(vec![mesh], &part.name, &models[part.model].model);
    let model_to_world = to_world.unwrap_or(Affine::IDENTITY);
    ModelInstance { model: Arc::new(model), model_to_world }
}

/// Moves the parts of models apart for an exploded view. The result has one object for each part,
/// then one for the straight paths of the moved parts.
///
/// The largest part stays. Every other part leaves on a side where nothing blocks it or, failing
/// that, where it is blocked least. In the result, no two parts intersect.
#[must_use]
pub fn explode_models(
    models: &[ModelInstance],
    settings: &ExplosionSettings,
) -> Vec<ModelInstance> {
    let parts = gather_parts(models);
    exploded_models(models, &parts, &settings.moves(&PartShapes::new(&parts, models)))
}

/// Moves every part and appends an object whose lines are the straight paths of the moved parts.
pub(crate) fn exploded_models(
    models: &[ModelInstance],
    parts: &[Part],
    moves: &[DVec3],
) -> Vec<ModelInstance> {
    let mut exploded = Vec::new();
    let numbered: Vec<(&Part, &DVec3)> = parts.iter().zip(moves).collect();
    for of_model in numbered.chunk_by(|(a, _), (b, _)| a.model == b.model) {
        let placed = &models[of_model[0].0.model];
        let mut model = Model {
            name: placed.model.name.clone(),
            length_unit: placed.model.length_unit,
            meshes: placed.model.meshes.clone(),
            materials: plain_materials(&placed.model),
            ..Model::default()
        };
        for (part, by) in of_model {
            let source = &placed.model.nodes[part.instance.node];
            // A skinned or morphed mesh is stored as drawn, since the new model has no skins or
            // animations.
            let deforms = source.skin.is_some()
                || drawn_primitives(&placed.model, part.instance)
                    .any(|primitive| !primitive.morph_targets.is_empty());
            let (mesh, to_model) = if deforms {
                model.meshes.push(part_mesh(part, models));
                let node = part.instance.node_to_model;
                // Skinned positions are relative to the model, not to the node.
                let to_model = if source.skin.is_some() { Affine::IDENTITY } else { node };
                (Some(model.meshes.len() - 1), to_model)
            } else {
                (source.mesh, part.instance.node_to_model)
            };
            let to_world = to_model.then(placed.model_to_world);
            let moved = to_world.then(Affine::<World, World>::translation(Vector::from_raw(**by)));
            push_node(&mut model, &part.name, mesh, moved.raw());
        }
        let model_to_world = Affine::IDENTITY;
        exploded.push(ModelInstance { model: Arc::new(model), model_to_world });
    }
    exploded.extend(path_model(parts, moves));
    exploded
}

/// Returns the paths of the moved parts' centers, as lines, or `None` if nothing moved.
fn path_model(parts: &[Part], moves: &[DVec3]) -> Option<ModelInstance> {
    // Positions are `f32`, so they are stored relative to a point in the scene to stay precise.
    let about = parts.first()?.bounds.center().raw();
    let moved = parts.iter().zip(moves).filter(|(_, by)| by.length() > 0.0);
    let ends = moved.flat_map(|(part, by)| {
        let center = part.bounds.center().raw() - about;
        [center, center + *by].map(|point| point.to_array().map(|c| c as f32))
    });
    let positions: Vec<[f32; 3]> = ends.collect();
    let indices = (0..positions.len() as u32).collect();
    let primitive =
        Primitive { topology: Topology::Lines, indices, positions, ..Primitive::default() };
    if primitive.positions.is_empty() {
        return None;
    }
    let mesh = Mesh { primitives: vec![primitive], ..Mesh::default() };
    let model = Arc::new(model_of_meshes(vec![mesh], PATHS, &Model::default()));
    Some(ModelInstance { model, model_to_world: Affine::translation(Vector::from_raw(about)) })
}

/// Returns a mesh of the lines and triangles of a part, skinned and morphed. Skinned parts are in
/// model space.
fn part_mesh(part: &Part, models: &[ModelInstance]) -> Mesh {
    let model = &models[part.model].model;
    let has_skin = model.nodes[part.instance.node].skin.is_some();
    let primitive = |primitive: &Primitive| {
        let skinned = model.skin_primitive(part.instance, primitive);
        let to_model = |position: &[f32; 3]| {
            let point = skinned.to_model.transform_point(position.map(f64::from).into());
            point.raw().to_array().map(|c| c as f32)
        };
        Primitive {
            topology: primitive.topology,
            indices: primitive.indices.clone(),
            positions: match has_skin {
                true => skinned.positions.iter().map(to_model).collect(),
                false => skinned.positions.to_vec(),
            },
            normals: skinned.normals.map(|normals| normals.to_vec()),
            material: primitive.material,
            edges: primitive.edges.clone(),
            ..Primitive::default()
        }
    };
    let primitives = drawn_primitives(model, part.instance).map(primitive).collect();
    Mesh { primitives, ..Mesh::default() }
}

/// Returns a model with one node per mesh and the materials of another model.
fn model_of_meshes(meshes: Vec<Mesh>, name: &str, source: &Model) -> Model {
    let count = meshes.len();
    let mut model = Model {
        name: name.to_owned(),
        length_unit: source.length_unit,
        meshes,
        materials: plain_materials(source),
        ..Model::default()
    };
    (0..count).for_each(|mesh| push_node(&mut model, name, Some(mesh), DMat4::IDENTITY));
    model
}

/// Appends a root node.
fn push_node(model: &mut Model, name: &str, mesh: Option<usize>, to_model: DMat4) {
    // The fallback is not needed: parts whose vertices are not finite have been skipped.
    let to_model = Affine::<ModelSpace, ModelSpace>::from_raw(to_model).unwrap_or(Affine::IDENTITY);
    model.roots.push(model.nodes.len());
    let (name, to_parent) = (Some(name.to_owned()), to_model);
    model.nodes.push(Node { name, mesh, to_parent, to_model, trs: None, ..Node::default() });
}

/// Returns the material properties that drawings show: names and colors.
fn plain_materials(source: &Model) -> Vec<Material> {
    let plain = |material: &Material| Material {
        name: material.name.clone(),
        base_color: material.base_color,
        ..Material::default()
    };
    source.materials.iter().map(plain).collect()
}

/// Returns orthonormal axes along the columns of a matrix (Gram–Schmidt), and the matrix in these
/// axes.
///
/// Zero columns get a direction perpendicular to the others.
fn orthonormal_axes(linear: DMat3) -> (DMat3, DMat3) {
    let x = linear.x_axis.normalize_or(DVec3::X);
    let across = linear.y_axis - x * x.dot(linear.y_axis);
    let y = across.normalize_or(x.any_orthonormal_vector());
    let z = x.cross(y) * linear.z_axis.dot(x.cross(y)).signum();
    let axes = DMat3::from_cols(x, y, z);
    (axes, axes.transpose() * linear)
}

/// Returns the nearest signed world axis for each axis, assigning the closest pair first.
fn nearest_axes(axes: DMat3) -> DMat3 {
    let mut pairs: Vec<(f64, usize, usize)> = (0..3)
        .flat_map(|column| (0..3).map(move |row| (axes.col(column)[row], column, row)))
        .collect();
    pairs.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
    let (mut nearest, mut columns, mut rows) = (DMat3::ZERO, [false; 3], [false; 3]);
    for (cosine, column, row) in pairs {
        if !columns[column] && !rows[row] {
            (columns[column], rows[row]) = (true, true);
            *nearest.col_mut(column) = DVec3::AXES[row] * cosine.signum();
        }
    }
    nearest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tilted_axes_turn_to_the_world_axes() {
        for (angle, about_y) in [(0.0, 0.0), (0.3, 0.2), (1.3, 0.0), (-0.6, 3.0)] {
            let turn = DMat3::from_mat4(
                (Affine::<World, World>::rotation_z(angle)
                    .then(Affine::<World, World>::rotation_y(about_y)))
                .raw(),
            );
            for mirror in [1.0, -1.0] {
                let linear = turn * DMat3::from_diagonal(DVec3::new(2.0, 3.0, 4.0 * mirror));
                let (axes, scale) = orthonormal_axes(linear);
                let back = axes * scale;
                assert!((back - linear).to_cols_array().iter().all(|c| c.abs() < 1e-12));
                let nearest = nearest_axes(axes);
                assert_eq!(nearest.determinant(), mirror);
                // The sides of the part keep their lengths.
                let lengths = [0, 1, 2].map(|axis| (nearest * scale).col(axis).length());
                let difference = [0, 1, 2].map(|axis| lengths[axis] - (axis + 2) as f64);
                assert!(difference.iter().all(|d| d.abs() < 1e-12), "{lengths:?}");
            }
        }
    }
}
