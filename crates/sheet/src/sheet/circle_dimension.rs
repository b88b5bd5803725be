//! Diameters and radii: an arrow that points at the circle along a line through its center, with
//! the number on a shelf outside the part (ISO 129-1).
//!
//! ```text
//!            __Ø20__
//!           ╱
//!      ╭──◄╯
//!     │  + │
//!      ╰──╯
//! ```

use super::annotation::{AnnotationLayer, AnnotationShape, AnnotationText};
use super::dimension::{ARROW_LENGTH, TEXT_GAP, arrowhead};
use super::dimension_board::{Candidate, DimensionBoard};
use super::measure::{ViewDimension, ViewMeasure};
use glam::DVec2;
use page::{Label, TextAlign};

/// The directions to try, in degrees counterclockwise from the right. None is horizontal or
/// vertical, because center lines run there.
const DIRECTIONS: [f64; 20] = [
    45.0, 135.0, -45.0, -135.0, 60.0, 120.0, -60.0, -120.0, 30.0, 150.0, -30.0, -150.0, 75.0,
    105.0, -75.0, -105.0, 15.0, 165.0, -15.0, -165.0,
];

/// The number of leader lengths to try for each direction.
const LENGTHS: u32 = 40;

impl DimensionBoard {
    /// Returns the free position with the shortest leader for a diameter or radius.
    pub(super) fn leader_candidate(&self, dimension: &ViewDimension) -> Option<Candidate> {
        let ViewMeasure::Round { center, radius, prefix, radii } = &dimension.measure else {
            return None;
        };
        let ratio = self.settings.scale.ratio();
        let text = format!("{prefix}{}", self.length_text(dimension, radius * radii));
        let (center, radius) = (*center * ratio, *radius * ratio);
        let letters = self.settings.letters;
        let mut best: Option<(f64, Candidate)> = None;
        for degrees in DIRECTIONS {
            let (sine, cosine) = libm::sincos(degrees.to_radians());
            let away = DVec2::new(cosine, -sine);
            let tip = center + away * radius;
            let nearest = self.exit_distance(tip, away) + 2.0 * ARROW_LENGTH * letters;
            for step in 0..LENGTHS {
                let length = nearest + 0.6 * letters * f64::from(step);
                // A longer leader cannot be better, so it is not tested for collisions.
                if best.as_ref().is_some_and(|(least, _)| *least <= length) {
                    break;
                }
                let candidate = leader(&text, tip, away, length, letters);
                if self.is_free(&candidate) {
                    best = Some((length, candidate));
                    break;
                }
            }
        }
        best.map(|(_, candidate)| candidate)
    }

    /// Returns the distance from a point to where a ray from it leaves the hull of the part.
    fn exit_distance(&self, from: DVec2, along: DVec2) -> f64 {
        let hull = &self.hull;
        let crossings = hull.iter().enumerate().filter_map(|(at, &a)| {
            let b = hull[(at + 1) % hull.len()];
            let [s, t] = [a, b].map(|end| (end - from).perp_dot(along));
            let crosses = s.min(t) <= 0.0 && s.max(t) >= 0.0 && s != t;
            crosses.then(|| (a + (b - a) * (s / (s - t)) - from).dot(along))
        });
        crossings.fold(0.0, f64::max)
    }
}

/// Returns a leader, with its arrowhead at a point of a circle and its text on a shelf at the end.
fn leader(text: &str, tip: DVec2, away: DVec2, length: f64, letters: f64) -> Candidate {
    let mut candidate = Candidate::default();
    let corner = tip + away * length;
    let sense = if away.x < 0.0 { -1.0 } else { 1.0 };
    let width = Label::new(text, DVec2::ZERO, letters).width();
    let shelf = corner + DVec2::X * (sense * (width + 0.6 * letters));
    candidate.push_line([tip, corner]);
    candidate.push_line([corner, shelf]);
    let head = AnnotationShape::Head(arrowhead(tip, away, ARROW_LENGTH * letters));
    candidate.push(AnnotationLayer::Dimensions, head);
    let text = AnnotationText {
        text: text.to_owned(),
        anchor: corner + DVec2::new(sense * 0.3 * letters, -TEXT_GAP * letters),
        height: letters,
        direction: DVec2::X,
        align: if sense < 0.0 { TextAlign::End } else { TextAlign::Start },
    };
    candidate.push(AnnotationLayer::DimensionTexts, AnnotationShape::Text(text));
    candidate
}
