//! From the text of a scene file to its parts, or to an error that points.

use super::SceneError;
use super::file::SceneFile;
use super::locate::{Step, locate};
use core::ops::Range;
use ron::error::Error as Code;
use ron::extensions::Extensions;
use serde_path_to_error::{Path, Segment};

/// Reads the text of a scene file; `file` is its name in messages.
///
/// # Errors
/// Points at the first fault of grammar, unknown name or number out of range.
pub fn parse(file: &str, source: &str) -> Result<SceneFile, SceneError> {
    // A byte order mark is invisible; whoever has one did not mean it.
    let source = source.strip_prefix('\u{feff}').unwrap_or(source);
    let extensions = Extensions::IMPLICIT_SOME
        | Extensions::UNWRAP_NEWTYPES
        | Extensions::UNWRAP_VARIANT_NEWTYPES;
    let options = ron::Options::default().with_default_extension(extensions);
    let fault = |code: &Code, path: Option<&Path>, at: Range<usize>| {
        let (message, help) = explain(code, path);
        let span = path.filter(|_| points_at_a_value(code)).map_or(at, |p| locate_path(source, p));
        SceneError { file: file.into(), source: source.into(), span, message, help }
    };
    let mut deserializer = ron::Deserializer::from_str_with_options(source, &options)
        .map_err(|error| fault(&error.code, None, bytes(source, &error.span)))?;
    let scene = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let path = error.path().clone();
        let spanned = deserializer.span_error(error.into_inner());
        fault(&spanned.code, Some(&path), bytes(source, &spanned.span))
    })?;
    deserializer.end().map_err(|code| {
        let end = locate(source, &[]).end;
        let blank = source[end..].len() - source[end..].trim_start().len();
        fault(&code, None, end + blank..source.trim_end().len())
    })?;
    Ok(scene)
}

/// Whether the value at the error's path is a better place to point at than where the parser stood.
fn points_at_a_value(code: &Code) -> bool {
    matches!(
        code,
        Code::Message(_)
            | Code::InvalidValueForType { .. }
            | Code::ExpectedFloat
            | Code::ExpectedInteger
            | Code::ExpectedString
            | Code::ExpectedArray
            | Code::ExpectedDifferentLength { .. }
            | Code::MissingStructField { .. }
    )
}

/// What is wrong and, where it can be told, what to do, in words.
fn explain(code: &Code, path: Option<&Path>) -> (String, Option<String>) {
    let place = path.map(ToString::to_string).filter(|path| path != "." && path != "?");
    let at_place =
        |what: &str| place.as_ref().map_or(what.to_owned(), |p| format!("`{p}`: {what}"));
    match code {
        Code::NoSuchStructField { expected, found, outer } => {
            let owner = outer.as_ref().map_or(String::new(), |outer| format!(" in `{outer}`"));
            (format!("unexpected field `{found}`{owner}"), suggestion(found, expected))
        }
        Code::NoSuchEnumVariant { expected, found, outer } => {
            let owner = outer.as_ref().map_or(String::new(), |outer| format!(" for `{outer}`"));
            (format!("unexpected `{found}`{owner}"), suggestion(found, expected))
        }
        Code::MissingStructField { field, outer } => {
            let owner = outer.as_ref().map_or(String::new(), |outer| format!(" of `{outer}`"));
            (format!("the field `{field}`{owner} is missing"), Some(format!("add `{field}: …`")))
        }
        Code::DuplicateStructField { field, .. } => {
            (format!("the field `{field}` is there twice"), Some("remove one of them".into()))
        }
        Code::ExpectedFloat => (at_place("expected a number"), None),
        Code::ExpectedInteger => (at_place("expected a whole number"), None),
        Code::ExpectedString => (
            at_place("expected a text"),
            Some("texts stand in quotation marks: \"like this\"".into()),
        ),
        Code::ExpectedComma => (
            "expected a comma or a closing bracket here".into(),
            Some(
                "whole numbers have no decimal point; fields and elements are parted by commas"
                    .into(),
            ),
        ),
        Code::InvalidValueForType { expected, found } => {
            (at_place(&format!("expected {expected}, found {found}")), None)
        }
        Code::Eof | Code::ExpectedNamedStructLike(_) => (
            "the file ends too early, or is no scene".into(),
            Some("a scene looks like this: Scene(models: [(path: \"model.glb\")])".into()),
        ),
        Code::TrailingCharacters => {
            ("there is something behind the scene's last bracket".into(), None)
        }
        Code::Message(message) => (at_place(message), None),
        other => (at_place(&lower_first(&other.to_string())), None),
    }
}

fn lower_first(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or(String::new(), |first| first.to_lowercase().chain(chars).collect())
}

/// "Did you mean", or the list of what is possible.
pub(super) fn suggestion<S: AsRef<str>>(found: &str, expected: &[S]) -> Option<String> {
    let likeness = |name: &str| strsim::jaro_winkler(&found.to_lowercase(), &name.to_lowercase());
    let best =
        expected.iter().map(AsRef::as_ref).max_by(|a, b| likeness(a).total_cmp(&likeness(b)))?;
    if likeness(best) > 0.8 {
        return Some(format!("did you mean `{best}`?"));
    }
    let names: Vec<String> = expected.iter().map(|name| format!("`{}`", name.as_ref())).collect();
    Some(format!("possible here: {}", names.join(", ")))
}

fn locate_path(source: &str, path: &Path) -> Range<usize> {
    let steps: Vec<Step<'_>> = path
        .iter()
        .filter_map(|segment| match segment {
            Segment::Seq { index } => Some(Step::Index(*index)),
            Segment::Map { key } => Some(Step::Field(key)),
            // The name of an enum's variant is no level of its own in the text.
            Segment::Enum { .. } | Segment::Unknown => None,
        })
        .collect();
    locate(source, &steps)
}

/// The bytes of a span that RON gives in lines and columns of characters; at least one character, if there is one.
fn bytes(source: &str, span: &ron::error::Span) -> Range<usize> {
    let offset = |position: &ron::error::Position| {
        let line_start = match position.line {
            0 | 1 => 0,
            line => source.match_indices('\n').nth(line - 2).map_or(source.len(), |(at, _)| at + 1),
        };
        let columns = source[line_start..].char_indices().map(|(at, _)| line_start + at);
        columns.chain([source.len()]).nth(position.col.saturating_sub(1)).unwrap_or(source.len())
    };
    let (start, end) = (offset(&span.start), offset(&span.end));
    let next = source[start..].chars().next().map_or(0, char::len_utf8);
    start..end.max(start + next)
}
