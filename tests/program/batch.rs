//! `alberti batch`.

use crate::bench::Bench;
use serde_json::Value;
use std::collections::BTreeMap;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// A folder of models: three good ones, one of them in a folder of its own, and a broken one.
fn bench(name: &str) -> Bench {
    let bench = Bench::new(name);
    std::fs::create_dir_all(bench.path("models/more")).expect("folders");
    for (model, place) in
        [("crate.glb", "a.glb"), ("lamp.glb", "more/a.glb"), ("house.glb", "b.glb")]
    {
        bench.bring(model);
        std::fs::rename(bench.path(model), bench.path(&format!("models/{place}")))
            .expect("a model");
    }
    bench.write("models/broken.glb", "glTF but not really");
    bench
}

const SMALL: [&str; 6] = ["batch", "models", "--out", "out", "--size", "32x24"];

/// What the report says: the status of each picture.
fn report(bench: &Bench, name: &str) -> BTreeMap<String, String> {
    let text = std::fs::read_to_string(bench.path(name)).expect("a report");
    let record = |line: &str| {
        let record: Value = serde_json::from_str(line).expect("JSON");
        let word = |name: &str| record[name].as_str().expect("words").to_owned();
        (word("output"), word("status"))
    };
    text.lines().map(record).collect()
}

fn statuses(bench: &Bench) -> Vec<(String, String)> {
    report(bench, "out/report.jsonl").into_iter().collect()
}

fn expected(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
    pairs.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect()
}

#[test]
fn a_broken_model_is_a_line_of_the_report_and_what_is_done_is_not_done_again() {
    let bench = bench("batch");
    let run = bench.run(&SMALL);
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert_eq!(run.stdout, "3 done, 0 done before, 1 failed\n");
    assert!(run.stderr.contains("broken.glb"), "{}", run.stderr);
    let first = expected(&[
        ("a.png", "done"),
        ("b.png", "done"),
        ("broken.png", "failed"),
        ("more/a.png", "done"),
    ]);
    assert_eq!(statuses(&bench), first);
    assert_eq!(bench.picture("out/more/a.png").0, 32);
    let sheet = std::fs::read_to_string(bench.path("out/index.html")).expect("a contact sheet");
    for word in ["./more/a.png", "3 pictures, 1 failed", "broken.glb"] {
        assert!(sheet.contains(word), "{word}: {sheet}");
    }
    bench.bring("teapot.glb");
    std::fs::rename(bench.path("teapot.glb"), bench.path("models/b.glb")).expect("another model");
    std::fs::remove_file(bench.path("out/more/a.png")).expect("a picture");
    let run = bench.run(&SMALL);
    assert_eq!(run.stdout, "2 done, 1 done before, 1 failed\n", "content changed, picture gone");
    let run = bench.run(&[&SMALL[..], &["--background", "#123"]].concat());
    assert_eq!(run.stdout, "3 done, 0 done before, 1 failed\n", "settings changed");
    let run = bench.run(&[&SMALL[..], &["--background", "#123", "--again"]].concat());
    assert_eq!(run.stdout, "3 done, 0 done before, 1 failed\n", "asked for again");
}

#[test]
fn shards_unite_to_the_whole() {
    let bench = bench("batch_shards");
    std::fs::remove_file(bench.path("models/broken.glb")).expect("the broken one");
    for shard in ["1/2", "2/2"] {
        let run = bench.run(&[&SMALL[..], &["--shard", shard]].concat());
        assert_eq!(run.code, 0, "{}", run.stderr);
    }
    let mut united = report(&bench, "out/report-1-of-2.jsonl");
    let other = report(&bench, "out/report-2-of-2.jsonl");
    assert!(other.keys().all(|picture| !united.contains_key(picture)), "no picture is made twice");
    united.extend(other);
    assert_eq!(united.into_keys().collect::<Vec<_>>(), ["a.png", "b.png", "more/a.png"]);
    let run = bench.run(&SMALL);
    assert_eq!((run.code, run.stdout.as_str()), (0, "0 done, 3 done before, 0 failed\n"));
    let run = bench.run(&[&SMALL[..], &["--shard", "auto"]].concat());
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("SLURM_ARRAY_TASK_ID"), "{}", run.stderr);
}

#[test]
fn a_run_that_is_killed_goes_on_where_it_was() {
    let bench = Bench::new("batch_killed");
    std::fs::create_dir(bench.path("models")).expect("a folder");
    bench.bring("teapot.glb");
    for number in 0..16 {
        let copy = bench.path(&format!("models/{number:02}.glb"));
        std::fs::copy(bench.path("teapot.glb"), copy).expect("a model");
    }
    let arguments = ["batch", "models", "--out", "out", "--size", "320x240", "--threads", "1"];
    let program = alberti_tests::program().expect("the program");
    let mut process = Command::new(program)
        .args(arguments)
        .current_dir(bench.path(""))
        .stdout(Stdio::null())
        .spawn()
        .expect("the program starts");
    let begin = Instant::now();
    let lines = || std::fs::read_to_string(bench.path("out/report.jsonl")).unwrap_or_default();
    while lines().lines().filter(|line| line.contains("done")).count() < 3 {
        assert!(begin.elapsed() < Duration::from_secs(60), "it does nothing: {}", lines());
        std::thread::sleep(Duration::from_millis(5));
    }
    process.kill().expect("it can be killed");
    process.wait().expect("it ends");
    let before = lines().lines().filter(|line| line.contains("done")).count();
    let run = bench.run(&arguments);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(report(&bench, "out/report.jsonl").len(), 16);
    let kept: usize = run
        .stdout
        .split(", ")
        .nth(1)
        .and_then(|words| words.split(' ').next())
        .and_then(|count| count.parse().ok())
        .expect("a count");
    assert_eq!(kept, before, "{}", run.stdout);
    assert!(kept < 16, "it was killed before it was through");
    assert!(!bench.files().iter().any(|name| name.ends_with(".part")));
}

#[test]
fn lists_and_scenes_are_inputs_too() {
    let bench = bench("batch_lists");
    bench.write("list.txt", "# models\nmodels/a.glb\n\nmodels/more/a.glb\n");
    bench.write("scene.ron", "Scene(models: [(path: \"models/b.glb\")], image: (size: (8, 8)))");
    let run = bench.run(&["batch", "list.txt", "scene.ron", "--out", "out"]);
    assert_eq!((run.code, run.stdout.as_str()), (0, "3 done, 0 done before, 0 failed\n"));
    assert_eq!(bench.picture("out/scene.png").0, 8);
    assert_eq!(bench.picture("out/models/more/a.png").0, 960);
    let run = bench.run(&["batch", "nowhere", "--out", "out2"]);
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("nowhere"), "{}", run.stderr);
}
