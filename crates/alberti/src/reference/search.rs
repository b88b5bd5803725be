//! The part of the reference that somebody asks for by a word.

use super::{Entry, Section};

/// The sections and entries that `word` names: a section by its title; a path of fields from the scene on, with the types at its
/// end; or entries of that name wherever they are.
///
/// # Errors
/// If there is nothing of that name: what there is that looks like it.
pub(super) fn matching(sections: &[Section], word: &str) -> Result<Vec<Section>, String> {
    let titled: Vec<Section> =
        sections.iter().filter(|section| is_titled(section, word)).cloned().collect();
    if !titled.is_empty() {
        return Ok(titled);
    }
    let steps: Vec<&str> = word.split('.').collect();
    let found = if steps.len() > 1 { by_path(sections, &steps) } else { named(sections, word) };
    if found.is_empty() { Err(unknown(sections, word)) } else { Ok(found) }
}

/// Whether it is the type or the command of this name.
fn is_titled(section: &Section, word: &str) -> bool {
    let title = &section.title;
    title.eq_ignore_ascii_case(word)
        || title.strip_prefix("alberti ").is_some_and(|command| command == word)
}

/// The entries of one name, each under the title of its section.
fn named(sections: &[Section], word: &str) -> Vec<Section> {
    let with = |section: &Section| {
        let entries: Vec<Entry> =
            section.entries.iter().filter_map(|entry| pruned(entry, word)).collect();
        (!entries.is_empty()).then(|| Section { entries, about: String::new(), ..section.clone() })
    };
    sections.iter().filter_map(with).collect()
}

/// An entry of this name, or one with such entries inside, and no others.
fn pruned(entry: &Entry, word: &str) -> Option<Entry> {
    if is_named(entry, word) {
        return Some(entry.clone());
    }
    let inner: Vec<Entry> = entry.inner.iter().filter_map(|inner| pruned(inner, word)).collect();
    (!inner.is_empty()).then(|| Entry { inner, ..entry.clone() })
}

fn is_named(entry: &Entry, word: &str) -> bool {
    names(entry).any(|name| name == word || name.trim_start_matches('-') == word)
}

/// The name of a field or a variant, or the short and the long one of a flag.
fn names(entry: &Entry) -> impl Iterator<Item = &str> {
    entry.term.split(", ").map(|name| name.split('(').next().unwrap_or(name))
}

/// The entries at the end of a path such as `camera.view.eye`; variants may be named on it or not.
fn by_path(sections: &[Section], steps: &[&str]) -> Vec<Section> {
    let is_scene = |section: &&Section| section.title == "Scene";
    let mut scopes: Vec<Section> = sections.iter().filter(is_scene).cloned().collect();
    let mut found = Vec::new();
    for step in steps {
        found = named(&scopes, step);
        scopes =
            found.iter().flat_map(|part| opened(sections, part, &part.entries, step)).collect();
    }
    // What can stand there.
    let types =
        scopes.into_iter().filter(|scope| found.iter().all(|part| part.title != scope.title));
    found.extend(types.collect::<Vec<_>>());
    found
}

/// What the entries of this name lead to: their own fields, and the types of their values.
fn opened(sections: &[Section], part: &Section, entries: &[Entry], name: &str) -> Vec<Section> {
    let open = |entry: &Entry| {
        if !is_named(entry, name) {
            return opened(sections, part, &entry.inner, name);
        }
        let written = format!("{} {}", entry.value, entry.term);
        let words: Vec<&str> = written.split(|c: char| !c.is_alphanumeric()).collect();
        let types = sections.iter().filter(|section| words.contains(&section.title.as_str()));
        let own = Section { entries: entry.inner.clone(), ..part.clone() };
        types.cloned().chain([own]).collect()
    };
    entries.iter().flat_map(open).collect()
}

fn unknown(sections: &[Section], word: &str) -> String {
    fn all<'a>(entry: &'a Entry, found: &mut Vec<&'a str>) {
        found.extend(names(entry));
        entry.inner.iter().for_each(|inner| all(inner, found));
    }
    let mut names: Vec<&str> = sections.iter().map(|section| section.title.as_str()).collect();
    sections.iter().flat_map(|section| &section.entries).for_each(|entry| all(entry, &mut names));
    let last = word.rsplit('.').next().unwrap_or(word);
    let likeness = |name: &&str| strsim::jaro_winkler(last, name);
    let best = names.into_iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    let hint = best.filter(|name| likeness(name) > 0.8);
    let hint = hint.map_or(String::new(), |name| format!("\n  = help: did you mean `{name}`?"));
    format!("the reference has nothing named `{word}`{hint}")
}
