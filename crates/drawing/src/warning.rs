//! Warnings about missing or approximate parts of a page, returned along with the page.

use crate::overlay::LabelFault;
use core::cmp::Ordering;
use core::fmt;
use files::visible_excerpt;
use page::Ink;

/// A part of a drawing that is missing or not exact. The `Display` text gives the reason.
///
/// Warnings are sorted and reported once each, so their order does not depend on threads: sections
/// first, then labels, then work limits. They are part of the result and are not logged: the caller
/// decides whether and where to print them.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum Warning {
    /// A warning from hidden-line removal.
    Lines(hidden_line::Warning),
    /// The style shows surfaces, but sections apply only to line drawings.
    SectionsIgnored,
    /// The format does not support anaglyphs; only PNG images do.
    AnaglyphIgnored,
    /// The format does not support images: DXF has lines, areas and text.
    ImagesNotInDxf,
    /// The point of a label is not in the picture.
    LabelNotDrawn {
        /// The text of the label.
        text: String,
        /// The reason.
        fault: LabelFault,
    },
    /// The stroke font lacks some of the characters in a string.
    GlyphsMissing {
        /// The string.
        text: String,
        /// The missing characters, without duplicates.
        characters: String,
    },
    /// So many faces overlap that their outlines are traced on a grid and are not exact.
    OutlinesTraced,
    /// Outlines over surfaces are not drawn, because the models have too many copies with too many
    /// triangles.
    OutlinesLeftOut,
    /// The ink of the style cannot be seen on the background, so the lines have another color.
    InkReplaced {
        /// The ink of the style.
        invisible: Ink,
        /// The color of the lines.
        ink: Ink,
    },
    /// The picture is empty.
    PictureEmpty {
        /// The reason.
        reason: String,
    },
}

impl Warning {
    /// Returns the position of the warning in a report, relative to
    /// [`hidden_line::Warning::report_order`].
    #[must_use]
    pub const fn report_order(&self) -> u8 {
        match self {
            Self::Lines(warning) => warning.report_order(),
            Self::SectionsIgnored => 40,
            Self::AnaglyphIgnored => 42,
            Self::ImagesNotInDxf => 43,
            Self::LabelNotDrawn { .. } => 44,
            Self::GlyphsMissing { .. } => 45,
            Self::OutlinesTraced => 70,
            Self::OutlinesLeftOut => 71,
            Self::PictureEmpty { .. } => 72,
            Self::InkReplaced { .. } => 73,
        }
    }

    /// Compares two warnings of the same kind.
    fn compare_values(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Self::Lines(a), Self::Lines(b)) => a.cmp(b),
            (Self::LabelNotDrawn { text, fault }, Self::LabelNotDrawn { text: b, fault: c }) => {
                (text, fault).cmp(&(b, c))
            }
            (
                Self::GlyphsMissing { text, characters },
                Self::GlyphsMissing { text: b, characters: c },
            ) => (text, characters).cmp(&(b, c)),
            (
                Self::InkReplaced { invisible, ink },
                Self::InkReplaced { invisible: other, ink: second },
            ) => (invisible, ink).cmp(&(other, second)),
            (Self::PictureEmpty { reason: a }, Self::PictureEmpty { reason: b }) => a.cmp(b),
            _ => Ordering::Equal,
        }
    }
}

impl Ord for Warning {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_kind = self.report_order().cmp(&other.report_order());
        by_kind.then_with(|| self.compare_values(other))
    }
}

impl PartialOrd for Warning {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl From<hidden_line::Warning> for Warning {
    fn from(warning: hidden_line::Warning) -> Self {
        Self::Lines(warning)
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lines(warning) => warning.fmt(f),
            Self::SectionsIgnored => f.write_str(
                "sections are ignored: they apply only to line drawings; choose a style such as \
                 `--style lines`",
            ),
            Self::AnaglyphIgnored => f.write_str(
                "only PNG pictures can be anaglyphs: this one shows only the view of the scene's \
                 camera",
            ),
            Self::ImagesNotInDxf => f.write_str(
                "DXF has lines, areas and text, but no images: backgrounds and face fills are \
                 omitted",
            ),
            Self::LabelNotDrawn { text, fault } => write!(
                f,
                "the label \"{}\" is not drawn: its point is {}",
                visible_excerpt(text),
                match fault {
                    LabelFault::BehindEye => "behind the eye",
                    LabelFault::Outside => "outside the picture",
                }
            ),
            Self::GlyphsMissing { text, characters } => {
                let [characters, text] = [characters, text].map(|text| visible_excerpt(text));
                write!(
                    f,
                    "the drawing font lacks {characters} in \"{text}\": boxes are drawn instead"
                )
            }
            Self::OutlinesTraced => f.write_str(
                "so many faces overlap that their outlines are traced on a fine grid and are not exact",
            ),
            Self::OutlinesLeftOut => f.write_str(
                "the outlines of the models are omitted because drawing so many instances would take \
                 too long: use `--no-line-limits` to draw them",
            ),
            Self::InkReplaced { invisible, ink } => {
                let [from, to] = [invisible, ink].map(|[r, g, b]| format!("#{r:02x}{g:02x}{b:02x}"));
                write!(
                    f,
                    "lines in {from} cannot be seen on this background, so they are drawn in {to}: set \
                     another `color` or background"
                )
            }
            Self::PictureEmpty { reason } => write!(f, "the picture is empty: {reason}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn invisible_characters_are_written_as_codes() {
        let (text, characters) =
            ("a\u{7}\u{202e}b\u{5d0}".to_owned(), "\u{7}\u{202e}\u{5d0}".to_owned());
        let message = Warning::GlyphsMissing { text, characters }.to_string();
        assert!(message.contains("lacks \\u{7}\\u{202e}\u{5d0} in"), "{message}");
        assert!(message.contains("\"a\\u{7}\\u{202e}b\u{5d0}\""), "{message}");
    }
}
