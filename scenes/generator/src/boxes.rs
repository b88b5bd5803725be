//! A wooden crate (base color texture) and glass panes (alpha modes BLEND, MASK and OPAQUE).

use crate::document::Document;
use crate::mesh::Mesh;
use crate::palette::{CLAY, OCHRE, SLATE, TEAL};
use crate::wood;
use glam::{DVec3, dvec3};
use serde_json::json;

/// Builds a one-meter cube that rests on the ground, with one texture on all six faces.
pub(crate) fn wooden_crate() -> Result<Document, String> {
    let mut document = Document::default();
    let planks = document.add_texture("planks", &wood::crate_side_png()?);
    let wood = document.add_textured("wood", planks, json!({}));
    let mesh = document.add_mesh("crate", &[(&Mesh::block_on(DVec3::ZERO, DVec3::ONE), wood)]);
    document.add_root("crate", Some(mesh), json!({}));
    Ok(document)
}

/// Builds three panes of colored glass (BLEND) with a perforated screen (MASK) behind them, in a
/// slate rail (OPAQUE). The panes are listed from front to back, the opposite of the order in which
/// they must be blended for a camera in front.
pub(crate) fn panes() -> Result<Document, String> {
    let mut document = Document::default();
    let rail = document.add_material("rail", SLATE);
    let rail = document.add_mesh(
        "rail",
        &[(&Mesh::block_on(DVec3::ZERO, dvec3(3.4, 0.16, 2.6)).without_uvs(), rail)],
    );
    document.add_root("rail", Some(rail), json!({}));

    for (name, color, x, z) in [
        ("ochre pane", OCHRE, -0.5, 0.9),
        ("clay pane", CLAY, 0.0, 0.3),
        ("teal pane", TEAL, 0.5, -0.3),
    ] {
        let glass = document.add_glass(name, color, 0.55);
        let pane = document
            .add_mesh(name, &[(&upright_pane(dvec3(x, 0.16, z), 1.5, 1.8).without_uvs(), glass)]);
        document.add_root(name, Some(pane), json!({}));
    }

    let lattice = document.add_texture("lattice", &wood::lattice_png()?);
    let cut_out = json!({ "alphaMode": "MASK", "alphaCutoff": 0.5, "doubleSided": true });
    let screen = document.add_textured("screen", lattice, cut_out);
    let screen =
        document.add_mesh("screen", &[(&upright_pane(dvec3(0.0, 0.16, -0.9), 3.0, 2.2), screen)]);
    document.add_root("screen", Some(screen), json!({}));
    Ok(document)
}

/// Builds a rectangle that faces +z; `at` is the center of its lower edge.
fn upright_pane(at: DVec3, width: f64, height: f64) -> Mesh {
    let side = DVec3::X * (width / 2.0);
    let up = DVec3::Y * height;
    let mut mesh = Mesh::default();
    mesh.add_quad([at - side, at + side, at + side + up, at - side + up]);
    mesh
}
