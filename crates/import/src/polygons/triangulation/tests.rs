//! Triangulation tests. They check areas and covered points, not which ears were clipped.

use super::*;

/// Triangulates a polygon, and returns its triangles and its kind.
fn triangulate(corners: &[[f32; 3]]) -> (Vec<[u32; 3]>, PolygonKind) {
    let mut triangles = vec![[9; 3]];
    let kind = Triangulator::default().triangulate(corners, &mut triangles);
    (triangles.split_off(1), kind)
}

/// Returns twice the signed areas of triangles in the plane z = 0.
fn doubled_areas(corners: &[[f32; 3]], triangles: &[[u32; 3]]) -> Vec<f64> {
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|at| corners[at as usize].map(f64::from));
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    triangles.iter().map(area).collect()
}

/// Returns twice the signed area of a polygon in the plane z = 0, by the shoelace formula.
fn doubled_polygon_area(corners: &[[f32; 3]]) -> f64 {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    edges
        .map(|(a, b)| [a, b].map(|p| p.map(f64::from)))
        .fold(0.0, |sum, [a, b]| sum + a[0] * b[1] - a[1] * b[0])
}

/// Checks that a counter-clockwise polygon is covered exactly once: by n − 2 triangles, none of
/// them reversed, whose areas add up to the area of the polygon.
fn assert_covered(plane: &[[f32; 2]]) -> Vec<[u32; 3]> {
    let corners: Vec<[f32; 3]> = plane.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    let (triangles, kind) = triangulate(&corners);
    assert_eq!(kind, PolygonKind::Simple, "{plane:?}");
    assert_eq!(triangles.len(), corners.len() - 2);
    let areas = doubled_areas(&corners, &triangles);
    assert!(areas.iter().all(|area| *area >= 0.0), "{plane:?}: {triangles:?}");
    let whole = doubled_polygon_area(&corners);
    assert!((areas.iter().sum::<f64>() - whole).abs() <= 1e-9 * whole, "{plane:?}: {triangles:?}");
    triangles
}

#[test]
fn convex_polygons_become_fans() {
    let quad = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
    assert_eq!(assert_covered(&quad), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(triangulate(&[]), (vec![], PolygonKind::Simple));
    assert_eq!(triangulate(&[[0.0; 3]; 2]), (vec![], PolygonKind::Simple));
    assert_eq!(triangulate(&[[0.0; 3]; 3]), (vec![[0, 1, 2]], PolygonKind::Simple));
}

/// Concave polygons: an arrowhead, an L, a U, a comb, a staircase and a spiral.
const CONCAVE: [&[[f32; 2]]; 6] = [
    &[[0.0, 0.0], [4.0, 4.0], [0.0, 8.0], [2.0, 4.0]],
    &[[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [1.0, 1.0], [1.0, 4.0], [0.0, 4.0]],
    &[
        [0.0, 0.0],
        [6.0, 0.0],
        [6.0, 5.0],
        [5.0, 5.0],
        [5.0, 1.0],
        [1.0, 1.0],
        [1.0, 5.0],
        [0.0, 5.0],
    ],
    &[
        [0.0, 0.0],
        [7.0, 0.0],
        [7.0, 5.0],
        [6.0, 1.0],
        [5.0, 5.0],
        [4.0, 1.0],
        [3.0, 5.0],
        [2.0, 1.0],
        [0.0, 5.0],
    ],
    &[
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 1.0],
        [2.0, 1.0],
        [2.0, 2.0],
        [1.0, 2.0],
        [1.0, 3.0],
        [0.0, 3.0],
    ],
    &[
        [0.0, 0.0],
        [6.0, 0.0],
        [6.0, 6.0],
        [2.0, 6.0],
        [2.0, 3.0],
        [4.0, 3.0],
        [4.0, 4.0],
        [3.0, 4.0],
        [3.0, 5.0],
        [5.0, 5.0],
        [5.0, 1.0],
        [1.0, 1.0],
        [1.0, 7.0],
        [0.0, 7.0],
    ],
];

#[test]
fn concave_polygons_are_covered_once_whichever_corner_is_first() {
    for shape in CONCAVE {
        for first in 0..shape.len() {
            let mut turned = shape.to_vec();
            turned.rotate_left(first);
            assert_covered(&turned);
        }
    }
}

#[test]
fn collinear_and_repeated_corners_are_triangulated() {
    // A square with a further corner on each edge becomes six triangles with nonzero area.
    let square = [
        [0.0, 0.0],
        [1.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [2.0, 2.0],
        [1.0, 2.0],
        [0.0, 2.0],
        [0.0, 1.0],
    ];
    let corners = square.map(|[x, y]| [x, y, 0.0]);
    let triangles = assert_covered(&square);
    assert!(doubled_areas(&corners, &triangles).iter().all(|area| *area > 0.0));
    // A corner that occurs twice, one that occurs three times in a row, and a spike of zero width.
    assert_covered(&[[0.0, 0.0], [2.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
    assert_covered(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 2.0], [0.0, 2.0]]);
    assert_covered(&[[0.0, 0.0], [2.0, 0.0], [5.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
}

#[test]
fn a_hole_joined_by_a_bridge_stays_open() {
    let keyhole = [
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 4.0],
        [0.0, 4.0],
        [0.0, 0.0],
        [1.0, 1.0],
        [1.0, 3.0],
        [3.0, 3.0],
        [3.0, 1.0],
        [1.0, 1.0],
    ];
    for first in 0..keyhole.len() {
        let mut turned = keyhole;
        turned.rotate_left(first);
        let triangles = assert_covered(&turned);
        // No triangle contains the center of the hole.
        for triangle in triangles {
            let [a, b, c] = triangle.map(|at| turned[at as usize].map(f64::from));
            let middle = [2.0, 2.0];
            let is_inside = [[a, b], [b, c], [c, a]]
                .iter()
                .all(|[from, to]| orient2d(*from, *to, middle) > 0.0);
            assert!(!is_inside, "{triangle:?}");
        }
    }
}

#[test]
fn triangulation_is_independent_of_pose() {
    let l_shape: [[f32; 2]; 6] =
        [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [1.0, 1.0], [1.0, 4.0], [0.0, 4.0]];
    let expected = assert_covered(&l_shape);
    let placements: [fn([f32; 2]) -> [f32; 3]; 5] = [
        |[x, y]| [7.0, x, y],
        |[x, y]| [y, 7.0, x],
        // The last three: slightly nonplanar, tilted, and seen from behind.
        |[x, y]| [x, y, 0.05 * x * y],
        |[x, y]| [x, y, 0.25 * x],
        |[x, y]| [-x, y, 0.0],
    ];
    for (at, place) in placements.iter().enumerate() {
        assert_eq!(
            triangulate(&l_shape.map(place)),
            (expected.clone(), PolygonKind::Simple),
            "{at}"
        );
    }
}

#[test]
fn self_intersecting_polygons_become_fans_and_are_reported() {
    let pentagram: Vec<[f32; 3]> = [[0.0, 5.0], [3.0, -4.0], [-5.0, 2.0], [5.0, 2.0], [-3.0, -4.0]]
        .map(|[x, y]| [x, y, 0.0])
        .to_vec();
    let (triangles, kind) = triangulate(&pentagram);
    assert_eq!((triangles.len(), kind), (3, PolygonKind::Fan));
    // A square that is traversed five times.
    let square = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let (triangles, _) = triangulate(&square.repeat(5));
    assert_eq!(triangles.len(), 18);
    assert!(triangles.as_flattened().iter().all(|corner| *corner < 20));
}

#[test]
fn polygons_without_area_become_fans() {
    let line: Vec<[f32; 3]> = (0..9).map(|x| [x as f32, 0.0, 0.0]).collect();
    assert_eq!(triangulate(&[[3.0; 3]; 6]).1, PolygonKind::Flat);
    let (triangles, kind) = triangulate(&line);
    assert_eq!((triangles.len(), kind), (7, PolygonKind::Flat));
}

#[test]
fn tiny_and_huge_coordinates_are_triangulated() {
    for scale in [1e-30, 1e30_f32] {
        let arrowhead = [[0.0, 0.0], [4.0, 4.0], [0.0, 8.0], [2.0, 4.0]];
        let corners = arrowhead.map(|[x, y]: [f32; 2]| [scale * x, scale * y, 0.0]);
        let (triangles, kind) = triangulate(&corners);
        assert_eq!((triangles, kind), (vec![[3, 0, 1], [2, 3, 1]], PolygonKind::Simple));
    }
}

#[test]
fn ten_thousand_corners_are_within_the_test_limit() {
    // A comb with 2,499 teeth, which has nearly all its ears at the tips of the teeth.
    let comb: Vec<[f32; 2]> = (0..4998)
        .map(|at| [(4998 - at) as f32, if at % 2 == 0 { 100.0 } else { 1.0 }])
        .chain([[0.0, 0.0], [5000.0, 0.0]])
        .collect();
    assert_covered(&comb);
    // The same comb on its side, so that its teeth follow one another in y, not x.
    assert_covered(&comb.iter().map(|[x, y]| [y * 0.01, -x]).collect::<Vec<_>>());
    // A star around the origin, with 5,000 tips.
    let star: Vec<[f32; 2]> = (0..10_000)
        .map(|at| {
            let angle = f64::from(at) * std::f64::consts::TAU / 10_000.0;
            let radius = if at % 2 == 0 { 1.0 } else { 0.5 };
            [radius * libm::cos(angle), radius * libm::sin(angle)].map(|x| x as f32)
        })
        .collect();
    assert_covered(&star);
}

#[test]
fn the_test_limit_applies_to_the_whole_file() {
    let mut triangulator = Triangulator { tests_left: 3, ..Triangulator::default() };
    let u_shape: Vec<[f32; 3]> = CONCAVE[2].iter().map(|&[x, y]| [x, y, 0.0]).collect();
    let mut triangles = Vec::new();
    assert_eq!(triangulator.triangulate(&u_shape, &mut triangles), PolygonKind::Fan);
    assert_eq!(triangles.len(), 6);
}
