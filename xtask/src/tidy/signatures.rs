//! Rule for signatures: the form of function parameters.

use super::Violation;
use super::code::is_word_char;
use super::source::Source;

/// The maximum number of lines to read from a signature.
const MOST_LINES: usize = 80;

/// Finds tuples that are destructured in a signature, because their members have no names for
/// callers.
pub fn tuple_parameters(source: &Source) -> Vec<Violation> {
    if !source.path.starts_with("crates/") || !source.path.contains("/src/") {
        return Vec::new();
    }
    let tuples = |start: usize| {
        let tuples = parameters(&source.code[start..]).into_iter().filter(|one| is_tuple(one));
        tuples.map(move |one| {
            let one = one.split_whitespace().collect::<Vec<&str>>().join(" ");
            let message = format!("replace `{one}` with several parameters or one named parameter");
            Violation::new(source.line_text(start + 1), message)
        })
    };
    let functions = (0..source.code.len()).filter(|i| begins_function(&source.code[*i]));
    functions.flat_map(tuples).collect()
}

/// Returns whether a parameter is a tuple of patterns or a reference to one.
fn is_tuple(parameter: &str) -> bool {
    parameter.trim_start().trim_start_matches('&').starts_with('(')
}

/// Returns whether a function begins in a line of code.
pub fn begins_function(line: &str) -> bool {
    let Some(at) = line.find("fn ") else { return false };
    let before = line[..at].chars().next_back();
    let named = line[at + 3..].chars().next().is_some_and(is_word_char);
    named && !before.is_some_and(is_word_char)
}

/// Returns the parameters of the function that begins in the first line, including `self`. The list
/// is split at commas outside inner brackets.
pub fn parameters(lines: &[String]) -> Vec<String> {
    let signature = lines[..lines.len().min(MOST_LINES)].join("\n");
    let Some((_, after_fn)) = signature.split_once("fn ") else { return Vec::new() };
    let (mut depth, mut angles, mut previous) = (0, 0, ' ');
    let (mut found, mut current) = (Vec::new(), String::new());
    for c in after_fn.chars() {
        let is_inside = depth > 0;
        match c {
            '<' if depth <= 1 => angles += 1,
            // The `>` in the arrow of a function type is not a closing bracket.
            '>' if depth <= 1 && previous != '-' => angles -= 1,
            '(' | '[' | '{' if angles == 0 || is_inside => depth += 1,
            ')' | ']' | '}' if is_inside => depth -= 1,
            _ => {}
        }
        previous = c;
        let is_list_end = c == ')' && depth == 0 && angles == 0;
        if is_list_end || c == ',' && depth == 1 && angles == 0 {
            found.push(std::mem::take(&mut current));
        } else if is_inside {
            current.push(c);
        }
        if is_list_end {
            // Skip an empty list, and the empty part after a trailing comma.
            found.retain(|one| !one.trim().is_empty());
            return found;
        }
    }
    Vec::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_end_at_commas_outside_inner_brackets() {
        let table: [(&str, &[&str]); 5] = [
            ("fn f() {", &[]),
            ("fn f(a: u8) -> (u8, u8) {", &["a: u8"]),
            (
                "pub fn f<A, B>(&self, a: Map<A, B>, b: [(A, B); 2]) {",
                &["&self", "a: Map<A, B>", "b: [(A, B); 2]"],
            ),
            ("fn f(a: impl Fn(u8, u8) -> u8, b: u8,) {", &["a: impl Fn(u8, u8) -> u8", "b: u8"]),
            ("fn f<F: Fn(u8, u8) -> u8>(a: F, (b, c): (u8, u8)) {", &["a: F", "(b, c): (u8, u8)"]),
        ];
        for (signature, expected) in table {
            let found = parameters(&[signature.to_owned()]);
            let found: Vec<&str> = found.iter().map(|one| one.trim()).collect();
            assert_eq!(found, expected, "{signature}");
        }
    }

    #[test]
    fn tuples_are_not_destructured_in_signatures() {
        let faults = |path: &str, code: &str| tuple_parameters(&Source::new(path, code));
        let path = "crates/a/src/b.rs";
        let code = "\nfn f(\n    a: u8,\n    (b, c): (u8, u8),\n) {}\nfn g(&(a, b): &Pair) {}\n";
        let locations: Vec<String> =
            faults(path, code).into_iter().map(|fault| fault.location).collect();
        assert_eq!(locations, ["crates/a/src/b.rs:2", "crates/a/src/b.rs:6"]);
        assert_eq!(faults("crates/a/tests/b.rs", code), []);
        for allowed in [
            "fn f(a: (u8, u8), [b, c]: [u8; 2], Pair { d, e }: Pair) {}\n",
            "// fn f((a, b): (u8, u8)) {}\nconst F: &str = \"fn f((a, b): (u8, u8)) {}\";\n",
            "fn f() {\n    let g = |(a, b): (u8, u8)| a + b;\n}\n",
        ] {
            assert_eq!(faults(path, allowed), [], "{allowed}");
        }
    }

    #[test]
    fn functions_begin_with_fn_and_a_name() {
        assert!(begins_function("pub(crate) const fn f() {"));
        assert!(!begins_function("// fnord ") && !begins_function("let x: fn (u8)"));
    }
}
