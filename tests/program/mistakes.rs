//! Mistakes in scene files, flags and models, and the messages about them: the mistake, its
//! location, and its fix.
//!
//! Each file in `tests/program/mistakes` is a list of cases:
//!
//! ```text
//! === the mistake in words
//! --- scene.ron                     files; the models from `scenes/models` already exist
//! Scene(modles: [])
//! $ alberti render scene.ron        the call, its standard error stream, and its exit code
//! error: …
//! [1]
//! ```
//! `BLESS=1 cargo test -p alberti-tests --test program mistakes` writes the current messages into
//! the files. Read each message before you commit it.

use crate::sandbox::Sandbox;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Models in `scenes/models` that the cases use.
const MODELS: [&str; 3] = ["crate.glb", "room.glb", "lamp.glb"];

/// A mistake.
struct Case {
    title: String,
    files: Vec<(String, String)>,
    call: String,
    message: String,
}

fn parse_cases(text: &str) -> Vec<Case> {
    text.split("=== ").skip(1).map(parse_case).collect()
}

fn parse_case(text: &str) -> Case {
    let (title, rest) = text.split_once('\n').expect("a title");
    let (files, answer) = rest.split_once("$ alberti ").expect("a call");
    let (call, message) = answer.split_once('\n').unwrap_or((answer, ""));
    let file = |part: &str| {
        let (name, content) = part.split_once('\n').expect("a file");
        (name.to_owned(), content.to_owned())
    };
    Case {
        title: title.to_owned(),
        files: files.split("--- ").skip(1).map(file).collect(),
        call: call.to_owned(),
        message: message.to_owned(),
    }
}

impl Case {
    /// Runs the call; returns its message and exit code.
    fn run_case(&self, sandbox: &Sandbox) -> String {
        for (name, content) in &self.files {
            let folder = sandbox.path_of(name).parent().map(PathBuf::from).expect("a folder");
            std::fs::create_dir_all(folder).expect("a folder");
            sandbox.write_file(name, content);
        }
        let words = split_call(&self.call);
        let run = sandbox.run(&words.iter().map(String::as_str).collect::<Vec<_>>());
        assert_ne!(run.code, 0, "{}: the call succeeded", self.title);
        let message = if run.stderr.is_empty() { run.stdout } else { run.stderr };
        format!("{}\n[{}]\n\n", message.trim_end(), run.code)
    }

    fn to_text(&self, message: &str) -> String {
        let mut text = format!("=== {}\n", self.title);
        for (name, content) in &self.files {
            let _ = write!(text, "--- {name}\n{content}");
        }
        let _ = write!(text, "$ alberti {}\n{message}", self.call);
        text
    }
}

/// Splits a call into words; words in quotation marks may contain spaces, or be empty.
fn split_call(call: &str) -> Vec<String> {
    let quoted = call.split('\'').enumerate();
    let parts = quoted.flat_map(|(number, part)| match number % 2 {
        0 => part.split_whitespace().map(str::to_owned).collect(),
        _ => vec![part.to_owned()],
    });
    parts.collect()
}

fn check_table(name: &str) {
    let path =
        alberti_tests::project_root().join("tests/program/mistakes").join(format!("{name}.txt"));
    let text = std::fs::read_to_string(&path).expect("the cases");
    let bless = std::env::var_os("BLESS").is_some() && std::env::var_os("CI").is_none();
    let (mut blessed, mut faults) = (String::new(), String::new());
    for (number, case) in parse_cases(&text).iter().enumerate() {
        let sandbox = Sandbox::new(&format!("mistake_{name}_{number}"));
        MODELS.iter().for_each(|model| sandbox.copy_model(model));
        let message = case.run_case(&sandbox);
        blessed.push_str(&case.to_text(&message));
        if message.trim_end() != case.message.trim_end() {
            let _ = writeln!(
                faults,
                "=== {}\nexpected:\n{}\nactual:\n{message}",
                case.title, case.message
            );
        }
    }
    if bless {
        std::fs::write(&path, blessed.trim_end().to_owned() + "\n").expect("the cases are written");
    }
    assert!(
        faults.is_empty(),
        "{}{faults}",
        if bless { "the file was rewritten: review it\n" } else { "" }
    );
}

#[test]
fn many() {
    check_table("many");
}

#[test]
fn grammar() {
    check_table("grammar");
}

#[test]
fn numbers() {
    check_table("numbers");
}

#[test]
fn meaning() {
    check_table("meaning");
}

#[test]
fn flags() {
    check_table("flags");
}

#[test]
fn files() {
    check_table("files");
}

#[test]
fn views() {
    check_table("views");
}

#[test]
fn there_are_at_least_sixty_cases() {
    let folder = alberti_tests::project_root().join("tests/program/mistakes");
    let entries = std::fs::read_dir(folder).expect("the cases");
    let text = |entry: std::io::Result<std::fs::DirEntry>| {
        std::fs::read_to_string(entry.expect("an entry").path()).expect("cases")
    };
    let count: usize = entries.map(|entry| parse_cases(&text(entry)).len()).sum();
    assert!(count >= 60, "{count} cases");
}
