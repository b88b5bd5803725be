//! How this program is started again: for the workers of a batch, and where its memory is limited.

#[cfg(target_os = "linux")]
mod supervisor;

use std::ffi::OsString;
use std::path::Path;
use std::process::Command;
use std::sync::OnceLock;

/// The words that start this program again, where it runs within another one.
static PROGRAM_WORDS: OnceLock<Vec<OsString>> = OnceLock::new();

/// Runs the program within another one, as [`run`](crate::run) does.
///
/// `program` are the words that start it again, such as `python -m alberti`: `batch` starts workers
/// with them.
pub fn run_within(
    program: impl IntoIterator<Item = OsString>,
    arguments: impl IntoIterator<Item = OsString>,
) -> u8 {
    PROGRAM_WORDS.get_or_init(|| program.into_iter().collect());
    crate::run(arguments)
}

/// Runs the program as [`run`](crate::run) does; if its memory is limited, in a second process, so
/// that a command that needs more ends with a message.
///
/// Only for the program itself, which may be started again.
pub fn run_program(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let words: Vec<OsString> = arguments.into_iter().collect();
    #[cfg(target_os = "linux")]
    if let Some(code) = supervisor::supervise(&words) {
        return code;
    }
    crate::run(words)
}

/// A command that starts this program again.
///
/// # Errors
/// If the system does not say where the program is.
pub(super) fn program_command() -> std::io::Result<Command> {
    if let Some([program, rest @ ..]) = PROGRAM_WORDS.get().map(Vec::as_slice) {
        let mut command = Command::new(program);
        command.args(rest);
        return Ok(command);
    }
    // The very file that runs, even if another version has taken its place since.
    let running = Path::new("/proc/self/exe");
    if cfg!(target_os = "linux") && running.exists() {
        return Ok(Command::new(running));
    }
    std::env::current_exe().map(Command::new)
}
