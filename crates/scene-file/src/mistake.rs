//! A mistake in the text of a scene file: its bytes, and what is wrong with them.

use super::SceneError;
use super::source_text::SourceText;
use core::ops::Range;

/// The most mistakes that are reported of a text: more tell nobody anything, and each costs a
/// search for what was meant.
pub(super) const MAX_MISTAKES: usize = 1000;

/// A mistake at a place in a text that both the parser and the checker of declarations know.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Mistake {
    /// The bytes that the message points at.
    pub(super) span: Range<usize>,
    /// The field or element that is wrong, of which nothing else should be reported.
    pub(super) scope: Range<usize>,
    pub(super) message: String,
    pub(super) help: Option<String>,
}

impl Mistake {
    /// A mistake whose scope is what it points at.
    pub(super) fn new(
        span: Range<usize>,
        message: impl Into<String>,
        help: Option<String>,
    ) -> Self {
        Self { scope: span.clone(), span, message: message.into(), help }
    }

    /// The mistake as an error of a file with this name and text.
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
