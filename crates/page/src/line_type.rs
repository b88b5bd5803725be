//! Line types and widths for technical drawings: ISO 128-2:2020 (parts 20 and 24 in 1996).
//!
//! ```text
//!  01.2  continuous wide      ━━━━━━━━━━━━━━━━━━━━━━   visible edges and outlines
//!  01.1  continuous narrow    ──────────────────────   tangent edges, dimensions, hatching
//!  02.1  dashed narrow        ─────  ─────  ─────  ─   hidden edges: dash 12 d, gap 3 d
//!  04.1  chain narrow         ───────── · ───────── ·  axes: dash 24 d, gap 3 d, dot ½ d, gap 3 d
//! ```
//!
//! Lengths are multiples of the line width d. Wide lines are twice as wide as narrow lines. Widths
//! form a series with ratio √2, like paper sizes, so a drawing reduced from A3 to A4 still has
//! widths from the series.

use super::page::{Cap, Ink, Join, Pen};

/// The line widths of the series, in millimeters.
const WIDTH_SERIES: [f64; 9] = [0.13, 0.18, 0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0];

/// A line group of ISO 128: a wide, a lettering and a narrow width. It is named after the wide
/// width.
///
/// ```
/// use page::IsoLineGroup;
///
/// let group = IsoLineGroup::from_wide_width(0.7).expect("a width of the series");
/// let widths = [group.wide_width(), group.lettering_width(), group.narrow_width()];
/// assert_eq!(widths, [0.7, 0.5, 0.35]);
/// assert_eq!(IsoLineGroup::from_wide_width(0.6), None);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct IsoLineGroup {
    /// The index of the wide width in the series, at least 2.
    wide_index: usize,
}

impl IsoLineGroup {
    /// 0.35 mm and 0.18 mm, for small sheets.
    pub const MM_0_35: Self = Self { wide_index: 3 };
    /// 0.5 mm and 0.25 mm, the preferred group.
    pub const MM_0_5: Self = Self { wide_index: 4 };
    /// 0.7 mm and 0.35 mm, for large sheets.
    pub const MM_0_7: Self = Self { wide_index: 5 };

    /// Returns the group whose wide lines have this width in millimeters: 0.25, 0.35, 0.5, 0.7, 1,
    /// 1.4 or 2. Returns `None` for any other width.
    #[must_use]
    pub fn from_wide_width(wide: f64) -> Option<Self> {
        let found = WIDTH_SERIES.iter().position(|&width| (width - wide).abs() < 1e-9)?;
        (found >= 2).then_some(Self { wide_index: found })
    }

    /// Returns the width of wide lines in millimeters.
    #[must_use]
    pub fn wide_width(self) -> f64 {
        WIDTH_SERIES[self.wide_index]
    }

    /// Returns the stroke width of lettering in millimeters, between the wide and narrow widths.
    #[must_use]
    pub fn lettering_width(self) -> f64 {
        WIDTH_SERIES[self.wide_index - 1]
    }

    /// Returns the width of narrow lines in millimeters.
    #[must_use]
    pub fn narrow_width(self) -> f64 {
        WIDTH_SERIES[self.wide_index - 2]
    }
}

/// An ISO 128 line type, with its number in the standard.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum LineType {
    /// 01: without gaps.
    Continuous,
    /// 02: dashes.
    Dashed,
    /// 04: long dashes, with a dot between them.
    LongDashedDotted,
    /// 05: long dashes, with two dots between them.
    LongDashedDoubleDotted,
}

impl LineType {
    /// Returns the alternating lengths of dashes and gaps, in millimeters, for a line of the given
    /// width. The result is empty for a continuous line.
    #[must_use]
    pub fn dash_pattern(self, width: f64) -> Vec<f64> {
        let in_widths: &[f64] = match self {
            Self::Continuous => &[],
            Self::Dashed => &[12.0, 3.0],
            Self::LongDashedDotted => &[24.0, 3.0, 0.5, 3.0],
            Self::LongDashedDoubleDotted => &[24.0, 3.0, 0.5, 3.0, 0.5, 3.0],
        };
        in_widths.iter().map(|length| length * width).collect()
    }

    /// Creates a pen of this type. Dashes get butt caps, because round caps would make them longer
    /// than in the pattern.
    #[must_use]
    pub fn to_pen(self, width: f64, ink: Ink, cap: Cap, join: Join) -> Pen {
        let cap = if self == Self::Continuous { cap } else { Cap::Butt };
        Pen { width, ink, dashes: self.dash_pattern(width), cap, join }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_groups_follow_the_standard() {
        let of = |wide: f64| {
            IsoLineGroup::from_wide_width(wide)
                .map(|g| [g.wide_width(), g.lettering_width(), g.narrow_width()])
        };
        assert_eq!(of(0.25), Some([0.25, 0.18, 0.13]));
        assert_eq!(of(0.5), Some([0.5, 0.35, 0.25]));
        assert_eq!(of(0.7), Some([0.7, 0.5, 0.35]));
        assert_eq!(of(2.0), Some([2.0, 1.4, 1.0]));
        assert_eq!((of(0.18), of(0.4), of(f64::NAN)), (None, None, None));
        // The ratio of the series is √2, rounded to the widths of technical pens.
        for pair in WIDTH_SERIES.windows(2) {
            assert!((pair[1] / pair[0] - core::f64::consts::SQRT_2).abs() < 0.05, "{pair:?}");
        }
    }

    #[test]
    fn dashes_are_twelve_widths_long() {
        assert_eq!(LineType::Dashed.dash_pattern(0.25), [3.0, 0.75]);
        assert_eq!(LineType::LongDashedDotted.dash_pattern(0.5), [12.0, 1.5, 0.25, 1.5]);
        let pen = LineType::Dashed.to_pen(0.25, [0; 3], Cap::Round, Join::Round);
        assert_eq!((pen.cap, pen.join), (Cap::Butt, Join::Round));
    }
}
