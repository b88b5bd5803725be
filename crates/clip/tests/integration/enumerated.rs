//! Exhaustive tests of small cases: triangles and segments with coordinates from five values. Two
//! of the values are on the borders, two are outside and one is in the middle, so every way of
//! touching, crossing and missing the volume occurs.
//!
//! ```text
//!    −2  −1   0   1   2
//!     ·   ├───·───┤   ·
//! ```

use clip::{Volume, clip_segment, clip_triangle};
use homog::{Clip, HPoint};

const VALUES: [f64; 5] = [-2.0, -1.0, 0.0, 1.0, 2.0];

/// Returns the `n`-th of all combinations of `K` values.
fn combination<const K: usize>(mut n: usize) -> [f64; K] {
    core::array::from_fn(|_| {
        let value = VALUES[n % 5];
        n /= 5;
        value
    })
}

fn flat(x: f64, y: f64) -> HPoint<Clip> {
    HPoint::new(x, y, 0.0, 1.0)
}

fn signed_area(ring: &[[f64; 2]]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| (a[0] * b[1] - a[1] * b[0]) / 2.0).sum()
}

/// Returns the area of the part of a triangle inside [−1, 1]², computed independently by
/// integrating the length of its horizontal cuts. The length is linear between consecutive heights
/// of corners and crossings, so the midpoint rule is exact.
fn area_by_cuts(corners: [[f64; 2]; 3]) -> f64 {
    let edges = [0, 1, 2].map(|i| (corners[i], corners[(i + 1) % 3]));
    let mut heights: Vec<f64> = vec![-1.0, 1.0];
    heights.extend(corners.iter().map(|corner| corner[1]));
    for side in [-1.0, 1.0] {
        let crossing =
            |&([x0, y0], [x1, y1]): &([f64; 2], [f64; 2])| y0 + (side - x0) / (x1 - x0) * (y1 - y0);
        heights.extend(edges.iter().map(crossing).filter(|y| y.is_finite()));
    }
    heights.retain(|y| (-1.0..=1.0).contains(y));
    heights.sort_by(f64::total_cmp);
    heights
        .windows(2)
        .map(|slab| (slab[1] - slab[0]) * cut_length(&edges, (slab[0] + slab[1]) / 2.0))
        .sum()
}

fn cut_length(edges: &[([f64; 2], [f64; 2]); 3], y: f64) -> f64 {
    let crosses = |&&([_, y0], [_, y1]): &&([f64; 2], [f64; 2])| (y0 < y) != (y1 < y);
    let x = |&([x0, y0], [x1, y1]): &([f64; 2], [f64; 2])| x0 + (y - y0) / (y1 - y0) * (x1 - x0);
    let ends: Vec<f64> = edges.iter().filter(crosses).map(x).map(|x| x.clamp(-1.0, 1.0)).collect();
    if ends.len() == 2 { (ends[0] - ends[1]).abs() } else { 0.0 }
}

#[test]
fn areas_of_all_flat_triangles_match_integration() {
    let mut by_corners = [0; 8];
    for n in 0..5_usize.pow(6) {
        let [ax, ay, bx, by, cx, cy] = combination(n);
        let left = clip_triangle([flat(ax, ay), flat(bx, by), flat(cx, cy)], &Volume::CHAPTER);
        let ring: Vec<[f64; 2]> =
            left.vertices().iter().map(|vertex| [vertex.point.x(), vertex.point.y()]).collect();
        by_corners[ring.len()] += 1;
        let corners = [[ax, ay], [bx, by], [cx, cy]];
        let (area, expected) = (signed_area(&ring), area_by_cuts(corners));
        assert!(
            (area.abs() - expected).abs() < 1e-14,
            "{corners:?}: area {area}, expected {expected}"
        );
        assert!(area * signed_area(&corners) >= 0.0, "{corners:?} changed its winding");
    }
    assert_eq!(by_corners[1] + by_corners[2], 0);
    assert!(
        by_corners[3..7].iter().all(|&count| count > 0),
        "expected polygons with 3, 4, 5 and 6 corners: {by_corners:?}"
    );
}

#[test]
fn triangles_with_one_corner_anywhere_in_4d_give_valid_polygons() {
    for n in 0..5_usize.pow(8) {
        let [ax, ay, bx, by, x, y, z, w] = combination(n);
        let corners = [
            HPoint::new(ax, ay, -1.0, 1.0),
            HPoint::new(bx, by, 1.0, 2.0),
            HPoint::new(x, y, z, w),
        ];
        let left = clip_triangle(corners, &Volume::CHAPTER);
        assert!(left.is_empty() || (3..=9).contains(&left.vertices().len()));
        for vertex in left.vertices() {
            assert!(Volume::CHAPTER.contains(vertex.point), "{corners:?}: {vertex:?}");
            let [a, b, c] = vertex.weights;
            let blend = corners[0].raw() * a + corners[1].raw() * b + corners[2].raw() * c;
            let off = (blend - vertex.point.raw()).abs().max_element();
            assert!(
                off < 1e-14 && a.min(b).min(c) >= 0.0,
                "{corners:?}: {vertex:?} is off by {off}"
            );
        }
    }
}

/// A segment is inside where all six tests pass. No test changes its result between two crossings,
/// so testing the midpoint of each stretch is enough.
#[test]
fn all_segments_match_midpoint_tests() {
    for n in 0..5_usize.pow(8) {
        let [px, py, pz, pw, qx, qy, qz, qw] = combination(n);
        let (p, q) = (HPoint::<Clip>::new(px, py, pz, pw), HPoint::new(qx, qy, qz, qw));
        let crossings = crossings(p, q);
        let stretches =
            crossings.windows(2).map(|ends| (ends[0], ends[1], (ends[0] + ends[1]) / 2.0));
        let visible: Vec<_> =
            stretches.filter(|&(_, _, t)| Volume::CHAPTER.contains(p.lerp(q, t))).collect();
        match (clip_segment(p, q, &Volume::CHAPTER), visible.first(), visible.last()) {
            (Some(left), Some(&(t0, _, _)), Some(&(_, t1, _))) => {
                assert!(
                    (left.t0 - t0).abs() < 1e-15 && (left.t1 - t1).abs() < 1e-15,
                    "{p:?} {q:?}: {left:?}"
                );
            }
            // A segment that touches the volume at one point has no visible stretch, and neither
            // does a segment of length 0.
            (Some(left), ..) => assert!(left.t0 == left.t1 || p == q, "{p:?} {q:?}: {left:?}"),
            (None, first, _) => assert_eq!(first, None, "{p:?} {q:?}"),
        }
    }
}

/// Returns, in order, the fractions at which a segment crosses one of the six planes, including
/// both ends.
fn crossings(p: HPoint<Clip>, q: HPoint<Clip>) -> Vec<f64> {
    let sides = |p: HPoint<Clip>| [p.x(), p.y(), p.z()].map(|c| [p.w() + c, p.w() - c]).concat();
    let crossing = |(a, b): (f64, f64)| (a * b < 0.0).then(|| a / (a - b));
    let mut all: Vec<f64> = sides(p).into_iter().zip(sides(q)).filter_map(crossing).collect();
    all.extend([0.0, 1.0]);
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}
