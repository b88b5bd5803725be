//! `alberti render`: renders scenes and models to PNG, or draws them as lines to SVG or PDF.

pub(super) mod tasks;

use super::args::RenderArgs;
use super::progress::Progress;
use super::render_job::RenderJob;
use super::{CliError, print_message, render_report, terminal_image};
use drawing::{self, Agreement, DrawOptions, HiddenEdges};
use model::import::ImportOptions;
use pipeline::scene::file::SceneFile;
use pipeline::scene::{Outputs, ResolveOptions};
use pipeline::{Origin, Scene, Timings};
use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;
use tasks::RenderTask;

/// The number of warnings of one model that are printed; the others are only counted.
const MAX_WARNINGS: usize = 8;

/// Renders all pictures. With several, a failure or a difference does not stop the others.
pub(crate) fn run(args: &RenderArgs) -> Result<ExitCode, CliError> {
    let jobs = tasks::plan_tasks(args)?;
    let mut code = ExitCode::SUCCESS;
    for job in &jobs {
        match render_task(args, job) {
            Err(failure) if jobs.len() > 1 => {
                print_message(
                    "error",
                    &format!("{}: {}", job.input.display(), failure.to_message()),
                );
                code = ExitCode::FAILURE;
            }
            Ok(false) => code = ExitCode::FAILURE,
            made => {
                made?;
            }
        }
    }
    Ok(code)
}

/// Renders one picture; returns whether it agrees with its reference, if it has one.
fn render_task(args: &RenderArgs, job: &RenderTask) -> Result<bool, CliError> {
    let progress = Progress::start("loading");
    let timings = if args.timings || args.json { Timings::enabled() } else { Timings::default() };
    let import = ImportOptions {
        timings: timings.clone(),
        ..job.overrides.import_options(&args.load_options)
    };
    let (origin, mut file) = open_input(&job.input, &import)?;
    job.overrides.apply_to(&mut file);
    args.region.apply_to(&mut file);
    args.passes.apply_to(&mut file);
    let outputs = Outputs::from_scene_file(&origin, &file)?;
    let scene = Scene::resolve(&origin, &file, &ResolveOptions { import })?;
    progress.enter_stage("rendering");
    let threads = thread_count(args.threads);
    let painting =
        RenderJob { args, task: job, scene: &scene, outputs, threads, timings: &timings };
    let painted = painting.write_files(&progress)?;
    let agreement = args.verify.then(|| verify_drawing(&scene, threads)).transpose()?;
    drop(progress);
    if let Some(agreement) = agreement {
        // A closed stream is not an error.
        let _ = writeln!(std::io::stderr(), "{}", agreement_message(&agreement));
    }
    if args.timings {
        print_timings(&timings);
    }
    if args.show {
        terminal_image::print_image(&painted)?;
    }
    if args.json {
        render_report::print_report(&painting, &painted)?;
    } else {
        print_warnings(&scene, &painted.warnings);
    }
    Ok(painted.matches_reference(args.json))
}

/// Compares the scene's line drawing with its z-buffer image, with hidden lines removed.
fn verify_drawing(scene: &Scene, threads: usize) -> Result<Agreement, CliError> {
    let options = DrawOptions {
        hidden_edges: HiddenEdges::Removed,
        ..scene.style.line_style().to_draw_options()
    };
    let drawing = drawing::draw(&scene.drawing_subject(), &options, threads)
        .map_err(pipeline::RenderError::from)?;
    Ok(drawing::verify_with_z_buffer(&scene.drawing_subject(), &drawing)
        .map_err(pipeline::RenderError::from)?)
}

/// The message of `--verify`.
fn agreement_message(agreement: &Agreement) -> String {
    let percent = 100.0 * agreement.disagreement_ratio();
    let length = agreement.visible_length;
    format!(
        "verified: {percent:.4} % of {length:.0} px of visible lines is hidden in the z-buffer image"
    )
}

/// Prints the time of each stage and their sum on the standard error stream.
fn print_timings(timings: &Timings) {
    let stages = timings.stages();
    let all: Duration = stages.iter().map(|(_, took)| *took).sum();
    let rows = stages.iter().copied().chain((!stages.is_empty()).then_some(("all", all)));
    for (stage, took) in rows {
        let milliseconds = 1e3 * took.as_secs_f64();
        // A closed stream is not an error.
        let _ = writeln!(std::io::stderr(), "{stage:<10} {milliseconds:9.2} ms");
    }
}

/// Whether a file is a scene, by its extension.
pub(super) fn is_scene_file(input: &Path) -> bool {
    input.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("ron"))
}

/// Opens a scene file with its includes, or makes a scene for a bare model.
///
/// `-` reads either from the standard input. Models are not loaded yet.
pub(super) fn open_input(
    input: &Path,
    options: &ImportOptions,
) -> Result<(Origin, SceneFile), CliError> {
    if input.as_os_str() == "-" {
        return open_stdin(options);
    }
    if is_scene_file(input) {
        Ok(Origin::read_scene_allowing(input, &options.allow_outside)?)
    } else {
        Ok(Origin::from_model_path(input))
    }
}

/// Reads a model or a scene from the standard input.
///
/// A model is recognized by its first bytes, `glTF` or `{`. Paths of a scene are relative to the
/// current folder.
fn open_stdin(options: &ImportOptions) -> Result<(Origin, SceneFile), CliError> {
    let limit = options.limits.file_bytes;
    let mut bytes = Vec::new();
    let read = std::io::stdin().lock().take(limit.saturating_add(1)).read_to_end(&mut bytes);
    let fault = |why: String| CliError::Usage(format!("cannot read the standard input: {why}"));
    read.map_err(|cause| fault(cause.to_string()))?;
    if bytes.len() as u64 > limit {
        return Err(fault(format!("it has more than {limit} bytes; --max-file-bytes allows more")));
    }
    let is_json = bytes.trim_ascii_start().starts_with(b"{");
    if is_json || bytes.starts_with(b"glTF") {
        return Ok(Origin::from_model_bytes("stdin", bytes));
    }
    let text = String::from_utf8(bytes)
        .map_err(|_| fault("it is neither a scene nor a model in glTF's binary form".to_owned()))?;
    let origin = Origin::from_text("<stdin>", text, PathBuf::new());
    Ok(origin.parse_with_includes(&options.allow_outside)?)
}

/// The requested number of threads, or one per core.
pub(super) fn thread_count(wanted: Option<u16>) -> usize {
    let all = || std::thread::available_parallelism().map_or(1, Into::into);
    wanted.map_or_else(all, usize::from)
}

/// Prints the warnings of a drawing, then those of each model once.
pub(super) fn print_warnings(scene: &Scene, drawing: &[drawing::Warning]) {
    drawing.iter().for_each(|warning| print_message("warning", &warning.to_string()));
    let mut printed: Vec<&str> = Vec::new();
    for placed in &scene.models {
        let model = &placed.model;
        if printed.contains(&model.name.as_str()) {
            continue;
        }
        printed.push(&model.name);
        for warning in model.warnings.iter().take(MAX_WARNINGS) {
            let message = format!("{}: {}: {}", model.name, warning.location, warning.message);
            print_message("warning", &message);
        }
        let rest = model.warnings.len().saturating_sub(MAX_WARNINGS);
        if rest > 0 {
            print_message("warning", &format!("{}: {rest} more warnings", model.name));
        }
    }
}
