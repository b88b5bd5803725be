//! `--show`: prints the picture in the terminal.
//!
//! Terminals with kitty's graphics protocol get the picture as a PNG. Others get half blocks, two
//! pixels per cell in 24-bit color, or, if NO_COLOR is set, ASCII art by luminance.
//!
//! The result is text, so it can also be piped into a pager that passes escapes through.

use super::CliError;
use super::render_job::RenderOutput;
use picture::terminal;
use std::io::Write as _;

/// The width assumed for a terminal that does not report it.
const DEFAULT_COLUMNS: u32 = 80;

/// Prints the picture in the best way the terminal supports, judging by environment variables.
///
/// `NO_COLOR` takes precedence over everything. Support for kitty's protocol is inferred from
/// `KITTY_WINDOW_ID` and `TERM`, because querying the terminal would mean reading its reply from
/// keyboard input.
///
/// # Errors
/// Returns an error if writing to standard output fails.
pub(super) fn print_image(painted: &RenderOutput) -> Result<(), CliError> {
    let Some(picture) = &painted.picture else { return Ok(()) };
    let is_set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let columns =
        terminal_size::terminal_size().map_or(DEFAULT_COLUMNS, |(width, _)| width.0.into());
    let kitty = is_set("KITTY_WINDOW_ID")
        || std::env::var("TERM")
            .is_ok_and(|term| term.contains("kitty") || term.contains("ghostty"));
    let text = if is_set("NO_COLOR") {
        terminal::ascii_art(picture, columns)
    } else if kitty {
        terminal::kitty_graphics(picture, columns)
    } else {
        terminal::half_blocks(picture, columns)
    };
    std::io::stdout().write_all(text.as_bytes())?;
    Ok(())
}
