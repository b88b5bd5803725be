//! Builds programs that outside users might write, with the packed crates as if these came from the
//! registry, and runs them.
//!
//! ```text
//!  crates ─► cargo package ─► *.crate ─► unpacked ─┐
//!  tests/strangers ─► copy whose patches lead there ┴─► cargo build ─► each program is run
//! ```

use crate::Outcome;
use crate::program::{cargo_command, run_command, run_visibly};
use crate::release::crates::package_crates;
use crate::workspace::{list_files, project_root, read_text, target_folder};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Packs the crates, builds the programs and runs them. With `--time`, they are built in release
/// mode, and `peers` is timed.
pub fn run_strangers(flags: &[String]) -> Outcome {
    let is_timed = flags.iter().any(|flag| flag == "--time");
    let folder = target_folder().join("strangers");
    let (crates, programs) = (folder.join("crates"), folder.join("programs"));
    let _ = fs::remove_dir_all(&crates);
    let _ = fs::remove_dir_all(&programs);
    fs::create_dir_all(&crates).map_err(|error| error.to_string())?;
    package_crates(false)?;
    for archive in list_files(&target_folder().join("package-sources/target/package"), "crate")? {
        let mut tar = Command::new("tar");
        run_command(tar.arg("xzmf").arg(&archive).arg("-C").arg(&crates))?;
    }
    copy_programs(&project_root().join("tests/strangers"), &programs)?;
    let mut cargo = cargo_command(&["build", "--quiet", "--workspace", "--locked"]);
    if is_timed {
        cargo.arg("--release");
    }
    let target = folder.join("target");
    run_command(cargo.current_dir(&programs).env("CARGO_TARGET_DIR", &target))?;
    let profile = if is_timed { "release" } else { "debug" };
    for name in program_names(&programs)? {
        println!("{name}:");
        let mut program = Command::new(target.join(profile).join(&name));
        if is_timed && name == "peers" {
            program.arg("--time");
        }
        run_visibly(&mut program)?;
    }
    Ok(())
}

/// Copies the programs and points the patches in their workspace to the unpacked crates.
fn copy_programs(from: &Path, to: &Path) -> Outcome {
    for name in program_names(from)? {
        let sources = to.join(&name).join("src");
        fs::create_dir_all(&sources).map_err(|error| error.to_string())?;
        let manifest = Path::new(&name).join("Cargo.toml");
        copy(&from.join(&manifest), &to.join(&manifest))?;
        for source in list_files(&from.join(&name).join("src"), "rs")? {
            copy(&source, &sources.join(source.file_name().unwrap_or_default()))?;
        }
    }
    copy(&from.join("Cargo.lock"), &to.join("Cargo.lock"))?;
    let version = env!("CARGO_PKG_VERSION");
    let manifest = read_text(&from.join("Cargo.toml"))?;
    let lines = manifest.lines().map(|line| match line.split_once(" = { path = \"") {
        Some((name, _)) if name.starts_with("alberti-") => {
            format!("{name} = {{ path = \"../crates/{name}-{version}\" }}")
        }
        _ => line.to_owned(),
    });
    let manifest: Vec<String> = lines.collect();
    fs::write(to.join("Cargo.toml"), manifest.join("\n")).map_err(|error| error.to_string())
}

/// Returns the program folder names.
fn program_names(folder: &Path) -> Result<Vec<String>, String> {
    let entries = fs::read_dir(folder).map_err(|error| error.to_string())?;
    let is_program = |entry: &fs::DirEntry| entry.path().join("src/main.rs").exists();
    let names = entries.flatten().filter(is_program);
    let mut names: Vec<String> =
        names.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    Ok(names)
}

fn copy(from: &Path, to: &Path) -> Outcome {
    let failed = |error| format!("{}: {error}", from.display());
    fs::copy(from, to).map(drop).map_err(failed)
}
