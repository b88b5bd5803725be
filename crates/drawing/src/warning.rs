//! Warnings: what a drawing leaves out, returned along with it.

use crate::overlay::LabelFault;
use core::fmt;

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
    /// The style shows surfaces, and sections apply to line drawings only.
    SectionsIgnored,
    /// The format has no anaglyphs; only PNG images have.
    AnaglyphIgnored,
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
    /// The search for intersection edges was cut off.
    IntersectionsIncomplete,
    /// The hatching was cut off.
    HatchingIncomplete,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SectionOpen { object } => write!(
                f,
                "the cut through `{object}` does not close, because its surface is open: \
                 the section has no cap and no hatching there"
            ),
            Self::SectionTooComplex { object } => write!(
                f,
                "the cut through `{object}` has too many points: \
                 the section has no cap and no hatching"
            ),
            Self::SectionsIgnored => f.write_str(
                "sections cut line drawings only: this style shows whole models; \
                 choose another, such as `--style lines`",
            ),
            Self::AnaglyphIgnored => f.write_str(
                "only PNG pictures have anaglyphs: \
                 this one shows the view of the scene's camera alone",
            ),
            Self::LabelNotDrawn { text, fault } => write!(
                f,
                "the label \"{text}\" is not drawn: its point is {}",
                match fault {
                    LabelFault::BehindEye => "behind the eye",
                    LabelFault::Outside => "outside of the picture",
                }
            ),
            Self::GlyphsMissing { text, characters } => write!(
                f,
                "the letters of drawings lack {characters} of \"{text}\": boxes are in their place"
            ),
            Self::IntersectionsIncomplete => f.write_str(
                "so many faces may intersect that not all were compared: \
                 some intersection edges may be missing",
            ),
            Self::HatchingIncomplete => f.write_str(
                "there are too many hatch lines, and some are missing: increase their spacing",
            ),
        }
    }
}
