//! Size rules: lines per file and per function, and arguments per function.

use super::Violation;
use super::signatures::{begins_function, parameters};
use super::source::Source;

/// The number of lines above which a file is noted, because it may cover two subjects.
const LONG_FILE_LINES: usize = 400;
/// The number of lines above which a file must be split.
const MAX_FILE_LINES: usize = 500;
/// The maximum number of lines in a `lib.rs`, which declares and re-exports.
const MAX_LIB_LINES: usize = 140;
/// The maximum number of lines in a function.
const MAX_FUNCTION_LINES: usize = 60;

/// The maximum number of arguments of a function, including `self`.
const MAX_ARGUMENTS: usize = 6;
/// Functions that may have more arguments, by file and name. Only inner loops of the rasterizer and
/// the tiled renderer may, because they take their whole state as arguments.
const MANY_ARGUMENTS: &[(&str, &str)] = &[];

/// Returns a note on a file that is long but not yet too long.
pub fn long_file(source: &Source) -> Option<Violation> {
    let lines = source.text.lines().count();
    let long = lines > LONG_FILE_LINES && lines <= MAX_FILE_LINES;
    long.then(|| {
        Violation::new(
            &source.path,
            format!("{lines} lines: does it still cover a single subject?"),
        )
    })
}

/// Reports a file above the limit.
pub fn file_length(source: &Source) -> Vec<Violation> {
    let lines = source.text.lines().count();
    let most = if source.path.ends_with("/src/lib.rs") { MAX_LIB_LINES } else { MAX_FILE_LINES };
    if lines <= most {
        return Vec::new();
    }
    vec![Violation::new(&source.path, format!("{lines} lines, but at most {most} are allowed"))]
}

/// Finds functions above the limit.
pub fn function_length(source: &Source) -> Vec<Violation> {
    let long = |start: usize| {
        let lines = function_lines(&source.code[start..]);
        (lines > MAX_FUNCTION_LINES).then(|| {
            let message = format!(
                "a function has {lines} lines, but at most {MAX_FUNCTION_LINES} are allowed"
            );
            Violation::new(source.line_text(start + 1), message)
        })
    };
    (0..source.code.len()).filter(|i| begins_function(&source.code[*i])).filter_map(long).collect()
}

/// Finds functions with more arguments than allowed, including `self`.
pub fn argument_count(source: &Source) -> Vec<Violation> {
    if !source.path.starts_with("crates/") {
        return Vec::new();
    }
    let many = |start: usize| {
        let count = parameters(&source.code[start..]).len();
        let is_listed = MANY_ARGUMENTS.iter().any(|(path, name)| {
            source.path == *path && source.code[start].contains(&format!("fn {name}"))
        });
        (count > MAX_ARGUMENTS && !is_listed).then(|| {
            let message = format!("{count} arguments, but at most {MAX_ARGUMENTS} are allowed");
            Violation::new(source.line_text(start + 1), message)
        })
    };
    (0..source.code.len()).filter(|i| begins_function(&source.code[*i])).filter_map(many).collect()
}

/// Returns the number of lines from the signature to the closing brace, or 0 if there is no body.
fn function_lines(lines: &[String]) -> usize {
    let mut depth = 0;
    for (number, line) in lines.iter().enumerate() {
        for c in line.chars() {
            match c {
                // Brackets may contain the `;` of an array type, which does not end the signature.
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

    #[test]
    fn arguments_are_counted_only_in_crates() {
        let source =
            |path: &str| Source::new(path, "fn f(a: A, b: B, c: C, d: D, e: E, f: F, g: G) {}\n");
        assert_eq!(argument_count(&source("crates/a/src/b.rs")).len(), 1);
        assert_eq!(argument_count(&source("tests/a.rs")).len(), 0);
    }

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
    fn braces_in_strings_and_declarations_without_a_body_do_not_count() {
        let text = "fn f() {\n    g(\"}}}\");\n}\ntrait T {\n    fn g(&self);\n}\n";
        let source = Source::new("a.rs", text);
        assert_eq!(function_lines(&source.code), 3);
        assert_eq!(function_lines(&source.code[4..]), 0);
    }

    #[test]
    fn a_lib_has_a_lower_limit_than_other_files() {
        let lines = "//! A.\n".repeat(MAX_LIB_LINES + 1);
        assert_eq!(file_length(&Source::new("crates/a/src/lib.rs", lines.clone())).len(), 1);
        assert_eq!(file_length(&Source::new("crates/a/src/b.rs", lines)).len(), 0);
        assert!(long_file(&Source::new("crates/a/src/b.rs", "//\n".repeat(401))).is_some());
    }
}
