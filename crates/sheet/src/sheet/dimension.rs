//! Linear dimensions (ISO 129-1): extension lines, a dimension line with arrowheads, and the length
//! above it.
//!
//! ```text
//!      │        150        │      extension lines on both sides,
//!      │◄─────────────────►│      the dimension line between them
//!      │                   │
//!      ┌───────────────────┐      the outline of the object
//! ```
//!
//! Extension lines begin slightly away from the outline and end slightly beyond the dimension line.
//! Arrows that do not fit between the extension lines are placed outside.
//!
//! All distances are multiples of the character height.

use super::annotation::{AnnotationLayer, AnnotationShape, AnnotationText, ViewAnnotations};
use super::length_format::LengthFormat;
use glam::DVec2;
use page::{Label, TextAlign};
use viewport::DrawingScale;

/// The distance from the outline to the dimension line.
pub(super) const LINE_DISTANCE: f64 = 2.4;

/// The distance from the outline to the start of the extension line.
pub(super) const EXTENSION_GAP: f64 = 0.25;

/// The length of an extension line beyond the dimension line.
pub(super) const EXTENSION_OVERHANG: f64 = 0.5;

/// The length of an arrowhead; it is a third as wide.
pub(super) const ARROW_LENGTH: f64 = 0.9;

/// The distance from the dimension line to the text above it.
pub(super) const TEXT_GAP: f64 = 0.35;

/// The side of a view on which an overall dimension is placed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum OverallSide {
    Above,
    Below,
    Left,
}

/// A dimension between two points of an outline.
struct LinearDimension {
    ends: [DVec2; 2],
    /// The unit vector from the outline to the dimension line.
    outward: DVec2,
    /// The distance from the outline to the dimension line, in millimeters.
    distance: f64,
    /// The length of the object in millimeters.
    length: f64,
}

/// Adds the overall dimensions of a view. `half` is half the size of the object in the view.
///
/// A direction in which the object has no extent gets no dimension.
pub(super) fn add_overall_dimensions(
    annotations: &mut ViewAnnotations,
    sides: &[OverallSide],
    half: DVec2,
    settings: &DimensionSettings,
) {
    for side in sides {
        let dimension = overall_dimension(*side, half, &settings.beyond(annotations, *side, half));
        if dimension.length > 1e-3 {
            dimension.annotate(annotations, settings);
        }
    }
}

/// Settings shared by the dimensions of a sheet.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct DimensionSettings {
    /// The character height in millimeters.
    pub(super) letters: f64,
    /// The scale of the view.
    pub(super) scale: DrawingScale,
    /// The format of the lengths.
    pub(super) format: LengthFormat,
    /// The space around the outline for section lines and letters, in millimeters, or 0 if unused.
    pub(super) reserved: f64,
    /// The width and height that the image of the object lacks, in object millimeters: the part that
    /// a broken view omits, and the distance between facets and circles.
    pub(super) not_shown: DVec2,
}

impl DimensionSettings {
    /// Returns the settings of an overall dimension placed beyond the other dimensions on its side.
    fn beyond(&self, annotations: &ViewAnnotations, side: OverallSide, half: DVec2) -> Self {
        let [low, high] = annotations.extent_of_dimensions([-half, half]);
        let taken = match side {
            OverallSide::Above => -half.y - low.y,
            OverallSide::Below => high.y - half.y,
            OverallSide::Left => -half.x - low.x,
        };
        let reserved = if taken > 0.0 { taken.max(self.reserved) } else { self.reserved };
        Self { reserved, ..*self }
    }
}

impl OverallSide {
    /// Returns the unit vector from the object to the dimension line.
    pub(super) const fn outward(self) -> DVec2 {
        match self {
            Self::Above => DVec2::NEG_Y,
            Self::Below => DVec2::Y,
            Self::Left => DVec2::NEG_X,
        }
    }
}

/// Returns the dimension of the object's whole extent along one side.
fn overall_dimension(
    side: OverallSide,
    half: DVec2,
    settings: &DimensionSettings,
) -> LinearDimension {
    let DimensionSettings { letters, scale, reserved, .. } = *settings;
    let corner = |x: f64, y: f64| half * DVec2::new(x, y);
    let (ends, outward) = match side {
        OverallSide::Above => ([corner(-1.0, -1.0), corner(1.0, -1.0)], -DVec2::Y),
        OverallSide::Below => ([corner(-1.0, 1.0), corner(1.0, 1.0)], DVec2::Y),
        OverallSide::Left => ([corner(-1.0, 1.0), corner(-1.0, -1.0)], -DVec2::X),
    };
    // If the outline is above the line, the text is between them.
    let text = if side == OverallSide::Below { 1.0 + TEXT_GAP } else { 0.0 };
    let distance = (LINE_DISTANCE * letters).max(reserved + (text + 0.5) * letters);
    let axis = usize::from(side == OverallSide::Left);
    let length = scale.to_object_length((ends[1] - ends[0]).length()) + settings.not_shown[axis];
    LinearDimension { ends, outward, distance, length }
}

impl LinearDimension {
    /// Returns the direction of the dimension line. The text runs along the line and is read from
    /// the bottom or the right of the sheet.
    fn line_direction(&self) -> DVec2 {
        (self.ends[1] - self.ends[0]).normalize_or(DVec2::X)
    }

    /// Returns the ends of the dimension line.
    fn dimension_line(&self) -> [DVec2; 2] {
        self.ends.map(|end| end + self.outward * self.distance)
    }

    /// Whether the arrows fit between the extension lines.
    fn fits_arrows(&self, height: f64) -> bool {
        (self.ends[1] - self.ends[0]).length() > 3.5 * ARROW_LENGTH * height
    }

    /// Adds extension lines, a dimension line, arrowheads and text.
    ///
    /// Arrows that do not fit between the extension lines point inward from outside. The dimension
    /// line extends to these arrows, and farther if the text is also outside.
    fn annotate(&self, annotations: &mut ViewAnnotations, settings: &DimensionSettings) {
        let height = settings.letters;
        let text = settings.format.text(self.length);
        let [start, end] = self.dimension_line();
        let (along, arrow) = (self.line_direction(), ARROW_LENGTH * height);
        let outwards = if self.fits_arrows(height) { 0.0 } else { 2.0 * arrow };
        let width = Label::new(&text, DVec2::ZERO, height).width();
        // The text needs free space of a quarter of its height at each end.
        let is_outside = width > (self.ends[1] - self.ends[0]).length() - 0.5 * height;
        let tail = if is_outside { outwards + width } else { outwards };
        let layer = AnnotationLayer::Dimensions;
        for (outline, line) in self.ends.into_iter().zip([start, end]) {
            let from = outline + self.outward * (EXTENSION_GAP * height);
            let to = line + self.outward * (EXTENSION_OVERHANG * height);
            annotations.push_line(layer, [from, to]);
        }
        annotations.push_line(layer, [start - along * outwards, end + along * tail]);
        let inwards = if outwards > 0.0 { -1.0 } else { 1.0 };
        for (tip, into) in [(start, along * inwards), (end, -along * inwards)] {
            annotations.push(layer, AnnotationShape::Head(arrowhead(tip, into, arrow)));
        }
        // Text reads along the line, so "above" is to the left of the reading direction.
        let above = DVec2::new(along.y, -along.x) * (TEXT_GAP * height);
        let (anchor, align) = if is_outside {
            // The text must clear the extension line, which extends above the dimension line.
            let beyond = if outwards > 0.0 { outwards } else { 0.5 * height };
            (end + along * beyond + above, TextAlign::Start)
        } else {
            ((start + end) * 0.5 + above, TextAlign::Middle)
        };
        let text = AnnotationText { text, anchor, height, direction: along, align };
        annotations.push(AnnotationLayer::DimensionTexts, AnnotationShape::Text(text));
    }
}

/// Returns an arrowhead with its tip at `tip`. `into` is the direction from the tip to the base.
pub(super) fn arrowhead(tip: DVec2, into: DVec2, length: f64) -> [DVec2; 3] {
    let across = DVec2::new(-into.y, into.x) * (length / 6.0);
    let base = tip + into * length;
    [tip, base + across, base - across]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the overall dimension, at 1:1, of an object with the given half size.
    fn annotated(half: DVec2, side: OverallSide, reserved: f64) -> ViewAnnotations {
        let (scale, format) = (DrawingScale::STANDARD[5], LengthFormat::default());
        let settings =
            DimensionSettings { letters: 3.5, scale, format, reserved, not_shown: DVec2::ZERO };
        let mut annotations = ViewAnnotations::default();
        add_overall_dimensions(&mut annotations, &[side], half, &settings);
        annotations
    }

    #[test]
    fn narrow_dimensions_have_arrows_outside() {
        let span = |half: f64| {
            let object = [DVec2::ZERO; 2];
            let annotations = annotated(DVec2::splat(half), OverallSide::Above, 0.0);
            annotations.extent_with(object).map(|corner| corner.x)
        };
        assert_eq!(span(20.0), [-20.0, 20.0]);
        let [low, high] = span(2.0);
        assert!(low < -7.0 && high > 7.0, "{low} {high}");
    }

    #[test]
    fn dimension_lines_leave_room_for_cut_lines() {
        let object = [DVec2::splat(-20.0), DVec2::splat(20.0)];
        for (side, axis) in [(OverallSide::Above, 1), (OverallSide::Left, 0)] {
            let low = |reserved| annotated(object[1], side, reserved).extent_with(object)[0][axis];
            assert!(low(0.0) > -20.0 - 14.0, "{side:?}");
            assert!(low(12.0) < -20.0 - 12.0 - 3.5, "{side:?}");
        }
        let below = annotated(object[1], OverallSide::Below, 12.0).extent_with(object)[1].y;
        assert!(below > 20.0 + 12.0 + 3.5, "{below}");
    }
}
