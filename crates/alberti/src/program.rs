//! The command line that starts this program again, for batch workers and memory limits.

#[cfg(target_os = "linux")]
mod supervisor;

use std::ffi::OsString;
use std::path::Path;
use std::process::Command;
use std::sync::OnceLock;

/// The words that start this program again if it runs inside another program.
static PROGRAM_WORDS: OnceLock<Vec<OsString>> = OnceLock::new();

/// Runs the program inside another program, like [`run`](crate::run).
///
/// `program` contains the words that start it again, such as `python -m alberti`: `batch` uses them
/// to start workers.
pub fn run_within(
    program: impl IntoIterator<Item = OsString>,
    arguments: impl IntoIterator<Item = OsString>,
) -> u8 {
    PROGRAM_WORDS.get_or_init(|| program.into_iter().collect());
    crate::run(arguments)
}

/// Runs the program like [`run`](crate::run). If memory is limited, the command runs in a second
/// process, so that exceeding the limit causes an error message.
///
/// Use it only in the program itself, because it may start the program again.
pub fn run_program(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let words: Vec<OsString> = arguments.into_iter().collect();
    #[cfg(target_os = "linux")]
    if let Some(code) = supervisor::supervise(&words) {
        return code;
    }
    crate::run(words)
}

/// Returns a command that starts this program again.
///
/// # Errors
/// Returns an error if the system does not report the program's path.
pub(super) fn program_command() -> std::io::Result<Command> {
    if let Some([program, rest @ ..]) = PROGRAM_WORDS.get().map(Vec::as_slice) {
        let mut command = Command::new(program);
        command.args(rest);
        return Ok(command);
    }
    // The file that is running, even if another version has since replaced it.
    let running = Path::new("/proc/self/exe");
    if cfg!(target_os = "linux") && running.exists() {
        return Ok(Command::new(running));
    }
    std::env::current_exe().map(Command::new)
}
