//! `alberti batch` on misleading lists and folders:
//!
//! - two lines with the same output
//! - pipes instead of reports
//! - symbolic links that form cycles or lead out of the output folder
//! - names that are not UTF-8

use crate::sandbox::{RunResult, Sandbox};
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt as _;
use std::os::unix::fs::symlink;
use std::process::Command;
use std::time::{Duration, Instant};

const SIZE: [&str; 2] = ["--size", "16x16"];

/// Runs a command that must not wait for anything; it is killed after a minute.
fn run_in_time(sandbox: &Sandbox, arguments: &[&str]) -> RunResult {
    let mut child = sandbox.start(arguments);
    drop(child.stdin.take());
    let begin = Instant::now();
    while child.try_wait().expect("the process has a state").is_none() {
        if begin.elapsed() > Duration::from_secs(60) {
            let _ = child.kill();
            panic!("the program hangs: {arguments:?}");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    RunResult::of(child.wait_with_output().expect("the process exits"))
}

fn crate_sandbox(name: &str) -> Sandbox {
    let sandbox = Sandbox::new(name);
    sandbox.copy_model("crate.glb");
    sandbox
}

#[test]
fn lines_with_the_same_output_are_refused() {
    let sandbox = crate_sandbox("batch_same_output");
    let (x, y) = (r#"{"input":"crate.glb","output":"x.png"}"#, r#"{"input":"crate.glb"}"#);
    let many = r#"{"input":"crate.glb","pictures":[{"output":"y.png"},{"output":"x.png"}]}"#;
    for (name, lines, numbers) in [
        ("a.jsonl", [x, x, y], "lines 1 and 2 "),
        ("b.jsonl", [x, "", r#"{"input":"crate.glb","output":"./x.png"}"#], ""),
        ("c.jsonl", [y, x, many], "lines 2 and 3 "),
        ("d.csv", ["input,output", "crate.glb,x.png", "crate.glb,x.png"], "lines 2 and 3 "),
    ] {
        sandbox.write_file(name, lines.join("\n"));
        let out_dir = &format!("out-{name}");
        let arguments = [&["batch", "--list", name, "--out-dir", out_dir][..], &SIZE].concat();
        let run = sandbox.run(&arguments);
        if numbers.is_empty() {
            // A path component `.` is rejected even without a duplicate.
            assert_eq!(run.code, 1, "{}", run.stderr);
            continue;
        }
        assert_eq!(run.code, 2, "{name}: {}", run.stderr);
        let expected = format!("error: {name}: {numbers}have the same output x.png\n  = help: ");
        assert!(run.stderr.starts_with(&expected), "{}", run.stderr);
        assert!(!sandbox.path_of(out_dir).exists(), "{name}");
    }
    // A pipe cannot be read in advance.
    let arguments = [&["batch", "--list", "-", "--out-dir", "out"][..], &SIZE].concat();
    let (code, stdout) = sandbox.run_with_input(&arguments, format!("{x}\n{x}\n").as_bytes());
    let stdout = String::from_utf8(stdout).expect("UTF-8");
    assert_eq!((code, stdout.as_str()), (1, "1 rendered, 0 up to date, 1 failed\n"));
    let report = sandbox.run(&["batch", "--merge", "--out-dir", "out"]);
    assert!(report.stdout.starts_with("1 picture"), "{}", report.stdout);
}

#[test]
fn duplicates_in_a_long_list_are_found_with_little_memory() {
    let sandbox = crate_sandbox("batch_long_list");
    let line = |at: u32| format!("{{\"input\":\"none.glb\",\"output\":\"{at}.png\"}}\n");
    let mut list: String = (0..20_000).map(line).collect();
    list += &line(1234);
    sandbox.write_file("a.jsonl", list);
    let run = sandbox.run(&["batch", "--list", "a.jsonl", "--out-dir", "out"]);
    assert!(run.stderr.contains("lines 1235 and 20001 have"), "{}", run.stderr);
}

#[test]
fn pipes_and_folders_are_not_read_as_reports() {
    let sandbox = crate_sandbox("batch_pipes");
    let batch = [&["batch", "crate.glb", "--out-dir", "out"][..], &SIZE].concat();
    assert_eq!(sandbox.run(&batch).code, 0);
    let reports = sandbox.path_of("out/reports");
    std::fs::create_dir(reports.join("1-of-1.a.1.1.jsonl")).expect("a folder");
    for pipe in ["out/reports/1-of-1.b.1.2.jsonl", "out/reports/x.part"] {
        let made = Command::new("mkfifo").arg(sandbox.path_of(pipe)).status().expect("mkfifo");
        assert!(made.success());
    }
    let run = run_in_time(&sandbox, &batch);
    assert_eq!(run.stdout, "0 rendered, 1 up to date, 0 failed\n", "{}", run.stderr);
    let run = run_in_time(&sandbox, &[&batch[..], &["--verify"]].concat());
    assert_eq!(run.stdout, "1 intact, 0 missing, 0 wrong, 0 failed\n", "{}", run.stderr);
    assert_eq!(run_in_time(&sandbox, &["batch", "--merge", "--out-dir", "out"]).code, 0);
    std::fs::remove_file(sandbox.path_of("out/crate.png")).expect("the picture");
    let pipe = Command::new("mkfifo").arg(sandbox.path_of("out/crate.png")).status();
    assert!(pipe.expect("mkfifo").success());
    let run = run_in_time(&sandbox, &[&batch[..], &["--verify"]].concat());
    assert_eq!(run.stdout.lines().last(), Some("0 intact, 1 missing, 0 wrong, 0 failed"));
}

#[test]
fn folders_that_link_to_themselves_are_visited_once() {
    let sandbox = crate_sandbox("batch_circles");
    for folder in ["models/a", "models/b", "elsewhere"] {
        std::fs::create_dir_all(sandbox.path_of(folder)).expect("a folder");
        let to = sandbox.path_of(folder).join("crate.glb");
        std::fs::copy(sandbox.path_of("crate.glb"), to).expect("a model");
    }
    for (link, to) in [
        ("models/a/circle", "."),
        ("models/a/up", "../../models"),
        ("models/a/b", "../b"),
        ("models/b/a", "../a"),
        ("models/b/outside", "../../elsewhere"),
    ] {
        symlink(to, sandbox.path_of(link)).expect("a link");
    }
    let run = sandbox.run(&[&["batch", "models", "--out-dir", "out"][..], &SIZE].concat());
    assert_eq!(run.stdout, "3 rendered, 0 up to date, 0 failed\n", "{}", run.stderr);
    for name in ["a/crate.png", "b/crate.png", "b/outside/crate.png"] {
        assert!(sandbox.path_of("out").join(name).exists(), "{name}");
    }
}

#[test]
fn a_link_out_of_the_output_folder_is_not_followed() {
    let sandbox = crate_sandbox("batch_link_outside");
    for folder in ["out/inside", "elsewhere"] {
        std::fs::create_dir_all(sandbox.path_of(folder)).expect("a folder");
    }
    symlink("../elsewhere", sandbox.path_of("out/link")).expect("a link");
    symlink("inside", sandbox.path_of("out/fine")).expect("a link");
    sandbox.write_file("elsewhere/old.png", "old");
    symlink("../elsewhere/old.png", sandbox.path_of("out/file.png")).expect("a link");
    let line = |output| format!("{{\"input\":\"crate.glb\",\"output\":\"{output}\"}}\n");
    let batch = [&["batch", "--list", "a.jsonl", "--out-dir", "out"][..], &SIZE].concat();
    for output in ["link/a.png", "link/new/a.png"] {
        sandbox.write_file("a.jsonl", line(output));
        let run = sandbox.run(&batch);
        assert_eq!(run.code, 3, "{}", run.stderr);
        assert!(run.stderr.contains("leads out of the output folder"), "{}", run.stderr);
    }
    sandbox.write_file("a.jsonl", ["fine/a.png", "file.png"].map(line).concat());
    let run = sandbox.run(&batch);
    assert_eq!(run.stdout, "2 rendered, 0 up to date, 0 failed\n", "{}", run.stderr);
    let elsewhere = std::fs::read_dir(sandbox.path_of("elsewhere")).expect("the folder");
    assert_eq!(elsewhere.count(), 1);
    let old = std::fs::read_to_string(sandbox.path_of("elsewhere/old.png")).expect("the file");
    assert_eq!(old, "old");
    assert!(sandbox.path_of("out/inside/a.png").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn names_that_are_not_utf8_are_reported() {
    let sandbox = crate_sandbox("batch_no_text");
    std::fs::create_dir(sandbox.path_of("models")).expect("a folder");
    let name = sandbox.path_of("models").join(OsStr::from_bytes(b"a\xff.glb"));
    std::fs::copy(sandbox.path_of("crate.glb"), name).expect("a model");
    let run = sandbox.run(&[&["batch", "models", "--out-dir", "out"][..], &SIZE].concat());
    assert_eq!(run.code, 1, "{}", run.stdout);
    assert!(
        run.stderr.contains("the name is not UTF-8\n  = help: rename the file"),
        "{}",
        run.stderr
    );
    assert!(!run.stderr.contains("does not exist"), "{}", run.stderr);
}
