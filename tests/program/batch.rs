//! Tests `alberti batch`.

use crate::sandbox::Sandbox;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Returns the records of all runs whose report names begin with `run`, in the order in which they
/// were written.
pub(crate) fn read_records(sandbox: &Sandbox, run: &str) -> Vec<Value> {
    let Ok(entries) = std::fs::read_dir(sandbox.path_of("out/reports")) else { return Vec::new() };
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let is_of_run = |path: &PathBuf| {
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        name.starts_with(run) && name.ends_with(".jsonl")
    };
    let mut paths: Vec<PathBuf> = paths.filter(is_of_run).collect();
    paths.sort();
    let texts = paths.iter().map(|path| std::fs::read_to_string(path).expect("a report"));
    let lines = |text: String| -> Vec<Value> {
        text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
    };
    texts.flat_map(lines).collect()
}

/// Returns the picture names in records, sorted.
fn outputs(records: &[Value]) -> Vec<&str> {
    let mut names: Vec<&str> =
        records.iter().map(|record| record["output"].as_str().expect("a name")).collect();
    names.sort_unstable();
    names
}

/// Returns a sandbox with a folder of models: three valid ones, one of them in a subfolder, and a
/// broken one.
pub(crate) fn batch_sandbox(name: &str) -> Sandbox {
    let sandbox = Sandbox::new(name);
    std::fs::create_dir_all(sandbox.path_of("models/more")).expect("folders");
    for (model, location) in
        [("crate.glb", "a.glb"), ("lamp.glb", "more/a.glb"), ("house.glb", "b.glb")]
    {
        sandbox.copy_model(model);
        std::fs::rename(sandbox.path_of(model), sandbox.path_of(&format!("models/{location}")))
            .expect("a model");
    }
    sandbox.write_file("models/broken.glb", "glTF but not really");
    sandbox
}

const SMALL: [&str; 6] = ["batch", "models", "--out-dir", "out", "--size", "32x24"];

/// Returns the status of each picture in a report.
fn read_report(sandbox: &Sandbox, name: &str) -> BTreeMap<String, String> {
    let text = std::fs::read_to_string(sandbox.path_of(name)).expect("a report");
    let record = |line: &str| {
        let record: Value = serde_json::from_str(line).expect("JSON");
        let word = |name: &str| record[name].as_str().expect("words").to_owned();
        (word("output"), word("status"))
    };
    text.lines().map(record).collect()
}

fn statuses(sandbox: &Sandbox) -> Vec<(String, String)> {
    read_report(sandbox, "out/report.jsonl").into_iter().collect()
}

fn status_list(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
    pairs.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect()
}

#[test]
fn broken_models_are_recorded_and_finished_pictures_are_not_rendered_again() {
    let sandbox = batch_sandbox("batch");
    let run = sandbox.run(&SMALL);
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert_eq!(run.stdout, "3 rendered, 0 up to date, 1 failed\n");
    assert!(run.stderr.contains("broken.glb"), "{}", run.stderr);
    let first = status_list(&[
        ("a.png", "done"),
        ("b.png", "done"),
        ("broken.png", "failed"),
        ("more/a.png", "done"),
    ]);
    assert_eq!(statuses(&sandbox), first);
    assert_eq!(sandbox.read_picture("out/more/a.png").0, 32);
    let sheet =
        std::fs::read_to_string(sandbox.path_of("out/index.html")).expect("a contact sheet");
    for word in ["./more/a.png", "3 pictures, 1 failed", "broken.glb"] {
        assert!(sheet.contains(word), "{word}: {sheet}");
    }
    sandbox.copy_model("teapot.glb");
    std::fs::rename(sandbox.path_of("teapot.glb"), sandbox.path_of("models/b.glb"))
        .expect("another model");
    std::fs::remove_file(sandbox.path_of("out/more/a.png")).expect("a picture");
    let run = sandbox.run(&SMALL);
    assert_eq!(
        run.stdout, "2 rendered, 1 up to date, 1 failed\n",
        "one model has changed and one picture is missing"
    );
    assert!(!run.stderr.contains("broken.glb"), "{}", run.stderr);
    assert!(run.stderr.contains("1 in an earlier run; use --retry-failed"), "{}", run.stderr);
    let run = sandbox.run(&[&SMALL[..], &["--retry-failed"]].concat());
    assert_eq!((run.code, run.stdout.as_str()), (1, "0 rendered, 3 up to date, 1 failed\n"));
    assert!(run.stderr.contains("broken.glb"), "it was retried: {}", run.stderr);
    let run = sandbox.run(&[&SMALL[..], &["--background", "#123"]].concat());
    assert_eq!(run.stdout, "3 rendered, 0 up to date, 1 failed\n", "settings changed");
    let run = sandbox.run(&[&SMALL[..], &["--background", "#123", "--force"]].concat());
    assert_eq!(run.stdout, "3 rendered, 0 up to date, 1 failed\n", "`--force` renders everything");
}

#[test]
fn shards_add_up_to_the_whole_batch() {
    let sandbox = batch_sandbox("batch_shards");
    std::fs::remove_file(sandbox.path_of("models/broken.glb")).expect("the broken model");
    for shard in ["1/2", "2/2"] {
        let run = sandbox.run(&[&SMALL[..], &["--shard", shard]].concat());
        assert_eq!(run.code, 0, "{}", run.stderr);
    }
    let [first, second] = ["1-of-2.", "2-of-2."].map(|run| read_records(&sandbox, run));
    assert!(!first.is_empty() && !second.is_empty(), "{first:?} {second:?}");
    let united = [first, second].concat();
    assert_eq!(outputs(&united), ["a.png", "b.png", "more/a.png"], "no picture is rendered twice");
    let run = sandbox.run(&SMALL);
    assert_eq!((run.code, run.stdout.as_str()), (0, "0 rendered, 3 up to date, 0 failed\n"));
    let run = sandbox.run(&[&SMALL[..], &["--shard", "auto"]].concat());
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("SLURM_ARRAY_TASK_ID"), "{}", run.stderr);
}

#[test]
fn a_killed_run_resumes_where_it_stopped() {
    let sandbox = Sandbox::new("batch_killed");
    std::fs::create_dir(sandbox.path_of("models")).expect("a folder");
    sandbox.copy_model("teapot.glb");
    for number in 0..16 {
        let copy = sandbox.path_of(&format!("models/{number:02}.glb"));
        std::fs::copy(sandbox.path_of("teapot.glb"), copy).expect("a model");
    }
    let arguments = ["batch", "models", "--out-dir", "out", "--size", "320x240", "--threads", "1"];
    let program = alberti_tests::program_path().expect("the program");
    let mut process = Command::new(program)
        .args(arguments)
        .current_dir(sandbox.path_of(""))
        .stdout(Stdio::null())
        .spawn()
        .expect("the program starts");
    let begin = Instant::now();
    let done = || read_records(&sandbox, "").len();
    while done() < 3 {
        assert!(begin.elapsed() < Duration::from_secs(60), "the run is making no progress");
        std::thread::sleep(Duration::from_millis(5));
    }
    process.kill().expect("the process can be killed");
    process.wait().expect("the process exits");
    let before = done();
    let run = sandbox.run(&arguments);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(read_report(&sandbox, "out/report.jsonl").len(), 16);
    let kept: usize = run
        .stdout
        .split(", ")
        .nth(1)
        .and_then(|words| words.split(' ').next())
        .and_then(|count| count.parse().ok())
        .expect("a count");
    assert_eq!(kept, before, "{}", run.stdout);
    assert!(kept < 16, "the run was killed before it finished");
    let entries = std::fs::read_dir(sandbox.path_of("out")).expect("the folder");
    for entry in entries {
        let name = entry.expect("an entry").file_name().into_string().expect("a name");
        assert!(!name.ends_with(".part"), "{name} is not a picture");
    }
}

#[test]
fn lists_and_scenes_can_be_inputs() {
    let sandbox = batch_sandbox("batch_lists");
    sandbox.write_file("list.txt", "# models\nmodels/a.glb\n\nmodels/more/a.glb\n");
    sandbox.write_file(
        "scene.ron",
        "Scene(models: [(path: \"models/b.glb\")], image: (size: (8, 8)))",
    );
    let run = sandbox.run(&["batch", "list.txt", "scene.ron", "--out-dir", "out"]);
    assert_eq!((run.code, run.stdout.as_str()), (0, "3 rendered, 0 up to date, 0 failed\n"));
    assert_eq!(sandbox.read_picture("out/scene.png").0, 8);
    assert_eq!(sandbox.read_picture("out/models/more/a.png").0, 960);
    let run = sandbox.run(&["batch", "nowhere", "--out-dir", "out2"]);
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("nowhere"), "{}", run.stderr);
}
