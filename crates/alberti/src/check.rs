//! `alberti check` and `alberti scene check`: everything that is wrong with scenes and models, and what is probably not meant.

mod json;

use super::args::CheckArgs;
use super::load_options::LoadArgs;
use super::render::is_scene_file;
use super::{CliError, color, print_stdout};
use model::import::{CheckReport, ImportOptions, check_file};
use pipeline::scene::{Lint, ResolveOptions, lint_scene, validate_scene};
use pipeline::{Origin, ResolveError, Scene, SceneError, SceneFile};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Debug, clap::Args)]
pub(crate) struct CheckScenesArgs {
    /// Scenes (.ron)
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// The report for programs
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    load_options: LoadArgs,
}

/// What was found in a scene, and in each model.
struct CheckResult {
    file: PathBuf,
    scene: Option<Vec<SceneError>>,
    advice: Vec<Lint>,
    models: Vec<CheckReport>,
}

/// Prints what is wrong with a scene or a model; the exit code is 1 if there are errors.
pub(crate) fn run(args: &CheckArgs) -> Result<ExitCode, CliError> {
    let options = args.load_options.import_options();
    let findings = if is_scene_file(&args.input) {
        check_scene(&args.input, &options)?
    } else {
        let models = vec![check_file(&args.input, &options)];
        CheckResult { file: args.input.clone(), scene: None, advice: Vec::new(), models }
    };
    print_stdout(
        (if args.json { json::of_file(&findings) } else { findings.to_text() }).as_bytes(),
    )?;
    Ok(exit_code(findings.error_count()))
}

/// Prints what is wrong with scenes; the exit code is 1 if there are errors.
pub(crate) fn run_scenes(args: &CheckScenesArgs) -> Result<ExitCode, CliError> {
    let options = args.load_options.import_options();
    let check = |path: &PathBuf| check_scene(path, &options);
    let findings = args.files.iter().map(check).collect::<Result<Vec<_>, _>>()?;
    let text = if args.json {
        json::of_scenes(&findings)
    } else {
        findings.iter().map(CheckResult::to_text).collect()
    };
    print_stdout(text.as_bytes())?;
    Ok(exit_code(findings.iter().map(CheckResult::error_count).sum()))
}

fn exit_code(errors: usize) -> ExitCode {
    if errors == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn check_scene(input: &Path, options: &ImportOptions) -> Result<CheckResult, CliError> {
    let found = |scene, advice, models| CheckResult {
        file: input.to_owned(),
        scene: Some(scene),
        advice,
        models,
    };
    let (origin, file) = match Origin::read_scene_allowing(input, &options.allow_outside) {
        Err(ResolveError::Scene(mistake)) => {
            return Ok(found(mistake.into(), Vec::new(), Vec::new()));
        }
        read => read?,
    };
    let resolve = ResolveOptions { import: options.clone() };
    let mut mistakes = validate_scene(&origin, &file, &resolve);
    let mut advice = Vec::new();
    if mistakes.is_empty() {
        // What `render` would refuse is a mistake, also where the review has no eye for it.
        match Scene::resolve(&origin, &file, &resolve) {
            Ok(scene) => advice = lint_scene(&origin, &file, &scene),
            Err(ResolveError::Scene(mistake)) => mistakes.extend(Vec::from(mistake)),
            // The reports of the models tell it.
            Err(_) => {}
        }
    }
    let models = check_models(&origin, &file, options);
    Ok(found(mistakes, advice, models))
}

/// The reports of the models of a scene, each once; those that may not be read have none.
fn check_models(origin: &Origin, file: &SceneFile, options: &ImportOptions) -> Vec<CheckReport> {
    let mut paths: Vec<&str> = Vec::new();
    for entry in &file.models {
        let may_read = origin.allows_path(Path::new(&entry.path), &options.allow_outside);
        if may_read && !paths.contains(&entry.path.as_str()) {
            paths.push(&entry.path);
        }
    }
    paths.into_iter().map(|path| check_file(&origin.folder.join(path), options)).collect()
}

impl CheckResult {
    fn error_count(&self) -> usize {
        let mistakes = self.scene.as_ref().map_or(0, Vec::len);
        mistakes + self.models.iter().map(|report| report.errors).sum::<usize>()
    }

    /// A line for each problem, the worst first, and a summary of each file. Writing to a `String` cannot fail.
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
            let _ = writeln!(text, "{}: {mistakes}{advice}", self.file.display());
        }
        for report in &self.models {
            for problem in &report.diagnostics {
                let _ = writeln!(text, "{problem}");
            }
            if report.omitted_count() > 0 {
                let _ = writeln!(text, "… and {} more", report.omitted_count());
            }
            let _ = writeln!(text, "{}: {}", report.file.display(), report.summary());
        }
        text
    }
}

fn count_phrase(count: usize, what: &str) -> String {
    match count {
        0 => format!("no {what}s"),
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    }
}
