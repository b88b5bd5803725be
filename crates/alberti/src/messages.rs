//! Printing: results on the standard output, messages on the standard error stream.
//!
//! A closed pipe, as in `alberti info model.glb | head`, ends neither with an error.
//!
//! The order on the standard error stream is: progress (removed before anything else is printed),
//! notes such as `--verify` and `--timings`, then warnings, then the error, if there is one.
//! Nothing on the standard output depends on whether messages are printed, so results can be piped
//! safely.

use super::CliError;
use super::color;
use model::Diagnostic;
use pipeline::Scene;
use std::io::{ErrorKind, Write};

/// The number of warnings of one model that are printed; the others are only counted.
///
/// A broken exporter can cause one warning per vertex accessor; a screen full of them would hide
/// the line that matters. `check` and the JSON reports have all of them.
const MAX_WARNINGS: usize = 8;

/// Writes to the standard output.
///
/// The stream is flushed here, because a buffered write that fails after `main` would go unnoticed.
/// Results are therefore printed as a whole, not piece by piece.
///
/// # Errors
/// If it cannot be written for another reason than a closed pipe.
pub(crate) fn print_stdout(bytes: &[u8]) -> Result<(), CliError> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(()),
    }
}

/// Prints `LEVEL: MESSAGE` on the standard error stream.
///
/// The level is `error`, `warning` or a word of the command, such as `failed` in `batch`; it is
/// colored as [`color::style_level`] says, the message never. Any further line of the message is
/// printed as it is.
pub(crate) fn print_message(level: &str, message: &str) {
    let level = color::style_level(level, color::stderr_has_color());
    // A closed stream is not an error.
    let _ = writeln!(std::io::stderr(), "{level}: {message}");
}

/// Prints a line without a level on the standard error stream.
///
/// Notes are answers to a flag, such as `--timings`, and therefore have neither level nor color.
pub(crate) fn print_note(line: &str) {
    // A closed stream is not an error.
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Prints the warnings of a drawing, then those of each model of the scene.
///
/// Several instances of a model have the same warnings, which are printed once.
///
/// Two files of one name count as one model here; `check` reports both. The order is that of the
/// scene, so the output is deterministic.
///
/// Warnings about what the picture would not show anyway are left out. `is_vector` is whether it is
/// a line drawing whatever its style is.
pub(crate) fn print_warnings(scene: &Scene, drawing: &[drawing::Warning], is_vector: bool) {
    drawing.iter().for_each(|warning| print_message("warning", &warning.to_string()));
    let mut printed: Vec<&str> = Vec::new();
    for instance in &scene.models {
        let model = &instance.model;
        if !printed.contains(&model.name.as_str()) {
            printed.push(&model.name);
            let warnings = model.warnings.iter();
            let shown = warnings.filter(|warning| concerns_picture(scene, is_vector, warning));
            print_model_warnings(&model.name, &shown.collect::<Vec<_>>());
        }
    }
}

/// Whether a picture would show what a warning says that it lacks.
///
/// Only some styles show materials, and only line drawings the edges that a file gives.
fn concerns_picture(scene: &Scene, is_vector: bool, warning: &Diagnostic) -> bool {
    let scenes = || std::iter::once(scene).chain(scene.insets.iter().map(|inset| &inset.scene));
    let draws_lines = |scene: &Scene| is_vector || !scene.style.draws_surfaces();
    let is_about = |names: &[&str]| names.iter().any(|name| warning.message.starts_with(name));
    if is_about(&["KHR_materials_"]) {
        return scenes().any(|scene| !draws_lines(scene) && !scene.style.overrides_materials());
    }
    if is_about(&["CESIUM_primitive_outline", "EXT_mesh_primitive_edge_visibility"]) {
        return scenes().any(|scene| !draws_lines(scene));
    }
    true
}

/// Prints the first warnings of a model, and the number of the others.
///
/// ```text
/// warning: fox.glb: /meshes/0: …
/// warning: fox.glb: 3 more warnings
/// ```
fn print_model_warnings(name: &str, warnings: &[&Diagnostic]) {
    for warning in warnings.iter().take(MAX_WARNINGS) {
        print_message(warning.severity.name(), &format!("{name}: {}", warning.sentence()));
    }
    let rest = warnings.len().saturating_sub(MAX_WARNINGS);
    if rest > 0 {
        let noun = if rest == 1 { "warning" } else { "warnings" };
        print_message("warning", &format!("{name}: {rest} more {noun}"));
    }
}
