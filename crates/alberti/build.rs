//! Packs the program's relocations and embeds the explorer.
//!
//! Packed relocations (`DT_RELR`) shrink a quarter of a megabyte of addresses, mostly of strings,
//! to a few kilobytes.
//!
//! The dynamic linker must support the format; glibc has supported it since version 2.36. A program
//! that is built on a machine with an older version, or cross-compiled, keeps ordinary relocations.
//!
//! The explorer consists of its page and its lesson models. `ALBERTI_WEB=FOLDER cargo build`, where
//! FOLDER is the output of `cargo xtask web`, adds the WebAssembly engine; without it, the program
//! computes everything the page shows.

use std::io::{Error, Result};
use std::path::{Path, PathBuf};
use std::process::Command;

fn main() -> Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=ALBERTI_WEB");
    embed_explorer(std::env::var_os("ALBERTI_WEB").map(PathBuf::from).as_deref())?;
    let variable = |name: &str| std::env::var(name).unwrap_or_default();
    let is_gnu_linux =
        variable("CARGO_CFG_TARGET_OS") == "linux" && variable("CARGO_CFG_TARGET_ENV") == "gnu";
    let is_native = variable("HOST") == variable("TARGET");
    if is_gnu_linux && is_native && glibc_version().is_some_and(|version| version >= [2, 36]) {
        println!("cargo::rustc-link-arg-bins=-Wl,-z,pack-relative-relocs");
    }
    Ok(())
}

/// The explorer's lesson models.
const LESSON_MODELS: [&str; 5] =
    ["crate.glb", "floor.glb", "house.glb", "mexican_hat.glb", "mexican_hat_lines.glb"];

/// Writes `explorer_files.rs`: the explorer's page, its lesson models and its engine, each
/// compressed (zlib).
///
/// `embedded` contains links to the page and the models, so that the package includes them.
fn embed_explorer(engine: Option<&Path>) -> Result<()> {
    let folder_of = |name: &str| PathBuf::from(std::env::var_os(name).unwrap_or_default());
    let (root, out) = (folder_of("CARGO_MANIFEST_DIR"), folder_of("OUT_DIR"));
    let page = root.join("embedded/page");
    println!("cargo::rerun-if-changed={}", page.display());
    let entries: Result<Vec<_>> = std::fs::read_dir(&page)?.collect();
    let mut files: Vec<(String, PathBuf)> =
        entries?.iter().map(|entry| (file_name(&entry.path()), entry.path())).collect();
    files.sort();
    let models = root.join("embedded/models");
    files.extend(LESSON_MODELS.map(|name| (format!("models/{name}"), models.join(name))));
    let engine_files = |folder: &Path| ["web.js", "web_bg.wasm"].map(|name| folder.join(name));
    files.extend(engine.into_iter().flat_map(engine_files).map(|path| (file_name(&path), path)));
    let mut list = String::new();
    for (at, (name, path)) in files.iter().enumerate() {
        println!("cargo::rerun-if-changed={}", path.display());
        let named = |error: Error| Error::new(error.kind(), format!("{}: {error}", path.display()));
        let bytes = std::fs::read(path).map_err(named)?;
        let packed = out.join(format!("explorer_file_{at}"));
        std::fs::write(&packed, miniz_oxide::deflate::compress_to_vec_zlib(&bytes, 10))?;
        list += &format!("({name:?}, include_bytes!({packed:?})),");
    }
    std::fs::write(out.join("explorer_files.rs"), format!("&[{list}]"))
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Returns the version of this machine's glibc.
fn glibc_version() -> Option<[u32; 2]> {
    let output = Command::new("getconf").arg("GNU_LIBC_VERSION").output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let (major, minor) = text.trim().strip_prefix("glibc ")?.split_once('.')?;
    Some([major.parse().ok()?, minor.parse().ok()?])
}
