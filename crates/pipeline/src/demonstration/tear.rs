//! The tear: what becomes of a floor that runs from ahead of the eye to behind it, divided at once and clipped first (C36).
//!
//! ```text
//!    from the side                  divided at once            clipped first
//!                  eye
//!    ═══════════════●═══════         ╲ ╱  what is behind          /   \
//!    ahead        w = 0  behind       ╳   comes out upside       /     \
//!                                    ╱ ╲  down, in the sky      /       \
//! ```
//! A point at z = −ε has its image far below, one at z = +ε far above: the segment between them goes through infinity, and what joins
//! the images of its ends is the part that does not belong to it. Clipping against the near plane before the divide leaves w > 0.

use super::DemonstrationError;
use super::number::short;
use camera::Camera;
use clip::{Volume, clip_convex, clip_segment};
use drawing::{Align, Group, Ink, Label, Layer, LineType, Page, Panel, Panels, Pen};
use drawing::{Cap, Join, Polyline};
use glam::DVec2;
use homog::{Clip, HPoint, Ndc, Point, Projective, Vector, World};
use projection::{Convention, Fov, Perspective};

const INK: Ink = [26, 31, 38];
const RED: Ink = [179, 38, 30];
const BLUE: Ink = [26, 86, 176];

/// Width and height of each picture in millimetres.
const SIZE: DVec2 = DVec2::new(88.0, 66.0);
const LETTERS: f64 = 2.2;
const WIDE: f64 = 0.35;

/// The eye's height above the floor, and the near plane's distance.
const EYE: f64 = 1.6;
const NEAR: f64 = 0.5;
const FAR: f64 = 40.0;

/// Where the boards of the floor begin and end, from the horizon towards the eye and beyond it; and their borders from left to
/// right. The third board crosses the plane of the eye, z = 0.
const ENDS: [f64; 5] = [-15.0, -9.0, -3.0, 3.0, 9.0];
const BORDERS: [f64; 5] = [-2.0, -1.0, 0.0, 1.0, 2.0];

/// The layers: what is ahead, what crosses the plane of the eye, what is behind it.
const KINDS: [(&str, &str, Ink); 3] = [
    ("ahead", "boards ahead of the eye", INK),
    ("crossing", "boards that cross the plane of the eye", RED),
    ("behind", "boards behind the eye", BLUE),
];

/// A board of the floor.
struct Board {
    kind: usize,
    corners: [Point<World>; 4],
}

/// The floor from the side, divided without clipping, and clipped first.
///
/// # Errors
/// If camera or projection cannot be had; theirs are fixed, so they can.
pub fn tear() -> Result<Panels, DemonstrationError> {
    let world_to_clip = world_to_clip()?;
    let boards = boards();
    let panels =
        vec![side(&boards), divided(&boards, world_to_clip), clipped(&boards, world_to_clip)];
    Ok(Panels::new("Clip before the divide: a floor that runs past the eye", panels))
}

/// From the world to the chapter's canonical volume (PE-3), looking along −z.
fn world_to_clip() -> Result<Projective<World, Clip>, DemonstrationError> {
    let eye = Point::new(0.0, EYE, 0.0);
    let camera = Camera::look_to(eye, -Vector::Z, Vector::Y)?;
    let lens = Perspective::new(Fov::Vertical(60_f64.to_radians()), SIZE.x / SIZE.y, NEAR, FAR)?;
    Ok(camera.world_to_view().then_project(lens.view_to_clip(Convention::CHAPTER)))
}

fn boards() -> Vec<Board> {
    let mut boards = Vec::new();
    for end in ENDS.windows(2) {
        let kind = if end[1] < 0.0 {
            0
        } else if end[0] < 0.0 {
            1
        } else {
            2
        };
        for border in BORDERS.windows(2) {
            let corner = |x: usize, z: usize| Point::new(border[x], 0.0, end[z]);
            boards.push(Board {
                kind,
                corners: [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)],
            });
        }
    }
    boards
}

/// The scene from the side: the gaze to the left, so that what is seen is left of the eye.
fn side(boards: &[Board]) -> Panel {
    let place = |z: f64, y: f64| DVec2::new(56.0 + z * 3.2, 40.0 - y * 3.2);
    let line = |a: [f64; 2], b: [f64; 2]| {
        Polyline::through(&[place(a[0], a[1]), place(b[0], b[1])], false)
    };
    let floor = |kind: usize| {
        let of_kind = boards.iter().filter(|board| board.kind == kind);
        let lines = of_kind.filter_map(|b| line([b.corners[0].z(), 0.0], [b.corners[2].z(), 0.0]));
        lines.collect()
    };
    let mut page = Page::new(SIZE, "from the side", None);
    page.layers.extend(KINDS.iter().enumerate().map(|(kind, of)| layer(*of, floor(kind))));
    let slope = libm::tan(30_f64.to_radians());
    let planes = [line([0.0, -3.0], [0.0, 7.0]), line([-NEAR, EYE - 1.2], [-NEAR, EYE + 1.2])];
    let mut dashed = LineType::Dashed.pen(0.18, INK, Cap::Butt, Join::Round);
    dashed.ink = [110, 116, 124];
    let mut plane = Layer::new("planes", "the plane of the eye and the near plane", dashed);
    plane.groups.push(group(planes.into_iter().flatten().collect()));
    let angle = [-1.0, 1.0].map(|side| line([0.0, EYE], [-10.0, EYE + side * 10.0 * slope]));
    let angle =
        layer(("angle", "what is seen", [110, 116, 124]), angle.into_iter().flatten().collect());
    let mut strokes = text("eye", place(0.6, EYE), Align::Start);
    strokes.extend(text("w = 0", place(0.0, 7.4), Align::Middle));
    strokes.extend(text("w > 0", place(-7.5, -1.3), Align::End));
    strokes.extend(text("w < 0", place(2.0, -1.3), Align::Start));
    let words = layer(("words", "names", INK), strokes);
    page.layers.extend([plane, thin(angle), thin(words)]);
    let notes = vec![
        format!("eye at height {EYE}, looking along -z; near plane at {NEAR}"),
        "black: ahead; red: through the plane of the eye; blue: behind it".to_owned(),
    ];
    let (id, title) = ("side".to_owned(), "from the side".to_owned());
    Panel { id, title, notes, page }
}

/// Each corner divided as it is, and the images joined.
fn divided(boards: &[Board], map: Projective<World, Clip>) -> Panel {
    let outline = |board: &Board| -> Vec<Polyline> {
        let images = board.corners.map(|corner| map.point(corner).divide());
        let sides = (0..4).filter_map(|n| Some([images[n]?, images[(n + 1) % 4]?]));
        sides.filter_map(within).collect()
    };
    let image = |x: f64, z: f64| told(map, Point::new(x, 0.0, z));
    let notes = vec![
        format!("(1, 0, -3) {}; (1, 0, 3) {}", image(1.0, -3.0), image(1.0, 3.0)),
        format!("(1, 0, -0.01) {}; (1, 0, 0.01) {}", image(1.0, -0.01), image(1.0, 0.01)),
    ];
    picture("divided", "divided at once", notes, boards, outline)
}

/// Clipped before the divide.
fn clipped(boards: &[Board], map: Projective<World, Clip>) -> Panel {
    let ring = |board: &Board| {
        clip_convex(&board.corners.map(|corner| map.point(corner)), &Volume::CHAPTER)
    };
    let outline = |board: &Board| -> Vec<Polyline> {
        let images: Vec<Point<Ndc>> =
            ring(board).points().iter().filter_map(|p| p.divide()).collect();
        let places: Vec<DVec2> = images.into_iter().map(place).collect();
        Polyline::through(&places, true).into_iter().collect()
    };
    let least = boards.iter().flat_map(|board| ring(board).points().to_vec()).map(HPoint::w);
    let least = least.fold(f64::INFINITY, f64::min);
    let count = |kind: usize| {
        let of_kind = boards.iter().filter(|board| board.kind == kind);
        let left = of_kind.clone().filter(|board| !ring(board).is_empty()).count();
        format!("{left} of {} {}", of_kind.count(), KINDS[kind].0)
    };
    let notes = vec![
        format!("left are {}, {}, {}", count(0), count(1), count(2)),
        format!("the least w that is divided by is {}", short(least, 4)),
    ];
    picture("clipped", "clipped first", notes, boards, outline)
}

/// A picture of the boards by their outlines.
fn picture(
    id: &str,
    title: &str,
    notes: Vec<String>,
    boards: &[Board],
    outline: impl Fn(&Board) -> Vec<Polyline>,
) -> Panel {
    let mut page = Page::new(SIZE, title, None);
    for (kind, of) in KINDS.iter().enumerate() {
        let of_kind = boards.iter().filter(|board| board.kind == kind);
        page.layers.push(layer(*of, of_kind.flat_map(&outline).collect()));
    }
    page.layers.retain(|layer| !layer.groups[0].strokes.is_empty());
    Panel { id: id.to_owned(), title: title.to_owned(), notes, page }
}

/// The part of a straight line between images that is in the picture.
fn within([a, b]: [Point<Ndc>; 2]) -> Option<Polyline> {
    // They are divided already: w is 1, and depth does not count.
    let flat = |p: Point<Ndc>| HPoint::<Clip>::new(p.x(), p.y(), 0.0, 1.0);
    let seen = clip_segment(flat(a), flat(b), &Volume::CHAPTER)?;
    Polyline::through(&[place(seen.start.divide()?), place(seen.end.divide()?)], false)
}

/// Where an image is on the page, y down.
fn place(image: Point<Ndc>) -> DVec2 {
    (DVec2::new(image.x(), -image.y()) + 1.0) * 0.5 * SIZE
}

/// w, and where the point goes.
fn told(map: Projective<World, Clip>, point: Point<World>) -> String {
    let clip = map.point(point);
    let Some(image) = clip.divide() else { return "has no image".to_owned() };
    let [w, x, y] = [clip.w(), image.x(), image.y()].map(|number| short(number, 3));
    format!("has w = {w}, goes to ({x}, {y})")
}

fn text(words: &str, at: DVec2, align: Align) -> Vec<Polyline> {
    Label::new(words, at, LETTERS).aligned(align).strokes()
}

fn group(strokes: Vec<Polyline>) -> Group {
    Group { strokes, ..Group::default() }
}

fn layer((id, title, ink): (&str, &str, Ink), strokes: Vec<Polyline>) -> Layer {
    let mut layer = Layer::new(id, title, Pen::of_width(WIDE, ink));
    layer.groups.push(group(strokes));
    layer
}

fn thin(mut layer: Layer) -> Layer {
    layer.pen.width = LETTERS * 0.1;
    layer
}

#[cfg(test)]
mod tests {
    use super::*;
    use drawing::millimetres;

    fn heights(panel: &Panel, layer: &str) -> Vec<f64> {
        let found = panel.page.layers.iter().filter(|found| found.id == layer);
        let lines = found.flat_map(|layer| &layer.groups).flat_map(|group| &group.strokes);
        lines.flat_map(|line| &line.points).map(|place| millimetres(*place).y).collect()
    }

    /// The floor is below the horizon, which is the middle of the picture: nothing of it may be drawn above.
    #[test]
    fn only_what_is_clipped_first_stays_below_the_horizon() {
        let panels = tear().expect("the panels").panels;
        let [_, divided, clipped] = &panels[..] else { unreachable!("three panels") };
        let horizon = SIZE.y * 0.5;
        for layer in ["ahead", "crossing"] {
            let heights = heights(clipped, layer);
            assert!(!heights.is_empty() && heights.iter().all(|y| *y > horizon), "{layer}");
        }
        assert!(heights(clipped, "behind").is_empty());
        // The boards that cross are torn: they have ends above and below.
        let torn = heights(divided, "crossing");
        assert!(torn.iter().any(|y| *y > horizon) && torn.iter().any(|y| *y < horizon));
        let behind = heights(divided, "behind");
        assert!(!behind.is_empty() && behind.iter().all(|y| *y < horizon));
        // What is ahead comes out alike.
        assert!(heights(divided, "ahead").iter().all(|y| *y > horizon));
    }

    /// z = ±ε goes to ∓∞: x/w and y/w for w = ∓z, with the cotangent of 30° across and upwards.
    #[test]
    fn the_numbers_are_those_of_the_formula() {
        let panels = tear().expect("the panels").panels;
        let cot = libm::sqrt(3.0);
        let (x, y) = (cot / (SIZE.x / SIZE.y), -EYE * cot);
        for (z, note) in [(3.0, 0), (0.01, 1)] {
            let [ahead, behind] = [z, -z].map(|w: f64| {
                format!("w = {}, goes to ({}, {})", short(w, 3), short(x / w, 3), short(y / w, 3))
            });
            let found = &panels[1].notes[note];
            assert!(
                found.contains(&ahead) && found.contains(&behind),
                "{found}: {ahead}, {behind}"
            );
        }
        // The lower border of the picture cuts them: at y = −w.
        let least = format!("the least w that is divided by is {}", short(-y, 4));
        assert_eq!(panels[2].notes[1], least);
    }
}
