//! Material spheres: metals and dielectrics by roughness, and one sphere per layer extension.

use crate::document::Document;
use crate::mesh::Mesh;
use serde_json::{Value, json};

/// Builds the spheres in rows, from the top: metals, dielectrics, layers.
pub(crate) fn finishes() -> Document {
    let mut document = Document::default();
    let ball = Mesh::sphere(0.45, 28);
    let gold = json!([1.0, 0.71, 0.29, 1.0]);
    let paint = json!([0.02, 0.16, 0.2, 1.0]);
    for step in 0..5_u32 {
        let roughness = f64::from(step) / 4.0;
        let plain = |color: &Value, metallic: f64, roughness: f64| {
            json!({
                "baseColorFactor": color, "metallicFactor": metallic, "roughnessFactor": roughness,
            })
        };
        let rows = [
            ("gold", json!({ "pbrMetallicRoughness": plain(&gold, 1.0, roughness) })),
            ("paint", json!({ "pbrMetallicRoughness": plain(&paint, 0.0, roughness) })),
            ("layer", layer_extension(step)),
        ];
        for (row, (name, material)) in rows.into_iter().enumerate() {
            let name = format!("{name} {}", step + 1);
            let material = document.add_finish(&name, material);
            let mesh = document.add_mesh(&name, &[(&ball, material)]);
            let place = [f64::from(step) - 2.0, 1.0 - row as f64, 0.0];
            document.add_root(&name, Some(mesh), json!({ "translation": place }));
        }
    }
    document
}

/// Returns the material of a column, with one extension: clearcoat, sheen, iridescence,
/// transmission or index of refraction.
fn layer_extension(which: u32) -> Value {
    let (color, metallic, roughness, name, extension) = match which {
        0 => (
            [0.45, 0.02, 0.02, 1.0],
            0.0,
            0.6,
            "KHR_materials_clearcoat",
            json!({ "clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.05 }),
        ),
        1 => (
            [0.06, 0.02, 0.12, 1.0],
            0.0,
            0.9,
            "KHR_materials_sheen",
            json!({ "sheenColorFactor": [0.9, 0.7, 0.95], "sheenRoughnessFactor": 0.4 }),
        ),
        2 => (
            [0.6, 0.6, 0.6, 1.0],
            1.0,
            0.15,
            "KHR_materials_iridescence",
            json!({ "iridescenceFactor": 1.0, "iridescenceThicknessMaximum": 380.0 }),
        ),
        3 => (
            [1.0, 1.0, 1.0, 1.0],
            0.0,
            0.0,
            "KHR_materials_transmission",
            json!({ "transmissionFactor": 0.95 }),
        ),
        _ => ([0.02, 0.25, 0.05, 1.0], 0.0, 0.1, "KHR_materials_ior", json!({ "ior": 2.4 })),
    };
    let surface = json!({
        "baseColorFactor": color, "metallicFactor": metallic, "roughnessFactor": roughness,
    });
    json!({ "pbrMetallicRoughness": surface, "extensions": { name: extension } })
}
