//! Compares our pictures with reference pictures: only invisible differences are allowed.
//!
//! There are two sets. [`analytic`] computes the first set by ray tracing with the formulas of the
//! specification. The second set was made with three.js. It is in the folder `$REFERENCES`, or in
//! `shared/references` next to the repository, with its models below `$ASSETS` or `shared/assets`.
//! Each `NAME.json` specifies the camera, lights and time of `NAME.png`. The real program renders
//! the same scene, and the two pictures are scored. `NAME.png` in the printed folder shows our
//! picture, the reference and the difference side by side. The limits are in `limits.rs`. Arguments
//! that are not flags select pictures whose names contain them.

mod analytic;
mod limits;
mod picture;
mod score;
mod setup;

use alberti_tests::harness::{Arguments, Tally, data_folder, run_program};
use picture::Picture;
use score::{Score, score_picture};
use setup::Setup;
use std::path::Path;
use std::process::{Command, ExitCode};

pub fn run() -> ExitCode {
    run_program("references", |arguments| {
        score::compare_with_script()?;
        let program = alberti_tests::program_path()?;
        let computed = Path::new(env!("CARGO_TARGET_TMPDIR")).join("references");
        analytic::write_references(&computed)?;
        let mut tally = compare_references(&program, &computed, &computed, arguments)?;
        let folders = (data_folder("REFERENCES", "references")?, data_folder("ASSETS", "assets")?);
        if let (Some(references), Some(assets)) = folders {
            tally += compare_references(&program, &references, &assets, arguments)?;
        }
        Ok(tally)
    })
}

/// Renders all selected pictures in a folder and prints their scores.
fn compare_references(
    program: &Path,
    references: &Path,
    assets: &Path,
    arguments: &Arguments,
) -> Result<Tally, String> {
    println!("{}", references.display());
    let output = program.with_file_name("references");
    std::fs::create_dir_all(&output).map_err(|error| error.to_string())?;
    let mut tally = Tally::default();
    for name in reference_names(references)?.iter().filter(|name| arguments.select(name)) {
        let job = Job { program, references, assets, output: &output, name };
        match job.run() {
            Ok((score, limits, reason)) if limits.allow(&score) => {
                println!("passed {name:28} {score} {reason}");
                tally.pass(1);
            }
            Ok((score, ..)) => tally.fail(name, &score.to_string()),
            Err(error) => tally.fail(name, &error),
        }
    }
    println!("ours, reference, difference: {}", output.display());
    Ok(tally)
}

/// Returns the reference names in a folder, sorted.
fn reference_names(references: &Path) -> Result<Vec<String>, String> {
    let entries = std::fs::read_dir(references)
        .map_err(|error| format!("{}: {error}", references.display()))?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let setups = paths.filter(|path| path.extension().is_some_and(|e| e == "json"));
    let stems = setups.filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()));
    let mut names: Vec<String> = stems.collect();
    names.sort();
    Ok(names)
}

/// A picture to render and score.
struct Job<'a> {
    program: &'a Path,
    references: &'a Path,
    assets: &'a Path,
    output: &'a Path,
    name: &'a str,
}

impl Job<'_> {
    /// Renders the picture and scores it. Returns the score, its limits, and the reason if the
    /// limits are not the default.
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
