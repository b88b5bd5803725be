//! Scale bar: a graphic scale that stays correct when a sheet is enlarged or reduced.
//!
//! ```text
//!   ┌────┬────┬─────────┐
//!   │████│    │█████████│      0 to a round length of the object
//!   └────┴────┴─────────┘
//!   0              100 mm
//! ```
//!
//! A scale such as 1:50 in the title block is wrong on a copy of a different size, but a bar
//! printed with the drawing scales with it.

use super::{Sheet, rectangle_from_size};
use glam::DVec2;
use page::{Cap, Group, Ink, Join, Label, Layer, Pen, Polyline, TextAlign};
use viewport::{DrawingScale, Rectangle};

/// The maximum length of the bar, in millimeters on paper.
const MAX_BAR_LENGTH: f64 = 60.0;

/// The height of the bar in millimeters.
const BAR_HEIGHT: f64 = 1.2;

/// The height of the bar's labels, as a multiple of the sheet's lettering height.
const LABEL_HEIGHT_FACTOR: f64 = 0.7;

/// The number of segments; every other one is filled.
const BAR_SEGMENTS: u32 = 4;

/// Returns the possible areas for the bar and its labels. The first is in the lower left corner of
/// the frame, or above the title block if the block is nearly as wide as the frame. The second is
/// above the title block on the right.
pub(super) fn scale_bar_areas(sheet: &Sheet) -> [Rectangle; 2] {
    let (frame, block) = (sheet.drawing_area(), sheet.title_block_area());
    let letters = sheet.lettering_height() * LABEL_HEIGHT_FACTOR;
    let (width, height) =
        (MAX_BAR_LENGTH.min(frame.width() * 0.5) + 16.0, BAR_HEIGHT + letters + 6.0);
    let is_beside = block.x() - frame.x() > width;
    let bottom = if is_beside { frame.y() + frame.height() } else { block.y() };
    let right = frame.x() + frame.width() - width;
    [
        rectangle_from_size(frame.x(), bottom - height, width, height),
        rectangle_from_size(right, block.y() - height, width, height),
    ]
}

/// Returns the layers of the bar in its area, at a scale, with lengths below it.
pub(super) fn scale_bar_layers(
    sheet: &Sheet,
    area: Rectangle,
    scale: DrawingScale,
    ink: Ink,
) -> [Layer; 2] {
    let letters = sheet.lettering_height() * LABEL_HEIGHT_FACTOR;
    let unit = sheet.dimension_unit;
    // Labels extend beyond both ends of the bar.
    let most = scale.to_object_length(area.width() - 16.0);
    let thing = round_length(most / unit.in_millimeters());
    let length = scale.to_paper_length(thing * unit.in_millimeters());
    let corner = DVec2::new(area.x() + 6.0, area.y() + 1.0);
    let pen = Pen { cap: Cap::Butt, join: Join::Miter, ..Pen::solid(0.18, ink) };
    let mut layer = Layer::new("scale-bar", "scale bar", pen);
    let mut bar = Group { strokes: vec![bar_segment(corner, 0.0, length)], ..Group::default() };
    let step = length / f64::from(BAR_SEGMENTS);
    let filled =
        (0..BAR_SEGMENTS).step_by(2).map(|at| bar_segment(corner, f64::from(at) * step, step));
    bar.fills.extend(filled);
    layer.groups.push(bar);
    let mut texts = Layer::new("scale-bar-text", "scale bar: text", Pen::solid(0.18, ink));
    for (text, x) in [("0".to_owned(), 0.0), (sheet.length_format().text_with_unit(thing), length)]
    {
        let at = corner + DVec2::new(x, BAR_HEIGHT + 1.2 + letters);
        let label = Label::new(&text, at, letters).with_align(TextAlign::Middle);
        texts.groups.push(label.group());
    }
    [layer, texts]
}

/// Returns a segment of the bar as a rectangle.
fn bar_segment(corner: DVec2, from: f64, length: f64) -> Polyline {
    let low = corner + DVec2::new(from, 0.0);
    let corners = [
        low,
        low + DVec2::new(length, 0.0),
        low + DVec2::new(length, BAR_HEIGHT),
        low + DVec2::new(0.0, BAR_HEIGHT),
    ];
    Polyline::through_points(&corners, true)
        .unwrap_or(Polyline { points: vec![[0, 0], [1, 0]], closed: false })
}

/// Returns the largest length of the form 1, 2 or 5 · 10ⁿ that is at most `most`.
///
/// Lengths below 1 are computed as 1 / integer, so that labels show no rounding errors.
fn round_length(most: f64) -> f64 {
    let mut power = 1e-6;
    while power * 10.0 <= most {
        power *= 10.0;
    }
    let fits = |factor: &&f64| **factor * power <= most * (1.0 + 1e-9);
    let rounded = [5.0, 2.0, 1.0].iter().find(fits).map_or(power, |factor| factor * power);
    // Powers of ten below 1 are inexact in binary, and labels print all digits.
    if rounded < 1.0 { 1.0 / libm::round(1.0 / rounded) } else { libm::round(rounded) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_round() {
        for (most, round) in
            [(60.0, 50.0), (3000.0, 2000.0), (1.2, 1.0), (0.6, 0.5), (10.0, 10.0), (4.99, 2.0)]
        {
            assert_eq!(round_length(most), round);
        }
    }
}
