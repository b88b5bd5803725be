//! `alberti check`: everything that is wrong with a scene or a model.

use super::Failure;
use super::args::CheckArgs;
use super::render::is_scene;
use pipeline::import::{ImportOptions, Problem, Report, check};
use pipeline::scene::{ResolveOptions, review};
use pipeline::{Origin, ResolveError, SceneError, SceneFile};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::process::ExitCode;

/// The version of the schema of `--json`. New members may come in any release; it rises when one changes its meaning or goes.
const VERSION: u32 = 1;

/// What was found in a scene, and in each model.
struct Findings {
    scene: Option<Vec<SceneError>>,
    models: Vec<Report>,
}

/// Prints what is wrong; the exit code is 1 if there are errors.
pub(crate) fn run(args: &CheckArgs) -> Result<ExitCode, Failure> {
    let options = args.load.options();
    let findings = if is_scene(&args.input) {
        check_scene(&args.input, &options)?
    } else {
        Findings { scene: None, models: vec![check(&args.input, &options)] }
    };
    let text = if args.json { findings.json(&args.input) } else { findings.text(&args.input) };
    std::io::stdout().write_all(text.as_bytes())?;
    Ok(if findings.errors() == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn check_scene(input: &Path, options: &ImportOptions) -> Result<Findings, Failure> {
    let (origin, file) = match Origin::read(input) {
        Err(ResolveError::Scene(mistake)) => {
            return Ok(Findings { scene: Some(vec![mistake]), models: Vec::new() });
        }
        read => read?,
    };
    let resolve = ResolveOptions { import: options.clone() };
    let scene = Some(review(&origin, &file, &resolve));
    let models = models(&origin, &file, options);
    Ok(Findings { scene, models })
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
    fn text(&self, input: &Path) -> String {
        let mut text = String::new();
        if let Some(mistakes) = &self.scene {
            for mistake in mistakes {
                let _ = writeln!(text, "{mistake}\n");
            }
            let count = match mistakes.len() {
                0 => "no mistakes".to_owned(),
                1 => "1 mistake".to_owned(),
                count => format!("{count} mistakes"),
            };
            let _ = writeln!(text, "{}: {count}", input.display());
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

    fn json(&self, input: &Path) -> String {
        let document = json!({
            "schema": {"name": "alberti-check", "version": VERSION},
            "file": input.to_string_lossy(),
            "errors": self.errors(),
            "scene": self.scene.as_ref().map(|all| all.iter().map(mistake_json).collect::<Vec<_>>()),
            "models": self.models.iter().map(report_json).collect::<Vec<_>>(),
        });
        format!("{document:#}\n")
    }
}

fn mistake_json(mistake: &SceneError) -> Value {
    let (line, column) = mistake.line_and_column();
    json!({"line": line, "column": column, "message": mistake.message, "remedy": mistake.help})
}

fn report_json(report: &Report) -> Value {
    let refusal = report.refusal.as_ref().map(
        |fault| json!({"pointer": fault.pointer, "message": fault.problem, "remedy": fault.remedy}),
    );
    json!({
        "file": report.file.to_string_lossy(),
        "errors": report.errors,
        "warnings": report.warnings,
        "notes": report.notes,
        "refusal": refusal,
        "problems": report.problems.iter().map(problem_json).collect::<Vec<_>>(),
        "problems_left_out": report.left_out(),
    })
}

fn problem_json(problem: &Problem) -> Value {
    json!({
        "severity": problem.severity.name(),
        "code": problem.code,
        "pointer": problem.pointer,
        "message": problem.message,
        "remedy": problem.remedy,
    })
}
