//! The JSON reports of `alberti check` and `alberti scene check`.
//!
//! ```json
//! {
//!   "schema": {"name": "alberti-check", "version": 1},
//!   "file": "scene.ron", "errors": 1,
//!   "scene": [{"file": "scene.ron", "line": 3, "column": 9, "message": "…", "remedy": "…"}],
//!   "advice": [],
//!   "models": [{"file": "fox.glb", "problems": [{"code": "…", "pointer": "/meshes/0"}]}]
//! }
//! ```
//! Member names are part of the interface and do not change, even where the program now uses other
//! words.

use super::CheckResult;
use gltf_check::CheckReport;
use model::Diagnostic;
use pipeline::SceneError;
use scene::Lint;
use serde_json::{Value, json};

/// The version of both schemas, which increases when a member is removed or changes its meaning.
/// New members may be added in any release.
const VERSION: u32 = 1;

/// Returns the report on a scene or a model.
///
/// Members are in alphabetical order, as `serde_json` writes them; the text ends with a line feed.
pub(super) fn file_report(findings: &CheckResult) -> String {
    let mut document = result_json(findings);
    document["schema"] = json!({"name": "alberti-check", "version": VERSION});
    format!("{document:#}\n")
}

/// Returns the report on scenes.
///
/// The totals let a script judge the result without reading `files`, which has one entry per
/// argument, in the same order.
pub(super) fn scenes_report(all: &[CheckResult]) -> String {
    let document = json!({
        "schema": {"name": "alberti-scene-check", "version": VERSION},
        "errors": all.iter().map(CheckResult::error_count).sum::<usize>(),
        "warnings": all.iter().map(|findings| findings.advice.len()).sum::<usize>(),
        "files": all.iter().map(result_json).collect::<Vec<_>>(),
    });
    format!("{document:#}\n")
}

/// Returns the result for one input.
///
/// `scene` is `null` for a bare model and an empty list for a scene without errors. `errors` counts
/// the errors in the scene and all its models.
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

/// Returns an error in a scene, with line and column counted from 1.
///
/// `file` may be an include. Columns count characters. `remedy` is `null` without a suggestion.
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

/// Returns a lint: a scene error with a code.
///
/// The code names the kind of lint and is stable, so that a script can ignore that kind.
fn lint_json(advice: &Lint) -> Value {
    let mut value = scene_error_json(&advice.error);
    value["code"] = json!(advice.code);
    value
}

/// Returns the report of a model.
///
/// `refusal` is the error that kept the model from being loaded, and `null` if it was loaded.
/// `problems` is limited in length; `problems_left_out` is the number of problems beyond the limit.
/// The counts cover all problems.
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

/// Returns a diagnostic of a model.
///
/// `pointer` is a JSON pointer (RFC 6901) into the glTF document, `severity` is `error`, `warning`
/// or `note`, and `code` names the violated rule.
fn diagnostic_json(diagnostic: &Diagnostic) -> Value {
    json!({
        "severity": diagnostic.severity.name(),
        "code": diagnostic.code,
        "pointer": diagnostic.location,
        "message": diagnostic.message,
        "remedy": diagnostic.help,
    })
}
