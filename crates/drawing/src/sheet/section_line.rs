//! Section lines: cutting planes marked in the views that see them edge-on, and the names of
//! sections (ISO 128-40).
//!
//! ```text
//!    A                 A
//!    │                 │
//!    ▼━ ── · ── · ── ━ ▼
//! ```
//!
//! The line is chain narrow with wide ends; arrows show the viewing direction, and a letter names
//! the section. The view that faces the plane is drawn cut, with A–A below it. All other principal
//! views show the whole object.

use super::{PlacedView, Sheet, ViewLayout};
use crate::label::{Label, TextAlign};
use crate::line_type::LineType;
use crate::page::{Cap, Group, Ink, Join, Layer, Pen, Polyline};
use camera::NamedView;
use glam::DVec2;
use homog::{Plane, Vector, World};

/// Directions whose sine or cosine differs by no more than this are parallel or perpendicular.
const PARALLEL_TOLERANCE: f64 = 1e-6;

/// The length by which the line extends beyond the view, in millimeters; its wide ends are as long.
const OVERHANG: f64 = 4.0;

/// The length of arrows with their shafts, in millimeters.
const ARROW_LENGTH: f64 = 6.0;

impl PlacedView<'_> {
    /// Whether the view is cut by a plane: an axonometric view by every one, a principal view by
    /// those that it faces.
    pub(super) fn shows_section(&self, plane: Plane<World>) -> bool {
        let is_principal = NamedView::PRINCIPAL.contains(&self.view.name);
        !is_principal || self.faces_section(plane)
    }

    /// Whether the view looks straight onto the plane, from the side that is removed.
    fn faces_section(&self, plane: Plane<World>) -> bool {
        plane.normal().dot(self.view.camera.gaze()) > 1.0 - PARALLEL_TOLERANCE
    }

    /// The trace of a plane that is seen edge-on: a point on the sheet, and the unit vector to the
    /// side that is retained.
    fn section_trace(&self, plane: Plane<World>) -> Option<(DVec2, DVec2)> {
        let camera = self.view.camera;
        let retained_direction =
            camera.rotation().transform_vector(Vector::from_raw(plane.normal().raw())).raw();
        if retained_direction.z.abs() > PARALLEL_TOLERANCE {
            return None;
        }
        let away = plane.evaluate(camera.eye());
        let millimeters = self.scale.to_paper_length(self.view.millimeters_per_unit * away);
        let retained = DVec2::new(retained_direction.x, -retained_direction.y).normalize_or_zero();
        Some((self.center - retained * millimeters, retained))
    }
}

/// The section lines and names for all sections that a principal view shows, lettered from A.
///
/// Three layers, for three pens: the chain line, its wide ends, and arrows with letters. A plane
/// that no principal view faces is shown by no name; only the axonometric view is cut by it.
pub(super) fn section_line_layers(
    sheet: &Sheet,
    sections: &[Plane<World>],
    layout: &ViewLayout<'_>,
    ink: Ink,
) -> Vec<Layer> {
    let principal: Vec<&PlacedView<'_>> = layout
        .views
        .iter()
        .filter(|placed| NamedView::PRINCIPAL.contains(&placed.view.name))
        .collect();
    let group = sheet.line_width_group();
    let chain =
        LineType::LongDashedDotted.to_pen(group.narrow_width(), ink, Cap::Butt, Join::Miter);
    let mut lines = Layer::new("cut-lines", "lines of cuts", chain);
    let wide = Pen { cap: Cap::Butt, ..Pen::solid(group.wide_width(), ink) };
    let mut ends = Layer::new("cut-ends", "ends of cuts", wide);
    let mut names =
        Layer::new("cut-names", "names of cuts", Pen::solid(group.lettering_width(), ink));
    let shown = sections.iter().filter(|plane| principal.iter().any(|p| p.faces_section(**plane)));
    for (plane, letter) in shown.zip('A'..='Z') {
        for placed in &principal {
            if placed.faces_section(*plane) {
                let area = placed.object_area();
                let height = sheet.lettering_height();
                let at = DVec2::new(placed.center.x, area.y() + area.height() + 1.8 * height);
                let name = format!("{letter}-{letter}");
                names.groups.push(label_group(&name, at, height));
            } else if let Some(line) = SectionLine::in_view(placed, *plane) {
                lines.groups.push(stroke_group([line.ends]));
                let inner =
                    |k: usize| line.ends[k].lerp(line.ends[1 - k], OVERHANG / line.line_length());
                ends.groups
                    .push(stroke_group([[line.ends[0], inner(0)], [line.ends[1], inner(1)]]));
                names.groups.push(line.arrow_group());
                let height = sheet.lettering_height();
                for end in line.ends {
                    let at = end - line.retained_direction * (ARROW_LENGTH + height)
                        + DVec2::Y * (0.5 * height);
                    names.groups.push(label_group(&letter.to_string(), at, height));
                }
            }
        }
    }
    [lines, ends, names].into_iter().filter(|layer| !layer.groups.is_empty()).collect()
}

/// A centered label as a group.
fn label_group(text: &str, at: DVec2, height: f64) -> Group {
    let strokes = Label::new(text, at, height).with_align(TextAlign::Middle).strokes();
    Group { strokes, ..Group::default() }
}

/// Straight lines as a group.
fn stroke_group<const N: usize>(lines: [[DVec2; 2]; N]) -> Group {
    let strokes = lines.iter().filter_map(|ends| Polyline::through_points(ends, false)).collect();
    Group { strokes, ..Group::default() }
}

/// The line of a section in a view that sees the plane edge-on.
struct SectionLine {
    ends: [DVec2; 2],
    /// The unit vector on the sheet to the side that is retained: the viewing direction of the
    /// section.
    retained_direction: DVec2,
}

impl SectionLine {
    /// The line of a plane in a view; `None` if the plane is not edge-on, or misses the object.
    ///
    /// A slab test over the area of the object gives the interval of the line, which is extended by
    /// [`OVERHANG`] at both ends.
    fn in_view(placed: &PlacedView<'_>, plane: Plane<World>) -> Option<Self> {
        let (point, retained) = placed.section_trace(plane)?;
        let area = placed.object_area();
        let half = DVec2::new(area.width(), area.height()) * 0.5;
        let along = DVec2::new(-retained.y, retained.x);
        // Slab test: the interval of the line within the area of the view.
        let mut span = [f64::NEG_INFINITY, f64::INFINITY];
        for axis in 0..2 {
            let from = point[axis] - placed.center[axis];
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
        is_there.then_some(Self { ends, retained_direction: retained })
    }

    /// The length in millimeters.
    fn line_length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).length()
    }

    /// An arrow at each end, its tip on the line.
    fn arrow_group(&self) -> Group {
        let shaft = self.ends.map(|end| {
            [end - self.retained_direction * ARROW_LENGTH, end - self.retained_direction]
        });
        let head = |tip: DVec2| {
            let (back, side) = (
                tip - self.retained_direction * 3.0,
                DVec2::new(-self.retained_direction.y, self.retained_direction.x) * 0.5,
            );
            Polyline::through_points(&[tip, back + side, back - side], true)
        };
        let fills = self.ends.into_iter().filter_map(head).collect();
        Group { fills, ..stroke_group(shaft) }
    }
}
