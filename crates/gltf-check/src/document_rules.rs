//! Rules about the document as a whole: version, extension lists, variants, cameras and unused
//! objects.
//!
//! These rules relate several objects, or several members of one object, so the schema tables
//! cannot express them.

use super::codes;
use super::document::{
    CheckedDocument, array_items, as_whole_number, extension_object, string_member,
};
use super::schema::Collection;
use super::schema::extensions::EXTENSION_OBJECTS;
use serde_json::Value;
use std::collections::BTreeSet;

/// Validates the declared glTF version and the minimum version.
///
/// An unsupported major version stops the validation, because its schema is unknown; a later minor
/// version causes only a warning, because minor versions are compatible (glTF 2.0 §3.2).
///
/// Versions are compared as pairs of integers, because 2.10 is later than 2.9.
pub(super) fn check_asset(document: &CheckedDocument<'_>) {
    let diagnostics = document.diagnostics;
    let Some(asset) = document.root.get("asset") else { return };
    let parts = |key: &str| {
        let (major, minor) = string_member(asset, key)?.split_once('.')?;
        Some((major.parse::<u64>().ok()?, minor.parse::<u64>().ok()?))
    };
    let Some(version) = parts("version") else { return };
    if version.0 != 2 {
        let message =
            format_args!("unsupported glTF version {}.{}: expected 2.0", version.0, version.1);
        diagnostics.add(&codes::UNKNOWN_ASSET_MAJOR_VERSION, "/asset/version", message);
    } else if version.1 > 0 {
        let message = format_args!("unknown glTF version 2.{}: expected 2.0", version.1);
        diagnostics.add(&codes::UNKNOWN_ASSET_MINOR_VERSION, "/asset/version", message);
    }
    if let Some(minimum) = parts("minVersion").filter(|&minimum| minimum > version) {
        let message =
            format_args!("minVersion {}.{} is greater than `version`", minimum.0, minimum.1);
        diagnostics.add(
            &codes::ASSET_MIN_VERSION_GREATER_THAN_VERSION,
            "/asset/minVersion",
            message,
        );
    }
}

/// Validates the extension lists.
///
/// A required extension must also be used (glTF 2.0 §3.12). An extension without schema tables gets
/// a note, because its content is not validated.
pub(super) fn check_extensions(document: &CheckedDocument<'_>) {
    let diagnostics = document.diagnostics;
    for (at, name) in array_items(document.root, "extensionsRequired").iter().enumerate() {
        if let Some(name) = name.as_str().filter(|name| !document.uses_extension(name)) {
            let message = format_args!("{name} is required but not listed in extensionsUsed");
            let pointer = format_args!("/extensionsRequired/{at}");
            diagnostics.add(&codes::UNUSED_EXTENSION_REQUIRED, pointer, message);
        }
    }
    for (at, name) in array_items(document.root, "extensionsUsed").iter().enumerate() {
        if let Some(name) = name.as_str().filter(|name| !is_known(name)) {
            let message =
                format_args!("unsupported extension {name}: its content is not validated");
            let pointer = format_args!("/extensionsUsed/{at}");
            diagnostics.add(&codes::UNSUPPORTED_EXTENSION, pointer, message);
        }
    }
}

/// Returns whether the schema has tables for an extension.
fn is_known(extension: &str) -> bool {
    EXTENSION_OBJECTS.iter().any(|place| place.name == extension)
}

/// Validates KHR_materials_variants.
///
/// The root must declare the variants, and each variant may map a primitive to at most one
/// material.
///
/// If two mappings of a primitive listed the same variant, viewers could choose different
/// materials.
pub(super) fn check_variants(document: &CheckedDocument<'_>) {
    const NAME: &str = "KHR_materials_variants";
    let diagnostics = document.diagnostics;
    let has_variants = extension_object(document.root, NAME).is_some();
    for (at, mesh) in document.root_array("meshes").iter().enumerate() {
        for (part, primitive) in array_items(mesh, "primitives").iter().enumerate() {
            let Some(own) = extension_object(primitive, NAME) else { continue };
            let pointer = format!("/meshes/{at}/primitives/{part}/extensions/{NAME}");
            if !has_variants {
                let message = format_args!("/extensions/{NAME} must declare the variants");
                diagnostics.add(&codes::UNSATISFIED_DEPENDENCY, &pointer, message);
            }
            let mut known = BTreeSet::new();
            for (number, mapping) in array_items(own, "mappings").iter().enumerate() {
                let twice =
                    |variant: &&Value| as_whole_number(variant).is_some_and(|v| !known.insert(v));
                let all = array_items(mapping, "variants");
                // Duplicates within one list are reported by the schema walk.
                let distinct: BTreeSet<u64> = all.iter().filter_map(as_whole_number).collect();
                if distinct.len() == all.len() && all.iter().filter(twice).count() > 0 {
                    let message = "duplicate variant: it already has a material for this primitive";
                    let pointer = format_args!("{pointer}/mappings/{number}/variants");
                    diagnostics.add(
                        &codes::KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT,
                        pointer,
                        message,
                    );
                }
            }
        }
    }
}

/// Validates the parameters of cameras.
///
/// A camera defines a projection only if `zfar` is greater than `znear`, no magnification is zero,
/// and the field of view is less than half a turn.
///
/// The object named by `type` must be present. Angles are in radians.
pub(super) fn check_cameras(document: &CheckedDocument<'_>) {
    let diagnostics = document.diagnostics;
    for (at, camera) in document.root_array("cameras").iter().enumerate() {
        if let Some(kind @ ("perspective" | "orthographic")) = string_member(camera, "type")
            && camera.get(kind).is_none()
        {
            let message = format_args!("missing property `{kind}`, which the camera type requires");
            diagnostics.add(
                &codes::UNDEFINED_PROPERTY,
                format_args!("/cameras/{at}/{kind}"),
                message,
            );
        }
        for kind in ["perspective", "orthographic"] {
            let Some(lens) = camera.get(kind) else { continue };
            let number = |key: &str| lens.get(key).and_then(Value::as_f64);
            let pointer = format!("/cameras/{at}/{kind}");
            if let (Some(far), Some(near)) = (number("zfar"), number("znear"))
                && far <= near
                && far > 0.0
            {
                let message = format_args!("zfar {far} must be greater than znear {near}");
                diagnostics.add(&codes::CAMERA_ZFAR_LEQUAL_ZNEAR, &pointer, message);
            }
            for key in ["xmag", "ymag"] {
                let Some(size) = number(key) else { continue };
                let pointer = format_args!("{pointer}/{key}");
                if size == 0.0 {
                    diagnostics.add(&codes::CAMERA_XMAG_YMAG_ZERO, pointer, "must not be zero");
                } else if size < 0.0 {
                    let message = format_args!("{size} is negative");
                    diagnostics.add(&codes::CAMERA_XMAG_YMAG_NEGATIVE, pointer, message);
                }
            }
            if let Some(angle) = number("yfov").filter(|&angle| angle >= std::f64::consts::PI) {
                let message = format_args!("yfov is {angle} radians but must be less than pi");
                diagnostics.add(
                    &codes::CAMERA_YFOV_GEQUAL_PI,
                    format_args!("{pointer}/yfov"),
                    message,
                );
            }
        }
    }
}

/// Reports objects that nothing refers to.
///
/// Files with unsupported extensions are skipped, because such extensions may refer to anything.
/// Nodes and scenes are never reported, because a viewer may select them.
///
/// Unused objects are valid but increase the download time, so they get notes.
pub(super) fn check_unused(document: &CheckedDocument<'_>) {
    let names = array_items(document.root, "extensionsUsed").iter().filter_map(Value::as_str);
    if names.into_iter().any(|name| !is_known(name)) {
        return;
    }
    for (collection, pointer, matters) in Collection::ALL {
        if !matters {
            continue;
        }
        for at in document.unused_indices(collection) {
            let pointer = format_args!("{pointer}/{at}");
            document.diagnostics.add(
                &codes::UNUSED_OBJECT,
                pointer,
                "unused: nothing refers to it",
            );
        }
    }
}
