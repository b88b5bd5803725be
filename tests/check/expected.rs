//! Intended differences between the check and the Khronos validator, with reasons.

use alberti_tests::manifest::Row;
use gltf_check::CheckReport;
use model::Severity;
use std::collections::BTreeSet;

const KTX: &str = "KHR_texture_ktx, for images with several layers, is not supported";

/// Files with an error that the validator does not report, with its code and the reason.
const STRICTER: &[(&str, &str, &str)] = &[
    (
        "acme-box-unknown-required-extension/ACMEBox.gltf",
        "UNSUPPORTED_REQUIRED_EXTENSION",
        "the extension does not exist",
    ),
    (
        "required-extensions-unsupported.gltf",
        "UNSUPPORTED_REQUIRED_EXTENSION",
        "EXT_lights_image_based is not supported",
    ),
    ("Test/image-3d-bundled.gltf", "UNSUPPORTED_REQUIRED_EXTENSION", KTX),
    ("Test/image-3d-compressed.glb", "UNSUPPORTED_REQUIRED_EXTENSION", KTX),
    ("Test/image-3d-not-bundled.glb", "UNSUPPORTED_REQUIRED_EXTENSION", KTX),
    ("Test/image-3d.glb", "UNSUPPORTED_REQUIRED_EXTENSION", KTX),
    ("Test/image-3d.gltf", "UNSUPPORTED_REQUIRED_EXTENSION", KTX),
    (
        "version-unsupported-min.gltf",
        "UNSUPPORTED_VERSION",
        "it requires glTF 2.1, which is not supported",
    ),
    (
        "asset/min_version_valid.gltf",
        "UNSUPPORTED_VERSION",
        "it requires glTF 2.1, which is not supported",
    ),
    (
        "KHR_node_visibility/data/node/unexpected_extension.gltf",
        "UNEXPECTED_EXTENSION_OBJECT",
        "the file is invalid on purpose, but this version of the validator does not know the extension",
    ),
];

/// Files with a validator error that the check does not report, with its code and the reason.
const MILDER: &[(&str, &str, &str)] = &[
    (
        "Test/mesh-invalid.gltf",
        "EXCEPTION",
        "the validator itself crashed; the check reports 28 codes",
    ),
    ("glb/no_header.glb", "EXCEPTION", "the validator itself crashed; NOT_GLTF here"),
    ("json/invalid_object.gltf", "EXCEPTION", "the validator itself crashed; TYPE_MISMATCH here"),
    (
        "camera/infinite_znear.gltf",
        "VALUE_NOT_IN_RANGE",
        "1e999 is rejected as JSON; INVALID_JSON here",
    ),
    (
        "node/infinite_transform.gltf",
        "VALUE_NOT_IN_RANGE",
        "1e999 is rejected as JSON; INVALID_JSON here",
    ),
    (
        "Test/mesh-multiple-primitives.gltf",
        "INVALID_JSON",
        "base64 whose last digit has extra bits is accepted here, but not by the validator",
    ),
    (
        "mesh-invalid-texcoord-flip-attribute-accessor-invalid-normalized.gltf",
        "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT",
        "the accessor has no type, which is UNDEFINED_PROPERTY",
    ),
];

/// Returns whether errors with this code concern a whole file and have no JSON pointer.
fn concerns_whole_file(code: &str) -> bool {
    code.starts_with("GLB_") || ["INVALID_JSON", "NOT_GLTF", "TYPE_MISMATCH"].contains(&code)
}

/// Returns the differences between a report and the errors that the validator lists.
pub fn difference_from_validator(
    row: &Row,
    report: &CheckReport,
    actual: &BTreeSet<&'static str>,
) -> Option<String> {
    let listed: BTreeSet<&str> = row.validator_errors.iter().map(String::as_str).collect();
    let is_exception = |table: &[(&str, &str, &str)], code: &str| {
        table.iter().any(|(end, known, _)| row.path.ends_with(end) && *known == code)
    };
    if row.group() != "bad" {
        let wrong = actual.iter().find(|code| !is_exception(STRICTER, code))?;
        let diagnostic = report.diagnostics.iter().find(|diagnostic| diagnostic.code == *wrong)?;
        return Some(format!("no errors are listed, but the check finds {diagnostic}"));
    }
    if !listed.is_empty() && report.errors == 0 {
        return Some(format!("the check finds no errors, but {listed:?} are listed"));
    }
    let unlocated = report.diagnostics.iter().find(|diagnostic| {
        diagnostic.severity == Severity::Error
            && diagnostic.location.is_empty()
            && !concerns_whole_file(diagnostic.code)
    });
    if let Some(diagnostic) = unlocated {
        return Some(format!("an error without a JSON pointer: {diagnostic}"));
    }
    let is_missing = |code: &&str| !actual.contains(code) && !is_exception(MILDER, code);
    let missing: Vec<&str> = listed.iter().copied().filter(is_missing).collect();
    (!missing.is_empty()).then(|| format!("expected {missing:?}, actual {actual:?}"))
}
