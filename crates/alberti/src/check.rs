//! `alberti check` and `alberti scene check`: everything that is wrong with scenes and models, and what is probably not meant.

mod json;

use super::args::CheckArgs;
use super::loading::LoadArgs;
use super::render::is_scene;
use super::{Failure, color, say};
use model::import::{ImportOptions, Report, check};
use pipeline::scene::{Advice, ResolveOptions, advise, review};
use pipeline::{Origin, ResolveError, Scene, SceneError, SceneFile};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Debug, clap::Args)]
pub(crate) struct SceneCheckArgs {
    /// Scenes (.ron)
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// The report for programs
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    load: LoadArgs,
}

/// What was found in a scene, and in each model.
struct Findings {
    file: PathBuf,
    scene: Option<Vec<SceneError>>,
    advice: Vec<Advice>,
    models: Vec<Report>,
}

/// Prints what is wrong with a scene or a model; the exit code is 1 if there are errors.
pub(crate) fn run(args: &CheckArgs) -> Result<ExitCode, Failure> {
    let options = args.load.options();
    let findings = if is_scene(&args.input) {
        check_scene(&args.input, &options)?
    } else {
        let models = vec![check(&args.input, &options)];
        Findings { file: args.input.clone(), scene: None, advice: Vec::new(), models }
    };
    say((if args.json { json::of_file(&findings) } else { findings.text() }).as_bytes())?;
    Ok(exit_code(findings.errors()))
}

/// Prints what is wrong with scenes; the exit code is 1 if there are errors.
pub(crate) fn scenes(args: &SceneCheckArgs) -> Result<ExitCode, Failure> {
    let options = args.load.options();
    let check = |path: &PathBuf| check_scene(path, &options);
    let findings = args.files.iter().map(check).collect::<Result<Vec<_>, _>>()?;
    let text = if args.json {
        json::of_scenes(&findings)
    } else {
        findings.iter().map(Findings::text).collect()
    };
    say(text.as_bytes())?;
    Ok(exit_code(findings.iter().map(Findings::errors).sum()))
}

fn exit_code(errors: usize) -> ExitCode {
    if errors == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn check_scene(input: &Path, options: &ImportOptions) -> Result<Findings, Failure> {
    let found = |scene, advice, models| Findings {
        file: input.to_owned(),
        scene: Some(scene),
        advice,
        models,
    };
    let (origin, file) = match Origin::read_below(input, &options.allow_outside) {
        Err(ResolveError::Scene(mistake)) => {
            return Ok(found(vec![mistake], Vec::new(), Vec::new()));
        }
        read => read?,
    };
    let resolve = ResolveOptions { import: options.clone() };
    let mut mistakes = review(&origin, &file, &resolve);
    let mut advice = Vec::new();
    if mistakes.is_empty() {
        // What `render` would refuse is a mistake, also where the review has no eye for it.
        match Scene::resolve(&origin, &file, &resolve) {
            Ok(scene) => advice = advise(&origin, &file, &scene),
            Err(ResolveError::Scene(mistake)) => mistakes.push(mistake),
            // The reports of the models tell it.
            Err(_) => {}
        }
    }
    let models = models(&origin, &file, options);
    Ok(found(mistakes, advice, models))
}

/// The reports of the models of a scene, each once; those that may not be read have none.
fn models(origin: &Origin, file: &SceneFile, options: &ImportOptions) -> Vec<Report> {
    let mut paths: Vec<&str> = Vec::new();
    for entry in &file.models {
        let may_read = origin.may_read(Path::new(&entry.path), &options.allow_outside);
        if may_read && !paths.contains(&entry.path.as_str()) {
            paths.push(&entry.path);
        }
    }
    paths.into_iter().map(|path| check(&origin.folder.join(path), options)).collect()
}

impl Findings {
    fn errors(&self) -> usize {
        let mistakes = self.scene.as_ref().map_or(0, Vec::len);
        mistakes + self.models.iter().map(|report| report.errors).sum::<usize>()
    }

    /// A line for each problem, the worst first, and a summary of each file. Writing to a `String` cannot fail.
    fn text(&self) -> String {
        let (mut text, color) = (String::new(), color::on_stdout());
        if let Some(mistakes) = &self.scene {
            for mistake in mistakes {
                let _ =
                    writeln!(text, "{}: {}\n", color::level("error", color), mistake.told(color));
            }
            for Advice { code, fault } in &self.advice {
                let _ = writeln!(
                    text,
                    "{}: {}\n",
                    color::level(&format!("warning[{code}]"), color),
                    fault.told(color)
                );
            }
            let mistakes = counted(mistakes.len(), "mistake");
            let advice = match self.advice.len() {
                0 => String::new(),
                count => format!(", {}", counted(count, "warning")),
            };
            let _ = writeln!(text, "{}: {mistakes}{advice}", self.file.display());
        }
        for report in &self.models {
            for problem in &report.problems {
                let _ = writeln!(text, "{problem}");
            }
            if report.left_out() > 0 {
                let _ = writeln!(text, "… and {} more", report.left_out());
            }
            let _ = writeln!(text, "{}: {}", report.file.display(), report.summary());
        }
        text
    }
}

fn counted(count: usize, what: &str) -> String {
    match count {
        0 => format!("no {what}s"),
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    }
}
