//! Lists the extensions that are drawn, ignored or rejected.
//!
//! To add a material extension (KHR_materials_…), follow "How to add" in ARCHITECTURE.md. Other
//! extensions are read in the module of their object (for nodes, `scene_graph`). Then update the
//! extension's row in the table, which the program uses to report a file's extensions.

use crate::warnings::ImportWarnings;
use gltf::json::Root;
use model::{Diagnostic, codes};
use std::collections::BTreeSet;

/// The level of support for an extension.
///
/// The strings complete warnings and are shown to users.
enum ExtensionSupport {
    /// It is fully supported.
    Full,
    /// It does not affect the picture.
    Harmless,
    /// It is drawn with the stated limitation.
    Partly(&'static str),
    /// It is ignored, with the stated consequence.
    Without(&'static str),
    /// Files that require it are rejected for the stated reason.
    None(&'static str),
}

use ExtensionSupport::{Full, Harmless, None as Never, Partly, Without};

/// Support for Draco, an optional feature of this crate that is enabled by default.
const DRACO_SUPPORT: ExtensionSupport =
    if cfg!(feature = "draco") { Full } else { Never("Draco compression is not supported") };

/// Support for Basis Universal, an optional feature of this crate that is enabled by default.
const BASISU_SUPPORT: ExtensionSupport =
    if cfg!(feature = "basisu") { Full } else { Never("KTX2 images are not supported") };

/// Support for WebP, an optional feature of this crate that is enabled by default.
const WEBP_SUPPORT: ExtensionSupport =
    if cfg!(feature = "webp") { Full } else { Never("WebP images are not supported") };

/// All known extensions, sorted by name.
///
/// An extension that is not listed is ignored without a warning if a file merely uses it; files
/// that require it are rejected.
const KNOWN_EXTENSIONS: [(&str, ExtensionSupport); 36] = [
    ("CESIUM_primitive_outline", Partly("the outlines appear only in line drawings")),
    ("EXT_mesh_features", Harmless),
    ("EXT_mesh_gpu_instancing", Full),
    ("EXT_mesh_manifold", Harmless),
    ("EXT_mesh_primitive_edge_visibility", Partly("the edges appear only in line drawings")),
    ("EXT_meshopt_compression", Full),
    ("EXT_structural_metadata", Harmless),
    ("EXT_texture_webp", WEBP_SUPPORT),
    ("KHR_animation_pointer", Full),
    ("KHR_draco_mesh_compression", DRACO_SUPPORT),
    ("KHR_lights_punctual", Full),
    (
        "KHR_materials_anisotropy",
        Partly("under an environment, reflections are bent but not stretched"),
    ),
    ("KHR_materials_clearcoat", Full),
    (
        "KHR_materials_diffuse_transmission",
        Without("light that passes through surfaces is not shown"),
    ),
    ("KHR_materials_dispersion", Full),
    ("KHR_materials_emissive_strength", Full),
    ("KHR_materials_ior", Full),
    ("KHR_materials_iridescence", Full),
    ("KHR_materials_pbrSpecularGlossiness", Full),
    ("KHR_materials_sheen", Full),
    ("KHR_materials_specular", Full),
    (
        "KHR_materials_transmission",
        Partly("thick or rough glass shows only the opaque surfaces behind it"),
    ),
    ("KHR_materials_unlit", Full),
    ("KHR_materials_variants", Full),
    ("KHR_materials_volume", Full),
    ("KHR_mesh_quantization", Full),
    ("KHR_meshopt_compression", Full),
    ("KHR_node_visibility", Without("hidden nodes are shown")),
    ("KHR_texture_basisu", BASISU_SUPPORT),
    ("KHR_texture_transform", Full),
    ("KHR_xmp", Harmless),
    ("KHR_xmp_json_ld", Harmless),
    ("MSFT_lod", Without("the finest level is shown")),
    ("MSFT_packing_normalRoughnessMetallic", Harmless),
    ("MSFT_packing_occlusionRoughnessMetallic", Harmless),
    ("MSFT_texture_dds", Never("DDS images are not supported")),
];

/// Checks `extensionsRequired`. Unsupported extensions are an error, or a warning in lenient mode.
/// Also warns about extensions that are ignored or partly supported.
///
/// Such a warning appears once per extension, where it is first listed.
///
/// # Errors
/// Returns [`UNSUPPORTED_REQUIRED_EXTENSION`](codes::UNSUPPORTED_REQUIRED_EXTENSION) with the
/// reason.
pub(super) fn check_extensions(
    root: &Root,
    warnings: &mut ImportWarnings,
) -> Result<(), Diagnostic> {
    for (at, name) in root.extensions_required.iter().enumerate() {
        let reason = match find_support(name) {
            Some(Never(reason)) => *reason,
            Some(_) => continue,
            None => "it is not supported",
        };
        let diagnostic = Diagnostic::error(
            codes::UNSUPPORTED_REQUIRED_EXTENSION,
            &format!("/extensionsRequired/{at}"),
            format!("the file requires the extension {name}: {reason}"),
            "export the file without it, or load the rest with --lenient",
        );
        warnings.downgrade_if_lenient(diagnostic, "the extension is ignored")?;
    }
    let mut reported = BTreeSet::new();
    for (list, names) in [
        ("extensionsUsed", &root.extensions_used),
        ("extensionsRequired", &root.extensions_required),
    ] {
        for (at, name) in names.iter().enumerate() {
            if let (Some(Partly(reason) | Without(reason) | Never(reason)), true) =
                (find_support(name), reported.insert(name))
            {
                warnings.push_warning(&format!("/{list}/{at}"), format!("{name}: {reason}"));
            }
        }
    }
    Ok(())
}

/// The effect of an extension on the picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ExtensionUse {
    /// It is drawn.
    Drawn,
    /// It does not affect the picture.
    Harmless,
    /// It is drawn with the stated limitation.
    Partly(&'static str),
    /// It is ignored, with the stated consequence.
    Without(&'static str),
    /// Files that require it are rejected for the stated reason.
    Refused(&'static str),
    /// It is unknown; files that require it are rejected.
    Unknown,
}

/// Returns the effect of the named extension.
#[must_use]
pub fn extension_use(name: &str) -> ExtensionUse {
    match find_support(name) {
        Some(Full) => ExtensionUse::Drawn,
        Some(Harmless) => ExtensionUse::Harmless,
        Some(Partly(how)) => ExtensionUse::Partly(how),
        Some(Without(what)) => ExtensionUse::Without(what),
        Some(Never(why)) => ExtensionUse::Refused(why),
        None => ExtensionUse::Unknown,
    }
}

/// Looks up an extension in the table. Returns `None` if it is unknown.
fn find_support(name: &str) -> Option<&'static ExtensionSupport> {
    KNOWN_EXTENSIONS.iter().find(|known| known.0 == name).map(|known| &known.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extension_table_is_sorted_without_duplicates() {
        assert!(KNOWN_EXTENSIONS.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }
}
