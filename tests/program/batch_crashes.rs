//! `alberti batch` when it is killed, when its disk is full, and when it is started twice: nothing
//! is lost, and no bad result counts as finished.
//!
//! `ALBERTI_BATCH_KILLS` is the number of times a batch is killed; the default is 12.

use crate::sandbox::{RunResult, Sandbox};
use alberti_tests::skip::report_skip;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant, SystemTime};

/// Returns a sandbox with eighteen small models, which `BATCH` renders.
fn crash_sandbox(name: &str) -> Sandbox {
    let sandbox = Sandbox::new(name);
    for model in ["crate.glb", "panes.glb", "house.glb"] {
        sandbox.copy_model(model);
        for folder in 0..6 {
            let to = sandbox.path_of(&format!("models/{folder}"));
            std::fs::create_dir_all(&to).expect("a folder");
            std::fs::copy(sandbox.path_of(model), to.join(model)).expect("a model");
        }
    }
    sandbox
}

const COUNT: usize = 18;
const BATCH: [&str; 8] =
    ["batch", "models", "--out-dir", "out", "--size", "96x64", "--threads", "2"];

/// Returns the batch command with additional flags.
fn batch_with<'a>(flags: &[&'a str]) -> Vec<&'a str> {
    [&BATCH[..], flags].concat()
}

/// Returns the pictures from an undisturbed run, by name.
fn undisturbed_pictures(sandbox: &Sandbox) -> BTreeMap<String, Vec<u8>> {
    let mut arguments = BATCH;
    arguments[3] = "whole";
    let run = sandbox.run(&arguments);
    assert_eq!((run.code, run.stdout.as_str()), (0, "18 rendered, 0 up to date, 0 failed\n"));
    let pictures = pictures_below(&sandbox.path_of("whole"));
    assert_eq!(pictures.len(), COUNT);
    pictures
}

/// Returns all `.png` files, by their path below a folder.
fn pictures_below(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let files = files_below(folder).into_iter().filter(|name| name.ends_with(".png"));
    // If another process is replacing a file, either the old or the new version is read.
    let read = |name: String| std::fs::read(folder.join(&name)).map(|bytes| (name, bytes)).ok();
    files.filter_map(read).collect()
}

/// Returns the paths of all files below a folder, relative to it; none if the folder does not
/// exist.
fn files_below(folder: &Path) -> Vec<String> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut files = Vec::new();
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        if path.is_dir() {
            files.extend(files_below(&path).iter().map(|below| format!("{name}/{below}")));
        } else {
            files.push(name);
        }
    }
    files
}

/// Returns the complete records in the reports of all runs.
fn recorded(out: &Path) -> Vec<Value> {
    let names = files_below(&out.join("reports")).into_iter();
    let texts = names
        .filter(|name| name.ends_with(".jsonl"))
        .filter_map(|name| std::fs::read_to_string(out.join("reports").join(name)).ok());
    let records = |text: String| -> Vec<Value> {
        text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
    };
    texts.flat_map(records).collect()
}

/// Checks that the existing pictures are complete.
fn check_pictures(sandbox: &Sandbox, whole: &BTreeMap<String, Vec<u8>>, when: &str) {
    for (name, bytes) in pictures_below(&sandbox.path_of("out")) {
        assert!(whole.get(&name) == Some(&bytes), "{when}: {name} is incomplete");
    }
}

/// Checks the state after a disturbed run: pictures are complete, and no record claims a picture
/// that is missing.
fn check_remains(sandbox: &Sandbox, whole: &BTreeMap<String, Vec<u8>>, when: &str) {
    let out = sandbox.path_of("out");
    check_pictures(sandbox, whole, when);
    let pictures = pictures_below(&out);
    for record in recorded(&out) {
        assert_eq!(record["status"], "done", "{when}: {record}");
        let name = record["output"].as_str().expect("a name");
        match record["tar"].as_str() {
            Some(tar) => assert!(out.join(tar).is_file(), "{when}: {record}"),
            None => assert!(pictures.contains_key(name), "{when}: {record}"),
        }
    }
    for tar in files_below(&out).iter().filter(|name| name.ends_with(".tar")) {
        let bytes = std::fs::read(out.join(tar)).expect("a tar file");
        let is_whole = bytes.len().is_multiple_of(512) && bytes.ends_with(&[0; 1024]);
        assert!(is_whole, "{when}: {tar} is incomplete");
    }
}

/// Checks that a batch is complete: `--verify` confirms it, and another run renders nothing.
fn check_complete(sandbox: &Sandbox, flags: &[&str]) {
    let run = sandbox.run(&batch_with(&[flags, &["--verify"]].concat()));
    let expected = "18 intact, 0 missing, 0 wrong, 0 failed\n";
    assert_eq!((run.code, run.stdout.as_str()), (0, expected), "{}", run.stderr);
    let run = sandbox.run(&batch_with(flags));
    let expected = "0 rendered, 18 up to date, 0 failed\n";
    assert_eq!((run.code, run.stdout.as_str()), (0, expected), "{}", run.stderr);
}

/// Starts a batch without reading its output.
fn start_batch(sandbox: &Sandbox, arguments: &[&str]) -> std::process::Child {
    let program = alberti_tests::program_path().expect("the program");
    let mut command = Command::new(program);
    command.args(arguments).current_dir(sandbox.path_of(""));
    let command = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().expect("the program starts")
}

/// Kills two shards at seeded random moments until there have been enough kills; shards that finish
/// are checked and started again.
fn kill_often(name: &str, kills: usize, flags: &[&str]) {
    let sandbox = crash_sandbox(name);
    let begin = Instant::now();
    let whole = undisturbed_pictures(&sandbox);
    let undisturbed = begin.elapsed();
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut killed = 0;
    while killed < kills {
        let shards = ["1/2", "2/2"].map(|shard| {
            let arguments = batch_with(&[flags, &["--shard", shard]].concat());
            start_batch(&sandbox, &arguments)
        });
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let part = (state >> 40) as f64 / (1_u64 << 24) as f64;
        let end = Instant::now() + undisturbed.mul_f64(part);
        while Instant::now() < end {
            check_pictures(&sandbox, &whole, "while it runs");
            std::thread::sleep(Duration::from_millis(1));
        }
        // Kills one of the shards, or both.
        let spared = (state >> 38) % 4;
        let mut ended = 0;
        for (at, mut shard) in (0_u64..).zip(shards) {
            if spared != at {
                shard.kill().expect("the process can be killed");
            }
            let status = shard.wait().expect("the process exits");
            ended += usize::from(status.code() == Some(0));
            killed += usize::from(status.code().is_none());
            assert!(matches!(status.code(), None | Some(0)), "{status}");
        }
        check_remains(&sandbox, &whole, &format!("after {killed} kills"));
        if ended == 2 {
            check_complete(&sandbox, flags);
            std::fs::remove_dir_all(sandbox.path_of("out")).expect("the output folder");
        }
    }
    for shard in ["1/2", "2/2"] {
        let run = sandbox.run(&batch_with(&[flags, &["--shard", shard]].concat()));
        assert_eq!(run.code, 0, "{}", run.stderr);
    }
    check_remains(&sandbox, &whole, "at the end");
    check_complete(&sandbox, flags);
    if flags.is_empty() {
        assert_eq!(pictures_below(&sandbox.path_of("out")), whole);
    }
}

/// Returns the number of times a batch is killed.
fn kill_count() -> usize {
    let text = std::env::var("ALBERTI_BATCH_KILLS").ok();
    text.map_or(12, |text| text.parse().expect("ALBERTI_BATCH_KILLS is a number"))
}

#[test]
fn a_batch_killed_at_any_moment_loses_nothing() {
    kill_often("batch_kills", kill_count(), &[]);
}

#[test]
fn tar_files_are_complete_or_absent_after_a_kill() {
    kill_often("batch_kills_tar", kill_count() / 2, &["--tar", "3"]);
}

#[test]
fn workers_exit_when_their_batch_is_killed() {
    let sandbox = crash_sandbox("batch_orphans");
    let mut batch = start_batch(&sandbox, &BATCH);
    let begin = Instant::now();
    while recorded(&sandbox.path_of("out")).is_empty() {
        assert!(begin.elapsed() < Duration::from_secs(120), "the batch is making no progress");
        std::thread::sleep(Duration::from_millis(5));
    }
    batch.kill().expect("the process can be killed");
    batch.wait().expect("the process exits");
    let files = || {
        let mut files = files_below(&sandbox.path_of("out"));
        files.sort();
        files
    };
    // Workers may still finish the pictures they have begun, but they begin no new ones.
    std::thread::sleep(Duration::from_millis(300));
    let left = files();
    std::thread::sleep(Duration::from_secs(1));
    assert_eq!(files(), left, "a worker is still running");
}

#[test]
fn truncated_records_are_written_again() {
    let sandbox = crash_sandbox("batch_torn");
    let whole = undisturbed_pictures(&sandbox);
    assert_eq!(sandbox.run(&BATCH).code, 0);
    // The merged report of a run without shards repeats all records.
    let merged = sandbox.path_of("out/report.jsonl");
    std::fs::remove_file(&merged).expect("a merged report");
    let name = files_below(&sandbox.path_of("out/reports")).pop().expect("a report");
    let path = sandbox.path_of("out/reports").join(name);
    let text = std::fs::read(&path).expect("a report");
    let mut cuts = 0;
    for lost in [1, 2, 40, 400, text.len() - 30] {
        std::fs::write(&path, &text[..text.len() - lost]).expect("a truncated report");
        let left = recorded(&sandbox.path_of("out")).len();
        let run = sandbox.run(&batch_with(&["--verify"]));
        let open = COUNT - left;
        assert_eq!(run.code, i32::from(open > 0), "{lost}: {}", run.stdout);
        let expected = format!("{left} intact, {open} missing, 0 wrong, 0 failed\n");
        assert!(run.stdout.ends_with(&expected), "{lost}: {}", run.stdout);
        let run = sandbox.run(&BATCH);
        assert_eq!(run.stdout, format!("{open} rendered, {left} up to date, 0 failed\n"));
        assert_eq!(pictures_below(&sandbox.path_of("out")), whole);
        check_complete(&sandbox, &[]);
        cuts += usize::from(open > 0);
        for other in files_below(&sandbox.path_of("out/reports")) {
            std::fs::remove_file(sandbox.path_of("out/reports").join(other)).expect("a report");
        }
        std::fs::remove_file(&merged).expect("a merged report");
    }
    // A line that lacks only its line break is complete.
    assert_eq!(cuts, 4);
}

#[test]
fn running_a_shard_twice_at_once_is_harmless() {
    for flags in [&[][..], &["--tar", "4"]] {
        let sandbox = crash_sandbox(&format!("batch_twice_{}", flags.len()));
        let whole = undisturbed_pictures(&sandbox);
        let shards = ["1/2", "1/2", "2/2", "2/2"].map(|shard| {
            start_batch(&sandbox, &batch_with(&[flags, &["--shard", shard]].concat()))
        });
        for mut shard in shards {
            assert_eq!(shard.wait().expect("the process exits").code(), Some(0));
        }
        check_remains(&sandbox, &whole, "after four runs");
        let tars = files_below(&sandbox.path_of("out"));
        let tars: Vec<&String> = tars.iter().filter(|name| name.ends_with(".tar")).collect();
        for tar in &tars {
            let records = recorded(&sandbox.path_of("out"));
            assert!(records.iter().any(|record| record["tar"] == tar.as_str()), "{tar}");
        }
        check_complete(&sandbox, flags);
        if flags.is_empty() {
            assert_eq!(pictures_below(&sandbox.path_of("out")), whole);
        }
    }
}

/// Sets the modification time of all files below a folder.
fn set_times(folder: &Path, time: SystemTime) {
    for name in files_below(folder) {
        let file = std::fs::File::options().append(true).open(folder.join(name)).expect("a file");
        file.set_modified(time).expect("the time can be set");
    }
}

#[test]
fn finished_pictures_are_recognized_regardless_of_clocks() {
    let sandbox = crash_sandbox("batch_clocks");
    assert_eq!(sandbox.run(&BATCH).code, 0);
    let ages = Duration::from_secs(20 * 365 * 86_400);
    let (past, future) = (SystemTime::now() - ages, SystemTime::now() + ages);
    for (inputs, outputs) in [(future, past), (past, future)] {
        set_times(&sandbox.path_of("models"), inputs);
        set_times(&sandbox.path_of("out"), outputs);
        check_complete(&sandbox, &[]);
        // A changed model is rendered again, although its picture and its record are newer.
        let (model, other) = (sandbox.path_of("models/3/house.glb"), sandbox.path_of("panes.glb"));
        let former = std::fs::read(&model).expect("a model");
        std::fs::copy(other, &model).expect("another model");
        set_times(&sandbox.path_of("models"), past);
        set_times(&sandbox.path_of("out"), future);
        let run = sandbox.run(&BATCH);
        assert_eq!(run.stdout, "1 rendered, 17 up to date, 0 failed\n");
        check_complete(&sandbox, &[]);
        // It is rendered once more when it is changed back, because the old record is superseded.
        std::fs::write(&model, former).expect("the former model");
        set_times(&sandbox.path_of("models"), past);
        set_times(&sandbox.path_of("out"), future);
        let run = sandbox.run(&BATCH);
        assert_eq!(run.stdout, "1 rendered, 17 up to date, 0 failed\n");
        check_complete(&sandbox, &[]);
    }
}

/// Runs a script in the sandbox, with the program as `$alberti`.
fn run_script(sandbox: &Sandbox, shell: &[&str], script: &str) -> Output {
    let program: PathBuf = alberti_tests::program_path().expect("the program");
    let mut command = Command::new(shell[0]);
    command.args(&shell[1..]).arg(script).current_dir(sandbox.path_of(""));
    command.env("alberti", program).env("batch", BATCH.join(" "));
    command.output().expect("a shell")
}

/// Checks a run that could not write: the exit code is 3, a message gives the reason, and no job
/// has failed.
fn check_stopped(sandbox: &Sandbox, run: &RunResult) {
    assert_eq!(run.code, 3, "{}{}", run.stdout, run.stderr);
    assert!(run.stderr.contains("cannot write") || run.stderr.contains("cannot create"));
    assert!(!run.stderr.contains("failed:"), "{}", run.stderr);
    for record in recorded(&sandbox.path_of("out")) {
        assert_eq!(record["status"], "done", "{record}");
    }
}

#[test]
fn file_size_limits_stop_the_run_without_failing_jobs() {
    let sandbox = crash_sandbox("batch_file_size");
    let whole = undisturbed_pictures(&sandbox);
    // Limits in blocks of 512 bytes: zero, then enough for at least one record.
    for blocks in ["0", "1", "2"] {
        // Ignores the signal that a write beyond the limit would cause.
        let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$alberti\" $batch");
        let output = run_script(&sandbox, &["sh", "-c"], &script);
        let run = RunResult::of(output);
        check_stopped(&sandbox, &run);
        check_remains(&sandbox, &whole, &format!("with {blocks} blocks"));
    }
    assert_eq!(sandbox.run(&BATCH).code, 0);
    assert_eq!(pictures_below(&sandbox.path_of("out")), whole);
    check_complete(&sandbox, &[]);
}

/// Runs a batch on a separate disk, which has 64 KiB at first and is enlarged later, with and
/// without tar files.
///
/// The disk exists only for the script, in a mount namespace.
const SMALL_DISK: &str = "
mkdir -p out && mount -t tmpfs -o size=64k tmpfs out || exit 99
for flags in '' '--tar 4'; do
    \"$alberti\" $batch $flags; echo \"full $?\"
    mount -o remount,size=32m out
    mount -o remount,ro out
    \"$alberti\" $batch $flags; echo \"read-only $?\"
    mount -o remount,rw out
    \"$alberti\" $batch $flags; echo \"room $?\"
    \"$alberti\" $batch $flags --verify; echo \"verify $?\"
    grep -l '\"failed\"' out/reports/*; find out -name '*.part'
    rm -r out/*
    mount -o remount,size=64k out
done";

#[cfg(target_os = "linux")]
#[test]
fn a_full_or_read_only_disk_stops_the_run_and_the_next_run_resumes() {
    let sandbox = crash_sandbox("batch_disk");
    let unshare = ["unshare", "--mount", "--map-root-user", "sh", "-c"];
    let is_there = Command::new("unshare").arg("--version").output().is_ok();
    let output = is_there.then(|| run_script(&sandbox, &unshare, SMALL_DISK));
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let Some(output) = output.filter(|output| text(&output.stdout).contains("full")) else {
        let name = "a_full_or_read_only_disk_stops_the_run_and_the_next_run_resumes";
        let why = "no file system can be mounted here (unshare --mount --map-root-user)";
        return report_skip(name, why);
    };
    let (stdout, stderr) = (text(&output.stdout), text(&output.stderr));
    let codes: Vec<&str> = stdout.lines().filter(|line| !line.contains(", ")).collect();
    let expected = ["full 3", "read-only 3", "room 0", "verify 0"].repeat(2);
    assert_eq!(codes, expected, "{stdout}{stderr}");
    assert_eq!(stdout.matches("18 intact, 0 missing, 0 wrong, 0 failed").count(), 2, "{stdout}");
    assert!(stderr.contains("No space left") && stderr.contains("Read-only"), "{stderr}");
    assert!(!stderr.contains("failed:"), "{stderr}");
}
