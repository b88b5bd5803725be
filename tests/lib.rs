//! Code shared by the cross-crate tests:
//!
//! - the [harness] of the table-driven programs
//! - a corpus of [samples] with its [manifest]
//! - small [glTF documents](gltf) and [3MF files](threemf)
//! - the path of the program under test
//! - a PNG reader

#![allow(clippy::print_stdout, reason = "the harness prints for test programs")]

pub mod gltf;
pub mod harness;
pub mod manifest;
pub mod samples;
pub mod skip;
pub mod statistics;
pub mod threemf;

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The examples of the guide, which need several crates.
#[cfg(doctest)]
#[doc = include_str!("../docs/guide/embedding.md")]
pub struct EmbeddingGuide;

/// Returns the root folder of the repository.
#[must_use]
pub fn project_root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

/// Returns the program `alberti`: `$ALBERTI` if set, otherwise a fresh build in the profile of the
/// calling test.
///
/// # Errors
/// Returns an error if `$ALBERTI` does not name a file or if the program does not build.
pub fn program_path() -> Result<PathBuf, String> {
    if let Some(path) = std::env::var_os("ALBERTI").map(PathBuf::from) {
        let missing = || format!("ALBERTI names {}, which is not a file", path.display());
        return path.is_file().then(|| path.clone()).ok_or_else(missing);
    }
    // A test is at target/PROFILE/deps/NAME-HASH. Cargo determines whether the program in
    // target/PROFILE is up to date.
    let test = std::env::current_exe().map_err(|error| error.to_string())?;
    let folder = test.ancestors().nth(2).ok_or("the test is not in a target folder")?;
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    // As in `cargo xtask test`, using the features of the whole workspace avoids compiling anything
    // twice.
    cargo.args(["build", "--quiet", "--workspace", "--bin", "alberti"]);
    if let Some(target) = folder.parent() {
        cargo.arg("--target-dir").arg(target);
    }
    if folder.ends_with("release") {
        cargo.arg("--release");
    }
    let status =
        cargo.current_dir(project_root()).status().map_err(|error| format!("cargo: {error}"))?;
    let path = folder.join(format!("alberti{}", std::env::consts::EXE_SUFFIX));
    if status.success() { Ok(path) } else { Err("the program does not build".to_owned()) }
}

/// Returns the width, height and 8-bit RGBA pixels of a PNG, with rows from the top.
///
/// # Errors
/// Returns an error that names the file if it cannot be read or is not a PNG.
pub fn read_png(path: &Path) -> Result<(u32, u32, Vec<[u8; 4]>), String> {
    let with_path = |error: String| format!("{}: {error}", path.display());
    let file = File::open(path).map_err(|error| with_path(error.to_string()))?;
    decode_png(BufReader::new(file)).map_err(with_path)
}

fn decode_png(source: BufReader<File>) -> Result<(u32, u32, Vec<[u8; 4]>), String> {
    let mut decoder = png::Decoder::new(source);
    decoder.set_transformations(
        png::Transformations::normalize_to_color8() | png::Transformations::ALPHA,
    );
    let mut reader = decoder.read_info().map_err(|error| error.to_string())?;
    let mut bytes = vec![0; reader.output_buffer_size().ok_or("too large")?];
    let info = reader.next_frame(&mut bytes).map_err(|error| error.to_string())?;
    let pixels = match info.color_type {
        png::ColorType::Rgba => bytes.as_chunks().0.to_vec(),
        png::ColorType::GrayscaleAlpha => {
            bytes.as_chunks().0.iter().map(|&[gray, alpha]| [gray, gray, gray, alpha]).collect()
        }
        other => return Err(format!("unexpected color type {other:?}")),
    };
    Ok((info.width, info.height, pixels))
}

/// The examples of the README are compiled and run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(test)]
mod tests {
    use super::project_root;

    #[test]
    fn the_scene_in_the_readme_matches_the_committed_file() {
        let read = |name: &str| std::fs::read_to_string(project_root().join(name)).expect(name);
        let readme = read("README.md");
        let printed = readme.split("```ron\n").nth(1).and_then(|rest| rest.split("```").next());
        let scene = read("scenes/mexican_hat.ron");
        assert!(scene.ends_with(printed.expect("a scene in the README")));
    }
}
