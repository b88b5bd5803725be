//! Collision tests between annotations, by separating axes of convex outlines.
//!
//! Text outlines, arrowheads and lines are convex, so the separating axis theorem applies: two
//! shapes are disjoint if they are separated along the normal of one of their sides (Gottschalk
//! 1996).

use super::annotation::{AnnotationShape, AnnotationText};
use glam::DVec2;
use page::Label;

/// The largest overlap, in millimeters, that counts as mere contact.
const CONTACT: f64 = 1e-6;

/// Returns the corners of the rectangle around text, with a margin.
pub(super) fn text_outline(text: &AnnotationText, margin: f64) -> [DVec2; 4] {
    let width = Label::new(&text.text, DVec2::ZERO, text.height).width();
    let part = match text.align {
        page::TextAlign::Start => 0.0,
        page::TextAlign::Middle => 0.5,
        page::TextAlign::End => 1.0,
    };
    let (along, up) = (text.direction, DVec2::new(text.direction.y, -text.direction.x));
    let start = text.anchor - along * (width * part + margin) - up * margin;
    let (across, height) = (along * (width + 2.0 * margin), up * (text.height + 2.0 * margin));
    [start, start + across, start + across + height, start + height]
}

/// Returns the convex parts of a shape, with a margin around text.
pub(super) fn convex_parts(shape: &AnnotationShape, margin: f64) -> Vec<Vec<DVec2>> {
    match shape {
        AnnotationShape::Line(ends) => vec![ends.to_vec()],
        AnnotationShape::Path(points) => points.windows(2).map(<[DVec2]>::to_vec).collect(),
        AnnotationShape::Loop(points) => {
            let next = points.iter().cycle().skip(1);
            points.iter().zip(next).map(|(a, b)| vec![*a, *b]).collect()
        }
        AnnotationShape::Head(corners) => vec![corners.to_vec()],
        AnnotationShape::Text(text) => vec![text_outline(text, margin).to_vec()],
    }
}

/// Whether two convex outlines overlap by more than mere contact. Two points are a line.
pub(super) fn convex_overlap(a: &[DVec2], b: &[DVec2]) -> bool {
    let axes = sides(a).chain(sides(b)).chain([DVec2::X, DVec2::Y]);
    let along = |points: &[DVec2], axis: DVec2| {
        points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], point| {
            let at = point.dot(axis);
            [low.min(at), high.max(at)]
        })
    };
    !axes.into_iter().any(|axis| {
        let ([low, high], [other_low, other_high]) = (along(a, axis), along(b, axis));
        high <= other_low + CONTACT || other_high <= low + CONTACT
    })
}

/// Returns the unit normals of the sides of an outline.
fn sides(points: &[DVec2]) -> impl Iterator<Item = DVec2> {
    let next = (0..points.len()).map(|k| points[(k + 1) % points.len()] - points[k]);
    next.filter_map(|side| side.perp().try_normalize())
}

/// Returns the convex hull of points, counterclockwise with y up (Andrew's monotone chain).
pub(super) fn convex_hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.retain(|point| point.is_finite());
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let half = |points: &mut dyn Iterator<Item = &DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for &point in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(point - b) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter());
    hull.extend(half(&mut points.iter().rev()));
    hull
}

/// Clips a convex outline to an interval along an axis, and returns how far the result extends in
/// the `outward` direction. Returns `None` if nothing is left.
pub(super) fn reach_between(
    hull: &[DVec2],
    along: DVec2,
    range: [f64; 2],
    outward: DVec2,
) -> Option<f64> {
    let [low, high] = range;
    let count = hull.len();
    let mut most: Option<f64> = None;
    let mut add = |point: DVec2| {
        let reach = point.dot(outward);
        most = Some(most.map_or(reach, |most| most.max(reach)));
    };
    for (at, &from) in hull.iter().enumerate() {
        let to = hull[(at + 1) % count];
        let (s, t) = (from.dot(along), to.dot(along));
        if (low..=high).contains(&s) {
            add(from);
        }
        for border in [low, high] {
            // Only sides that cross the border count; corners on the border have been added above.
            if (s - border) * (t - border) < 0.0 {
                add(from + (to - from) * ((border - s) / (t - s)));
            }
        }
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[[f64; 2]]) -> Vec<DVec2> {
        list.iter().copied().map(DVec2::from).collect()
    }

    #[test]
    fn lines_beside_slanted_text_do_not_overlap_it() {
        let slanted = points(&[[0.0, 0.0], [10.0, 10.0], [9.0, 11.0], [-1.0, 1.0]]);
        assert!(!convex_overlap(&slanted, &points(&[[0.5, 0.0], [10.5, 10.0]])));
        assert!(convex_overlap(&slanted, &points(&[[0.0, 0.5], [10.0, 10.5]])));
        assert!(!convex_overlap(&slanted, &points(&[[9.0, 0.0], [9.0, 8.9]])));
        assert!(convex_overlap(&slanted, &points(&[[5.0, 0.0], [5.0, 20.0]])));
    }

    #[test]
    fn hulls_have_only_corners_and_reach_is_limited_to_a_range() {
        let square =
            points(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [2.0, 2.0], [2.0, 0.0]]);
        let hull = convex_hull(square);
        assert_eq!(hull.len(), 4);
        let triangle = convex_hull(points(&[[0.0, 0.0], [8.0, 0.0], [0.0, 8.0]]));
        let reach = |low, high| reach_between(&triangle, DVec2::X, [low, high], DVec2::Y);
        assert_eq!(
            [reach(0.0, 1.0), reach(2.0, 3.0), reach(9.0, 10.0)],
            [Some(8.0), Some(6.0), None]
        );
    }
}
