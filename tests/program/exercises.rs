//! The page of exercises: runs each of its commands, and compares its JSON output with the worked
//! answer on the page (exercises 1 to 11, C104).

use crate::sandbox::Sandbox;
use serde_json::Value;
use std::collections::BTreeSet;

/// A command on the page, with the ids and numbers in its answers.
struct Case {
    title: String,
    command: String,
    answers: Vec<(String, Vec<f64>)>,
}

fn read_page(name: &str) -> String {
    let path = alberti_tests::project_root().join("docs").join(name);
    std::fs::read_to_string(path).expect(name)
}

/// Returns a sandbox with the scenes of the exercises below `docs`, where the commands expect them.
fn sandbox_with_scenes(name: &str) -> Sandbox {
    let sandbox = Sandbox::new(name);
    std::fs::create_dir_all(sandbox.path_of("docs/exercises")).expect("a folder");
    let scenes = alberti_tests::project_root().join("docs/exercises");
    for entry in std::fs::read_dir(scenes).expect("the scenes") {
        let from = entry.expect("a scene").path();
        let file = from.file_name().expect("a name").to_string_lossy().into_owned();
        std::fs::copy(&from, sandbox.path_of(&format!("docs/exercises/{file}"))).expect("a copy");
    }
    sandbox
}

/// Parses a number or a fraction on the page.
fn parse_number(word: &str) -> f64 {
    let (above, below) = word.split_once('/').unwrap_or((word, "1"));
    let parse = |digits: &str| digits.parse::<f64>().unwrap_or_else(|_| panic!("{word}"));
    parse(above) / parse(below)
}

/// Returns the commands on the page, each with the answers that follow it.
fn read_cases(page: &str) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    let mut title = String::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        if let Some(heading) = line.strip_prefix("### ") {
            heading.clone_into(&mut title);
        } else if line == "```sh" {
            let command = lines.next().expect("a command").to_owned();
            cases.push(Case { title: title.clone(), command, answers: Vec::new() });
        } else if let Some((id, numbers)) =
            line.strip_prefix("- `").and_then(|rest| rest.split_once("`: `"))
        {
            let numbers = numbers.trim_end_matches('`').replace(';', " ");
            let numbers = numbers.split_whitespace().map(parse_number).collect();
            cases.last_mut().expect("a command").answers.push((id.to_owned(), numbers));
        }
    }
    cases
}

/// Splits a command into words. A quoted string is one word.
fn split_words(command: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for (part, text) in command.split('\'').enumerate() {
        match part % 2 {
            0 => words.extend(text.split_whitespace().map(str::to_owned)),
            _ => words.push(text.to_owned()),
        }
    }
    words
}

/// Runs a command from a page, which begins with `alberti`.
fn run_command(sandbox: &Sandbox, command: &str, more: &[&str]) -> String {
    let words = split_words(command);
    assert_eq!(words[0], "alberti", "{command}");
    let words: Vec<&str> =
        words.iter().skip(1).map(String::as_str).chain(more.iter().copied()).collect();
    let run = sandbox.run(&words);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{command}");
    run.stdout
}

/// Returns the numbers in the item with this id or, without one, in the member of the document.
fn find_numbers(document: &Value, id: &str) -> Option<Vec<f64>> {
    let steps = document["steps"].as_array().into_iter().flatten();
    let mut items = steps.flat_map(|step| step["items"].as_array().into_iter().flatten());
    let found = match items.find(|item| item["id"] == id) {
        Some(item) => &item["value"],
        None => document.get(id)?,
    };
    let found = found.get("rows").unwrap_or(found);
    Some(match found {
        Value::Array(list) => list
            .iter()
            .flat_map(|part| part.as_array().map_or(std::slice::from_ref(part), Vec::as_slice))
            .filter_map(Value::as_f64)
            .collect(),
        number => vec![number.as_f64()?],
    })
}

#[test]
fn c104_every_exercise_command_gives_the_worked_answer() {
    let sandbox = sandbox_with_scenes("exercises");
    for Case { title, command, answers } in read_cases(&read_page("exercises.md")) {
        let output = match command.rsplit_once(" -o ") {
            Some((_, file)) => {
                run_command(&sandbox, &command, &[]);
                std::fs::read_to_string(sandbox.path_of(file)).expect("an output")
            }
            None => run_command(&sandbox, &command, &["--json"]),
        };
        let document: Value = serde_json::from_str(&output).expect("JSON");
        assert!(!answers.is_empty(), "{title}: {command}");
        for (id, expected) in answers {
            let actual = find_numbers(&document, &id).unwrap_or_default();
            let close = actual.len() == expected.len()
                && actual.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-12);
            assert!(close, "{title}, {id} is {actual:?}, not {expected:?}: {command}");
        }
    }
}

#[test]
fn the_page_has_all_exercises_and_source_items() {
    let page = read_page("exercises.md");
    let cases = read_cases(&page);
    let headings = (12..=24).map(|number| format!("\n### Exercise {number} [own]\n"));
    assert!(headings.into_iter().all(|heading| page.contains(&heading)));
    let titles: BTreeSet<&str> = cases.iter().map(|case| case.title.as_str()).collect();
    for number in 1..=11 {
        assert!(titles.contains(format!("Exercise {number} [S]").as_str()), "exercise {number}");
    }
    let items: Vec<&&str> = titles.iter().filter(|title| !title.starts_with("Exercise")).collect();
    assert!(items.len() >= 30, "{} items", items.len());
    for source in ["[S]", "[N]", "[G]", "[L]", "[A]"] {
        assert!(items.iter().filter(|title| title.ends_with(source)).count() >= 4, "{source}");
    }
}

/// The answers that the page checks with `alberti exercise` are correct.
#[test]
fn answers_in_the_exercise_text_are_correct() {
    let sandbox = Sandbox::new("exercises_answers");
    let page = read_page("exercises.md");
    let spans = page.split('`').skip(1).step_by(2);
    let commands: Vec<&str> = spans
        .filter(|span| span.starts_with("alberti exercise") && span.contains("--answer "))
        .collect();
    assert_eq!(commands.len(), 5, "{commands:?}");
    for command in commands {
        assert_eq!(run_command(&sandbox, command, &["--language", "en"]), "correct\n", "{command}");
    }
    // Runs the samples in the section on checking.
    let (_, samples) = page.split_once("```text\n").expect("samples");
    let samples = samples.split("```").next().unwrap_or_default();
    for sample in samples.split("$ ").skip(1) {
        let (command, said) = sample.split_once('\n').expect("an answer");
        let words = split_words(command);
        let words: Vec<&str> = words.iter().skip(1).map(String::as_str).collect();
        let words = [&words[..], &["--language", "en"]].concat();
        assert_eq!(sandbox.run(&words).stdout, said, "{command}");
    }
}

/// `reference ID` shows the formula, source and command of every id, and each command works.
#[test]
fn every_formula_is_in_the_reference_and_its_command_works() {
    let sandbox = sandbox_with_scenes("formulas");
    let page = read_page("formulas.md");
    let commands: BTreeSet<&str> = page
        .lines()
        .filter_map(|line| line.strip_prefix("Command: `")?.strip_suffix('`'))
        .collect();
    assert!(commands.len() > 35, "{}", commands.len());
    let (with_scene, alone): (Vec<&str>, Vec<&str>) =
        commands.into_iter().partition(|command| command.contains("docs/exercises/"));
    for command in with_scene {
        run_command(&sandbox, command, &[]);
    }
    // These commands are run in an empty folder.
    let empty = Sandbox::new("formulas_alone");
    for command in alone {
        run_command(&empty, command, &[]);
    }
    // Ids that need a scene are listed at the top, and so are ids without a command.
    let ids = |has: &dyn Fn(&str) -> bool| -> Vec<&str> {
        let entries = page.split("\n**").skip(1).filter(|entry| has(entry));
        entries.filter_map(|entry| entry.split(',').next()).collect()
    };
    let in_scenes = ids(&|entry| entry.contains("docs/exercises/"));
    assert_eq!(in_scenes, ["CL-2", "CL-3", "IN-2", "RA-1", "RA-2", "UN-2", "HL-1"]);
    assert_eq!(ids(&|entry| !entry.contains("\nCommand: `")), ["CL-4", "RA-3"]);
    let names = sandbox.run(&["reference", "formulas"]).stdout;
    let headings = page.lines().filter_map(|line| line.strip_prefix("**")?.split("** [").next());
    assert!(names.lines().eq(headings), "{names}");
    for (id, parts) in [
        ("PE-1", ["n + f − f n/z", "Fundamentals of Computer Graphics", "--planes 1,2"]),
        ("ob-1", ["x' = x + z L1 cos φ", "Lecture slides", "--oblique 1/2,45"]),
        ("D3D-1", ["−FN/(F−N)", "Common knowledge", "--conventions direct3d"]),
    ] {
        let run = sandbox.run(&["reference", id]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{id}");
        for part in parts {
            assert!(run.stdout.contains(part), "{id}, {part}: {}", run.stdout);
        }
    }
    let markdown = sandbox.run(&["reference", "PE-1", "--format", "markdown"]).stdout;
    assert!(markdown.contains("```text\n    ┌ n 0  0    0  ┐"), "{markdown}");
    let html = sandbox.run(&["reference", "PE-1", "--format", "html"]).stdout;
    assert!(
        html.starts_with("<!DOCTYPE html>") && html.contains("Command: <code>alberti"),
        "{html}"
    );
    let unknown = sandbox.run(&["reference", "UNKNOWN-1"]);
    assert!(unknown.code == 1 && unknown.stderr.contains("no entry named `UNKNOWN-1`"));
    assert!(unknown.stderr.contains("`alberti scene doc` lists"), "{}", unknown.stderr);
}
