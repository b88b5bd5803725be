//! Angular dimensions: an arc between the sides of an angle, or between their extensions beyond the
//! vertex, labeled in degrees (ISO 129-1).
//!
//! ```text
//!        ╲  60°  ╱
//!         ╲◄───►╱
//!          ╲   ╱
//!           ╲ ╱
//! ```

use super::annotation::{AnnotationLayer, AnnotationShape, AnnotationText};
use super::dimension::{ARROW_LENGTH, EXTENSION_GAP, EXTENSION_OVERHANG, TEXT_GAP, arrowhead};
use super::dimension_board::{Candidate, DimensionBoard};
use super::measure::{ViewDimension, ViewMeasure};
use glam::DVec2;
use page::{Label, TextAlign};

/// The minimum radius of the arc and the step between radii, in character heights, and the number
/// of radii to try.
const RADII: (f64, f64, u32) = (4.0, 1.1, 60);

/// The maximum angle of one segment of an arc, 2.5 degrees in radians.
const ARC_STEP: f64 = core::f64::consts::PI / 72.0;

/// The number of decimal places of angles in degrees.
const DEGREE_DECIMALS: u32 = 2;

/// An arc between two directions from a vertex.
struct AngleArc<'a> {
    vertex: DVec2,
    /// The unit vectors along the sides of the angle. The turn from the first to the second is less
    /// than 180°, in the direction from x to y.
    sides: [DVec2; 2],
    /// The distances from the vertex to the ends of the measured sides; 0 for their extensions.
    lengths: [f64; 2],
    /// The angle in radians.
    sweep: f64,
    radius: f64,
    text: &'a str,
    letters: f64,
}

impl DimensionBoard {
    /// Returns the free position nearest to the vertex of the angle.
    pub(super) fn angle_candidate(&self, dimension: &ViewDimension) -> Option<Candidate> {
        let ViewMeasure::Angle { vertex, ends } = &dimension.measure else { return None };
        let ratio = self.settings.scale.ratio();
        let (vertex, mut ends) = (*vertex * ratio, ends.map(|end| end * ratio));
        // The ends are sorted so that the turn from the first to the second is below 180°.
        if (ends[0] - vertex).perp_dot(ends[1] - vertex) < 0.0 {
            ends.swap(0, 1);
        }
        let arms = ends.map(|end| end - vertex);
        let sweep = libm::atan2(arms[0].perp_dot(arms[1]), arms[0].dot(arms[1]));
        let decimals = dimension.decimals.unwrap_or(DEGREE_DECIMALS) as usize;
        let numbers = self.settings.format.numbers;
        let text = format!("{}°", numbers.decimal(sweep.to_degrees(), decimals));
        let letters = self.settings.letters;
        let (least, step, count) = RADII;
        // Try small arcs first, each between the arms and then on the opposite side of the vertex.
        for number in 0..count {
            let radius = (least + step * f64::from(number)) * letters;
            for sense in [1.0, -1.0] {
                // Beyond the vertex, the part has no sides.
                let lengths = arms.map(|arm| if sense > 0.0 { arm.length() } else { 0.0 });
                let sides = arms.map(|arm| arm.normalize_or(DVec2::X) * sense);
                let (text, vertex) = (text.as_str(), vertex);
                let arc = AngleArc { vertex, sides, lengths, sweep, radius, text, letters };
                let candidate = arc.candidate();
                if self.is_free(&candidate) {
                    return Some(candidate);
                }
            }
        }
        None
    }
}

impl AngleArc<'_> {
    /// Returns the point on the arc at an angle from the first side, and the unit tangent there.
    fn at(&self, angle: f64) -> (DVec2, DVec2) {
        let (sine, cosine) = libm::sincos(angle);
        let arm = DVec2::new(cosine, sine).rotate(self.sides[0]);
        (self.vertex + arm * self.radius, arm.perp())
    }

    /// Returns all lines and the text of the dimension.
    fn candidate(&self) -> Candidate {
        let (letters, mut candidate) = (self.letters, Candidate::default());
        for (side, length) in self.sides.into_iter().zip(self.lengths) {
            let end = self.radius + EXTENSION_OVERHANG * letters;
            let start = length + EXTENSION_GAP * letters;
            if start < end {
                candidate.push_line([self.vertex + side * start, self.vertex + side * end]);
            }
        }
        let arrow = ARROW_LENGTH * letters;
        // Arrows that do not fit between the arms point inward from outside.
        let is_narrow = self.radius * self.sweep <= 3.5 * arrow;
        let beyond = if is_narrow { 2.0 * arrow / self.radius } else { 0.0 };
        let span = self.sweep + 2.0 * beyond;
        let steps = (span / ARC_STEP).ceil().max(8.0);
        let points =
            (0..=steps as u32).map(|k| self.at(f64::from(k) / steps * span - beyond).0).collect();
        candidate.push(AnnotationLayer::Dimensions, AnnotationShape::Path(points));
        let inward = if is_narrow { -1.0 } else { 1.0 };
        for (angle, sense) in [(0.0, inward), (self.sweep, -inward)] {
            let (tip, _) = self.at(angle);
            // The arrow points along its chord, so that its base is on the arc.
            let (base, _) = self.at(angle + sense * arrow / self.radius);
            let head = arrowhead(tip, (base - tip).normalize_or(DVec2::X), arrow);
            candidate.push(AnnotationLayer::Dimensions, AnnotationShape::Head(head));
        }
        candidate.push(AnnotationLayer::DimensionTexts, AnnotationShape::Text(self.label()));
        candidate
    }

    /// Returns the horizontal label with the degrees, on the outer side of the arc.
    fn label(&self) -> AnnotationText {
        let (middle, _) = self.at(0.5 * self.sweep);
        let out = (middle - self.vertex).normalize_or(DVec2::NEG_Y);
        let width = Label::new(self.text, DVec2::ZERO, self.letters).width();
        let margin = 2.0 * TEXT_GAP * self.letters;
        let half = DVec2::new(0.5 * width, 0.5 * self.letters);
        // Move the text outward until it is entirely outside the arc, with a margin.
        let mut distance = self.radius + margin;
        let is_inside = |distance: f64| {
            let center = out * distance;
            DVec2::ZERO.clamp(center - half, center + half).length() < self.radius + margin
        };
        while is_inside(distance) {
            distance += 0.2 * self.letters;
        }
        let center = self.vertex + out * distance;
        AnnotationText {
            text: self.text.to_owned(),
            anchor: center + DVec2::Y * half.y,
            height: self.letters,
            direction: DVec2::X,
            align: TextAlign::Middle,
        }
    }
}
