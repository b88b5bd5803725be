//! An open room with three cameras in the file: a view from the door, a plan and an elevation.

use crate::document::{Document, rotation_quaternion};
use crate::mesh::Mesh;
use crate::palette::{BARK, BRICK, CREAM, OCHRE, PAPER, PLUM, SAGE, SKY, TEAL, WOOD};
use glam::{DVec3, dvec3};
use serde_json::json;

/// Builds the room. The floor spans −2.5 to 2.5 in x and −2 to 2 in z; there are walls only at −x
/// and −z.
pub(crate) fn room() -> Document {
    let mut document = Document::default();
    let mut piece = |name: &str, color, boxes: &[(DVec3, DVec3)]| {
        let material = document.add_material(name, color);
        let mut mesh = Mesh::default();
        for (at, size) in boxes {
            mesh.append(&Mesh::block_on(*at, *size).without_uvs());
        }
        let mesh = document.add_mesh(name, &[(&mesh, material)]);
        document.add_root(name, Some(mesh), json!({}));
    };
    piece("floor boards", WOOD, &[(dvec3(0.0, -0.1, 0.0), dvec3(5.0, 0.1, 4.0))]);
    piece(
        "walls",
        CREAM,
        &[
            (dvec3(0.0, -0.1, -2.06), dvec3(5.24, 2.7, 0.12)),
            (dvec3(-2.56, -0.1, 0.0), dvec3(0.12, 2.7, 4.0)),
        ],
    );
    piece("rug", SAGE, &[(dvec3(0.2, 0.0, 0.3), dvec3(2.6, 0.02, 1.9))]);
    piece("window", SKY, &[(dvec3(0.9, 1.0, -1.99), dvec3(1.3, 1.1, 0.04))]);
    piece("window frame", PAPER, &window_frame_boxes());
    piece(
        "bed frame",
        BARK,
        &[
            (dvec3(-1.9, 0.0, 0.6), dvec3(1.1, 0.35, 2.2)),
            (dvec3(-1.9, 0.0, 1.74), dvec3(1.1, 0.75, 0.08)),
        ],
    );
    piece("blanket", BRICK, &[(dvec3(-1.9, 0.35, 0.35), dvec3(1.12, 0.2, 1.6))]);
    piece("pillow", PAPER, &[(dvec3(-1.9, 0.35, 1.4), dvec3(0.8, 0.16, 0.45))]);
    piece("table", BARK, &table_boxes(dvec3(0.9, 0.0, -1.3)));
    piece("book", PLUM, &[(dvec3(0.6, 0.76, -1.3), dvec3(0.35, 0.06, 0.25))]);
    piece("box", OCHRE, &[(dvec3(1.25, 0.76, -1.4), dvec3(0.3, 0.22, 0.3))]);
    piece(
        "stool",
        TEAL,
        &[
            (dvec3(0.9, 0.42, -0.45), dvec3(0.45, 0.07, 0.45)),
            (dvec3(0.9, 0.0, -0.45), dvec3(0.1, 0.42, 0.1)),
            (dvec3(0.9, 0.0, -0.45), dvec3(0.36, 0.05, 0.36)),
        ],
    );
    piece(
        "shelf",
        BARK,
        &[
            (dvec3(-1.3, 1.3, -1.85), dvec3(1.5, 0.06, 0.3)),
            (dvec3(-1.3, 1.75, -1.85), dvec3(1.5, 0.06, 0.3)),
        ],
    );
    piece("books", TEAL, &book_boxes());
    add_cameras(&mut document);
    document
}

fn window_frame_boxes() -> Vec<(DVec3, DVec3)> {
    let (z, deep) = (-1.97, 0.06);
    vec![
        (dvec3(0.9, 0.94, z), dvec3(1.46, 0.08, deep)),
        (dvec3(0.9, 2.08, z), dvec3(1.46, 0.08, deep)),
        (dvec3(0.21, 0.94, z), dvec3(0.08, 1.22, deep)),
        (dvec3(1.59, 0.94, z), dvec3(0.08, 1.22, deep)),
        (dvec3(0.9, 1.0, z), dvec3(0.06, 1.1, deep)),
    ]
}

fn table_boxes(at: DVec3) -> Vec<(DVec3, DVec3)> {
    let mut boxes = vec![(at + dvec3(0.0, 0.7, 0.0), dvec3(1.5, 0.06, 0.8))];
    for (x, z) in [(-0.68, -0.33), (0.68, -0.33), (-0.68, 0.33), (0.68, 0.33)] {
        boxes.push((at + dvec3(x, 0.0, z), dvec3(0.08, 0.7, 0.08)));
    }
    boxes
}

fn book_boxes() -> Vec<(DVec3, DVec3)> {
    let heights = [0.28, 0.33, 0.25, 0.3, 0.27, 0.34, 0.26];
    let book = |(i, height): (usize, &f64)| {
        (dvec3(-1.9 + 0.11 * i as f64, 1.36, -1.85), dvec3(0.08, *height, 0.2))
    };
    heights.iter().enumerate().map(book).collect()
}

/// Adds the cameras. glTF cameras look along their −z axis with y up; the camera at the door is
/// turned about y and then tilted down.
fn add_cameras(document: &mut Document) {
    let lens = json!({ "type": "perspective",
        "perspective": { "yfov": 50.0_f64.to_radians(), "znear": 0.1, "zfar": 50.0 } });
    let [_, turn_y, _, turn_w] = rotation_quaternion(DVec3::Y, 43.5);
    let [tip_x, _, _, tip_w] = rotation_quaternion(DVec3::X, -26.0);
    let both = [turn_w * tip_x, turn_y * tip_w, -turn_y * tip_x, turn_w * tip_w];
    document.add_camera("from the door", lens, [4.8, 4.1, 5.0], both);

    let flat = |half_height: f64| {
        json!({ "type": "orthographic",
            "orthographic": {
                "xmag": half_height * 1.6, "ymag": half_height, "znear": 0.1, "zfar": 20.0,
            } })
    };
    document.add_camera("plan", flat(2.4), [0.0, 10.0, 0.0], rotation_quaternion(DVec3::X, -90.0));
    document.add_camera(
        "elevation",
        flat(1.7),
        [0.0, 1.3, 10.0],
        rotation_quaternion(DVec3::X, 0.0),
    );
}
