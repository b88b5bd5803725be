//! Overlays: axes, ground grid, horizon, vanishing points, view volumes and labels, drawn over a
//! picture.
//!
//! ```text
//!    ──────────●─ · ─ · ─ horizon ─ · ─ · ─●──     world axes, a ground grid,
//!              V  ╲  ╲             ╱   ╱   V       the horizon, vanishing points with
//!               x   ╲ ┌───────────┐ ╱       z      lines to them, the view volume of
//!                     │           │                another camera
//! ```
//!
//! The axes, the grid and the view volume are part of the world, so models can hide them. The
//! horizon and the vanishing points are drawn on the picture plane. Anything behind the eye is
//! clipped before the perspective divide. The near and far planes do not clip overlays.

mod perspective;
mod point_label;
mod view_volume;

pub use point_label::{
    LabelFault, PointLabel, label_rectangles, label_warnings, missing_glyph_warning,
    with_label_halos,
};

use super::line_style::HiddenLines;
use camera::ViewProjection;
use glam::{DMat4, DVec2, DVec3, DVec4};
use hidden_line::{Occluders, Projector, Subject, WeldedSurface};
use homog::{Bounds, Clip, Point, Projective, Vector, World};
use page::palette::{BLUE, GRAY, GREEN, RED};
use page::{
    Cap, Group, Ink, Label, Layer, LineType, MILLIMETERS_PER_PIXEL, Pen, Polyline, TextAlign,
};

/// An annotation drawn over a picture to explain it.
#[derive(Clone, PartialEq, Debug)]
pub enum Overlay {
    /// The world axes, drawn from the origin with this length; with `None`, the length depends on
    /// the size of the models.
    Axes(Option<f64>),
    /// A grid on the ground, y = 0, with this spacing; with `None`, a round spacing that depends on
    /// the size of the models.
    Grid(Option<f64>),
    /// The vanishing line of horizontal planes.
    Horizon,
    /// The vanishing points of the axes, with lines from the corners of the models' bounding box.
    VanishingPoints,
    /// The view volume of another camera, and its eye.
    Volume(Box<ViewProjection>),
    /// The visible feature edges of the surfaces, which line drawings show anyway.
    Edges,
    /// Text at a world point.
    Label(PointLabel),
}

/// The directions, names and colors of the world axes.
pub const AXES: [(Vector<World>, &str, Ink); 3] =
    [(Vector::X, "x", RED), (Vector::Y, "y", GREEN), (Vector::Z, "z", BLUE)];

/// The line width in millimeters.
const LINE_WIDTH: f64 = 0.25;
/// The height of characters in millimeters.
const LETTER_HEIGHT: f64 = 3.0;
/// The length of an arrowhead in millimeters.
const ARROW_LENGTH: f64 = 2.4;

/// The maximum number of grid lines in each direction.
const MAX_GRID_LINES: f64 = 200.0;

/// Returns the layers of all overlays, for a page of the picture's size.
#[must_use]
pub fn overlay_layers(
    subject: &Subject<'_>,
    overlays: &[Overlay],
    hidden: HiddenLines,
) -> Vec<Layer> {
    if overlays.is_empty() {
        return Vec::new();
    }
    let Some(glass) = PicturePlane::new(subject, hidden) else { return Vec::new() };
    let layers = overlays.iter().enumerate().flat_map(|(index, overlay)| {
        let layers = match overlay {
            Overlay::Axes(length) => glass.axes_layers(*length),
            Overlay::Grid(step) => glass.grid_layers(*step),
            Overlay::Horizon => glass.horizon_layers(),
            Overlay::VanishingPoints => glass.vanishing_point_layers(),
            Overlay::Volume(view_projection) => glass.view_volume_layers(view_projection),
            // Feature edges are drawn along with the surfaces, not here.
            Overlay::Edges => Vec::new(),
            Overlay::Label(label) => glass.point_label_layers(label, subject),
        };
        layers
            .into_iter()
            .map(move |layer| Layer { id: format!("overlay-{}-{}", index + 1, layer.id), ..layer })
    });
    layers.filter(|layer| layer.groups.iter().any(|group| !group.strokes.is_empty())).collect()
}

/// The picture plane, to which world points, directions and lines are projected.
struct PicturePlane {
    world_to_clip: Projective<World, Clip>,
    /// Half the width and height of the page in millimeters.
    half: DVec2,
    /// The bounding box of the models.
    bounds: Bounds<World>,
    /// The faces that hide overlays, if any.
    occluders: Option<Occluders>,
}

/// The visible and hidden parts of lines on the page.
#[derive(Default)]
struct DividedStrokes {
    visible: Vec<Polyline>,
    hidden: Vec<Polyline>,
}

/// The factor by which the depth range around the models is extended, so that overlays are not
/// clipped in depth.
const DEPTH_RANGE_FACTOR: f64 = 1000.0;

impl PicturePlane {
    /// Creates the picture plane of a subject, or returns `None` if there are no models.
    fn new(subject: &Subject<'_>, hidden: HiddenLines) -> Option<Self> {
        let bounds = Bounds::from_points(model::world_points(subject.models))?;
        let size = DVec2::from(subject.size.map(f64::from));
        Some(Self {
            world_to_clip: subject.view_projection.world_to_clip(),
            half: size * (0.5 * MILLIMETERS_PER_PIXEL),
            bounds,
            occluders: model_occluders(subject, hidden),
        })
    }

    /// Projects a point and returns x, y and w of its clip coordinates.
    fn project_point(&self, point: Point<World>) -> DVec3 {
        drop_depth(self.world_to_clip.transform_point(point).raw())
    }

    /// Projects a direction to a vanishing point with w ≥ 0.
    fn project_direction(&self, direction: Vector<World>) -> DVec3 {
        let image = drop_depth(self.world_to_clip.transform_direction(direction).raw());
        if image.z < 0.0 { -image } else { image }
    }

    /// Converts normalized device coordinates to page millimeters.
    fn ndc_to_page(&self, ndc: DVec2) -> DVec2 {
        self.half + DVec2::new(ndc.x, -ndc.y) * self.half
    }

    /// Clips a homogeneous segment to the picture, divides by w, and maps the result to the page.
    ///
    /// The four conditions w ± x ≥ 0 and w ± y ≥ 0 imply w ≥ 0, so points behind the eye are never
    /// divided (Liang–Barsky in homogeneous coordinates).
    fn clip_to_picture(&self, a: DVec3, b: DVec3) -> Option<[DVec2; 2]> {
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for side in [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y] {
            let [start, end] = [a, b].map(|image| image.z + image.dot(side));
            if start < 0.0 && end < 0.0 {
                return None;
            }
            if start < 0.0 {
                from = from.max(start / (start - end));
            } else if end < 0.0 {
                to = to.min(start / (start - end));
            }
        }
        let at = |t: f64| {
            let image = a.lerp(b, t);
            (image.z > 0.0).then(|| self.ndc_to_page(image.truncate() / image.z))
        };
        if from < to { Some([at(from)?, at(to)?]) } else { None }
    }

    /// Divides a world line into visible and hidden strokes.
    ///
    /// Without occluders, the whole line is visible. Each part is an interval of fractions of the
    /// world line and is projected and clipped to the picture separately.
    fn divide_line(&self, from: Point<World>, to: Point<World>, strokes: &mut DividedStrokes) {
        let stroke = |[a, b]: [f64; 2]| {
            let [a, b] = [a, b].map(|t| self.project_point(from.lerp(to, t)));
            Polyline::through_points(&self.clip_to_picture(a, b)?, false)
        };
        let Some(obstacles) = &self.occluders else {
            return strokes.visible.extend(stroke([0.0, 1.0]));
        };
        let parts = obstacles.edge_parts([from, to]);
        strokes.visible.extend(parts.visible.into_iter().filter_map(stroke));
        strokes.hidden.extend(parts.hidden.into_iter().filter_map(stroke));
    }

    /// Returns the position of a homogeneous point on the page, if it is inside the picture.
    fn point_in_picture(&self, image: DVec3) -> Option<DVec2> {
        let inside = image.z > 0.0 && image.x.abs() <= image.z && image.y.abs() <= image.z;
        inside.then(|| self.ndc_to_page(image.truncate() / image.z))
    }

    /// Returns the layers of the three world axes.
    fn axes_layers(&self, length: Option<f64>) -> Vec<Layer> {
        let diagonal = self.bounds.diagonal();
        let length = length.unwrap_or(if diagonal > 0.0 { 0.6 * diagonal } else { 1.0 });
        let axes = AXES.into_iter();
        axes.flat_map(|(direction, name, ink)| self.axis_layers(direction * length, name, ink))
            .collect()
    }

    /// Returns the layers of one axis: its visible and hidden parts, and its arrowhead and name.
    fn axis_layers(&self, direction: Vector<World>, name: &str, ink: Ink) -> [Layer; 3] {
        let tip = Point::ORIGIN + direction;
        let [visible, hidden] =
            self.line_layers(&format!("axis-{name}"), ink, &[[Point::ORIGIN, tip]]);
        let mut head =
            overlay_layer(&format!("axis-{name}-name"), &format!("axis {name}: name"), ink);
        let ends = [Point::ORIGIN, tip].map(|point| self.project_point(point));
        let ends = self
            .clip_to_picture(ends[0], ends[1])
            .filter(|_| self.point_in_picture(ends[1]).is_some());
        if let Some([from, tip]) = ends {
            let along = (tip - from).normalize_or_zero();
            let at = tip + along * (0.9 * LETTER_HEIGHT) + DVec2::new(0.0, 0.35 * LETTER_HEIGHT);
            let label = Label::new(name, at, LETTER_HEIGHT).with_align(TextAlign::Middle);
            let fills = arrowhead(tip, along).into_iter().collect();
            head.groups.push(Group { fills, ..label.group() });
        }
        [visible, hidden, head]
    }

    /// Returns two layers of world lines: one with their visible parts, and a dashed one with their
    /// hidden parts.
    fn line_layers(&self, name: &str, ink: Ink, lines: &[[Point<World>; 2]]) -> [Layer; 2] {
        let mut strokes = DividedStrokes::default();
        lines.iter().for_each(|[from, to]| self.divide_line(*from, *to, &mut strokes));
        let mut visible = overlay_layer(name, name, ink);
        let mut hidden = overlay_layer(&format!("{name}-hidden"), &format!("{name}: hidden"), ink);
        hidden.pen.width *= 0.6;
        hidden.pen.dashes = LineType::Dashed.dash_pattern(hidden.pen.width * 0.6);
        visible.groups.push(Group { strokes: strokes.visible, ..Group::default() });
        hidden.groups.push(Group { strokes: strokes.hidden, ..Group::default() });
        [visible, hidden]
    }

    /// Returns the ground grid under the models, extending one cell beyond their bounding box on
    /// each side.
    ///
    /// Lines are at multiples of the step, so grids with the same step coincide across scenes. If
    /// the requested step would give more than [`MAX_GRID_LINES`] lines, it is increased.
    fn grid_layers(&self, step: Option<f64>) -> Vec<Layer> {
        let (min, max) = (self.bounds.min(), self.bounds.max());
        let size = (max.x() - min.x()).max(max.z() - min.z()).max(self.bounds.diagonal() * 0.1);
        let step = step.unwrap_or_else(|| round_grid_step(size / 8.0)).max(size / MAX_GRID_LINES);
        let range = |low: f64, high: f64| {
            let (low, high) = (libm::floor(low / step) - 1.0, libm::ceil(high / step) + 1.0);
            (low, ((high - low) as u32).min(2 * MAX_GRID_LINES as u32))
        };
        let ((x, columns), (z, rows)) = (range(min.x(), max.x()), range(min.z(), max.z()));
        let at = |column: f64, row: f64| Point::new((x + column) * step, 0.0, (z + row) * step);
        let (width, depth) = (f64::from(columns), f64::from(rows));
        let across = (0..=rows).map(|row| (at(0.0, row.into()), at(width, row.into())));
        let along = (0..=columns).map(|column| (at(column.into(), 0.0), at(column.into(), depth)));
        let mut strokes = DividedStrokes::default();
        across.chain(along).for_each(|(from, to)| self.divide_line(from, to, &mut strokes));
        let mut layer = overlay_layer("grid", &format!("grid, {step} apart"), GRAY);
        layer.pen.width = 0.13;
        layer.groups.push(Group { strokes: strokes.visible, ..Group::default() });
        vec![layer]
    }
}

/// Returns the faces of the models as occluders, unless the style draws hidden lines like visible
/// ones.
///
/// The third row of the projection is divided by [`DEPTH_RANGE_FACTOR`], which flattens depths
/// without changing their order. Points far in front of or behind the models then stay within the
/// view volume.
fn model_occluders(subject: &Subject<'_>, hidden: HiddenLines) -> Option<Occluders> {
    if hidden == HiddenLines::Drawn {
        return None;
    }
    let viewport = subject.viewport().ok()?;
    // Only the order of depths matters, so the range can be extended to include the overlays.
    let deep = DMat4::from_diagonal(DVec4::new(1.0, 1.0, 1.0 / DEPTH_RANGE_FACTOR, 1.0));
    let view_to_clip = Projective::from_raw(deep * subject.view_projection.view_to_clip.raw());
    let projector =
        Projector::new(&ViewProjection { view_to_clip, ..subject.view_projection }, &viewport);
    let surface = WeldedSurface::new(subject.models, subject.sections, subject.uncut);
    Some(Occluders::new(surface.occluder_triangles(), projector, surface.touch_tolerance()))
}

/// Returns the x, y and w components.
fn drop_depth(image: DVec4) -> DVec3 {
    DVec3::new(image.x, image.y, image.w)
}

/// Returns an empty layer with the overlay pen.
fn overlay_layer(id: &str, title: &str, ink: Ink) -> Layer {
    Layer::new(id, title, Pen { cap: Cap::Butt, ..Pen::solid(LINE_WIDTH, ink) })
}

/// Returns an arrowhead with its tip at `tip`, pointing in the direction `along`.
fn arrowhead(tip: DVec2, along: DVec2) -> Option<Polyline> {
    let across = DVec2::new(-along.y, along.x) * (ARROW_LENGTH / 6.0);
    let base = tip - along * ARROW_LENGTH;
    Polyline::through_points(&[tip, base + across, base - across], true)
}

/// Returns the largest length of the form 1, 2 or 5 · 10ⁿ that is at most `most`, or 1 if `most` is
/// not positive.
fn round_grid_step(most: f64) -> f64 {
    if !(most > 0.0 && most.is_finite()) {
        return 1.0;
    }
    let power = libm::pow(10.0, libm::floor(libm::log10(most)));
    let fits = |factor: &f64| factor * power <= most;
    [5.0, 2.0, 1.0].into_iter().find(fits).map_or(power, |factor| factor * power)
}
