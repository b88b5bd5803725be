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
/// A plane that no principal view faces gets no name; only the axonometric view is cut by it.
pub(super) fn section_line_layers(
    sheet: &Sheet,
    sections: &[Plane<World>],
    layout: &ViewLayout<'_>,
    ink: Ink,
) -> Vec<Layer> {
    let is_principal = |placed: &&PlacedView<'_>| NamedView::PRINCIPAL.contains(&placed.view.name);
    let principal: Vec<&PlacedView<'_>> = layout.views.iter().filter(is_principal).collect();
    let mut layers = SectionLayers::new(sheet, ink);
    let shown = sections.iter().filter(|plane| principal.iter().any(|p| p.faces_section(**plane)));
    for (plane, letter) in shown.zip('A'..='Z') {
        for placed in &principal {
            if placed.faces_section(*plane) {
                layers.push_name(placed, letter);
            } else if let Some(line) = SectionLine::in_view(placed, *plane) {
                layers.push_line(&line, letter);
            }
        }
    }
    let SectionLayers { lines, ends, names, .. } = layers;
    [lines, ends, names].into_iter().filter(|layer| !layer.groups.is_empty()).collect()
}

/// The layers of section lines, one for each of three pens.
struct SectionLayers {
    /// Chain lines.
    lines: Layer,
    /// The wide ends of the lines.
    ends: Layer,
    /// Arrows, letters and the names below sectional views.
    names: Layer,
    /// The height of letters in millimeters.
    lettering: f64,
}

impl SectionLayers {
    /// Empty layers with the pens of a sheet.
    fn new(sheet: &Sheet, ink: Ink) -> Self {
        let group = sheet.line_width_group();
        let chain =
            LineType::LongDashedDotted.to_pen(group.narrow_width(), ink, Cap::Butt, Join::Miter);
        let wide = Pen { cap: Cap::Butt, ..Pen::solid(group.wide_width(), ink) };
        let lettering = Pen::solid(group.lettering_width(), ink);
        Self {
            lines: Layer::new("cut-lines", "lines of cuts", chain),
            ends: Layer::new("cut-ends", "ends of cuts", wide),
            names: Layer::new("cut-names", "names of cuts", lettering),
            lettering: sheet.lettering_height(),
        }
    }

    /// Writes A–A below a view that shows section A.
    fn push_name(&mut self, placed: &PlacedView<'_>, letter: char) {
        let area = placed.object_area();
        let below = area.y() + area.height() + 1.8 * self.lettering;
        let name = format!("{letter}-{letter}");
        let anchor = DVec2::new(placed.center.x, below);
        self.names.groups.push(label_group(&name, anchor, self.lettering));
    }

    /// Draws a section line with its wide ends, and an arrow with the letter at each of them.
    fn push_line(&mut self, line: &SectionLine, letter: char) {
        let [a, b] = line.ends;
        self.lines.groups.push(stroke_group([line.ends]));
        let inner = |k: usize| line.ends[k].lerp(line.ends[1 - k], OVERHANG / line.line_length());
        self.ends.groups.push(stroke_group([[a, inner(0)], [b, inner(1)]]));
        self.names.groups.push(line.arrow_group());
        for end in line.ends {
            let anchor = end - line.retained_direction * (ARROW_LENGTH + self.lettering)
                + DVec2::Y * (0.5 * self.lettering);
            self.names.groups.push(label_group(&letter.to_string(), anchor, self.lettering));
        }
    }
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
