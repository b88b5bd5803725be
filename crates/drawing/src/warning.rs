//! Warnings: what a drawing leaves out, returned along with it.

mod assembly;
mod dimension;

use crate::overlay::{LabelFault, SheetLabelFault};
pub use assembly::AssemblyWarning;
use core::fmt;
pub use dimension::DimensionFault;

/// Something that a drawing leaves out or could not do, with the reason in its `Display` text.
///
/// Warnings are sorted and each is reported once, so their order does not depend on threads. They
/// are part of the result, not logged: the caller decides whether and where to print them.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
#[non_exhaustive]
pub enum Warning {
    /// The outline of a section does not close.
    SectionOpen {
        /// The name of the object.
        object: String,
    },
    /// The outline of a section has too many points for a cap.
    SectionTooComplex {
        /// The name of the object.
        object: String,
    },
    /// A section plane lies beside the models and removes nothing.
    SectionMisses {
        /// The number of the section, from 1.
        number: usize,
    },
    /// A section plane lies beside the models, which are all on the side that is removed.
    SectionRemovesAll {
        /// The number of the section, from 1.
        number: usize,
    },
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
    /// The textures of some materials cut out parts of their faces, and lines show these whole.
    CutOutsDrawnWhole,
    /// So many faces lie behind each other that small gaps between them count as closed.
    CrowdApproximated,
    /// So many faces overlap that their outlines are traced on a grid, and are not exact.
    OutlinesTraced,
    /// Outlines over surfaces are left out, because copies have too many triangles.
    OutlinesLeftOut,
    /// Nothing is in the picture.
    PictureEmpty {
        /// The reason.
        reason: String,
    },
    /// The search for intersection edges was cut off.
    IntersectionsIncomplete,
    /// The hatching was cut off.
    HatchingIncomplete,
    /// The models have no size, or points only: no view of a sheet has a line.
    NothingDrawn,
    /// No view of a sheet is as large as a millimeter of the paper.
    ViewsTiny,
    /// The search for hidden lines was cut off.
    VisibilityIncomplete,
}

impl Warning {
    /// The text of a warning about a section plane; of others nothing.
    fn fmt_section(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SectionOpen { object } => write!(
                f,
                "the cut through `{}` does not close, because its surface is open: \
                 the section has no cap and no hatching there",
                visible_text(object)
            ),
            Self::SectionTooComplex { object } => write!(
                f,
                "the cut through `{}` has too many points: \
                 the section has no cap and no hatching",
                visible_text(object)
            ),
            Self::SectionMisses { number } => {
                write!(f, "section {number} cuts nothing: its plane lies beside the models")
            }
            Self::SectionRemovesAll { number } => write!(
                f,
                "section {number} would remove everything: all models lie on the side of its plane \
                 that is cut away"
            ),
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
                visible_text(text),
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
                visible_text(text),
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

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SectionOpen { .. }
            | Self::SectionTooComplex { .. }
            | Self::SectionMisses { .. }
            | Self::SectionRemovesAll { .. }
            | Self::SectionOblique { .. } => self.fmt_section(f),
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
                let [characters, text] = [characters, text].map(|text| visible_text(text));
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
            | Self::CutOutsDrawnWhole
            | Self::CrowdApproximated
            | Self::OutlinesTraced
            | Self::OutlinesLeftOut
            | Self::IntersectionsIncomplete
            | Self::HatchingIncomplete
            | Self::NothingDrawn
            | Self::ViewsTiny
            | Self::VisibilityIncomplete => f.write_str(self.fixed_text()),
        }
    }
}

/// Characters of a text beyond this number are left out of messages: names of parts have any length.
const MAX_QUOTED: usize = 60;

/// A text in which characters without a sign of their own, such as controls and those that change
/// the direction of writing, are written by their code: `\u{202e}`. A long one is cut off.
pub fn visible_text(text: &str) -> String {
    let is_invisible = |c: char| {
        files::is_terminal_control(c)
            || matches!(c, '\u{ad}' | '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2060}'..='\u{206f}')
            || c == '\u{feff}'
    };
    let shown =
        |c: char| if is_invisible(c) { c.escape_unicode().to_string() } else { c.to_string() };
    let start = text.chars().take(MAX_QUOTED).map(shown);
    let is_longer = text.chars().nth(MAX_QUOTED).is_some();
    start.chain(is_longer.then(|| "...".to_owned())).collect()
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
            Self::CrowdApproximated => {
                "so many surfaces lie behind each other that lines behind gaps of a pixel or two are \
                 left out: `--no-line-limits` draws them, and may take long"
            }
            Self::OutlinesTraced => {
                "so many faces overlap that their outlines are traced on a fine grid, and are not exact"
            }
            Self::OutlinesLeftOut => {
                "the models have so many copies that their outlines would take long, and they are left \
                 out: `--no-line-limits` draws them"
            }
            Self::CutOutsDrawnWhole => {
                "textures cut shapes such as leaves out of some faces: lines show the edges of the \
                 whole faces"
            }
            Self::IntersectionsIncomplete => {
                "so many faces may intersect that not all were compared: \
                 some intersection edges may be missing"
            }
            Self::HatchingIncomplete => {
                "there are too many hatch lines, and some are missing: increase their spacing"
            }
            Self::NothingDrawn => {
                "the views are empty: the models have neither lines nor faces, or these have no size"
            }
            Self::ViewsTiny => {
                "the views are smaller than a millimeter of the paper: \
                 set the unit of the model, or a larger scale"
            }
            Self::VisibilityIncomplete => {
                "so many faces lie before and behind each other that not all lines were compared \
                 with all of them, and some hidden lines are drawn: leave out parts of the model, \
                 or simplify its meshes"
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
