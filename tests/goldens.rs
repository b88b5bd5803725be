//! Golden images: the real program renders every scene of `scenes/` to exactly the pixels of
//! `tests/goldens/NAME.png`.
//!
//! The comparison is by pixels, not bytes, so that a new release of the PNG encoder changes
//! nothing. If the pixels differ, the new picture and a map of the differences are saved as
//! `NAME.actual.png` and `NAME.diff.png` in the goldens folder. `cargo xtask golden --bless NAME`
//! accepts a picture as the new golden after someone has looked at it. Arguments that are not flags
//! select scenes whose names contain them.

mod picture;

use alberti_tests::harness::{Tally, run_program};
use alberti_tests::project_root;
use picture::{Difference, Picture};
use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode};

pub fn run() -> ExitCode {
    run_program("goldens", |arguments| {
        let program = alberti_tests::program_path()?;
        let mut tally = Tally::default();
        for name in scene_names()?.iter().filter(|name| arguments.select(name)) {
            tally.record(name, compare_scene(&program, name));
        }
        Ok(tally)
    })
}

/// Returns the scene names. `cargo xtask tidy` finds goldens without a scene.
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

/// Renders a scene and compares it with its golden.
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

/// Removes a file that an earlier run may have left.
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
