//! Finds test functions, and the items that they name, in source text.
//!
//! A test names an item in one of two ways: by a word in its own name (`c16_the_unit_square`,
//! `misprint_m11_…`, `exercise_8_and_9_…`) or in the doc comment above it (`/// C31, M28: …`).

use super::items::exercise_item;
use std::collections::BTreeSet;

/// A test function and the items that it names.
#[derive(Debug, PartialEq, Eq)]
pub struct Test {
    /// The path of the file, relative to the root.
    pub path: String,
    /// The name of the function.
    pub name: String,
    /// The ids, such as `C16`, `M11b` or `exercise 3`.
    pub ids: BTreeSet<String>,
}

impl Test {
    /// Returns the crate whose topics a test covers. Tests in `recognition` count toward
    /// `projection`; tests in `explain` and cross-crate tests count toward `pipeline`.
    pub fn owner(&self) -> &str {
        let folder = self.path.strip_prefix("crates/").and_then(|rest| rest.split('/').next());
        match folder {
            Some("recognition") => "projection",
            Some("explain") => "pipeline",
            _ => folder.unwrap_or("pipeline"),
        }
    }
}

/// Finds the tests in a file.
pub fn scan_tests(path: &str, text: &str) -> Vec<Test> {
    let (mut found, mut docs, mut marked) = (Vec::new(), String::new(), false);
    for line in text.lines().map(str::trim) {
        if let Some(doc) = line.strip_prefix("///") {
            docs.push_str(doc);
        } else if line.starts_with("#[") {
            marked |= line == "#[test]";
        } else {
            if let Some(name) = function_name(line).filter(|_| marked) {
                let mut ids = named_ids(name.split('_').map(capitalize_word));
                ids.extend(named_ids(
                    docs.split(|c: char| !c.is_alphanumeric()).map(str::to_owned),
                ));
                found.push(Test { path: path.to_owned(), name: name.to_owned(), ids });
            }
            docs.clear();
            marked = false;
        }
    }
    found
}

fn function_name(line: &str) -> Option<&str> {
    let rest = line.strip_prefix("fn ")?;
    rest.split(|c: char| c != '_' && !c.is_alphanumeric()).next()
}

fn capitalize_word(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map(|first| first.to_ascii_uppercase()).into_iter().chain(letters).collect()
}

/// Finds ids among words: C16, M11b, and numbers that follow `exercise`.
fn named_ids(words: impl Iterator<Item = String>) -> BTreeSet<String> {
    let (mut ids, mut exercise) = (BTreeSet::new(), false);
    for word in words.filter(|word| !word.is_empty()) {
        if is_item_id(&word) {
            ids.insert(word);
        } else if exercise && word.parse::<u8>().is_ok() {
            let id = format!("exercise {word}");
            ids.extend(exercise_item(&id).map(str::to_owned));
            ids.insert(id);
        } else {
            exercise = matches!(word.as_str(), "Exercise" | "Exercises" | "exercise" | "exercises")
                || exercise && matches!(word.as_str(), "and" | "And");
        }
    }
    ids
}

/// Parses an id: a letter, a number and, for a misprint, an optional letter.
pub fn is_item_id(word: &str) -> bool {
    let number = |rest: &str| !rest.is_empty() && rest.bytes().all(|byte| byte.is_ascii_digit());
    let misprint = |rest: &str| number(rest) || number(rest.trim_end_matches(['b', 'c']));
    word.strip_prefix('C').is_some_and(number) || word.strip_prefix('M').is_some_and(misprint)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ids(text: &str) -> Vec<String> {
        scan_tests("crates/clip/tests/integration/a.rs", text)
            .into_iter()
            .flat_map(|test| test.ids)
            .collect()
    }

    #[test]
    fn names_and_doc_comments_name_items() {
        let table = [
            ("#[test]\nfn c16_the_square() {", vec!["C16"]),
            ("    #[test]\n    fn c37_c52_x(a in b()) {", vec!["C37", "C52"]),
            ("#[test]\nfn misprint_m11b_c58_x() {", vec!["C58", "M11b"]),
            ("#[test]\nfn exercise_8_and_9_n_1_f_2() {", vec!["C45", "exercise 8", "exercise 9"]),
            ("/// C31, PL-2, M14c: why.\n#[test]\nfn x() {", vec!["C31", "M14c"]),
            ("/// C31.\nfn x() {\n\n#[test]\nfn y() {", vec![]),
            ("/// Why.\n/// And exercise 3.\n#[test]\nfn y() {", vec!["C40", "exercise 3"]),
            ("#[test]\nfn a_c_of_m_and_c2x() {", vec![]),
        ];
        for (text, expected) in table {
            assert_eq!(ids(text), expected, "{text}");
        }
    }

    #[test]
    fn the_folder_determines_the_owner() {
        let owner = |path: &str| scan_tests(path, "#[test]\nfn x() {")[0].owner().to_owned();
        assert_eq!(owner("crates/clip/src/a.rs"), "clip");
        assert_eq!(owner("tests/program/main.rs"), "pipeline");
    }
}
