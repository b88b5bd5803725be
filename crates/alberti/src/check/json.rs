//! The JSON reports of `alberti check` and `alberti scene check`.

use super::CheckResult;
use model::{CheckReport, Diagnostic};
use pipeline::SceneError;
use pipeline::scene::Lint;
use serde_json::{Value, json};

/// The version of both schemas: it rises when a member is removed or changes its meaning. New
/// members may be added in any release.
const VERSION: u32 = 1;

/// The report on a scene or a model.
pub(super) fn file_report(findings: &CheckResult) -> String {
    let mut document = result_json(findings);
    document["schema"] = json!({"name": "alberti-check", "version": VERSION});
    format!("{document:#}\n")
}

/// The report on scenes.
pub(super) fn scenes_report(all: &[CheckResult]) -> String {
    let document = json!({
        "schema": {"name": "alberti-scene-check", "version": VERSION},
        "errors": all.iter().map(CheckResult::error_count).sum::<usize>(),
        "warnings": all.iter().map(|findings| findings.advice.len()).sum::<usize>(),
        "files": all.iter().map(result_json).collect::<Vec<_>>(),
    });
    format!("{document:#}\n")
}

/// The result for one input.
fn result_json(findings: &CheckResult) -> Value {
    let scene = findings.scene.as_ref();
    json!({
        "file": findings.file.to_string_lossy(),
        "errors": findings.error_count(),
        "scene": scene.map(|all| all.iter().map(scene_error_json).collect::<Vec<_>>()),
        "advice": findings.advice.iter().map(lint_json).collect::<Vec<_>>(),
        "models": findings.models.iter().map(report_json).collect::<Vec<_>>(),
    })
}

/// An error of a scene, with line and column from 1.
fn scene_error_json(mistake: &SceneError) -> Value {
    let (line, column) = mistake.line_and_column();
    json!({
        "file": mistake.file,
        "line": line,
        "column": column,
        "message": mistake.message,
        "remedy": mistake.help,
    })
}

/// A lint: a scene error with a code.
fn lint_json(advice: &Lint) -> Value {
    let mut value = scene_error_json(&advice.error);
    value["code"] = json!(advice.code);
    value
}

/// The report of a model.
fn report_json(report: &CheckReport) -> Value {
    let refusal = report.load_error.as_ref().map(
        |fault| json!({"pointer": fault.location, "message": fault.message, "remedy": fault.help}),
    );
    json!({
        "file": report.file.to_string_lossy(),
        "errors": report.errors,
        "warnings": report.warnings,
        "notes": report.notes,
        "refusal": refusal,
        "problems": report.diagnostics.iter().map(diagnostic_json).collect::<Vec<_>>(),
        "problems_left_out": report.omitted_count(),
    })
}

/// A diagnostic of a model.
fn diagnostic_json(diagnostic: &Diagnostic) -> Value {
    json!({
        "severity": diagnostic.severity.name(),
        "code": diagnostic.code,
        "pointer": diagnostic.location,
        "message": diagnostic.message,
        "remedy": diagnostic.help,
    })
}
