//! Warnings about missing or approximate parts of a line drawing, returned with the drawing.

use core::fmt;
use files::visible_excerpt;

/// A part of a line drawing that is missing or approximate; its `Display` text gives the reason.
///
/// Warnings are sorted and free of duplicates, so their order does not depend on threads. They are
/// part of the result and are never logged: the caller decides whether and where to print them.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
#[non_exhaustive]
pub enum Warning {
    /// The outline of a section does not close.
    SectionOpen {
        /// The object name.
        object: String,
    },
    /// The outline of a section has too many points for a cap.
    SectionTooComplex {
        /// The object name.
        object: String,
    },
    /// A section plane misses the models and removes nothing.
    SectionMisses {
        /// The number of the section, from 1.
        number: usize,
    },
    /// A section plane misses the models, all of which are on the removed side.
    SectionRemovesAll {
        /// The number of the section, from 1.
        number: usize,
    },
    /// The textures of some materials have cut-outs, but the lines show whole faces.
    CutOutsDrawnWhole,
    /// So many faces overlap on the screen that small gaps between them count as closed.
    CrowdApproximated,
    /// The search for intersection edges ended early.
    IntersectionsIncomplete,
    /// The hatching ended early.
    HatchingIncomplete,
    /// The search for hidden lines ended early.
    VisibilityIncomplete,
}

impl Warning {
    /// Returns the position of the warning in a report: sections, then labels, then work limits.
    /// Crates that depend on this one use the numbers in between for their own warnings.
    #[must_use]
    pub const fn report_order(&self) -> u8 {
        match self {
            Self::SectionOpen { .. } => 0,
            Self::SectionTooComplex { .. } => 1,
            Self::SectionMisses { .. } => 2,
            Self::SectionRemovesAll { .. } => 3,
            Self::CutOutsDrawnWhole => 60,
            Self::CrowdApproximated => 61,
            Self::IntersectionsIncomplete => 80,
            Self::HatchingIncomplete => 81,
            Self::VisibilityIncomplete => 100,
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SectionOpen { object } => write!(
                f,
                "the cut through `{}` is not closed, because the surface is open: the section has \
                 no cap and no hatching there",
                visible_excerpt(object)
            ),
            Self::SectionTooComplex { object } => write!(
                f,
                "the cut through `{}` has too many points: the section has no cap and no hatching \
                 there",
                visible_excerpt(object)
            ),
            Self::SectionMisses { number } => {
                write!(f, "section {number} cuts nothing: its plane misses the models")
            }
            Self::SectionRemovesAll { number } => write!(
                f,
                "section {number} would remove everything: all models are on the removed side of \
                 its plane"
            ),
            Self::CutOutsDrawnWhole => f.write_str(
                "textures cut shapes such as leaves out of some faces: lines show the edges of the \
                 whole faces",
            ),
            Self::CrowdApproximated => f.write_str(
                "so many surfaces overlap that lines behind gaps of a pixel or two are omitted: \
                 `--no-line-limits` draws them, but may take a long time",
            ),
            Self::IntersectionsIncomplete => f.write_str(
                "so many faces may intersect that not all were compared: \
                 some intersection edges may be missing",
            ),
            Self::HatchingIncomplete => f.write_str(
                "there are too many hatch lines, so some are missing: increase the spacing",
            ),
            Self::VisibilityIncomplete => f.write_str(
                "too many faces overlap to compare every line with every face, so some hidden \
                 lines are drawn: remove parts of the model, or simplify its meshes",
            ),
        }
    }
}
