//! Scene file errors, each with its position in the text and, if possible, a correction.

use super::source_text::SourceText;
#[cfg(feature = "terminal")]
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use core::fmt;
use core::ops::Range;
use files::{counted, visible_text};

/// Lines with more bytes than this are not quoted.
#[cfg(feature = "terminal")]
const LONGEST_LINE: usize = 10_000;

/// A mistake in a scene file.
///
/// Its `Display` shows the line with a caret under the mistake:
/// ```text
/// unexpected field `traget` in `LookAt`
///  --> scene.ron:4:32
///   |
/// 4 |     camera: (view: LookAt(eye: (4, 3, 5.5), traget: (0, 0, 0))),
///   |                                             ^^^^^^
///   = help: did you mean `target`?
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SceneError {
    /// The path of the scene file, or the name of the model if there is no scene file.
    pub file: String,
    /// The whole text; empty for a model without a scene file.
    pub source: SourceText,
    /// The byte range of the mistake in the text.
    pub span: Range<usize>,
    /// A description of the mistake.
    pub message: String,
    /// The suggested correction.
    pub help: Option<String>,
}

impl SceneError {
    /// Returns the line and column of the mistake, both counted from 1. Columns count characters.
    #[must_use]
    pub fn line_and_column(&self) -> (usize, usize) {
        self.source.line_and_column(self.span.start)
    }

    /// Formats the message with the line and the caret, in terminal colors (ECMA-48) if `colors` is
    /// set.
    ///
    /// Without the feature `terminal`, the line and column are given as numbers, without colors.
    #[must_use]
    #[cfg_attr(not(feature = "terminal"), expect(unused_variables, reason = "used by snippets"))]
    pub fn to_message(&self, colors: bool) -> String {
        #[cfg(feature = "terminal")]
        if let Some(snippet) = self.to_snippet(colors) {
            return snippet;
        }
        let mut place = visible_text(&self.file).into_owned();
        if !self.source.is_empty() {
            let (line, column) = self.line_and_column();
            place = format!("{place}:{line}:{column}");
        }
        let help = self.help.as_deref().map_or(String::new(), |help| {
            let help = visible_text(help);
            format!("\n  = help: {help}")
        });
        format!("{place}: {}{help}", visible_text(&self.message))
    }

    /// Formats the message with the line and the caret; returns `None` if there is no text or the
    /// line is too long to show.
    #[cfg(feature = "terminal")]
    fn to_snippet(&self, colors: bool) -> Option<String> {
        let (number, line) = self.source.line_at(self.span.start);
        if self.source.is_empty() || line.len() > LONGEST_LINE {
            return None;
        }
        // Only the first line is marked: carets under many lines hide more than they show.
        let marked = self.span.start - line.start..self.span.end.min(line.end) - line.start;
        let [file, message] = [&self.file, &self.message].map(|text| visible_text(text));
        let snippet = Snippet::source(&self.source[line])
            .line_start(number)
            .path(&*file)
            .annotation(AnnotationKind::Primary.span(marked));
        let mut group: Group<'_> = Level::ERROR.no_name().primary_title(&*message).element(snippet);
        if let Some(help) = &self.help {
            group = group.element(Level::HELP.message(visible_text(help)));
        }
        let renderer = if colors { Renderer::styled() } else { Renderer::plain() };
        Some(renderer.render(&[group]))
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.to_message(false))
    }
}

impl std::error::Error for SceneError {}

/// The mistakes in a scene, at least one, in file order. None of them is a consequence of another.
///
/// Its `Display` shows the first [`SHOWN`](Self::SHOWN) and counts the rest.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SceneErrors {
    /// The first mistake, boxed to keep a `Result` with these errors small.
    first: Box<SceneError>,
    others: Vec<SceneError>,
}

impl SceneErrors {
    /// The maximum number of mistakes in a message; more would scroll the first one off the screen.
    pub const SHOWN: usize = 5;

    /// Wraps the mistakes in this order; returns `None` if the list is empty.
    #[must_use]
    pub fn from_list(errors: Vec<SceneError>) -> Option<Self> {
        let mut errors = errors.into_iter();
        Some(Self { first: Box::new(errors.next()?), others: errors.collect() })
    }

    /// Returns the first mistake.
    #[must_use]
    pub fn first(&self) -> &SceneError {
        &self.first
    }

    /// Returns all mistakes.
    pub fn iter(&self) -> impl Iterator<Item = &SceneError> {
        std::iter::once(&*self.first).chain(&self.others)
    }

    /// Formats the first few mistakes, all but the first prefixed with `error: `, and counts the
    /// others. Uses terminal colors if `colors` is set.
    #[must_use]
    pub fn to_message(&self, colors: bool) -> String {
        let error = if colors { "\x1b[1;31merror\x1b[0m: " } else { "error: " };
        let messages: Vec<String> =
            self.iter().take(Self::SHOWN).map(|mistake| mistake.to_message(colors)).collect();
        let mut text = messages.join(&format!("\n\n{error}"));
        let count = 1 + self.others.len();
        if let Some(more) = count.checked_sub(Self::SHOWN).filter(|more| *more > 0) {
            let more = counted(more, "more mistake", "more mistakes");
            text.push_str(&format!("\n\n… and {more}; `alberti scene check` lists them all"));
        }
        text
    }
}

impl From<SceneError> for SceneErrors {
    fn from(error: SceneError) -> Self {
        Self { first: Box::new(error), others: Vec::new() }
    }
}

impl From<SceneErrors> for Vec<SceneError> {
    fn from(errors: SceneErrors) -> Self {
        std::iter::once(*errors.first).chain(errors.others).collect()
    }
}

impl fmt::Display for SceneErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.to_message(false))
    }
}

impl std::error::Error for SceneErrors {}
