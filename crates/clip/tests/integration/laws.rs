//! Laws of clipping, tested on random shapes: nothing is lost, nothing is added, and the order of
//! planes and vertices does not matter.
//!
//! Shapes may cross w = 0, be behind the eye, touch borders or extend far out. Coordinates are
//! often small integers, so ties and degenerate shapes are common.

use clip::{
    ClipVertex, PlaneIndex, PlaneOutcome, Volume, clip_convex, clip_point, clip_polyline,
    clip_segment, clip_triangle, segment_outcomes,
};
use glam::DVec4;
use homog::{Clip, HPoint, Plane};
use proptest::prelude::*;

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => -3.0..3.0,
        2 => (-3..=3).prop_map(f64::from),
        1 => -1e6..1e6,
        1 => (-300..300_i32).prop_map(|e| libm::exp2(f64::from(e))),
    ]
}

fn anywhere() -> impl Strategy<Value = HPoint<Clip>> {
    [coordinate(), coordinate(), coordinate(), coordinate()].prop_map(HPoint::from)
}

/// Generates points that are neither huge nor tiny, so that sums of weights stay accurate.
fn moderate() -> impl Strategy<Value = HPoint<Clip>> {
    let near = || prop_oneof![2 => -3.0..3.0, 1 => (-3..=3).prop_map(f64::from)];
    [near(), near(), near(), near()].prop_map(HPoint::from)
}

/// Generates affine points (w = 1) of moderate size, for laws that measure areas and lengths.
fn place() -> impl Strategy<Value = HPoint<Clip>> {
    [-3.0..3.0, -3.0..3.0, -3.0..3.0].prop_map(|[x, y, z]| HPoint::new(x, y, z, 1.0))
}

fn plane() -> impl Strategy<Value = Plane<Clip>> {
    let row = [-1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0];
    row.prop_map(|row| Plane::from_raw(DVec4::from(row)))
}

fn volume() -> impl Strategy<Value = Volume> {
    let conventions =
        [Volume::CHAPTER, Volume::OPENGL, Volume::ZERO_ONE, Volume::ZERO_ONE_REVERSED];
    let open = prop::sample::select(conventions.to_vec()).prop_map(Volume::without_far);
    prop_oneof![4 => prop::sample::select(conventions.to_vec()), 1 => open]
}

/// Returns the fraction of the triangle that a polygon covers, measured in weights.
fn fraction(polygon: &[ClipVertex]) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    let cross = |(p, q): (&ClipVertex, &ClipVertex)| {
        p.weights[1] * q.weights[2] - p.weights[2] * q.weights[1]
    };
    polygon.iter().zip(next).map(cross).sum()
}

fn bits(point: HPoint<Clip>) -> [u64; 4] {
    point.raw().to_array().map(f64::to_bits)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn clipped_triangles_are_inside_and_can_be_divided(corners in [anywhere(), anywhere(), anywhere()], volume in volume()) {
        let left = clip_triangle(corners, &volume);
        prop_assert!(left.is_empty() || left.vertices().len() >= 3);
        for vertex in left.vertices() {
            prop_assert!(volume.contains(vertex.point), "{vertex:?}");
            let place = vertex.point.divide().expect("w > 0");
            prop_assert!(place.x().abs() <= 1.0 && place.y().abs() <= 1.0, "{place:?}");
        }
    }

    #[test]
    fn weights_sum_to_one_and_reproduce_the_vertex(corners in [place(), place(), place()]) {
        for vertex in clip_triangle(corners, &Volume::CHAPTER).vertices() {
            let [a, b, c] = vertex.weights;
            prop_assert!((a + b + c - 1.0).abs() < 1e-14);
            prop_assert!(a.min(b).min(c) >= 0.0, "{:?}", vertex.weights);
            let blend = corners[0].raw() * a + corners[1].raw() * b + corners[2].raw() * c;
            prop_assert!((blend - vertex.point.raw()).abs().max_element() < 1e-13);
        }
    }

    /// D8: an edge shared by two triangles is cut at bit-identical points, regardless of its
    /// direction and of the third vertices.
    #[test]
    fn shared_edges_are_watertight(
        edge in [moderate(), moderate()],
        others in [moderate(), moderate()],
        cuts in prop::collection::vec(plane(), 0..3),
    ) {
        let add = |volume: Volume, plane| volume.with_plane(plane).expect("a free slot");
        let volume = cuts.into_iter().fold(Volume::CHAPTER, add);
        let [p, q] = edge;
        let on_the_edge = |corners, third: usize| {
            let left = clip_triangle(corners, &volume);
            let kept = left.vertices().iter().filter(|vertex| vertex.weights[third] == 0.0);
            let mut points: Vec<_> = kept.map(|vertex| bits(vertex.point)).collect();
            points.sort_unstable();
            (!left.is_empty()).then_some(points)
        };
        let one = on_the_edge([p, q, others[0]], 2);
        let other = on_the_edge([others[1], q, p], 0);
        if let (Some(one), Some(other)) = (one, other) {
            prop_assert_eq!(one, other);
        }
    }

    #[test]
    fn vertex_order_does_not_change_the_clipped_area(corners in [place(), place(), place()]) {
        let [a, b, c] = corners;
        let areas = [[a, b, c], [b, c, a], [a, c, b]].map(|t| fraction(clip_triangle(t, &Volume::CHAPTER).vertices()));
        prop_assert!((areas[0] - areas[1]).abs() < 1e-12 && (areas[0] - areas[2]).abs() < 1e-12);
    }

    #[test]
    fn clipping_is_idempotent(corners in [anywhere(), anywhere(), anywhere()], volume in volume()) {
        let once = clip_triangle(corners, &volume);
        for piece in once.triangles() {
            let again = clip_triangle(piece.map(|vertex| vertex.point), &volume);
            prop_assert!(again.is_unclipped());
            prop_assert_eq!(again.outcomes, clip::PlaneOutcomes::default());
        }
    }

    /// Area is conserved: the parts on both sides of a plane add up to the whole.
    #[test]
    fn both_sides_of_a_plane_add_up_to_the_whole(corners in [moderate(), moderate(), moderate()], cut in plane()) {
        let all = fraction(clip_triangle(corners, &Volume::CHAPTER).vertices());
        let sides = [cut, Plane::from_raw(-cut.raw())].map(|side| {
            let volume = Volume::CHAPTER.with_plane(side).expect("a free slot");
            fraction(clip_triangle(corners, &volume).vertices())
        });
        prop_assert!((sides[0] + sides[1] - all).abs() < 1e-9, "{sides:?} do not add up to {all}");
    }

    #[test]
    fn the_order_of_planes_does_not_matter(
        corners in [place(), place(), place()],
        cuts in [plane(), plane(), plane()],
    ) {
        let area = |order: [usize; 3]| {
            let add = |volume: Volume, i: usize| volume.with_plane(cuts[i]).expect("a free slot");
            fraction(clip_triangle(corners, &order.into_iter().fold(Volume::CHAPTER, add)).vertices())
        };
        let first = area([0, 1, 2]);
        for order in [[2, 1, 0], [1, 2, 0], [0, 2, 1]] {
            prop_assert!((area(order) - first).abs() < 1e-10);
        }
    }

    #[test]
    fn larger_volumes_keep_more(corners in [anywhere(), anywhere(), anywhere()], k in 1.0..16.0) {
        let band = Volume::CHAPTER.with_guard_band(k, k).expect("allowed");
        let [small, large] = [Volume::CHAPTER, band].map(|volume| fraction(clip_triangle(corners, &volume).vertices()));
        prop_assert!(small <= large + 1e-12);
    }

    /// A guard band changes how much of a triangle is passed on, but not its visible part.
    #[test]
    fn clipping_to_the_band_first_keeps_the_visible_area(corners in [place(), place(), place()], k in 1.0..16.0) {
        let band = Volume::CHAPTER.with_guard_band(k, k).expect("allowed");
        let direct = fraction(clip_triangle(corners, &Volume::CHAPTER).vertices());
        let ndc_area = |triangle: [HPoint<Clip>; 3]| {
            let [a, b, c] = triangle.map(|p| p.raw().truncate());
            (b - a).cross(c - a).length()
        };
        let by_band: f64 = clip_triangle(corners, &band)
            .triangles()
            .map(|piece| piece.map(|vertex| vertex.point))
            .map(|piece| ndc_area(piece) * fraction(clip_triangle(piece, &Volume::CHAPTER).vertices()))
            .sum();
        prop_assert!((by_band - direct * ndc_area(corners)).abs() < 1e-9);
    }

    #[test]
    fn segments_are_clipped_alike_in_both_directions(p in anywhere(), q in anywhere(), volume in volume()) {
        let (there, back) = (clip_segment(p, q, &volume), clip_segment(q, p, &volume));
        prop_assert_eq!(there.is_some(), back.is_some());
        if let (Some(there), Some(back)) = (there, back) {
            prop_assert_eq!((bits(there.start), bits(there.end)), (bits(back.end), bits(back.start)));
            prop_assert_eq!((there.enter, there.exit), (back.exit, back.enter));
            prop_assert!((there.t0 + back.t1 - 1.0).abs() < 1e-15 && (there.t1 + back.t0 - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn clipped_segments_are_inside_and_clipping_is_idempotent(p in anywhere(), q in anywhere(), volume in volume()) {
        let Some(left) = clip_segment(p, q, &volume) else { return Ok(()) };
        prop_assert!(0.0 <= left.t0 && left.t0 <= left.t1 && left.t1 <= 1.0);
        prop_assert!(volume.contains(left.start) && volume.contains(left.end), "{left:?}");
        let again = clip_segment(left.start, left.end, &volume).expect("inside");
        prop_assert_eq!((again.t0, again.t1, again.enter, again.exit), (0.0, 1.0, None, None));
    }

    /// Nothing is lost: a point of a segment is inside if and only if it is between the cuts.
    #[test]
    fn points_of_segments_are_inside_exactly_between_the_cuts(p in place(), q in place(), t in 0.0..1.0) {
        let inside = clip_point(p.lerp(q, t), &Volume::CHAPTER).is_some();
        match clip_segment(p, q, &Volume::CHAPTER) {
            Some(left) if (t - left.t0).abs() > 1e-9 && (t - left.t1).abs() > 1e-9 => {
                prop_assert_eq!(inside, left.t0 < t && t < left.t1);
            }
            Some(_) => {}
            None => prop_assert!(!inside),
        }
    }

    #[test]
    fn outcomes_name_the_planes_that_clipped(p in place(), q in place()) {
        let fates = segment_outcomes(p, q, &Volume::CHAPTER);
        match clip_segment(p, q, &Volume::CHAPTER) {
            Some(left) => {
                let acted = [left.enter, left.exit];
                for plane in PlaneIndex::BOX {
                    prop_assert_eq!(fates.outcome_of(plane) == PlaneOutcome::Clipped, acted.contains(&Some(plane)));
                }
            }
            None => prop_assert!(!fates.rejected.is_inside()),
        }
    }

    /// A triangle moved completely beyond one plane is rejected by that plane.
    #[test]
    fn shapes_beyond_one_plane_are_rejected_by_it(
        corners in [place(), place(), place()],
        axis in 0..3_usize,
        low: bool,
    ) {
        let moved = corners.map(|corner| {
            let mut raw = corner.raw();
            raw[axis] = if low { -1.5 - raw[axis].abs() } else { 1.5 + raw[axis].abs() };
            HPoint::from_raw(raw)
        });
        let index = PlaneIndex::new(2 * axis + usize::from(!low)).expect("a plane of the box");
        let left = clip_triangle(moved, &Volume::OPENGL);
        prop_assert!(left.is_empty());
        prop_assert_eq!(left.outcomes.outcome_of(index), PlaneOutcome::Rejected);
    }

    #[test]
    fn polylines_match_their_segments(points in prop::collection::vec(anywhere(), 0..12)) {
        let volume = Volume::CHAPTER;
        let runs = clip_polyline(&points, &volume);
        let pieces = runs.iter().flat_map(|run| run.windows(2)).map(|ends| (bits(ends[0].point), bits(ends[1].point)));
        let segments = points.windows(2).filter_map(|ends| clip_segment(ends[0], ends[1], &volume));
        prop_assert_eq!(
            pieces.collect::<Vec<_>>(),
            segments.map(|left| (bits(left.start), bits(left.end))).collect::<Vec<_>>()
        );
    }

    #[test]
    fn convex_polygons_match_their_fans(center in place(), radius in 0.1..4.0, sides in 3..12_usize) {
        let corner = |i: usize| libm::sincos(i as f64 * core::f64::consts::TAU / sides as f64);
        let ring: Vec<HPoint<Clip>> = (0..sides)
            .map(corner)
            .map(|(s, c)| HPoint::from_raw(center.raw() + DVec4::new(radius * c, radius * s, 0.0, 0.0)))
            .collect();
        let area = |points: &[HPoint<Clip>]| -> f64 {
            let next = points.iter().cycle().skip(1);
            points.iter().zip(next).map(|(p, q)| p.x() * q.y() - p.y() * q.x()).sum()
        };
        let whole = area(clip_convex(&ring, &Volume::CHAPTER).points());
        let fan = (2..sides).map(|i| {
            let left = clip_triangle([ring[0], ring[i - 1], ring[i]], &Volume::CHAPTER);
            area(&left.vertices().iter().map(|vertex| vertex.point).collect::<Vec<_>>())
        });
        prop_assert!((fan.sum::<f64>() - whole).abs() < 1e-12 * (1.0 + radius * radius));
    }
}
