//! Warnings about elements that are missing from assembly pages.

use core::fmt;
use files::{counted, visible_excerpt};

/// An element that is missing from the assembly pages. Its `Display` text gives the reason.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
#[non_exhaustive]
pub enum AssemblyWarning {
    /// The models have no lines or triangles.
    NoParts,
    /// The mass of a part cannot be computed from its density.
    MassUnknown {
        /// The name of the part.
        part: String,
    },
    /// Part names contain characters that are missing from the stroke font.
    NamesUnreadable {
        /// The first such name.
        name: String,
        /// The number of such names.
        count: usize,
    },
    /// Parts are hidden in the assembly view and have no balloons.
    NotVisible {
        /// The number of the first such item in the list.
        number: usize,
        /// Its name.
        part: String,
        /// The number of items without a visible part.
        count: usize,
    },
    /// Balloons do not fit around the assembly view.
    BalloonsLeftOut {
        /// The number of the first such balloon.
        number: usize,
        /// The number of such balloons.
        count: usize,
    },
    /// There are too many parts for an exploded view.
    TooManyPartsToExplode {
        /// The maximum number of parts.
        most: usize,
    },
    /// There are too many parts to draw a sheet for each part.
    PartSheetsLeftOut {
        /// The number of parts without a sheet.
        count: usize,
    },
}

impl fmt::Display for AssemblyWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoParts => f.write_str(
                "there are no parts to list or number: the models have no lines or triangles",
            ),
            Self::MassUnknown { part } => write!(
                f,
                "the mass of `{}` is unknown: its mesh is not closed, so its volume is undefined",
                visible_excerpt(part)
            ),
            Self::NamesUnreadable { name, count } => write!(
                f,
                "the drawing font lacks characters in {} in the parts list, such as \
                 \"{}\": boxes are drawn instead",
                counted(*count, "name", "names"),
                visible_excerpt(name)
            ),
            Self::NotVisible { number, part, count } => write!(
                f,
                "{} no balloon, such as item {number}, `{}`: it is not visible in the \
                 assembly view, because other parts hide it or its size is zero; an exploded view, \
                 or another axonometric view, may show it",
                counted(*count, "item has", "items have"),
                visible_excerpt(part)
            ),
            Self::BalloonsLeftOut { number, count } => write!(
                f,
                "{} no room around the view, starting with number {number}: use larger \
                 paper",
                counted(*count, "balloon has", "balloons have")
            ),
            Self::TooManyPartsToExplode { most } => write!(
                f,
                "the assembly has more than {most} parts, so it is not exploded: draw only part \
                 of the model"
            ),
            Self::PartSheetsLeftOut { count } => write!(
                f,
                "there are too many parts for part sheets: the last {} none",
                counted(*count, "item has", "items have")
            ),
        }
    }
}
