//! Section lines: cutting planes marked in the views that see them edge-on, and section names (ISO
//! 128-40).
//!
//! ```text
//!    A                 A
//!    │                 │
//!    ▼━ ── · ── · ── ━ ▼
//! ```
//!
//! The line is a narrow chain line with wide ends. Arrows show the viewing direction, and a letter
//! identifies the section. The view that faces the plane is drawn cut, with A–A below it. Letters
//! and names are placed in free space: beyond their arrows, beyond the line, or farther out.

use super::annotation::{
    AnnotationLayer, AnnotationShape, AnnotationText, Extent, ViewAnnotations,
};
use super::composition::Break;
use super::sheet_view::SheetView;
use super::view_mark::{MarkSettings, add_end_letter};
use glam::DVec2;
use homog::{Plane, Vector, World};
use page::TextAlign;
use viewport::DrawingScale;

/// The maximum deviation of a cosine from ±1 or 0 at which directions count as parallel or
/// perpendicular.
pub(super) const PARALLEL_TOLERANCE: f64 = 1e-6;

/// The overhang of the line beyond the view, and the length of its wide ends, in millimeters.
pub(super) const OVERHANG: f64 = 4.0;

/// The length of an arrow including its shaft, in millimeters.
pub(super) const ARROW_LENGTH: f64 = 6.0;

/// The number of positions to try, farther and farther out, for a letter or a name.
const TEXT_STEPS: u32 = 40;

/// Returns the space beside a view for a section line and a letter beyond its end, in millimeters.
pub(super) fn section_line_reserve(letters: f64) -> f64 {
    OVERHANG + 1.8 * letters
}

/// A section plane and the letter of its section.
#[derive(Clone, Copy, Debug)]
pub(super) struct LetteredPlane {
    pub(super) plane: Plane<World>,
    pub(super) letter: char,
}

/// The line of a section in a view that sees the plane edge-on, relative to the center of the view.
#[derive(Clone, Copy, Debug)]
pub(super) struct SectionLine {
    ends: [DVec2; 2],
    /// The unit vector on the sheet toward the retained side, which is the viewing direction of the
    /// section.
    retained_direction: DVec2,
    letter: char,
}

impl SheetView {
    /// Whether the view looks straight at the plane, from the removed side.
    pub(super) fn faces_section(&self, plane: Plane<World>) -> bool {
        plane.normal().dot(self.camera.gaze()) > 1.0 - PARALLEL_TOLERANCE
    }

    /// Whether the view sees the plane edge-on.
    pub(super) fn sees_edge_of(&self, plane: Plane<World>) -> bool {
        plane.normal().dot(self.camera.gaze()).abs() <= PARALLEL_TOLERANCE
    }

    /// Returns the trace of a plane seen edge-on: a point on the trace, in millimeters from the
    /// center of the view, and the unit vector toward the retained side.
    fn section_trace(&self, plane: Plane<World>, scale: DrawingScale) -> Option<(DVec2, DVec2)> {
        let normal = Vector::from_raw(plane.normal().raw());
        let direction = self.camera.rotation().transform_vector(normal).raw();
        if !self.sees_edge_of(plane) {
            return None;
        }
        let away = plane.evaluate(self.camera.eye());
        let millimeters = scale.to_paper_length(self.millimeters_per_unit * away);
        let retained = DVec2::new(direction.x, -direction.y).normalize_or_zero();
        Some((-retained * millimeters, retained))
    }
}

impl SectionLine {
    /// Returns the line of a plane in a view, or `None` if the plane is not edge-on or misses the
    /// object.
    ///
    /// A slab test against the area of the object gives the interval of the line, which is extended
    /// by [`OVERHANG`] at both ends.
    pub(super) fn in_view(
        view: &SheetView,
        scale: DrawingScale,
        section: LetteredPlane,
    ) -> Option<Self> {
        let LetteredPlane { plane, letter } = section;
        let (point, retained) = view.section_trace(plane, scale)?;
        let half = view.size * scale.ratio() * 0.5;
        let along = DVec2::new(-retained.y, retained.x);
        // Slab test: the interval of the line inside the area of the view.
        let mut span = [f64::NEG_INFINITY, f64::INFINITY];
        for axis in 0..2 {
            let from = point[axis];
            if along[axis].abs() < PARALLEL_TOLERANCE {
                if from.abs() > half[axis] {
                    return None;
                }
                continue;
            }
            let [s, t] = [-half[axis] - from, half[axis] - from].map(|to| to / along[axis]);
            span = [span[0].max(s.min(t)), span[1].min(s.max(t))];
        }
        let is_there = span[0] < span[1] && span[0].is_finite() && span[1].is_finite();
        let ends = [span[0] - OVERHANG, span[1] + OVERHANG].map(|t| point + along * t);
        is_there.then_some(Self { ends, retained_direction: retained, letter })
    }

    /// Adds the line with its wide ends, each with an arrow whose tip is on the line.
    pub(super) fn annotate(&self, annotations: &mut ViewAnnotations) {
        let [a, b] = self.ends;
        annotations.push_line(AnnotationLayer::CutLines, self.ends);
        let along = (b - a).normalize_or_zero() * OVERHANG;
        annotations.push_line(AnnotationLayer::CutEnds, [a, a + along]);
        annotations.push_line(AnnotationLayer::CutEnds, [b, b - along]);
        for tip in self.ends {
            add_section_arrow(annotations, tip, self.retained_direction);
        }
    }

    /// Returns the line in a view with an omitted part, or `None` if the line is in the omitted
    /// part.
    pub(super) fn shortened(mut self, part: &Break, scale: DrawingScale) -> Option<Self> {
        let middle = (self.ends[0] + self.ends[1]) * 0.5;
        if self.retained_direction[part.axis].abs() < 1.0 - PARALLEL_TOLERANCE {
            // The line runs along the shortened axis or is oblique to it, so its ends move with the
            // ends of the object.
            let half = part.length() * (0.5 * scale.ratio());
            for end in &mut self.ends {
                *end -= half * (*end - middle)[part.axis].signum();
            }
            return Some(self);
        }
        let by = part.shortened(middle / scale.ratio())? * scale.ratio() - middle;
        self.ends.iter_mut().for_each(|end| *end += by);
        Some(self)
    }

    /// Adds the letter at both ends of the line, at the first free position.
    pub(super) fn add_letters(
        &self,
        annotations: &mut ViewAnnotations,
        object: Extent,
        letters: f64,
    ) {
        let [a, b] = self.ends;
        for (end, other) in [(a, b), (b, a)] {
            let (away, tail) = ((end - other).normalize_or_zero(), -self.retained_direction);
            let settings = MarkSettings { ratio: 1.0, object, letters };
            add_end_letter(annotations, end, away, tail, self.letter, &settings);
        }
    }
}

/// Adds an arrow with its tip at a point, in the viewing direction of a section.
pub(super) fn add_section_arrow(annotations: &mut ViewAnnotations, tip: DVec2, gaze: DVec2) {
    annotations.push_line(AnnotationLayer::CutArrows, [tip - gaze * ARROW_LENGTH, tip - gaze]);
    let (back, side) = (tip - gaze * 3.0, gaze.perp() * 0.5);
    let head = AnnotationShape::Head([tip, back + side, back - side]);
    annotations.push(AnnotationLayer::CutArrows, head);
}

/// Adds text below a view, as close to it as other annotations allow.
pub(super) fn add_caption(
    annotations: &mut ViewAnnotations,
    layer: AnnotationLayer,
    text: &str,
    object: Extent,
    letters: f64,
) {
    let places = (0..=TEXT_STEPS).map(|step| AnnotationText {
        text: text.to_owned(),
        anchor: DVec2::new(0.0, object[1].y + (1.8 + 0.5 * f64::from(step)) * letters),
        height: letters,
        direction: DVec2::X,
        align: TextAlign::Middle,
    });
    annotations.push_first_free_text(layer, places, object);
}
