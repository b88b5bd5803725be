//! Section cuts of closed solids: the outline closes, the volume is conserved, and the cap fills
//! the outline.
//!
//! The solids are a cube, a faceted sphere, and two tori whose sections have a hole or two pieces.

use clip::{CutTriangle, Outline, cut_triangle};
use glam::DVec3;
use homog::{Normal, Plane, Point, World};
use proptest::prelude::*;
use std::f64::consts::TAU;

type Triangle = [Point<World>; 3];

/// Returns a faceted torus over a grid that closes in both directions.
fn ring(around: usize, along: usize) -> Vec<Triangle> {
    let place = |i: usize, j: usize| {
        let (s, c) = libm::sincos(TAU * (i % around) as f64 / around as f64);
        let (t, d) = libm::sincos(TAU * (j % along) as f64 / along as f64);
        let r = 2.0 + 0.75 * d;
        Point::new(r * c, 0.75 * t, -r * s)
    };
    squares(around, along, place)
}

fn squares(m: usize, n: usize, place: impl Fn(usize, usize) -> Point<World>) -> Vec<Triangle> {
    let square = |i: usize, j: usize| {
        let [a, b, c, d] = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    (0..m)
        .flat_map(|i| (0..n).flat_map(move |j| [(i, j)]))
        .flat_map(|(i, j)| square(i, j))
        .collect()
}

/// Returns a sphere of eight subdivided octants, with triangles counterclockwise seen from outside.
fn sphere() -> Vec<Triangle> {
    let n = 6;
    let mut triangles = Vec::new();
    for signs in 0..8 {
        let sign =
            DVec3::from_array([0, 1, 2].map(|bit| if signs >> bit & 1 == 1 { -1.0 } else { 1.0 }));
        let mirrored = sign.x * sign.y * sign.z < 0.0;
        let place = |i: i32, j: i32| {
            let raw = DVec3::new(f64::from(i), f64::from(j), f64::from(n - i - j));
            Point::from_raw(raw.normalize() * sign + 0.0)
        };
        let mut add =
            |[a, b, c]: Triangle| triangles.push(if mirrored { [a, c, b] } else { [a, b, c] });
        for i in 0..n {
            for j in 0..n - i {
                add([place(i, j), place(i + 1, j), place(i, j + 1)]);
                if i + j < n - 1 {
                    add([place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)]);
                }
            }
        }
    }
    triangles
}

fn cube() -> Vec<Triangle> {
    let corner = |i: usize| Point::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64);
    let sides =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let halves = |[a, b, c, d]: [usize; 4]| [[a, b, c].map(corner), [a, c, d].map(corner)];
    sides.into_iter().flat_map(halves).collect()
}

fn solids() -> [Vec<Triangle>; 4] {
    [cube(), sphere(), ring(24, 12), ring(5, 3)]
}

/// Returns the volume of a solid as a sum over tetrahedra with a common apex.
fn volume(triangles: &[Triangle], from: Point<World>) -> f64 {
    let six = |[a, b, c]: Triangle| (a - from).dot((b - from).cross(c - from));
    triangles.iter().copied().map(six).sum::<f64>() / 6.0
}

fn area(triangles: &[Triangle], normal: DVec3) -> f64 {
    triangles.iter().map(|[a, b, c]| (*b - *a).cross(*c - *a).raw().dot(normal) / 2.0).sum()
}

/// Returns the part of a solid on the positive side of a plane, and the outline of the opening.
fn cut(solid: &[Triangle], plane: Plane<World>) -> (Vec<Triangle>, Outline<World>) {
    let pieces: Vec<_> = solid.iter().map(|&triangle| cut_triangle(triangle, plane)).collect();
    let left = pieces.iter().flat_map(CutTriangle::triangles);
    let left = left.map(|triangle| triangle.map(|vertex| vertex.point)).collect();
    let edges: Vec<_> = pieces.iter().filter_map(CutTriangle::edge).collect();
    (left, Outline::from_edges(&edges))
}

fn check(solid: &[Triangle], through: Point<World>, normal: DVec3) -> Result<(), TestCaseError> {
    let mut halves = 0.0;
    let mut caps = Vec::new();
    for normal in [normal, -normal] {
        let plane = Plane::through(through, Normal::from_raw(normal));
        let (left, outline) = cut(solid, plane);
        prop_assert!(outline.is_closed(), "open: {:?}", outline.open);
        let cap = outline.triangulate_cap(plane);
        prop_assert!(
            cap.iter().all(|&t| area(&[t], -normal) > -1e-12),
            "a cap triangle is clockwise"
        );
        // With the apex on the plane, the cap contributes no volume; with the apex elsewhere, it
        // must close the solid.
        let half = volume(&left, through);
        let closed: Vec<Triangle> = left.into_iter().chain(cap.iter().copied()).collect();
        let elsewhere = through + homog::Vector::new(3.0, -7.0, 5.0);
        let again = volume(&closed, elsewhere);
        prop_assert!(
            (again - half).abs() < 1e-9,
            "with the cap the volume is {again}, expected {half}"
        );
        halves += half;
        caps.push(area(&cap, -normal));
    }
    let whole = volume(solid, through);
    prop_assert!((halves - whole).abs() < 1e-9, "the halves add up to {halves}, expected {whole}");
    // A face in the plane already closes the half with the solid, so the cap areas may differ.
    let plane = Plane::through(through, Normal::from_raw(normal));
    let has_face =
        solid.iter().any(|t| t.iter().all(|&corner| plane.evaluate(corner).abs() < 1e-12));
    prop_assert!(has_face || (caps[0] - caps[1]).abs() < 1e-9, "the caps have areas {caps:?}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn halves_with_caps_add_up_to_the_whole(
        through in [-1.0..1.0, -1.0..1.0, -1.0..1.0],
        normal in [-1.0..1.0, -1.0..1.0, -1.0..1.0],
    ) {
        let normal = DVec3::from(normal);
        prop_assume!(normal.length() > 0.1);
        for solid in solids() {
            check(&solid, Point::from(through), normal.normalize())?;
        }
    }
}

/// Planes in these special positions hit corners, edges and whole faces of the solids.
#[test]
fn planes_through_corners_and_edges_also_conserve_volume() {
    for solid in solids() {
        for axis in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(0.6, 0.8, 0.0)] {
            for place in [-0.5, 0.0, 0.25, 0.5, 0.75] {
                check(&solid, Point::from_raw(DVec3::splat(place)), axis).unwrap_or_else(|error| {
                    panic!("plane through {place} with normal {axis}: {error}");
                });
            }
        }
    }
}

#[test]
fn horizontal_torus_cuts_have_a_hole_and_vertical_cuts_have_two_pieces() {
    let ring = ring(24, 12);
    let pieces = |normal| {
        let plane = Plane::through(Point::new(0.0, 0.1, 0.05), normal);
        let (_, outline) = cut(&ring, plane);
        let cap = area(&outline.triangulate_cap(plane), -plane.normal().raw());
        (outline.loops.len(), cap)
    };
    let (loops, flat) = pieces(Normal::new(0.0, 1.0, 0.0));
    assert_eq!(loops, 2);
    assert!((flat - TAU / 2.0 * (2.73 * 2.73 - 1.27 * 1.27)).abs() < 0.8, "{flat}");
    let (loops, vertical) = pieces(Normal::new(0.0, 0.0, 1.0));
    assert_eq!(loops, 2);
    assert!((vertical - TAU * 0.75 * 0.75).abs() < 0.4, "{vertical}");
}

#[test]
fn planes_that_miss_the_solid_keep_everything_or_nothing() {
    let above = Plane::through(Point::new(0.0, 5.0, 0.0), Normal::new(0.0, 1.0, 0.0));
    let (left, outline) = cut(&cube(), above);
    assert!(
        left.is_empty() && outline.loops.is_empty() && outline.triangulate_cap(above).is_empty()
    );
    let below = Plane::through(Point::new(0.0, -5.0, 0.0), Normal::new(0.0, 1.0, 0.0));
    assert_eq!(cut(&cube(), below).0, cube());
    let nan = Plane::through(Point::new(f64::NAN, 0.0, 0.0), Normal::new(0.0, 1.0, 0.0));
    assert!(cut(&cube(), nan).0.is_empty());
}

#[test]
fn corners_on_the_plane_stay_finite_however_far_the_others_are() {
    let plane = Plane::<World>::through(Point::ORIGIN, Normal::new(0.0, 1.0, 0.0));
    let far = 1.5e308;
    let corners =
        [Point::new(-far, 0.0, 0.0), Point::new(far, -1.0, 0.0), Point::new(0.0, 1.0, 0.0)];
    let left = cut_triangle(corners, plane);
    let edge = left.edge();
    assert!(edge.is_none_or(|edge| edge.iter().all(|end| end.is_finite())), "{edge:?}");
    assert!(left.vertices().iter().all(|vertex| vertex.point.is_finite()), "{left:?}");
}
