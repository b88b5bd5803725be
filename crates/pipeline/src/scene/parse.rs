//! From the text of a scene file to its parts, or to an error that points.

use super::SceneError;
use super::file::SceneFile;
use super::messages::explain_parse_error;
use super::source_span::{PathStep, span_of};
use core::ops::Range;
use ron::error::Error as Code;
use ron::extensions::Extensions;
use serde_path_to_error::{Path, Segment};

/// Reads the text of a scene file; `file` is its name in messages.
///
/// # Errors
/// Points at the first fault of grammar, unknown name or number out of range.
pub fn parse_scene(file: &str, source: &str) -> Result<SceneFile, SceneError> {
    // A byte order mark is invisible; whoever has one did not mean it.
    let source = source.strip_prefix('\u{feff}').unwrap_or(source);
    let extensions = Extensions::IMPLICIT_SOME
        | Extensions::UNWRAP_NEWTYPES
        | Extensions::UNWRAP_VARIANT_NEWTYPES;
    let options = ron::Options::default().with_default_extension(extensions);
    let fault = |code: &Code, path: Option<&Path>, at: Range<usize>| {
        let span = path.filter(|_| points_at_a_value(code)).map_or(at, |p| locate_path(source, p));
        let (message, help) = explain_parse_error(code, path, source, &span);
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
        let end = span_of(source, &[]).end;
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
            | Code::ExpectedIdentifier
            | Code::IntegerOutOfBounds
            | Code::ExpectedDifferentLength { .. }
            | Code::MissingStructField { .. }
    )
}

fn locate_path(source: &str, path: &Path) -> Range<usize> {
    let steps: Vec<PathStep<'_>> = path
        .iter()
        .filter_map(|segment| match segment {
            Segment::Seq { index } => Some(PathStep::Index(*index)),
            Segment::Map { key } => Some(PathStep::Field(key)),
            // The name of an enum's variant is no level of its own in the text.
            Segment::Enum { .. } | Segment::Unknown => None,
        })
        .collect();
    span_of(source, &steps)
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
