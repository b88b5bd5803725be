//! Mistakes in scene files, flags and models, and what people are told: what it is, where it is, what to do.
//!
//! Each file of `tests/program/mistakes` is a list of cases:
//!
//! ```text
//! === what is wrong, in words
//! --- scene.ron                     files, as many as it takes; the models of `scenes/` are there already
//! Scene(modles: [])
//! $ alberti render scene.ron        the call, then what it writes to its standard error, and its code
//! error: …
//! [1]
//! ```
//! `BLESS=1 cargo test -p alberti-tests --test program mistakes` writes what is told now into the files. Read it, each
//! message, before it is committed.

use crate::bench::Bench;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Models of `scenes/models` that cases name.
const MODELS: [&str; 3] = ["crate.glb", "room.glb", "lamp.glb"];

/// A mistake.
struct Case {
    title: String,
    files: Vec<(String, String)>,
    call: String,
    told: String,
}

fn cases(text: &str) -> Vec<Case> {
    text.split("=== ").skip(1).map(case).collect()
}

fn case(text: &str) -> Case {
    let (title, rest) = text.split_once('\n').expect("a title");
    let (files, answer) = rest.split_once("$ alberti ").expect("a call");
    let (call, told) = answer.split_once('\n').unwrap_or((answer, ""));
    let file = |part: &str| {
        let (name, content) = part.split_once('\n').expect("a file");
        (name.to_owned(), content.to_owned())
    };
    Case {
        title: title.to_owned(),
        files: files.split("--- ").skip(1).map(file).collect(),
        call: call.to_owned(),
        told: told.to_owned(),
    }
}

impl Case {
    /// What the program tells now.
    fn run(&self, bench: &Bench) -> String {
        for (name, content) in &self.files {
            let folder = bench.path(name).parent().map(PathBuf::from).expect("a folder");
            std::fs::create_dir_all(folder).expect("a folder");
            bench.write(name, content);
        }
        let words = words(&self.call);
        let run = bench.run(&words.iter().map(String::as_str).collect::<Vec<_>>());
        assert_ne!(run.code, 0, "{}: no mistake", self.title);
        let told = if run.stderr.is_empty() { run.stdout } else { run.stderr };
        format!("{}\n[{}]\n\n", told.trim_end(), run.code)
    }

    fn text(&self, told: &str) -> String {
        let mut text = format!("=== {}\n", self.title);
        for (name, content) in &self.files {
            let _ = write!(text, "--- {name}\n{content}");
        }
        let _ = write!(text, "$ alberti {}\n{told}", self.call);
        text
    }
}

/// The words of a call; those between quotation marks may have blanks, or be empty.
fn words(call: &str) -> Vec<String> {
    let quoted = call.split('\'').enumerate();
    let parts = quoted.flat_map(|(number, part)| match number % 2 {
        0 => part.split_whitespace().map(str::to_owned).collect(),
        _ => vec![part.to_owned()],
    });
    parts.collect()
}

fn table(name: &str) {
    let path = alberti_tests::root().join("tests/program/mistakes").join(format!("{name}.txt"));
    let text = std::fs::read_to_string(&path).expect("the cases");
    let bless = std::env::var_os("BLESS").is_some() && std::env::var_os("CI").is_none();
    let (mut blessed, mut faults) = (String::new(), String::new());
    for (number, case) in cases(&text).iter().enumerate() {
        let bench = Bench::new(&format!("mistake_{name}_{number}"));
        MODELS.iter().for_each(|model| bench.bring(model));
        let told = case.run(&bench);
        blessed.push_str(&case.text(&told));
        if told.trim_end() != case.told.trim_end() {
            let _ = writeln!(faults, "=== {}\nexpected:\n{}\ntold:\n{told}", case.title, case.told);
        }
    }
    if bless {
        std::fs::write(&path, blessed.trim_end().to_owned() + "\n").expect("the cases are written");
    }
    assert!(faults.is_empty(), "{}{faults}", if bless { "written: read it\n" } else { "" });
}

#[test]
fn grammar() {
    table("grammar");
}

#[test]
fn numbers() {
    table("numbers");
}

#[test]
fn meaning() {
    table("meaning");
}

#[test]
fn flags() {
    table("flags");
}

#[test]
fn files() {
    table("files");
}

#[test]
fn views() {
    table("views");
}

#[test]
fn there_are_enough_of_them() {
    let folder = alberti_tests::root().join("tests/program/mistakes");
    let entries = std::fs::read_dir(folder).expect("the cases");
    let text = |entry: std::io::Result<std::fs::DirEntry>| {
        std::fs::read_to_string(entry.expect("an entry").path()).expect("cases")
    };
    let count: usize = entries.map(|entry| cases(&text(entry)).len()).sum();
    assert!(count >= 60, "{count} cases");
}
