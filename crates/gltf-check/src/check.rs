//! Validation of whole files: the glTF rules, then the loader's diagnostics.

use crate::CheckReport;
use crate::data::ElementRules;
use crate::diagnostics::Diagnostics;
use crate::document::CheckedDocument;
use crate::store::BufferStore;
use crate::usage::UsageMap;
use gltf_import::{ImportOptions, UriResolver, check_json_limits, read_file};
use import::{FileFormat, import_model};
use model::Diagnostic;
use serde_json::Value;
use std::path::Path;

/// Validates a file and the files it refers to.
///
/// Always returns a report: an unreadable file is an error in the report.
///
/// ```no_run
/// use import::ImportOptions;
/// use gltf_check::check_file;
/// let report = check_file("chair.glb".as_ref(), &ImportOptions::default());
/// for diagnostic in &report.diagnostics {
///     println!("{diagnostic}");
/// }
/// println!("{}", report.summary());
/// ```
#[must_use]
pub fn check_file(path: &Path, options: &ImportOptions) -> CheckReport {
    let findings = Diagnostics::default();
    let resolver = |length| UriResolver::new(path, length, options);
    let result = read_file(path, &options.limits, "").and_then(|bytes| {
        if has_gltf_rules(path, &bytes) {
            check_content(&bytes, &resolver(bytes.len())?, &findings);
        }
        // The loader gets a separate resolver, because bytes read by the validation must not count
        // against its limits.
        import_model(path, &bytes, &resolver(bytes.len())?, options)
    });
    build_report(path, result, findings)
}

/// Validates a file in memory; `name` replaces its path in the report.
///
/// As with [`load_bytes`](import::load_bytes), other files are read only if there is a
/// [root](ImportOptions::root).
#[must_use]
pub fn check_bytes(name: &str, bytes: &[u8], options: &ImportOptions) -> CheckReport {
    let path = Path::new(name);
    let findings = Diagnostics::default();
    let resolver = || UriResolver::in_memory(bytes.len(), options);
    let result = resolver().and_then(|own| {
        if has_gltf_rules(path, bytes) {
            check_content(bytes, &own, &findings);
        }
        import_model(path, bytes, &resolver()?, options)
    });
    build_report(path, result, findings)
}

/// Returns whether to validate the file against the glTF specification. For other formats, only the
/// loader's diagnostics are reported.
fn has_gltf_rules(path: &Path, bytes: &[u8]) -> bool {
    FileFormat::recognize(path, bytes) == Ok(FileFormat::Gltf)
}

/// Builds the report from the findings, the loader's diagnostics and the counts.
fn build_report(
    path: &Path,
    result: Result<model::Model, Diagnostic>,
    findings: Diagnostics,
) -> CheckReport {
    let refusal = crate::load_outcome::add_load_outcome(result, &findings);
    let (problems, [errors, warnings, notes]) = findings.into_parts();
    CheckReport {
        file: path.to_owned(),
        diagnostics: problems,
        errors,
        warnings,
        notes,
        load_error: refusal,
    }
}

/// Validates the container and, if it can be parsed, its JSON.
fn check_content(bytes: &[u8], resolver: &UriResolver<'_>, findings: &Diagnostics) {
    let parts = crate::glb::check_container(bytes, findings);
    let Some(text) = parts.json.map(|range| &bytes[range]) else { return };
    // The loader rejects and reports JSON that is too deep or too large.
    if check_json_limits(text, resolver.limits).is_err() {
        return;
    }
    match serde_json::from_slice::<Value>(text) {
        Ok(root) => {
            let document = CheckedDocument::new(&root, findings);
            let chunk = parts.binary.map(|range| &bytes[range]);
            check_document(&document, resolver, chunk, parts.is_binary);
        }
        Err(error) if parts.is_binary || text.starts_with(b"{") => {
            let message = format_args!("invalid JSON: {error}");
            findings.add(&crate::codes::INVALID_JSON, "", message);
        }
        Err(_) => {}
    }
}

/// Runs all checks on a parsed document.
///
/// The order matters. The schema walk runs first, because it reports missing and mistyped members,
/// which later checks skip. Element data is read after all of its rules are known. Unused objects
/// are found last.
fn check_document(
    document: &CheckedDocument<'_>,
    resolver: &UriResolver<'_>,
    chunk: Option<&[u8]>,
    is_binary: bool,
) {
    crate::schema_walk::check_schema(document);
    crate::document_rules::check_asset(document);
    if document.diagnostics.has_code(&crate::codes::UNKNOWN_ASSET_MAJOR_VERSION) {
        return;
    }
    crate::document_rules::check_extensions(document);
    crate::document_rules::check_cameras(document);
    crate::document_rules::check_variants(document);
    crate::materials::check_materials(document);
    let tree = crate::nodes::check_nodes(document);

    let store = BufferStore::load_buffers(document, resolver, chunk, is_binary);
    let (usage, mut demands) = (UsageMap::new(document), ElementRules::default());
    crate::store::check_buffer_views(document);
    crate::images::check_images(document, &store, &usage, resolver, is_binary);
    crate::accessors::check_accessors(document, &store, &usage);
    crate::meshes::check_meshes(document, &usage, &mut demands);
    crate::skins::check_skins(document, &tree, &usage, &mut demands);
    crate::animations::check_animations(document, &usage, &mut demands);
    crate::data::check_data(document, &store, &demands);
    crate::skins::check_skinned_meshes(document, &store);
    crate::document_rules::check_unused(document);
}
