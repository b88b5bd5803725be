//! Runs the program whose pictures and reference the pages show.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The program `alberti`.
pub struct Program {
    path: PathBuf,
}

impl Program {
    /// Creates a program from its path. Fails if there is no such file.
    pub fn at(path: &Path) -> Result<Self, String> {
        let path = std::path::absolute(path).map_err(|error| error.to_string())?;
        if path.is_file() {
            Ok(Self { path })
        } else {
            Err(format!("{}: no such file", path.display()))
        }
    }

    /// Runs the program in a folder and returns its output.
    pub fn run(&self, folder: &Path, arguments: &[&str]) -> Result<String, String> {
        let mut command = Command::new(&self.path);
        Ok(output_of(command.args(arguments).current_dir(folder), &arguments.join(" "))?.stdout)
    }

    /// Runs a shell script in which `alberti` is this program, and returns its output. Warnings are
    /// errors.
    pub fn run_script(&self, folder: &Path, script: &str) -> Result<String, String> {
        let mut shell = Command::new("sh");
        shell.args(["-e", "-u", "-c", script]).current_dir(folder).env("PATH", self.search_path());
        let Output { stdout, stderr } = output_of(&mut shell, script)?;
        if stderr.contains("warning:") { Err(format!("{script}\n{stderr}")) } else { Ok(stdout) }
    }

    /// Returns the search path for programs, with this program's folder first.
    fn search_path(&self) -> OsString {
        let own = self.path.parent().map(Path::to_owned);
        let others = std::env::var_os("PATH").unwrap_or_default();
        let all = own.into_iter().chain(std::env::split_paths(&others));
        std::env::join_paths(all).unwrap_or(others)
    }
}

/// The output of a command.
struct Output {
    stdout: String,
    stderr: String,
}

/// Runs a command to completion. Fails if the command fails.
fn output_of(command: &mut Command, shown: &str) -> Result<Output, String> {
    let output = command.output().map_err(|error| format!("{shown}: {error}"))?;
    let [stdout, stderr] =
        [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    if output.status.success() {
        return Ok(Output { stdout, stderr });
    }
    Err(format!("{shown}\n{}, with the output\n{stderr}", output.status))
}
