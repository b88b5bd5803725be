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
    SectionTooFine {
        /// The object.
        object: String,
    },
    /// The style shows surfaces, and only line drawings are cut open.
    SectionsUnseen,
    /// Only pixels have viewports.
    ViewportsUnseen,
    /// Not all crossings of surfaces were looked for.
    CrossingsLeftOut,
    /// Not all of the hatching was drawn.
    HatchingLeftOut,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SectionOpen { object } => write!(
                f,
                "the cut through `{object}` does not close, for its surface is open: it has no cap and no hatching there"
            ),
            Self::SectionTooFine { object } => write!(
                f,
                "the cut through `{object}` has too many points: it has no cap and no hatching"
            ),
            Self::SectionsUnseen => f.write_str(
                "sections cut line drawings only: this style shows the models whole; choose another, such as `--style lines`",
            ),
            Self::ViewportsUnseen => f.write_str(
                "only PNG pictures have viewports and pairs of eyes: this one shows the scene's own camera alone",
            ),
            Self::CrossingsLeftOut => f.write_str(
                "so many surfaces may cross that not all were compared: some lines where they cross may be missing",
            ),
            Self::HatchingLeftOut => {
                f.write_str("there is too much hatching: some of it is missing; make it wider")
            }
        }
    }
}
