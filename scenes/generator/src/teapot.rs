//! The Utah teapot, tessellated from its published patches, y up.

use crate::bezier;
use crate::document::Document;
use crate::mesh::{Mesh, OutlinePoint};
use crate::palette::{BARK, CREAM, SAND, TEAL, mix_colors};
use crate::teapot_patches::{Part, teapot_parts};
use glam::{DVec3, dvec2, dvec3};
use serde_json::json;

/// The number of steps along each side of a patch, which gives forty steps around the pot.
const PATCH_STEPS: u32 = 10;

pub(crate) fn teapot() -> Document {
    let mut document = Document::default();
    // The inside is visible through the spout and through the gap around the lid, which the
    // original also has.
    let glaze = document.add_double_sided("glaze", TEAL);
    let root = document.add_root("teapot", None, json!({}));
    for part in teapot_parts() {
        let mesh = document.add_mesh(part.name, &[(&tessellate_part(&part), glaze)]);
        document.add_child(root, part.name, Some(mesh), json!({}));
    }
    document
}

/// Tessellates the patches of a part into one mesh, rotated from z up to glTF's y up.
fn tessellate_part(part: &Part) -> Mesh {
    let mut mesh = Mesh::default();
    for patch in &part.patches {
        bezier::tessellate(&mut mesh, patch, PATCH_STEPS);
    }
    for v in mesh.positions.iter_mut().chain(&mut mesh.normals) {
        *v = dvec3(v.x, v.z, -v.y);
    }
    mesh
}

/// The outer radius of the table top's darker rim; [`TABLE_RIM`] is the inner radius.
const TABLE_RADIUS: f64 = 4.2;
const TABLE_RIM: f64 = 4.05;

/// Builds a round table top; its vertex colors contain the contact shadow of the teapot.
pub(crate) fn table_document() -> Document {
    let mut document = Document::default();
    let cloth = document.add_material("table top", crate::palette::Color(255, 255, 255));
    let mesh = document.add_mesh("table top", &[(&table_top(), cloth)]);
    document.add_root("table top", Some(mesh), json!({}));
    document
}

fn table_top() -> Mesh {
    let flat = |radius| OutlinePoint { radius, height: 0.0, normal: dvec2(0.0, 1.0) };
    let outline = |normal, radius, height| OutlinePoint { radius, height, normal };
    let edge = dvec2(1.0, 0.0);
    let mut rings = vec![outline(edge, TABLE_RADIUS, -0.25), outline(edge, TABLE_RADIUS, 0.0)];
    rings.extend([TABLE_RADIUS, TABLE_RIM + 0.01, TABLE_RIM - 0.01, 3.5].map(flat));
    // The steps are fine only where the shadow ends.
    rings.extend((12..=28).rev().map(|tenth| flat(f64::from(tenth) / 10.0)));
    rings.push(flat(0.0));
    let mut mesh = Mesh::lathe(&rings, 64);
    mesh.colors = mesh.positions.iter().map(|p| table_color(*p)).collect();
    mesh
}

fn table_color(position: DVec3) -> [f64; 3] {
    if position.y < 0.0 {
        return BARK.linear();
    }
    let r = libm::sqrt(position.x * position.x + position.z * position.z);
    if r > TABLE_RIM {
        return SAND.linear();
    }
    // The shadow is darkest under the pot and ends 1.2 beyond its foot.
    let shade = ((r - 1.3) / 1.4).clamp(0.0, 1.0);
    let shade = shade * shade * (3.0 - 2.0 * shade);
    mix_colors(CREAM.linear().map(|channel| channel * 0.38), CREAM.linear(), shade)
}
