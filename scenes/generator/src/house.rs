//! A small house, as a solid and as its edges (glTF LINES), both from one list of points.

use crate::document::{Document, PrimitiveMode};
use crate::mesh::Mesh;
use crate::palette::{BRICK, CREAM, INK, PAPER, SKY, SLATE, TEAL};
use glam::{DVec3, dvec3};
use serde_json::json;

/// Half the width of the walls, along x.
const HALF_WIDTH: f64 = 2.0;
/// Half the depth of the walls, along z, the direction of the ridge.
const HALF_DEPTH: f64 = 2.8;
const EAVES: f64 = 2.4;
const RIDGE: f64 = 4.2;
const ROOF_THICKNESS: f64 = 0.18;
const OVERHANG: f64 = 0.35;

/// Builds the solid house: walls, roof, chimney, door and windows.
pub(crate) fn solid_house() -> Document {
    let mut document = Document::default();
    let plaster = document.add_material("plaster", CREAM);
    let tiles = document.add_material("roof tiles", BRICK);
    let brick = document.add_material("chimney brick", SLATE);
    let paint = document.add_material("door paint", TEAL);
    let pane = document.add_material("window panes", SKY);
    let frame = document.add_material("window frames", PAPER);

    let mut door = Mesh::block_on(dvec3(0.7, 0.0, HALF_DEPTH), dvec3(0.9, 1.9, 0.12)).without_uvs();
    door.append(
        &Mesh::block_on(dvec3(0.7, 0.0, HALF_DEPTH + 0.3), dvec3(1.3, 0.12, 0.6)).without_uvs(),
    );
    let (panes, frames) = window_meshes();
    let house = document.add_mesh(
        "house",
        &[
            (&wall_mesh(), plaster),
            (&roof_mesh(), tiles),
            (&chimney_mesh(), brick),
            (&door, paint),
            (&panes, pane),
            (&frames, frame),
        ],
    );
    document.add_root("house", Some(house), json!({}));
    document
}

/// Returns the outline of the gable wall, counterclockwise seen from the front.
fn gable_outline(z: f64) -> [DVec3; 5] {
    [
        dvec3(-HALF_WIDTH, 0.0, z),
        dvec3(HALF_WIDTH, 0.0, z),
        dvec3(HALF_WIDTH, EAVES, z),
        dvec3(0.0, RIDGE, z),
        dvec3(-HALF_WIDTH, EAVES, z),
    ]
}

fn wall_mesh() -> Mesh {
    let (front, mut back) = (gable_outline(HALF_DEPTH), gable_outline(-HALF_DEPTH));
    let mut mesh = Mesh::default();
    mesh.add_polygon(&front);
    mesh.add_polygon(&[front[1], back[1], back[2], front[2]]);
    mesh.add_polygon(&[back[0], front[0], front[4], back[4]]);
    back.reverse();
    mesh.add_polygon(&back);
    mesh
}

/// Builds the two slabs of the roof, which rest on the gables and overhang the walls.
fn roof_mesh() -> Mesh {
    let slope = dvec3(HALF_WIDTH, EAVES - RIDGE, 0.0);
    let reach = slope * (1.0 + OVERHANG / slope.length());
    let up = dvec3(0.0, ROOF_THICKNESS, 0.0);
    let mut mesh = Mesh::default();
    for side in [1.0, -1.0] {
        let ridge = dvec3(0.0, RIDGE, 0.0);
        let eave = ridge + dvec3(reach.x * side, reach.y, 0.0);
        // The cross-section of one slab, counterclockwise seen from the front, for both sides.
        let mut section = [ridge, eave, eave + up, ridge + up];
        if side < 0.0 {
            section.reverse();
        }
        add_prism(&mut mesh, &section, HALF_DEPTH + OVERHANG);
    }
    mesh
}

/// Adds a bar along z with the given cross-section, from −half to +half.
fn add_prism(mesh: &mut Mesh, section: &[DVec3; 4], half: f64) {
    let at = |point: DVec3, z: f64| point + dvec3(0.0, 0.0, z);
    mesh.add_polygon(&section.map(|point| at(point, half)));
    let mut back = section.map(|point| at(point, -half));
    back.reverse();
    mesh.add_polygon(&back);
    for side in 0..4 {
        let (a, b) = (section[side], section[(side + 1) % 4]);
        mesh.add_polygon(&[at(b, half), at(a, half), at(a, -half), at(b, -half)]);
    }
}

fn chimney_mesh() -> Mesh {
    Mesh::block_on(dvec3(-1.0, 3.0, -1.3), dvec3(0.55, 1.75, 0.55)).without_uvs()
}

/// Builds the window panes and their frames.
fn window_meshes() -> (Mesh, Mesh) {
    let (mut panes, mut frames) = (Mesh::default(), Mesh::default());
    let thin = 0.06;
    let mut window = |at: DVec3, along_z: bool| {
        let size = |wide: f64, high: f64, deep: f64| {
            if along_z { dvec3(deep, high, wide) } else { dvec3(wide, high, deep) }
        };
        frames.append(&Mesh::block_on(at, size(1.0, 1.0, thin)).without_uvs());
        let raised = at + dvec3(0.0, 0.1, 0.0);
        panes.append(&Mesh::block_on(raised, size(0.8, 0.8, thin + 0.05)).without_uvs());
    };
    window(dvec3(-0.8, 0.9, HALF_DEPTH), false);
    window(dvec3(0.0, 2.5, HALF_DEPTH), false);
    for z in [-1.4, 0.0, 1.4] {
        window(dvec3(HALF_WIDTH, 0.9, z), true);
        window(dvec3(-HALF_WIDTH, 0.9, z), true);
    }
    (panes, frames)
}

/// Builds the edges of the house as segments, without faces to hide them.
pub(crate) fn house_edges() -> Document {
    let mut drawing = Mesh::default();
    for z in [HALF_DEPTH, -HALF_DEPTH] {
        add_closed_line(&mut drawing, &gable_outline(z));
    }
    for corner in gable_outline(HALF_DEPTH) {
        add_segment(&mut drawing, corner, dvec3(corner.x, corner.y, -HALF_DEPTH));
    }
    let z = HALF_DEPTH;
    add_closed_line(
        &mut drawing,
        &rectangle_points(dvec3(0.25, 0.0, z), DVec3::X * 0.9, DVec3::Y * 1.9),
    );
    add_closed_line(&mut drawing, &rectangle_points(dvec3(-1.3, 0.9, z), DVec3::X, DVec3::Y));
    add_closed_line(&mut drawing, &rectangle_points(dvec3(-0.5, 2.5, z), DVec3::X, DVec3::Y));
    for z in [-1.9, -0.5, 0.9] {
        for x in [HALF_WIDTH, -HALF_WIDTH] {
            add_closed_line(&mut drawing, &rectangle_points(dvec3(x, 0.9, z), DVec3::Z, DVec3::Y));
        }
    }
    chimney_edges(&mut drawing);

    let mut document = Document::default();
    let ink = document.add_material("ink", INK);
    let mesh =
        document.add_mesh_of_modes("house in edges", &[(&drawing, ink, PrimitiveMode::Lines)]);
    document.add_root("house in edges", Some(mesh), json!({}));
    document
}

/// Adds the chimney's edges; the vertical edges end at the slope of the roof.
fn chimney_edges(drawing: &mut Mesh) {
    let (top, half) = (4.75, 0.275);
    let roof_at = |x: f64| RIDGE + (EAVES - RIDGE) * x.abs() / HALF_WIDTH;
    let corners = [
        (-1.0 - half, -1.3 - half),
        (-1.0 + half, -1.3 - half),
        (-1.0 + half, -1.3 + half),
        (-1.0 - half, -1.3 + half),
    ];
    add_closed_line(drawing, &corners.map(|(x, z)| dvec3(x, top, z)));
    add_closed_line(drawing, &corners.map(|(x, z)| dvec3(x, roof_at(x), z)));
    for (x, z) in corners {
        add_segment(drawing, dvec3(x, roof_at(x), z), dvec3(x, top, z));
    }
}

fn rectangle_points(corner: DVec3, side: DVec3, up: DVec3) -> [DVec3; 4] {
    [corner, corner + side, corner + side + up, corner + up]
}

/// Adds the segments of a closed outline.
fn add_closed_line(drawing: &mut Mesh, corners: &[DVec3]) {
    for (i, corner) in corners.iter().enumerate() {
        add_segment(drawing, *corner, corners[(i + 1) % corners.len()]);
    }
}

fn add_segment(drawing: &mut Mesh, from: DVec3, to: DVec3) {
    let first = drawing.positions.len() as u32;
    drawing.positions.extend([from, to]);
    drawing.indices.extend([first, first + 1]);
}
