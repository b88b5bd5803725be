//! A tall house, for cameras that must keep its walls upright.

use super::document::Document;
use super::mesh::Mesh;
use super::palette::{CREAM, INK, OCHRE, SAND, SKY, TEAL};
use glam::{DVec3, dvec3};
use serde_json::json;

const STOREYS: u32 = 7;
const STOREY: f64 = 2.0;
const WIDTH: f64 = 6.0;

pub fn tower() -> Document {
    let mut document = Document::default();
    let plaster = document.material("plaster", OCHRE);
    let bands = document.material("bands", CREAM);
    let glass = document.material("glass", SKY);
    let paint = document.material("door paint", TEAL);
    let lead = document.material("lead", INK);
    let paving = document.material("paving", SAND);

    let top = STOREY * f64::from(STOREYS);
    let walls = Mesh::block(DVec3::ZERO, dvec3(WIDTH, top, WIDTH)).plain();
    let mut roof = Mesh::block(dvec3(0.0, top, 0.0), dvec3(WIDTH + 0.8, 0.35, WIDTH + 0.8)).plain();
    roof.append(&Mesh::block(dvec3(-1.2, top + 0.35, -1.0), dvec3(1.6, 1.1, 1.6)).plain());
    let door = Mesh::block(dvec3(0.0, 0.0, WIDTH / 2.0), dvec3(1.1, 1.6, 0.15)).plain();
    let ground = Mesh::block(dvec3(0.0, -0.1, 6.0), dvec3(800.0, 0.1, 800.0)).plain();
    let tower = document.mesh(
        "tower",
        &[
            (&walls, plaster),
            (&storeys(), bands),
            (&windows(), glass),
            (&door, paint),
            (&roof, lead),
            (&ground, paving),
        ],
    );
    document.root("tower", Some(tower), json!({}));
    document
}

/// The bands between the storeys.
fn storeys() -> Mesh {
    let mut mesh = Mesh::default();
    for storey in 1..STOREYS {
        let at = dvec3(0.0, STOREY * f64::from(storey) - 0.09, 0.0);
        mesh.append(&Mesh::block(at, dvec3(WIDTH + 0.16, 0.18, WIDTH + 0.16)).plain());
    }
    mesh
}

/// Four windows a storey on the two sides that are seen; none where the door is.
fn windows() -> Mesh {
    let mut mesh = Mesh::default();
    for storey in 0..STOREYS {
        for column in 0..4 {
            let across = 1.4 * f64::from(column) - 2.1;
            let up = STOREY * f64::from(storey) + 0.55;
            let beside_door = storey == 0 && (1..=2).contains(&column);
            if !beside_door {
                mesh.append(
                    &Mesh::block(dvec3(across, up, WIDTH / 2.0), dvec3(0.7, 1.0, 0.1)).plain(),
                );
            }
            mesh.append(&Mesh::block(dvec3(WIDTH / 2.0, up, across), dvec3(0.1, 1.0, 0.7)).plain());
        }
    }
    mesh
}
