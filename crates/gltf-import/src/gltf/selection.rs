//! The active scene and material variants (KHR_materials_variants).
//!
//! The document root names the variants, and each primitive maps some of them to materials.
//! Choosing a variant replaces the material of every primitive that maps it, once, when the file is
//! loaded.

use crate::NameOrIndex;
use crate::warnings::ImportWarnings;
use gltf::json::{Root, mesh};
use model::{Diagnostic, Mesh, VariantMaterial};
use serde_json::Value;

/// Returns the active scene: the requested scene, else the default scene, else the first.
///
/// The index is 0 for a file without scenes, whose root nodes are then drawn.
///
/// # Errors
/// Fails if the requested scene does not exist. A missing default scene is also an error, except in
/// lenient mode.
pub(super) fn select_scene(
    root: &Root,
    selector: Option<&NameOrIndex>,
    warnings: &mut ImportWarnings,
) -> Result<usize, Diagnostic> {
    if let Some(selector) = selector {
        let names: Vec<_> = root.scenes.iter().map(|scene| scene.name.as_deref()).collect();
        return selector.find_among(&names, "scene", "/scenes");
    }
    match root.scene.map(|scene| scene.value()) {
        Some(scene) if scene >= root.scenes.len() => {
            let diagnostic =
                Diagnostic::unresolved_index("/scene", "scene", scene, root.scenes.len());
            warnings.downgrade_if_lenient(diagnostic, "the first scene is shown").map(|()| 0)
        }
        scene => Ok(scene.unwrap_or(0)),
    }
}

/// The extension's name, in the root and in primitives.
const VARIANTS_EXTENSION: &str = "KHR_materials_variants";

/// Returns the variant names in a file.
///
/// The name of an unnamed variant is empty; variants are identified by index.
pub(super) fn variant_names(root: &Root) -> Vec<String> {
    let extension =
        root.extensions.as_ref().and_then(|extensions| extensions.others.get(VARIANTS_EXTENSION));
    let list = extension.and_then(|extension| extension.get("variants")?.as_array());
    let name = |json: &Value| json.get("name").and_then(Value::as_str).unwrap_or("").to_owned();
    list.into_iter().flatten().map(name).collect()
}

/// Returns the index of the requested variant.
///
/// # Errors
/// Fails if the name is unknown or the index is out of range. The error lists the existing names.
pub(super) fn select_variant(
    names: &[String],
    selector: &NameOrIndex,
) -> Result<usize, Diagnostic> {
    let names: Vec<_> = names.iter().map(|name| Some(name.as_str())).collect();
    selector.find_among(&names, "variant", &format!("/extensions/{VARIANTS_EXTENSION}/variants"))
}

/// Returns the materials of a primitive for the variants. Invalid references are skipped with a
/// warning.
///
/// A mapping may assign a material to several variants; the result has an entry for each pair.
pub(super) fn variant_materials(
    root: &Root,
    json: &mesh::Primitive,
    pointer: &str,
    variants: usize,
    warnings: &mut ImportWarnings,
) -> Vec<VariantMaterial> {
    let extension = json.extensions.as_ref().and_then(|all| all.others.get(VARIANTS_EXTENSION));
    let mappings = extension.and_then(|extension| extension.get("mappings")?.as_array());
    let mut assignments = Vec::new();
    for (position, mapping) in mappings.into_iter().flatten().enumerate() {
        let pointer = format!("{pointer}/extensions/{VARIANTS_EXTENSION}/mappings/{position}");
        let index =
            |json: Option<&Value>| json.and_then(Value::as_u64).map(|position| position as usize);
        // A missing index is treated like an out-of-range index.
        let material = index(mapping.get("material")).unwrap_or(usize::MAX);
        let listed = mapping.get("variants").and_then(Value::as_array).into_iter().flatten();
        let diagnostic = if material < root.materials.len() {
            let numbers = listed.map(|json| index(Some(json)).unwrap_or(usize::MAX));
            let (known, unknown): (Vec<_>, Vec<_>) =
                numbers.partition(|&position| position < variants);
            assignments.extend(known.iter().map(|&variant| VariantMaterial { variant, material }));
            let pointer = format!("{pointer}/variants");
            unknown.first().map(|&position| {
                let diagnostic =
                    Diagnostic::unresolved_index(&pointer, "variant", position, variants);
                (diagnostic, "the reference is ignored")
            })
        } else {
            let (pointer, count) = (format!("{pointer}/material"), root.materials.len());
            let diagnostic = Diagnostic::unresolved_index(&pointer, "material", material, count);
            Some((diagnostic, "the mapping is skipped"))
        };
        if let Some((diagnostic, consequence)) = diagnostic {
            warnings.downgrade(&diagnostic, consequence);
        }
    }
    assignments
}

/// Returns the material of a primitive in a variant, if the variant changes it.
///
/// This predicts which images are needed before primitives are imported. Warnings are discarded,
/// because the import adds them.
pub(super) fn variant_material(
    root: &Root,
    json: &mesh::Primitive,
    variant: usize,
) -> Option<usize> {
    let all = variant_materials(root, json, "", variant + 1, &mut ImportWarnings::default());
    all.iter()
        .find(|assignments| assignments.variant == variant)
        .map(|assignments| assignments.material)
}

/// Replaces the materials of the primitives that the variant changes.
///
/// The time is linear in the number of primitives and their mappings.
pub(super) fn apply_variant(meshes: &mut [Mesh], variant: usize) {
    for primitive in meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives) {
        if let Some(assignments) =
            primitive.material_variants.iter().find(|assignments| assignments.variant == variant)
        {
            primitive.material = Some(assignments.material);
        }
    }
}
