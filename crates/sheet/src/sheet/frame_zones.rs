//! Sheet zones (ISO 5457): a border with letters and numbers that identify positions on the sheet.
//! Trimming marks show where to cut the paper.
//!
//! ```text
//!      │  1  │  2  │  3  │  4  │
//!   ───┌─────┴─────┼─────┴─────┐───
//!    A │           │           │ A     zones of 50 mm, counted from the middle of each
//!   ───┤           │           ├───    side; the corner zones take up the rest
//!    B │           │           │ B
//! ```

use super::frame::{area_within_frame, rectangle_outline};
use super::rectangle_from_size;
use glam::DVec2;
use page::{Cap, Group, Ink, Join, Label, Layer, Pen, Polyline, TextAlign};
use viewport::{Paper, Rectangle};

/// The border around the drawing area of a sheet.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum SheetFrame {
    /// A line, with a centering mark in the middle of each side.
    #[default]
    Plain,
    /// A line with centering marks, zones with letters and numbers, and trimming marks at the
    /// corners of the paper.
    Zones,
}

/// The width of the border with letters and numbers, in millimeters.
pub(super) const ZONE_BORDER: f64 = 5.0;

/// The length of a zone in millimeters.
const ZONE_LENGTH: f64 = 50.0;

/// The height of letters and numbers in millimeters.
const LETTER_HEIGHT: f64 = 3.5;

/// The width of the lines between zones in millimeters.
const LINE_WIDTH: f64 = 0.35;

/// The side lengths, in millimeters, of the two rectangles that form a trimming mark.
const TRIMMING_MARK: [f64; 2] = [10.0, 5.0];

/// The maximum side length, in millimeters, of paper that has numbers only along the top and
/// letters only on the right.
const SMALL_PAPER: f64 = 300.0;

/// The row letters, without I and O, which look like digits.
const ROW_LETTERS: &[u8] = b"ABCDEFGHJKLMNPQRSTUVWXYZ";

/// Returns the zone borders along a side: the frame, and multiples of 50 mm from the middle of the
/// paper.
fn zone_borders(side: f64, [from, to]: [f64; 2]) -> Vec<f64> {
    let count = libm::round(0.5 * side / ZONE_LENGTH).max(1.0) as u32;
    let inner =
        (1..2 * count).map(|k| 0.5 * side + (f64::from(k) - f64::from(count)) * ZONE_LENGTH);
    let inner = inner.filter(|at| *at > from && *at < to);
    core::iter::once(from).chain(inner).chain(core::iter::once(to)).collect()
}

/// Returns the name of a zone's row: A to Z without I and O, then AA and so on.
fn row_letter(index: usize) -> String {
    let letter = char::from(ROW_LETTERS[index % ROW_LETTERS.len()]);
    letter.to_string().repeat(1 + index / ROW_LETTERS.len())
}

/// Returns the zone border with its lines and names, and the trimming marks.
pub(super) fn zone_layers(paper: Paper, ink: Ink) -> Vec<Layer> {
    let frame = area_within_frame(paper);
    let butt = Pen { cap: Cap::Butt, join: Join::Miter, ..Pen::solid(LINE_WIDTH, ink) };
    let mut lines = Layer::new("frame-zones", "frame: zones", butt.clone());
    let mut names =
        Layer::new("frame-zone-names", "frame: zone names", Pen::solid(LINE_WIDTH, ink));
    let outer = rectangle_from_size(
        frame.x() - ZONE_BORDER,
        frame.y() - ZONE_BORDER,
        frame.width() + 2.0 * ZONE_BORDER,
        frame.height() + 2.0 * ZONE_BORDER,
    );
    let mut strokes = vec![rectangle_outline(outer)];
    let is_small = paper.width().max(paper.height()) <= SMALL_PAPER;
    for axis in 0..2 {
        let (low, high, side) = side_of(frame, paper, axis);
        let borders = zone_borders(side, [low[axis], high[axis]]);
        for far in [false, true] {
            // Numbers are along the top, letters on the right.
            if is_small && far == (axis == 0) {
                continue;
            }
            let edge = if far { high[1 - axis] } else { low[1 - axis] };
            let outward = if far { ZONE_BORDER } else { -ZONE_BORDER };
            let at = |along: f64, across: f64| {
                if axis == 0 { DVec2::new(along, across) } else { DVec2::new(across, along) }
            };
            // The first and last borders are the corners of the frame.
            for border in &borders[1..borders.len() - 1] {
                let ends = [at(*border, edge), at(*border, edge + outward)];
                strokes.extend(Polyline::through_points(&ends, false));
            }
            for (index, pair) in borders.windows(2).enumerate() {
                let name = if axis == 0 { (index + 1).to_string() } else { row_letter(index) };
                let middle = at(0.5 * (pair[0] + pair[1]), edge + 0.5 * outward);
                let anchor = middle + DVec2::Y * (0.5 * LETTER_HEIGHT);
                let label = Label::new(&name, anchor, LETTER_HEIGHT).with_align(TextAlign::Middle);
                names.groups.push(label.group());
            }
        }
    }
    lines.groups.push(Group { strokes, ..Group::default() });
    vec![lines, names, trimming_marks(paper, butt)]
}

/// Returns the corners of the frame, and the length of the paper along an axis.
fn side_of(frame: Rectangle, paper: Paper, axis: usize) -> (DVec2, DVec2, f64) {
    let low = DVec2::new(frame.x(), frame.y());
    let high = low + DVec2::new(frame.width(), frame.height());
    (low, high, [paper.width(), paper.height()][axis])
}

/// Returns the trimming marks: two rectangles in each corner, which show where to cut the paper.
fn trimming_marks(paper: Paper, pen: Pen) -> Layer {
    let size = DVec2::new(paper.width(), paper.height());
    let [long, short] = TRIMMING_MARK;
    let mut fills = Vec::new();
    for corner in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(DVec2::from) {
        let inward = DVec2::ONE - corner * 2.0;
        let at = |x: f64, y: f64| size * corner + inward * DVec2::new(x, y);
        // Both rectangles form one outline, because their overlap would not be filled otherwise.
        let outline = [
            at(0.0, 0.0),
            at(long, 0.0),
            at(long, short),
            at(short, short),
            at(short, long),
            at(0.0, long),
        ];
        fills.extend(Polyline::through_points(&outline, true));
    }
    let mut layer = Layer::new("frame-trimming", "trimming marks", pen);
    layer.groups.push(Group { fills, ..Group::default() });
    layer
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zone_counts_match_the_standard() {
        // ISO 5457, table 2: the zone counts along the longer and the shorter side.
        for (paper, counts) in [
            (Paper::A0, [24, 16]),
            (Paper::A1, [16, 12]),
            (Paper::A2, [12, 8]),
            (Paper::A3, [8, 6]),
            (Paper::A4, [6, 4]),
        ] {
            let frame = area_within_frame(paper);
            let (low, high, _) = side_of(frame, paper, 0);
            let along = zone_borders(paper.height(), [low.y, high.y]).len() - 1;
            let across = zone_borders(paper.width(), [low.x, high.x]).len() - 1;
            assert_eq!([along, across], counts, "{paper:?}");
        }
        // Borders are multiples of 50 mm from the middle of the paper.
        let borders = zone_borders(297.0, [20.0, 287.0]);
        assert_eq!(borders, [20.0, 48.5, 98.5, 148.5, 198.5, 248.5, 287.0]);
        assert_eq!([0, 7, 8, 13, 24].map(row_letter), ["A", "H", "J", "P", "AA"]);
    }

    #[test]
    fn small_paper_has_zone_names_only_at_the_top_and_right() {
        let names = |paper| zone_layers(paper, [0; 3])[1].groups.len();
        assert_eq!(names(Paper::A4), 6 + 4);
        assert_eq!(names(Paper::A3.rotated()), 2 * (8 + 6));
    }
}
