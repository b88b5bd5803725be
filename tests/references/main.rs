//! Pictures that another renderer made of the shared models: ours must be the same but for what the eye does not see.
//!
//! The folder of the references is `$REFERENCES`, or `shared/references` beside the project; the models are below `$ASSETS`, or
//! `shared/assets`. Each `NAME.json` says with which camera, lights and time `NAME.png` was made. The real program draws the
//! same, the two are scored, and `NAME.png` in the folder that is printed at the end shows ours, theirs and the difference side
//! by side. The limits are in `limits.rs`. Arguments that are not flags choose pictures by a part of their name.

#![allow(clippy::print_stdout, reason = "a test program speaks on its standard output")]
#![allow(missing_docs, unreachable_pub, reason = "the modules of a program have no other outside")]

mod limits;
mod picture;
mod score;
mod setup;

use picture::Picture;
use score::{Score, score_picture};
use setup::Setup;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

fn main() -> ExitCode {
    if let Err(problem) = score::is_that_of_the_script() {
        println!("FAILED references: {problem}");
        return ExitCode::FAILURE;
    }
    let beside = |name: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared").join(name);
    let chosen = |variable: &str| std::env::var_os(variable).map(PathBuf::from);
    let references = chosen("REFERENCES").unwrap_or_else(|| beside("references"));
    let assets = chosen("ASSETS").unwrap_or_else(|| beside("assets"));
    let was_chosen = chosen("REFERENCES").is_some() || chosen("ASSETS").is_some();
    for folder in [&references, &assets] {
        if !was_chosen && !folder.is_dir() {
            println!("SKIPPED references: the folder {} was not found", folder.display());
            return ExitCode::SUCCESS;
        }
    }
    match compare_references(&references, &assets) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            println!("FAILED references: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Draws all pictures of a folder and prints their scores; returns how many are beyond their limits.
fn compare_references(references: &Path, assets: &Path) -> Result<usize, String> {
    let program = alberti_tests::program_path()?;
    let output = program.with_file_name("references");
    std::fs::create_dir_all(&output).map_err(|error| error.to_string())?;
    let (mut passed, mut failed) = (0, 0);
    for name in reference_names(references)? {
        let job = Job { program: &program, references, assets, output: &output, name: &name };
        match job.run() {
            Ok((score, limits, why)) => {
                let holds = limits.allow(&score);
                let verdict = if holds { "passed" } else { "FAILED" };
                println!("{verdict} {name:28} {score} {why}");
                if holds { passed += 1 } else { failed += 1 }
            }
            Err(error) => {
                println!("FAILED {name}: {error}");
                failed += 1;
            }
        }
    }
    println!("ours, theirs, difference: {}", output.display());
    println!("references: {passed} passed, {failed} failed");
    if passed + failed == 0 { Err("no such picture".to_owned()) } else { Ok(failed) }
}

/// The names of the references that are chosen.
fn reference_names(references: &Path) -> Result<Vec<String>, String> {
    let filters: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let chosen =
        |name: &str| filters.is_empty() || filters.iter().any(|f| name.contains(f.as_str()));
    let entries = std::fs::read_dir(references)
        .map_err(|error| format!("{}: {error}", references.display()))?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let setups = paths.filter(|path| path.extension().is_some_and(|e| e == "json"));
    let stems = setups.filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()));
    let mut names: Vec<String> = stems.filter(|name| chosen(name)).collect();
    names.sort();
    Ok(names)
}

/// One picture to draw and to score.
struct Job<'a> {
    program: &'a Path,
    references: &'a Path,
    assets: &'a Path,
    output: &'a Path,
    name: &'a str,
}

impl Job<'_> {
    fn run(&self) -> Result<(Score, limits::Limits, &'static str), String> {
        let file = |ending: &str| self.references.join(format!("{}.{ending}", self.name));
        let setup = Setup::read_json(&file("json"))?;
        let reference = Picture::read_png(&file("png"))?;
        let full =
            |path: &Path| path.canonicalize().map_err(|e| format!("{}: {e}", path.display()));
        let model = full(&self.assets.join(&setup.model))?;
        let ours = self.render_scene(&setup.scene_source(&model)?, &full(self.assets)?)?;
        let score = score_picture(&ours, &reference).ok_or("the sizes differ")?;
        ours.side_by_side(&reference).write_png(&self.output.join(format!("{}.png", self.name)))?;
        let (limits, why) = limits::limits_for(self.name, &model);
        Ok((score, limits, why))
    }

    fn render_scene(&self, scene: &str, assets: &Path) -> Result<Picture, String> {
        let path = self.output.join(format!("{}.ron", self.name));
        let picture = self.output.join(format!("{}.ours.png", self.name));
        std::fs::write(&path, scene).map_err(|error| error.to_string())?;
        let mut command = Command::new(self.program);
        command.arg("render").arg(&path).arg("-o").arg(&picture).arg("--allow-outside").arg(assets);
        let run = command.output().map_err(|error| error.to_string())?;
        if !run.status.success() {
            return Err(String::from_utf8_lossy(&run.stderr).trim().to_owned());
        }
        Picture::read_png(&picture)
    }
}
