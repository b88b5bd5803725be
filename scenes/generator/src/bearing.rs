//! A plain bearing for section views: a shaft in its housing, as closed solids that fit together.

use crate::document::Document;
use crate::mesh::{Mesh, sharp_outline};
use crate::palette::{CLAY, OCHRE, SAND, SLATE, TEAL};
use glam::{DVec3, dvec3};
use serde_json::json;

/// Segments around the axis.
const SEGMENTS: u32 = 48;

/// An outline in radius and height; a closed one gives the solid of revolution a bore.
type Profile<'a> = &'a [(f64, f64)];

const HOUSING: Profile<'_> = &[
    (0.6, 0.0),
    (1.6, 0.0),
    (1.6, 0.3),
    (1.0, 0.3),
    (1.0, 1.5),
    (0.75, 1.5),
    (0.75, 1.3),
    (0.6, 1.3),
    (0.6, 0.0),
];
const BUSH: Profile<'_> = &[(0.45, -0.1), (0.6, -0.1), (0.6, 1.3), (0.45, 1.3), (0.45, -0.1)];
const RING: Profile<'_> = &[(0.45, 1.3), (0.75, 1.3), (0.75, 1.5), (0.45, 1.5), (0.45, 1.3)];
/// The shaft reaches the axis at both ends, so its outline is open.
const SHAFT: Profile<'_> = &[
    (0.0, -0.5),
    (0.4, -0.5),
    (0.45, -0.45),
    (0.45, 1.6),
    (0.7, 1.6),
    (0.7, 1.8),
    (0.3, 1.8),
    (0.3, 2.3),
    (0.0, 2.3),
];
/// Only the bolt head.
const BOLT: Profile<'_> = &[(0.0, 0.3), (0.2, 0.3), (0.2, 0.45), (0.0, 0.45)];

pub(crate) fn bearing() -> Document {
    let mut document = Document::default();
    for (name, profile, color) in [
        ("housing", HOUSING, SLATE),
        ("bush", BUSH, OCHRE),
        ("ring", RING, CLAY),
        ("shaft", SHAFT, SAND),
    ] {
        let material = document.add_material(name, color);
        let part =
            document.add_mesh(name, &[(&Mesh::lathe(&sharp_outline(profile), SEGMENTS), material)]);
        document.add_root(name, Some(part), json!({}));
    }
    let steel = document.add_material("steel", TEAL);
    let bolt = document.add_mesh("bolt", &[(&Mesh::lathe(&sharp_outline(BOLT), 12), steel)]);
    let places: [DVec3; 4] =
        [dvec3(1.3, 0.0, 0.0), dvec3(-1.3, 0.0, 0.0), dvec3(0.0, 0.0, 1.3), dvec3(0.0, 0.0, -1.3)];
    for (number, DVec3 { x, y, z }) in (1..).zip(places) {
        let place = json!({ "translation": [x, y, z] });
        document.add_root(&format!("bolt {number}"), Some(bolt), place);
    }
    document
}
