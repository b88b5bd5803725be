//! Counts phrases that a native author would not write. Their number may only fall.
//!
//! Each phrase is correct in some sentences, so none is forbidden. CONTRIBUTING.md explains what to
//! write instead.

use super::Violation;
use crate::program::capture_output;
use crate::workspace::project_root;
use std::process::Command;

/// A group of phrases, with what to write instead.
struct Family {
    /// The phrases, in lowercase.
    phrases: &'static [&'static str],
    /// Words that make a line acceptable although it contains a phrase.
    exceptions: &'static [&'static str],
    /// The maximum number of lines with one of the phrases.
    most: usize,
    /// What to write instead.
    rule: &'static str,
}

const FAMILIES: &[Family] = &[
    Family {
        phrases: &["of its own", "of their own", "of one's own", "of your own"],
        exceptions: &[],
        most: 4,
        rule: "drop `of its own`, or say separate, custom, individual",
    },
    Family {
        phrases: &["is no", "are no"],
        exceptions: &["there is no", "there are no", "is no longer", "are no longer", "is no more"],
        most: 1,
        rule: "write `is not a`, `are not`, or what is wrong",
    },
    Family {
        phrases: &["what is", "what follows", "what comes", "what came", "what else"],
        exceptions: &[],
        most: 33,
        rule: "name the thing: background, result, rest of the file",
    },
    Family {
        phrases: &["whoever", "whatever", "whichever", "wherever"],
        exceptions: &[],
        most: 20,
        rule: "write you, if, any, every, or the imperative",
    },
    Family {
        phrases: &["that of", "those of"],
        exceptions: &[],
        most: 20,
        rule: "repeat the noun, or use a verb",
    },
    Family {
        phrases: &["stands", "stand", "lies", "lie", "in the place of"],
        exceptions: &[],
        most: 26,
        rule: "write is, appears, is listed, instead of, represents",
    },
    Family {
        phrases: &[
            "is told",
            "are told",
            "is said",
            "are said",
            "is due",
            "are due",
            "is named",
            "are named",
        ],
        exceptions: &[],
        most: 7,
        rule: "write reported, specified, required, expected",
    },
    Family {
        phrases: &["alone", "nothing but", "but for"],
        exceptions: &[],
        most: 54,
        rule: "put `only` before the word it limits; write `except for`",
    },
    Family {
        phrases: &["so many", "so much", "as far as", "one a line"],
        exceptions: &[],
        most: 8,
        rule: "write at most, up to, per",
    },
    Family {
        phrases: &[
            "before the eye",
            "before the plane",
            "before the models",
            "besides",
            "goes to",
            "make of",
        ],
        exceptions: &[],
        most: 6,
        rule: "write in front of, after, too, maps to, becomes",
    },
    Family {
        phrases: &["mend", "mended", "mends", "reckon", "upright"],
        exceptions: &[],
        most: 4,
        rule: "write fix, compute, vertical",
    },
];

/// Finds groups whose phrases are on more lines than allowed.
pub fn phrases(files: &[(String, String)]) -> Vec<Violation> {
    let counted = files.iter().filter(|(path, _)| is_counted(path));
    let lines: Vec<String> =
        counted.flat_map(|(_, text)| text.lines().map(str::to_lowercase)).collect();
    let too_many = FAMILIES.iter().filter_map(|family| {
        let count = lines.iter().filter(|line| family.is_in(line)).count();
        (count > family.most).then(|| family.violation(count))
    });
    too_many.collect()
}

/// Returns whether a file contains English text of this project.
fn is_counted(path: &str) -> bool {
    let is_text = [".rs", ".md", ".py", ".pyi", ".tsv"].iter().any(|ending| path.ends_with(ending));
    // The topics repeat the book.
    let is_generated = path.starts_with("docs/api/") || path == "docs/topics.md";
    is_text && !is_generated && !path.starts_with("xtask/src/tidy/")
}

impl Family {
    /// Returns whether a lowercase line contains one of the phrases.
    fn is_in(&self, line: &str) -> bool {
        let is_right = self.exceptions.iter().any(|exception| line.contains(exception));
        !is_right && self.phrases.iter().any(|phrase| has_phrase(line, phrase))
    }

    fn violation(&self, count: usize) -> Violation {
        let message =
            format!("{count} lines, but at most {} are allowed: {}", self.most, self.rule);
        let added = added_lines().into_iter().filter(|line| self.is_in(&line.to_lowercase()));
        let shown: Vec<String> =
            added.take(5).map(|line| format!("\n    {}", line.trim())).collect();
        Violation::new(self.phrases.join(", "), message + &shown.concat())
    }
}

/// Returns whether a line contains a phrase as whole words.
fn has_phrase(line: &str, phrase: &str) -> bool {
    line.match_indices(phrase).any(|(at, _)| {
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let before = line[..at].chars().next_back();
        let after = line[at + phrase.len()..].chars().next();
        !before.is_some_and(is_word) && !after.is_some_and(is_word)
    })
}

/// Returns the lines that were added since the last commit or, if there are none, by the last
/// commit.
fn added_lines() -> Vec<String> {
    let diff = |range: &[&str]| {
        let mut git = Command::new("git");
        git.current_dir(project_root()).args(["diff", "--unified=0"]).args(range);
        let text = capture_output(&mut git).unwrap_or_default();
        let added = text.lines().filter_map(|line| line.strip_prefix('+'));
        added.filter(|line| !line.starts_with("++")).map(str::to_owned).collect::<Vec<_>>()
    };
    let uncommitted = diff(&["HEAD"]);
    if uncommitted.is_empty() { diff(&["HEAD~1", "HEAD"]) } else { uncommitted }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phrases_are_whole_words_and_exceptions_are_allowed() {
        let family = |phrase: &str| FAMILIES.iter().find(|f| f.phrases.contains(&phrase));
        let own = family("is no").expect("a group");
        assert!(own.is_in("the matrix is no rotation"));
        assert!(!own.is_in("there is no such file") && !own.is_in("it is normal"));
        assert!(!family("stands").expect("a group").is_in("bystands"));
    }
}
