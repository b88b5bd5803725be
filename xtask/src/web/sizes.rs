//! Checks the size of the page against its limits.

use super::node;
use crate::Outcome;
use std::fs;
use std::path::{Path, PathBuf};

/// The maximum size of the module in bytes, uncompressed and compressed. The goals are 2,500,000
/// and 950,000.
const MODULE: [usize; 2] = [2_936_000, 1_231_000];
/// The maximum size in bytes of everything that the page loads except the module and models: HTML,
/// styles and scripts.
const PAGE: usize = 84_000;

/// Prints the sizes and checks the limits.
///
/// # Errors
/// Fails if a size is above its limit.
pub fn check_sizes(site: &Path) -> Outcome {
    let module = site.join("web_bg.wasm");
    let raw = file_size(&module)?;
    let packed = node::gzip_size(&module)?;
    let mut page = 0;
    for path in page_files(site)? {
        page += file_size(&path)?;
    }
    let rows = [
        ("web_bg.wasm", raw, MODULE[0]),
        ("web_bg.wasm, gzip -9", packed, MODULE[1]),
        ("page without the module", page, PAGE),
    ];
    for (name, size, limit) in rows {
        println!("  {name:22} {size:9} bytes of {limit:9}");
    }
    println!("  {:22} {:9} bytes", "alberti.html", file_size(&site.join("alberti.html"))?);
    let large = rows.iter().filter(|(_, size, limit)| size > limit);
    let names: Vec<&str> = large.map(|(name, ..)| *name).collect();
    if names.is_empty() { Ok(()) } else { Err(format!("too large: {}", names.join("; "))) }
}

/// Returns the files that the page loads before the module: the page's files and the module's
/// JavaScript.
fn page_files(site: &Path) -> Result<Vec<PathBuf>, String> {
    let mut files: Vec<PathBuf> =
        super::page_files()?.iter().filter_map(|path| Some(site.join(path.file_name()?))).collect();
    files.push(site.join("web.js"));
    Ok(files)
}

fn file_size(path: &Path) -> Result<usize, String> {
    let metadata = fs::metadata(path).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(usize::try_from(metadata.len()).unwrap_or(usize::MAX))
}
