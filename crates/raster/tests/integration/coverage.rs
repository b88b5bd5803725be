//! Compares coverage and visibility with their definitions by brute force.

use homog::Point;
use proptest::prelude::*;
use raster::{Frame, Opacity, Samples, ScreenVertex};

const SIDE: u32 = 24;

/// Returns a vertex on the grid of 1/256 pixel.
fn vertex(x: i32, y: i32) -> ScreenVertex {
    ScreenVertex::new(x, y, 0.5, 1.0).expect("on the grid")
}

/// Returns whether the triangle covers a sample, computed directly from RA-1. Samples inside are
/// covered. A sample on the border is covered if a step to the right and an infinitely smaller step
/// down (y down) take it inside.
fn covers(triangle: [ScreenVertex; 3], x: i64, y: i64) -> bool {
    let side = |a: ScreenVertex, b: ScreenVertex| {
        let (dx, dy) = (i64::from(b.x()) - i64::from(a.x()), i64::from(b.y()) - i64::from(a.y()));
        let here = dx * (y - i64::from(a.y())) - dy * (x - i64::from(a.x()));
        // On the edge, the sign after the step to the right decides; on a horizontal edge, the sign
        // after the step down.
        here.signum() * 4 + (-dy).signum() * 2 + dx.signum()
    };
    let [p, q, r] = triangle;
    let sides = [side(p, q), side(q, r), side(r, p)].map(i64::signum);
    sides == [1; 3] || sides == [-1; 3]
}

fn covered(triangle: [ScreenVertex; 3]) -> Vec<bool> {
    let mut frame = Frame::new(SIDE, SIDE, Samples::One).expect("a small frame");
    frame.add_triangle(triangle, 0, Opacity::Opaque);
    frame.visibility_buffer().ids.iter().map(Option::is_some).collect()
}

/// Generates coordinates at pixel centers, half pixels and arbitrary grid steps, inside and outside
/// the picture.
fn coordinate() -> impl Strategy<Value = i32> {
    let far = SIDE as i32 * 256;
    prop_oneof![
        (-4..28_i32).prop_map(|n| n * 256 + 128),
        (-8..56_i32).prop_map(|n| n * 128),
        -far..2 * far,
        -2_097_152..=6_291_456_i32,
    ]
}

fn corner() -> impl Strategy<Value = ScreenVertex> {
    (coordinate(), coordinate()).prop_map(|(x, y)| vertex(x, y))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn coverage_matches_the_definition(p in corner(), q in corner(), r in corner()) {
        for (at, covered) in covered([p, q, r]).into_iter().enumerate() {
            let (x, y) = (at as i64 % i64::from(SIDE), at as i64 / i64::from(SIDE));
            prop_assert_eq!(covered, covers([p, q, r], x * 256 + 128, y * 256 + 128), "pixel ({}, {})", x, y);
        }
    }

    #[test]
    fn triangles_around_a_point_cover_each_sample_once(
        center in corner(),
        rim in prop::collection::vec((-6000_i32..6000, 1_i32..6000), 3..9),
    ) {
        // Sort the rim by angle around the center, with at most one corner in each direction, to
        // make a fan without overlaps.
        let mut rim: Vec<(i32, i32)> = rim.into_iter().flat_map(|(x, y)| [(x, y), (-x, -y)]).collect();
        let upper = |&(x, y): &(i32, i32)| y < 0 || (y == 0 && x < 0);
        let cross = |a: &(i32, i32), b: &(i32, i32)| i64::from(a.0) * i64::from(b.1) - i64::from(a.1) * i64::from(b.0);
        let is_there = |x: i32, y: i32| ScreenVertex::new(x, y, 0.5, 1.0).is_some();
        rim.retain(|&(x, y)| is_there(center.x() + x, center.y() + y));
        rim.sort_by(|a, b| upper(a).cmp(&upper(b)).then(0.cmp(&cross(a, b))));
        rim.dedup_by(|a, b| upper(a) == upper(b) && cross(a, b) == 0);
        let at = |(x, y): (i32, i32)| vertex(center.x() + x, center.y() + y);
        let mut hits = vec![0; (SIDE * SIDE) as usize];
        for k in 0..rim.len() {
            let triangle = [center, at(rim[k]), at(rim[(k + 1) % rim.len()])];
            for (hits, covered) in hits.iter_mut().zip(covered(triangle)) {
                *hits += u32::from(covered);
            }
        }
        prop_assert!(hits.iter().all(|&hits| hits <= 1), "{:?}", hits);
        // Samples closer to the center than every rim edge are inside the fan.
        let reach = (0..rim.len()).map(|k| {
            let (a, b) = (rim[k], rim[(k + 1) % rim.len()]);
            let length = f64::from(b.0 - a.0).hypot_exact(f64::from(b.1 - a.1));
            if length == 0.0 { 0.0 } else { (cross(&a, &b) as f64 / length).abs() }
        }).fold(f64::INFINITY, f64::min);
        for (n, hits) in hits.iter().enumerate() {
            let (x, y) = ((n as i32 % SIDE as i32) * 256 + 128, (n as i32 / SIDE as i32) * 256 + 128);
            let distance = f64::from(x - center.x()).hypot_exact(f64::from(y - center.y()));
            prop_assert!(*hits == 1 || distance >= reach, "sample ({}, {}) in a gap", x, y);
        }
    }
}

/// The hypotenuse √(x² + y²) of numbers whose squares neither overflow nor underflow.
trait Hypot {
    fn hypot_exact(self, other: f64) -> f64;
}

impl Hypot for f64 {
    fn hypot_exact(self, other: f64) -> f64 {
        (self * self + other * other).sqrt()
    }
}

#[test]
fn slivers_across_a_16384_pixel_picture_have_no_gaps_or_overlaps() {
    // Slivers that extend across the largest picture, of which one row is checked.
    let width = raster::MAX_SIDE;
    let mut frame = Frame::new(width, 1, Samples::One).expect("one row");
    let (left, right) = (0, width as i32 * 256);
    let heights: Vec<i32> = (-200..200).map(|k| k * 3 - 1).collect();
    for (id, pair) in heights.windows(2).enumerate() {
        let (y0, y1) = (pair[0], pair[1]);
        let corners =
            [vertex(left, y0 * 40), vertex(right, y0), vertex(right, y1), vertex(left, y1 * 40)];
        let [a, b, c, d] = corners;
        frame.add_triangle([a, b, c], id as u32 * 2, Opacity::Opaque);
        frame.add_triangle([a, c, d], id as u32 * 2 + 1, Opacity::Opaque);
    }
    let first = frame.visibility_buffer();
    assert!(first.ids.iter().all(Option::is_some), "a gap");
}

#[test]
fn nearer_triangles_win_and_the_first_wins_at_equal_depth() {
    let square = |depth: f32| {
        let corner = |(x, y)| ScreenVertex::new(x * 256, y * 256, depth, 1.0);
        [(0, 0), (8, 0), (0, 8)].map(corner).map(|corner| corner.expect("on the grid"))
    };
    let seen = |depths: &[f32]| {
        let mut frame = Frame::new(8, 8, Samples::One).expect("a small frame");
        for (id, &depth) in depths.iter().enumerate() {
            frame.add_triangle(square(depth), id as u32, Opacity::Opaque);
        }
        frame.visibility_buffer().ids[0]
    };
    assert_eq!(seen(&[0.25, 0.75, 0.5]), Some(1));
    assert_eq!(seen(&[0.5, 0.5]), Some(0));
    assert_eq!(seen(&[0.0]), Some(0), "a triangle on the far plane is visible");
}

#[test]
fn c31_depth_follows_the_plane_and_weights_follow_the_projection() {
    // The corners are at different distances, so halfway along an edge on the screen, the weights
    // are not equal.
    let corner = |x: f64, y: f64, w: f64| {
        ScreenVertex::snap(Point::new(x, y, 1.0 / w), w).expect("within the grid")
    };
    let mut frame = Frame::new(64, 64, Samples::One).expect("a small frame");
    let (p, q, r) = ([0.0, 0.0], [64.0, 0.0], [0.0, 64.0]);
    frame.add_triangle(
        [corner(p[0], p[1], 1.0), corner(q[0], q[1], 3.0), corner(r[0], r[1], 2.0)],
        0,
        Opacity::Opaque,
    );
    let depth = frame.visibility_buffer().depth;
    let mut checked = 0;
    frame.for_each_fragment(|fragment| {
        let (x, y) = (f64::from(fragment.x) + 0.5, f64::from(fragment.y) + 0.5);
        let screen = [1.0 - x / 64.0 - y / 64.0, x / 64.0, y / 64.0];
        let over_w = [screen[0], screen[1] / 3.0, screen[2] / 2.0];
        let inv_w: f64 = over_w.iter().sum();
        for (k, share) in over_w.iter().enumerate() {
            assert!((f64::from(fragment.weights[k]) - share / inv_w).abs() < 1e-6, "({x}, {y})");
        }
        let at = (fragment.y * 64 + fragment.x) as usize;
        assert!((f64::from(depth[at]) - inv_w).abs() < 1e-7, "({x}, {y})");
        checked += 1;
    });
    assert_eq!(
        checked,
        64 * 63 / 2,
        "pixel centers on the long side belong to the other half of the square"
    );
}

#[test]
fn lines_and_points_cover_rectangles_of_their_width() {
    let mut frame = Frame::new(16, 8, Samples::One).expect("a small frame");
    frame.add_line([vertex(2 * 256, 4 * 256), vertex(14 * 256, 4 * 256)], 2.0, 1, Opacity::Opaque);
    assert_eq!(frame.visibility_buffer().ids.iter().flatten().count(), 12 * 2);
    frame.for_each_fragment(|fragment| {
        let along = (f64::from(fragment.x) + 0.5 - 2.0) / 12.0;
        assert!(
            (f64::from(fragment.weights[1]) - along).abs() < 1e-6 && fragment.weights[2] == 0.0
        );
    });
    let mut frame = Frame::new(8, 8, Samples::One).expect("a small frame");
    frame.add_point(vertex(4 * 256, 4 * 256), 4.0, 1, Opacity::Opaque);
    assert_eq!(frame.visibility_buffer().ids.iter().flatten().count(), 16);
    frame.for_each_fragment(|fragment| assert_eq!(fragment.weights, [1.0, 0.0, 0.0]));
}
