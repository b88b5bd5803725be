//! Scene overlays in the views of a sheet: points with labels, and the world axes.
//!
//! ```text
//!        ridge              a label is beside the object, at the free position closest to its
//!          ╲                point, with a leader line and a dot at the point
//!     ┌─────●─────┐
//!     │     └──►  │  x      axes are drawn over the object, with their names beside it
//!     └───────────┘
//! ```
//!
//! Every parallel view shows every point, even points hidden by the object. Overlays are placed
//! last, after dimensions, and a label for which there is no room is omitted with a warning.

use super::Sheet;
use super::annotation::{
    AnnotationLayer, AnnotationShape, AnnotationText, Extent, ViewAnnotations,
};
use super::balloon_ring::ring_places;
use super::composition::Composition;
use super::sheet_view::SheetView;
use super::view_mark::MarkSettings;
use super::view_plan::{PlannedView, ViewPlan};
use crate::{SheetLabelFault, SheetWarning};
use drawing::{AXES, Overlay, circle_points, missing_glyph_warning};
use glam::DVec2;
use homog::{Bounds, Point, World};
use model::{ModelInstance, world_points};

/// The maximum number of labels in a view. More labels would hide the object and be slow to place.
const MAX_LABELS: usize = 100;

/// The number of rings around the object on which label positions are tried.
const RINGS: u32 = 6;

/// The distance between rings, and between positions on a ring, in character heights.
const STEP: f64 = 1.7;

/// The distance from the end of a leader line to the text, in character heights.
const LEADER_GAP: f64 = 0.35;

/// The radius of the dot at a point, in character heights.
const DOT_RADIUS: f64 = 0.1;
/// The length of arrowheads, in character heights.
const HEAD_LENGTH: f64 = 0.9;

/// The number of corners of a dot.
const DOT_CORNERS: u32 = 12;

/// Points farther from the object than this fraction of its longer side get no label.
const FARTHEST: f64 = 0.25;

/// The length of an axis as a fraction of the models' diagonal, the same as in pictures.
const AXIS_LENGTH: f64 = 0.6;

/// The overlays of a view, in object millimeters from its center, with y down.
#[derive(Clone, Debug, Default)]
pub(super) struct ViewOverlays {
    /// Points with their labels.
    labels: Vec<(DVec2, String)>,
    /// Axes, from the origin to their ends, with their names.
    axes: Vec<([DVec2; 2], &'static str)>,
}

impl ViewPlan {
    /// Adds labels and axes to all views except details and broken views, and warns about overlays
    /// that sheets do not show.
    pub(super) fn add_overlays(&mut self, sheet: &Sheet, models: &[ModelInstance]) {
        if sheet.overlays.is_empty() {
            return;
        }
        let bounds = Bounds::from_points(world_points(models));
        let diagonal = bounds.map_or(0.0, Bounds::diagonal);
        let Self { principal, free, requested, warnings } = self;
        warnings.extend(sheet.overlays.iter().filter_map(overlay_warning));
        let usual = principal.iter_mut().chain(free.iter_mut()).filter(|_| requested.is_empty());
        let mut planned: Vec<&mut PlannedView> = usual.collect();
        if planned.is_empty() {
            planned.extend(requested);
        }
        for one in planned {
            let is_broken = matches!(one.composition, Composition::Broken(_));
            if one.detail_radius.is_none() && !is_broken {
                one.overlays = ViewOverlays::in_view(&one.view, &sheet.overlays, diagonal);
            }
        }
    }
}

/// Returns a warning if sheets cannot show an overlay, or cannot show all characters of a label.
fn overlay_warning(overlay: &Overlay) -> Option<SheetWarning> {
    let overlay = match overlay {
        Overlay::Grid(_) => "grid",
        Overlay::Horizon => "horizon",
        Overlay::VanishingPoints => "vanishing points",
        Overlay::Volume(_) => "view volume",
        Overlay::Label(label) => {
            return missing_glyph_warning(&label.text).map(SheetWarning::from);
        }
        // Sheets always draw edges.
        Overlay::Axes(_) | Overlay::Edges => return None,
    };
    Some(SheetWarning::OverlayNotOnSheets { overlay: overlay.to_owned() })
}

impl ViewOverlays {
    /// Returns the labels and axes of a view, for models with the given diagonal.
    fn in_view(view: &SheetView, overlays: &[Overlay], diagonal: f64) -> Self {
        let mut own = Self::default();
        for overlay in overlays {
            match overlay {
                Overlay::Label(label) => {
                    own.labels.push((view.image_of(label.at), label.text.clone()));
                }
                Overlay::Axes(length) => {
                    own.add_axes(view, length.unwrap_or(AXIS_LENGTH * diagonal));
                }
                _ => {}
            }
        }
        own
    }

    /// Adds the axes that are not along the view direction.
    fn add_axes(&mut self, view: &SheetView, length: f64) {
        for (direction, name, _) in AXES {
            let tip: Point<World> = Point::ORIGIN + direction * length;
            let ends = [Point::ORIGIN, tip].map(|point| view.image_of(point));
            if ends[0].distance(ends[1]) > 1e-6 * length * view.millimeters_per_unit {
                self.axes.push((ends, name));
            }
        }
    }

    /// Adds the overlays at a scale, clear of everything placed so far.
    pub(super) fn annotate(&self, annotations: &mut ViewAnnotations, settings: &MarkSettings) {
        let MarkSettings { ratio, object, letters } = *settings;
        let board = LabelBoard { object, letters };
        for (ends, name) in &self.axes {
            board.add_axis(annotations, ends.map(|end| end * ratio), name);
        }
        for (number, (point, text)) in self.labels.iter().enumerate() {
            let at = *point * ratio;
            let fault = if number >= MAX_LABELS {
                SheetLabelFault::TooMany
            } else if !board.reaches(at) {
                SheetLabelFault::Far
            } else if !board.add_label(annotations, at, text, true) {
                SheetLabelFault::NoRoom
            } else {
                continue;
            };
            annotations.labels_left_out.push((text.clone(), fault));
        }
    }
}

/// The space for labels around an object.
struct LabelBoard {
    object: Extent,
    letters: f64,
}

impl LabelBoard {
    /// Whether a point is on or near the object.
    fn reaches(&self, point: DVec2) -> bool {
        let [low, high] = self.object;
        let far = FARTHEST * (high - low).max_element();
        point.cmpge(low - far).all() && point.cmple(high + far).all()
    }

    /// Adds an axis with its arrowhead and name. The axis ends before it gets too far from the
    /// object or crosses a label.
    fn add_axis(&self, annotations: &mut ViewAnnotations, [from, to]: [DVec2; 2], name: &str) {
        const PARTS: i32 = 40;
        let ends = (1..=PARTS).map(|k| from.lerp(to, f64::from(k) / f64::from(PARTS)));
        let is_drawn = |end: &DVec2| self.reaches(*end) && annotations.is_clear([from, *end]);
        let drawn: Vec<DVec2> = ends.take_while(is_drawn).collect();
        // An arrowhead on another line would be misread.
        let is_apart = |tip: &&DVec2| {
            let around = [**tip - 0.5 * self.letters, **tip + 0.5 * self.letters];
            annotations.is_empty_area(around, [DVec2::INFINITY; 2])
        };
        let Some(tip) = drawn.iter().rfind(is_apart).or(drawn.last()).copied() else { return };
        let along = (to - from).normalize_or(DVec2::X);
        let head = along * (HEAD_LENGTH * self.letters);
        let across = head.perp() / 6.0;
        annotations.push_line(AnnotationLayer::OverlayLines, [from, tip]);
        // The name is placed first, because its leader line begins at the arrowhead.
        if !self.add_label(annotations, tip, name, false) {
            annotations.labels_left_out.push((name.to_owned(), SheetLabelFault::NoRoom));
        }
        let head = AnnotationShape::Head([tip, tip - head + across, tip - head - across]);
        annotations.push(AnnotationLayer::OverlayLines, head);
    }

    /// Adds a label at the free position closest to a point, with a leader line unless the label is
    /// next to the point. Returns `false` if there is no such position.
    fn add_label(
        &self,
        annotations: &mut ViewAnnotations,
        point: DVec2,
        text: &str,
        has_dot: bool,
    ) -> bool {
        let layer = AnnotationLayer::OverlayTexts;
        for (text, leader) in self.candidates(point, text) {
            let is_clear = leader.is_none_or(|line| annotations.is_clear(line));
            if !is_clear || !annotations.is_free(&text, self.object) {
                continue;
            }
            let lines = AnnotationLayer::OverlayLines;
            leader.into_iter().for_each(|line| annotations.push_line(lines, line));
            if has_dot {
                annotations.push(lines, AnnotationShape::Loop(self.dot(point)));
            }
            annotations.push(layer, AnnotationShape::Text(text));
            return true;
        }
        false
    }

    /// Returns positions for a label on rings around the object, each with a leader line if needed.
    /// Positions closest to the point come first.
    fn candidates(
        &self,
        point: DVec2,
        text: &str,
    ) -> impl Iterator<Item = (AnnotationText, Option<[DVec2; 2]>)> {
        let width = page::Label::new(text, DVec2::ZERO, self.letters).width();
        let half = DVec2::new(width, self.letters) * 0.5;
        let step = STEP * self.letters;
        let mut middles = Vec::new();
        for ring in 0..RINGS {
            let away = half + 0.5 * self.letters + step * f64::from(ring);
            let (low, high) = (self.object[0] - away, self.object[1] + away);
            middles.extend(ring_places([low, high], step));
            // Add the positions directly across from the point.
            let [x, y] = point.clamp(low, high).to_array();
            middles.extend([[low.x, y], [high.x, y], [x, low.y], [x, high.y]].map(DVec2::from));
        }
        // Add positions beside the point, in case it is not on the object.
        let beside = half + 0.5 * self.letters;
        let around = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]].map(DVec2::from);
        let corners = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(DVec2::from);
        middles.extend(around.into_iter().chain(corners).map(|way| point + way * beside));
        let nearest = move |middle: DVec2| point.clamp(middle - half, middle + half);
        let distance = |middle: &DVec2| nearest(*middle).distance_squared(point);
        middles.sort_by(|a, b| {
            distance(a).total_cmp(&distance(b)).then(a.x.total_cmp(&b.x)).then(a.y.total_cmp(&b.y))
        });
        let (letters, text) = (self.letters, text.to_owned());
        middles.into_iter().map(move |middle| {
            let end = nearest(middle);
            let away = (point - end).normalize_or_zero() * (LEADER_GAP * letters);
            let needs_leader = end.distance(point) > letters;
            let leader = needs_leader.then(|| [point, end + away]);
            (AnnotationText::centered(text.clone(), middle, letters), leader)
        })
    }

    /// Returns the outline of a small dot at a point.
    fn dot(&self, point: DVec2) -> Vec<DVec2> {
        circle_points(point, DOT_RADIUS * self.letters, DOT_CORNERS)
    }
}
