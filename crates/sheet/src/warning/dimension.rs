//! The reasons why dimensions are missing.

use camera::NamedView;
use core::fmt;

/// The reason why a dimension is not on the sheet.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
#[non_exhaustive]
pub enum DimensionFault {
    /// The requested view is not on the sheet.
    NoSuchView(NamedView),
    /// The requested view foreshortens the dimension; another view may show its true size.
    Foreshortened {
        /// The requested view.
        view: NamedView,
        /// A view on the sheet that shows the true size.
        shown_in: Option<NamedView>,
    },
    /// No view on the sheet shows the true size of the dimension.
    NowhereTrue,
    /// A section removes the measured points.
    CutAway,
    /// The points coincide in the direction of measurement, or the angle is 0 or 180 degrees.
    NoExtent,
    /// There is no room for the dimension's number.
    NoRoom,
}

impl fmt::Display for DimensionFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchView(view) => write!(f, "there is no {view} view"),
            Self::Foreshortened { view, shown_in } => {
                write!(f, "the {view} view does not show its true size")?;
                match shown_in {
                    Some(other) => write!(f, ", but the {other} view does"),
                    None => f.write_str(", and no other view does"),
                }
            }
            Self::NowhereTrue => f.write_str("no view on the sheet shows its true size"),
            Self::CutAway => f.write_str("a section removes the points it measures"),
            Self::NoExtent => f.write_str("there is nothing to measure between its points"),
            Self::NoRoom => f.write_str("there is no room for its number"),
        }
    }
}
