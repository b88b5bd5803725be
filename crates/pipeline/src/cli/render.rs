//! `alberti render`: a scene or a bare model becomes a PNG, or as a line drawing an SVG or a PDF.

use super::args::RenderArgs;
use super::format::Format;
use super::paint::Painting;
use super::progress::Progress;
use super::{Failure, complain, report, show};
use pipeline::drawing::{self, Agreement, Hidden, Options};
use pipeline::import::ImportOptions;
use pipeline::scene::file::SceneFile;
use pipeline::scene::{Outputs, ResolveOptions};
use pipeline::{Origin, Scene, Timings};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

/// The most warnings of one model that are told; the rest is counted.
const MOST_WARNINGS: usize = 8;

pub(crate) fn run(args: &RenderArgs) -> Result<ExitCode, Failure> {
    let output = output_of(args)?;
    let format = Format::of(&output)?;
    let progress = Progress::start("loading");
    let (origin, mut file) = open(&args.input)?;
    args.look.override_in(&mut file);
    args.part.override_in(&mut file);
    args.passes.override_in(&mut file);
    let timings = if args.timings || args.json { Timings::measuring() } else { Timings::default() };
    let import = ImportOptions { timings: timings.clone(), ..args.load.options() };
    let outputs = Outputs::of(&origin, &file)?;
    let scene = Scene::resolve(&origin, &file, &ResolveOptions { import })?;
    progress.stage("rendering");
    let threads = threads(args.threads);
    let painting =
        Painting { args, scene: &scene, outputs, output, format, threads, timings: &timings };
    let painted = painting.write(&progress)?;
    let agreement = args.verify.then(|| compared(&scene, threads)).transpose()?;
    drop(progress);
    if let Some(agreement) = agreement {
        // Nothing else can be done where nobody listens.
        let _ = writeln!(std::io::stderr(), "{}", told(&agreement));
    }
    if args.timings {
        tell(&timings);
    }
    if args.show {
        show::show(&painted)?;
    }
    if args.json {
        report::tell(&painting, &painted)?;
    } else {
        warn(&scene);
    }
    Ok(painted.verdict(args.json))
}

/// The scene's line drawing against its z-buffer image. Lines that show hidden parts as visible are left out of it.
fn compared(scene: &Scene, threads: usize) -> Result<Agreement, Failure> {
    let options = Options { hidden: Hidden::Removed, ..scene.style.line_look().options() };
    let drawing = drawing::draw(scene, &options, threads)?;
    Ok(drawing::verify(scene, &drawing)?)
}

fn told(agreement: &Agreement) -> String {
    let share = 100.0 * agreement.disagreement();
    let length = agreement.visible;
    format!(
        "verified: {share:.4} % of {length:.0} px of visible lines is hidden in the z-buffer image"
    )
}

/// What each stage took, and all together, on the standard error.
fn tell(timings: &Timings) {
    let stages = timings.stages();
    let all: Duration = stages.iter().map(|(_, took)| *took).sum();
    let rows = stages.iter().copied().chain((!stages.is_empty()).then_some(("all", all)));
    for (stage, took) in rows {
        let milliseconds = 1e3 * took.as_secs_f64();
        // Nothing else can be done where nobody listens.
        let _ = writeln!(std::io::stderr(), "{stage:<10} {milliseconds:9.2} ms");
    }
}

/// Whether a file is a scene, by its name.
pub(super) fn is_scene(input: &Path) -> bool {
    input.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("ron"))
}

/// A scene file, or the scene of a bare model.
pub(super) fn open(input: &Path) -> Result<(Origin, SceneFile), Failure> {
    if is_scene(input) { Ok(Origin::read(input)?) } else { Ok(Origin::bare_model(input)) }
}

fn output_of(args: &RenderArgs) -> Result<PathBuf, Failure> {
    if let Some(output) = &args.output {
        return Ok(output.clone());
    }
    let stem = args.input.file_stem();
    let stem = stem.ok_or_else(|| Failure::Usage("name the output with -o FILE".to_owned()))?;
    let mut name = stem.to_owned();
    name.push(".png");
    Ok(PathBuf::from(name))
}

/// As many threads as are wanted, or as there are cores.
pub(super) fn threads(wanted: Option<u16>) -> usize {
    let all = || std::thread::available_parallelism().map_or(1, Into::into);
    wanted.map_or_else(all, usize::from)
}

pub(super) fn warn(scene: &Scene) {
    let mut told: Vec<&str> = Vec::new();
    for placed in &scene.models {
        let model = &placed.model;
        if told.contains(&model.name.as_str()) {
            continue;
        }
        told.push(&model.name);
        for warning in model.warnings.iter().take(MOST_WARNINGS) {
            let message = format!("{}: {}: {}", model.name, warning.pointer, warning.message);
            complain("warning", &message);
        }
        let rest = model.warnings.len().saturating_sub(MOST_WARNINGS);
        if rest > 0 {
            complain("warning", &format!("{}: {rest} more warnings", model.name));
        }
    }
}
