//! Warnings: what a page of a drawing leaves out, returned along with it.

mod assembly;
mod dimension;

use crate::overlay::{LabelFault, SheetLabelFault};
pub use assembly::AssemblyWarning;
use core::cmp::Ordering;
use core::fmt;
pub use dimension::DimensionFault;
use files::visible_excerpt;

/// Something that a drawing leaves out or could not do, with the reason in its `Display` text.
///
/// Warnings are sorted and each is reported once, so their order does not depend on threads:
/// sections come first, then labels, then limits of work. They are part of the result, not logged:
/// the caller decides whether and where to print them.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum Warning {
    /// Something that its lines leave out.
    Lines(hidden_line::Warning),
    /// No principal view of a sheet sees a section plane from the front or edge-on.
    SectionOblique {
        /// The number of the section, from 1.
        number: usize,
    },
    /// A view of a sheet finds no place beside the others.
    ViewLeftOut {
        /// The name of the view, such as `isometric view` or `section A-A`.
        view: String,
    },
    /// A dimension is not on the sheet.
    DimensionLeftOut {
        /// The name of the dimension, such as `dimension 3`.
        dimension: String,
        /// The reason.
        fault: DimensionFault,
    },
    /// The line of a section has no view on the sheet that could show it.
    CutLineNotShown {
        /// The name of the section, such as `A-A`.
        section: String,
    },
    /// A view of a sheet lies over another one, or over the title block, at the place that it was
    /// given.
    ViewOverlaps {
        /// The name of the view, such as `isometric view`.
        view: String,
        /// The other view, or the title block.
        other: String,
    },
    /// Sheets do not show an overlay of the scene.
    OverlayNotOnSheets {
        /// The kind of overlay, such as `grid`.
        overlay: String,
    },
    /// The label of a point, or the name of an axis, is not in a view of a sheet.
    LabelNotInView {
        /// The text of the label.
        text: String,
        /// The name of the view, such as `front view`.
        view: String,
        /// The reason.
        fault: SheetLabelFault,
    },
    /// The style shows surfaces, and sections apply to line drawings only.
    SectionsIgnored,
    /// The style of the scene shows surfaces, and a sheet is a line drawing.
    StyleIgnored,
    /// The format has no anaglyphs; only PNG images have.
    AnaglyphIgnored,
    /// The format has no images: DXF has lines, areas and texts.
    ImagesNotInDxf,
    /// The point of a label is not in the picture.
    LabelNotDrawn {
        /// The text of the label.
        text: String,
        /// Where the point is.
        fault: LabelFault,
    },
    /// The stroke font lacks characters of a text.
    GlyphsMissing {
        /// The text.
        text: String,
        /// The characters, each once.
        characters: String,
    },
    /// Something that the pages of an assembly leave out.
    Assembly(AssemblyWarning),
    /// So many faces overlap that their outlines are traced on a grid, and are not exact.
    OutlinesTraced,
    /// Outlines over surfaces are left out, because copies have too many triangles.
    OutlinesLeftOut,
    /// Nothing is in the picture.
    PictureEmpty {
        /// The reason.
        reason: String,
    },
    /// The models have no size, or points only: no view of a sheet has a line.
    NothingDrawn,
    /// No view of a sheet is as large as a millimeter of the paper.
    ViewsTiny,
}

impl Warning {
    /// The place of the warning in a report, among those of [`hidden_line::Warning::report_order`].
    #[must_use]
    pub const fn report_order(&self) -> u8 {
        match self {
            Self::Lines(warning) => warning.report_order(),
            Self::SectionOblique { .. } => 20,
            Self::ViewLeftOut { .. } => 21,
            Self::DimensionLeftOut { .. } => 22,
            Self::CutLineNotShown { .. } => 23,
            Self::ViewOverlaps { .. } => 24,
            Self::OverlayNotOnSheets { .. } => 25,
            Self::LabelNotInView { .. } => 26,
            Self::SectionsIgnored => 40,
            Self::StyleIgnored => 41,
            Self::AnaglyphIgnored => 42,
            Self::ImagesNotInDxf => 43,
            Self::LabelNotDrawn { .. } => 44,
            Self::GlyphsMissing { .. } => 45,
            Self::Assembly(_) => 50,
            Self::OutlinesTraced => 70,
            Self::OutlinesLeftOut => 71,
            Self::PictureEmpty { .. } => 72,
            Self::NothingDrawn => 90,
            Self::ViewsTiny => 91,
        }
    }

    /// The order of two warnings of one kind.
    fn compare_values(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Self::Lines(a), Self::Lines(b)) => a.cmp(b),
            (Self::SectionOblique { number: a }, Self::SectionOblique { number: b }) => a.cmp(b),
            (
                Self::DimensionLeftOut { dimension, fault },
                Self::DimensionLeftOut { dimension: b, fault: c },
            ) => (dimension, fault).cmp(&(b, c)),
            (
                Self::LabelNotInView { text, view, fault },
                Self::LabelNotInView { text: b, view: c, fault: d },
            ) => (text, view, fault).cmp(&(b, c, d)),
            (Self::LabelNotDrawn { text, fault }, Self::LabelNotDrawn { text: b, fault: c }) => {
                (text, fault).cmp(&(b, c))
            }
            (Self::Assembly(a), Self::Assembly(b)) => a.cmp(b),
            _ => self.texts().cmp(&other.texts()),
        }
    }

    /// The texts in the values of a warning.
    fn texts(&self) -> [&str; 2] {
        match self {
            Self::ViewLeftOut { view: text }
            | Self::CutLineNotShown { section: text }
            | Self::OverlayNotOnSheets { overlay: text }
            | Self::PictureEmpty { reason: text } => [text, ""],
            Self::ViewOverlaps { view: text, other }
            | Self::GlyphsMissing { text, characters: other } => [text, other],
            _ => ["", ""],
        }
    }

    /// The text of a warning about a section plane; of others nothing.
    fn fmt_section(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SectionOblique { number } => write!(
                f,
                "section {number} has neither a cut line nor a view of its own on the sheet: its plane is \
                 oblique to the front, the top and the side view, and only an axonometric view shows it"
            ),
            _ => Ok(()),
        }
    }

    /// Writes a warning about an overlay of the scene.
    fn fmt_overlay(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LabelNotDrawn { text, fault } => write!(
                f,
                "the label \"{}\" is not drawn: its point is {}",
                visible_excerpt(text),
                match fault {
                    LabelFault::BehindEye => "behind the eye",
                    LabelFault::Outside => "outside of the picture",
                }
            ),
            Self::OverlayNotOnSheets { overlay } => write!(
                f,
                "sheets show labels and axes of the scene's overlays, but not the {overlay}"
            ),
            Self::LabelNotInView { text, view, fault } => write!(
                f,
                "the label \"{}\" is not in the {view}: {}",
                visible_excerpt(text),
                match fault {
                    SheetLabelFault::Far => {
                        "its point is too far from the models; move it nearer to them"
                    }
                    SheetLabelFault::NoRoom => {
                        "there is no place for it; take larger paper, or fewer labels"
                    }
                    SheetLabelFault::TooMany => "a view has at most 100; leave some out",
                }
            ),
            _ => Ok(()),
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
            Self::SectionOblique { .. } => self.fmt_section(f),
            Self::ViewLeftOut { view } => write!(
                f,
                "there is no place for the {view} beside the other views, and it is left out: \
                 use larger paper or a smaller scale"
            ),
            Self::DimensionLeftOut { dimension, fault } => {
                write!(f, "{dimension} is not on the sheet: {fault}")
            }
            Self::CutLineNotShown { section } => write!(
                f,
                "no view of the sheet looks along the steps of section {section}, so none has its \
                 line"
            ),
            Self::ViewOverlaps { view, other } => write!(
                f,
                "the {view} lies over the {other} at the place that it was given: move one of them, \
                 or choose a smaller scale"
            ),
            Self::ImagesNotInDxf => f.write_str(
                "DXF has lines, areas and texts, but no images: \
                 backgrounds and fills of faces are left out",
            ),
            Self::LabelNotDrawn { .. }
            | Self::OverlayNotOnSheets { .. }
            | Self::LabelNotInView { .. } => self.fmt_overlay(f),
            Self::GlyphsMissing { text, characters } => {
                let [characters, text] = [characters, text].map(|text| visible_excerpt(text));
                write!(
                    f,
                    "the letters of drawings lack {characters} of \"{text}\": \
                     boxes are in their place"
                )
            }
            Self::Assembly(warning) => warning.fmt(f),
            Self::PictureEmpty { reason } => write!(f, "the picture is empty: {reason}"),
            Self::SectionsIgnored
            | Self::StyleIgnored
            | Self::AnaglyphIgnored
            | Self::OutlinesTraced
            | Self::OutlinesLeftOut
            | Self::NothingDrawn
            | Self::ViewsTiny => f.write_str(self.fixed_text()),
        }
    }
}

impl Warning {
    /// The text of a warning without a value; empty for the others.
    const fn fixed_text(&self) -> &'static str {
        match self {
            Self::SectionsIgnored => {
                "sections do nothing here: only line drawings can be cut; choose a style such as \
                 `--style lines`"
            }
            Self::StyleIgnored => {
                "sheets are line drawings, and do not show the style of the scene: \
                 `style: Lines(…)` sets their lines"
            }
            Self::AnaglyphIgnored => {
                "only PNG pictures have anaglyphs: \
                 this one shows the view of the scene's camera alone"
            }
            Self::OutlinesTraced => {
                "so many faces overlap that their outlines are traced on a fine grid, and are not exact"
            }
            Self::OutlinesLeftOut => {
                "the models have so many copies that their outlines would take long, and they are left \
                 out: `--no-line-limits` draws them"
            }
            Self::NothingDrawn => {
                "the views are empty: the models have neither lines nor faces, or these have no size"
            }
            Self::ViewsTiny => {
                "the views are smaller than a millimeter of the paper: \
                 set the unit of the model, or a larger scale"
            }
            _ => "",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_that_are_not_seen_are_written_by_their_code() {
        let (text, characters) =
            ("a\u{7}\u{202e}b\u{5d0}".to_owned(), "\u{7}\u{202e}\u{5d0}".to_owned());
        let message = Warning::GlyphsMissing { text, characters }.to_string();
        assert!(message.contains("lack \\u{7}\\u{202e}\u{5d0} of"), "{message}");
        assert!(message.contains("\"a\\u{7}\\u{202e}b\u{5d0}\""), "{message}");
    }
}
