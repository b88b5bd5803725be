//! The program under test, run as a process.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// So long a file may take. The largest has eight million triangles and takes three seconds of a processor without
/// optimisation; the machine may have other work to do.
const TIME_LIMIT: Duration = Duration::from_secs(30);

/// The program `alberti`.
pub struct Program {
    path: PathBuf,
}

/// How a run ended.
pub struct Run {
    /// The exit code; `None` if a signal ended the process.
    pub code: Option<i32>,
    /// Whether the time limit ended it.
    pub hung: bool,
    pub stderr: String,
}

impl Program {
    /// The program that all tests use.
    pub fn build() -> Result<Self, String> {
        Ok(Self { path: alberti_tests::program_path()? })
    }

    /// Draws a file into `picture`, as large as `size`, and waits no longer than the limit.
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
            .map_err(|error| format!("the program does not start: {error}"))?;
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
