//! Assemblies generated for tests, with known parts, copies and placements.

use super::boxes::{Random, box_model};
use glam::{DQuat, DVec3};
use homog::{Affine, Model as ModelSpace, Vector};
use model::{Material, Mesh, Model, ModelInstance, Node, Primitive};
use std::sync::Arc;

/// Returns the transform of a part: a rotation around an axis, then a translation.
pub fn placed(at: DVec3, turn: f64) -> Affine<ModelSpace, ModelSpace> {
    let turn = DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), turn);
    let turn = Affine::<ModelSpace, ModelSpace>::from_quaternion(turn.to_array());
    turn.expect("a turn").then(Affine::translation(Vector::from_raw(at)))
}

/// Returns a box primitive with these sides around the origin, with shared vertices.
pub fn box_primitive(size: DVec3) -> Primitive {
    let model = box_model(size);
    model.model.meshes[0].primitives[0].clone()
}

/// Returns a prism around the origin, along y, with `corners` corners on a circle.
pub fn prism_primitive(radius: f64, height: f64, corners: u32) -> Primitive {
    let mut positions = Vec::new();
    for y in [-0.5, 0.5] {
        for k in 0..corners {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(corners);
            let (x, z) = (libm::cos(angle) * radius, libm::sin(angle) * radius);
            positions.push([x as f32, (y * height) as f32, z as f32]);
        }
    }
    let mut indices = Vec::new();
    for k in 0..corners {
        let next = (k + 1) % corners;
        indices.extend([k, corners + k, next, next, corners + k, corners + next]);
        if (1..corners - 1).contains(&k) {
            indices.extend([0, k, k + 1, corners, corners + k + 1, corners + k]);
        }
    }
    Primitive { positions, indices, ..Primitive::default() }
}

/// Returns a model of nodes with these names, meshes and transforms.
pub fn assembly(
    primitives: Vec<(Primitive, &str)>,
    nodes: Vec<(String, usize, Affine<ModelSpace, ModelSpace>)>,
) -> ModelInstance {
    let mut model = Model { name: "assembly".to_owned(), ..Model::default() };
    for (index, (primitive, material)) in primitives.into_iter().enumerate() {
        let primitive = Primitive { material: Some(index), ..primitive };
        model.meshes.push(Mesh { primitives: vec![primitive], ..Mesh::default() });
        let name = (!material.is_empty()).then(|| material.to_owned());
        model.materials.push(Material { name, ..Material::default() });
    }
    for (name, mesh, to_parent) in nodes {
        model.roots.push(model.nodes.len());
        model.nodes.push(Node {
            name: Some(name),
            mesh: Some(mesh),
            to_parent,
            to_model: to_parent,
            ..Node::default()
        });
    }
    ModelInstance { model: Arc::new(model), model_to_world: Affine::IDENTITY }
}

/// Returns an assembly of `kinds` different parts, each `copies` times, in stacked layers: each
/// layer has a plate with pins through it.
pub fn stacked_assembly(kinds: usize, copies: usize) -> ModelInstance {
    let mut random = Random(kinds as u64 * 1000 + copies as u64);
    let mut primitives = Vec::new();
    let mut nodes = Vec::new();
    let side = 20.0 * libm::ceil(libm::sqrt(copies as f64));
    for kind in 0..kinds {
        let height = 4.0 * kind as f64;
        let turn = random.fraction();
        if kind % 5 == 0 {
            let size = DVec3::new(side + kind as f64, 4.0, side);
            primitives.push((box_primitive(size), "steel"));
        } else {
            let radius = 2.0 + 5.0 * random.fraction();
            primitives.push((prism_primitive(radius, 6.0, 12 + kind as u32 % 7), "brass"));
        }
        for copy in 0..copies {
            let name = format!("part {}.{:03}", letters(kind), copy + 1);
            let columns = libm::ceil(libm::sqrt(copies as f64)) as usize;
            let (column, row) = (copy % columns, copy / columns);
            let at = |n: usize| 20.0 * (n as f64 + 0.5) - side * 0.5;
            let place = DVec3::new(at(column), height, at(row));
            nodes.push((name, kind, placed(place, if kind % 3 == 0 { turn } else { 0.0 })));
        }
    }
    assembly(primitives, nodes)
}

/// Returns an assembly of `count` different parts side by side in a square.
pub fn scattered_parts(count: usize) -> ModelInstance {
    let columns = libm::ceil(libm::sqrt(count as f64)) as usize;
    let mut primitives = Vec::new();
    let mut nodes = Vec::new();
    for part in 0..count {
        let size = DVec3::new(5.0 + part as f64 * 1e-3, 4.0, 5.0);
        primitives.push((box_primitive(size), "steel"));
        let at = |n: usize| 10.0 * n as f64;
        let place = DVec3::new(at(part % columns), 0.0, at(part / columns));
        nodes.push((format!("part {}", letters(part)), part, placed(place, 0.0)));
    }
    assembly(primitives, nodes)
}

/// Converts a number to letters, so that kind names do not end in digits.
pub fn letters(number: usize) -> String {
    let letter = |digit: usize| char::from(b'a' + digit as u8);
    [number / 676 % 26, number / 26 % 26, number % 26].map(letter).iter().collect()
}
