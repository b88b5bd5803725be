//! View marks, which show where the other views on a sheet are taken from (ISO 128-3).
//!
//! ```text
//!     B                      ┌───┐                   A              A
//!    ╱                       │   │  ◄── B            ▼━─·─┐         ▼
//!   (   )   a detail         └───┘  a viewing             ┃ · ─ · ━━   a stepped section:
//!    ╲_╱                             direction            ┗━─·─┘      wide ends and corners
//! ```
//!
//! Letters are placed in free space beside the object. A leader line connects a letter to a circle
//! inside the object.

use super::annotation::{
    AnnotationLayer, AnnotationShape, AnnotationText, Extent, ViewAnnotations,
};
use super::section_line::{ARROW_LENGTH, OVERHANG, add_section_arrow};
use drawing::circle_points;
use glam::DVec2;

/// The number of corners of the circle around a detail.
const CIRCLE_POINTS: u32 = 120;

/// The number of directions to try for the letter of a detail.
const LETTER_DIRECTIONS: u32 = 16;

/// The number of positions to try for a mark, each farther out than the one before.
const STEPS: u32 = 40;

/// The minimum width of an object across its center line, in millimeters on paper. Narrower objects
/// get no line.
const LEAST_WIDTH: f64 = 2.0;

/// The overhang of a center line beyond the view, in millimeters.
const CENTER_LINE_OVERHANG: f64 = 3.0;

/// A mark in a view. Positions are in object millimeters from the center of the view, to the right
/// and down.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum ViewMark {
    /// The circle around a detail. In the detail itself it has no letter.
    Circle { center: DVec2, radius: f64, letter: Option<char> },
    /// The viewing direction of another view, as a unit vector.
    Direction { gaze: DVec2, letter: char },
    /// The line of a stepped section, and the unit vector toward the retained side.
    SteppedLine { corners: Vec<DVec2>, retained: DVec2, letter: char },
    /// The center line of a half section, or a line of symmetry, through a point.
    CenterLine { through: DVec2, axis: usize },
}

/// The scale of a view, the extent of its object on paper, and the character height.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct MarkSettings {
    pub(super) ratio: f64,
    pub(super) object: Extent,
    pub(super) letters: f64,
}

impl ViewMark {
    /// Returns a point on a center line and the index of its paper axis, or `None` for other marks.
    pub(super) const fn as_center_line(&self) -> Option<(DVec2, usize)> {
        match self {
            Self::CenterLine { through, axis } => Some((*through, *axis)),
            _ => None,
        }
    }

    /// Returns the space that the mark takes up beside the object, in millimeters on paper.
    pub(super) fn reserve(&self, settings: &MarkSettings) -> f64 {
        let MarkSettings { ratio, object, letters } = *settings;
        match self {
            Self::Circle { center, radius, .. } => {
                let (low, high) = ((*center - *radius) * ratio, (*center + *radius) * ratio);
                (object[0] - low).max(high - object[1]).max_element().max(0.0)
            }
            Self::SteppedLine { .. } => OVERHANG + 1.8 * letters,
            Self::CenterLine { .. } => CENTER_LINE_OVERHANG,
            Self::Direction { .. } => 0.0,
        }
    }

    /// Adds the lines of the mark, which have fixed positions.
    pub(super) fn annotate(&self, annotations: &mut ViewAnnotations, settings: &MarkSettings) {
        let MarkSettings { ratio, object, .. } = *settings;
        match self {
            Self::Circle { center, radius, .. } => {
                let points = circle_points(*center * ratio, radius * ratio, CIRCLE_POINTS);
                let circle = AnnotationShape::Loop(points);
                annotations.push(AnnotationLayer::ViewMarks, circle);
            }
            Self::SteppedLine { corners, retained, .. } => {
                let corners = stepped_line(corners, ratio);
                annotate_stepped_line(annotations, &corners, *retained);
            }
            // An object seen as a line gets no line of symmetry, because ISO 128 gives outlines
            // priority.
            Self::CenterLine { axis, .. }
                if object[1][1 - *axis] - object[0][1 - *axis] < LEAST_WIDTH => {}
            Self::CenterLine { through, axis } => {
                let end = |side: usize, sign: f64| {
                    let mut end = *through * ratio;
                    end[*axis] = object[side][*axis] + sign * CENTER_LINE_OVERHANG;
                    end
                };
                let ends = [end(0, -1.0), end(1, 1.0)];
                annotations.push_line(AnnotationLayer::SymmetryLines, ends);
            }
            Self::Direction { .. } => {}
        }
    }

    /// Adds the letters and arrows of the mark, each at the first free position.
    pub(super) fn add_letters(&self, annotations: &mut ViewAnnotations, settings: &MarkSettings) {
        match self {
            Self::Circle { letter: None, .. } | Self::CenterLine { .. } => {}
            Self::Circle { center, radius, letter: Some(letter) } => {
                let ratio = settings.ratio;
                let (center, radius) = (*center * ratio, radius * ratio);
                add_circle_letter(annotations, center, radius, *letter, settings);
            }
            Self::Direction { gaze, letter } => {
                add_direction(annotations, *gaze, *letter, settings);
            }
            Self::SteppedLine { corners, retained, letter } => {
                let corners = stepped_line(corners, settings.ratio);
                let [first, .., last] = corners.as_slice() else { return };
                for (end, other) in [(*first, *last), (*last, *first)] {
                    let away = (end - other).normalize_or_zero();
                    let along = away - *retained * away.dot(*retained);
                    let away = along.normalize_or(away);
                    add_end_letter(annotations, end, away, -*retained, *letter, settings);
                }
            }
        }
    }
}

/// Returns the corners of the line on paper, with both ends extended.
fn stepped_line(corners: &[DVec2], ratio: f64) -> Vec<DVec2> {
    let mut corners: Vec<DVec2> = corners.iter().map(|corner| *corner * ratio).collect();
    let count = corners.len();
    if count >= 2 {
        let start = (corners[0] - corners[1]).normalize_or_zero() * OVERHANG;
        let end = (corners[count - 1] - corners[count - 2]).normalize_or_zero() * OVERHANG;
        corners[0] += start;
        corners[count - 1] += end;
    }
    corners
}

/// Adds the narrow line, its wide ends and corners, and an arrow at each end.
fn annotate_stepped_line(annotations: &mut ViewAnnotations, corners: &[DVec2], retained: DVec2) {
    annotations.push(AnnotationLayer::CutLines, AnnotationShape::Path(corners.to_vec()));
    for pair in corners.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let along = (to - from).normalize_or_zero() * OVERHANG.min(0.5 * from.distance(to));
        annotations.push_line(AnnotationLayer::CutEnds, [from, from + along]);
        annotations.push_line(AnnotationLayer::CutEnds, [to - along, to]);
    }
    for tip in [corners.first(), corners.last()].into_iter().flatten() {
        add_section_arrow(annotations, *tip, retained);
    }
}

/// Adds a letter at the end of a section line, beyond the arrow or beyond the line.
pub(super) fn add_end_letter(
    annotations: &mut ViewAnnotations,
    end: DVec2,
    away: DVec2,
    tail: DVec2,
    letter: char,
    settings: &MarkSettings,
) {
    let letters = settings.letters;
    let near = [
        end + tail * (ARROW_LENGTH + letters),
        end + away * letters,
        end + (away - tail) * letters,
        end + tail * (ARROW_LENGTH + 0.5 * letters) + away * letters,
    ];
    let farther = (1..=STEPS).flat_map(|step| {
        let step = f64::from(step) * 0.5 * letters;
        [near[0] + tail * step, near[1] + away * step, near[0] + (tail + away) * step]
    });
    let text = |middle| AnnotationText::centered(letter.to_string(), middle, letters);
    let places = near.into_iter().chain(farther).map(text);
    annotations.push_first_free_text(AnnotationLayer::CutNames, places, settings.object);
}

/// Adds the letter of a circle, as close to the circle as possible, with a leader line unless it is
/// right beside the circle.
fn add_circle_letter(
    annotations: &mut ViewAnnotations,
    center: DVec2,
    radius: f64,
    letter: char,
    settings: &MarkSettings,
) {
    let MarkSettings { object, letters, .. } = *settings;
    let mut places: Vec<(f64, DVec2)> = Vec::new();
    // The upper right is tried first.
    let directions = circle_points(DVec2::ZERO, 1.0, LETTER_DIRECTIONS);
    let start = directions.len() - directions.len() / 8;
    for direction in directions.iter().cycle().skip(start).take(directions.len()) {
        let beside = radius + 1.1 * letters;
        let outside = exit_distance(center, *direction, object) + 1.1 * letters;
        let nearest = if is_beside(center + *direction * beside, object, letters) {
            beside
        } else {
            beside.max(outside)
        };
        places.extend((0..STEPS).map(|step| {
            let distance = nearest + f64::from(step) * 0.5 * letters;
            (distance, center + *direction * distance)
        }));
    }
    places.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let free = places.iter().find_map(|(distance, middle)| {
        let direction = (*middle - center) / *distance;
        let text = AnnotationText::centered(letter.to_string(), *middle, letters);
        let leader = [center + direction * radius, *middle - direction * (0.9 * letters)];
        let has_leader = distance - radius > 1.6 * letters;
        let is_free =
            annotations.is_free(&text, object) && (!has_leader || annotations.is_clear(leader));
        is_free.then_some((text, has_leader.then_some(leader)))
    });
    let Some((text, leader)) = free else { return };
    leader.into_iter().for_each(|line| annotations.push_line(AnnotationLayer::ViewMarks, line));
    annotations.push(AnnotationLayer::ViewNames, AnnotationShape::Text(text));
}

/// Whether a letter at a point is clear of the object.
fn is_beside(point: DVec2, object: Extent, letters: f64) -> bool {
    (point + letters).cmplt(object[0]).any() || (point - letters).cmpgt(object[1]).any()
}

/// Returns the distance from a point to where a ray leaves a rectangle, or 0 if the point is
/// outside.
fn exit_distance(from: DVec2, direction: DVec2, [low, high]: Extent) -> f64 {
    let mut exit = f64::INFINITY;
    for axis in 0..2 {
        let side = if direction[axis] > 0.0 { high[axis] } else { low[axis] };
        if direction[axis].abs() > 1e-9 {
            exit = exit.min((side - from[axis]) / direction[axis]);
        }
    }
    exit.max(0.0)
}

/// Adds an arrow that points toward the object, with a letter behind it, in free space beside the
/// object.
fn add_direction(
    annotations: &mut ViewAnnotations,
    gaze: DVec2,
    letter: char,
    settings: &MarkSettings,
) {
    let MarkSettings { object, letters, .. } = *settings;
    let edge = exit_distance(DVec2::ZERO, -gaze, object) + 2.0;
    let place = |step: u32, aside: f64| {
        let tip =
            -gaze * (edge + f64::from(step) * 0.5 * letters) + gaze.perp() * (aside * letters);
        let tail = tip - gaze * (1.5 * ARROW_LENGTH);
        let text = AnnotationText::centered(letter.to_string(), tail - gaze * letters, letters);
        (tip, tail, text)
    };
    let asides = [0.0, 2.0, -2.0, 4.0, -4.0];
    let mut places = (0..=STEPS).flat_map(|step| asides.map(|aside| place(step, aside)));
    let free = places.find(|(tip, tail, text)| {
        let area = [tip.min(*tail) - 1.0, tip.max(*tail) + 1.0];
        annotations.is_free(text, object) && annotations.is_empty_area(area, object)
    });
    // A mark that overlaps something is better than a view without its mark.
    let (tip, tail, text) = free.unwrap_or_else(|| place(STEPS, 0.0));
    annotations.push_line(AnnotationLayer::CutArrows, [tail, tip - gaze]);
    let (back, side) = (tip - gaze * 3.0, gaze.perp() * 0.5);
    let head = AnnotationShape::Head([tip, back + side, back - side]);
    annotations.push(AnnotationLayer::CutArrows, head);
    annotations.push(AnnotationLayer::ViewNames, AnnotationShape::Text(text));
}

#[cfg(test)]
mod tests {
    use super::*;

    const SETTINGS: MarkSettings = MarkSettings {
        ratio: 2.0,
        object: [DVec2::splat(-30.0), DVec2::splat(30.0)],
        letters: 3.5,
    };

    #[test]
    fn exit_distances_are_measured_to_the_border() {
        let object = SETTINGS.object;
        assert_eq!(exit_distance(DVec2::new(10.0, 0.0), DVec2::X, object), 20.0);
        assert_eq!(exit_distance(DVec2::new(10.0, 0.0), -DVec2::Y, object), 30.0);
        assert_eq!(exit_distance(DVec2::new(40.0, 0.0), DVec2::X, object), 0.0);
    }

    #[test]
    fn circles_are_to_scale_with_letters_beside_the_object() {
        let circle =
            ViewMark::Circle { center: DVec2::new(14.0, 0.0), radius: 4.0, letter: Some('B') };
        // At 2:1 the circle extends to 2 · (14 + 4) = 36, and the object to 30.
        assert_eq!(circle.reserve(&SETTINGS), 6.0);
        let mut annotations = ViewAnnotations::default();
        circle.annotate(&mut annotations, &SETTINGS);
        let [low, high] = annotations.extent_with([DVec2::new(28.0, 0.0); 2]);
        assert!((low - DVec2::new(20.0, -8.0)).length() < 1e-9, "{low}");
        assert!((high - DVec2::new(36.0, 8.0)).length() < 1e-9, "{high}");
        circle.add_letters(&mut annotations, &SETTINGS);
        let with_letter = annotations.extent_with(SETTINGS.object);
        assert!(with_letter[1].x > 36.0 || with_letter[0].y < -30.0, "{with_letter:?}");
    }

    #[test]
    fn stepped_lines_extend_only_at_their_ends() {
        let corners = [[-15.0, 0.0], [0.0, 0.0], [0.0, 5.0], [15.0, 5.0]].map(DVec2::from);
        let line = stepped_line(&corners, 2.0);
        assert_eq!(line[0], DVec2::new(-30.0 - OVERHANG, 0.0));
        assert_eq!(line[1..3], [DVec2::ZERO, DVec2::new(0.0, 10.0)]);
        assert_eq!(line[3], DVec2::new(30.0 + OVERHANG, 10.0));
    }
}
