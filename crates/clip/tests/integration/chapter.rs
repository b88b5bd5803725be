//! Clipping as described in the sources, including their misprints and pitfalls.
//!
//! The projection is the chapter's, in its form with w > 0 (PE-3), for n = −1, f = −9 and the
//! window [−1, 1]². Then w = −z, near maps to depth 1, and far maps to depth −1.

use clip::{PlaneIndex, Volume, clip_point, clip_segment, clip_triangle};
use glam::{DMat4, DVec4};
use homog::{Clip, HPoint, Normal, Plane, Point, Projective, View};

const NEAR: f64 = 1.0;
const FAR: f64 = 9.0;

fn view_to_clip() -> Projective<View, Clip> {
    let depth = DVec4::new(0.0, 0.0, (FAR + NEAR) / (FAR - NEAR), -1.0);
    let offset = DVec4::new(0.0, 0.0, 2.0 * FAR * NEAR / (FAR - NEAR), 0.0);
    Projective::from_raw(DMat4::from_cols(DVec4::X, DVec4::Y, depth, offset))
}

fn seen(x: f64, y: f64, z: f64) -> HPoint<Clip> {
    view_to_clip().transform_point(Point::new(x, y, z))
}

/// M28, C54: points are clipped to −w ≤ x, y, z ≤ w before the division. After it, a point behind
/// the eye can be in the cube and look visible.
#[test]
fn misprint_m28_the_cube_exists_only_after_the_division() {
    let behind = seen(0.1, 0.1, 5.0);
    let divided = behind.divide().expect("w is not 0");
    assert!(divided.x().abs() <= 1.0 && divided.y().abs() <= 1.0);
    assert!(behind.w() < 0.0 && clip_point(behind, &Volume::CHAPTER).is_none());
    // Conversely, a visible point need not be in the cube before the division.
    let ahead = seen(4.0, 0.0, -8.0);
    assert!(ahead.x() > 1.0 && clip_point(ahead, &Volume::CHAPTER).is_some());
}

/// C36, PL-2: the division tears apart a segment through the eye plane. Drawn between its divided
/// endpoints, it covers exactly the part that is not visible. If it is clipped first, it ends where
/// it leaves the view.
#[test]
fn a_segment_that_passes_the_eye_ends_at_the_border_of_the_view() {
    // On the floor, from three meters ahead to three meters behind.
    let (ahead, behind) = (seen(0.5, -1.0, -3.0), seen(0.5, -1.0, 3.0));
    let [p, q] = [ahead, behind].map(|end| end.divide().expect("w is not 0"));
    assert!(
        p.y() < 0.0 && q.y() > 0.0,
        "expected one end below and one above the horizon: {p:?} {q:?}"
    );
    let visible = clip_segment(ahead, behind, &Volume::CHAPTER).expect("it starts in view");
    let end = visible.end.divide().expect("in view");
    assert_eq!((visible.start, visible.enter), (ahead, None));
    assert_eq!((end.y(), visible.exit), (-1.0, Some(PlaneIndex::BOTTOM)));
}

/// C36: z = ±ε. The images of points just in front of the eye and just behind it are at opposite
/// ends of the picture.
#[test]
fn points_on_both_sides_of_the_eye_are_far_apart_in_the_picture() {
    let [ahead, behind] =
        [-1e-9, 1e-9].map(|z| seen(0.5, 0.5, z).divide().expect("w is not 0").x());
    assert!(ahead > 1e8 && behind < -1e8);
    assert!(clip_segment(seen(0.5, 0.5, -1e-9), seen(0.5, 0.5, 1e-9), &Volume::CHAPTER).is_none());
}

/// C31, C47: clipping in four dimensions agrees with clipping in the picture. After the division,
/// the cut point is where the image leaves the square.
#[test]
fn cuts_before_and_after_the_division_agree() {
    let (p, q) = (seen(0.0, 0.0, -2.0), seen(6.0, 2.0, -4.0));
    let end = clip_segment(p, q, &Volume::CHAPTER).expect("it starts in view").end;
    let [a, b, end] = [p, q, end].map(|point| point.divide().expect("ahead"));
    let s = (1.0 - a.x()) / (b.x() - a.x());
    assert!((a.lerp(b, s) - end).length() < 1e-15, "{end:?}");
}

/// C89: one clipper serves both parallel and perspective projections.
#[test]
fn boxes_and_frusta_use_the_same_clipper() {
    let parallel = Projective::<View, Clip>::from_raw(DMat4::from_cols(
        DVec4::X,
        DVec4::Y,
        DVec4::Z * 0.25,
        DVec4::new(0.0, 0.0, 1.25, 1.0),
    ));
    let corners = [[-3.0, 0.0, -2.0], [3.0, 0.0, -2.0], [0.0, 0.5, -2.0]].map(Point::from);
    for (map, half_width) in [(parallel, 1.0), (view_to_clip(), 2.0)] {
        let left =
            clip_triangle(corners.map(|corner| map.transform_point(corner)), &Volume::CHAPTER);
        let back = map.inverse().expect("regular");
        let rightmost = left.vertices().iter().map(|vertex| back.transform_hpoint(vertex.point));
        let rightmost = rightmost.filter_map(HPoint::divide).map(Point::x);
        assert!((rightmost.fold(0.0, f64::max) - half_width).abs() < 1e-15);
        assert_eq!(left.outcomes.clipped.to_string(), "left+right");
    }
}

/// A plane in camera space becomes a plane in clip space and cuts at the same point there.
#[test]
fn planes_can_be_added_from_any_space() {
    let here = Plane::<View>::through(Point::new(0.25, 0.0, 0.0), Normal::new(-1.0, 0.0, 0.0));
    let there = view_to_clip().transform_plane(here).expect("regular");
    let volume = Volume::CHAPTER.with_plane(there).expect("a free slot");
    let left = clip_segment(seen(-0.5, 0.0, -2.0), seen(1.5, 0.0, -2.0), &volume).expect("in view");
    assert_eq!(left.exit, PlaneIndex::added(0));
    assert!((left.t1 - 0.375).abs() < 1e-15, "{}", left.t1);
}

/// CL-1: the signs of M_per make w negative for visible points. Without a sign change, everything
/// visible would be clipped away.
#[test]
fn the_sign_of_m_per_must_be_flipped_before_clipping() {
    let raw = HPoint::<Clip>::from_raw(-seen(0.5, 0.5, -2.0).raw());
    assert!(clip_point(raw, &Volume::CHAPTER).is_none());
    assert!(clip_point(HPoint::from_raw(-raw.raw()), &Volume::CHAPTER).is_some());
}

/// CL-1: points at infinity are directions. A line that extends to its vanishing point is visible
/// up to the far plane, or all the way if there is no far plane.
#[test]
fn lines_to_infinity_end_at_the_far_plane_or_their_vanishing_point() {
    let ahead = view_to_clip().transform_direction(-homog::Vector::Z);
    let start = seen(0.0, 0.0, -2.0);
    let far = clip_segment(start, ahead, &Volume::CHAPTER).expect("it starts in view");
    assert_eq!(far.end.divide().map(Point::z), Some(-1.0));
    let endless = clip_segment(start, ahead, &Volume::CHAPTER.without_far()).expect("in view");
    assert_eq!((endless.end, endless.exit), (ahead, None));
}

/// Rounding may push a crossing past the largest finite number if k w is close to that number.
#[test]
fn cuts_near_the_largest_numbers_are_finite() {
    let volume = Volume::CHAPTER.with_guard_band(9.167_783_980_303_91, 1.0).expect("allowed");
    let max = f64::MAX;
    let corners =
        [[0.7, -3e241, -5e-236, -5e-236], [max, 1e-116, -8.8, 1e-154], [max, 0.0, 0.0, max]];
    let left = clip_triangle(corners.map(HPoint::from), &volume);
    assert!(!left.is_empty() && left.vertices().iter().all(|vertex| vertex.point.is_finite()));
}
