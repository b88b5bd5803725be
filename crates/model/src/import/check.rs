//! Everything that is wrong with a file, and not only what stops it from being drawn.
//!
//! Loading asks "can this be drawn?" and stops at the first thing that forbids it. A check asks "is this as the
//! specification demands?" and goes on: it compares the JSON with the schema, follows every reference, reads every
//! number, and at the end has the file loaded as well, so that its answer includes what loading says.
//!
//! ```text
//!  bytes ─glb─► JSON ─walk, by the tables of schema─► references ─nodes, meshes, skins, …─► demands ─data─► numbers
//!                                                                                 └─loading─► what is left out
//! ```
//!
//! It works on the JSON as it stands in the file and takes nothing for granted: members may be missing or of any type. The
//! rules are those of glTF 2.0, and they have the names and severities that the Khronos validator has for them. The
//! [limits](super::Limits) hold here as for loading: time and memory follow what is in the files, not what they claim.

mod accessors;
mod animations;
mod codes;
mod data;
mod document;
mod elements;
mod findings;
mod formats;
mod glb;
mod images;
mod layout;
mod lists;
mod loading;
mod materials;
mod meshes;
mod nodes;
mod report;
mod schema;
mod skins;
mod store;
mod uris;
mod usage;
mod walk;

pub use report::{Problem, Report, Severity};

use super::error::Fault;
use super::resolver::{self, Resolver};
use super::{ImportOptions, json, read_model};
use data::Demands;
use document::Document;
use findings::Findings;
use serde_json::Value;
use std::path::Path;
use store::Store;
use usage::Usage;

/// Checks a `.gltf` or `.glb` file and all that belongs to it.
///
/// A file that cannot be read is a report with that error: there is always a report.
///
/// ```no_run
/// use model::{ImportOptions, check};
/// let report = check("chair.glb".as_ref(), &ImportOptions::default());
/// for problem in &report.problems {
///     println!("{problem}");
/// }
/// println!("{}", report.summary());
/// ```
#[must_use]
pub fn check(path: &Path, options: &ImportOptions) -> Report {
    let findings = Findings::default();
    let resolver = |length| Resolver::new(path, length, options);
    let result = resolver::read_file(path, &options.limits, "").and_then(|bytes| {
        check_content(&bytes, &resolver(bytes.len())?, &findings);
        // A resolver of its own: what the check has read does not count against the loader's limits.
        read_model(path, &bytes, &resolver(bytes.len())?, options)
    });
    finish(path, result, findings)
}

/// Checks a file that is in memory; `name` stands for its path. As for [`load_bytes`](super::load_bytes), only with a
/// [root](ImportOptions::root) are other files read.
#[must_use]
pub fn check_bytes(name: &str, bytes: &[u8], options: &ImportOptions) -> Report {
    let path = Path::new(name);
    let findings = Findings::default();
    let resolver = || Resolver::in_memory(bytes.len(), options);
    let result = resolver().and_then(|own| {
        check_content(bytes, &own, &findings);
        read_model(path, bytes, &resolver()?, options)
    });
    finish(path, result, findings)
}

fn finish(path: &Path, result: Result<crate::Model, Fault>, findings: Findings) -> Report {
    let refusal = loading::tell(result, &findings);
    let (problems, [errors, warnings, notes]) = findings.into_parts();
    Report { file: path.to_owned(), problems, errors, warnings, notes, refusal }
}

fn check_content(bytes: &[u8], resolver: &Resolver<'_>, findings: &Findings) {
    let parts = glb::check(bytes, findings);
    let Some(text) = parts.json.map(|range| &bytes[range]) else { return };
    // What is too deep or has too many values, the loader refuses and tells.
    if json::count(text, resolver.limits).is_err() {
        return;
    }
    match serde_json::from_slice::<Value>(text) {
        Ok(root) => {
            let document = Document::new(&root, findings);
            let chunk = parts.binary.map(|range| &bytes[range]);
            check_document(&document, resolver, chunk, parts.is_binary);
        }
        Err(error) if parts.is_binary || text.starts_with(b"{") => {
            let message = format_args!("the JSON is not well formed: {error}");
            findings.add(&codes::INVALID_JSON, "", message);
        }
        Err(_) => {}
    }
}

fn check_document(
    document: &Document<'_>,
    resolver: &Resolver<'_>,
    chunk: Option<&[u8]>,
    is_binary: bool,
) {
    walk::walk(document);
    lists::check_asset(document);
    if document.findings.has_code(&codes::UNKNOWN_ASSET_MAJOR_VERSION) {
        return;
    }
    lists::check_extensions(document);
    lists::check_cameras(document);
    lists::check_variants(document);
    materials::check(document);
    let tree = nodes::check(document);

    let store = Store::read(document, resolver, chunk, is_binary);
    let (usage, mut demands) = (Usage::new(document), Demands::default());
    store::check_views(document);
    images::check(document, &store, &usage, resolver, is_binary);
    accessors::check(document, &store, &usage);
    meshes::check(document, &usage, &mut demands);
    skins::check(document, &tree, &usage, &mut demands);
    animations::check(document, &usage, &mut demands);
    data::check(document, &store, &demands);
    skins::check_weights(document, &store);
    lists::check_unused(document);
}
