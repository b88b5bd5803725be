//! Runs other processes: builds and runs the program `alberti`, and calls Cargo.

use crate::test::process_seconds;
use crate::workspace::{project_root, target_folder};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};

/// A build profile of the program. All of them must render the same pixels.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Build {
    Debug,
    Release,
    /// Release, for processors with AVX2 and fused multiply-add.
    Wide,
}

impl Build {
    /// Returns the profile's name in messages and folder names.
    pub fn name(self) -> &'static str {
        match self {
            Self::Debug => "debug",
            Self::Release => "release",
            Self::Wide => "wide",
        }
    }
}

/// The program, built with one profile.
pub struct Program {
    path: PathBuf,
}

impl Program {
    /// Builds the program and returns a handle to it.
    pub fn build(build: Build) -> Result<Self, String> {
        let mut cargo = cargo_command(&["build", "--quiet", "--bin", "alberti"]);
        let mut folder = target_folder();
        if build == Build::Debug {
            // As in the tests, build with the features of the whole workspace, so that nothing is
            // compiled twice.
            cargo.arg("--workspace");
        } else {
            cargo.args(["--package", "alberti", "--release"]);
        }
        if build == Build::Wide {
            folder = folder.join("wide");
            cargo.env("RUSTFLAGS", "-Ctarget-feature=+avx2,+fma").env("CARGO_TARGET_DIR", &folder);
        }
        compile(|| run_command(&mut cargo))?;
        let profile = if build == Build::Debug { "debug" } else { "release" };
        let name = format!("alberti{}", std::env::consts::EXE_SUFFIX);
        Ok(Self { path: folder.join(profile).join(name) })
    }

    /// Builds the release program of another checkout, in the target folder of that checkout.
    pub fn build_checkout(root: &Path) -> Result<Self, String> {
        let folder = root.join("target");
        // In old revisions, the program was part of the library package.
        let package = if root.join("crates/alberti").is_dir() { "alberti" } else { "pipeline" };
        let mut cargo = cargo_command(&["build", "--quiet", "--release", "--locked"]);
        cargo.args(["--package", package, "--bin", "alberti"]);
        run_command(cargo.current_dir(root).env("CARGO_TARGET_DIR", &folder))?;
        let name = format!("alberti{}", std::env::consts::EXE_SUFFIX);
        Ok(Self { path: folder.join("release").join(name) })
    }

    /// Creates a handle to a program that has already been built.
    pub fn at(path: &Path) -> Self {
        Self { path: path.to_owned() }
    }

    /// Returns its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Renders a scene. Returns the program's message if it fails.
    pub fn render(&self, scene: &Path, picture: &Path, flags: &[&str]) -> Result<(), String> {
        run_command(
            Command::new(&self.path).arg("render").arg(scene).arg("-o").arg(picture).args(flags),
        )
    }

    /// Renders a scene from its text, with paths relative to a folder.
    pub fn render_text(&self, text: &str, folder: &Path, picture: &Path) -> Result<(), String> {
        let mut render = Command::new(&self.path);
        render.current_dir(folder).args(["render", "-", "-o"]).arg(picture);
        let shown = command_line(&render);
        render.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = render.spawn().map_err(|error| format!("{shown}: {error}"))?;
        if let Some(mut input) = child.stdin.take() {
            input.write_all(text.as_bytes()).map_err(|error| format!("{shown}: {error}"))?;
        }
        let output = child.wait_with_output().map_err(|error| format!("{shown}: {error}"))?;
        let said = String::from_utf8_lossy(&output.stderr);
        if output.status.success() { Ok(()) } else { Err(format!("`{shown}` failed\n{said}")) }
    }
}

/// Returns a command that runs Cargo in the workspace root: the same Cargo that started this
/// program.
pub fn cargo_command(arguments: &[&str]) -> Command {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(project_root()).args(arguments);
    cargo
}

/// The CPU time that [`compile`] has counted as compiler time, in hundredths of a second.
static COMPILE_TICKS: AtomicU64 = AtomicU64::new(0);

/// Does some work and counts its CPU time as compiler time.
pub fn compile<T>(work: impl FnOnce() -> T) -> T {
    let before = process_seconds();
    let result = work();
    let ticks = ((process_seconds() - before) * 100.0).round() as u64;
    COMPILE_TICKS.fetch_add(ticks, Ordering::Relaxed);
    result
}

/// Returns the CPU seconds that [`compile`] has counted.
pub fn compile_seconds() -> f64 {
    COMPILE_TICKS.load(Ordering::Relaxed) as f64 / 100.0
}

/// Runs a command to completion. Its output is shown only if it fails.
pub fn run_command(command: &mut Command) -> Result<(), String> {
    capture_output(command).map(drop)
}

/// Runs a command to completion and returns its standard output.
pub fn capture_output(command: &mut Command) -> Result<String, String> {
    let shown = command_line(command);
    let output = command.output().map_err(|error| format!("{shown}: {error}"))?;
    let [stdout, stderr] =
        [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    if output.status.success() {
        return Ok(stdout);
    }
    Err(format!("`{shown}` failed ({})\n{stdout}{stderr}", output.status))
}

/// Runs a command to completion with visible output.
pub fn run_visibly(command: &mut Command) -> Result<(), String> {
    let shown = command_line(command);
    let status = command.status().map_err(|error| format!("{shown}: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("`{shown}` failed ({status})")) }
}

/// Formats a command as it would be typed.
pub fn command_line(command: &Command) -> String {
    let program = Path::new(command.get_program()).file_stem().unwrap_or_default();
    let words = std::iter::once(program).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}
