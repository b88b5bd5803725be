//! The sheet frame (ISO 5457): margins, a border line of 0.7 mm and centering marks.
//!
//! The margin is 20 mm on the left, for filing, and 10 mm elsewhere.

use super::annotation::{Extent, overlap};
use super::frame_zones::{SheetFrame, ZONE_BORDER};
use super::rectangle_from_size;
use glam::DVec2;
use page::{Cap, Group, Ink, Join, Layer, Pen, Polyline};
use viewport::{Paper, Rectangle};

/// The left margin in millimeters.
const FILING_MARGIN: f64 = 20.0;
/// The other margins in millimeters.
const MARGIN: f64 = 10.0;

/// The width of the frame's line in millimeters.
const FRAME_LINE_WIDTH: f64 = 0.7;

/// The distance from the centering marks to the edge of the paper, and the length of the marks
/// inside the drawing area, in millimeters.
const CENTERING_MARK: [f64; 2] = [5.0, 5.0];

/// The minimum distance from the inner part of a centering mark to anything else, in millimeters.
const MARK_CLEARANCE: f64 = 1.0;

/// Returns the drawing area inside the frame. On small paper, each margin is at most a tenth of the
/// width or height.
pub(super) fn area_within_frame(paper: Paper) -> Rectangle {
    let margin = |margin: f64, side: f64| margin.min(side * 0.1);
    let (left, right) = (margin(FILING_MARGIN, paper.width()), margin(MARGIN, paper.width()));
    let edge = margin(MARGIN, paper.height());
    rectangle_from_size(left, edge, paper.width() - left - right, paper.height() - 2.0 * edge)
}

/// Returns the frame with its centering marks, which stop at the frame if something is in their
/// way.
pub(super) fn frame_layer(paper: Paper, style: SheetFrame, contents: &[Extent], ink: Ink) -> Layer {
    let pen = Pen { cap: Cap::Butt, join: Join::Miter, ..Pen::solid(FRAME_LINE_WIDTH, ink) };
    let mut layer = Layer::new("frame", "frame", pen);
    let mut strokes = vec![rectangle_outline(area_within_frame(paper))];
    strokes.extend(centering_marks(paper, style, contents));
    layer.groups.push(Group { strokes, ..Group::default() });
    layer
}

/// Returns the border of a rectangle.
pub(super) fn rectangle_outline(area: Rectangle) -> Polyline {
    let (x, y) = (area.x(), area.y());
    let (right, bottom) = (x + area.width(), y + area.height());
    let corners = [[x, y], [right, y], [right, bottom], [x, bottom]].map(DVec2::from);
    Polyline::through_points(&corners, true)
        .unwrap_or(Polyline { points: vec![[0, 0], [1, 0]], closed: false })
}

/// Returns the marks in the middle of each side, which help align the sheet in a copier.
fn centering_marks(paper: Paper, style: SheetFrame, contents: &[Extent]) -> Vec<Polyline> {
    let size = DVec2::new(paper.width(), paper.height());
    let (middle, area) = (size * 0.5, area_within_frame(paper));
    let (left, top) = (area.x(), area.y());
    let (right, bottom) = (left + area.width(), top + area.height());
    let [inset, length] = CENTERING_MARK;
    let start = match style {
        SheetFrame::Plain => inset,
        SheetFrame::Zones => left - ZONE_BORDER,
    };
    // The outer end of each mark, its point on the frame, and its direction.
    let marks = [
        [DVec2::new(start, middle.y), DVec2::new(left, middle.y), DVec2::X],
        [DVec2::new(size.x - inset, middle.y), DVec2::new(right, middle.y), -DVec2::X],
        [DVec2::new(middle.x, inset), DVec2::new(middle.x, top), DVec2::Y],
        [DVec2::new(middle.x, size.y - inset), DVec2::new(middle.x, bottom), -DVec2::Y],
    ];
    let to_line = |[outer, at_frame, inward]: [DVec2; 3]| {
        let inner = at_frame + inward * length;
        let around = [at_frame.min(inner) - MARK_CLEARANCE, at_frame.max(inner) + MARK_CLEARANCE];
        let is_free = !contents.iter().any(|area| overlap(*area, around));
        Polyline::through_points(&[outer, if is_free { inner } else { at_frame }], false)
    };
    marks.into_iter().filter_map(to_line).collect()
}
