//! `alberti scene fmt`: formats scene files.

use crate::{CliError, print_stdout, print_text};
use files::visible_path;
use scene_file::format_source;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Arguments of `alberti scene fmt`.
#[derive(Debug, clap::Args)]
pub(crate) struct FmtArgs {
    /// Scenes (.ron); `-` reads one from the standard input and writes it to the standard output
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Write nothing; list unformatted files by name, and exit with 1 if there are any
    #[arg(long)]
    check: bool,
}

/// Formats the files, or with `--check` lists the unformatted ones.
///
/// A file that is already formatted is not written, so its modification time stays the same. If the
/// command fails on a syntax error, earlier files have already been formatted.
///
/// # Errors
/// Returns an error if a file cannot be read, parsed or written.
pub(crate) fn run(args: &FmtArgs) -> Result<ExitCode, CliError> {
    let mut differ = Vec::new();
    for path in &args.files {
        let text = read_source(path)?;
        let name = path.display().to_string();
        let better = format_source(&name, &text).map_err(pipeline::ResolveError::from)?;
        let same = better == text;
        if !same {
            differ.push(visible_path(path));
        }
        match (args.check, path.as_os_str() == "-") {
            (true, _) => {}
            (false, true) => print_stdout(better.as_bytes())?,
            (false, false) if same => {}
            (false, false) => pipeline::write_file(path, better.as_bytes())?,
        }
    }
    if !args.check || differ.is_empty() {
        return Ok(ExitCode::SUCCESS);
    }
    print_text(&format!("{}\n", differ.join("\n")))?;
    Ok(ExitCode::FAILURE)
}

/// Reads a file, or the standard input for `-`.
///
/// # Errors
/// Returns an error if the input cannot be read or is not UTF-8.
fn read_source(path: &Path) -> Result<String, CliError> {
    let mut text = String::new();
    let read = if path.as_os_str() == "-" {
        std::io::stdin().read_to_string(&mut text).map(drop)
    } else {
        std::fs::read_to_string(path).map(|read| text = read)
    };
    read.map_err(|cause| CliError::Usage(format!("cannot read {}: {cause}", visible_path(path))))?;
    Ok(text)
}
