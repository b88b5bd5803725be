//! What the tests across crates share: where the project is, and the program they run as a process.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The top folder of the project.
#[must_use]
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

/// The program `alberti`: `$ALBERTI` if that is set, else a fresh build in the profile of the calling test.
///
/// # Errors
/// If `$ALBERTI` is no file, or the program does not build.
pub fn program() -> Result<PathBuf, String> {
    if let Some(path) = std::env::var_os("ALBERTI").map(PathBuf::from) {
        let missing = || format!("ALBERTI names {}, which is no file", path.display());
        return path.is_file().then(|| path.clone()).ok_or_else(missing);
    }
    // A test is target/PROFILE/deps/NAME-HASH; Cargo knows whether the program beside it is up to date.
    let test = std::env::current_exe().map_err(|error| error.to_string())?;
    let folder = test.ancestors().nth(2).ok_or("the test is in no target folder")?;
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.args(["build", "--quiet", "--package", "pipeline", "--bin", "alberti"]);
    if let Some(target) = folder.parent() {
        cargo.arg("--target-dir").arg(target);
    }
    if folder.ends_with("release") {
        cargo.arg("--release");
    }
    let status = cargo.current_dir(root()).status().map_err(|error| format!("cargo: {error}"))?;
    let path = folder.join(format!("alberti{}", std::env::consts::EXE_SUFFIX));
    if status.success() { Ok(path) } else { Err("the program does not build".to_owned()) }
}

/// The examples of the README are compiled and run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(test)]
mod tests {
    use super::root;

    #[test]
    fn the_scene_in_the_readme_is_the_committed_one() {
        let read = |name: &str| std::fs::read_to_string(root().join(name)).expect(name);
        let readme = read("README.md");
        let shown = readme.split("```ron\n").nth(1).and_then(|rest| rest.split("```").next());
        let scene = read("scenes/mexican_hat.ron");
        assert!(scene.ends_with(shown.expect("a scene in the README")));
    }
}
