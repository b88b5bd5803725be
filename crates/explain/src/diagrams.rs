//! SVG diagrams of an explanation: the view volume from above and from the side, the canonical
//! volume, and the picture.
//!
//! The diagrams show only numbers from the steps.
//!
//! ```text
//!   view space from above     canonical volume        picture
//!      ╱───────┐               ┌───────┐            ┌───────┐
//!   eye    •   │ far           │   •   │            │    •  │
//!      ╲───────┘               └───────┘            └───────┘
//! ```
//!
//! The point coordinates come from items whose ids begin with `view`, `ndc` or `screen`, so a new
//! subject gets its diagrams without code here. All projections are orthographic along an axis; a
//! frustum keeps its shape because its edges are straight in view space.

use super::plain_text::format_number;
use super::transform_chain::TransformChain;
use super::{Explanation, ItemValue};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use homog::HPoint;
use picture::Picture;

/// The width and height of a volume diagram in SVG user units; the page scales it to the column.
const SIZE: [f64; 2] = [300.0, 220.0];
/// The margin around the contents in SVG user units, with room for labels of extreme points.
const MARGIN: f64 = 24.0;

/// A point of the subject in one space, with its label.
struct LabeledPoint {
    /// The label, such as `a` or `start`; empty for a single point.
    name: String,
    /// Three finite coordinates in the space of the diagram.
    coordinates: Vec<f64>,
}

/// A diagram, with a caption and an SVG element.
///
/// The SVG has classes instead of colors; the page's style sheet sets the colors for light and dark
/// schemes.
pub(super) struct Diagram {
    /// The caption below the diagram.
    pub(super) caption: String,
    /// The SVG element, complete with its closing tag.
    pub(super) svg: String,
}

/// Draws all diagrams for which an explanation has the numbers.
///
/// ```text
///  view from above   (depth ahead, x)      if the view volume is finite
///  view from side    (depth ahead, y)      ″
///  NDC front         (x, y)                if a point survives the divide
///  NDC side          (z, y)                ″
///  picture           (column, row)         if a picture is given
/// ```
/// View space is drawn with the gaze to the right in all conventions: z is negated if view space
/// looks along −z.
pub(super) fn draw_diagrams(
    explanation: &Explanation,
    chain: &TransformChain,
    picture: Option<&Picture>,
) -> Vec<Diagram> {
    let mut figures = Vec::new();
    if let Some(corners) = view_volume_corners(chain) {
        let marks = labeled_points(explanation, "view");
        let ahead = if chain.looks_along_z() { 1.0 } else { -1.0 };
        let plan = |point: &[f64]| [ahead * point[2], point[0]];
        let side = |point: &[f64]| [ahead * point[2], point[1]];
        let volume = |project: &dyn Fn(&[f64]) -> [f64; 2]| corners.map(|c| project(&c));
        figures.push(volume_diagram(
            "View space from above: the gaze to the right, u up",
            volume(&plan),
            &marks,
            plan,
        ));
        figures.push(volume_diagram(
            "View space from the side: the gaze to the right, v up",
            volume(&side),
            &marks,
            side,
        ));
    }
    let marks_of_ndc = labeled_points(explanation, "ndc");
    if !marks_of_ndc.is_empty() {
        let corners = canonical_corners(chain);
        let front = |point: &[f64]| [point[0], point[1]];
        let side = |point: &[f64]| [point[2], point[1]];
        figures.push(volume_diagram(
            "The canonical view volume: x to the right, y up",
            corners.map(|c| front(&c)),
            &marks_of_ndc,
            front,
        ));
        figures.push(volume_diagram(
            "The canonical view volume from the side: z to the right, y up",
            corners.map(|c| side(&c)),
            &marks_of_ndc,
            side,
        ));
    }
    if let Some(picture) = picture {
        figures.push(picture_diagram(chain, picture, &labeled_points(explanation, "screen")));
    }
    figures
}

/// Finds the points in a space by the ids of step items: one point, two ends or three vertices.
///
/// Accepts the id `space` itself and `space_label`. Skips items of other types, homogeneous points
/// (four numbers) and coordinates that are not finite, such as a clip-space point near w = 0.
fn labeled_points(explanation: &Explanation, space: &str) -> Vec<LabeledPoint> {
    let items = explanation.steps.iter().flat_map(|step| &step.items);
    let marks = items.filter_map(|item| {
        let name = item.id.strip_prefix(space)?;
        let name = if name.is_empty() { name } else { name.strip_prefix('_')? };
        let ItemValue::Numbers(point) = &item.value else { return None };
        let is_point = point.len() == 3 && point.iter().all(|c| c.is_finite());
        is_point.then(|| LabeledPoint { name: name.to_owned(), coordinates: point.clone() })
    });
    marks.collect()
}

/// Returns the corners of the canonical volume in NDC: x varies fastest, then y, then z.
///
/// Corner n has bit 0 for right, bit 1 for top and bit 2 for far; [`BOX_EDGES`] relies on this.
fn canonical_corners(chain: &TransformChain) -> [[f64; 3]; 8] {
    let [near, far] = chain.depth_range();
    let side = |bit: usize| if bit == 0 { -1.0 } else { 1.0 };
    std::array::from_fn(|n| [side(n & 1), side(n >> 1 & 1), if n >> 2 == 0 { near } else { far }])
}

/// Returns the corners of the view volume in view space; `None` if it is infinite.
///
/// Maps the corners of the canonical volume back with the inverse projection, p_view = M⁻¹ p_ndc,
/// and divides by w. Infinite far planes give w = 0, and singular projections have no inverse;
/// coordinates beyond 1e12 would reduce the rest of the diagram to a dot.
fn view_volume_corners(chain: &TransformChain) -> Option<[[f64; 3]; 8]> {
    let clip_to_view = chain.view_to_clip().inverse()?;
    let mut corners = [[0.0; 3]; 8];
    for (corner, [x, y, z]) in corners.iter_mut().zip(canonical_corners(chain)) {
        let point = clip_to_view.transform_hpoint(HPoint::new(x, y, z, 1.0)).divide()?;
        *corner = <[f64; 3]>::from(point);
    }
    corners.as_flattened().iter().all(|c| c.abs() < 1e12).then_some(corners)
}

/// The edges of a box by the indices of its corners.
///
/// The two indices of an edge differ in exactly one bit: four edges along x, four along y, four
/// along z.
const BOX_EDGES: [[usize; 2]; 12] = [
    [0, 1],
    [2, 3],
    [4, 5],
    [6, 7],
    [0, 2],
    [1, 3],
    [4, 6],
    [5, 7],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];

/// Draws the diagram of a volume seen along an axis, with the points of the subject.
///
/// `corners` are already projected to the plane of the diagram; `project` projects the points.
/// Diagrams of view space also show the eye, which is the origin there. The window includes points
/// outside the volume, so a clipped point is visible next to the box.
fn volume_diagram(
    caption: &str,
    corners: [[f64; 2]; 8],
    marks: &[LabeledPoint],
    project: impl Fn(&[f64]) -> [f64; 2],
) -> Diagram {
    let projected: Vec<[f64; 2]> = marks.iter().map(|mark| project(&mark.coordinates)).collect();
    let is_view = caption.starts_with("View");
    let origin = is_view.then_some([0.0; 2]);
    let window = DiagramWindow::around_points(corners.iter().chain(&projected).chain(&origin));
    let mut svg = open_svg(SIZE);
    for [from, to] in BOX_EDGES {
        let ([x1, y1], [x2, y2]) =
            (window.to_diagram(corners[from]), window.to_diagram(corners[to]));
        svg += &format!(
            "<line class=\"volume\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>"
        );
    }
    if let Some(eye) = origin {
        let [x, y] = window.to_diagram(eye);
        svg += &format!(
            "<circle class=\"eye\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"/><text x=\"{x:.1}\" y=\"{:.1}\">eye</text>",
            y + 16.0
        );
    }
    let positions: Vec<[f64; 2]> =
        projected.iter().map(|&point| window.to_diagram(point)).collect();
    svg += &subject_svg(marks, &positions, 1.0);
    svg += "</svg>";
    Diagram { caption: caption.to_owned(), svg }
}

/// Draws the diagram of the picture with the points of the subject.
///
/// The user units of this SVG are pixels of the image, so marks need no scaling, only a change to
/// the upper left origin. The PNG is embedded as a base64 data URI and may be smaller than the
/// image: `preserveAspectRatio="none"` stretches it to the full size.
fn picture_diagram(chain: &TransformChain, picture: &Picture, marks: &[LabeledPoint]) -> Diagram {
    let [width, height] = chain.image_size();
    let mut svg = open_svg([width, height]);
    let png = STANDARD.encode(picture.to_png());
    svg += &format!(
        "<image width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" href=\"data:image/png;base64,{png}\"/>"
    );
    let positions: Vec<[f64; 2]> = marks
        .iter()
        .map(|mark| chain.image_coordinates([mark.coordinates[0], mark.coordinates[1]]))
        .collect();
    svg += &subject_svg(marks, &positions, width / SIZE[0]);
    svg += "</svg>";
    let caption =
        format!("The picture, {} × {} pixels", format_number(width), format_number(height));
    Diagram { caption, svg }
}

/// Draws the points with their labels, joined into a polygon if there are several; `unit` scales
/// lines and text.
///
/// `positions` are in SVG user units, one for each mark. A segment is a polygon of two points,
/// drawn as a line. Labels are ids of this program (`a`, `b`, `1`, …) and need no escaping.
fn subject_svg(marks: &[LabeledPoint], positions: &[[f64; 2]], unit: f64) -> String {
    let mut svg = String::new();
    if positions.len() > 1 {
        let corners: Vec<String> =
            positions.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        svg += &format!(
            "<polygon class=\"subject\" stroke-width=\"{:.2}\" points=\"{}\"/>",
            1.5 * unit,
            corners.join(" ")
        );
    }
    for (mark, [x, y]) in marks.iter().zip(positions) {
        svg += &format!(
            "<circle class=\"mark\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{:.1}\" stroke-width=\"{:.1}\"/>",
            4.0 * unit,
            1.5 * unit
        );
        if !mark.name.is_empty() {
            svg += &format!(
                "<text class=\"mark\" x=\"{:.1}\" y=\"{:.1}\" style=\"font-size:{:.1}px\">{}</text>",
                x + 6.0 * unit,
                y - 6.0 * unit,
                12.0 * unit,
                mark.name
            );
        }
    }
    svg
}

/// Returns the opening tag of a diagram.
///
/// `role="img"` makes screen readers announce the diagram as one image, described by its caption.
fn open_svg([width, height]: [f64; 2]) -> String {
    format!("<svg viewBox=\"0 0 {width} {height}\" role=\"img\">")
}

/// The window-to-viewport map of a diagram: from y up to y down, with equal scales on both axes.
///
/// ```text
///  x_svg = SIZE_x / 2 + (x − center_x) · scale
///  y_svg = SIZE_y / 2 − (y − center_y) · scale
/// ```
struct DiagramWindow {
    /// The point mapped to the diagram's center.
    center: [f64; 2],
    /// Diagram units per unit of the plane.
    scale: f64,
}

impl DiagramWindow {
    /// Creates the map that shows all points, centered.
    ///
    /// The smaller of the two axis scales fits both extents. A single point has extent 0; the lower
    /// bound 1e-300 avoids a division by zero, and the point maps to the center.
    fn around_points<'a>(points: impl Iterator<Item = &'a [f64; 2]>) -> Self {
        let (mut min, mut max) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points {
            for axis in 0..2 {
                min[axis] = min[axis].min(point[axis]);
                max[axis] = max[axis].max(point[axis]);
            }
        }
        let scale = |axis: usize| (SIZE[axis] - 2.0 * MARGIN) / (max[axis] - min[axis]).max(1e-300);
        let center = [0, 1].map(|axis| 0.5 * (min[axis] + max[axis]));
        Self { center, scale: scale(0).min(scale(1)) }
    }

    /// Maps a point to the diagram's units.
    fn to_diagram(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [cx, cy] = self.center;
        [0.5 * SIZE[0] + (x - cx) * self.scale, 0.5 * SIZE[1] - (y - cy) * self.scale]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_shows_its_points_at_equal_scales() {
        let points = [[-1.0, 0.0], [3.0, 0.0], [0.0, 1.0]];
        let window = DiagramWindow::around_points(points.iter());
        for point in points {
            let [x, y] = window.to_diagram(point);
            assert!((MARGIN..=SIZE[0] - MARGIN).contains(&x), "{x}");
            assert!((MARGIN..=SIZE[1] - MARGIN).contains(&y), "{y}");
        }
        let ([x0, y0], [x1, y1]) = (window.to_diagram([0.0, 0.0]), window.to_diagram([1.0, 1.0]));
        assert!((x1 - x0 - (y0 - y1)).abs() < 1e-9, "y should point up");
        assert_eq!(
            DiagramWindow::around_points([[2.0, 2.0]].iter()).to_diagram([2.0, 2.0]),
            [150.0, 110.0]
        );
    }
}
