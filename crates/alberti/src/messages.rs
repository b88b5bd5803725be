//! Printing: results on the standard output, messages on the standard error stream.
//!
//! A closed pipe, as in `alberti info model.glb | head`, is not an error for either stream.
//!
//! The order on the standard error stream is: progress (removed before anything else is printed),
//! notes from flags such as `--timings`, then warnings, then the error, if any. Nothing on the
//! standard output depends on whether messages are printed, so results can be piped safely.
//!
//! Human-readable text shows control characters as codes, because names may come from any file.
//! This applies to [`print_text`], [`print_json`], and everything on the standard error stream.
//! Names within a message line are written by [`files::visible_text`], which also shows line ends.

use super::CliError;
use super::color;
use files::{counted, is_terminal_control, visible_text};
use model::Diagnostic;
use pipeline::Scene;
use std::borrow::Cow;
use std::fmt::Display;
use std::io::{ErrorKind, Write};

/// The maximum number of warnings printed per model; the others are only counted.
///
/// A broken exporter can cause one warning per vertex accessor; a screen full of them would hide
/// the line that matters. `check` and the JSON reports contain all of them.
const MAX_WARNINGS: usize = 8;

/// Writes to the standard output.
///
/// The stream is flushed here, because a buffered write that fails after `main` would go unnoticed.
/// Results are therefore printed as a whole, not piece by piece.
///
/// # Errors
/// Returns an error if writing fails for a reason other than a closed pipe.
pub(crate) fn print_stdout(bytes: &[u8]) -> Result<(), CliError> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(()),
    }
}

/// Writes human-readable text to the standard output, with control characters shown as codes.
///
/// # Errors
/// Returns the same errors as [`print_stdout`].
pub(crate) fn print_text(text: &str) -> Result<(), CliError> {
    print_stdout(without_controls(text, color::stdout_has_color()).as_bytes())
}

/// Writes a JSON document to the standard output, with the control characters in its strings
/// escaped, so that all values stay the same.
///
/// # Errors
/// Returns the same errors as [`print_stdout`].
pub(crate) fn print_json(json: &str) -> Result<(), CliError> {
    if !json.contains(must_be_escaped) {
        return print_stdout(json.as_bytes());
    }
    let mut escaped = String::with_capacity(json.len() + 8);
    for character in json.chars() {
        if must_be_escaped(character) {
            // Every control character fits into the four digits of a JSON escape.
            escaped.push_str(&format!("\\u{:04x}", u32::from(character)));
        } else {
            escaped.push(character);
        }
    }
    print_stdout(escaped.as_bytes())
}

/// Whether a character is a control character other than a line end.
fn must_be_escaped(character: char) -> bool {
    character != '\n' && is_terminal_control(character)
}

/// Returns multi-line text with control characters shown as codes, except for the colors of the
/// program's own messages if they are `colored`.
fn without_controls(text: &str, colored: bool) -> Cow<'_, str> {
    if !text.contains(must_be_escaped) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 8);
    let mut rest = text;
    while let Some(at) = rest.find(must_be_escaped) {
        let (before, found) = rest.split_at(at);
        let length = match color_length(found) {
            Some(length) if colored => length,
            _ => 0,
        };
        let (color, after) = found.split_at(length);
        shown.push_str(before);
        shown.push_str(color);
        rest = after;
        if length == 0 {
            let mut characters = rest.chars();
            shown.extend(characters.next().into_iter().flat_map(char::escape_unicode));
            rest = characters.as_str();
        }
    }
    shown.push_str(rest);
    Cow::Owned(shown)
}

/// Returns the length in bytes of a color escape, such as `ESC [1;31m`, at the start of `text`.
fn color_length(text: &str) -> Option<usize> {
    let numbers = text.strip_prefix("\x1b[")?;
    let end = numbers.find(|c: char| !c.is_ascii_digit() && c != ';')?;
    numbers[end..].starts_with('m').then_some(2 + end + 1)
}

/// Prints `LEVEL: MESSAGE` on the standard error stream.
///
/// The level is `error`, `warning` or a word of the command, such as `failed` in `batch`;
/// [`color::style_level`] colors it. The message itself is colored only if it is about a scene
/// file. Further lines of a message have no prefix.
pub(crate) fn print_message(level: &str, message: &str) {
    let colored = color::stderr_has_color();
    let level = color::style_level(level, colored);
    let message = without_controls(message, colored);
    // A closed stream is not an error.
    let _ = writeln!(std::io::stderr(), "{level}: {message}");
}

/// Prints clap's message about wrong usage, or the requested help.
pub(crate) fn print_usage(usage: &clap::Error) {
    if !usage.use_stderr() {
        // If this fails, there is nowhere to report the error.
        let _ = usage.print();
        return;
    }
    let (text, colored) = (usage.render(), color::stderr_has_color());
    let text = if colored { text.ansi().to_string() } else { text.to_string() };
    // A closed stream is not an error.
    let _ = write!(std::io::stderr(), "{}", without_controls(&text, colored));
}

/// Prints a line without a level on the standard error stream.
///
/// A flag such as `--timings` requests notes, so they have neither a level nor a color.
pub(crate) fn print_note(line: &str) {
    let line = without_controls(line, false);
    // A closed stream is not an error.
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Prints the warnings about a drawing, then the warnings about each model.
///
/// Several instances of a model have the same warnings, which are printed once.
///
/// Two files with the same name count as one model here; `check` reports both. The order follows
/// the scene, so the output is deterministic.
///
/// Warnings about features that the picture would not show are omitted. `is_vector` is true if the
/// output has lines regardless of style.
pub(crate) fn print_warnings<W: Display>(scene: &Scene, drawing: &[W], is_vector: bool) {
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

/// Whether a picture would show the feature that a warning reports as unsupported.
///
/// Only some styles show materials, and only line drawings show the edges declared in a file.
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

/// Prints the first warnings about a model, and the number of remaining warnings.
///
/// ```text
/// warning: fox.glb: /meshes/0: …
/// warning: fox.glb: 3 more warnings
/// ```
fn print_model_warnings(name: &str, warnings: &[&Diagnostic]) {
    let name = visible_text(name);
    for warning in warnings.iter().take(MAX_WARNINGS) {
        print_message(warning.severity.name(), &format!("{name}: {}", warning.sentence()));
    }
    let rest = warnings.len().saturating_sub(MAX_WARNINGS);
    if rest > 0 {
        let more = counted(rest, "more warning", "more warnings");
        print_message("warning", &format!("{name}: {more}"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_programs_own_colors_reach_a_terminal() {
        let text = "\x1b[1;31merror\x1b[0m: a\x1b]0;b\x07\n\u{9b}2J\x1b[\u{202e}";
        let plain = "\\u{1b}[1;31merror\\u{1b}[0m: a\\u{1b}]0;b\\u{7}\n\\u{9b}2J\\u{1b}[\\u{202e}";
        assert_eq!(without_controls(text, false), plain);
        let colored = "\x1b[1;31merror\x1b[0m: a\\u{1b}]0;b\\u{7}\n\\u{9b}2J\\u{1b}[\\u{202e}";
        assert_eq!(without_controls(text, true), colored);
        assert!(matches!(without_controls("a\nb", false), Cow::Borrowed("a\nb")));
    }
}
