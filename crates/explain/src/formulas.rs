//! The formulas of the viewing pipeline by id, parsed from `docs/formulas.md`, which is embedded in
//! the program.
//!
//! ```text
//!  **OB-1, oblique projection by length and angle** [A]. `x' = x + z L1 cos φ`, …     an entry
//!  Command: `alberti explain …`                                      what demonstrates it
//!  | D3D-1 | left-handed, by angle | F/(F−N) | …                     a row of a table
//! ```

mod html;

use std::fmt;

/// The file from which the entries are parsed.
const PAGE: &str = include_str!("../formulas.md");

/// The file with the topics, the misprints, and the pages of the book for every id.
const TOPICS: &str = include_str!("../topics.md");

/// An entry of the formulas.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Formula {
    /// The ids and name, such as `OB-1, oblique projection by length and angle`.
    pub name: &'static str,
    /// The abbreviations of the sources, such as `S, N`.
    marks: &'static str,
    /// The formula and its meaning, as Markdown.
    pub text: &'static str,
    /// The command that demonstrates the formula; `None` if no command does so separately.
    pub command: Option<&'static str>,
}

/// Finds the formula with this id, such as `PE-1`, or the topic or misprint, such as `C61` or
/// `M14`, in any case.
#[must_use]
pub fn find_formula(id: &str) -> Option<Formula> {
    entries().find(|entry| entry.has_id(id)).or_else(|| table_row(id)).or_else(|| topic(id))
}

/// Returns the text below the name of a topic, misprint or formula, and the name.
fn topic_entry(id: &str) -> Option<(&'static str, &'static str)> {
    TOPICS.split("\n**").skip(1).find_map(|part| {
        let (name, rest) = part.split_once("**\n")?;
        let named = name.split(',').next()?;
        named.eq_ignore_ascii_case(id).then(|| (name, rest.split("\n#").next().unwrap_or(rest)))
    })
}

/// Returns the line of links to the pages of the book that cover an id.
fn pages(id: &str) -> Option<&'static str> {
    let (_, rest) = topic_entry(id)?;
    rest.lines().find_map(|line| line.strip_prefix("Book: "))
}

/// Returns a topic or a misprint of the sources.
fn topic(id: &str) -> Option<Formula> {
    let (name, rest) = topic_entry(id)?;
    let (body, _) = rest.split_once("Book: ")?;
    let (text, command) = split_command(body);
    name.contains(',').then_some(Formula { name, marks: "", text, command })
}

/// Returns all entries, in file order; table rows belong to the entry of their table.
pub fn entries() -> impl Iterator<Item = Formula> {
    PAGE.split("\n**").skip(1).filter_map(|part| {
        let (name, rest) = part.split_once("** [")?;
        let (marks, rest) = rest.split_once(']')?;
        let text = rest.split("\n#").next().unwrap_or(rest);
        let (text, command) = split_command(text);
        let text = text.trim_start_matches('.').trim();
        Some(Formula { name, marks, text, command })
    })
}

/// Finds formulas that contain these words: first in the name (true), then in the text (false).
///
/// Words are compared by stem, in any case: `homogenize` finds `homogeneous`.
#[must_use]
pub fn find_formulas(words: &str) -> Vec<(Formula, bool)> {
    let wanted: Vec<String> = stems(words).collect();
    let has = |text: &str| {
        let found: Vec<String> = stems(text).collect();
        !wanted.is_empty() && wanted.iter().all(|stem| found.contains(stem))
    };
    let (named, others): (Vec<Formula>, Vec<Formula>) =
        entries().partition(|entry| has(entry.name));
    let told = others.into_iter().filter(|entry| has(entry.text)).map(|entry| (entry, false));
    named.into_iter().map(|entry| (entry, true)).chain(told).collect()
}

/// Returns the stems of all words with at least three letters.
fn stems(text: &str) -> impl Iterator<Item = String> {
    let words = text.split(|c: char| !c.is_alphabetic()).filter(|word| word.len() >= 3);
    words.map(|word| stem(&word.to_lowercase()))
}

/// Removes the ending of a lowercase word, so that different forms of the word are equal.
fn stem(word: &str) -> String {
    const ENDINGS: [&str; 28] = [
        "izations", "ization", "ations", "eously", "ation", "ating", "izing", "eous", "ates",
        "ated", "ized", "izes", "ings", "ions", "ible", "ing", "ion", "ize", "ate", "ive", "ed",
        "es", "is", "ly", "al", "s", "e", "y",
    ];
    let mut cut = ENDINGS.iter().filter_map(|ending| word.strip_suffix(ending));
    let stem = cut.find(|stem| stem.len() >= 3).unwrap_or(word);
    // `clipping` has the stem `clip`.
    let doubled = stem.len() > 3
        && stem != word
        && stem.is_ascii()
        && stem.as_bytes()[stem.len() - 1] == stem.as_bytes()[stem.len() - 2]
        && !stem.ends_with(['l', 's']);
    stem[..stem.len() - usize::from(doubled)].to_owned()
}

impl Formula {
    /// Whether the entry has this id, in any case.
    fn has_id(&self, id: &str) -> bool {
        let is_word = |c: char| c.is_alphanumeric() || c == '-';
        let words = self.name.split(|c: char| !is_word(c));
        is_id(id) && words.into_iter().any(|word| word.eq_ignore_ascii_case(id))
    }

    /// Returns the titles of the formula's sources.
    pub fn sources(&self) -> impl Iterator<Item = &'static str> {
        self.marks.split(", ").filter_map(|mark| {
            let row = format!("| [{mark}] | ");
            let at = PAGE.find(&row)? + row.len();
            PAGE[at..].split(" |").next()
        })
    }

    /// Returns the titles and file names of book pages that cover the formula.
    pub fn book_pages(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        let ids = self.name.split(|c: char| !c.is_alphanumeric() && c != '-');
        let links = ids.filter_map(pages).next().unwrap_or_default().split(", [");
        links.filter_map(|link| {
            let (title, path) = link.trim_start_matches('[').split_once("](")?;
            Some((title, path.trim_end_matches(')').rsplit('/').next()?))
        })
    }

    /// Returns the first three equations of the text: code that contains `=` or `→`.
    pub fn equations(&self) -> impl Iterator<Item = &'static str> {
        let code = self.text.split("```").next().unwrap_or_default().split('`').skip(1).step_by(2);
        code.filter(|code| code.contains(" = ") || code.contains(" → ")).take(3)
    }
}

impl fmt::Display for Formula {
    /// Writes Markdown: the name, the text, the sources and the command.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}\n", self.name)?;
        if !self.text.is_empty() {
            writeln!(f, "{}\n", self.text)?;
        }
        for source in self.sources() {
            writeln!(f, "Source: {source}")?;
        }
        match self.command {
            Some(command) => writeln!(f, "Command: {command}")?,
            None if self.marks.is_empty() => {}
            None => writeln!(f, "Command: none demonstrates it separately")?,
        }
        let pages: Vec<String> =
            self.book_pages().map(|(title, file)| format!("{title} ({file})")).collect();
        match &pages[..] {
            [] => Ok(()),
            _ => writeln!(f, "Book: {}", pages.join(", ")),
        }
    }
}

/// Whether a word has the form of an id: letters and digits, a hyphen, a number.
fn is_id(word: &str) -> bool {
    word.rsplit_once('-').is_some_and(|(letters, number)| {
        letters.starts_with(|c: char| c.is_ascii_alphabetic())
            && !number.is_empty()
            && number.bytes().all(|c| c.is_ascii_digit())
    })
}

/// Finds the formula in a table row, and combines each cell with its column name.
fn table_row(id: &str) -> Option<Formula> {
    if !is_id(id) {
        return None;
    }
    let row = PAGE.lines().find(|line| {
        let first = line.strip_prefix("| ").and_then(|rest| rest.split(" |").next());
        first.is_some_and(|cell| cell.eq_ignore_ascii_case(id))
    })?;
    let at = PAGE.find(row)?;
    let section = PAGE[..at].rfind("\n### ")?;
    let (text, command) = split_command(PAGE[section..].split("\n**").next()?);
    let (_, text) = text.trim().split_once('\n')?;
    let name = row.trim_matches(['|', ' ']);
    Some(Formula { name, marks: "std", text: text.trim(), command })
}

/// Splits an entry into its body and its command.
fn split_command(text: &'static str) -> (&'static str, Option<&'static str>) {
    match text.split_once("\nCommand: `") {
        Some((text, rest)) => (text.trim(), rest.split("`\n").next().map(str::trim)),
        None => (text.trim(), None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_and_table_rows_have_a_formula_source_and_command() {
        let oblique = find_formula("ob-1").expect("an entry");
        assert_eq!(oblique.name, "OB-1, oblique projection by length and angle");
        assert_eq!(oblique.equations().next(), Some("x' = x + z L1 cos φ"));
        assert!(oblique.sources().all(|source| source.starts_with("Lecture slides")));
        assert!(oblique.command.is_some_and(|command| command.starts_with("alberti ")));
        let windowing = find_formula("WI-3").expect("an entry with two ids");
        assert_eq!(find_formula("WI-2"), Some(windowing));
        let row = find_formula("D3D-3").expect("a row");
        assert!(row.name.starts_with("D3D-3 | left-handed, by window"), "{}", row.name);
        assert!(row.text.contains("0 0 A B") && row.command.is_some());
        let pages = find_formula("D3D-1").expect("a row").book_pages().next();
        assert_eq!(pages, Some(("Matrices of the graphics APIs", "conventions.md")));
        assert_eq!(find_formula("UNKNOWN-1"), None);
        assert_eq!(find_formula("and"), None);
    }

    /// The codes of the book's margins and of its boxes.
    #[test]
    fn topics_and_misprints_lead_to_the_book() {
        let misprint = find_formula("m14").expect("a misprint");
        assert_eq!(misprint.name, "M14, A 1 at the end of a perspective's bottom row");
        assert!(misprint.text.starts_with("Three matrices have the bottom row"));
        assert!(misprint.command.is_some_and(|command| command.starts_with("alberti explain ")));
        assert!(misprint.book_pages().any(|page| page == ("Errata", "printed-wrong.md")));
        for id in ["C61", "C1", "M11b", "M28"] {
            let topic = find_formula(id).expect("a topic");
            assert!(topic.book_pages().next().is_some(), "{id}");
            assert!(topic.to_string().contains("\nBook: "), "{topic}");
        }
        assert_eq!(find_formula("C999"), None);
    }

    #[test]
    fn words_are_found_by_their_stems() {
        for (word, id, in_name) in [
            ("windowing", "WI-2", true),
            ("Windows", "OR-1", false),
            ("homogenize", "HO-1", false),
            ("basis", "CA-1", true),
            ("INVERSE", "IV-1", true),
            ("inverses", "CA-2", false),
            ("order", "PE-1", false),
            ("clip", "CL-1", false),
            ("vanishing points", "VN-1", true),
        ] {
            let formula = find_formula(id).expect("an entry");
            let found = find_formulas(word);
            assert!(found.contains(&(formula, in_name)), "{word}: {found:?}");
        }
        assert!(find_formulas("zebra").is_empty() && find_formulas("PE-1").is_empty());
    }

    #[test]
    fn entry_text_ends_before_the_next_entry() {
        for entry in entries() {
            assert!(!entry.text.contains("\n**") && !entry.text.contains("Command:"), "{entry}");
            assert!(!entry.text.is_empty() && entry.sources().next().is_some(), "{entry}");
        }
    }
}
