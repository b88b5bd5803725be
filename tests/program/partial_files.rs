//! Temporary files: none remain after a signal, and the next run removes the files that a killed
//! process left behind.

use crate::explore::ignores_signal;
use crate::sandbox::Sandbox;
use alberti_tests::skip::report_skip;
use std::os::unix::process::ExitStatusExt as _;
use std::process::{Child, Command};
use std::time::{Duration, Instant};

/// Starts rendering a slow picture, and waits for its temporary file.
fn start_picture(sandbox: &Sandbox) -> Child {
    let mut child = sandbox.start(&["render", "house.glb", "--size", "16000x16000", "-o", "a.png"]);
    let begin = Instant::now();
    while parts_of(sandbox).is_empty() {
        assert!(begin.elapsed() < Duration::from_secs(60), "there is no temporary file");
        assert!(child.try_wait().expect("the process has a state").is_none(), "the run has ended");
        std::thread::sleep(Duration::from_millis(10));
    }
    child
}

fn parts_of(sandbox: &Sandbox) -> Vec<String> {
    sandbox.file_names().into_iter().filter(|name| name.ends_with(".part")).collect()
}

fn send_signal(child: &Child, signal: &str) {
    let kill = Command::new("kill").args([signal, &child.id().to_string()]).status().expect("kill");
    assert!(kill.success());
}

/// Returns the id of a process that has ended.
fn dead_process() -> u32 {
    let mut child = Command::new("true").spawn().expect("a process");
    child.wait().expect("the process exits");
    child.id()
}

#[test]
fn a_signal_leaves_no_temporary_file() {
    let sandbox = Sandbox::new("partial_signals");
    sandbox.copy_model("house.glb");
    sandbox.write_file("a.png", "old");
    for (signal, number) in [("-TERM", 15), ("-HUP", 1), ("-INT", 2)] {
        if ignores_signal(number) {
            report_skip(signal, "this test was started with the signal ignored");
            continue;
        }
        let mut child = start_picture(&sandbox);
        send_signal(&child, signal);
        let status = child.wait().expect("the process exits");
        assert_eq!(status.signal(), Some(number), "{signal}: {status}");
        assert_eq!(sandbox.file_names(), ["a.png", "house.glb"], "{signal}");
    }
    let old = std::fs::read_to_string(sandbox.path_of("a.png")).expect("the old file");
    assert_eq!(old, "old");
}

#[cfg(target_os = "linux")]
#[test]
fn the_next_run_removes_the_files_of_a_killed_run() {
    let sandbox = Sandbox::new("partial_killed");
    sandbox.copy_model("house.glb");
    let mut child = start_picture(&sandbox);
    send_signal(&child, "-KILL");
    child.wait().expect("the process exits");
    assert_eq!(parts_of(&sandbox), [format!("a.png.{}.part", child.id())]);
    // A file that another run is writing, and a file for another output.
    let alive = format!("a.png.{}.part", std::process::id());
    let other = format!("b.png.{}.part", dead_process());
    sandbox.write_file(&alive, "");
    sandbox.write_file(&other, "");
    let run = sandbox.run(&["render", "house.glb", "--size", "16x16", "-o", "a.png"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(parts_of(&sandbox), [alive, other]);
}

#[cfg(target_os = "linux")]
#[test]
fn the_next_batch_removes_the_files_of_a_killed_batch() {
    let sandbox = Sandbox::new("partial_batch");
    sandbox.copy_model("crate.glb");
    let batch = ["batch", "crate.glb", "--out-dir", "out", "--size", "16x16"];
    assert_eq!(sandbox.run(&batch).code, 0);
    let host = std::fs::read_to_string("/proc/sys/kernel/hostname").expect("a name");
    let host: String =
        host.trim().chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    let (dead, alive) = (dead_process(), std::process::id());
    let name = |host: &str, process, end| format!("out/reports/1-of-1.{host}.{process}.1.{end}");
    let gone = [name(&host, dead, "0.part"), name(&host, dead, "tar.part")];
    let kept = [name(&host, alive, "0.part"), name("elsewhere", dead, "0.part")];
    gone.iter().chain(&kept).for_each(|name| sandbox.write_file(name, ""));
    assert_eq!(sandbox.run(&batch).code, 0);
    let is_there = |name: &String| sandbox.path_of(name).exists();
    assert!(!gone.iter().any(is_there) && kept.iter().all(is_there));
}
