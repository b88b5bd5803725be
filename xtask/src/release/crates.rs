//! Packs the crates as the registry would receive them.
//!
//! ```text
//!  sources ─► copy with `publish = true` ─► cargo package --workspace ─► target/package-sources
//! ```
//! Cargo packs interdependent crates only if they may be published. The manifests forbid
//! publishing, to prevent accidents, so only the copy allows it. Without building, the step takes a
//! second and finds gaps in manifests. With building, each crate is built from its archive, which
//! also finds gaps in the archives.

use super::build::{cargo_home, copy_sources};
use super::write_file;
use crate::Outcome;
use crate::program::{cargo_command, run_command};
use crate::workspace::{list_files, read_text, target_folder};
use std::fs;

/// Workspace members that are not published.
const UNPUBLISHED: [&str; 4] = ["alberti-tests", "book-doctests", "scene-models", "xtask"];

/// Packs all crates. If `is_built` is true, each crate is also built from its archive.
pub fn package_crates(is_built: bool) -> Outcome {
    let sources = target_folder().join("package-sources");
    let _ = fs::remove_dir_all(&sources);
    copy_sources(&sources)?;
    let manifest = sources.join("Cargo.toml");
    let text = read_text(&manifest)?;
    let published = text.replace("\npublish = false\n", "\npublish = true\n");
    if published == text {
        return Err("Cargo.toml has no line `publish = false`: see RELEASING.md".to_owned());
    }
    write_file(&manifest, published.as_bytes())?;
    if is_built {
        forget_unpacked_crates()?;
    }
    let mut cargo = cargo_command(&["package", "--quiet", "--workspace", "--allow-dirty"]);
    for name in UNPUBLISHED {
        cargo.args(["--exclude", name]);
    }
    if !is_built {
        cargo.arg("--no-verify");
    }
    run_command(cargo.current_dir(&sources).env_remove("CARGO_TARGET_DIR"))?;
    let folder = sources.join("target/package");
    for archive in list_files(&folder, "crate")? {
        let bytes = fs::metadata(&archive).map_err(|error| error.to_string())?.len();
        let name = archive.file_name().unwrap_or_default().to_string_lossy().into_owned();
        println!("{name:40} {bytes:>8} bytes");
    }
    Ok(())
}

/// Removes the crates that an earlier run unpacked. Cargo considers crates with the same version
/// identical, so it would build a new crate against an old one.
///
/// Cargo keeps them in its folder for registries without a host.
fn forget_unpacked_crates() -> Outcome {
    let registries = fs::read_dir(cargo_home().join("registry/src")).into_iter().flatten();
    let has_no_host = |entry: &fs::DirEntry| entry.file_name().to_string_lossy().starts_with('-');
    for registry in registries.flatten().filter(has_no_host) {
        let crates = fs::read_dir(registry.path()).into_iter().flatten().flatten();
        for unpacked in crates.filter(|e| e.file_name().to_string_lossy().starts_with("alberti")) {
            let path = unpacked.path();
            fs::remove_dir_all(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        }
    }
    Ok(())
}
