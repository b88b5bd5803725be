//! Rules for names: a type name has one meaning within a crate, and few functions are called `of`.

use super::Violation;
use super::code::is_word_char;
use super::source::Source;
use std::collections::BTreeMap;

/// Type names that may be declared more than once in a crate, each with the reason. At most eight
/// are allowed.
const REPEATED_TYPES: &[(&str, &str, &str)] = &[];

/// The maximum number of functions called `of` in all crates. The name is hard to search for.
const MAX_FUNCTIONS_NAMED_OF: usize = 15;

/// Finds types with the same name in one crate, outside tests.
pub fn repeated_types(sources: &[Source]) -> Vec<Violation> {
    let mut declared: BTreeMap<(&str, &str), Vec<String>> = BTreeMap::new();
    for source in sources.iter().filter(|source| !is_test(source)) {
        let Some(name) = crate_name(&source.path) else { continue };
        for (number, line) in source.code_without_tests() {
            if let Some(declaration) = declared_type(line) {
                let lines = declared.entry((name, declaration)).or_default();
                lines.push(source.line_text(number));
            }
        }
    }
    let is_allowed = |(package, name): (&str, &str)| {
        REPEATED_TYPES.iter().any(|(known, repeated, _)| (*known, *repeated) == (package, name))
    };
    let repeated = declared.into_iter().filter(|(key, lines)| lines.len() > 1 && !is_allowed(*key));
    repeated
        .map(|((_, name), lines)| {
            let others = lines[1..].join(", ");
            Violation::new(&lines[0], format!("`{name}` is also declared at {others}"))
        })
        .collect()
}

/// Returns all functions called `of`, if there are too many.
pub fn functions_named_of(sources: &[Source]) -> Vec<Violation> {
    let mut lines = Vec::new();
    for source in sources.iter().filter(|source| source.path.starts_with("crates/")) {
        let named = source.code_without_tests().filter(|(_, line)| declares_of(line));
        lines.extend(named.map(|(number, _)| source.line_text(number)));
    }
    if lines.len() <= MAX_FUNCTIONS_NAMED_OF {
        return Vec::new();
    }
    let message = format!("at most {MAX_FUNCTIONS_NAMED_OF} functions may be called `of`");
    lines.into_iter().map(|line| Violation::new(line, message.clone())).collect()
}

fn is_test(source: &Source) -> bool {
    source.path.contains("/tests/") || source.path.ends_with("tests.rs")
}

/// Returns the crate of a library or program file.
fn crate_name(path: &str) -> Option<&str> {
    let (name, rest) = path.strip_prefix("crates/")?.split_once('/')?;
    rest.starts_with("src/").then_some(name)
}

/// Returns the name of the type that a line declares. Associated types do not count.
fn declared_type(line: &str) -> Option<&str> {
    let mut words = line.split_whitespace().skip_while(|word| word.starts_with("pub"));
    let keyword = words.next()?;
    let is_type = matches!(keyword, "struct" | "enum" | "trait" | "union")
        || keyword == "type" && !line.starts_with(' ');
    let name = words.next().filter(|_| is_type)?;
    // In a macro, the name may be a variable, as in `struct $name`.
    name.split(|c: char| !is_word_char(c)).next().filter(|name| !name.is_empty())
}

fn declares_of(line: &str) -> bool {
    line.split_once("fn of").is_some_and(|(before, after)| {
        !before.ends_with(is_word_char) && !after.starts_with(is_word_char)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_type_name_has_one_meaning_in_a_crate() {
        let source = |path: &str, text: &str| Source::new(path, text);
        let violations = repeated_types(&[
            source("crates/a/src/x.rs", "pub struct Reader;\nenum Kind {}\n"),
            source("crates/a/src/y.rs", "//! Y.\npub(crate) struct Reader<'a>(&'a u8);\n"),
            source("crates/a/tests/z.rs", "struct Reader;\n"),
            source("crates/b/src/x.rs", "struct Reader;\n#[cfg(test)]\nstruct Reader;\n"),
        ]);
        assert_eq!(violations.len(), 1);
        assert_eq!(violations[0].location, "crates/a/src/x.rs:1");
        assert!(violations[0].message.contains("crates/a/src/y.rs:2"));
    }

    #[test]
    fn too_many_functions_named_of_are_reported() {
        let text =
            |count: usize| "pub fn of(x: u8) {}\nfn office() {}\nlet of = 1;\n".repeat(count);
        let count =
            |times| functions_named_of(&[Source::new("crates/a/src/x.rs", text(times))]).len();
        assert_eq!(count(MAX_FUNCTIONS_NAMED_OF), 0);
        assert_eq!(count(MAX_FUNCTIONS_NAMED_OF + 1), MAX_FUNCTIONS_NAMED_OF + 1);
    }

    #[test]
    fn exceptions_are_few_and_have_reasons() {
        assert!(REPEATED_TYPES.len() <= 8);
        assert!(REPEATED_TYPES.iter().all(|(.., reason)| !reason.is_empty()));
    }
}
