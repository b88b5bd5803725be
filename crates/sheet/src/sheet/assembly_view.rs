//! Assembly page: a view of all parts, in place or exploded, with balloons around it and the parts
//! list above the title block.
//!
//! ```text
//!   ┌──────────────────────────────┐
//!   │  ①   ②   ③   ④              │     the view is as large as its region of the sheet allows;
//!   │  ⑤  ┌────────┐  ⑥           │     the balloons surround it as closely as space allows
//!   │  ⑦  │  view  │  ⑧ ┌─────────┤
//!   │     └────────┘    │  list   │
//!   │  ⑨   ⑩   ⑪      ├─────────┤
//!   └───────────────────┴─────────┘
//! ```

use super::annotation::Extent;
use super::balloon_ring::{clear_places, ring_places, shortest_places};
use super::sheet_view::SheetView;
use super::visible_spots::VisibleSpot;
use super::{Sheet, rectangle_from_size};
use crate::assembly::PartsListItem;
use glam::DVec2;
use page::{Group, Ink, Label, Layer, Pen, Polyline, TextAlign};
use viewport::{DrawingScale, Rectangle};

/// The distance from the view or its balloons to the frame, in millimeters. It is large enough to
/// clear the centering marks.
const BORDER_GAP: f64 = 6.0;

/// The distance from the view to the balloons, in millimeters.
const VIEW_GAP: f64 = 5.0;

/// The minimum distance between balloons, in millimeters. Leaders clear other balloons by half.
const BALLOON_GAP: f64 = 2.5;

/// The number of steps between the rings to try, from the view to the border.
const RING_STEPS: u32 = 5;

/// The balloon distances to try on each ring, as multiples of the minimum. When balloons are
/// farther apart, leaders can pass between them at flatter angles.
const SPREADS: [f64; 3] = [1.0, 1.4, 2.0];

/// The radius of the dot at the end of a leader, in character heights.
const DOT_RADIUS: f64 = 0.15;

/// The number of corners of balloons and dots.
const CIRCLE_CORNERS: u32 = 48;

/// The position of a view on its page.
#[derive(Clone, Copy, Debug)]
pub(super) struct AssemblyLayout {
    pub(super) center: DVec2,
    pub(super) scale: DrawingScale,
    /// The part of the sheet available for the view and balloons.
    region: Extent,
    /// Half the size of the view on the page.
    half: DVec2,
    /// The radius of balloons, or 0 if there are none.
    radius: f64,
    letters: f64,
}

/// An item, and the spot where its leader ends, in millimeters on the page.
#[derive(Clone, Copy, Debug)]
pub(super) struct BalloonTarget<'a> {
    pub(super) item: &'a PartsListItem,
    pub(super) spot: DVec2,
}

impl AssemblyLayout {
    /// Returns the layout with the largest scale at which the view fits beside or above the title
    /// block and parts list, or `None` if it does not fit at any standard scale.
    ///
    /// `count` is the maximum number of balloons; 0 means none.
    pub(super) fn arrange(
        sheet: &Sheet,
        view: &SheetView,
        list: Option<Rectangle>,
        count: usize,
    ) -> Option<Self> {
        let letters = sheet.lettering_height();
        let radius = if count > 0 { balloon_radius(count, letters) } else { 0.0 };
        let around = if count > 0 { VIEW_GAP + 2.0 * radius + 1.0 } else { 0.0 };
        let fitting = |region: Extent| {
            let room = region[1] - region[0] - DVec2::splat(2.0 * around);
            // Try the requested scale first, then the standard scales from the largest down.
            let own = sheet.scale.into_iter().chain(DrawingScale::STANDARD);
            let fits = |scale: &DrawingScale| (view.size * scale.ratio()).cmple(room).all();
            let scale = own.into_iter().find(fits)?;
            let center = super::view_layout::snap_to_grid((region[0] + region[1]) * 0.5);
            let half = view.size * scale.ratio() * 0.5;
            Some(Self { center, scale, region, half, radius, letters })
        };
        let better = |a: Self, b: Self| {
            let area = |one: &Self| (one.region[1] - one.region[0]).element_product();
            let is_larger =
                b.scale.ratio() > a.scale.ratio() || b.scale == a.scale && area(&b) > area(&a);
            if is_larger { b } else { a }
        };
        free_regions(sheet, list).into_iter().filter_map(fitting).reduce(better)
    }

    /// Returns the number of balloons that fit around the view.
    pub(super) fn capacity(&self) -> usize {
        ring_places(self.ring(1.0), self.pitch()).len()
    }

    /// Returns the distance between neighboring balloons.
    fn pitch(&self) -> f64 {
        2.0 * self.radius + BALLOON_GAP
    }

    /// Returns the rectangle on which balloon centers are placed, around the view if `part` is 0,
    /// at the border if `part` is 1.
    fn ring(&self, part: f64) -> Extent {
        let [low, high] = self.region;
        let near = self.half + DVec2::splat(VIEW_GAP + self.radius);
        let outer = [low + self.radius, high - self.radius];
        let inner = [(self.center - near).max(outer[0]), (self.center + near).min(outer[1])];
        [inner[0].lerp(outer[0], part), inner[1].lerp(outer[1], part)]
    }

    /// Converts a spot in the view to a point on the page.
    pub(super) fn on_page(&self, spot: &VisibleSpot, view: &SheetView) -> DVec2 {
        self.center + spot.at * (view.millimeters_per_unit * self.scale.ratio())
    }

    /// Chooses a balloon center for each spot, or `None` if the spot's balloon does not fit.
    ///
    /// Uses the ring nearest to the view on which all balloons fit. If they fit on no ring, uses the
    /// ring on which the most leaders stay clear of other balloons.
    fn choose_places(&self, spots: &[DVec2]) -> Vec<Option<DVec2>> {
        let clearance = self.radius + 0.5 * BALLOON_GAP;
        let rings = (0..=RING_STEPS).map(|step| self.ring(f64::from(step) / f64::from(RING_STEPS)));
        let rings: Vec<Extent> = rings.collect();
        for ring in &rings {
            for spread in SPREADS {
                let places = ring_places(*ring, self.pitch() * spread);
                if let Some(centers) = shortest_places(spots, &places, clearance) {
                    return centers.into_iter().map(Some).collect();
                }
            }
        }
        let mut best = vec![None; spots.len()];
        for ring in &rings {
            let centers = clear_places(spots, &ring_places(*ring, self.pitch()), clearance);
            if centers.iter().flatten().count() > best.iter().flatten().count() {
                best = centers;
            }
        }
        best
    }

    /// Returns the layers with balloons and with their numbers, and the items that have no room.
    pub(super) fn balloon_layers<'a>(
        &self,
        targets: &[BalloonTarget<'a>],
        width: f64,
        ink: Ink,
    ) -> ([Layer; 2], Vec<&'a PartsListItem>) {
        let spots: Vec<DVec2> = targets.iter().map(|target| target.spot).collect();
        let centers = self.choose_places(&spots);
        let pen = Pen { cap: page::Cap::Butt, ..Pen::solid(width, ink) };
        let mut lines = Layer::new("balloons", "balloons", pen);
        let lettering = Pen::solid(self.letters * 0.1, ink);
        let mut numbers = Layer::new("balloon-numbers", "balloons: numbers", lettering);
        let mut left_out = Vec::new();
        for (target, center) in targets.iter().zip(centers) {
            let Some(center) = center else {
                left_out.push(target.item);
                continue;
            };
            lines.groups.push(self.balloon_group(target, center));
            let text = target.item.number.to_string();
            let at = center + DVec2::Y * (0.5 * self.letters);
            let label = Label::new(&text, at, self.letters).with_align(TextAlign::Middle);
            numbers.groups.push(label.group());
        }
        ([lines, numbers], left_out)
    }

    /// Returns the balloon of an item, with its leader and the dot at the leader's end.
    fn balloon_group(&self, target: &BalloonTarget<'_>, center: DVec2) -> Group {
        let away = (target.spot - center).normalize_or(DVec2::Y);
        let leader = [center + away * self.radius, target.spot];
        let strokes = [circle(center, self.radius), Polyline::through_points(&leader, false)];
        let dot = circle(target.spot, DOT_RADIUS * self.letters);
        Group {
            id: target.item.number.to_string(),
            title: target.item.name.clone(),
            strokes: strokes.into_iter().flatten().collect(),
            fills: dot.into_iter().collect(),
            ..Group::default()
        }
    }
}

/// Returns a balloon radius with ample room for the widest number up to `count`.
fn balloon_radius(count: usize, letters: f64) -> f64 {
    let digits = count.to_string().len();
    let widest = "0".repeat(digits);
    let half = DVec2::new(Label::new(&widest, DVec2::ZERO, letters).width(), letters) * 0.5;
    (half.length() + 0.35 * letters).max(1.25 * letters)
}

/// Returns a circle as a polygon.
fn circle(center: DVec2, radius: f64) -> Option<Polyline> {
    let corner = |k: u32| {
        let angle = core::f64::consts::TAU * f64::from(k) / f64::from(CIRCLE_CORNERS);
        center + DVec2::new(libm::cos(angle), libm::sin(angle)) * radius
    };
    let corners: Vec<DVec2> = (0..CIRCLE_CORNERS).map(corner).collect();
    Polyline::through_points(&corners, true)
}

/// Returns the parts of the drawing area that the title block and the list above it leave free: the
/// area above both, and the area beside them.
fn free_regions(sheet: &Sheet, list: Option<Rectangle>) -> Vec<Extent> {
    let (frame, block) = (sheet.drawing_area(), sheet.title_block_area());
    let top = list.map_or(block.y(), |list| list.y());
    let above = rectangle_from_size(frame.x(), frame.y(), frame.width(), top - frame.y());
    let beside = rectangle_from_size(frame.x(), frame.y(), block.x() - frame.x(), frame.height());
    let region = |area: Rectangle| {
        let low = DVec2::new(area.x(), area.y());
        [low + BORDER_GAP, low + DVec2::new(area.width(), area.height()) - BORDER_GAP]
    };
    [above, beside].map(region).into_iter().filter(|[low, high]| low.cmplt(*high).all()).collect()
}
