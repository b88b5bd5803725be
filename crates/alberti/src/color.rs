//! Message colors: when to use ANSI escapes, and which ones.
//!
//! The choice is global to the process, because messages are printed from everywhere in the
//! program: `--color` sets it once, before the first message.

use std::io::IsTerminal as _;
use std::sync::OnceLock;

/// When to color messages (`--color`).
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub(crate) enum ColorChoice {
    /// On a terminal, unless NO_COLOR is set
    Auto,
    /// Always, even in files and pipes
    Always,
    /// Never
    Never,
}

/// The value of `--color`, once the arguments have been parsed.
///
/// Unset in unit tests, where it counts as `auto`.
static COLOR_CHOICE: OnceLock<ColorChoice> = OnceLock::new();

/// Sets the choice for the process; only the first call has an effect.
pub(super) fn set_color_choice(arg: ColorChoice) {
    COLOR_CHOICE.get_or_init(|| arg);
}

/// Whether messages on the standard error stream are colored.
///
/// The answer does not depend on the standard output: with `alberti check x.ron > report.txt`,
/// errors are colored and the report is not.
pub(super) fn stderr_has_color() -> bool {
    should_use_color(COLOR_CHOICE.get().copied(), std::io::stderr().is_terminal())
}

/// Whether reports on the standard output are colored.
///
/// Only `check` prints a colored report. All other results are data and are never colored; the
/// escapes printed by `--show` are the picture itself.
pub(super) fn stdout_has_color() -> bool {
    should_use_color(COLOR_CHOICE.get().copied(), std::io::stdout().is_terminal())
}

/// Whether output to a stream is colored, depending on whether the stream is a `terminal`.
///
/// With `auto`, it is not colored on dumb terminals or if `NO_COLOR` is set to a non-empty value
/// (<https://no-color.org>).
fn should_use_color(chosen: Option<ColorChoice>, terminal: bool) -> bool {
    match chosen.unwrap_or(ColorChoice::Auto) {
        ColorChoice::Always => true,
        ColorChoice::Never => false,
        ColorChoice::Auto => {
            let set = |name| std::env::var_os(name).filter(|value| !value.is_empty());
            terminal && set("NO_COLOR").is_none() && set("TERM").is_none_or(|term| term != "dumb")
        }
    }
}

/// Formats the severity at the start of a message: bold red for errors, otherwise bold yellow.
///
/// A code after the word, as in `warning[CODE]`, is colored too. The result ends with a reset, so
/// that the text after it has the terminal's color.
pub(super) fn style_level(word: &str, colors: bool) -> String {
    match colors {
        false => word.to_owned(),
        true if word.starts_with("error") => format!("\x1b[1;31m{word}\x1b[0m"),
        true => format!("\x1b[1;33m{word}\x1b[0m"),
    }
}
