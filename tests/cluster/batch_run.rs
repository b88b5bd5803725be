//! A run of `alberti batch`: in one process, or as a Slurm array job.

use crate::cluster::run_command;
use crate::cluster::slurm::{Cluster, LONGEST_WAIT, create_folder};
use alberti_tests::project_root;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

/// Flags of every run. The pictures are large enough that the run outlasts the failures of nodes.
const FLAGS: [&str; 6] = ["--size", "1024x768", "--job-seconds", "6", "--job-memory", "1GiB"];
/// Twelve shards, of which at most three run at a time.
const ARRAY: &str = "--array=0-11%3";

/// A run with a separate output folder.
pub struct BatchRun {
    /// The test folder, with the list of jobs.
    folder: PathBuf,
    /// The name of the run and of its output folder.
    name: String,
    /// The program under test.
    program: PathBuf,
}

impl BatchRun {
    /// Creates a run of the job list in a folder.
    pub fn new(folder: &Path, name: &str, program: &Path) -> Self {
        Self { folder: folder.to_owned(), name: name.to_owned(), program: program.to_owned() }
    }

    /// Returns the folder with the pictures and reports.
    pub fn out_dir(&self) -> PathBuf {
        self.folder.join(&self.name)
    }

    /// Returns the arguments that all commands of the run share.
    fn arguments(&self) -> Vec<String> {
        let path = |name: &str| self.folder.join(name).display().to_string();
        let own =
            ["--list".to_owned(), path("jobs.jsonl"), "--out-dir".to_owned(), path(&self.name)];
        own.into_iter().chain(FLAGS.map(str::to_owned)).collect()
    }

    /// Returns a command that runs the program with the shared arguments.
    fn batch(&self) -> Command {
        let mut command = Command::new(&self.program);
        command.arg("batch").args(self.arguments());
        command
    }

    /// Runs all jobs in one process.
    pub fn run_alone(&self) -> Result<(), String> {
        run_batch(&mut self.batch(), &[1])
    }

    /// Merges the reports.
    pub fn merge(&self) -> Result<(), String> {
        run_batch(self.batch().arg("--merge"), &[0, 1])
    }

    /// Runs the program with `--verify`; returns its exit code and its standard output.
    pub fn verify(&self) -> Result<(i32, String), String> {
        let output = self.batch().arg("--verify").output().map_err(|error| error.to_string())?;
        let code = output.status.code().ok_or("alberti batch --verify was killed")?;
        Ok((code, String::from_utf8_lossy(&output.stdout).into_owned()))
    }

    /// Submits the array job with the published script.
    pub fn submit(&self, cluster: &Cluster) -> Result<Submitted, String> {
        let logs = self.folder.join("logs");
        create_folder(&logs)?;
        let mut sbatch = cluster.command("sbatch");
        sbatch.args(["--parsable", "--requeue", ARRAY, "--output"]);
        sbatch.arg(logs.join(format!("{}-%A-%a.txt", self.name)));
        sbatch.arg(project_root().join("deploy/slurm/batch.sh")).args(self.arguments());
        sbatch.env("ALBERTI", &self.program);
        let start = Instant::now();
        Ok(Submitted { job: run_command(&mut sbatch)?.trim().to_owned(), start })
    }
}

/// Runs the program, which must exit with one of `codes`.
fn run_batch(batch: &mut Command, codes: &[i32]) -> Result<(), String> {
    let output = batch.output().map_err(|error| format!("alberti: {error}"))?;
    if output.status.code().is_some_and(|code| codes.contains(&code)) {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(format!("alberti batch exited with {}, not one of {codes:?}: {said}", output.status))
}

/// An array job in the queue.
pub struct Submitted {
    /// The job number.
    job: String,
    /// The time of submission.
    start: Instant,
}

impl Submitted {
    /// Waits for the job to end; returns the time since it was submitted.
    pub fn wait(&self, cluster: &Cluster) -> Result<Duration, String> {
        self.wait_until(cluster, || false)?.ok_or_else(|| "the job did not end".to_owned())
    }

    /// Waits until a condition holds or the job ends. If the job ended, returns its time.
    pub fn wait_until(
        &self,
        cluster: &Cluster,
        mut is_so: impl FnMut() -> bool,
    ) -> Result<Option<Duration>, String> {
        loop {
            if is_so() {
                return Ok(None);
            }
            if !cluster.has_job(&self.job)? {
                return Ok(Some(self.start.elapsed()));
            }
            if self.start.elapsed() > LONGEST_WAIT {
                return Err(format!("job {} took more than {LONGEST_WAIT:?}", self.job));
            }
            std::thread::sleep(Duration::from_millis(100));
        }
    }
}
