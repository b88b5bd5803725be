//! A second process for a command whose memory is limited.
//!
//! The system ends a program that runs out of memory in the middle of its work, without a message.
//! If there is a limit, from `--max-memory`, `ulimit` or the thumbnailer, the command runs in a
//! second process. The first process reports what happened, removes unfinished files, and ends with
//! exit code 1.
//!
//! ```text
//!  alberti --max-memory 1GiB render … ─► the same arguments, limited ─► picture, or killed
//!        ▲ messages, exit code ◄──────────────────────┘
//! ```

use crate::args::{Args, Command};
use crate::memory_limit::limit_process_memory;
use crate::messages::print_message;
use crate::{negative_numbers, usage_advice};
use clap::CommandFactory as _;
use rustix::process::{Resource, Signal, getrlimit, set_parent_process_death_signal};
use std::ffi::OsString;
use std::io::{BufRead as _, BufReader, Write as _};
use std::os::unix::process::ExitStatusExt as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};

/// The environment variable that marks the limited process; its value is the number of bytes that
/// the process may use, or 0 if another limit applies.
const LIMITED: &str = "ALBERTI_LIMITED_PROCESS";
/// The message that the standard library prints before it aborts.
const LAST_WORDS: &str = "memory allocation of";

/// Runs the command in a second process if its memory is limited. Returns `None` if there is no
/// limit, and in the second process.
pub(super) fn supervise(words: &[OsString]) -> Option<u8> {
    if let Some(bytes) = std::env::var(LIMITED).ok().and_then(|text| text.parse().ok()) {
        // Ends this process if the waiting process is killed.
        let _ = set_parent_process_death_signal(Some(Signal::TERM));
        if bytes > 0 {
            limit_process_memory(bytes);
        }
        return None;
    }
    let (limit, what) = memory_limit(words)?;
    let mut command = super::program_command().ok()?;
    command.args(words.iter().skip(1)).env(LIMITED, limit.to_string()).stderr(Stdio::piped());
    let child = command.spawn().ok()?;
    let process = child.id();
    let status = forward_messages(child).ok()?;
    if let Some(code) = status.code() {
        return Some(u8::try_from(code).unwrap_or(1));
    }
    remove_left_over(words, process);
    print_message("error", &format!("the command ran out of memory: {what}"));
    Some(1)
}

/// Returns the number of bytes that the command may use (0 if another limit applies), and the
/// message for a command that exceeds the limit. Returns `None` if there is no limit.
fn memory_limit(words: &[OsString]) -> Option<(u64, String)> {
    let limits = [Resource::As, Resource::Data].map(|resource| getrlimit(resource).current);
    let of_system = limits.into_iter().flatten().min();
    let may_ask = words
        .iter()
        .filter_map(|word| word.to_str())
        .any(|word| word.starts_with("--max-memory") || word == "thumbnailer");
    if !may_ask && of_system.is_none() {
        return None;
    }
    // Invalid words need no second process: this process reports them.
    let words = negative_numbers::join_negative_numbers(words.iter().cloned(), Args::command);
    let args = usage_advice::parse_args(&words).ok()?;
    let size = |bytes: u64| format!("{} MiB", bytes >> 20);
    if let Some(bytes) = args.max_memory {
        let help = "use a smaller picture, fewer samples or a larger `--max-memory`";
        return Some((bytes, format!("--max-memory allows {}\n  = help: {help}", size(bytes))));
    }
    if matches!(args.command, Command::Thumbnailer(_)) {
        let help = "raise --max-memory-bytes";
        return Some((0, format!("this thumbnail needs too much memory\n  = help: {help}")));
    }
    let bytes = of_system?;
    Some((0, format!("the system allows {}\n  = help: raise the limit (`ulimit`)", size(bytes))))
}

/// Forwards a process's messages as they arrive, except the standard library's message about
/// running out of memory, and waits for the process to end.
fn forward_messages(mut child: Child) -> std::io::Result<std::process::ExitStatus> {
    if let Some(messages) = child.stderr.take() {
        let mut reader = BufReader::new(messages);
        let (mut line, mut is_over) = (Vec::new(), false);
        while reader.read_until(b'\n', &mut line)? > 0 {
            // A backtrace may follow.
            is_over |= line.starts_with(LAST_WORDS.as_bytes());
            if !is_over {
                // A closed stream is not an error.
                let _ = std::io::stderr().write_all(&line);
            }
            line.clear();
        }
    }
    child
        .wait()
        .inspect(|status| debug_assert!(status.code().is_some() || status.signal().is_some()))
}

/// Removes a killed process's temporary files from the current folder and the folders of the words.
fn remove_left_over(words: &[OsString], process: u32) {
    let ending = format!(".{process}.part");
    let of_words = words.iter().skip(1).filter_map(|word| Path::new(word).parent());
    let mut folders: Vec<PathBuf> = of_words.map(Path::to_owned).collect();
    folders.push(PathBuf::new());
    folders.sort_unstable();
    folders.dedup();
    for folder in folders {
        let folder = if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder };
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            if entry.file_name().to_string_lossy().ends_with(&ending) {
                // It may have been removed already.
                let _ = std::fs::remove_file(entry.path());
            }
        }
    }
}
