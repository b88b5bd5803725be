//! `alberti batch --list`: jobs from JSON and CSV lines, names from templates, and one scene for
//! many models.

use crate::batch::{batch_sandbox, read_records};
use crate::sandbox::Sandbox;
use serde_json::Value;

fn run_list(sandbox: &Sandbox, list: &str, more: &[&str]) -> (i32, String, String) {
    let arguments = [&["batch", "--list", list, "--out-dir", "out"], more].concat();
    let run = sandbox.run(&arguments);
    (run.code, run.stdout, run.stderr)
}

#[test]
fn json_lines_have_their_own_flags() {
    let sandbox = batch_sandbox("batch_jsonl");
    sandbox.write_file(
        "models/jobs.jsonl",
        concat!(
            "{\"input\": \"a.glb\", \"output\": \"x/one.png\", \"size\": \"20x10\"}\n",
            "\n",
            "{\"input\": \"a.glb\", \"view\": \"front\", \"lenient\": true, \"overlay\": ",
            "[\"axes\", \"grid\"], \"samples\": 4}\n",
            "{\"input\": \"b.glb\", \"background\": \"#000\", \"pictures\": [{\"view\": \"top\", ",
            "\"output\": \"top.png\"}, {\"size\": \"6x6\"}, {\"background\": \"#f00\", ",
            "\"output\": \"red.png\"}]}\n",
        ),
    );
    let list = "models/jobs.jsonl";
    let (code, stdout, stderr) = run_list(&sandbox, list, &["--size", "32x24", "--view", "right"]);
    assert_eq!((code, stdout.as_str()), (0, "5 rendered, 0 up to date, 0 failed\n"), "{stderr}");
    let size = |name: &str| {
        let (width, height, _) = sandbox.read_picture(name);
        (width, height)
    };
    assert_eq!(size("out/x/one.png"), (20, 10));
    assert_eq!(size("out/a-00000003.png"), (32, 24), "the line has no size");
    assert_eq!(size("out/b-00000004-2.png"), (6, 6), "the second picture has no name");
    let corner = |name: &str| sandbox.read_picture(name).2.first().copied();
    assert_eq!(corner("out/top.png"), Some([0, 0, 0, 255]), "the line's background");
    assert_eq!(corner("out/red.png"), Some([255, 0, 0, 255]), "the picture's background");
    // The same picture as without a list.
    let front = ["render", "models/a.glb", "--size", "32x24", "--view", "front", "--samples", "4"];
    let front = [&front[..], &["--overlay", "axes,grid", "-o", "front.png"]].concat();
    assert_eq!(sandbox.run(&front).code, 0);
    assert_eq!(sandbox.read_picture("front.png"), sandbox.read_picture("out/a-00000003.png"));
    let (code, stdout, _) = run_list(&sandbox, list, &["--size", "32x24", "--view", "right"]);
    assert_eq!((code, stdout.as_str()), (0, "0 rendered, 5 up to date, 0 failed\n"));
}

#[test]
fn invalid_lines_fail_by_number_and_the_others_run() {
    let sandbox = batch_sandbox("batch_wrong_lines");
    let lines = [
        ("{\"input\": \"models/a.glb\", \"size\": \"8x8\"}", ""),
        ("{\"input\": \"models/a.glb\"", "not JSON"),
        ("[1]", "not a JSON object"),
        ("{\"output\": \"x.png\"}", "missing member `input`"),
        ("{\"input\": 3}", "`input` must be a string"),
        ("{\"input\": \"models/a.glb\", \"sampels\": 4}", "did you mean `samples`?"),
        ("{\"input\": \"models/a.glb\", \"max_anisotropy\": 4}", "did you mean `max-anisotropy`?"),
        ("{\"input\": \"models/a.glb\", \"out-dir\": \"x\"}", "unknown member `out-dir`"),
        ("{\"input\": \"models/a.glb\", \"output\": \"../x.png\"}", "outside the output folder"),
        ("{\"input\": \"models/a.glb\", \"output\": \"/x.png\"}", "outside the output folder"),
        ("{\"input\": \"models/a.glb\", \"output\": \"x.jpg\"}", "end the name in .png"),
        ("{\"input\": \"models/a.glb\", \"pictures\": []}", "must be a nonempty list of pictures"),
        ("{\"input\": \"models/a.glb\", \"pictures\": [{\"sice\": 1}]}", "pictures[0]: unknown"),
        ("{\"input\": \"models/a.glb\", \"samples\": 3}", "expected 1, 4, 8 or 16"),
        (
            "{\"input\": \"models/a.glb\", \"view\": \"front\", \"camera\": 0}",
            "cannot be used with",
        ),
        ("{\"input\": \"nowhere.glb\"}", "nowhere.glb"),
    ];
    let text: String = lines.iter().map(|(line, _)| format!("{line}\n")).collect();
    sandbox.write_file("jobs.jsonl", text);
    let (code, stdout, stderr) = run_list(&sandbox, "jobs.jsonl", &[]);
    assert_eq!((code, stdout.as_str()), (1, "1 rendered, 0 up to date, 15 failed\n"), "{stderr}");
    let records = read_records(&sandbox, "");
    for (at, (line, words)) in lines.iter().enumerate().filter(|(_, (_, words))| !words.is_empty())
    {
        let place = format!("jobs.jsonl:{}: ", at + 1);
        let is_of_line =
            |record: &&Value| record["message"].as_str().expect("a message").starts_with(&place);
        let record = records.iter().find(is_of_line);
        let record = record.unwrap_or_else(|| panic!("{place}: {records:?}"));
        assert_eq!(record["status"], "failed", "{line}");
        let message = record["message"].as_str().expect("a message");
        assert!(message.contains(words), "{line}: {message}");
        assert!(stderr.contains(&place), "{place}: {stderr}");
    }
}

#[test]
fn csv_columns_are_members() {
    let sandbox = batch_sandbox("batch_csv");
    sandbox.write_file(
        "jobs.csv",
        "input,output,size,view,lenient\r\n\
         models/a.glb,\"a, b.png\",8x8,,true\r\n\
         models/b.glb,,10x10,top,\r\n\
         models/b.glb,c.png\r\n",
    );
    let (code, stdout, stderr) = run_list(&sandbox, "jobs.csv", &["--name", "{line}.png"]);
    assert_eq!((code, stdout.as_str()), (1, "2 rendered, 0 up to date, 1 failed\n"), "{stderr}");
    assert_eq!(sandbox.read_picture("out/a, b.png").0, 8);
    assert_eq!(sandbox.read_picture("out/3.png").0, 10);
    assert!(stderr.contains("jobs.csv:4: the line has 2 fields, but the header has 5"), "{stderr}");
    for (header, words) in [
        ("input,sise\n", "did you mean `size`?"),
        ("output\n", "missing column `input`"),
        ("", "missing column `input`"),
        ("input,size,size\n", "duplicate column `size`"),
    ] {
        sandbox.write_file("wrong.csv", header);
        let (code, _, stderr) = run_list(&sandbox, "wrong.csv", &[]);
        assert_eq!(code, 2, "{header}: {stderr}");
        assert!(stderr.contains(words) && stderr.contains("wrong.csv:1"), "{header}: {stderr}");
    }
    let (code, _, stderr) = run_list(&sandbox, "nowhere.jsonl", &[]);
    assert_eq!(code, 2);
    assert!(stderr.contains("nowhere.jsonl"), "{stderr}");
}

#[test]
fn a_list_can_come_from_a_pipe() {
    let sandbox = batch_sandbox("batch_list_pipe");
    for (list, output) in [
        ("{\"input\": \"models/a.glb\", \"output\": \"j.png\"}", "out/j.png"),
        ("input,output\nmodels/a.glb,c.png\n", "out/c.png"),
    ] {
        let arguments = ["batch", "--list", "-", "--out-dir", "out", "--size", "8x8"];
        let (code, stdout) = sandbox.run_with_input(&arguments, list.as_bytes());
        assert_eq!((code, stdout.as_slice()), (0, &b"1 rendered, 0 up to date, 0 failed\n"[..]));
        assert_eq!(sandbox.read_picture(output).0, 8);
    }
}

#[test]
fn names_follow_a_template_in_any_folder() {
    let sandbox = batch_sandbox("batch_names");
    let small = ["batch", "models", "--out-dir", "out", "--size", "8x8", "--name"];
    let run = |template: &str| sandbox.run(&[&small[..], &[template]].concat());
    let twice = run("{stem}.png");
    assert_eq!(twice.code, 2, "{}", twice.stderr);
    assert!(twice.stderr.contains("models/a.glb and models/more/a.glb"), "{}", twice.stderr);
    let wrong = run("{stm}.png");
    assert_eq!(wrong.code, 2);
    assert!(wrong.stderr.contains("{stem}"), "{}", wrong.stderr);
    let named = run("all/{prefix}/{folder}/{name}.png");
    assert_eq!((named.code, named.stdout.as_str()), (1, "3 rendered, 0 up to date, 1 failed\n"));
    let records = read_records(&sandbox, "");
    let names: Vec<&str> =
        records.iter().map(|record| record["output"].as_str().expect("a name")).collect();
    let more = names.iter().find(|name| name.ends_with("/more/a.glb.png")).expect("a picture");
    let prefix = more.strip_prefix("all/").and_then(|rest| rest.split('/').next());
    let prefix = prefix.expect("a prefix");
    assert!(prefix.len() == 2 && u8::from_str_radix(prefix, 16).is_ok(), "{more}");
    assert_eq!(sandbox.read_picture(&format!("out/{more}")).0, 8);
}

#[test]
fn one_scene_is_rendered_with_many_models() {
    let sandbox = batch_sandbox("batch_scene");
    sandbox.write_file(
        "lineup.ron",
        "Scene(models: [(path: \"{input}\"), (path: \"models/b.glb\", translation: (2, 0, \
         0))], image: (size: (12, 9)))",
    );
    sandbox.write_file("empty.ron", "Scene(models: [(path: \"models/b.glb\")])");
    let arguments = ["batch", "models/a.glb", "models/more", "--out-dir", "out"];
    let run = sandbox.run(&[&arguments[..], &["--scene", "lineup.ron"]].concat());
    assert_eq!(run.stdout, "2 rendered, 0 up to date, 0 failed\n", "{}", run.stderr);
    assert_eq!(sandbox.read_picture("out/a.glb.png").0, 12);
    // The same picture as from a scene that names the model.
    let text = std::fs::read_to_string(sandbox.path_of("lineup.ron")).expect("the scene");
    sandbox.write_file("named.ron", text.replace("{input}", "models/a.glb"));
    assert_eq!(sandbox.run(&["render", "named.ron", "-o", "named.png"]).code, 0);
    assert_eq!(sandbox.read_picture("named.png"), sandbox.read_picture("out/a.glb.png"));
    let run = sandbox.run(&[&arguments[..], &["--scene", "empty.ron"]].concat());
    assert_eq!((run.code, run.stdout.as_str()), (1, "0 rendered, 0 up to date, 2 failed\n"));
    assert!(run.stderr.contains("{input}"), "{}", run.stderr);
    sandbox.write_file(
        "jobs.jsonl",
        "{\"input\": \"models/a.glb\", \"scene\": \"lineup.ron\", \"output\": \"l.png\"}\n\
         {\"input\": \"lineup.ron\", \"scene\": \"lineup.ron\"}\n",
    );
    let (code, stdout, stderr) = run_list(&sandbox, "jobs.jsonl", &[]);
    assert_eq!((code, stdout.as_str()), (1, "1 rendered, 0 up to date, 1 failed\n"), "{stderr}");
    assert_eq!(sandbox.read_picture("named.png"), sandbox.read_picture("out/l.png"));
    assert!(stderr.contains("jobs.jsonl:2: lineup.ron is a scene, not a model"), "{stderr}");
}
