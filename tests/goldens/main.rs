//! The golden images: every scene of `scenes/`, drawn by the real program at its own size, must
//! have the very pixels of `tests/goldens/NAME.png`.
//!
//! Pixels are compared, not bytes, so that a new release of the PNG encoder changes nothing. Where
//! they differ, the new picture and a map of the differences are left beside the golden as
//! `NAME.actual.png` and `NAME.diff.png`. `cargo xtask golden --bless NAME` makes a picture golden
//! after someone has looked at it. Arguments that are not flags choose scenes by name.

#![allow(clippy::print_stdout, reason = "a test program speaks on its standard output")]
#![allow(unreachable_pub, reason = "the modules of a program have no other outside")]

mod picture;

use alberti_tests::project_root;
use picture::{Difference, Picture};
use std::path::Path;
use std::process::{Command, ExitCode};
use std::{env, fs};

fn main() -> ExitCode {
    match compare_goldens() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            println!("FAILED goldens: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Whether all chosen scenes have their golden's pixels.
fn compare_goldens() -> Result<bool, String> {
    let chosen: Vec<String> = env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let wanted = |name: &String| chosen.is_empty() || chosen.contains(name);
    let program = alberti_tests::program_path()?;
    let (mut passed, mut failed) = (0, 0);
    for name in scene_names()?.iter().filter(|name| wanted(name)) {
        match compare_scene(&program, name) {
            Ok(()) => passed += 1,
            Err(message) => {
                failed += 1;
                println!("FAILED {name}: {message}");
            }
        }
    }
    println!("goldens: {passed} passed, {failed} failed");
    Ok(failed == 0 && passed > 0)
}

/// The scenes by name. Goldens that no scene makes are found by `cargo xtask tidy`.
fn scene_names() -> Result<Vec<String>, String> {
    let entries =
        fs::read_dir(project_root().join("scenes")).map_err(|error| format!("scenes: {error}"))?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let scenes = paths.filter(|path| path.extension().is_some_and(|extension| extension == "ron"));
    let mut names: Vec<String> =
        scenes.filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned())).collect();
    names.sort();
    Ok(names)
}

/// Draws a scene and holds it against its golden.
fn compare_scene(program: &Path, name: &str) -> Result<(), String> {
    let beside =
        |ending: &str| project_root().join("tests/goldens").join(format!("{name}{ending}"));
    let actual_path = beside(".actual.png");
    render_scene(program, &project_root().join(format!("scenes/{name}.ron")), &actual_path)?;
    let actual = Picture::read_png(&actual_path)?;
    let golden = Picture::read_png(&beside(".png")).map_err(|error| {
        format!(
            "{error}\n  Look at {name}.actual.png; \
             `cargo xtask golden --bless {name}` if it is right."
        )
    })?;
    match golden.difference(&actual) {
        None => {
            remove_file(&actual_path);
            remove_file(&beside(".diff.png"));
            Ok(())
        }
        Some(Difference::Size(message)) => Err(message),
        Some(Difference::Pixels { message, map }) => {
            map.write_png(&beside(".diff.png"))?;
            Err(format!("{message}\n  See tests/goldens/{name}.actual.png and {name}.diff.png."))
        }
    }
}

/// What an earlier run left; nothing is there to be removed most of the time.
fn remove_file(path: &Path) {
    let _ = fs::remove_file(path);
}

fn render_scene(program: &Path, scene: &Path, picture: &Path) -> Result<(), String> {
    let mut command = Command::new(program);
    let output = command.arg("render").arg(scene).arg("-o").arg(picture).output();
    let output = output.map_err(|error| format!("{}: {error}", program.display()))?;
    if output.status.success() {
        return Ok(());
    }
    Err(format!("{} ({})", String::from_utf8_lossy(&output.stderr).trim(), output.status))
}
