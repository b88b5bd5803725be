//! Words that people bring from other programs and from older scene files, with the scene file
//! words to use instead.
//!
//! A word is looked up together with its struct or enum. If that declares the intended field or
//! variant, its name is suggested; if another part of the scene does, the suggestion shows where.

mod advice;
mod foreign;

use super::SceneFile;
use super::file::{FromFile, ViewportFile};
use super::schema::{Declared, Shape, TypeEntry, example_of, fields_where, variants_where};
use super::suggest::{closest_name, list_names};
use advice::find_advice;
use foreign::FOREIGN_WORDS;

/// A suggestion for a name that is not declared.
pub(super) struct Suggestion {
    /// The help: a name, an example, or the allowed names.
    pub(super) help: String,
    /// The intended field of the same struct, if there is one.
    pub(super) sibling: Option<&'static str>,
    kind: SuggestionKind,
}

/// The way a suggestion was found.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum SuggestionKind {
    /// The word is in a table, or names a field or variant elsewhere.
    Known,
    /// The word resembles one of the allowed names.
    Similar,
    /// The suggestion lists the allowed names.
    List,
}

impl Suggestion {
    /// Whether the word is in a table, or names a field or variant elsewhere.
    pub(super) fn is_known(&self) -> bool {
        self.kind == SuggestionKind::Known
    }
}

/// A field or variant: the struct, variant (`View::LookAt`) or enum that has it, and its name.
type Target = (&'static str, &'static str);

/// Suggests a field name for an undeclared one. `owner` is the struct or variant around it,
/// `siblings` are its fields, and `top_level` is the scene field around it.
pub(super) fn suggest_field(
    owner: &str,
    siblings: &[&'static str],
    word: &str,
    top_level: Option<&str>,
) -> Suggestion {
    if let Some(help) = find_advice(owner, &normalize(word)) {
        return Suggestion { help: help.to_owned(), sibling: None, kind: SuggestionKind::Known };
    }
    let targets = targets_of(word);
    let own = targets.iter().find(|(target, _)| *target == owner);
    if let Some(&(_, name)) = own.filter(|(_, name)| siblings.contains(name)) {
        let mut help = format!("did you mean `{name}`?");
        // The word can also mean something other than a field of the scene itself.
        let declared =
            if owner == SceneFile::ENTRY.name { declared_elsewhere(word) } else { vec![] };
        if let Some(example) = declared.first() {
            help = format!("{help} or write it as {example}");
        }
        return Suggestion { help, sibling: Some(name), kind: SuggestionKind::Known };
    }
    let same_spelling = siblings.iter().copied().find(|name| normalize(name) == normalize(word));
    let similar = same_spelling.or_else(|| closest_name(word, siblings));
    let is_very_similar = similar.is_some_and(|name| strsim::jaro_winkler(word, name) > 0.9);
    if !is_very_similar && same_spelling.is_none() {
        // A field with exactly this name takes precedence over the word's meaning in other
        // programs, unless that meaning is nearer or is itself such a field.
        let is_field = |name: &str| name.starts_with(char::is_lowercase);
        let same_name =
            targets.iter().filter(|(_, name)| is_field(name) && normalize(name) == normalize(word));
        let same_name: Vec<Target> = same_name.copied().collect();
        let meant = example_elsewhere(&same_name, top_level)
            .or_else(|| example_elsewhere(&targets, top_level));
        let is_near = !same_name.is_empty()
            || meant.as_ref().is_some_and(|example| is_in_field(example, top_level));
        let declared = || nearest_example(&declared_elsewhere(word), top_level);
        let elsewhere = if is_near { meant } else { declared().or(meant) };
        if let Some(example) = elsewhere {
            let help = format!("write it as {example}");
            return Suggestion { help, sibling: None, kind: SuggestionKind::Known };
        }
    }
    match similar {
        Some(name) => {
            let help = format!("did you mean `{name}`?");
            Suggestion { help, sibling: Some(name), kind: SuggestionKind::Similar }
        }
        None => {
            Suggestion { help: list_names(siblings), sibling: None, kind: SuggestionKind::List }
        }
    }
}

/// Suggests a correction for an undeclared variant name, or for the name of a wrong struct.
pub(super) fn suggest_variant(
    entry: &'static TypeEntry,
    word: &str,
    top_level: Option<&str>,
) -> Suggestion {
    let names: Vec<&'static str> = match entry.shape {
        Shape::Variants(variants) => variants.iter().map(|variant| variant.name).collect(),
        _ => Vec::new(),
    };
    let known = |help: String| Suggestion { help, sibling: None, kind: SuggestionKind::Known };
    if let Some(help) = suggest_viewport(entry, word) {
        return known(help);
    }
    if let Some(help) = find_advice(entry.name, &normalize(word)) {
        return known(help.to_owned());
    }
    let targets = targets_of(word);
    let own = targets.iter().find(|(target, name)| *target == entry.name && names.contains(name));
    if let Some((_, name)) = own {
        return known(format!("did you mean `{name}`?"));
    }
    if super::color::Color::parse(word).is_some() && names.contains(&"Color") {
        return known(format!("did you mean `Color(\"{}\")`?", word.to_lowercase()));
    }
    let same_spelling = names.iter().copied().find(|name| normalize(name) == normalize(word));
    let similar = same_spelling.or_else(|| closest_name(word, &names));
    let is_very_similar = similar.is_some_and(|name| strsim::jaro_winkler(word, name) > 0.9);
    let elsewhere = example_elsewhere(&targets, top_level)
        .filter(|_| !is_very_similar && same_spelling.is_none());
    match (elsewhere, similar) {
        (Some(example), _) => known(format!("write it as {example}")),
        (None, Some(name)) => {
            let help = format!("did you mean `{name}`?");
            Suggestion { help, sibling: None, kind: SuggestionKind::Similar }
        }
        _ => match variant_inside(entry, word)
            .or_else(|| nearest_example(&variants_elsewhere(word), top_level))
        {
            Some(example) => known(format!("write it as {example}")),
            None => {
                Suggestion { help: list_names(&names), sibling: None, kind: SuggestionKind::List }
            }
        },
    }
}

/// Suggests a whole viewport if only a named view was written.
fn suggest_viewport(entry: &TypeEntry, word: &str) -> Option<String> {
    let Shape::Variants(views) = FromFile::ENTRY.shape else { return None };
    let is_view = views.iter().any(|view| view.name == word && view.value_type.is_none());
    (is_view && entry.name == ViewportFile::ENTRY.name).then(|| {
        format!("write (at: (0.5, 0, 0.5, 0.5), camera: (view: Frame(from: {word}))), with left, top, width and height as fractions of the picture")
    })
}

/// Returns the fields and variants that a word from another program means, as paths such as
/// `Perspective.near`.
pub(super) fn meanings_of(word: &str) -> Vec<String> {
    let path =
        |(owner, name): Target| format!("{}.{name}", owner.rsplit("::").next().unwrap_or(owner));
    targets_of(word).into_iter().map(path).collect()
}

/// Returns the meanings of a word in the table, in table order.
fn targets_of(word: &str) -> Vec<Target> {
    let word = normalize(word);
    let meanings =
        FOREIGN_WORDS.iter().filter(|(words, ..)| words.split(' ').any(|known| known == word));
    meanings.map(|&(_, owner, name)| (owner, name)).collect()
}

/// Converts a word to lowercase and removes underscores and hyphens, so that `DirectionalLight`,
/// `directional_light` and `directional-light` are equal.
fn normalize(word: &str) -> String {
    word.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Returns an example of the first target, preferring targets in the same scene field.
fn example_elsewhere(targets: &[Target], top_level: Option<&str>) -> Option<String> {
    let examples =
        targets.iter().filter_map(|(owner, name)| example_of(SceneFile::ENTRY, owner, name));
    nearest_example(&examples.collect::<Vec<_>>(), top_level)
}

/// Returns examples of the fields with this name, in any struct.
fn declared_elsewhere(word: &str) -> Vec<String> {
    let word = normalize(word);
    let fields = fields_where(SceneFile::ENTRY, |field| normalize(field) == word);
    let example =
        |(owner, field): &(String, &'static str)| example_of(SceneFile::ENTRY, owner, field);
    fields.iter().filter_map(example).collect()
}

/// Returns an example of a variant with this name within an enum, such as `Frame(from: Left)` for a
/// `Left` written as a whole view.
fn variant_inside(entry: &'static TypeEntry, word: &str) -> Option<String> {
    let Shape::Variants(_) = entry.shape else { return None };
    let owners = variants_where(entry, word);
    owners.iter().find_map(|owner| example_of(entry, owner, word))
}

/// Returns examples of variants with exactly this name.
fn variants_elsewhere(word: &str) -> Vec<String> {
    // These names are too generic to be recognized as misplaced variants.
    if matches!(word, "None" | "Some" | "All" | "Name" | "Index" | "On" | "Off") {
        return Vec::new();
    }
    let owners = variants_where(SceneFile::ENTRY, word);
    owners.iter().filter_map(|owner| example_of(SceneFile::ENTRY, owner, word)).collect()
}

/// Returns the first example in the same scene field, otherwise the first of all.
fn nearest_example(examples: &[String], top_level: Option<&str>) -> Option<String> {
    let is_near = |example: &&String| is_in_field(example, top_level);
    examples.iter().find(is_near).or(examples.first()).cloned()
}

/// Whether an example begins with this scene field.
fn is_in_field(example: &str, top_level: Option<&str>) -> bool {
    top_level.is_some_and(|field| example.starts_with(&format!("{field}: ")))
}
