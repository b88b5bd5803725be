//! Wrap-around at w = 0: a floor that extends from in front of the eye to behind it, once divided
//! without clipping and once clipped first (C36).
//!
//! ```text
//!    from the side                  divided at once            clipped first
//!                  eye
//!    ═══════════════●═══════         ╲ ╱  behind the eye:         /   \
//!    ahead        w = 0  behind       ╳   upside down,           /     \
//!                                    ╱ ╲  in the sky            /       \
//! ```
//! The image of a point at z = −ε is far below, and at z = +ε far above. The image of the segment
//! between them passes through infinity, so the line that connects the images of its ends is
//! exactly the part outside the true image. Clipping against the near plane before the divide
//! leaves only w > 0.

use super::DemonstrationError;
use super::number_format::format_short;
use camera::Camera;
use clip::{Volume, clip_convex, clip_segment};
use drawing::{Page, Panel, Panels};
use glam::DVec2;
use homog::{Clip, HPoint, Ndc, Point, Projective, Vector, World};
use page::{Cap, Group, Ink, Join, Label, Layer, LineType, Pen, Polyline, TextAlign};
use projection::{Convention, Fov, Perspective};

/// The color of boards in front of the eye.
const INK: Ink = [26, 31, 38];
/// The color of boards that cross the plane of the eye.
const RED: Ink = [179, 38, 30];
/// The color of boards behind the eye.
const BLUE: Ink = [26, 86, 176];

/// The width and height of each picture in millimeters.
const PICTURE_SIZE: DVec2 = DVec2::new(88.0, 66.0);
/// The text height in millimeters.
const LETTER_HEIGHT: f64 = 2.2;
/// The line width of boards in millimeters.
const STROKE_WIDTH: f64 = 0.35;

/// The eye's height above the floor.
const EYE_HEIGHT: f64 = 1.6;
/// The distance of the near plane.
const NEAR: f64 = 0.5;
/// The distance of the far plane.
const FAR: f64 = 40.0;

/// The z coordinates at which rows of boards begin and end, from far in front of the eye to behind
/// it. The third row crosses the plane of the eye, z = 0.
const BOARD_ENDS: [f64; 5] = [-15.0, -9.0, -3.0, 3.0, 9.0];
/// The x coordinates of the borders between boards.
const BOARD_BORDERS: [f64; 5] = [-2.0, -1.0, 0.0, 1.0, 2.0];

/// The layers of boards by position relative to the eye: id, title and color.
const BOARD_KINDS: [(&str, &str, Ink); 3] = [
    ("ahead", "boards in front of the eye", INK),
    ("crossing", "boards that cross the plane of the eye", RED),
    ("behind", "boards behind the eye", BLUE),
];

/// A board of the floor: the index of its layer and its corners.
///
/// The board is in the plane y = 0 and measures 1 × 6 world units.
struct Board {
    /// Index into [`BOARD_KINDS`].
    kind: usize,
    /// The corners in order around the board.
    corners: [Point<World>; 4],
}

/// Draws the floor three times: from the side, divided without clipping, and clipped first.
///
/// The page depends only on the constants in this file. The notes state w and the images of two
/// pairs of points, and the number of boards left after clipping.
///
/// # Errors
/// Never fails in practice, because the camera and projection are constants.
pub fn wraparound_panels() -> Result<Panels, DemonstrationError> {
    let world_to_clip = world_to_clip()?;
    let boards = floor_boards();
    let panels = vec![
        side_panel(&boards),
        divided_panel(&boards, world_to_clip),
        clipped_panel(&boards, world_to_clip),
    ];
    Ok(Panels::new("Clip before the divide: a floor that extends behind the eye", panels))
}

/// Returns the transform from the world to the chapter's canonical volume (PE-3), looking along −z.
///
/// The vertical field of view is 60°. For points on the floor w = −z, so the sign of z
/// distinguishes front from back.
fn world_to_clip() -> Result<Projective<World, Clip>, DemonstrationError> {
    let eye = Point::new(0.0, EYE_HEIGHT, 0.0);
    let camera = Camera::look_to(eye, -Vector::Z, Vector::Y)?;
    let lens = Perspective::new(
        Fov::Vertical(60_f64.to_radians()),
        PICTURE_SIZE.x / PICTURE_SIZE.y,
        NEAR,
        FAR,
    )?;
    Ok(camera.world_to_view().then_project(lens.view_to_clip(Convention::CHAPTER)))
}

/// Returns the boards of the floor, row by row.
///
/// There are four rows of four boards. A row is in front if it ends at z < 0 and behind if it
/// begins at z ≥ 0; otherwise it crosses the plane of the eye.
fn floor_boards() -> Vec<Board> {
    let mut boards = Vec::new();
    for end in BOARD_ENDS.windows(2) {
        let kind = if end[1] < 0.0 {
            0
        } else if end[0] < 0.0 {
            1
        } else {
            2
        };
        for border in BOARD_BORDERS.windows(2) {
            let corner = |x: usize, z: usize| Point::new(border[x], 0.0, end[z]);
            boards.push(Board {
                kind,
                corners: [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)],
            });
        }
    }
    boards
}

/// Draws the scene from the side. The camera looks to the left, so the visible part is to the left
/// of the eye.
///
/// This is an orthographic view along −x at 3.2 mm per world unit, drawn directly on the page and
/// not through the pipeline. Dashed lines show the plane of the eye and the near plane; thin lines
/// show the field of view of 60°.
fn side_panel(boards: &[Board]) -> Panel {
    let position = |z: f64, y: f64| DVec2::new(56.0 + z * 3.2, 40.0 - y * 3.2);
    let line = |a: [f64; 2], b: [f64; 2]| {
        Polyline::through_points(&[position(a[0], a[1]), position(b[0], b[1])], false)
    };
    let floor = |kind: usize| {
        let boards_of_kind = boards.iter().filter(|board| board.kind == kind);
        let lines =
            boards_of_kind.filter_map(|b| line([b.corners[0].z(), 0.0], [b.corners[2].z(), 0.0]));
        lines.collect()
    };
    let mut page = Page::new(PICTURE_SIZE, "from the side", None);
    let floors = BOARD_KINDS.iter().enumerate();
    page.layers
        .extend(floors.map(|(kind, &(id, title, ink))| stroke_layer(id, title, ink, floor(kind))));
    let slope = libm::tan(30_f64.to_radians());
    let planes =
        [line([0.0, -3.0], [0.0, 7.0]), line([-NEAR, EYE_HEIGHT - 1.2], [-NEAR, EYE_HEIGHT + 1.2])];
    let mut dashed = LineType::Dashed.to_pen(0.18, INK, Cap::Butt, Join::Round);
    dashed.ink = [110, 116, 124];
    let mut plane = Layer::new("planes", "the plane of the eye and the near plane", dashed);
    plane.groups.push(stroke_group(planes.into_iter().flatten().collect()));
    let angle =
        [-1.0, 1.0].map(|side| line([0.0, EYE_HEIGHT], [-10.0, EYE_HEIGHT + side * 10.0 * slope]));
    let angle = stroke_layer(
        "angle",
        "field of view",
        [110, 116, 124],
        angle.into_iter().flatten().collect(),
    );
    let mut strokes = label_strokes("eye", position(0.6, EYE_HEIGHT), TextAlign::Start);
    strokes.extend(label_strokes("w = 0", position(0.0, 7.4), TextAlign::Middle));
    strokes.extend(label_strokes("w > 0", position(-7.5, -1.3), TextAlign::End));
    strokes.extend(label_strokes("w < 0", position(2.0, -1.3), TextAlign::Start));
    let words = stroke_layer("words", "names", INK, strokes);
    page.layers.extend([plane, with_thin_pen(angle), with_thin_pen(words)]);
    let notes = vec![
        format!("eye at height {EYE_HEIGHT}, looking along -z; near plane at {NEAR}"),
        "black boards are in front of the eye, red ones cross its plane, blue ones are behind it"
            .to_owned(),
    ];
    let (id, title) = ("side".to_owned(), "from the side".to_owned());
    Panel { id, title, notes, page }
}

/// Draws the boards divided without clipping: the connected images of their corners.
///
/// This is the mistake that the lesson demonstrates: if w has different signs at two corners, the
/// segment between their images is the complement of the true image. The drawing is clipped to the
/// picture only afterward, which cannot correct it.
fn divided_panel(boards: &[Board], map: Projective<World, Clip>) -> Panel {
    let outline = |board: &Board| -> Vec<Polyline> {
        let images = board.corners.map(|corner| map.transform_point(corner).divide());
        let sides = (0..4).filter_map(|n| Some([images[n]?, images[(n + 1) % 4]?]));
        sides.filter_map(clip_to_picture).collect()
    };
    let image = |x: f64, z: f64| describe_image(map, Point::new(x, 0.0, z));
    let notes = vec![
        format!("(1, 0, -3) {}; (1, 0, 3) {}", image(1.0, -3.0), image(1.0, 3.0)),
        format!("(1, 0, -0.01) {}; (1, 0, 0.01) {}", image(1.0, -0.01), image(1.0, 0.01)),
    ];
    boards_panel("divided", "divided without clipping", notes, boards, outline)
}

/// Draws the boards clipped against the view volume and then divided.
///
/// Clips polygons in homogeneous space (Sutherland and Hodgman, 1974; CL-3). Every remaining vertex
/// has w ≥ near, and the smallest w is printed. Boards behind the eye disappear, and crossing
/// boards keep their front part.
fn clipped_panel(boards: &[Board], map: Projective<World, Clip>) -> Panel {
    let ring = |board: &Board| {
        clip_convex(&board.corners.map(|corner| map.transform_point(corner)), &Volume::CHAPTER)
    };
    let outline = |board: &Board| -> Vec<Polyline> {
        let images: Vec<Point<Ndc>> =
            ring(board).points().iter().filter_map(|p| p.divide()).collect();
        let positions: Vec<DVec2> = images.into_iter().map(to_page).collect();
        Polyline::through_points(&positions, true).into_iter().collect()
    };
    let least = boards.iter().flat_map(|board| ring(board).points().to_vec()).map(HPoint::w);
    let least = least.fold(f64::INFINITY, f64::min);
    let count = |kind: usize| {
        let boards_of_kind = boards.iter().filter(|board| board.kind == kind);
        let left = boards_of_kind.clone().filter(|board| !ring(board).is_empty()).count();
        format!("{left} of {} {}", boards_of_kind.count(), BOARD_KINDS[kind].0)
    };
    let notes = vec![
        format!("remaining: {}, {}, {}", count(0), count(1), count(2)),
        format!("the smallest divisor w is {}", format_short(least, 4)),
    ];
    boards_panel("clipped", "clipped first", notes, boards, outline)
}

/// Returns a picture of the board outlines.
///
/// Each kind of board has a layer; empty layers are dropped.
fn boards_panel(
    id: &str,
    title: &str,
    notes: Vec<String>,
    boards: &[Board],
    outline: impl Fn(&Board) -> Vec<Polyline>,
) -> Panel {
    let mut page = Page::new(PICTURE_SIZE, title, None);
    for (kind, &(layer_id, layer_title, ink)) in BOARD_KINDS.iter().enumerate() {
        let boards_of_kind = boards.iter().filter(|board| board.kind == kind);
        let strokes = boards_of_kind.flat_map(&outline).collect();
        page.layers.push(stroke_layer(layer_id, layer_title, ink, strokes));
    }
    page.layers.retain(|layer| !layer.groups[0].strokes.is_empty());
    Panel { id: id.to_owned(), title: title.to_owned(), notes, page }
}

/// Returns the part of a line between two images that is inside the picture.
///
/// It reuses homogeneous segment clipping with w = 1 and z = 0. The result is `None` if the line
/// misses the picture.
fn clip_to_picture([a, b]: [Point<Ndc>; 2]) -> Option<Polyline> {
    // The points are already divided, so w is 1, and depth is irrelevant.
    let flat = |p: Point<Ndc>| HPoint::<Clip>::new(p.x(), p.y(), 0.0, 1.0);
    let visible = clip_segment(flat(a), flat(b), &Volume::CHAPTER)?;
    Polyline::through_points(
        &[to_page(visible.start.divide()?), to_page(visible.end.divide()?)],
        false,
    )
}

/// Converts NDC to millimeters on the page, with y down.
fn to_page(image: Point<Ndc>) -> DVec2 {
    (DVec2::new(image.x(), -image.y()) + 1.0) * 0.5 * PICTURE_SIZE
}

/// Describes w and the image of a point.
///
/// Image coordinates are NDC and may be far outside [−1, 1].
fn describe_image(map: Projective<World, Clip>, point: Point<World>) -> String {
    let clip = map.transform_point(point);
    let Some(image) = clip.divide() else { return "has no image".to_owned() };
    let [w, x, y] = [clip.w(), image.x(), image.y()].map(|number| format_short(number, 3));
    format!("has w = {w} and maps to ({x}, {y})")
}

/// Returns text as strokes.
fn label_strokes(words: &str, at: DVec2, align: TextAlign) -> Vec<Polyline> {
    Label::new(words, at, LETTER_HEIGHT).with_align(align).strokes()
}

/// Returns a group that contains only strokes.
fn stroke_group(strokes: Vec<Polyline>) -> Group {
    Group { strokes, ..Group::default() }
}

/// Returns a layer of strokes with the pen of the boards.
fn stroke_layer(id: &str, title: &str, ink: Ink, strokes: Vec<Polyline>) -> Layer {
    let mut layer = Layer::new(id, title, Pen::solid(STROKE_WIDTH, ink));
    layer.groups.push(stroke_group(strokes));
    layer
}

/// Returns a layer with the pen width for text.
fn with_thin_pen(mut layer: Layer) -> Layer {
    layer.pen.width = LETTER_HEIGHT * 0.1;
    layer
}

#[cfg(test)]
mod tests {
    use super::*;
    use page::to_millimeters;

    fn stroke_heights(panel: &Panel, layer: &str) -> Vec<f64> {
        let found = panel.page.layers.iter().filter(|found| found.id == layer);
        let lines = found.flat_map(|layer| &layer.groups).flat_map(|group| &group.strokes);
        lines.flat_map(|line| &line.points).map(|position| to_millimeters(*position).y).collect()
    }

    /// The floor is below the horizon, which is in the middle of the picture, so no part of it may
    /// appear above the horizon.
    #[test]
    fn only_boards_clipped_first_stay_below_the_horizon() {
        let panels = wraparound_panels().expect("the panels").panels;
        let [_, divided, clipped] = &panels[..] else { unreachable!("three panels") };
        let horizon = PICTURE_SIZE.y * 0.5;
        for layer in ["ahead", "crossing"] {
            let heights = stroke_heights(clipped, layer);
            assert!(!heights.is_empty() && heights.iter().all(|y| *y > horizon), "{layer}");
        }
        assert!(stroke_heights(clipped, "behind").is_empty());
        // The crossing boards are torn: they have ends above and below the horizon.
        let torn = stroke_heights(divided, "crossing");
        assert!(torn.iter().any(|y| *y > horizon) && torn.iter().any(|y| *y < horizon));
        let behind = stroke_heights(divided, "behind");
        assert!(!behind.is_empty() && behind.iter().all(|y| *y < horizon));
        // The boards in front are below the horizon in both pictures.
        assert!(stroke_heights(divided, "ahead").iter().all(|y| *y > horizon));
    }

    /// Near z = 0, x/w and y/w are large, because w = −z; x and y contain the cotangent of 30°.
    #[test]
    fn notes_match_the_formula() {
        let panels = wraparound_panels().expect("the panels").panels;
        let cot = libm::sqrt(3.0);
        let (x, y) = (cot / (PICTURE_SIZE.x / PICTURE_SIZE.y), -EYE_HEIGHT * cot);
        for (z, note) in [(3.0, 0), (0.01, 1)] {
            let [ahead, behind] = [z, -z].map(|w: f64| {
                format!(
                    "w = {} and maps to ({}, {})",
                    format_short(w, 3),
                    format_short(x / w, 3),
                    format_short(y / w, 3)
                )
            });
            let actual = &panels[1].notes[note];
            assert!(
                actual.contains(&ahead) && actual.contains(&behind),
                "{actual}: {ahead}, {behind}"
            );
        }
        // The lower border of the picture clips the boards at y = −w.
        let least = format!("the smallest divisor w is {}", format_short(-y, 4));
        assert_eq!(panels[2].notes[1], least);
    }
}
