//! Which view shows which cut, and the lines that say where the cuts are (ISO 128-40).
//!
//! ```text
//!    A                 A        The line of the cut, chain narrow with wide ends, stands in the views that see the plane from its
//!    │                 │        edge; arrows show the way one looks, and a letter names the cut. The view that looks straight
//!    ▼━ ── · ── · ── ━ ▼        onto the plane is drawn cut, with A–A below it. All other principal views show the thing whole.
//! ```

use super::{Arrangement, Placed, Sheet};
use crate::label::{Align, Label};
use crate::linetype::LineType;
use crate::page::{Cap, Group, Ink, Join, Layer, Pen, Polyline};
use camera::NamedView;
use glam::DVec2;
use homog::{Plane, Vector, World};

/// What counts as parallel: the sine or the cosine may differ by this.
const PARALLEL: f64 = 1e-6;

/// How far the line reaches beyond the view, in millimetres; its wide ends are as long.
const BEYOND: f64 = 4.0;

/// The length of the arrows with their shafts, in millimetres.
const ARROW: f64 = 6.0;

impl Placed<'_> {
    /// Whether the view shows a cut: an axonometric view every one, a principal view what it looks straight onto.
    pub(super) fn shows(&self, plane: Plane<World>) -> bool {
        let is_principal = NamedView::PRINCIPAL.contains(&self.view.name);
        !is_principal || self.looks_onto(plane)
    }

    fn looks_onto(&self, plane: Plane<World>) -> bool {
        plane.normal().dot(self.view.camera.gaze()) > 1.0 - PARALLEL
    }

    /// Where a plane that is seen from its edge is on the sheet: a point, and the unit vector to what is kept.
    fn trace(&self, plane: Plane<World>) -> Option<(DVec2, DVec2)> {
        let camera = self.view.camera;
        let kept = camera.rotation().vector(Vector::from_raw(plane.normal().raw())).raw();
        if kept.z.abs() > PARALLEL {
            return None;
        }
        let away = plane.evaluate(camera.eye());
        let millimetres = self.scale.to_paper(self.view.unit * away);
        let kept = DVec2::new(kept.x, -kept.y).normalize_or_zero();
        Some((self.centre - kept * millimetres, kept))
    }
}

/// The lines of all cuts that a principal view shows, and the names of those views' cuts.
pub(super) fn layers(
    sheet: &Sheet,
    sections: &[Plane<World>],
    arrangement: &Arrangement<'_>,
    ink: Ink,
) -> Vec<Layer> {
    let principal: Vec<&Placed<'_>> = arrangement
        .placed
        .iter()
        .filter(|placed| NamedView::PRINCIPAL.contains(&placed.view.name))
        .collect();
    let group = sheet.line_group();
    let chain = LineType::LongDashedDotted.pen(group.narrow(), ink, Cap::Butt, Join::Miter);
    let mut lines = Layer::new("cut-lines", "lines of cuts", chain);
    let wide = Pen { cap: Cap::Butt, ..Pen::of_width(group.wide(), ink) };
    let mut ends = Layer::new("cut-ends", "ends of cuts", wide);
    let mut names = Layer::new("cut-names", "names of cuts", Pen::of_width(group.lettering(), ink));
    let shown = sections.iter().filter(|plane| principal.iter().any(|p| p.looks_onto(**plane)));
    for (plane, letter) in shown.zip('A'..='Z') {
        for placed in &principal {
            if placed.looks_onto(*plane) {
                let area = placed.area();
                let height = sheet.lettering();
                let at = DVec2::new(placed.centre.x, area.y() + area.height() + 1.8 * height);
                let name = format!("{letter}-{letter}");
                names.groups.push(text(&name, at, height));
            } else if let Some(line) = CutLine::of(placed, *plane) {
                lines.groups.push(strokes([line.ends]));
                let inner = |k: usize| line.ends[k].lerp(line.ends[1 - k], BEYOND / line.length());
                ends.groups.push(strokes([[line.ends[0], inner(0)], [line.ends[1], inner(1)]]));
                names.groups.push(line.arrows());
                let height = sheet.lettering();
                for end in line.ends {
                    let at = end - line.kept * (ARROW + height) + DVec2::Y * (0.5 * height);
                    names.groups.push(text(&letter.to_string(), at, height));
                }
            }
        }
    }
    [lines, ends, names].into_iter().filter(|layer| !layer.groups.is_empty()).collect()
}

fn text(text: &str, at: DVec2, height: f64) -> Group {
    let strokes = Label::new(text, at, height).aligned(Align::Middle).strokes();
    Group { strokes, ..Group::default() }
}

fn strokes<const N: usize>(lines: [[DVec2; 2]; N]) -> Group {
    let strokes = lines.iter().filter_map(|ends| Polyline::through(ends, false)).collect();
    Group { strokes, ..Group::default() }
}

/// The line of a cut in a view.
struct CutLine {
    ends: [DVec2; 2],
    kept: DVec2,
}

impl CutLine {
    /// `None` if the plane is not seen from its edge, or passes by.
    fn of(placed: &Placed<'_>, plane: Plane<World>) -> Option<Self> {
        let (point, kept) = placed.trace(plane)?;
        let area = placed.area();
        let half = DVec2::new(area.width(), area.height()) * 0.5;
        let along = DVec2::new(-kept.y, kept.x);
        // From where to where the line is within the area of the view.
        let mut span = [f64::NEG_INFINITY, f64::INFINITY];
        for axis in 0..2 {
            let from = point[axis] - placed.centre[axis];
            if along[axis].abs() < PARALLEL {
                if from.abs() > half[axis] {
                    return None;
                }
                continue;
            }
            let [s, t] = [-half[axis] - from, half[axis] - from].map(|to| to / along[axis]);
            span = [span[0].max(s.min(t)), span[1].min(s.max(t))];
        }
        let is_there = span[0] < span[1] && span[0].is_finite() && span[1].is_finite();
        let ends = [span[0] - BEYOND, span[1] + BEYOND].map(|t| point + along * t);
        is_there.then_some(Self { ends, kept })
    }

    fn length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).length()
    }

    /// An arrow at each end, its tip on the line.
    fn arrows(&self) -> Group {
        let shaft = self.ends.map(|end| [end - self.kept * ARROW, end - self.kept]);
        let head = |tip: DVec2| {
            let (back, side) = (tip - self.kept * 3.0, DVec2::new(-self.kept.y, self.kept.x) * 0.5);
            Polyline::through(&[tip, back + side, back - side], true)
        };
        let fills = self.ends.into_iter().filter_map(head).collect();
        Group { fills, ..strokes(shaft) }
    }
}
