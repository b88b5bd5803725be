//! The reports of `check` for programs.

use super::Findings;
use model::import::{Problem, Report};
use pipeline::SceneError;
use pipeline::scene::Advice;
use serde_json::{Value, json};

/// The version of both schemas. New members may come in any release; it rises when one changes its meaning or goes.
const VERSION: u32 = 1;

/// The report on a scene or a model.
pub(super) fn of_file(findings: &Findings) -> String {
    let mut document = members(findings);
    document["schema"] = json!({"name": "alberti-check", "version": VERSION});
    format!("{document:#}\n")
}

/// The report on scenes.
pub(super) fn of_scenes(all: &[Findings]) -> String {
    let document = json!({
        "schema": {"name": "alberti-scene-check", "version": VERSION},
        "errors": all.iter().map(Findings::errors).sum::<usize>(),
        "warnings": all.iter().map(|findings| findings.advice.len()).sum::<usize>(),
        "files": all.iter().map(members).collect::<Vec<_>>(),
    });
    format!("{document:#}\n")
}

fn members(findings: &Findings) -> Value {
    let scene = findings.scene.as_ref();
    json!({
        "file": findings.file.to_string_lossy(),
        "errors": findings.errors(),
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

fn advice(advice: &Advice) -> Value {
    let mut value = mistake(&advice.fault);
    value["code"] = json!(advice.code);
    value
}

fn report(report: &Report) -> Value {
    let refusal = report.refusal.as_ref().map(
        |fault| json!({"pointer": fault.pointer, "message": fault.problem, "remedy": fault.remedy}),
    );
    json!({
        "file": report.file.to_string_lossy(),
        "errors": report.errors,
        "warnings": report.warnings,
        "notes": report.notes,
        "refusal": refusal,
        "problems": report.problems.iter().map(problem).collect::<Vec<_>>(),
        "problems_left_out": report.left_out(),
    })
}

fn problem(problem: &Problem) -> Value {
    json!({
        "severity": problem.severity.name(),
        "code": problem.code,
        "pointer": problem.pointer,
        "message": problem.message,
        "remedy": problem.remedy,
    })
}
