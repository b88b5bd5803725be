//! A checkered floor with rows of posts that extends behind a camera at the origin.
//!
//! Every tile is a separate face. Tiles below the camera cross the plane w = 0, where a renderer
//! that divides before it clips shows wrap-around.

use crate::document::Document;
use crate::mesh::Mesh;
use crate::palette::{BRICK, CREAM, SAND, SLATE};
use glam::{DVec3, dvec3};
use serde_json::json;

/// Half the number of tiles across; a tile is one meter wide.
const HALF_WIDTH: i32 = 4;
/// The z-coordinate of the far end; [`TO_Z`] is the end behind the camera.
const FROM_Z: i32 = -72;
const TO_Z: i32 = 24;

pub(crate) fn floor() -> Document {
    let mut document = Document::default();
    let light = document.add_material("light tiles", CREAM);
    let dark = document.add_material("dark tiles", SLATE);
    let tiles = document.add_mesh("tiles", &[(&floor_tiles(0), light), (&floor_tiles(1), dark)]);
    document.add_root("floor", Some(tiles), json!({}));

    let stone = document.add_material("stone", SAND);
    let cap = document.add_material("cap", BRICK);
    let post = document.add_mesh(
        "post",
        &[(&floor_post(), stone), (&Mesh::sphere(0.22, 16).translated(dvec3(0.0, 2.36, 0.0)), cap)],
    );
    for step in 0..23 {
        let z = f64::from(TO_Z) - 1.5 - 4.0 * f64::from(step);
        for (side, x) in [("left", -3.5), ("right", 3.5)] {
            document.add_root(
                &format!("{side} post {step}"),
                Some(post),
                json!({ "translation": [x, 0.0, z] }),
            );
        }
    }
    document
}

/// Builds the tiles of one color, on a grid of shared vertices.
fn floor_tiles(odd: i32) -> Mesh {
    let mut mesh = Mesh::default();
    let across = 2 * HALF_WIDTH + 1;
    for z in FROM_Z..=TO_Z {
        for x in -HALF_WIDTH..=HALF_WIDTH {
            mesh.add_vertex(dvec3(f64::from(x), 0.0, f64::from(z)), DVec3::Y);
        }
    }
    for row in 0..TO_Z - FROM_Z {
        for column in (0..across - 1).filter(|column| (row + column) % 2 == odd) {
            // Seen from above, z runs down the page, so this order is counterclockwise.
            let corner = (row * across + column) as u32;
            let below = corner + across as u32;
            mesh.indices.extend([corner, below, below + 1, corner, below + 1, corner + 1]);
        }
    }
    mesh
}

fn floor_post() -> Mesh {
    let mut post = Mesh::block_on(DVec3::ZERO, dvec3(0.5, 0.2, 0.5)).without_uvs();
    post.append(&Mesh::block_on(dvec3(0.0, 0.2, 0.0), dvec3(0.32, 1.9, 0.32)).without_uvs());
    post.append(&Mesh::block_on(dvec3(0.0, 2.1, 0.0), dvec3(0.5, 0.12, 0.5)).without_uvs());
    post
}
