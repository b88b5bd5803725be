//! Seven identical spheres in a row: one mesh, seven nodes.

use crate::document::Document;
use crate::mesh::Mesh;
use crate::palette::{CLAY, OCHRE};
use serde_json::json;

pub(crate) fn spheres() -> Document {
    let mut document = Document::default();
    let middle = document.add_material("middle ball", CLAY);
    let outer = document.add_material("outer balls", OCHRE);
    let ball = Mesh::sphere(0.5, 40);
    let [middle, outer] = [("middle ball", middle), ("outer ball", outer)]
        .map(|(name, by)| document.add_mesh(name, &[(&ball, by)]));
    for place in -3_i32..=3 {
        let mesh = if place == 0 { middle } else { outer };
        let x = f64::from(place) * 1.5;
        document.add_root(
            &format!("ball {}", place + 4),
            Some(mesh),
            json!({ "translation": [x, 0.5, 0.0] }),
        );
    }
    document
}
