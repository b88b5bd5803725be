//! `alberti reference` and `alberti scene doc`: every flag and every field.

use crate::sandbox::Sandbox;

/// Returns the long flags in a help text.
fn flags_in_help(help: &str) -> Vec<&str> {
    let words = help.split(|c: char| c.is_whitespace() || c == ',' || c == '[' || c == '=');
    words.filter(|word| word.starts_with("--") && word.len() > 2).collect()
}

#[test]
fn every_flag_of_every_command_is_in_the_reference() {
    let sandbox = Sandbox::new("reference_flags");
    let reference = sandbox.run(&["reference"]);
    assert_eq!((reference.code, reference.stderr.as_str()), (0, ""));
    let commands = [
        "render",
        "sheet",
        "info",
        "check",
        "matrix",
        "explain",
        "exercise",
        "compare-projections",
        "sweep",
        "curve depth",
        "demo wrap-around",
        "animate",
        "batch",
        "thumbnailer",
        "reference",
        "scene check",
        "scene init",
        "scene fmt",
        "scene doc",
    ];
    for command in commands {
        let begin = format!("alberti {command}\n");
        let section = reference.stdout.split(&begin).nth(1).expect(command);
        let section = section.split("\n\n").next().expect("a section");
        let mut arguments: Vec<&str> = command.split(' ').collect();
        arguments.push("-h");
        let help = sandbox.run(&arguments).stdout;
        let options: Vec<&str> =
            help.lines().filter(|line| line.trim_start().starts_with('-')).collect();
        let options = options.join("\n");
        let wanted = flags_in_help(&options).into_iter().filter(|flag| *flag != "--");
        for flag in wanted.map(|flag| flag.trim_end_matches(':')) {
            assert!(section.contains(flag), "{command} {flag}\n{section}");
        }
    }
}

#[test]
fn fields_are_found_by_name_type_and_path() {
    let sandbox = Sandbox::new("reference_fields");
    let doc = |word: &str| {
        let run = sandbox.run(&["scene", "doc", word]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{word}");
        run.stdout
    };
    let up = doc("camera.view.up");
    assert!(up.starts_with("View\n") && up.contains("  up: Triple\n"), "{up}");
    assert_eq!(doc("camera.view.LookAt.up").matches("up: Triple").count(), 1);
    assert!(doc("fov_y_degrees").contains("FieldOfView"));
    assert!(doc("lines").contains("crease_degrees: Crease"));
    assert!(sandbox.run(&["reference", "--size"]).stdout.contains("--size <WxH>"));
    assert!(sandbox.run(&["reference", "scene fmt"]).stdout.contains("--check"));
    let run = sandbox.run(&["scene", "doc", "fov_y_degres"]);
    assert!(
        run.code == 1 && run.stderr.contains("did you mean `fov_y_degrees`?"),
        "{}",
        run.stderr
    );
}

#[test]
fn the_reference_is_also_available_as_markdown_and_html() {
    let sandbox = Sandbox::new("reference_formats");
    let markdown = sandbox.run(&["reference", "--format", "markdown"]).stdout;
    assert!(markdown.starts_with("# Alberti reference\n\n## alberti\n"), "{markdown}");
    assert!(markdown.contains("\n## Camera\n") && markdown.contains("\n- `view`: View — "));
    let html = sandbox.run(&["scene", "doc", "--format", "html"]).stdout;
    assert!(html.starts_with("<!DOCTYPE html>") && html.trim_end().ends_with("</html>"));
    assert!(html.contains("<h2 id=\"View\">") && html.contains("<a href=\"#Triple\">Triple</a>"));
    for tag in ["dl", "dt", "dd", "code", "p"] {
        let count = |what: String| html.matches(&what).count();
        assert_eq!(count(format!("<{tag}>")), count(format!("</{tag}>")), "{tag}");
    }
}

/// The codes of the book's margins: topics, misprints and formulas, with the pages that cover them.
#[test]
fn codes_of_the_book_lead_to_its_pages() {
    let sandbox = Sandbox::new("reference_codes");
    for (code, lines) in [
        (
            "M14",
            [
                "M14, A 1 at the end of a perspective's bottom row",
                "Three matrices have the bottom row (0, 0, −1, 1). Correct: (0, 0, −1, 0).",
                "Command: alberti explain --matrix '1 0 0 0",
                "Errata (printed-wrong.md)",
            ],
        ),
        (
            "c61",
            [
                "C61, Field of view, aspect ratio",
                "near and far are validated",
                "Book: ",
                "(conventions.md)",
            ],
        ),
        (
            "GL-1",
            [
                "GL-1, ",
                "Source: ",
                "Command: ",
                "Book: Matrices of the graphics APIs (conventions.md)",
            ],
        ),
    ] {
        let run = sandbox.run(&["reference", code]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{code}");
        for line in lines {
            assert!(run.stdout.contains(line), "{code}, {line}: {}", run.stdout);
        }
    }
    assert_eq!(sandbox.run(&["reference", "M99"]).code, 1);
}

/// Symbols and id prefixes lead to formulas; other words lead to the list of formulas.
#[test]
fn textbook_words_lead_to_formulas() {
    let sandbox = Sandbox::new("reference_symbols");
    for (word, name) in [("HO", "HO-1, lift and divide"), ("M_vp", "VP-1, ")] {
        let run = sandbox.run(&["reference", word]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{word}");
        assert!(run.stdout.contains(name), "{word}: {}", run.stdout);
    }
    let run = sandbox.run(&["reference", "exercise"]);
    assert!(run.stdout.contains("exercise") || run.stderr.contains("`alberti reference formulas`"));
    let run = sandbox.run(&["reference", "qwertz"]);
    assert_eq!((run.code, run.stdout.as_str()), (1, ""));
    assert!(run.stderr.contains("`alberti reference formulas`"), "{}", run.stderr);
}

/// Each convention is explained with its depth range, y direction, handedness and pixel centers.
#[test]
fn conventions_are_explained_by_name() {
    let sandbox = Sandbox::new("reference_conventions");
    for words in [&["reference", "conventions"][..], &["help", "matrix"], &["explain", "--help"]] {
        let text = sandbox.run(words).stdout;
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        for line in [
            "near at z = -1, far at 1; y up; looks along -z (right-handed)",
            "near at z = 0, far at 1; y down; looks along -z (right-handed)",
            "near at z = 0, far at 1; y up; looks along +z (left-handed)",
            "centers at integers",
        ] {
            assert!(text.contains(line), "{words:?}, {line}: {text}");
        }
    }
}

/// Words from titles and descriptions lead to formulas, in any case and form.
#[test]
fn formulas_are_found_by_words() {
    let sandbox = Sandbox::new("reference_words");
    for (word, names) in [
        ("windowing", &["WI-2 and WI-3, windowing", "OR-1, orthographic box"][..]),
        ("homogenize", &["HO-1, lift and divide"]),
        ("Basis", &["CA-1, basis from gaze and view-up"]),
        (
            "inverse",
            &[
                "PE-1, the perspective matrix P and its inverse",
                "IV-1, inverses in closed form",
                "CA-2, world to view",
            ],
        ),
        ("order", &["PE-1, the perspective matrix P"]),
    ] {
        let run = sandbox.run(&["reference", word]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{word}");
        for name in names {
            assert!(run.stdout.contains(name), "{word}: {}", run.stdout);
        }
    }
}
