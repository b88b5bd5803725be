//! Printing: results on the standard output, messages on the standard error stream.
//!
//! A closed pipe, as in `alberti info model.glb | head`, ends neither with an error.

use super::CliError;
use super::color;
use model::Diagnostic;
use pipeline::Scene;
use std::io::{ErrorKind, Write};

/// The number of warnings of one model that are printed; the others are only counted.
const MAX_WARNINGS: usize = 8;

/// Writes to the standard output.
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
pub(crate) fn print_message(level: &str, message: &str) {
    let level = color::style_level(level, color::stderr_has_color());
    // A closed stream is not an error.
    let _ = writeln!(std::io::stderr(), "{level}: {message}");
}

/// Prints a line without a level on the standard error stream.
pub(crate) fn print_note(line: &str) {
    // A closed stream is not an error.
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Prints the warnings of a drawing, then those of each model of the scene.
///
/// Several instances of a model have the same warnings, which are printed once.
pub(crate) fn print_warnings(scene: &Scene, drawing: &[drawing::Warning]) {
    drawing.iter().for_each(|warning| print_message("warning", &warning.to_string()));
    let mut printed: Vec<&str> = Vec::new();
    for instance in &scene.models {
        let model = &instance.model;
        if !printed.contains(&model.name.as_str()) {
            printed.push(&model.name);
            print_model_warnings(&model.name, &model.warnings);
        }
    }
}

/// Prints the first warnings of a model, and the number of the others.
fn print_model_warnings(name: &str, warnings: &[Diagnostic]) {
    for warning in warnings.iter().take(MAX_WARNINGS) {
        print_message("warning", &format!("{name}: {}", warning.sentence()));
    }
    let rest = warnings.len().saturating_sub(MAX_WARNINGS);
    if rest > 0 {
        print_message("warning", &format!("{name}: {rest} more warnings"));
    }
}
