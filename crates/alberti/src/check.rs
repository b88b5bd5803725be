//! `alberti check` and `alberti scene check`: validation of scenes and models.
//!
//! For a scene, the report lists its errors, lints for values that are probably unintended, and the
//! diagnostics of each model it refers to. A glTF file is validated against the glTF 2.0
//! specification; for other formats, the diagnostics come from the importer.
//!
//! The report is printed to the standard output even if it is full of errors, which are a result
//! here, not a failure. Only a problem that keeps the check from running, such as a missing scene,
//! is printed as `error:`. The exit code is 1 in both cases.

mod json;

use super::args::CheckArgs;
use super::load_options::LoadArgs;
use super::render::read_stdin;
use super::{CliError, color, print_json, print_text};
use files::visible_path;
use gltf_check::{CheckReport, check_file};
use import::ImportOptions;
use pipeline::{Origin, ResolveError, SceneError, SceneFile};
use scene::{Lint, ResolveOptions, lint_description, lint_scene, validate_scene};
use scene_file::is_scene_file;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Arguments of `alberti scene check`.
#[derive(Debug, clap::Args)]
pub(crate) struct CheckScenesArgs {
    /// Scenes (.ron); `-` is the standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    load_options: LoadArgs,
}

/// The results for one input: a scene with its models, or a bare model.
///
/// Text and JSON are both derived from it, so they cannot disagree.
struct CheckResult {
    /// The path of the input.
    file: PathBuf,
    /// The scene's errors; `None` if the input is a model.
    scene: Option<Vec<SceneError>>,
    /// Lints: scene values that are valid but probably unintended.
    advice: Vec<Lint>,
    /// The reports of the models.
    models: Vec<CheckReport>,
}

/// Validates a scene or a model; the exit code is 1 if there are errors.
///
/// # Errors
/// Returns an error if a scene file cannot be read. If a model cannot be read, the error is part of
/// its report instead, so that a scene with a missing model is still checked to the end.
pub(crate) fn run(args: &CheckArgs) -> Result<ExitCode, CliError> {
    let options = args.load_options.import_options();
    let findings = if is_scene_file(&args.input) {
        check_scene(&args.input, &options)?
    } else {
        let models = vec![check_file(&args.input, &options)];
        CheckResult { file: args.input.clone(), scene: None, advice: Vec::new(), models }
    };
    if args.json {
        print_json(&json::file_report(&findings))?;
    } else {
        print_text(&findings.to_text())?;
    }
    Ok(exit_code(findings.error_count()))
}

/// Validates scenes and their models; the exit code is 1 if there are errors.
///
/// Checks all files before printing anything; stops at the first file that cannot be read.
pub(crate) fn run_scenes(args: &CheckScenesArgs) -> Result<ExitCode, CliError> {
    let options = args.load_options.import_options();
    let check = |path: &PathBuf| check_scene(path, &options);
    let findings = args.files.iter().map(check).collect::<Result<Vec<_>, _>>()?;
    if args.json {
        print_json(&json::scenes_report(&findings))?;
    } else {
        print_text(&findings.iter().map(CheckResult::to_text).collect::<String>())?;
    }
    Ok(exit_code(findings.iter().map(CheckResult::error_count).sum()))
}

/// Returns 1 if there are errors, otherwise 0.
fn exit_code(errors: usize) -> ExitCode {
    if errors == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Validates a scene and its models.
///
/// For a file that cannot be parsed, only syntax errors are reported. Most lints need a resolved
/// scene, so they run only if there are no errors.
///
/// The order is: parse, resolve as `render` would, lint, check the models. The models are checked
/// even if the scene has errors, unless it cannot be parsed.
fn check_scene(input: &Path, options: &ImportOptions) -> Result<CheckResult, CliError> {
    let name = if input.as_os_str() == "-" { Path::new("<stdin>") } else { input };
    let found = |scene, advice, models| CheckResult {
        file: name.to_owned(),
        scene: Some(scene),
        advice,
        models,
    };
    let read = if input.as_os_str() == "-" {
        let text = String::from_utf8_lossy(&read_stdin(options)?).into_owned();
        let origin = Origin::from_text("<stdin>", text, PathBuf::new());
        origin.parse_with_includes(&options.allow_outside)
    } else {
        Origin::read_scene_allowing(input, &options.allow_outside)
    };
    let (origin, file) = match read {
        Err(ResolveError::Scene(mistake)) => {
            return Ok(found(mistake.into(), Vec::new(), Vec::new()));
        }
        read => read?,
    };
    let resolve = ResolveOptions::with_import(options.clone());
    let (scene, mistakes) = validate_scene(&origin, &file, &resolve);
    let advice = match scene.filter(|_| mistakes.is_empty()) {
        Some(scene) => lint_scene(&origin, &file, &scene, &resolve),
        None => lint_description(&origin, &file),
    };
    let models = check_models(&origin, &file, options);
    Ok(found(mistakes, advice, models))
}

/// Validates each model file of a scene once, except those the scene may not read.
///
/// A path that is not allowed is already a scene error; reading it here would reveal whether it
/// exists. Models are reported in the order in which they first appear.
fn check_models(origin: &Origin, file: &SceneFile, options: &ImportOptions) -> Vec<CheckReport> {
    let mut paths: Vec<&str> = Vec::new();
    for entry in &file.models {
        let may_read = origin.allows_path(Path::new(&entry.path), &options.allow_outside)
            && !entry.path.starts_with("lesson:");
        if may_read && !paths.contains(&entry.path.as_str()) {
            paths.push(&entry.path);
        }
    }
    paths.into_iter().map(|path| check_file(&origin.folder.join(path), options)).collect()
}

impl CheckResult {
    /// Returns the number of errors in the scene and its models.
    ///
    /// Warnings, notes and lints do not count: they do not change the exit code.
    fn error_count(&self) -> usize {
        let mistakes = self.scene.as_ref().map_or(0, Vec::len);
        mistakes + self.models.iter().map(|report| report.errors).sum::<usize>()
    }

    /// Formats the report as text: the diagnostics of each file, then its summary.
    ///
    /// Writing to a `String` cannot fail.
    ///
    /// ```text
    /// error: expected a number
    ///  --> scene.ron:3:9
    /// …
    ///
    /// scene.ron: 1 mistake
    /// fox.glb: no errors, no warnings, no notes; it can be drawn
    /// ```
    fn to_text(&self) -> String {
        let (mut text, color) = (String::new(), color::stdout_has_color());
        if let Some(mistakes) = &self.scene {
            for mistake in mistakes {
                let _ = writeln!(
                    text,
                    "{}: {}\n",
                    color::style_level("error", color),
                    mistake.to_message(color)
                );
            }
            for Lint { code, error: fault } in &self.advice {
                let _ = writeln!(
                    text,
                    "{}: {}\n",
                    color::style_level(&format!("warning[{code}]"), color),
                    fault.to_message(color)
                );
            }
            let mistakes = count_phrase(mistakes.len(), "mistake");
            let advice = match self.advice.len() {
                0 => String::new(),
                count => format!(", {}", count_phrase(count, "warning")),
            };
            let _ = writeln!(text, "{}: {mistakes}{advice}", visible_path(&self.file));
        }
        for report in &self.models {
            for problem in &report.diagnostics {
                let _ = writeln!(text, "{problem}");
            }
            if report.omitted_count() > 0 {
                let _ = writeln!(text, "… and {} more", report.omitted_count());
            }
            let _ = writeln!(text, "{}: {}", visible_path(&report.file), report.summary());
        }
        text
    }
}

/// Formats a count with its noun: `no errors`, `1 error`, `2 errors`.
fn count_phrase(count: usize, what: &str) -> String {
    match count {
        0 => format!("no {what}s"),
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    }
}
