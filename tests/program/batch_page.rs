//! The batch page, `docs/batch.md`: its commands are run with the files that it shows.

use crate::sandbox::Sandbox;

/// The mark after a command on the page that the test does not run.
const NOT_RUN: &str = "# not run here";

/// Returns the page's code blocks in a language.
fn blocks<'a>(page: &'a str, language: &str) -> Vec<&'a str> {
    let fence = format!("\n```{language}\n");
    page.split(fence.as_str())
        .skip(1)
        .map(|rest| rest.split("\n```").next().expect("a block"))
        .collect()
}

/// Splits a command into words. A quoted string is one word.
fn split_words(command: &str) -> Vec<&str> {
    let parts = command.split('\'').enumerate();
    let words = parts.flat_map(|(part, text)| match part % 2 {
        0 => text.split_whitespace().collect(),
        _ => vec![text],
    });
    words.collect()
}

#[test]
fn every_command_on_the_page_works_as_described() {
    let path = alberti_tests::project_root().join("docs/batch.md");
    let page = std::fs::read_to_string(path).expect("the page");
    let sandbox = Sandbox::new("batch_page");
    std::fs::create_dir(sandbox.path_of("models")).expect("a folder");
    for model in ["crate.glb", "lamp.glb", "house.glb"] {
        sandbox.copy_model(model);
        let inside = sandbox.path_of(&format!("models/{model}"));
        std::fs::rename(sandbox.path_of(model), inside).expect("a model");
    }
    for (language, name) in [("json", "jobs.jsonl"), ("csv", "views.csv"), ("ron", "lineup.ron")] {
        let block = blocks(&page, language)[0];
        sandbox.write_file(name, format!("{block}\n"));
    }
    let commands = blocks(&page, "sh").into_iter().flat_map(str::lines);
    let commands: Vec<&str> = commands.filter(|line| !line.ends_with(NOT_RUN)).collect();
    assert!(commands.len() > 10);
    for command in commands {
        let words = split_words(command);
        assert_eq!(words[0], "alberti", "{command}");
        let run = sandbox.run(&words[1..]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{command}: {}", run.stdout);
    }
    for (picture, width) in [
        ("out/crate.png", 256),
        ("listed/crate-00000001.png", 256),
        ("listed/lamps/0001.png", 512),
        ("listed/house-top.png", 256),
        ("listed/house-k.png", 256),
        ("views/crate-lines.png", 256),
        ("limited/lamp.png", 256),
        ("watched/lamp.png", 256),
    ] {
        assert_eq!(sandbox.read_picture(picture).0, width, "{picture}");
    }
    for file in ["out/report.jsonl", "parts/report.jsonl", "parts/index.html", "batch.prom"] {
        assert!(sandbox.path_of(file).is_file(), "{file}");
    }
}

#[test]
fn every_shipped_file_is_on_the_page() {
    let root = alberti_tests::project_root();
    let page = std::fs::read_to_string(root.join("docs/batch.md")).expect("the page");
    for folder in std::fs::read_dir(root.join("deploy")).expect("the folder") {
        let folder = folder.expect("a folder").path();
        for file in std::fs::read_dir(folder).expect("a folder") {
            let file = file.expect("a file").path();
            let name = file.strip_prefix(root).expect("below the root").to_string_lossy();
            assert!(page.contains(&format!("(../{name})")), "{name}");
        }
    }
}
