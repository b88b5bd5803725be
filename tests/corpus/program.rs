//! The program under test, run as a process.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The time limit per file. The largest file has eight million triangles and takes three seconds in
/// an unoptimized build; the machine may be busy with other work.
const TIME_LIMIT: Duration = Duration::from_secs(30);

/// The program `alberti`.
pub struct Program {
    path: PathBuf,
}

/// The result of a run.
pub struct Run {
    /// The exit code, or `None` if a signal killed the process.
    pub code: Option<i32>,
    /// Whether it was killed at the time limit.
    pub hung: bool,
    /// Everything it wrote to standard error.
    pub stderr: String,
}

impl Program {
    /// Returns the program, after building it if necessary.
    pub fn build() -> Result<Self, String> {
        Ok(Self { path: alberti_tests::program_path()? })
    }

    /// Renders `input` to `picture`, and kills the process at the time limit.
    pub fn render(&self, input: &Path, picture: &Path, size: (u32, u32)) -> Result<Run, String> {
        let log = picture.with_extension("log");
        let stderr = File::create(&log).map_err(|error| error.to_string())?;
        let mut process = Command::new(&self.path)
            .arg("render")
            .arg(input)
            .arg("-o")
            .arg(picture)
            .arg("--size")
            .arg(format!("{}x{}", size.0, size.1))
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(stderr)
            .spawn()
            .map_err(|error| format!("cannot start the program: {error}"))?;
        let end = Instant::now() + TIME_LIMIT;
        let mut hung = false;
        let status = loop {
            if let Some(status) = process.try_wait().map_err(|error| error.to_string())? {
                break status;
            }
            if Instant::now() > end && !hung {
                hung = true;
                process.kill().map_err(|error| error.to_string())?;
            }
            std::thread::sleep(Duration::from_millis(5));
        };
        let stderr = String::from_utf8_lossy(&std::fs::read(&log).unwrap_or_default()).into_owned();
        Ok(Run { code: status.code(), hung, stderr })
    }
}
