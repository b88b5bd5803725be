//! A fuzzing session: one run of a target, with libFuzzer's processes, their time limit and their
//! reports.

use crate::workspace::relative_path;
use std::collections::BTreeSet;
use std::fmt;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Settings of a run.
pub struct Session {
    /// The target's executable.
    pub program: PathBuf,
    /// Whether the target prints messages for each case.
    pub is_talkative: bool,
    /// The path of the dictionary.
    pub words: Option<PathBuf>,
    /// The folder that contains `seeds`, `corpus` and `artifacts`.
    pub folder: PathBuf,
    /// The limit of the run in minutes of CPU time.
    pub minutes: f64,
    /// The number of concurrent processes.
    pub jobs: usize,
}

/// The results of a run.
pub struct SessionReport {
    /// The name of the target.
    pub name: String,
    /// The CPU time of all jobs.
    time: Duration,
    executions: u64,
    /// The number of branches reached.
    edges: u64,
    /// The number of branches, counted once for each range of how often they were taken.
    features: u64,
    corpus: usize,
    /// Inputs that crashed the target or exceeded a limit.
    pub crashes: Vec<PathBuf>,
}

/// A libFuzzer process.
struct FuzzJob {
    child: Child,
    log: PathBuf,
    start: Instant,
    time: Duration,
    done: bool,
}

impl Session {
    /// Runs until the time is used up or something crashes.
    pub fn run_jobs(&self, name: &str) -> Result<SessionReport, String> {
        let before = list_artifacts(&self.folder)?;
        let mut jobs = (0..self.jobs).map(|n| self.start_job(n)).collect::<Result<Vec<_>, _>>()?;
        let budget = Duration::from_secs_f64(60.0 * self.minutes);
        loop {
            sleep(Duration::from_millis(200));
            jobs.iter_mut().try_for_each(FuzzJob::update_peak)?;
            let time: Duration = jobs.iter().map(|job| job.time).sum();
            if time >= budget || jobs.iter().any(|job| job.done) {
                break;
            }
        }
        let unexpected = jobs.iter().any(|job| job.done);
        for job in &mut jobs {
            job.stop_process()?;
        }
        let new = list_artifacts(&self.folder)?.difference(&before).cloned().collect::<Vec<_>>();
        let mut report = self.session_report(name, &jobs)?;
        report.crashes.extend(new);
        if unexpected {
            for job in &jobs {
                println!("{}", last_lines(&fs::read_to_string(&job.log).unwrap_or_default()));
            }
            // A known crash is not written again, but it still counts.
            if report.crashes.is_empty() {
                report.crashes.extend(before);
            }
            if report.crashes.is_empty() {
                return Err(format!(
                    "{name} exited unexpectedly; see {}",
                    relative_path(&jobs[0].log)
                ));
            }
            report.crashes.iter().for_each(|crash| println!("crash: {}", relative_path(crash)));
        }
        Ok(report)
    }

    fn start_job(&self, number: usize) -> Result<FuzzJob, String> {
        let log = self.folder.join(format!("job-{number}.log"));
        let file = File::create(&log).map_err(|error| format!("{}: {error}", log.display()))?;
        let folder = |part: &str| self.folder.join(part);
        // These limits are a last resort, because each case checks its own time and memory.
        let mut command = Command::new(&self.program);
        command.args(["-timeout=30", "-rss_limit_mb=2048", "-print_final_stats=1"]);
        if self.is_talkative {
            // Hide the messages of the program under test. The fuzzer's own messages still appear.
            command.arg("-close_fd_mask=3");
        }
        command.arg(format!("-artifact_prefix={}/", folder("artifacts").display()));
        if let Some(words) = &self.words {
            command.arg(format!("-dict={}", words.display()));
        }
        command.args(["corpus", "seeds", "artifacts"].map(folder));
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(file);
        let child =
            command.spawn().map_err(|error| format!("{}: {error}", self.program.display()))?;
        let start = Instant::now();
        Ok(FuzzJob { child, log, start, time: Duration::ZERO, done: false })
    }

    fn session_report(&self, name: &str, jobs: &[FuzzJob]) -> Result<SessionReport, String> {
        let logs = jobs.iter().map(|job| fs::read_to_string(&job.log).unwrap_or_default());
        let logs: Vec<String> = logs.collect();
        let most = |name: &str| logs.iter().filter_map(|log| last_number(log, name)).max();
        let executions = logs.iter().filter_map(|log| executed_runs(log)).sum();
        let corpus = fs::read_dir(self.folder.join("corpus")).map_or(0, Iterator::count);
        Ok(SessionReport {
            name: name.to_owned(),
            time: jobs.iter().map(|job| job.time).sum(),
            executions,
            edges: most("cov:").unwrap_or(0),
            features: most("ft:").unwrap_or(0),
            corpus,
            crashes: Vec::new(),
        })
    }
}

impl FuzzJob {
    /// Updates the process's running time, and whether it has exited.
    fn update_peak(&mut self) -> Result<(), String> {
        // If the system does not report the CPU time, use the clock.
        self.time =
            processor_time(self.child.id()).unwrap_or_else(|| self.start.elapsed()).max(self.time);
        self.done = self.child.try_wait().map_err(|error| error.to_string())?.is_some();
        Ok(())
    }

    /// Stops the process with an interrupt, as Ctrl-C does, so that it still reports its results.
    fn stop_process(&mut self) -> Result<(), String> {
        if !self.done {
            let id = self.child.id().to_string();
            let asked = Command::new("kill").args(["-INT", &id]).status();
            if !asked.is_ok_and(|status| status.success()) {
                self.child.kill().map_err(|error| error.to_string())?;
            }
        }
        self.child.wait().map(drop).map_err(|error| error.to_string())
    }
}

/// Returns the CPU time of a process, if the system reports it.
fn processor_time(process: u32) -> Option<Duration> {
    let text = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    // The name is in parentheses and may contain spaces. Linux counts in hundredths of a second,
    // regardless of its internal clock.
    let (_, after) = text.rsplit_once(')')?;
    let mut fields = after.split_whitespace().skip(11);
    let ticks = fields.next()?.parse::<u64>().ok()? + fields.next()?.parse::<u64>().ok()?;
    Some(Duration::from_millis(10 * ticks))
}

/// Returns all inputs that have ever crashed the target.
fn list_artifacts(folder: &Path) -> Result<BTreeSet<PathBuf>, String> {
    let folder = folder.join("artifacts");
    let entries =
        fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(entries.filter_map(|entry| Some(entry.ok()?.path())).collect())
}

/// Returns the number after the last occurrence of a word.
fn last_number(log: &str, word: &str) -> Option<u64> {
    let (_, after) = log.rsplit_once(&format!(" {word} "))?;
    after.split_whitespace().next()?.parse().ok()
}

/// Returns the number of inputs tried, from the statistics at the end or, after a crash, from the
/// last progress line.
fn executed_runs(log: &str) -> Option<u64> {
    if let Some((_, after)) = log.rsplit_once("stat::number_of_executed_units:") {
        return after.split_whitespace().next()?.parse().ok();
    }
    let progress = log.lines().rev().find_map(|line| line.strip_prefix('#'))?;
    progress.split_whitespace().next()?.parse().ok()
}

/// Returns a log's last lines, or its lines from the first panic on, without progress lines.
fn last_lines(log: &str) -> String {
    let lines: Vec<&str> = log.lines().filter(|line| !line.starts_with('#')).collect();
    let last = lines.len().saturating_sub(LAST_LINES);
    let start = lines.iter().position(|line| line.contains("panicked at")).unwrap_or(last);
    lines[start..].iter().take(LAST_LINES).copied().collect::<Vec<_>>().join("\n")
}

/// The number of lines to show, which is enough to see where a crash happened.
const LAST_LINES: usize = 30;

impl SessionReport {
    /// The column headings of the table of reports.
    pub const HEADING: &str =
        "target       CPU min  executions   per s    edges  features  corpus  crashes";
}

impl fmt::Display for SessionReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, time, executions, edges, features, corpus, crashes } = self;
        let (seconds, crashes) = (time.as_secs_f64().max(0.01), crashes.len());
        let (minutes, rate) = (seconds / 60.0, *executions as f64 / seconds);
        write!(
            f,
            "{name:11} {minutes:8.1} {executions:11} {rate:7.0} {edges:8} {features:9} {corpus:7} {crashes:8}"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOG: &str = "INFO: seed corpus: 2\n#3 INITED cov: 12 ft: 34 corp: 2/9b\n\
        #4096 pulse  cov: 15 ft: 40 corp: 3/12b lim: 4096 exec/s: 2048 rss: 31Mb\n";

    #[test]
    fn progress_is_parsed_from_the_log() {
        assert_eq!((last_number(LOG, "cov:"), last_number(LOG, "ft:")), (Some(15), Some(40)));
        assert_eq!(executed_runs(LOG), Some(4096));
        let ended = format!("{LOG}stat::number_of_executed_units: 5000\nstat::peak_rss_mb: 1\n");
        assert_eq!(executed_runs(&ended), Some(5000));
        assert_eq!((last_number("", "cov:"), executed_runs("")), (None, None));
    }

    #[test]
    fn the_last_lines_begin_with_the_panic() {
        let frames = "  at frame\n".repeat(90);
        let log =
            format!("INFO: x\n#1 INITED\nthread 't' panicked at a.rs:1:2:\n#2 NEW\nwhy\n{frames}");
        let shown = last_lines(&log);
        assert!(shown.starts_with("thread 't' panicked at a.rs:1:2:\nwhy\n"), "{shown}");
        assert_eq!(
            (shown.lines().count(), last_lines("#1\na\nb\n")),
            (LAST_LINES, "a\nb".to_owned())
        );
    }

    #[test]
    fn this_process_has_used_less_than_an_hour_of_cpu_time() {
        let time = processor_time(std::process::id());
        assert!(time.is_none_or(|time| time < Duration::from_secs(3600)), "{time:?}");
    }
}
