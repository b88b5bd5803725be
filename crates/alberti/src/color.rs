//! Colours of messages: whether there are any, and which.

use std::io::IsTerminal as _;
use std::sync::OnceLock;

/// When messages have colours.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub(crate) enum ColorChoice {
    /// On a terminal, unless NO_COLOR is set
    Auto,
    /// Wherever they go
    Always,
    /// Nowhere
    Never,
}

/// What the flag says, once it has been read.
static COLOR_CHOICE: OnceLock<ColorChoice> = OnceLock::new();

pub(super) fn set_color_choice(arg: ColorChoice) {
    COLOR_CHOICE.get_or_init(|| arg);
}

pub(super) fn stderr_has_color() -> bool {
    should_use_color(COLOR_CHOICE.get().copied(), std::io::stderr().is_terminal())
}

pub(super) fn stdout_has_color() -> bool {
    should_use_color(COLOR_CHOICE.get().copied(), std::io::stdout().is_terminal())
}

/// Terminals that are dumb, and people who set NO_COLOR to anything (no-color.org), get none.
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

/// The word that a message begins with: errors are red, all else is yellow.
pub(super) fn style_level(word: &str, colors: bool) -> String {
    match colors {
        false => word.to_owned(),
        true if word.starts_with("error") => format!("\x1b[1;31m{word}\x1b[0m"),
        true => format!("\x1b[1;33m{word}\x1b[0m"),
    }
}
