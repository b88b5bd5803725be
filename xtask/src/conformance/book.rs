//! Topic marks in the pages of the book: code spans such as `C14` and `M11b` in
//! `book/src/*.md`.

use super::scan::is_item_id;
use crate::Outcome;
use crate::workspace::read_text;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The errata page, which marks every misprint.
pub const MISPRINT_PAGE: &str = "printed-wrong";
/// The topic index, which is generated from the marks and is not counted as a page.
const GENERATED_PAGE: &str = "topics";

/// The pages of the book that mark each topic.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct BookMarks {
    pages: BTreeMap<String, BTreeSet<String>>,
}

impl BookMarks {
    /// Reads the marks of all pages in a folder; returns `None` if the folder does not exist.
    pub fn read(folder: &Path) -> Result<Option<Self>, String> {
        if !folder.is_dir() {
            return Ok(None);
        }
        let entries = fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        let mut marks = Self::default();
        for entry in entries {
            let path = entry.map_err(|error| error.to_string())?.path();
            let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let is_page = path.extension().is_some_and(|ending| ending == "md");
            if is_page && stem != GENERATED_PAGE {
                marks.add_page(&stem, &read_text(&path)?);
            }
        }
        Ok(Some(marks))
    }

    fn add_page(&mut self, page: &str, text: &str) {
        for id in marked_ids(text) {
            self.pages.entry(id).or_default().insert(page.to_owned());
        }
    }

    /// Returns the pages that mark a topic, sorted.
    pub fn pages_of(&self, id: &str) -> impl Iterator<Item = &str> {
        self.pages.get(id).into_iter().flatten().map(String::as_str)
    }

    /// Finds missing and unknown marks, given all topics.
    pub fn faults(&self, topics: &BTreeSet<String>) -> Vec<String> {
        let unmarked = topics.iter().filter(|id| !self.pages.contains_key(*id));
        let unmarked = unmarked.map(|id| format!("no page of the book marks {id}"));
        let strange = self.pages.iter().filter(|(id, _)| !topics.contains(*id));
        let strange = strange.map(|(id, pages)| {
            let pages: Vec<&str> = pages.iter().map(String::as_str).collect();
            format!("book/src: {id} is not a topic, marked in {}", pages.join(", "))
        });
        let misprints = topics.iter().filter(|id| id.starts_with('M'));
        let unlisted = misprints.filter(|id| self.pages_of(id).all(|page| page != MISPRINT_PAGE));
        let unlisted = unlisted.map(|id| format!("book/src/{MISPRINT_PAGE}.md does not mark {id}"));
        unmarked.chain(strange).chain(unlisted).collect()
    }
}

/// Returns the topics in an inventory: the ids in the first columns of its tables.
pub fn inventory_topics(text: &str) -> BTreeSet<String> {
    let cells = text.lines().filter_map(|line| line.strip_prefix("| ")?.split(" |").next());
    cells.filter(|cell| is_item_id(cell)).map(str::to_owned).collect()
}

/// Fails if two lists of topics differ.
pub fn compare_topics(name: &str, found: &BTreeSet<String>, known: &BTreeSet<String>) -> Outcome {
    let list =
        |ids: Vec<&String>| ids.into_iter().map(String::as_str).collect::<Vec<_>>().join(", ");
    let missing = list(known.difference(found).collect());
    let strange = list(found.difference(known).collect());
    if missing.is_empty() && strange.is_empty() {
        return Ok(());
    }
    Err(format!("{name} lacks [{missing}] and also has [{strange}]"))
}

/// Returns the ids in code spans outside fenced blocks.
fn marked_ids(text: &str) -> BTreeSet<String> {
    let mut in_fence = false;
    let mut ids = BTreeSet::new();
    for line in text.lines() {
        if line.trim_start().trim_start_matches('>').trim_start().starts_with("```") {
            in_fence = !in_fence;
        } else if !in_fence {
            let spans = line.split('`').skip(1).step_by(2);
            ids.extend(spans.filter(|span| is_item_id(span)).map(str::to_owned));
        }
    }
    ids
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(ids: &[&str]) -> BTreeSet<String> {
        ids.iter().map(|id| (*id).to_owned()).collect()
    }

    #[test]
    fn marks_are_code_spans_outside_blocks() {
        let text =
            "`C14` Text, `M11b` and `C2`, `$C3$`, C4, `C5 x`.\n```rust\n`C6`\n```\n> `M28`\n";
        assert_eq!(marked_ids(text), set(&["C14", "C2", "M11b", "M28"]));
    }

    #[test]
    fn missing_and_unknown_marks_are_reported() {
        let mut marks = BookMarks::default();
        marks.add_page("points", "`C1` `M1` `C9`");
        marks.add_page("printed-wrong", "`M1`");
        assert!(marks.pages_of("M1").eq(["points", "printed-wrong"]));
        let faults = marks.faults(&set(&["C1", "C2", "M1"]));
        assert_eq!(
            faults,
            ["no page of the book marks C2", "book/src: C9 is not a topic, marked in points"]
        );
        marks.add_page("camera", "`C2` `M2`");
        let faults = marks.faults(&set(&["C1", "C2", "C9", "M1", "M2"]));
        assert_eq!(faults, ["book/src/printed-wrong.md does not mark M2"]);
    }

    #[test]
    fn topic_lists_are_compared() {
        let found =
            inventory_topics("| id | where |\n|---|---|\n| C1 | x |\n| M11b | y |\n| MV | z |\n");
        assert_eq!(found, set(&["C1", "M11b"]));
        assert_eq!(compare_topics("it", &found, &set(&["C1", "M11b"])), Ok(()));
        let error = compare_topics("it", &found, &set(&["C1", "C2"]));
        assert_eq!(error, Err("it lacks [C2] and also has [M11b]".to_owned()));
    }
}
