//! `alberti render`: a scene or a bare model becomes a PNG, or as a line drawing an SVG or a PDF.

use super::args::RenderArgs;
use super::format::Format;
use super::progress::Progress;
use super::{Failure, complain};
use pipeline::drawing::{self, Agreement, Hidden, Options};
use pipeline::import::ImportOptions;
use pipeline::scene::ResolveOptions;
use pipeline::scene::file::SceneFile;
use pipeline::{Origin, Scene, Timings, draw, render_reported};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The most warnings of one model that are told; the rest is counted.
const MOST_WARNINGS: usize = 8;

pub(crate) fn run(args: &RenderArgs) -> Result<(), Failure> {
    let output = output_of(args)?;
    let format = Format::of(&output)?;
    let progress = Progress::start("loading");
    let (origin, mut file) = open(&args.input)?;
    args.look.override_in(&mut file);
    let timings = if args.timings { Timings::measuring() } else { Timings::default() };
    let import = ImportOptions { timings: timings.clone(), ..args.look.import(&args.load) };
    let options = ResolveOptions { import };
    let scene = Scene::resolve(&origin, &file, &options)?;
    progress.stage("rendering");
    let (bytes, warnings) = match format {
        Format::Png => {
            let (picture, warnings) = render_reported(&scene, threads(args.threads), &timings)?;
            (timings.measure("encode", || picture.to_png()), warnings)
        }
        Format::Svg | Format::Pdf => {
            let mut page = draw(&scene, threads(args.threads), &timings)?;
            let warnings = std::mem::take(&mut page.warnings);
            (timings.measure("encode", || format.vectors(&[page])), warnings)
        }
    };
    progress.stage("writing");
    timings.measure("write", || pipeline::write_file(&output, &bytes))?;
    let agreement = args.verify.then(|| compared(&scene, threads(args.threads))).transpose()?;
    drop(progress);
    if let Some(agreement) = agreement {
        // Nothing else can be done where nobody listens.
        let _ = writeln!(std::io::stderr(), "{}", told(&agreement));
    }
    tell(&timings);
    warn(&scene, &warnings);
    Ok(())
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

/// Tells what is wrong with the models, and what could not be drawn.
pub(super) fn warn(scene: &Scene, drawing: &[drawing::Warning]) {
    drawing.iter().for_each(|warning| complain("warning", &warning.to_string()));
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
