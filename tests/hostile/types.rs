//! Tests every combination of shape, component type and normalization for every use of an accessor.

use crate::hostile::case::{Case, Expected};
use alberti_tests::gltf::Document;
use serde_json::json;

const SHAPES: [(&str, usize); 8] = [
    ("SCALAR", 1),
    ("VEC2", 2),
    ("VEC3", 3),
    ("VEC4", 4),
    ("MAT2", 4),
    ("MAT3", 9),
    ("MAT4", 16),
    ("VEC5", 5),
];

const COMPONENTS: [(u32, usize); 8] =
    [(5120, 1), (5121, 1), (5122, 2), (5123, 2), (5124, 4), (5125, 4), (5126, 4), (5130, 8)];

/// A use of an accessor: the attribute, with its accepted shapes and component types.
type Use = (&'static str, &'static [&'static str], &'static [u32]);

const USES: [Use; 7] = [
    ("POSITION", &["VEC3"], &[5120, 5121, 5122, 5123, 5126]),
    ("NORMAL", &["VEC3"], &[5120, 5122, 5126]),
    ("TEXCOORD_0", &["VEC2"], &[5120, 5121, 5122, 5123, 5126]),
    ("COLOR_0", &["VEC3", "VEC4"], &[5121, 5123, 5126]),
    ("JOINTS_0", &["VEC4"], &[5121, 5123]),
    ("WEIGHTS_0", &["VEC4"], &[5121, 5123, 5126]),
    ("_OWN", &[], &[]),
];

pub fn type_cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (shape, width) in SHAPES {
        for (component, size) in COMPONENTS {
            for normalized in [false, true] {
                let name = format!("{shape} of {component}, normalized {normalized}");
                let accessor = json!({"componentType": component, "type": shape, "count": 3, "normalized": normalized});
                // The buffer has space for any column padding. Read as floats, its bytes are ones.
                let bytes = [0, 0, 0x80, 0x3F].repeat(3 * (width * size).max(16));
                let readable = |shapes: &[&str], components: &[u32]| {
                    shapes.contains(&shape) && components.contains(&component)
                };
                for (attribute, shapes, components) in USES {
                    let mut document = Document::single_triangle();
                    let number = document.add_accessor(&bytes, accessor.clone());
                    let document = document.with_value(
                        &format!("/meshes/0/primitives/0/attributes/{attribute}"),
                        json!(number),
                    );
                    let expected = match (attribute, readable(shapes, components)) {
                        ("_OWN", _) => Expected::LoadsClean,
                        (_, true) => Expected::Loads,
                        ("POSITION", false) => Expected::Refused,
                        (_, false) => Expected::Warned,
                    };
                    cases.push(Case::from_document(
                        format!("{attribute}: {name}"),
                        &document,
                        expected,
                    ));
                }
                for (user, expected) in [
                    ("/meshes/0/primitives/0/indices", readable(&["SCALAR"], &[5121, 5123, 5125])),
                    ("/skins/0/inverseBindMatrices", true),
                    ("/animations/0/samplers/0/input", true),
                    (
                        "/accessors/0/sparse/indices/componentType",
                        [5121, 5123, 5125].contains(&component),
                    ),
                ] {
                    let mut document = Document::with_all_members();
                    let number = document.add_accessor(&bytes, accessor.clone());
                    let value =
                        if user.ends_with("Type") { json!(component) } else { json!(number) };
                    let expected = if expected { Expected::Loads } else { Expected::Refused };
                    cases.push(Case::from_document(
                        format!("{user}: {name}"),
                        &document.with_value(user, value),
                        expected,
                    ));
                }
            }
        }
    }
    cases
}
