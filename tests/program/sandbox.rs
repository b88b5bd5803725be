//! A sandbox to run the program in: an empty folder for each test.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::OnceLock;

/// An empty folder, and the program to run in it.
pub(crate) struct Sandbox {
    folder: PathBuf,
}

/// The result of a run.
pub(crate) struct RunResult {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl RunResult {
    /// Returns the exit code and output of a program that was not ended by a signal.
    pub(crate) fn of(output: Output) -> Self {
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("the program writes UTF-8");
        Self {
            code: output.status.code().expect("no signal ends the program"),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }
}

fn program() -> &'static Path {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    PROGRAM.get_or_init(|| alberti_tests::program_path().expect("the program"))
}

impl Sandbox {
    /// Creates a folder named after the test, with the suffix `SANDBOX_SUFFIX`.
    pub(crate) fn new(name: &str) -> Self {
        let suffix = std::env::var("SANDBOX_SUFFIX").unwrap_or_default();
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}{suffix}"));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).expect("a folder for the test");
        Self { folder }
    }

    /// Runs the program here.
    pub(crate) fn run(&self, arguments: &[&str]) -> RunResult {
        let mut command = Command::new(program());
        let output = command.args(arguments).current_dir(&self.folder).output();
        RunResult::of(output.expect("the program starts"))
    }

    /// Runs the program here with its standard output in a file; returns its standard error stream.
    pub(crate) fn stderr_with_output_in(&self, file: &str, arguments: &[&str]) -> String {
        let output = std::fs::File::create(self.path_of(file)).expect("a file");
        let mut command = Command::new(program());
        let run = command.args(arguments).current_dir(&self.folder).stdout(output);
        let run = run.stderr(Stdio::piped()).output().expect("the program starts");
        String::from_utf8(run.stderr).expect("the program writes UTF-8")
    }

    /// Runs the program here with another value of an environment variable.
    pub(crate) fn run_with_variable(
        &self,
        (name, value): (&str, &Path),
        arguments: &[&str],
    ) -> RunResult {
        let mut command = Command::new(program());
        let output = command.args(arguments).current_dir(&self.folder).env(name, value).output();
        RunResult::of(output.expect("the program starts"))
    }

    /// Starts the program here; its standard input is a pipe.
    pub(crate) fn start(&self, arguments: &[&str]) -> Child {
        let mut command = Command::new(program());
        let pipes = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        pipes.args(arguments).current_dir(&self.folder).spawn().expect("the program starts")
    }

    /// Runs the program here with bytes on its standard input; returns its exit code and its
    /// standard output.
    pub(crate) fn run_with_input(&self, arguments: &[&str], input: &[u8]) -> (i32, Vec<u8>) {
        let output = self.spawn_with_input(arguments, input);
        (output.status.code().expect("no signal ends the program"), output.stdout)
    }

    /// Runs the program here with bytes on its standard input; returns its standard error stream.
    pub(crate) fn stderr_with_input(&self, arguments: &[&str], input: &[u8]) -> String {
        String::from_utf8(self.spawn_with_input(arguments, input).stderr)
            .expect("the program writes UTF-8")
    }

    fn spawn_with_input(&self, arguments: &[&str], input: &[u8]) -> Output {
        let mut child = self.start(arguments);
        // A program that has read enough may close its input.
        let _ = child.stdin.take().expect("a pipe").write_all(input);
        child.wait_with_output().expect("the program ends")
    }

    pub(crate) fn path_of(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    pub(crate) fn write_file(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path_of(name), content).expect("a file for the test");
    }

    /// Copies a model from `scenes/models` to this folder.
    pub(crate) fn copy_model(&self, model: &str) {
        let from = alberti_tests::project_root().join("scenes/models").join(model);
        std::fs::copy(from, self.path_of(model)).expect("a committed model");
    }

    /// Returns the file names here, sorted.
    pub(crate) fn file_names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.folder).expect("the folder");
        let name = |entry: std::io::Result<std::fs::DirEntry>| {
            entry.expect("an entry").file_name().into_string().expect("a UTF-8 name")
        };
        let mut names: Vec<String> = entries.map(name).collect();
        names.sort();
        names
    }

    /// Returns the width, height and RGBA pixels of a PNG in this folder.
    pub(crate) fn read_picture(&self, name: &str) -> (u32, u32, Vec<[u8; 4]>) {
        alberti_tests::read_png(&self.path_of(name)).expect("a picture")
    }
}
