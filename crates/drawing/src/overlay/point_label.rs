//! Labels at world points: text beside the image of a point, with an optional leader line.
//!
//! ```text
//!         ridge               offset (24, −24): pixels to the right and up from the
//!       ╱                     point to the nearest corner of the text
//!      ●  at
//! ```
//!
//! Labels are drawn over the models, even where models hide the point.

use super::{LETTER_HEIGHT, LINE_WIDTH, PicturePlane, overlay_layer};
use crate::{Overlay, Warning};
use camera::ViewProjection;
use glam::{DVec2, DVec3};
use hidden_line::Subject;
use homog::{Point, World};
use page::{
    Group, Ink, Label, Layer, MILLIMETERS_PER_PIXEL, Pen, Polyline, TextAlign, missing_glyphs,
    to_millimeters,
};

/// The distance between a leader line and the text, in character heights.
const LEADER_GAP: f64 = 0.3;
/// The distance between baselines, in character heights.
const LINE_PITCH: f64 = 1.7;
/// The distance that a halo extends beyond the character strokes, in millimeters.
const HALO: f64 = 0.5;
/// The radius of the dot at the end of a leader line, in millimeters.
const DOT_RADIUS: f64 = 0.15 * LETTER_HEIGHT;
/// The number of sides of the dot.
const DOT_SIDES: u32 = 12;
/// The minimum distance between a label and the border of the picture, in millimeters.
const BORDER_DISTANCE: f64 = 0.8;

/// A label at a world point.
#[derive(Clone, PartialEq, Debug)]
pub struct PointLabel {
    /// The labeled point.
    pub at: Point<World>,
    /// The text, which may have several lines.
    pub text: String,
    /// The offset in pixels, with y down, from the image of the point to the nearest corner of the
    /// text, or to the middle of the nearest side if a component is 0.
    pub offset: DVec2,
    /// The color.
    pub ink: Ink,
    /// The height of capitals in pixels.
    pub height: f64,
    /// Whether a leader line with a dot points to the labeled point.
    pub leader: bool,
}

/// The reason why a label is not in the picture.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum LabelFault {
    /// The point is behind the eye.
    BehindEye,
    /// The point is outside the picture.
    Outside,
}

impl PointLabel {
    /// Returns the reason why the label is not in a picture, or `None` if it is. `view_height` is
    /// the fraction of the picture's height, measured from the top, that shows the view.
    #[must_use]
    pub fn fault(&self, view: &ViewProjection, view_height: f64) -> Option<LabelFault> {
        let clip = view.world_to_clip().transform_point(self.at).raw();
        if clip.w <= 0.0 {
            return Some(LabelFault::BehindEye);
        }
        let [x, y] = [clip.x / clip.w, clip.y / clip.w];
        let is_inside = x.abs() <= 1.0 && y <= 1.0 && y >= 1.0 - 2.0 * view_height;
        (!is_inside).then_some(LabelFault::Outside)
    }
}

/// Returns warnings about labels that are not in the picture and about characters that the font
/// lacks.
#[must_use]
pub fn label_warnings(subject: &Subject<'_>, overlays: &[Overlay]) -> Vec<Warning> {
    let labels = overlays.iter().filter_map(|overlay| match overlay {
        Overlay::Label(label) => Some(label),
        _ => None,
    });
    let warnings = labels.flat_map(|label| {
        let text = || label.text.clone();
        let fault = label.fault(&subject.view_projection, subject.view_height());
        let fault = fault.map(|fault| Warning::LabelNotDrawn { text: text(), fault });
        fault.into_iter().chain(missing_glyph_warning(&label.text))
    });
    warnings.collect()
}

/// Returns a warning if the font lacks characters of a string.
#[must_use]
pub fn missing_glyph_warning(text: &str) -> Option<Warning> {
    let characters = missing_glyphs(text);
    (!characters.is_empty()).then(|| Warning::GlyphsMissing { text: text.to_owned(), characters })
}

impl PicturePlane {
    /// Returns the leader line and text of a label; empty if its point is not in the picture.
    pub(super) fn point_label_layers(
        &self,
        label: &PointLabel,
        subject: &Subject<'_>,
    ) -> Vec<Layer> {
        if label.fault(&subject.view_projection, subject.view_height()).is_some() {
            return Vec::new();
        }
        let image: DVec3 = self.project_point(label.at);
        let at = self.ndc_to_page(image.truncate() / image.z);
        let height = label.height * MILLIMETERS_PER_PIXEL;
        let offset = label.offset * MILLIMETERS_PER_PIXEL;
        let lines: Vec<Label<'_>> =
            label.text.lines().map(|line| Label::new(line, at, height)).collect();
        let width = lines.iter().map(Label::width).fold(0.0, f64::max);
        let pitch = LINE_PITCH * height;
        let extent = DVec2::new(width, height + pitch * lines.len().saturating_sub(1) as f64);
        // The offset from the corner or side nearest to the point back to the upper left corner.
        let back = |offset: f64, extent: f64| match offset {
            x if x > 0.0 => 0.0,
            x if x < 0.0 => -extent,
            _ => -0.5 * extent,
        };
        let back = DVec2::new(back(offset.x, extent.x), back(offset.y, extent.y));
        let low = DVec2::splat(BORDER_DISTANCE);
        let high = self.half * 2.0 * DVec2::new(1.0, subject.view_height()) - low - extent;
        // Keeps the text inside the picture; text that is too large starts at the upper left.
        let corner = (at + offset + back).min(high).max(low);
        let mut text = overlay_layer("label", &format!("label: {}", label.text), label.ink);
        text.pen = Label::new("", at, height).pen(label.ink);
        for (index, line) in lines.into_iter().enumerate() {
            let anchor = corner + DVec2::new(0.0, height + pitch * index as f64);
            text.groups.push(Label { anchor, ..line }.with_align(TextAlign::Start).group());
        }
        let leader = label.leader.then(|| leader_layer(label, [at, corner - back]));
        leader.into_iter().chain([text]).collect()
    }
}

/// Adds a halo under each label to keep it legible: the label's characters, drawn with wider
/// strokes in a contrasting color. Other layers are unchanged.
#[must_use]
pub fn with_label_halos(layers: Vec<Layer>) -> Vec<Layer> {
    let add_halo = |layer: Layer| {
        let halo = is_label(&layer).then(|| {
            let is_dark = layer.pen.ink.iter().map(|code| u32::from(*code)).sum::<u32>() < 384;
            let ink = if is_dark { [255; 3] } else { [0; 3] };
            let pen = Pen { width: layer.pen.width + 2.0 * HALO, ink, ..Pen::solid(HALO, ink) };
            let strokes =
                |group: &Group| Group { strokes: group.strokes.clone(), ..Group::default() };
            let groups = layer.groups.iter().map(strokes).collect();
            let (id, title) =
                (format!("{}-halo", layer.id), format!("halo of the {}", layer.title));
            Layer { groups, ..Layer::new(id, &title, pen) }
        });
        halo.into_iter().chain([layer])
    };
    layers.into_iter().flat_map(add_halo).collect()
}

/// Returns the page rectangles that labels occupy, in millimeters, including a margin.
#[must_use]
pub fn label_rectangles(layers: &[Layer]) -> Vec<[DVec2; 2]> {
    let labels = layers.iter().filter(|layer| is_label(layer));
    let rectangle = |layer: &Layer| {
        let lines = layer.groups.iter().flat_map(|group| &group.strokes);
        let mut points = lines.flat_map(|line| &line.points).map(|point| to_millimeters(*point));
        let first = points.next()?;
        let around = points.fold([first; 2], |[low, high], at| [low.min(at), high.max(at)]);
        let border = DVec2::splat(HALO + 0.5 * layer.pen.width);
        Some([around[0] - border, around[1] + border])
    };
    labels.filter_map(rectangle).collect()
}

/// Whether a layer is the text of a scene label.
fn is_label(layer: &Layer) -> bool {
    layer.id.starts_with("overlay-") && layer.id.ends_with("-label")
}

/// Returns a line from a point to its label, with a dot at the point and a gap before the text.
fn leader_layer(label: &PointLabel, [at, end]: [DVec2; 2]) -> Layer {
    let gap = LEADER_GAP * label.height * MILLIMETERS_PER_PIXEL;
    let end = end - (end - at).normalize_or_zero() * gap;
    let title = format!("leader line: {}", label.text);
    let mut layer = overlay_layer("label-leader", &title, label.ink);
    layer.pen.width = LINE_WIDTH * 0.7;
    let strokes = Polyline::through_points(&[at, end], false).into_iter().collect();
    let corner = |k: u32| {
        let angle = core::f64::consts::TAU * f64::from(k) / f64::from(DOT_SIDES);
        let (sin, cos) = libm::sincos(angle);
        at + DVec2::new(cos, sin) * DOT_RADIUS
    };
    let dot: Vec<DVec2> = (0..DOT_SIDES).map(corner).collect();
    let fills = Polyline::through_points(&dot, true).into_iter().collect();
    layer.groups.push(Group { strokes, fills, ..Group::default() });
    layer
}
