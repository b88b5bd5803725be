//! The reports of `check` for programs.

use super::CheckResult;
use model::Diagnostic;
use model::import::CheckReport;
use pipeline::SceneError;
use pipeline::scene::Lint;
use serde_json::{Value, json};

/// The version of both schemas. New members may come in any release; it rises when one changes its meaning or goes.
const VERSION: u32 = 1;

/// The report on a scene or a model.
pub(super) fn of_file(findings: &CheckResult) -> String {
    let mut document = members(findings);
    document["schema"] = json!({"name": "alberti-check", "version": VERSION});
    format!("{document:#}\n")
}

/// The report on scenes.
pub(super) fn of_scenes(all: &[CheckResult]) -> String {
    let document = json!({
        "schema": {"name": "alberti-scene-check", "version": VERSION},
        "errors": all.iter().map(CheckResult::error_count).sum::<usize>(),
        "warnings": all.iter().map(|findings| findings.advice.len()).sum::<usize>(),
        "files": all.iter().map(members).collect::<Vec<_>>(),
    });
    format!("{document:#}\n")
}

fn members(findings: &CheckResult) -> Value {
    let scene = findings.scene.as_ref();
    json!({
        "file": findings.file.to_string_lossy(),
        "errors": findings.error_count(),
        "scene": scene.map(|all| all.iter().map(mistake).collect::<Vec<_>>()),
        "advice": findings.advice.iter().map(advice).collect::<Vec<_>>(),
        "models": findings.models.iter().map(report).collect::<Vec<_>>(),
    })
}

fn mistake(mistake: &SceneError) -> Value {
    let (line, column) = mistake.line_and_column();
    json!({
        "file": mistake.file,
        "line": line,
        "column": column,
        "message": mistake.message,
        "remedy": mistake.help,
    })
}

fn advice(advice: &Lint) -> Value {
    let mut value = mistake(&advice.error);
    value["code"] = json!(advice.code);
    value
}

fn report(report: &CheckReport) -> Value {
    let refusal = report.load_error.as_ref().map(
        |fault| json!({"pointer": fault.location, "message": fault.message, "remedy": fault.help}),
    );
    json!({
        "file": report.file.to_string_lossy(),
        "errors": report.errors,
        "warnings": report.warnings,
        "notes": report.notes,
        "refusal": refusal,
        "problems": report.diagnostics.iter().map(problem).collect::<Vec<_>>(),
        "problems_left_out": report.omitted_count(),
    })
}

fn problem(problem: &Diagnostic) -> Value {
    json!({
        "severity": problem.severity.name(),
        "code": problem.code,
        "pointer": problem.location,
        "message": problem.message,
        "remedy": problem.help,
    })
}
