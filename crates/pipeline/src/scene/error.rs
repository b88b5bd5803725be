//! Errors of scene files: each points at the place in the text and says what to do.

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use core::fmt;
use core::ops::Range;

/// A fault of a scene file.
///
/// Its `Display` shows the line with a mark under the fault:
/// ```text
/// error: unexpected field `traget` in `LookAt`
///  --> scene.ron:4:32
///   |
/// 4 |     camera: (view: LookAt(eye: (4, 3, 5.5), traget: (0, 0, 0))),
///   |                                             ^^^^^^
///   = help: did you mean `target`?
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SceneError {
    /// The scene file's path, or what stands for it.
    pub file: String,
    /// The whole text; empty if there is none, for a bare model.
    pub source: String,
    /// The bytes of the text that the fault is in.
    pub span: Range<usize>,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
}

impl SceneError {
    /// The line and column of the fault, both from 1; columns count characters.
    #[must_use]
    pub fn line_and_column(&self) -> (usize, usize) {
        let before = &self.source[..self.span.start];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.to_message(false))
    }
}

impl SceneError {
    /// The message with the line and the mark; in colours of a terminal (ECMA-48), if they are wanted.
    #[must_use]
    pub fn to_message(&self, colors: bool) -> String {
        if self.source.is_empty() {
            let help =
                self.help.as_ref().map_or(String::new(), |help| format!("\n  = help: {help}"));
            return format!("{}: {}{help}", self.file, self.message);
        }
        let snippet = Snippet::source(self.source.as_str())
            .path(self.file.as_str())
            .annotation(AnnotationKind::Primary.span(self.first_line_of_span()));
        let mut group: Group<'_> =
            Level::ERROR.no_name().primary_title(self.message.as_str()).element(snippet);
        if let Some(help) = &self.help {
            group = group.element(Level::HELP.message(help.as_str()));
        }
        let renderer = if colors { Renderer::styled() } else { Renderer::plain() };
        renderer.render(&[group])
    }

    /// A mark over many lines hides more than it shows: keep it to the first.
    fn first_line_of_span(&self) -> Range<usize> {
        let marked = &self.source[self.span.clone()];
        let length = marked.find('\n').unwrap_or(marked.len());
        self.span.start..self.span.start + length
    }
}

impl std::error::Error for SceneError {}
