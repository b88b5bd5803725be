//! `alberti batch` on a Slurm cluster loses nothing when a node dies and another is cut off.
//!
//! ```text
//!  one process ─► the expected pictures
//!  array job   ─► the time of an undisturbed run
//!  array job   ─► a third is done: a node dies; half is done: another is cut off for 20 s
//!                 every picture exists and is correct, every bad model has one record
//! ```
//!
//! A controller and three nodes run in namespaces of this machine, with `deploy/slurm/batch.sh` as
//! the job script. Everything stops when the test stops, however it ends. If Slurm is not installed
//! or the test may not create namespaces, the step is reported as skipped; `.ci/run` installs Slurm
//! if it can. `CLUSTER_RUNS=3` repeats the disturbed run. The time is compared with the time of an
//! undisturbed run, unless other programs are using the processors.

mod batch_run;
mod checks;
mod models;
mod node;
mod sandbox;
mod slurm;
mod watcher;

use alberti_tests::harness::{Arguments, Tally, TemporaryFolder, run_program};
use batch_run::BatchRun;
use slurm::Cluster;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::{Duration, Instant};

/// The name of the test in its output.
const NAME: &str = "cluster";
/// The argument for the process inside the namespaces; the test folder follows it.
const INSIDE: &str = "--inside";

pub fn run() -> ExitCode {
    // The suite name comes first.
    let mut words = std::env::args().skip(2);
    if words.next().as_deref() == Some(INSIDE) {
        let folder = words.next().map(PathBuf::from);
        return run_program(NAME, |_| test_cluster(&folder.ok_or("missing folder")?));
    }
    let outcome = run_sandbox(&Arguments::from_env());
    outcome.unwrap_or_else(|reason| run_program(NAME, |_| Err(reason)))
}

/// Runs the test in separate namespaces if this machine supports them.
fn run_sandbox(arguments: &Arguments) -> Result<ExitCode, String> {
    if !arguments.select(NAME) {
        return Ok(ExitCode::SUCCESS);
    }
    let missing = slurm::missing_program().or_else(sandbox::missing_right);
    if let Some(missing) = missing {
        return Ok(run_program(NAME, |_| {
            let mut tally = Tally::default();
            tally.skip(NAME, &missing);
            Ok(tally)
        }));
    }
    let program = alberti_tests::program_path()?;
    let folder = TemporaryFolder::create(NAME)?;
    let test = std::env::current_exe().map_err(|error| error.to_string())?;
    let mut inside = sandbox::isolated_command(&test);
    inside.arg(NAME).arg(INSIDE).arg(folder.path()).env("ALBERTI", program);
    let status = inside.status().map_err(|error| format!("unshare: {error}"))?;
    Ok(if status.success() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Runs the whole test inside the namespaces.
fn test_cluster(folder: &Path) -> Result<Tally, String> {
    let mut tally = Tally::default();
    let mut load = foreign_load()?;
    let jobs = models::write_models(folder)?;
    let program = alberti_tests::program_path()?;
    let run = |name: &str| BatchRun::new(folder, name, &program);
    let single = run("single");
    let start = Instant::now();
    single.run_alone()?;
    println!("one process: {:.1} s", start.elapsed().as_secs_f64());
    let expected = checks::read_pictures(&single, &jobs)?;
    let mut cluster = Cluster::start(folder)?;
    let undisturbed = run("undisturbed");
    let time = undisturbed.submit(&cluster)?.wait(&cluster)?;
    println!("three nodes, undisturbed: {:.1} s", time.as_secs_f64());
    tally.record("undisturbed", checks::check_pictures(&undisturbed, &expected));
    let mut disturbed_times = Vec::new();
    for number in 0..run_count() {
        let name = format!("disturbed-{}", number + 1);
        let outcome = test_disturbed(&mut cluster, &run(&name), &expected);
        let outcome = outcome.map(|time| disturbed_times.push(time));
        tally.record(&name, outcome.map_err(|reason| format!("{reason}\n{}", cluster.log_end())));
    }
    load = load.max(foreign_load()?);
    for disturbed in disturbed_times {
        let outcome = checks::check_time(disturbed, time);
        if load > MAX_LOAD {
            let share = load * 100.0;
            tally.skip(
                "cluster: time",
                &format!("other programs use {share:.0} % of the processors"),
            );
        } else {
            tally.record("time", outcome);
        }
    }
    Ok(tally)
}

/// The maximum share of the processors that other programs may use. Above it, times are not
/// compared.
const MAX_LOAD: f64 = 0.25;

/// Returns the share of the processors in use during a second in which this test does nothing.
fn foreign_load() -> Result<f64, String> {
    let read_ticks = || -> Result<(u64, u64), String> {
        let text = std::fs::read_to_string("/proc/stat").map_err(|error| error.to_string())?;
        let numbers = text.lines().next().unwrap_or_default().split_whitespace().skip(1);
        let ticks: Vec<u64> = numbers.filter_map(|word| word.parse().ok()).collect();
        // The fourth and fifth fields: idle, and idle while a disk is working.
        Ok((ticks.iter().skip(3).take(2).sum(), ticks.iter().take(8).sum()))
    };
    let (idle, all) = read_ticks()?;
    std::thread::sleep(Duration::from_secs(1));
    let (idle_after, all_after) = read_ticks()?;
    let (idle, all) = (idle_after.saturating_sub(idle), all_after.saturating_sub(all).max(1));
    Ok(1.0 - idle as f64 / all as f64)
}

/// Returns the number of disturbed runs.
fn run_count() -> u32 {
    std::env::var("CLUSTER_RUNS").ok().and_then(|runs| runs.parse().ok()).unwrap_or(1)
}

/// Performs one run in which a node dies and another is cut off, and returns its time.
fn test_disturbed(
    cluster: &mut Cluster,
    run: &BatchRun,
    expected: &checks::Expected,
) -> Result<Duration, String> {
    cluster.wait_for_nodes()?;
    let watcher = watcher::Watcher::start(&run.out_dir(), expected.pictures.clone());
    let submitted = run.submit(cluster)?;
    let time = disturb(cluster, &watcher, &submitted, expected.pictures.len())?;
    cluster.start_dead_nodes()?;
    cluster.wait_for_nodes()?;
    let seen = watcher.stop()?;
    checks::check_draws(&seen, run)?;
    run.merge()?;
    checks::check_pictures(run, expected)?;
    checks::check_records(run, expected)?;
    let before = checks::Snapshot::of(run)?;
    run.submit(cluster)?.wait(cluster)?;
    before.check_unchanged(run)?;
    checks::check_verdict(&run.verify()?, expected)?;
    Ok(time)
}

/// Kills a node when a third of the pictures are done and cuts another off when half are; returns
/// the time until the job ends.
fn disturb(
    cluster: &mut Cluster,
    watcher: &watcher::Watcher,
    submitted: &batch_run::Submitted,
    pictures: usize,
) -> Result<Duration, String> {
    submitted.wait_until(cluster, || watcher.count() * 3 >= pictures)?;
    let killed = cluster.kill_node(1)?;
    println!("{} of {pictures} drawn; n2 dies with {killed} processes", watcher.count());
    submitted.wait_until(cluster, || watcher.count() * 2 >= pictures)?;
    println!("{} of {pictures} drawn; n3 is cut off", watcher.count());
    cluster.cut_link(2)?;
    let cut = Instant::now();
    let is_over = || cut.elapsed() >= slurm::LINK_CUT;
    let time = submitted.wait_until(cluster, is_over)?;
    std::thread::sleep(slurm::LINK_CUT.saturating_sub(cut.elapsed()));
    cluster.restore_link(2)?;
    let time = match time {
        Some(time) => time,
        None => submitted.wait(cluster)?,
    };
    println!("three nodes, one dead, one cut off: {:.1} s", time.as_secs_f64());
    Ok(time)
}

/// Runs a command until it exits, and returns its output.
///
/// # Errors
/// Returns an error, with the output, if the command does not start or fails.
pub fn run_command(command: &mut Command) -> Result<String, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| format!("{name}: {error}"))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() {
        return Ok(text);
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(format!("{name} failed ({}): {said}{text}", output.status))
}
