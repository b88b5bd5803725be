//! `alberti render`: scenes and bare models become PNGs, or as line drawings SVGs or PDFs.

pub(super) mod jobs;

use super::args::RenderArgs;
use super::paint::Painting;
use super::progress::Progress;
use super::{Failure, complain, report, show};
use drawing::{self, Agreement, Hidden, Options};
use jobs::Job;
use model::import::ImportOptions;
use pipeline::scene::file::SceneFile;
use pipeline::scene::{Outputs, ResolveOptions};
use pipeline::{Origin, Scene, Timings};
use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

/// The most warnings of one model that are told; the rest is counted.
const MOST_WARNINGS: usize = 8;

/// Makes the pictures; one that cannot be made, or is not what it should be, does not stop the others.
pub(crate) fn run(args: &RenderArgs) -> Result<ExitCode, Failure> {
    let jobs = jobs::of(args)?;
    let mut code = ExitCode::SUCCESS;
    for job in &jobs {
        match one(args, job) {
            Err(failure) if jobs.len() > 1 => {
                complain("error", &format!("{}: {}", job.input.display(), failure.told()));
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

/// Makes one picture. Whether it is what it was compared with.
fn one(args: &RenderArgs, job: &Job) -> Result<bool, Failure> {
    let progress = Progress::start("loading");
    let timings = if args.timings || args.json { Timings::measuring() } else { Timings::default() };
    let import = ImportOptions { timings: timings.clone(), ..job.look.import(&args.load) };
    let (origin, mut file) = open(&job.input, &import)?;
    job.look.override_in(&mut file);
    args.part.override_in(&mut file);
    args.passes.override_in(&mut file);
    let outputs = Outputs::of(&origin, &file)?;
    let scene = Scene::resolve(&origin, &file, &ResolveOptions { import })?;
    progress.stage("rendering");
    let threads = threads(args.threads);
    let painting = Painting { args, job, scene: &scene, outputs, threads, timings: &timings };
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
        warn(&scene, &painted.warnings);
    }
    Ok(painted.agrees(args.json))
}

/// The scene's line drawing against its z-buffer image. Lines that show hidden parts as visible are left out of it.
fn compared(scene: &Scene, threads: usize) -> Result<Agreement, Failure> {
    let options = Options { hidden: Hidden::Removed, ..scene.style.line_look().options() };
    let drawing =
        drawing::draw(&scene.subject(), &options, threads).map_err(pipeline::RenderError::from)?;
    Ok(drawing::verify(&scene.subject(), &drawing).map_err(pipeline::RenderError::from)?)
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

/// A scene file, with those it includes, or the scene of a bare model; `-` reads either from the standard input.
pub(super) fn open(input: &Path, options: &ImportOptions) -> Result<(Origin, SceneFile), Failure> {
    if input.as_os_str() == "-" {
        return read_stdin(options);
    }
    if is_scene(input) {
        Ok(Origin::read_below(input, &options.allow_outside)?)
    } else {
        Ok(Origin::bare_model(input))
    }
}

/// A model if it begins like one, in binary or as JSON; else a scene, whose paths begin at the current folder.
fn read_stdin(options: &ImportOptions) -> Result<(Origin, SceneFile), Failure> {
    let most = options.limits.file_bytes;
    let mut bytes = Vec::new();
    let read = std::io::stdin().lock().take(most.saturating_add(1)).read_to_end(&mut bytes);
    let fault = |why: String| Failure::Usage(format!("cannot read the standard input: {why}"));
    read.map_err(|cause| fault(cause.to_string()))?;
    if bytes.len() as u64 > most {
        return Err(fault(format!("it has more than {most} bytes; --max-file-bytes allows more")));
    }
    let is_json = bytes.trim_ascii_start().starts_with(b"{");
    if is_json || bytes.starts_with(b"glTF") {
        return Ok(Origin::model_in_memory("stdin", bytes));
    }
    let text = String::from_utf8(bytes)
        .map_err(|_| fault("it is neither a scene nor a model in glTF's binary form".to_owned()))?;
    let origin = Origin::of_text("<stdin>", text, PathBuf::new());
    Ok(origin.with_includes(&options.allow_outside)?)
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
