//! Makes the reference of scene files from the types that read them, so that it cannot fall behind them: every field, variant and
//! doc comment of `src/scene/file` and `src/scene/number.rs` becomes an entry of a table that `scene::reference` includes.

#![allow(clippy::print_stdout, reason = "that is how a build script speaks to Cargo")]

#[path = "build/read.rs"]
mod read;
#[path = "build/table.rs"]
mod table;

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

/// The type of a whole scene file: where the reference begins.
const ROOT: &str = "SceneFile";

fn main() -> Result<(), Box<dyn Error>> {
    let scene = Path::new("src/scene");
    let mut types = Vec::new();
    for path in sources(scene)? {
        println!("cargo::rerun-if-changed={}", path.display());
        let read = fs::read_to_string(&path)?;
        let file =
            syn::parse_file(&read).map_err(|error| format!("{}: {error}", path.display()))?;
        types.extend(read::types(&file.items));
    }
    println!("cargo::rerun-if-changed={}", scene.join("file").display());
    let out = PathBuf::from(std::env::var_os("OUT_DIR").ok_or("Cargo sets OUT_DIR")?);
    fs::write(out.join("reference.rs"), table::of(&types, ROOT)?)?;
    Ok(())
}

/// The files whose types a scene file is made of, in a fixed order.
fn sources(scene: &Path) -> Result<Vec<PathBuf>, std::io::Error> {
    let entries = fs::read_dir(scene.join("file"))?;
    let mut paths =
        entries.map(|entry| Ok(entry?.path())).collect::<Result<Vec<_>, std::io::Error>>()?;
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "rs"));
    paths.extend([scene.join("file.rs"), scene.join("number.rs")]);
    paths.sort();
    Ok(paths)
}
