//! Warnings about missing or incomplete parts of a sheet.

mod assembly;
mod dimension;

pub use assembly::AssemblyWarning;
use core::cmp::Ordering;
use core::fmt;
pub use dimension::DimensionFault;
use drawing::Warning;
use files::visible_excerpt;

/// An element that is missing from a sheet or could not be computed. Its `Display` text gives the
/// reason.
///
/// Warnings are sorted, and each is reported once; see [`Warning`].
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum SheetWarning {
    /// A warning from a drawing on the sheet.
    Drawing(Warning),
    /// No principal view of a sheet sees a section plane face-on or edge-on.
    SectionOblique {
        /// The number of the section, from 1.
        number: usize,
    },
    /// A view does not fit on the sheet.
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
    /// No view on the sheet can show the line of a section.
    CutLineNotShown {
        /// The name of the section, such as `A-A`.
        section: String,
    },
    /// A view overlaps another view or the title block at its requested position.
    ViewOverlaps {
        /// The name of the view, such as `isometric view`.
        view: String,
        /// The other view, or the title block.
        other: String,
    },
    /// Sheets do not show this overlay of the scene.
    OverlayNotOnSheets {
        /// The kind of overlay, such as `grid`.
        overlay: String,
    },
    /// A point label or axis name is missing from a view.
    LabelNotInView {
        /// The text of the label.
        text: String,
        /// The name of the view, such as `front view`.
        view: String,
        /// The reason.
        fault: SheetLabelFault,
    },
    /// The style of the scene shows surfaces, but a sheet is a line drawing.
    StyleIgnored,
    /// A warning about the assembly pages.
    Assembly(AssemblyWarning),
    /// The models have no extent or only points, so no view has a line.
    NothingDrawn,
    /// Every view is smaller than a millimeter on paper.
    ViewsTiny,
}

/// The reason why a label is missing from a view.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum SheetLabelFault {
    /// The point is too far from the models.
    Far,
    /// The label would overlap something at every position.
    NoRoom,
    /// The view has too many labels.
    TooMany,
}

impl SheetWarning {
    /// Returns the position of the warning in a report, relative to [`Warning::report_order`].
    #[must_use]
    pub const fn report_order(&self) -> u8 {
        match self {
            Self::Drawing(warning) => warning.report_order(),
            Self::SectionOblique { .. } => 20,
            Self::ViewLeftOut { .. } => 21,
            Self::DimensionLeftOut { .. } => 22,
            Self::CutLineNotShown { .. } => 23,
            Self::ViewOverlaps { .. } => 24,
            Self::OverlayNotOnSheets { .. } => 25,
            Self::LabelNotInView { .. } => 26,
            Self::StyleIgnored => 41,
            Self::Assembly(_) => 50,
            Self::NothingDrawn => 90,
            Self::ViewsTiny => 91,
        }
    }

    /// Compares two warnings of the same kind.
    fn compare_values(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Self::Drawing(a), Self::Drawing(b)) => a.cmp(b),
            (Self::SectionOblique { number: a }, Self::SectionOblique { number: b }) => a.cmp(b),
            (
                Self::DimensionLeftOut { dimension, fault },
                Self::DimensionLeftOut { dimension: b, fault: c },
            ) => (dimension, fault).cmp(&(b, c)),
            (
                Self::LabelNotInView { text, view, fault },
                Self::LabelNotInView { text: b, view: c, fault: d },
            ) => (text, view, fault).cmp(&(b, c, d)),
            (Self::Assembly(a), Self::Assembly(b)) => a.cmp(b),
            _ => self.texts().cmp(&other.texts()),
        }
    }

    /// Returns the view, section and overlay names in a warning.
    fn texts(&self) -> [&str; 2] {
        match self {
            Self::ViewLeftOut { view: text }
            | Self::CutLineNotShown { section: text }
            | Self::OverlayNotOnSheets { overlay: text } => [text, ""],
            Self::ViewOverlaps { view, other } => [view, other],
            _ => ["", ""],
        }
    }
}

impl Ord for SheetWarning {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_kind = self.report_order().cmp(&other.report_order());
        by_kind.then_with(|| self.compare_values(other))
    }
}

impl PartialOrd for SheetWarning {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl From<Warning> for SheetWarning {
    fn from(warning: Warning) -> Self {
        Self::Drawing(warning)
    }
}

impl From<hidden_line::Warning> for SheetWarning {
    fn from(warning: hidden_line::Warning) -> Self {
        Self::Drawing(Warning::Lines(warning))
    }
}

impl fmt::Display for SheetWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Drawing(warning) => warning.fmt(f),
            Self::SectionOblique { number } => write!(
                f,
                "section {number} has no cut line and no separate view on the sheet: its plane is \
                 oblique to the front, top and side views, so only an axonometric view shows it"
            ),
            Self::ViewLeftOut { view } => write!(
                f,
                "there is no room for the {view}, so it is omitted: use larger paper or a smaller \
                 scale"
            ),
            Self::DimensionLeftOut { dimension, fault } => {
                write!(f, "{dimension} is not on the sheet: {fault}")
            }
            Self::CutLineNotShown { section } => write!(
                f,
                "no view on the sheet looks along the steps of section {section}, so its cut line \
                 is not shown"
            ),
            Self::ViewOverlaps { view, other } => write!(
                f,
                "the {view} overlaps the {other} at its requested position: move one of them, or \
                 choose a smaller scale"
            ),
            Self::OverlayNotOnSheets { overlay } => write!(
                f,
                "sheets show only labels and axes from the scene's overlays, not the {overlay}"
            ),
            Self::LabelNotInView { text, view, fault } => {
                write!(f, "the label \"{}\" is not in the {view}: {fault}", visible_excerpt(text))
            }
            Self::StyleIgnored => f.write_str(
                "sheets are line drawings and ignore the style of the scene: set their lines with \
                 `style: Lines(…)`",
            ),
            Self::Assembly(warning) => warning.fmt(f),
            Self::NothingDrawn => f.write_str(
                "the views are empty: the models have no lines or faces, or their size is zero",
            ),
            Self::ViewsTiny => f.write_str(
                "the views are smaller than a millimeter on paper: set the unit of the model, or a \
                 larger scale",
            ),
        }
    }
}

impl fmt::Display for SheetLabelFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Far => "its point is too far from the models; move it closer",
            Self::NoRoom => "there is no room for it; use larger paper, or fewer labels",
            Self::TooMany => "a view can have at most 100 labels; remove some",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hidden_line::Warning as Lines;

    /// The messages of all crates are interleaved in reading order.
    #[test]
    fn a_report_begins_with_sections_and_ends_with_limits() {
        let ordered = [
            Lines::SectionMisses { number: 2 }.into(),
            Lines::SectionMisses { number: 10 }.into(),
            SheetWarning::SectionOblique { number: 1 },
            SheetWarning::ViewLeftOut { view: "front view".to_owned() },
            SheetWarning::ViewLeftOut { view: "top view".to_owned() },
            Warning::ImagesNotInDxf.into(),
            SheetWarning::Assembly(AssemblyWarning::NoParts),
            Lines::CrowdApproximated.into(),
            Warning::OutlinesTraced.into(),
            Lines::HatchingIncomplete.into(),
            SheetWarning::ViewsTiny,
            Lines::VisibilityIncomplete.into(),
        ];
        let mut sorted = ordered.to_vec();
        sorted.reverse();
        sorted.sort_unstable();
        assert_eq!(sorted, ordered);
    }
}
