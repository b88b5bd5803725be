//! Rules for words: file openings, markers of unfinished work, printing macros and machine paths.

use super::Violation;
use super::source::Source;

/// The folder of the rules, which must name the words that they forbid.
const EXEMPT: &str = "xtask/src/tidy";

/// Markers of unfinished work, which belongs in an issue or in the README.
const UNFINISHED: [&str; 3] = ["TODO", "FIXME", "XXX"];

/// Macros that print or abort and must not be used in a library.
const PRINTING: [&str; 7] =
    ["todo!", "dbg!", "println!", "eprintln!", "print!", "eprint!", "unimplemented!"];

/// Prefixes of paths that exist on only one machine.
const MACHINE_PATHS: [&str; 5] = ["/home/", "/root/", "/tmp/", "/Users/", "C:\\Users"];

/// Checks that a file begins with module documentation.
pub fn module_docs(source: &Source) -> Vec<Violation> {
    let first = source.text.lines().find(|line| !line.trim().is_empty());
    if first
        .is_some_and(|line| line.starts_with("//!") || line.starts_with("#![doc = include_str!("))
    {
        return Vec::new();
    }
    vec![Violation::new(&source.path, "begin the file with `//!` and explain its purpose")]
}

/// Finds markers of unfinished work.
pub fn unfinished_markers(source: &Source) -> Vec<Violation> {
    if source.path.starts_with(EXEMPT) {
        return Vec::new();
    }
    let lines = source.text.lines().enumerate();
    let violations = lines.filter_map(|(i, line)| {
        let word = UNFINISHED.iter().find(|word| has_word(line, word))?;
        Some(Violation::new(source.line_text(i + 1), format!("`{word}`: do it, or file an issue")))
    });
    violations.collect()
}

/// Finds printing macros in libraries.
pub fn printing_macros(source: &Source) -> Vec<Violation> {
    if !source.is_library() {
        return Vec::new();
    }
    let violations = source.code_without_tests().filter_map(|(number, line)| {
        let word = PRINTING.iter().find(|word| has_word(line, word))?;
        Some(Violation::new(source.line_text(number), format!("a library may not use `{word}`")))
    });
    violations.collect()
}

/// Finds machine paths in all text files.
pub fn machine_path_mentions(files: &[(String, String)]) -> Vec<Violation> {
    let mut faults = Vec::new();
    for (path, text) in files.iter().filter(|(path, _)| !path.starts_with(EXEMPT)) {
        for (i, line) in text.lines().enumerate() {
            if let Some(start) = MACHINE_PATHS.iter().find(|start| has_word(line, start)) {
                faults.push(Violation::new(
                    format!("{path}:{}", i + 1),
                    format!("`{start}…` exists on only one machine"),
                ));
            }
        }
    }
    faults
}

/// Returns whether a line contains `word`, but not as the end of a longer word or path.
fn has_word(line: &str, word: &str) -> bool {
    line.match_indices(word).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        !before.is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | '.' | '/'))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_begins_with_its_documentation() {
        let faults = |text: &str| module_docs(&Source::new("a.rs", text)).len();
        assert_eq!(
            (faults("\n//! A."), faults("// A."), faults("use a;\n//! A."), faults("")),
            (0, 1, 1, 1)
        );
    }

    #[test]
    fn libraries_do_not_print_but_programs_tests_and_docs_may() {
        let text = r#"//! A.
/// println!("x");
fn f() {
    eprintln!("x");
}
#[cfg(test)]
mod tests {
    fn g() { println!(); }
}
"#;
        let places = |path: &str| printing_macros(&Source::new(path, text)).len();
        assert_eq!((places("crates/clip/src/a.rs"), places("crates/alberti/src/a.rs")), (1, 0));
    }

    #[test]
    fn machine_paths_are_found_but_relative_paths_are_not() {
        let faults = |line: &str| machine_path_mentions(&[("README.md".into(), line.into())]).len();
        assert_eq!(
            (faults("see /home/anna/x"), faults("target/tmp/x"), faults("see crates/home/x")),
            (1, 0, 0)
        );
    }

    #[test]
    fn unfinished_work_is_reported() {
        let faults = |line: &str| unfinished_markers(&Source::new("a.rs", line)).len();
        assert_eq!((faults("// TODO: more"), faults("// nothing to do")), (1, 0));
    }
}
