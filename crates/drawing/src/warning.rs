//! What a drawing could not show as it should: told to whoever asked for it.

use core::fmt;

/// What a drawing leaves out, and why.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
#[non_exhaustive]
pub enum Warning {
    /// The cut through an object does not close.
    SectionOpen {
        /// The object.
        object: String,
    },
    /// The cut through an object has too many points for a cap.
    SectionTooComplex {
        /// The object.
        object: String,
    },
    /// The style shows surfaces, and only line drawings are cut open.
    SectionsIgnored,
    /// Only pixels have viewports.
    ViewportsIgnored,
    /// Not all crossings of surfaces were looked for.
    IntersectionsIncomplete,
    /// Not all of the hatching was drawn.
    HatchingIncomplete,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SectionOpen { object } => write!(
                f,
                "the cut through `{object}` does not close, for its surface is open: it has no cap and no hatching there"
            ),
            Self::SectionTooComplex { object } => write!(
                f,
                "the cut through `{object}` has too many points: it has no cap and no hatching"
            ),
            Self::SectionsIgnored => f.write_str(
                "sections cut line drawings only: this style shows the models whole; choose another, such as `--style lines`",
            ),
            Self::ViewportsIgnored => f.write_str(
                "only PNG pictures have viewports and pairs of eyes: this one shows the scene's own camera alone",
            ),
            Self::IntersectionsIncomplete => f.write_str(
                "so many surfaces may cross that not all were compared: some lines where they cross may be missing",
            ),
            Self::HatchingIncomplete => {
                f.write_str("there is too much hatching: some of it is missing; make it wider")
            }
        }
    }
}
