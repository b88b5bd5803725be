//! `alberti render`: renders scenes and models to PNG, or draws them as lines to SVG, PDF or DXF.
//!
//! ```text
//!  flags ─► tasks ─► for each: open ─► override ─► resolve ─► render ─► files ─► messages
//! ```
//! One call renders every input from every view. The plan is complete before the first model is
//! loaded, so that a bad output name costs nothing.

mod shared_scale;
pub(super) mod tasks;
mod watch;

use super::args::RenderArgs;
use super::format::OutputFormat;
use super::messages::{print_message, print_note, print_warnings};
use super::progress::Progress;
use super::render_job::RenderJob;
use super::unused_flags::find_unused_flags;
use super::{CliError, render_report, terminal_image};
use files::visible_path;
use hidden_line::{Agreement, DrawOptions, EdgeClass, HiddenEdges, SilhouetteMethod};
use import::{FileFormat, ImageLoading, ImportOptions};
use pipeline::{Origin, Scene, Timings};
use scene::Outputs;
use scene_file::closest_name;
use scene_file::file::SceneFile;
use scene_file::is_scene_file;
use std::collections::BTreeSet;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;
use tasks::RenderTask;

/// Renders all pictures. If one fails or differs from its reference, the others are still rendered.
///
/// The exit code is 1 if any picture failed or differs from its reference. A single failure is
/// returned and printed by `main`. With several pictures, each failure is printed at once after the
/// input's name, since `main` could report only one:
///
/// ```text
/// error: broken.glb: not a glTF file: …
/// ```
pub(crate) fn run(args: &RenderArgs) -> Result<ExitCode, CliError> {
    if args.watch {
        tasks::plan_tasks(args)?;
        let to_stdout = args.output.as_deref() == Some(Path::new("-"));
        watch::repeat(&args.inputs, to_stdout, || render_all(args).map(drop))?;
    }
    render_all(args)
}

/// Renders all pictures once.
fn render_all(args: &RenderArgs) -> Result<ExitCode, CliError> {
    let tasks = tasks::plan_tasks(args)?;
    // `> picture.png` is meant to receive the picture; a log file is not.
    let redirected = std::fs::read_link("/proc/self/fd/1").unwrap_or_default();
    if args.output.is_none() && OutputFormat::is_known(&redirected) {
        let output =
            tasks.first().and_then(|task| task.output.as_deref()).unwrap_or(Path::new("-"));
        let message = format!(
            "the picture is written to {}, not to the standard output; `-o -` writes it there",
            visible_path(output)
        );
        print_message("warning", &message);
    }
    let (mut code, mut told) = (ExitCode::SUCCESS, BTreeSet::new());
    for task in &tasks {
        match render_task(args, task) {
            Err(failure) if tasks.len() > 1 => {
                let (name, message) = (visible_path(&task.input), failure.to_message());
                let prefix = format!("{name}: ");
                // Most messages begin with the file they are about.
                let rest = message.strip_prefix(&prefix).unwrap_or(&message);
                let message = format!("{prefix}{rest}");
                if told.insert(message.clone()) {
                    print_message("error", &message);
                }
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
///
/// The overrides, the region and the passes are applied to the scene file in this order; then the
/// scene is resolved and rendered.
///
/// After the progress line is removed, messages come in a fixed order. The results of `--verify`,
/// `--timings` and `--show` come first, then the JSON report or the warnings, then the result of
/// `--compare`. With `--json`, warnings and comparison are part of the report and are not repeated.
///
/// Times are measured only if they will be printed: the stopwatch is cheap, but not free.
///
/// # Errors
/// Returns an error if the input is invalid, if flags contradict each other, or if a file cannot be
/// written. The output files are then unchanged, except if `--verify`, `--show` or the report fails
/// after they are written.
fn render_task(args: &RenderArgs, job: &RenderTask) -> Result<bool, CliError> {
    let progress = Progress::start("loading");
    let is_measured = args.timings || args.json;
    let timings = if is_measured { Timings::enabled() } else { Timings::default() };
    let import = ImportOptions {
        timings: timings.clone(),
        ..job.overrides.import_options(&args.load_options)
    };
    let (origin, mut file) = open_input(&job.input, &import)?;
    job.overrides.apply_to(&origin, &mut file)?;
    args.load_options.apply_crease_to(&mut file, !job.format.is_raster());
    args.region.apply_to(&mut file);
    args.passes.apply_to(&mut file);
    let outputs = Outputs::from_scene_file(&origin, &file)?;
    // Line drawings have no textures.
    let is_drawing = !job.format.is_raster() && outputs.passes.is_empty();
    let images = if is_drawing { ImageLoading::Headers } else { import.images };
    let options = job.overrides.resolve_options(ImportOptions { images, ..import });
    let mut scene = Scene::resolve(&origin, &file, &options)?;
    job.overrides.place_camera(&origin, &file, &mut scene)?;
    if args.same_scale {
        shared_scale::share_scale(&args.views, &origin, &file, &mut scene)?;
    }
    progress.enter_stage("rendering");
    let threads = thread_count(args.threads);
    let render_job =
        RenderJob { args, task: job, scene: &scene, outputs, threads, timings: &timings };
    let output = render_job.write_files(&progress)?;
    let agreement = args.verify.then(|| verify_drawing(&scene, threads)).transpose()?;
    drop(progress);
    if let Some(agreement) = agreement {
        print_note(&agreement_message(&agreement));
    }
    if args.timings {
        print_timings(&timings);
    }
    if args.show {
        terminal_image::print_image(&output)?;
    }
    let unused = find_unused_flags(args, job, &scene);
    if args.json {
        render_report::print_report(&render_job, &output, &unused)?;
    } else {
        unused.iter().for_each(|warning| print_message("warning", warning));
        print_warnings(&scene, &output.warnings, !job.format.is_raster());
    }
    Ok(output.matches_reference(args.json))
}

/// Compares the scene's line drawing without hidden lines (see `hidden-line/src/visibility`) with
/// the scene's z-buffer image.
///
/// The scene is drawn again without hidden lines, because hidden lines drawn solid or dashed would
/// count as visible.
///
/// The two methods have nothing in common after clip space: the drawing finds visibility from line
/// intersections, the image from pixel coverage and depth. An error in one is therefore unlikely to
/// occur in the other.
fn verify_drawing(scene: &Scene, threads: usize) -> Result<Agreement, CliError> {
    let style = scene.style.line_style();
    let options = DrawOptions { hidden_edges: HiddenEdges::Removed, ..style.to_draw_options() };
    let (subject, fill) = (scene.drawing_subject(), style.to_fill_options());
    let drawing =
        drawing::draw(&subject, &options, &fill, threads).map_err(pipeline::RenderError::from)?;
    let mut agreement = hidden_line::verify_with_z_buffer(&subject, &drawing.segments)
        .map_err(pipeline::RenderError::from)?;
    // Interpolated contours run inside facets, where the image shows no edge.
    if options.silhouettes == SilhouetteMethod::Interpolated {
        let is_contour = |index: usize| drawing.segments[index].class == EdgeClass::Silhouette;
        agreement.groundless_segments.retain(|(index, _)| !is_contour(*index));
        agreement.groundless_length = agreement.groundless_segments.iter().map(|s| s.1).sum();
    }
    Ok(agreement)
}

/// Returns the message of `--verify`.
///
/// The length is the total of all visible lines, in pixels; the percentage is the part behind the
/// z-buffer's surface. Up to about 0.2% is normal, because the image resolves only a quarter of a
/// pixel, while the drawing is exact. Lines across flat faces are errors, and are reported if there
/// are any.
fn agreement_message(agreement: &Agreement) -> String {
    let percent = 100.0 * agreement.disagreement_ratio();
    let (length, groundless) = (agreement.visible_length, agreement.groundless_length);
    let mut message = format!(
        "verified: {percent:.4}% of {length:.0} px of visible lines is hidden in the z-buffer image"
    );
    if groundless > 0.0 {
        message += &format!("; {groundless:.1} px cross flat faces, where it shows no edge");
    }
    message
}

/// Prints the time of each stage and their sum on the standard error stream.
///
/// A stage that ran several times has one row with the total. The last row, `all`, is the sum of
/// the rows above, not the time of the command; it is omitted if nothing was measured.
///
/// ```text
/// load            12.31 ms
/// write            1.07 ms
/// all             13.38 ms
/// ```
fn print_timings(timings: &Timings) {
    let stages = timings.stages();
    let all: Duration = stages.iter().map(|(_, took)| *took).sum();
    let rows = stages.iter().copied().chain((!stages.is_empty()).then_some(("all", all)));
    for (stage, took) in rows {
        let milliseconds = 1e3 * took.as_secs_f64();
        print_note(&format!("{stage:<10} {milliseconds:9.2} ms"));
    }
}

/// Opens a scene file with its includes, or creates a scene for a bare model.
///
/// `-` reads either from the standard input. Models are not loaded yet.
///
/// The scene of a bare model frames it from a three-quarter view, in studio light if the model has
/// no lights. It is an ordinary scene file in memory, so all flags work on both kinds of input.
///
/// # Errors
/// Returns an error if the scene or an include is unreadable, invalid, or outside allowed folders.
pub(super) fn open_input(
    input: &Path,
    options: &ImportOptions,
) -> Result<(Origin, SceneFile), CliError> {
    if input.as_os_str() == "-" {
        return open_stdin(options);
    }
    check_is_file(input)?;
    if input.to_str().is_none() {
        let name = visible_path(input);
        return Err(CliError::Usage(format!(
            "{name}: the file name is not UTF-8\n  = help: rename the file or its folder"
        )));
    }
    if is_scene_file(input) {
        Ok(Origin::read_scene_allowing(input, &options.allow_outside)?)
    } else {
        Ok(Origin::from_model_path(input))
    }
}

/// Rejects a folder or a missing file; for a missing file, suggests what was probably meant.
///
/// Other reasons why a file cannot be read are detected and explained where it is read.
fn check_is_file(input: &Path) -> Result<(), CliError> {
    let name = visible_path(input);
    if input.is_dir() {
        return Err(CliError::Usage(format!(
            "{name} is a folder\n  = help: `alberti batch {name} --out-dir DIR` renders every model in it"
        )));
    }
    let Some(wanted) = input.file_name().filter(|_| !input.exists()) else { return Ok(()) };
    let folder = input.parent().filter(|folder| !folder.as_os_str().is_empty());
    let entries = std::fs::read_dir(folder.unwrap_or(Path::new("."))).into_iter().flatten();
    let mut names: Vec<String> =
        entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    let is_readable = |name: &&str| {
        is_scene_file(Path::new(name)) || FileFormat::from_extension(Path::new(name)).is_some()
    };
    let names: Vec<&str> = names.iter().map(String::as_str).filter(is_readable).collect();
    let help = match closest_name(&wanted.to_string_lossy(), &names) {
        Some(similar) => {
            Some(format!("did you mean `{}`?", visible_path(input.with_file_name(similar))))
        }
        None => missing_input_help(input),
    };
    let missing =
        |help| CliError::Usage(format!("{name}: the file does not exist\n  = help: {help}"));
    help.map_or(Ok(()), |help| Err(missing(help)))
}

/// Returns help for an input that does not name a file: a pattern that the shell did not expand, a
/// URL, or a word that belongs to a flag.
pub(super) fn missing_input_help(input: &Path) -> Option<String> {
    let word = input.to_string_lossy();
    if word.contains("://") {
        return Some(format!(
            "models are not downloaded; download the file first, as in `curl -O {word}`"
        ));
    }
    if word.contains(['*', '?']) {
        return Some(
            "this pattern matches no file, or was quoted; remove the quotation marks, or run \
             `alberti batch models --out-dir pictures` for all models in a folder"
                .to_owned(),
        );
    }
    if word.starts_with(['–', '—']) {
        return Some(
            "it begins with a dash; flags begin with two hyphens, as in `--size`".to_owned(),
        );
    }
    if word.ends_with(".json") {
        return Some(format!(
            "`--json` takes no value; redirect its report, as in `--json > {word}`"
        ));
    }
    matches!(&*word, "on" | "off" | "true" | "false" | "yes" | "no")
        .then(|| format!("the flag before it takes no value: omit `{word}`"))
}

/// Reads a model or a scene from the standard input.
///
/// A model is recognized by its content. Paths in a scene are relative to the current folder.
///
/// A scene is a RON struct, and no model begins like one, so the two cannot be confused. A model
/// must be self-contained: there is no folder in which to find its buffers and images.
fn open_stdin(options: &ImportOptions) -> Result<(Origin, SceneFile), CliError> {
    let bytes = read_stdin(options)?;
    if FileFormat::from_content(&bytes).is_some() {
        return Ok(Origin::from_model_bytes("stdin", bytes));
    }
    let text = String::from_utf8(bytes)
        .map_err(|_| stdin_error("it is neither a scene nor a model of a known format"))?;
    let origin = Origin::from_text("<stdin>", text, PathBuf::new());
    Ok(origin.parse_with_includes(&options.allow_outside)?)
}

/// Reads the bytes of the standard input.
///
/// At most `--max-file-bytes` are read, plus one byte to detect that there are more; an endless
/// stream therefore gives an error instead of filling the memory.
pub(super) fn read_stdin(options: &ImportOptions) -> Result<Vec<u8>, CliError> {
    let limit = options.limits.file_bytes;
    let mut bytes = Vec::new();
    let read = std::io::stdin().lock().take(limit.saturating_add(1)).read_to_end(&mut bytes);
    read.map_err(|cause| stdin_error(&cause.to_string()))?;
    if bytes.len() as u64 > limit {
        let why = format!("it has more than {limit} bytes; raise --max-file-bytes");
        return Err(stdin_error(&why));
    }
    Ok(bytes)
}

/// Returns the error for an unreadable standard input.
fn stdin_error(why: &str) -> CliError {
    CliError::Usage(format!("cannot read the standard input: {why}"))
}

/// Returns the requested number of threads, or one per core.
///
/// One thread is used if the system does not report its cores. The number never changes the output:
/// tiles and bands are independent of it.
pub(super) fn thread_count(wanted: Option<u16>) -> usize {
    let all = || std::thread::available_parallelism().map_or(1, Into::into);
    wanted.map_or_else(all, usize::from)
}
