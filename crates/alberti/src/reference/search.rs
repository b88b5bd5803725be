//! Search in the reference by name, type or path of fields.

use super::{ReferenceEntry, ReferenceSection};

/// Finds the section with the title `word`, the end of a path of fields with its types, or all
/// entries of that name.
///
/// Titles come first, because they are the most specific: `render` is the command, not every entry
/// of that name. Types are found in any case, commands with or without `alberti`.
///
/// # Errors
/// If nothing has that name; the message suggests the most similar one.
pub(super) fn find_sections(
    sections: &[ReferenceSection],
    word: &str,
) -> Result<Vec<ReferenceSection>, String> {
    let titled: Vec<ReferenceSection> =
        sections.iter().filter(|section| is_titled(section, word)).cloned().collect();
    if !titled.is_empty() {
        return Ok(titled);
    }
    let steps: Vec<&str> = word.split('.').collect();
    let found =
        if steps.len() > 1 { find_by_path(sections, &steps) } else { find_entries(sections, word) };
    if found.is_empty() { Err(unknown_word(sections, word)) } else { Ok(found) }
}

/// Whether a section describes the type or command of this name.
fn is_titled(section: &ReferenceSection, word: &str) -> bool {
    let title = &section.title;
    title.eq_ignore_ascii_case(word)
        || title.strip_prefix("alberti ").is_some_and(|command| command == word)
}

/// The sections reduced to entries of this name.
fn find_entries(sections: &[ReferenceSection], word: &str) -> Vec<ReferenceSection> {
    let with = |section: &ReferenceSection| {
        let entries: Vec<ReferenceEntry> =
            section.entries.iter().filter_map(|entry| prune_entry(entry, word)).collect();
        (!entries.is_empty()).then(|| ReferenceSection {
            entries,
            about: String::new(),
            ..section.clone()
        })
    };
    sections.iter().filter_map(with).collect()
}

/// An entry of this name, or an entry reduced to inner entries of this name.
///
/// An entry that matches itself keeps all of its inner entries; one that only contains a match
/// keeps the matches.
fn prune_entry(entry: &ReferenceEntry, word: &str) -> Option<ReferenceEntry> {
    if is_named(entry, word) {
        return Some(entry.clone());
    }
    let inner: Vec<ReferenceEntry> =
        entry.inner.iter().filter_map(|inner| prune_entry(inner, word)).collect();
    (!inner.is_empty()).then(|| ReferenceEntry { inner, ..entry.clone() })
}

/// Whether an entry has this name; the dashes of a flag may be omitted.
fn is_named(entry: &ReferenceEntry, word: &str) -> bool {
    entry_names(entry).any(|name| name == word || name.trim_start_matches('-') == word)
}

/// The name of a field or variant, or the short and long name of a flag.
fn entry_names(entry: &ReferenceEntry) -> impl Iterator<Item = &str> {
    entry.term.split(", ").map(|name| name.split('(').next().unwrap_or(name))
}

/// The entries at the end of a path such as `camera.view.eye`.
///
/// Variants on the path may be named or left out. The types of the values at the end are appended,
/// so that `camera.view` describes `View` as well.
///
/// Each step looks for its name in the current scopes, beginning with `Scene`; the next scopes are
/// the types of the values that were found and the fields inside of them. A step without a match
/// ends with nothing found.
fn find_by_path(sections: &[ReferenceSection], steps: &[&str]) -> Vec<ReferenceSection> {
    let is_scene = |section: &&ReferenceSection| section.title == "Scene";
    let mut scopes: Vec<ReferenceSection> = sections.iter().filter(is_scene).cloned().collect();
    let mut found = Vec::new();
    for step in steps {
        found = find_entries(&scopes, step);
        scopes = found
            .iter()
            .flat_map(|part| open_entries(sections, part, &part.entries, step))
            .collect();
    }
    // The types of the values at the end of the path.
    let types =
        scopes.into_iter().filter(|scope| found.iter().all(|part| part.title != scope.title));
    found.extend(types.collect::<Vec<_>>());
    found
}

/// The scope below the entries of this name: their own fields, and the types of their values.
///
/// Types are found by their names in the text of the value, so `list of Model` opens `Model`.
fn open_entries(
    sections: &[ReferenceSection],
    part: &ReferenceSection,
    entries: &[ReferenceEntry],
    name: &str,
) -> Vec<ReferenceSection> {
    let open = |entry: &ReferenceEntry| {
        if !is_named(entry, name) {
            return open_entries(sections, part, &entry.inner, name);
        }
        let written = format!("{} {}", entry.value, entry.term);
        let words: Vec<&str> = written.split(|c: char| !c.is_alphanumeric()).collect();
        let types = sections.iter().filter(|section| words.contains(&section.title.as_str()));
        let own = ReferenceSection { entries: entry.inner.clone(), ..part.clone() };
        types.cloned().chain([own]).collect()
    };
    entries.iter().flat_map(open).collect()
}

/// The message for a word that nothing matches, with the most similar name as a hint.
///
/// Similarity is that of Jaro and Winkler, which favors a common beginning; below 0.8 a suggestion
/// would mislead. Of a path only the last step is compared.
fn unknown_word(sections: &[ReferenceSection], word: &str) -> String {
    fn collect_names<'a>(entry: &'a ReferenceEntry, found: &mut Vec<&'a str>) {
        found.extend(entry_names(entry));
        entry.inner.iter().for_each(|inner| collect_names(inner, found));
    }
    let mut names: Vec<&str> = sections.iter().map(|section| section.title.as_str()).collect();
    sections
        .iter()
        .flat_map(|section| &section.entries)
        .for_each(|entry| collect_names(entry, &mut names));
    let last = word.rsplit('.').next().unwrap_or(word);
    let likeness = |name: &&str| strsim::jaro_winkler(last, name);
    let best = names.into_iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    let hint = best.filter(|name| likeness(name) > 0.8);
    let hint = hint.map_or(String::new(), |name| format!("\n  = help: did you mean `{name}`?"));
    format!("the reference has nothing named `{word}`{hint}")
}
