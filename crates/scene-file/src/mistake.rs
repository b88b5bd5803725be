//! A mistake in the text of a scene file: its bytes and a message.

use super::SceneError;
use super::source_text::SourceText;
use core::ops::Range;

/// The maximum number of mistakes reported for a text. A longer list would help nobody, and each
/// mistake costs a search for the intended word.
pub(super) const MAX_MISTAKES: usize = 1000;

/// A mistake at a position in a text, found by the parser or by the declaration checker.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Mistake {
    /// The bytes that the message points at.
    pub(super) span: Range<usize>,
    /// The bytes of the field or element with the mistake; nothing else should be reported in them.
    pub(super) scope: Range<usize>,
    pub(super) message: String,
    pub(super) help: Option<String>,
}

impl Mistake {
    /// Creates a mistake whose scope is its span.
    pub(super) fn new(
        span: Range<usize>,
        message: impl Into<String>,
        help: Option<String>,
    ) -> Self {
        Self { scope: span.clone(), span, message: message.into(), help }
    }

    /// Converts the mistake to an error in a file with this name and text.
    pub(super) fn to_error(&self, file: &str, source: &SourceText) -> SceneError {
        SceneError {
            file: file.to_owned(),
            source: source.clone(),
            span: self.span.clone(),
            message: self.message.clone(),
            help: self.help.clone(),
        }
    }
}
