//! Palette: the ink colors of drawings, overlays and charts, as sRGB bytes.
//!
//! Technical sheets are drawn in pure [`BLACK`]; pictures and teaching material use the softer
//! [`INK`]. Axis colors follow convention: x is red, y is green and z is blue.

use super::page::Ink;

/// The ink of technical sheets.
pub const BLACK: Ink = [0, 0, 0];

/// White paper.
pub const WHITE: Ink = [255; 3];

/// The paper of blueprints.
pub const BLUEPRINT_BLUE: Ink = [29, 66, 121];

/// The pencil color of sketches.
pub const GRAPHITE: Ink = [68, 66, 64];

/// The ink of line drawings, charts and captions on light paper.
pub const INK: Ink = [26, 31, 38];

/// The ink of line drawings on dark paper.
pub const LIGHT_INK: Ink = [240, 243, 246];

/// The ink of outlines over shaded surfaces.
pub const OUTLINE: Ink = [20, 24, 30];

/// The ink of the x axis, errors and failures.
pub const RED: Ink = [179, 38, 30];

/// The ink of the y axis.
pub const GREEN: Ink = [30, 122, 52];

/// The ink of the z axis, view volumes and correct results.
pub const BLUE: Ink = [26, 86, 176];

/// The ink of the horizon.
pub const BROWN: Ink = [140, 90, 20];

/// The ink of frames and ground grids.
pub const GRAY: Ink = [150, 156, 163];

/// The ink of grid lines in charts.
pub const LIGHT_GRAY: Ink = [222, 225, 229];

/// Returns an ink that contrasts with the paper: light ink on dark paper, dark ink otherwise.
///
/// Paper is dark if its luma (Rec. 601 weights) is below 118 of 255.
#[must_use]
pub fn ink_on_paper(paper: Option<Ink>) -> Ink {
    let is_dark = paper.is_some_and(|[r, g, b]| {
        let [r, g, b] = [r, g, b].map(u32::from);
        r * 299 + g * 587 + b * 114 < 118_000
    });
    if is_dark { LIGHT_INK } else { INK }
}
