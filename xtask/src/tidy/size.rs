//! How long files and functions may be.

use super::Violation;
use super::code::is_word_char;
use super::source::Source;

/// A file is one subject; past this many lines it is worth a second look,
const LONG_FILE_LINES: usize = 400;
/// and past this many it is two subjects.
const MAX_FILE_LINES: usize = 500;
/// A `lib.rs` names and re-exports.
const MAX_LIB_LINES: usize = 120;
const MAX_FUNCTION_LINES: usize = 60;

/// A note on a file that is long but not yet too long.
pub fn long_file(source: &Source) -> Option<Violation> {
    let lines = source.text.lines().count();
    let long = lines > LONG_FILE_LINES && lines <= MAX_FILE_LINES;
    long.then(|| Violation::new(&source.path, format!("{lines} lines: is it still one subject?")))
}

pub fn file_length(source: &Source) -> Vec<Violation> {
    let lines = source.text.lines().count();
    let most = if source.path.ends_with("/src/lib.rs") { MAX_LIB_LINES } else { MAX_FILE_LINES };
    if lines <= most {
        return Vec::new();
    }
    vec![Violation::new(&source.path, format!("{lines} lines, where {most} are allowed"))]
}

pub fn function_length(source: &Source) -> Vec<Violation> {
    let long = |start: usize| {
        let lines = function_lines(&source.code[start..]);
        (lines > MAX_FUNCTION_LINES).then(|| {
            let message =
                format!("a function of {lines} lines, where {MAX_FUNCTION_LINES} are allowed");
            Violation::new(source.line_text(start + 1), message)
        })
    };
    (0..source.code.len()).filter(|i| begins_function(&source.code[*i])).filter_map(long).collect()
}

fn begins_function(line: &str) -> bool {
    let Some(at) = line.find("fn ") else { return false };
    let before = line[..at].chars().next_back();
    let named = line[at + 3..].chars().next().is_some_and(is_word_char);
    named && !before.is_some_and(is_word_char)
}

/// Lines from a function's first to that of its closing brace; 0 for one without a body.
fn function_lines(lines: &[String]) -> usize {
    let mut depth = 0;
    for (number, line) in lines.iter().enumerate() {
        for c in line.chars() {
            match c {
                // A bracket holds the `;` of an array type; it is no end.
                '{' | '(' | '[' => depth += 1,
                '}' | ')' | ']' => depth -= 1,
                ';' if depth == 0 => return 0,
                _ => {}
            }
            if c == '}' && depth == 0 {
                return number + 1;
            }
        }
    }
    0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn function_of(lines: usize) -> Source {
        let body = "    let x = [0; 3];\n".repeat(lines - 2);
        Source::new("crates/a/src/b.rs", format!("//! B.\n\npub fn f(x: [u8; 3]) {{\n{body}}}\n"))
    }

    #[test]
    fn sixty_lines_pass_and_sixty_one_do_not() {
        assert_eq!(function_length(&function_of(60)), []);
        let faults = function_length(&function_of(61));
        assert_eq!((faults.len(), faults[0].location.as_str()), (1, "crates/a/src/b.rs:3"));
    }

    #[test]
    fn braces_in_strings_and_declarations_without_body_do_not_count() {
        let text = "fn f() {\n    g(\"}}}\");\n}\ntrait T {\n    fn g(&self);\n}\n";
        let source = Source::new("a.rs", text);
        assert_eq!(function_lines(&source.code), 3);
        assert_eq!(function_lines(&source.code[4..]), 0);
        assert!(!begins_function("// fnord ") && !begins_function("let x: fn (u8)"));
    }

    #[test]
    fn a_lib_has_less_room_than_other_files() {
        let lines = "//! A.\n".repeat(121);
        assert_eq!(file_length(&Source::new("crates/a/src/lib.rs", lines.clone())).len(), 1);
        assert_eq!(file_length(&Source::new("crates/a/src/b.rs", lines)).len(), 0);
        assert!(long_file(&Source::new("crates/a/src/b.rs", "//\n".repeat(401))).is_some());
    }
}
