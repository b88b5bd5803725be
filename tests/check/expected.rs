//! Where the check and the validator differ, and why.

use crate::manifest::Row;
use model::Severity;
use model::import::CheckReport;
use std::collections::BTreeSet;

const KTX: &str = "KHR_texture_ktx, for images of several layers, is not read";

/// Files in which the validator finds no error and the check does, with the kind and the reason.
const STRICTER: &[(&str, &str, &str)] = &[
    (
        "acme-box-unknown-required-extension/ACMEBox.gltf",
        "UNSUPPORTED_REQUIRED_EXTENSION",
        "the extension does not exist",
    ),
    (
        "required-extensions-unsupported.gltf",
        "UNSUPPORTED_REQUIRED_EXTENSION",
        "EXT_lights_image_based is not read",
    ),
    ("Test/image-3d-bundled.gltf", "UNSUPPORTED_REQUIRED_EXTENSION", KTX),
    ("Test/image-3d-compressed.glb", "UNSUPPORTED_REQUIRED_EXTENSION", KTX),
    ("Test/image-3d-not-bundled.glb", "UNSUPPORTED_REQUIRED_EXTENSION", KTX),
    ("Test/image-3d.glb", "UNSUPPORTED_REQUIRED_EXTENSION", KTX),
    ("Test/image-3d.gltf", "UNSUPPORTED_REQUIRED_EXTENSION", KTX),
    (
        "version-unsupported-min.gltf",
        "UNSUPPORTED_VERSION",
        "it needs glTF 2.1, which is not known",
    ),
    (
        "asset/min_version_valid.gltf",
        "UNSUPPORTED_VERSION",
        "it needs glTF 2.1, which is not known",
    ),
    (
        "KHR_node_visibility/data/node/unexpected_extension.gltf",
        "UNEXPECTED_EXTENSION_OBJECT",
        "the file is wrong on purpose; the validator that was asked does not know the extension",
    ),
];

/// Kinds of errors that the validator lists and the check does not find in a file, with the reason.
const MILDER: &[(&str, &str, &str)] = &[
    ("Test/mesh-invalid.gltf", "EXCEPTION", "the validator itself broke; the check finds 28 kinds"),
    ("glb/no_header.glb", "EXCEPTION", "the validator itself broke; NOT_GLTF here"),
    ("json/invalid_object.gltf", "EXCEPTION", "the validator itself broke; TYPE_MISMATCH here"),
    (
        "camera/infinite_znear.gltf",
        "VALUE_NOT_IN_RANGE",
        "1e999 is refused as JSON: INVALID_JSON here",
    ),
    (
        "node/infinite_transform.gltf",
        "VALUE_NOT_IN_RANGE",
        "1e999 is refused as JSON: INVALID_JSON here",
    ),
    (
        "Test/mesh-multiple-primitives.gltf",
        "INVALID_JSON",
        "base64 whose last digit has stray bits is read; the validator's parser gives up",
    ),
    (
        "mesh-invalid-texcoord-flip-attribute-accessor-invalid-normalized.gltf",
        "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT",
        "the accessor has no type at all, which is UNDEFINED_PROPERTY",
    ),
];

/// How a report differs from what is expected of a file.
pub fn difference_from_validator(
    row: &Row,
    report: &CheckReport,
    actual: &BTreeSet<&'static str>,
) -> Option<String> {
    let listed: BTreeSet<&str> = row.validator_errors.iter().map(String::as_str).collect();
    let allowed = |table: &[(&str, &str, &str)], code: &str| {
        table.iter().any(|(end, known, _)| row.path.ends_with(end) && *known == code)
    };
    if row.group() != "bad" {
        let wrong = actual.iter().find(|code| !allowed(STRICTER, code))?;
        let problem = report.diagnostics.iter().find(|problem| problem.code == *wrong)?;
        return Some(format!("no error is listed: {problem}"));
    }
    if !listed.is_empty() && report.errors == 0 {
        return Some(format!("no error is found, and there are {listed:?}"));
    }
    // What is wrong with the file as a whole has no place in the JSON; everything else has.
    let whole = |code: &str| {
        code.starts_with("GLB_") || ["INVALID_JSON", "NOT_GLTF", "TYPE_MISMATCH"].contains(&code)
    };
    let lost = report.diagnostics.iter().find(|p| p.location.is_empty() && !whole(p.code));
    if let Some(problem) = lost.filter(|problem| problem.severity == Severity::Error) {
        return Some(format!("an error without a place: {problem}"));
    }
    let missing: Vec<&str> = listed
        .iter()
        .copied()
        .filter(|code| !actual.contains(code) && !allowed(MILDER, code))
        .collect();
    if missing.is_empty() { None } else { Some(format!("{missing:?} not found, but {actual:?}")) }
}
