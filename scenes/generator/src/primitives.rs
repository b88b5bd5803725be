//! One star for each of glTF's seven primitive modes, in numerical order, in two rows.

use crate::document::{Document, PrimitiveMode};
use crate::mesh::Mesh;
use crate::palette::{BRICK, CLAY, Color, OCHRE, PLUM, SAGE, SLATE, TEAL};
use glam::{DVec3, dvec3};
use serde_json::json;
use std::f64::consts::{PI, TAU};

/// The number of points of the star.
const RAY_COUNT: u32 = 7;

pub(crate) fn primitives() -> Document {
    let mut document = Document::default();
    let count = 2 * RAY_COUNT;
    let around: Vec<u32> = (0..count).collect();
    let spokes = around.iter().flat_map(|&rim| [rim, rim + count + 1]).collect();
    let modes: [(&str, PrimitiveMode, Color, Vec<u32>); 7] = [
        ("points", PrimitiveMode::Points, BRICK, around.clone()),
        ("lines", PrimitiveMode::Lines, CLAY, spokes),
        ("line loop", PrimitiveMode::LineLoop, PLUM, around.clone()),
        ("line strip", PrimitiveMode::LineStrip, SLATE, around.clone()),
        ("triangles", PrimitiveMode::Triangles, OCHRE, ray_indices()),
        ("triangle strip", PrimitiveMode::TriangleStrip, SAGE, ring_indices(count)),
        ("triangle fan", PrimitiveMode::TriangleFan, TEAL, fan_indices(count)),
    ];
    for (place, (name, mode, color, indices)) in modes.into_iter().enumerate() {
        let material = document.add_double_sided(name, color);
        let star = Mesh { indices, ..star_mesh(mode as u32 >= PrimitiveMode::Triangles as u32) };
        let mesh = document.add_mesh_of_modes(name, &[(&star, material, mode)]);
        let (x, y) = if place < 4 {
            (2.5 * place as f64 - 3.75, 1.25)
        } else {
            (2.5 * place as f64 - 12.5, -1.25)
        };
        document.add_root(name, Some(mesh), json!({ "translation": [x, y, 0.0] }));
    }
    document
}

/// Builds the vertices: outer and inner points of the outline in turn, then the center, then an
/// inner ring. Only triangles have normals.
fn star_mesh(faces: bool) -> Mesh {
    let at = |step: u32, radius: f64| {
        let (sine, cosine) =
            libm::sincos(PI / 2.0 + TAU * f64::from(step) / f64::from(2 * RAY_COUNT));
        dvec3(radius * cosine, radius * sine, 0.0)
    };
    let mut positions: Vec<DVec3> =
        (0..2 * RAY_COUNT).map(|step| at(step, if step % 2 == 0 { 1.0 } else { 0.6 })).collect();
    positions.push(DVec3::ZERO);
    positions.extend((0..2 * RAY_COUNT).map(|step| at(step, 0.4)));
    let normals = if faces { vec![DVec3::Z; positions.len()] } else { Vec::new() };
    Mesh { positions, normals, ..Mesh::default() }
}

/// Returns separate triangles: each point of the star with the two adjacent inner points.
fn ray_indices() -> Vec<u32> {
    let count = 2 * RAY_COUNT;
    (0..RAY_COUNT).flat_map(|ray| [(2 * ray + count - 1) % count, 2 * ray, 2 * ray + 1]).collect()
}

/// Returns a closed strip between the outline and the inner ring.
fn ring_indices(count: u32) -> Vec<u32> {
    (0..=count).flat_map(|step| [count + 1 + step % count, step % count]).collect()
}

/// Returns a closed fan about the center.
fn fan_indices(count: u32) -> Vec<u32> {
    std::iter::once(count).chain((0..=count).map(|step| step % count)).collect()
}
