//! Linear dimensions (ISO 129-1): extension lines, a dimension line with arrowheads, and the length
//! above it.
//!
//! ```text
//!      │        150        │      extension lines at both sides,
//!      │◄─────────────────►│      the dimension line between them
//!      │                   │
//!      ┌───────────────────┐      the outline of the object
//! ```
//!
//! Extension lines begin a little beside the outline and end a little beyond the dimension line.
//! Arrows that do not fit between them are placed outside.
//!
//! All distances are multiples of the height of letters.

use super::Sheet;
use super::view_layout::ViewLayout;
use crate::{Group, Ink, Label, Layer, Pen, Polyline, TextAlign};
use camera::NamedView;
use glam::DVec2;

/// From the outline to the dimension line.
const LINE_DISTANCE: f64 = 2.4;

/// From the outline to the start of the extension line.
const EXTENSION_GAP: f64 = 0.25;

/// The length of an extension line beyond the dimension line.
const EXTENSION_OVERHANG: f64 = 0.5;

/// The length of an arrowhead; it is a third as wide.
const ARROW_LENGTH: f64 = 0.9;

/// From the dimension line to the text above it.
const TEXT_GAP: f64 = 0.35;

/// A length between two points of an outline, dimensioned on the side `outward` of it.
struct LinearDimension {
    ends: [DVec2; 2],
    /// The unit vector from the outline to the dimension line.
    outward: DVec2,
    /// The length of the object in millimeters.
    length: f64,
}

/// The overall width, height and depth of the object: a layer of lines and one of texts.
pub(super) fn overall_dimension_layers(
    sheet: &Sheet,
    layout: &ViewLayout<'_>,
    ink: Ink,
) -> Vec<Layer> {
    let height = sheet.lettering_height();
    let group = sheet.line_width_group();
    let lines = Pen { cap: crate::Cap::Butt, ..Pen::solid(group.narrow_width(), ink) };
    let mut lines = Layer::new("dimensions", "dimensions", lines);
    let mut texts =
        Layer::new("dimensions-text", "dimensions: text", Pen::solid(height * 0.1, ink));
    for dimension in overall_dimensions(layout, sheet.side_view) {
        let text = format_length(dimension.length);
        lines.groups.push(dimension.line_group(height, &text));
        texts
            .groups
            .push(Group { strokes: dimension.text_strokes(height, &text), ..Group::default() });
    }
    vec![lines, texts]
}

/// The dimensions of the front view in both directions, and of the side view's width; none where
/// there is no extent.
fn overall_dimensions(layout: &ViewLayout<'_>, side: NamedView) -> Vec<LinearDimension> {
    let scale = layout.scale;
    let horizontal = |name: NamedView| {
        let area = layout.view_area(name)?;
        let (left, right) = (area.x(), area.x() + area.width());
        let (y, out) = if layout.is_top_below {
            (area.y(), -DVec2::Y)
        } else {
            (area.y() + area.height(), DVec2::Y)
        };
        let ends = [DVec2::new(left, y), DVec2::new(right, y)];
        Some(LinearDimension { ends, outward: out, length: scale.to_object_length(area.width()) })
    };
    let vertical = |name: NamedView| {
        let area = layout.view_area(name)?;
        let (x, bottom) = (area.x(), area.y() + area.height());
        let ends = [DVec2::new(x, bottom), DVec2::new(x, area.y())];
        Some(LinearDimension {
            ends,
            outward: -DVec2::X,
            length: scale.to_object_length(area.height()),
        })
    };
    // A flat object has no dimension across.
    let all = [horizontal(NamedView::Front), vertical(NamedView::Front), horizontal(side)];
    all.into_iter().flatten().filter(|dimension| dimension.length > 1e-3).collect()
}

/// A length in millimeters: to a hundredth, from one meter on to a millimeter, without trailing
/// zeros.
fn format_length(length: f64) -> String {
    let decimals = if length < 1000.0 { 2 } else { 0 };
    let text = format!("{length:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

impl LinearDimension {
    /// The direction of the dimension line; its text reads along it from the bottom or from the
    /// right of the sheet.
    fn line_direction(&self) -> DVec2 {
        (self.ends[1] - self.ends[0]).normalize_or(DVec2::X)
    }

    /// The ends of the dimension line.
    fn dimension_line(&self, height: f64) -> [DVec2; 2] {
        self.ends.map(|end| end + self.outward * (LINE_DISTANCE * height))
    }

    /// Whether arrows and text fit between the extension lines.
    fn fits_arrows(&self, height: f64) -> bool {
        (self.ends[1] - self.ends[0]).length() > 3.5 * ARROW_LENGTH * height
    }

    /// Extension lines, dimension line and arrowheads.
    ///
    /// Arrows that do not fit between the extension lines point inward from outside, and the
    /// dimension line is extended to them, and on to a text that stands beside it.
    fn line_group(&self, height: f64, text: &str) -> Group {
        let [start, end] = self.dimension_line(height);
        let (along, arrow) = (self.line_direction(), ARROW_LENGTH * height);
        let outwards = if self.fits_arrows(height) { 0.0 } else { 2.0 * arrow };
        let tail = if self.is_text_outside(height, text) {
            outwards + self.unplaced_label(height, text).width()
        } else {
            outwards
        };
        let mut strokes: Vec<Polyline> = Vec::new();
        for (end, line) in self.ends.iter().zip([start, end]) {
            let from = *end + self.outward * (EXTENSION_GAP * height);
            strokes.extend(Polyline::through_points(
                &[from, line + self.outward * (EXTENSION_OVERHANG * height)],
                false,
            ));
        }
        strokes.extend(Polyline::through_points(
            &[start - along * outwards, end + along * tail.max(outwards)],
            false,
        ));
        let inwards = if outwards > 0.0 { -1.0 } else { 1.0 };
        let heads =
            [arrowhead(start, along * inwards, arrow), arrowhead(end, -along * inwards, arrow)];
        Group { strokes, fills: heads.into_iter().flatten().collect(), ..Group::default() }
    }

    /// Whether the text is wider than the dimension, so that it stands beside it.
    fn is_text_outside(&self, height: f64, text: &str) -> bool {
        let available = (self.ends[1] - self.ends[0]).length();
        self.unplaced_label(height, text).width() > available - 0.5 * height
    }

    /// The text in its direction, at the origin: to measure it, or to move it.
    fn unplaced_label<'a>(&self, height: f64, text: &'a str) -> Label<'a> {
        Label::new(text, DVec2::ZERO, height).with_direction(self.line_direction())
    }

    /// The strokes of the text: centered above the dimension line, or beyond its end.
    fn text_strokes(&self, height: f64, text: &str) -> Vec<Polyline> {
        let [start, end] = self.dimension_line(height);
        let along = self.line_direction();
        // Above the line in reading direction is to the left of it.
        let above = DVec2::new(along.y, -along.x) * (TEXT_GAP * height);
        let label = self.unplaced_label(height, text);
        let label = if self.is_text_outside(height, text) {
            let outwards = if self.fits_arrows(height) { 0.5 } else { 2.0 * ARROW_LENGTH };
            Label { anchor: end + along * (outwards * height) + above, ..label }
        } else {
            Label { anchor: (start + end) * 0.5 + above, align: TextAlign::Middle, ..label }
        };
        label.strokes()
    }
}

/// An arrowhead with this tip; `into` is the direction from the tip to the base.
fn arrowhead(tip: DVec2, into: DVec2, length: f64) -> Option<Polyline> {
    let across = DVec2::new(-into.y, into.x) * (length / 6.0);
    let base = tip + into * length;
    Polyline::through_points(&[tip, base + across, base - across], true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_no_trailing_zeros() {
        for (length, text) in [
            (150.0, "150"),
            (12.5, "12.5"),
            (0.126, "0.13"),
            (99.999, "100"),
            (12_345.6, "12346"),
            (4520.31, "4520"),
            (999.996, "1000"),
            (123.45, "123.45"),
            (100.0, "100"),
        ] {
            assert_eq!(format_length(length), text);
        }
    }

    #[test]
    fn narrow_dimensions_have_their_arrows_outside() {
        let of = |width: f64| LinearDimension {
            ends: [DVec2::new(50.0, 50.0), DVec2::new(50.0 + width, 50.0)],
            outward: -DVec2::Y,
            length: width,
        };
        let span = |dimension: &LinearDimension| {
            let points =
                dimension.line_group(3.5, "7").strokes.into_iter().flat_map(|line| line.points);
            points.fold([i32::MAX, i32::MIN], |[low, high], [x, _]| [low.min(x), high.max(x)])
        };
        assert_eq!(span(&of(40.0)), [50_000, 90_000]);
        let [low, high] = span(&of(4.0));
        assert!(low < 45_000 && high > 59_000, "{low} {high}");
    }
}
