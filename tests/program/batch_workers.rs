//! `alberti batch` with models that hang, crash or use up the memory, and with killed workers.

#![cfg(target_os = "linux")]

use crate::batch::{batch_sandbox, read_records};
use crate::sandbox::{RunResult, Sandbox};
use serde_json::Value;
use std::process::{Child, Command};
use std::time::{Duration, Instant};

/// Returns a sandbox with a list of three jobs: the second takes minutes, and the others are short.
fn slow_sandbox(name: &str) -> Sandbox {
    let sandbox = batch_sandbox(name);
    sandbox.write_file(
        "jobs.jsonl",
        concat!(
            "{\"input\": \"models/a.glb\", \"output\": \"first.png\", \"size\": \"8x8\"}\n",
            "{\"input\": \"models/a.glb\", \"output\": \"slow.png\", \"size\": \"16384x16384\", ",
            "\"samples\": 16}\n",
            "{\"input\": \"models/b.glb\", \"output\": \"last.png\", \"size\": \"8x8\"}\n",
        ),
    );
    sandbox
}

const SLOW: [&str; 7] = ["batch", "--list", "jobs.jsonl", "--out-dir", "out", "--threads", "1"];

/// Returns the record of a picture.
fn record_of(sandbox: &Sandbox, output: &str) -> Option<Value> {
    read_records(sandbox, "").into_iter().find(|record| record["output"] == output)
}

/// Waits until a condition holds.
fn wait_for<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let begin = Instant::now();
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(begin.elapsed() < Duration::from_secs(120), "timed out: {what}");
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Returns the child processes of a process.
fn children(process: u32) -> Vec<u32> {
    let Ok(tasks) = std::fs::read_dir(format!("/proc/{process}/task")) else { return Vec::new() };
    let lists =
        tasks.filter_map(|task| std::fs::read_to_string(task.ok()?.path().join("children")).ok());
    lists
        .flat_map(|list| list.split(' ').filter_map(|id| id.parse().ok()).collect::<Vec<_>>())
        .collect()
}

fn send_signal(process: u32, signal: &str) {
    let sent = Command::new("kill").args([format!("-{signal}"), process.to_string()]).status();
    assert!(sent.expect("kill runs").success(), "there is no process {process}");
}

/// Waits until a worker other than `known` renders the slow picture; returns its process id.
fn slow_worker(sandbox: &Sandbox, run: &Child, known: Option<u32>) -> u32 {
    wait_for("the first picture", || record_of(sandbox, "first.png"));
    wait_for("a worker", || children(run.id()).into_iter().find(|id| Some(*id) != known))
}

/// Waits for a run to exit, possibly because of a signal.
fn end_of(run: Child) -> RunResult {
    RunResult::of(run.wait_with_output().expect("the process exits"))
}

#[test]
fn a_job_that_times_out_is_one_failed_record() {
    let sandbox = slow_sandbox("batch_slow");
    let run = sandbox.run(&[&SLOW[..], &["--job-seconds", "6"]].concat());
    assert_eq!((run.code, run.stdout.as_str()), (1, "2 rendered, 0 up to date, 1 failed\n"));
    let record = record_of(&sandbox, "slow.png").expect("a record");
    let message = record["message"].as_str().expect("a message");
    assert!(message.contains("6 s") && message.contains("--job-seconds"), "{message}");
    assert!(!sandbox.path_of("out/slow.png").exists());
    assert_eq!(sandbox.read_picture("out/last.png").0, 8);
}

#[test]
fn a_job_that_needs_too_much_memory_is_one_failed_record() {
    let sandbox = slow_sandbox("batch_memory");
    let run = sandbox.run(&[&SLOW[..], &["--job-memory", "64MiB"]].concat());
    assert_eq!((run.code, run.stdout.as_str()), (1, "2 rendered, 0 up to date, 1 failed\n"));
    let record = record_of(&sandbox, "slow.png").expect("a record");
    let message = record["message"].as_str().expect("a message");
    assert!(message.contains("memory") && message.contains("--job-memory"), "{message}");
    assert_eq!(sandbox.read_picture("out/last.png").0, 8);
    let run = sandbox.run(&["batch", "models", "--out-dir", "x", "--job-memory", "1MiB"]);
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("at least 64MiB"), "{}", run.stderr);
}

#[test]
fn a_worker_killed_twice_fails_one_job() {
    let sandbox = slow_sandbox("batch_killed_worker");
    let run = sandbox.start(&SLOW);
    let first = slow_worker(&sandbox, &run, None);
    send_signal(first, "KILL");
    let second = slow_worker(&sandbox, &run, Some(first));
    assert!(record_of(&sandbox, "slow.png").is_none(), "it is retried");
    send_signal(second, "KILL");
    let run = end_of(run);
    assert_eq!((run.code, run.stdout.as_str()), (1, "2 rendered, 0 up to date, 1 failed\n"));
    let record = record_of(&sandbox, "slow.png").expect("a record");
    assert!(record["message"].as_str().expect("a message").contains("SIGKILL"), "{record}");
    assert_eq!(sandbox.read_picture("out/last.png").0, 8);
}

#[test]
fn a_crash_is_reported_with_its_signal() {
    let sandbox = slow_sandbox("batch_crash");
    let run = sandbox.start(&SLOW);
    let first = slow_worker(&sandbox, &run, None);
    send_signal(first, "ABRT");
    send_signal(slow_worker(&sandbox, &run, Some(first)), "ABRT");
    let run = end_of(run);
    assert_eq!((run.code, run.stdout.as_str()), (1, "2 rendered, 0 up to date, 1 failed\n"));
    let record = record_of(&sandbox, "slow.png").expect("a record");
    assert!(record["message"].as_str().expect("a message").contains("SIGABRT"), "{record}");
}

#[test]
fn an_interrupted_worker_ends_the_run_and_records_nothing() {
    let sandbox = slow_sandbox("batch_interrupted");
    let run = sandbox.start(&SLOW);
    send_signal(slow_worker(&sandbox, &run, None), "TERM");
    let run = end_of(run);
    assert_eq!(run.code, 128 + 15, "{}", run.stderr);
    assert!(run.stderr.contains("interrupted"), "{}", run.stderr);
    let records = read_records(&sandbox, "");
    assert!(records.iter().all(|record| record["output"] == "first.png"), "{records:?}");
}

#[test]
fn workers_exit_with_their_coordinator() {
    let sandbox = slow_sandbox("batch_orphans");
    let mut run = sandbox.start(&SLOW);
    let worker = slow_worker(&sandbox, &run, None);
    run.kill().expect("the process can be killed");
    run.wait().expect("the process exits");
    wait_for("the worker ends", || {
        let status = std::fs::read_to_string(format!("/proc/{worker}/stat"));
        // A process that has exited remains until its new parent reaps it.
        status.map_or(true, |status| status.contains(") Z ")).then_some(())
    });
    assert!(record_of(&sandbox, "slow.png").is_none());
}

#[test]
fn a_pipe_instead_of_a_scene_fails_its_job() {
    let sandbox = batch_sandbox("batch_pipes");
    let made = Command::new("mkfifo").arg(sandbox.path_of("pipe.ron")).status();
    assert!(made.expect("mkfifo runs").success());
    let arguments = ["batch", "pipe.ron", "models/a.glb", "--size", "8x8", "--out-dir", "out"];
    let run = sandbox.run(&arguments);
    assert_eq!((run.code, run.stdout.as_str()), (1, "1 rendered, 0 up to date, 1 failed\n"));
    assert!(run.stderr.contains("it is not a regular file"), "{}", run.stderr);
}

#[test]
fn an_unusable_output_folder_stops_the_run_without_failing_jobs() {
    let sandbox = batch_sandbox("batch_place");
    std::fs::create_dir(sandbox.path_of("out")).expect("a folder");
    // Nothing can be written there, not even by root.
    std::os::unix::fs::symlink("/proc", sandbox.path_of("out/more")).expect("a link");
    let arguments = ["batch", "models/more/a.glb", "--out-dir", "out", "--size", "8x8"];
    let named = [&arguments[..], &["--name", "more/{stem}.png"]].concat();
    let run = sandbox.run(&named);
    assert_eq!(run.code, 3, "{}", run.stderr);
    assert!(run.stderr.contains("out/more/a.png"), "{}", run.stderr);
    assert!(read_records(&sandbox, "").is_empty());
    std::fs::remove_file(sandbox.path_of("out/more")).expect("the link");
    let run = sandbox.run(&named);
    assert_eq!((run.code, run.stdout.as_str()), (0, "1 rendered, 0 up to date, 0 failed\n"));
    let place = sandbox.path_of("other");
    std::fs::create_dir(&place).expect("a folder");
    std::fs::write(place.join("reports"), "a file").expect("a file");
    let run = sandbox.run(&["batch", "models/b.glb", "--out-dir", "other", "--size", "8x8"]);
    assert_eq!(run.code, 3, "{}", run.stderr);
}
