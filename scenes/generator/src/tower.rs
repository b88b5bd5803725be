//! A tall building, for cameras with lens shift that keep verticals vertical.

use crate::document::Document;
use crate::mesh::Mesh;
use crate::palette::{CREAM, INK, OCHRE, SAND, SKY, TEAL};
use glam::{DVec3, dvec3};
use serde_json::json;

const STORIES: u32 = 7;
const STORY_HEIGHT: f64 = 2.0;
const WIDTH: f64 = 6.0;

pub(crate) fn tower() -> Document {
    let mut document = Document::default();
    let plaster = document.add_material("plaster", OCHRE);
    let bands = document.add_material("bands", CREAM);
    let glass = document.add_material("glass", SKY);
    let paint = document.add_material("door paint", TEAL);
    let lead = document.add_material("lead", INK);
    let paving = document.add_material("paving", SAND);

    let top = STORY_HEIGHT * f64::from(STORIES);
    let walls = Mesh::block_on(DVec3::ZERO, dvec3(WIDTH, top, WIDTH)).without_uvs();
    let mut roof =
        Mesh::block_on(dvec3(0.0, top, 0.0), dvec3(WIDTH + 0.8, 0.35, WIDTH + 0.8)).without_uvs();
    roof.append(&Mesh::block_on(dvec3(-1.2, top + 0.35, -1.0), dvec3(1.6, 1.1, 1.6)).without_uvs());
    let door = Mesh::block_on(dvec3(0.0, 0.0, WIDTH / 2.0), dvec3(1.1, 1.6, 0.15)).without_uvs();
    let ground = Mesh::block_on(dvec3(0.0, -0.1, 6.0), dvec3(800.0, 0.1, 800.0)).without_uvs();
    let tower = document.add_mesh(
        "tower",
        &[
            (&walls, plaster),
            (&story_meshes(), bands),
            (&window_mesh(), glass),
            (&door, paint),
            (&roof, lead),
            (&ground, paving),
        ],
    );
    document.add_root("tower", Some(tower), json!({}));
    document
}

/// Builds the bands between the stories.
fn story_meshes() -> Mesh {
    let mut mesh = Mesh::default();
    for storey in 1..STORIES {
        let at = dvec3(0.0, STORY_HEIGHT * f64::from(storey) - 0.09, 0.0);
        mesh.append(&Mesh::block_on(at, dvec3(WIDTH + 0.16, 0.18, WIDTH + 0.16)).without_uvs());
    }
    mesh
}

/// Builds four windows per story on the two visible sides, except at the door.
fn window_mesh() -> Mesh {
    let mut mesh = Mesh::default();
    for storey in 0..STORIES {
        for column in 0..4 {
            let across = 1.4 * f64::from(column) - 2.1;
            let up = STORY_HEIGHT * f64::from(storey) + 0.55;
            let beside_door = storey == 0 && (1..=2).contains(&column);
            if !beside_door {
                mesh.append(
                    &Mesh::block_on(dvec3(across, up, WIDTH / 2.0), dvec3(0.7, 1.0, 0.1))
                        .without_uvs(),
                );
            }
            mesh.append(
                &Mesh::block_on(dvec3(WIDTH / 2.0, up, across), dvec3(0.1, 1.0, 0.7)).without_uvs(),
            );
        }
    }
    mesh
}
