//! Searches the reference by name, type or field path.

use super::{ReferenceEntry, ReferenceSection};
use scene_file::closest_name;

/// Finds the section titled `word`, or else the entries at the end of the field path `word` with
/// their types, or else all entries named `word`.
///
/// Titles come first, because they are the most specific: `render` is the command, not every entry
/// with that name. Types match in any case, and commands match with or without `alberti`. A path
/// may come from an error message, with indices as in `models[0].materials[0].of`, and may begin
/// with a type.
///
/// # Errors
/// Returns an error if nothing has that name; the message suggests the most similar name.
pub(super) fn find_sections(
    sections: &[ReferenceSection],
    word: &str,
) -> Result<Vec<ReferenceSection>, String> {
    let titled: Vec<ReferenceSection> =
        sections.iter().filter(|section| is_titled(section, word)).cloned().collect();
    if !titled.is_empty() {
        return Ok(titled);
    }
    let steps: Vec<&str> = word.split('.').map(without_index).collect();
    let found = match steps.as_slice() {
        [name] => find_entries(sections, name),
        steps => find_by_path(sections, steps),
    };
    let found = if found.is_empty() { find_related(sections, word) } else { found };
    if found.is_empty() { Err(unknown_word(sections, word)) } else { Ok(found) }
}

/// Finds entries related to a word that names none: names that contain it in any case, such as
/// `Depth` and `depth_cue_percent` for `depth`, and fields that other programs call by this word,
/// such as `camera_path` for `turntable`. If there are none, finds all entries that mention the
/// word.
fn find_related(sections: &[ReferenceSection], word: &str) -> Vec<ReferenceSection> {
    let word = word.to_lowercase();
    let mut found = filter_entries(sections, &|entry| has_in_name(entry, &word));
    for path in scene_file::reference::meanings_of(&word) {
        let steps: Vec<&str> = path.split('.').collect();
        for section in find_by_path(sections, &steps) {
            if !found.contains(&section) {
                found.push(section);
            }
        }
    }
    // Words of up to three letters occur in too many sentences.
    if found.is_empty() && word.len() > 3 {
        found = filter_entries(sections, &|entry| mentions(&entry.about, &word));
    }
    found
}

/// Whether a lowercase word is an entry's name or part of it, ignoring case.
fn has_in_name(entry: &ReferenceEntry, word: &str) -> bool {
    entry_names(entry).any(|name| {
        let name = name.trim_start_matches('-').to_lowercase();
        name == word || name.split(['_', '-']).any(|part| part == word)
    })
}

/// Whether sections were found only by the words in their descriptions.
pub(super) fn is_only_mentioned(found: &[ReferenceSection], word: &str) -> bool {
    let lower = word.to_lowercase();
    let mentioned = |entry: &ReferenceEntry| mentions(&entry.about, &lower);
    !found.iter().any(|section| is_titled(section, word))
        && filter_entries(found, &|entry| has_in_name(entry, &lower)).is_empty()
        && !filter_entries(found, &mentioned).is_empty()
}

/// Whether text contains a word or its plural.
fn mentions(text: &str, word: &str) -> bool {
    let is_word = |part: &str| {
        let part = part.to_lowercase();
        part == word || part.strip_suffix('s') == Some(word)
    };
    text.split(|c: char| !c.is_alphanumeric()).any(is_word)
}

/// Returns a path step without its index: `models` for `models[0]`.
fn without_index(step: &str) -> &str {
    match step.split_once('[') {
        Some((name, index)) if !name.is_empty() && index.ends_with(']') => name,
        _ => step,
    }
}

/// Whether a section describes the type or command with this name.
fn is_titled(section: &ReferenceSection, word: &str) -> bool {
    let title = &section.title;
    title.eq_ignore_ascii_case(word)
        || title.strip_prefix("alberti ").is_some_and(|command| command == word)
}

/// Reduces the sections to entries with this name.
fn find_entries(sections: &[ReferenceSection], word: &str) -> Vec<ReferenceSection> {
    filter_entries(sections, &|entry| is_named(entry, word))
}

/// Reduces the sections to the wanted entries.
fn filter_entries(
    sections: &[ReferenceSection],
    is_wanted: &dyn Fn(&ReferenceEntry) -> bool,
) -> Vec<ReferenceSection> {
    let with = |section: &ReferenceSection| {
        let entries: Vec<ReferenceEntry> =
            section.entries.iter().filter_map(|entry| prune_entry(entry, is_wanted)).collect();
        (!entries.is_empty()).then(|| ReferenceSection {
            entries,
            about: String::new(),
            ..section.clone()
        })
    };
    sections.iter().filter_map(with).collect()
}

/// Returns a wanted entry, or an entry reduced to its wanted inner entries.
///
/// An entry that itself matches keeps all its inner entries; an entry that only contains matches
/// keeps only those.
fn prune_entry(
    entry: &ReferenceEntry,
    is_wanted: &dyn Fn(&ReferenceEntry) -> bool,
) -> Option<ReferenceEntry> {
    if is_wanted(entry) {
        return Some(entry.clone());
    }
    let inner: Vec<ReferenceEntry> =
        entry.inner.iter().filter_map(|inner| prune_entry(inner, is_wanted)).collect();
    (!inner.is_empty()).then(|| ReferenceEntry { inner, ..entry.clone() })
}

/// Whether an entry has this name; the dashes of a flag may be omitted.
fn is_named(entry: &ReferenceEntry, word: &str) -> bool {
    entry_names(entry).any(|name| name == word || name.trim_start_matches('-') == word)
}

/// Returns the name of a field or variant, or the short and long name of a flag.
fn entry_names(entry: &ReferenceEntry) -> impl Iterator<Item = &str> {
    entry.term.split(", ").map(|name| name.split('(').next().unwrap_or(name))
}

/// Returns the entries at the end of a path such as `camera.view.eye`.
///
/// Variants on the path may be named or omitted. The types of the values at the end are appended,
/// so that `camera.view` also describes `View`.
///
/// Each step looks up its name in the current scopes, beginning with `Scene`; the next scopes are
/// the types of the values found and their inner fields. If a step has no match, nothing is found.
fn find_by_path(sections: &[ReferenceSection], steps: &[&str]) -> Vec<ReferenceSection> {
    let titled = |title: &str| -> Vec<ReferenceSection> {
        sections.iter().filter(|section| section.title == title).cloned().collect()
    };
    let found = follow_path(sections, titled("Scene"), steps);
    if !found.is_empty() {
        return found;
    }
    // A path may begin with a type, or with a field or variant of any type.
    match (steps, titled(steps[0])) {
        ([_, rest @ ..], start) if !start.is_empty() => follow_path(sections, start, rest),
        _ => follow_path(sections, sections.to_vec(), steps),
    }
}

/// Returns the entries at the end of a path that starts in one of the scopes.
fn follow_path(
    sections: &[ReferenceSection],
    mut scopes: Vec<ReferenceSection>,
    steps: &[&str],
) -> Vec<ReferenceSection> {
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

/// Returns the scope below the entries with this name: their fields, and their values' types.
///
/// Types are found by name in the value's text, so `list of Model` leads to `Model`.
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

/// Returns the message for a word without a match, with a similar name or a place to look.
///
/// Only the last step of a path is compared.
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
    let begins_alike = |name: &&str| {
        let [word, name] =
            [last, *name].map(|it| it.chars().next().map(|c| c.to_ascii_lowercase()));
        word == name
    };
    let hint = closest_name(last, &names).filter(begins_alike).map_or_else(
        || "`alberti scene doc` lists the scene fields, `alberti --help` the commands".to_owned(),
        |name| format!("did you mean `{name}`?"),
    );
    format!("the reference has no entry named `{word}`\n  = help: {hint}")
}

#[cfg(test)]
mod tests {
    use super::super::fields::type_sections;
    use super::*;

    /// Paths can be looked up exactly as messages print them.
    #[test]
    fn paths_from_messages_are_found() {
        let sections = type_sections();
        for path in [
            "models[0].materials[0].of",
            "models[0].path",
            "camera.view.LookAt.eye[1]",
            "camera.projection.Perspective.fov_y_degrees",
            "camera.view.eye",
            "lights[0].Ambient.intensity",
            "image.size[0]",
            "LookAt.eye",
            "View.LookAt",
            "Model.path",
            "Projection.Perspective.near",
        ] {
            let found = find_sections(&sections, path);
            let last = without_index(path.rsplit('.').next().unwrap_or(path));
            let has_entry = |entry: &ReferenceEntry| {
                prune_entry(entry, &|entry| is_named(entry, last)).is_some()
            };
            let is_found = found
                .as_ref()
                .is_ok_and(|found| found.iter().any(|part| part.entries.iter().any(has_entry)));
            assert!(is_found, "{path}: {found:?}");
        }
        assert!(find_sections(&sections, "models[0].nothing").is_err());
        assert!(find_sections(&sections, "Nothing.path").is_err());
    }

    /// Words from other programs, and words that occur only in descriptions, lead to entries.
    #[test]
    fn words_that_are_not_names_lead_to_matching_entries() {
        let sections = type_sections();
        for (word, expected) in [
            ("turntable", "camera_path"),
            ("forest", "instances"),
            ("scatter", "instances"),
            ("depth", "depth_cue_percent"),
            ("depth", "Depth"),
            ("fov", "fov_y_degrees"),
            ("msaa", "samples"),
            ("shadow catcher", "Shadow"),
            ("cutaway", "sections"),
            ("glasses", "Anaglyph"),
        ] {
            let found = find_sections(&sections, word);
            let is_meant = |entry: &ReferenceEntry| is_named(entry, expected);
            let is_found =
                found.as_ref().is_ok_and(|found| !filter_entries(found, &is_meant).is_empty());
            assert!(is_found, "{word}: {found:?}");
        }
        assert!(find_sections(&sections, "qwertz").is_err());
    }

    /// Every field of every type is found by a path that begins with the type.
    #[test]
    fn every_field_is_found_by_its_type() {
        let sections = type_sections();
        for section in &sections {
            for entry in &section.entries {
                for name in entry_names(entry) {
                    let path = format!("{}.{name}", section.title);
                    assert!(find_sections(&sections, &path).is_ok(), "{path}");
                }
            }
        }
    }
}
