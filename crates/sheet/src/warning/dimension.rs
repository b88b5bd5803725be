//! Why a dimension is left out.

use camera::NamedView;
use core::fmt;

/// Why a dimension is not on the sheet.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
#[non_exhaustive]
pub enum DimensionFault {
    /// The sheet does not have the view.
    NoSuchView(NamedView),
    /// The view that was asked for foreshortens it; another view of the sheet may show it true.
    Foreshortened {
        /// The view that was asked for.
        view: NamedView,
        /// A view that shows it true.
        shown_in: Option<NamedView>,
    },
    /// No view of the sheet shows it true.
    NowhereTrue,
    /// A section removes what it measures.
    CutAway,
    /// The points coincide in the direction of measurement, or the angle is 0 or 180 degrees.
    NoExtent,
    /// There is no free place for its number.
    NoRoom,
}

impl fmt::Display for DimensionFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchView(view) => write!(f, "there is no {view} view"),
            Self::Foreshortened { view, shown_in } => {
                write!(f, "the {view} view does not show it true")?;
                match shown_in {
                    Some(other) => write!(f, ", but the {other} view does"),
                    None => f.write_str(", and no other view does"),
                }
            }
            Self::NowhereTrue => f.write_str("no view of the sheet shows it true"),
            Self::CutAway => f.write_str("a section removes what it measures"),
            Self::NoExtent => f.write_str("there is nothing to measure between its points"),
            Self::NoRoom => f.write_str("there is no free place for its number"),
        }
    }
}
