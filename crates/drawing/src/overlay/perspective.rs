//! Perspective overlays: the horizon, and the vanishing points of the axes (C80, C81).
//!
//! A direction d is a point at infinity, and its image is a vanishing point: the clip coordinates
//! of (d, 0) after the perspective divide. The images of all horizontal directions are on one line,
//! the horizon, which is the cross product of the images of x and z.

use super::{AXES, LETTER_HEIGHT, PicturePlane, overlay_layer};
use glam::{DVec2, DVec3};
use homog::Vector;
use page::palette::BROWN;
use page::{Group, Label, Layer, LineType, Polyline, TextAlign};

/// The radius of the ring around a vanishing point, in millimeters.
const RING_RADIUS: f64 = 0.8;

/// The distance from the border of the picture to the name of a vanishing point outside it, in
/// millimeters.
const BORDER_GAP: f64 = 1.5;

/// The number of sides of a ring.
const RING_SIDES: u32 = 24;

/// A component counts as zero if it is at most this fraction of the vector's length.
const ZERO_TOLERANCE: f64 = 1e-12;

impl PicturePlane {
    /// Returns the horizon with its label; empty in a parallel projection, which has none.
    pub(super) fn horizon_layers(&self) -> Vec<Layer> {
        let Some(ends) = self.horizon_ends() else { return Vec::new() };
        let mut line = overlay_layer("horizon", "horizon", BROWN);
        line.pen.dashes = LineType::LongDashedDotted.dash_pattern(line.pen.width);
        let strokes = Polyline::through_points(&ends, false).into_iter().collect();
        line.groups.push(Group { strokes, ..Group::default() });
        let mut text = overlay_layer("horizon-text", "horizon: text", BROWN);
        let along = (ends[1] - ends[0]).normalize_or(DVec2::X);
        // The label is below the line, because the vanishing point names are above it.
        let (height, below) = (0.8 * LETTER_HEIGHT, DVec2::new(-along.y, along.x));
        let at = ends[0] + along * 2.0 + below * (height + 0.8);
        let label = Label::new("horizon", at, height);
        text.groups.push(label.with_direction(along).group());
        vec![line, text]
    }

    /// Returns the points where the horizon enters and leaves the picture, from left to right.
    ///
    /// The horizon is the line through the vanishing points of x and z. In homogeneous coordinates
    /// of the picture plane, the line a x + b y + c = 0 through two points is their cross product
    /// (a, b, c). Its point nearest to the center is −c (a, b) / (a² + b²), the middle of the
    /// segment that is clipped to the picture.
    fn horizon_ends(&self) -> Option<[DVec2; 2]> {
        let [x, z] = [Vector::X, Vector::Z].map(|direction| self.project_direction(direction));
        if x.z.max(z.z) <= ZERO_TOLERANCE * x.length().max(z.length()) {
            return None;
        }
        // The line a x + b y + c = 0 through two images is their cross product.
        let line = x.cross(z);
        let normal = line.truncate();
        let foot = normal * (-line.z / normal.length_squared());
        // For a camera that looks straight down, there is no horizon, or it is far outside the
        // picture.
        let half_length = foot.length() + 4.0;
        if !half_length.is_finite() || half_length > 1e6 {
            return None;
        }
        let along = DVec2::new(normal.y, -normal.x).normalize_or(DVec2::X) * half_length;
        let [from, to] = [foot - along, foot + along].map(|center| center.extend(1.0));
        let [a, b] = self.clip_to_picture(from, to)?;
        Some(if a.x <= b.x { [a, b] } else { [b, a] })
    }

    /// Returns rings around the vanishing points of the axes, and lines to them from the corners of
    /// the models' bounding box.
    ///
    /// If a vanishing point is outside the picture, its name is at the border, on the line from the
    /// center to that point. An axis parallel to the picture plane has no finite vanishing point (w
    /// = 0 up to rounding) and is skipped.
    pub(super) fn vanishing_point_layers(&self) -> Vec<Layer> {
        let mut layers = Vec::new();
        for (direction, name, ink) in AXES {
            let image = self.project_direction(direction);
            if image.z <= ZERO_TOLERANCE * image.length() {
                continue;
            }
            let mut lines =
                overlay_layer(&format!("to-{name}"), &format!("lines along {name}"), ink);
            lines.pen.width *= 0.5;
            let to_it = |corner| self.line_to_vanishing_point(self.project_point(corner), image);
            let strokes = self.bounds.corners().into_iter().filter_map(to_it).collect();
            lines.groups.push(Group { strokes, ..Group::default() });
            let title = format!("vanishing point of {name}");
            let (id, strokes) = match self.point_in_picture(image) {
                Some(center) => ("vanishing", vanishing_point_mark(center, name)),
                None => ("outside", self.outside_mark(image, name)),
            };
            let mut mark = overlay_layer(&format!("{id}-{name}"), &title, ink);
            mark.groups.push(Group { strokes, ..Group::default() });
            layers.extend([lines, mark]);
        }
        layers
    }

    /// Returns the mark `Vx outside`, at the border on the line from the center to a vanishing
    /// point.
    fn outside_mark(&self, image: DVec3, name: &str) -> Vec<Polyline> {
        let Some([_, border]) = self.clip_to_picture(DVec3::Z, image) else { return Vec::new() };
        let text = format!("V{name} outside");
        let from_center = (border - self.half) / self.half;
        let (align, aside) = match from_center.x {
            x if x > 0.99 => (TextAlign::End, -BORDER_GAP),
            x if x < -0.99 => (TextAlign::Start, BORDER_GAP),
            _ => (TextAlign::Middle, 0.0),
        };
        let lowest = 2.0 * self.half.y - BORDER_GAP;
        let y = border.y.clamp((LETTER_HEIGHT + BORDER_GAP).min(lowest), lowest);
        let at = DVec2::new(border.x + aside, y);
        Label::new(&text, at, LETTER_HEIGHT).with_align(align).strokes()
    }

    /// Returns the line from the image of a corner to a vanishing point.
    fn line_to_vanishing_point(&self, from: DVec3, vanishing: DVec3) -> Option<Polyline> {
        Polyline::through_points(&self.clip_to_picture(from, vanishing)?, false)
    }
}

/// Returns a ring around a vanishing point, with its name.
fn vanishing_point_mark(center: DVec2, name: &str) -> Vec<Polyline> {
    let point = |k: u32| {
        let (sin, cos) =
            libm::sincos(core::f64::consts::TAU * f64::from(k) / f64::from(RING_SIDES));
        center + DVec2::new(cos, sin) * RING_RADIUS
    };
    let circle = Polyline::through_points(&(0..RING_SIDES).map(point).collect::<Vec<_>>(), true);
    let text = format!("V{name}");
    let label = Label::new(&text, center - DVec2::new(0.0, 1.8), LETTER_HEIGHT)
        .with_align(TextAlign::Middle);
    circle.into_iter().chain(label.strokes()).collect()
}
