//! 3×3 matrices: textbook examples, intrinsics, rotations and maps of the plane.

use recognition::{MatrixMeaning, PlanarMatrix, PlanarReading, recognize_planar};

type Rows3 = [[f64; 3]; 3];

/// C16: the map of the square to (−3,0), (3,0), (1,3), (−1,3).
const EXAMPLE: Rows3 = [[2.0, 0.0, -1.0], [0.0, 3.0, 0.0], [0.0, 2.0 / 3.0, 1.0 / 3.0]];

fn first(rows: Rows3) -> PlanarReading {
    let (readings, transposed) = recognize_planar(rows);
    assert!(!transposed, "{rows:?}");
    readings[0]
}

fn plane(rows: Rows3) -> MatrixMeaning {
    let found = first(rows).meaning;
    assert!(matches!(found, PlanarMatrix::Plane(_)), "{found:?}");
    match found {
        PlanarMatrix::Plane(meaning) => meaning,
        _ => MatrixMeaning::Projective,
    }
}

fn transposed(m: Rows3) -> Rows3 {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

/// C16 and C17: a multiple of a matrix is the same map.
#[test]
fn the_textbooks_example_and_its_triple_are_projective_maps() {
    for rows in [EXAMPLE, EXAMPLE.map(|row| row.map(|entry| 3.0 * entry))] {
        assert_eq!(first(rows).meaning, PlanarMatrix::Homography);
    }
}

/// C6, C38: 640 × 480 pixels with integer centers.
#[test]
fn viewports_of_the_plane_are_recognized() {
    for (y, y_down) in [(240.0, false), (-240.0, true)] {
        let found = plane([[320.0, 0.0, 319.5], [0.0, y, 239.5], [0.0, 0.0, 1.0]]);
        let MatrixMeaning::Viewport(viewport) = found else { panic!("{found:?}") };
        assert_eq!((viewport.width, viewport.height), (640.0, 480.0));
        assert_eq!((viewport.y_down, viewport.integer_centers), (y_down, true));
    }
}

/// C96: T(100, 50) S(20, 30) T(2, −5).
#[test]
fn a_window_to_a_viewport_is_a_scale_and_an_offset() {
    let found = plane([[20.0, 0.0, 140.0], [0.0, 30.0, -100.0], [0.0, 0.0, 1.0]]);
    let MatrixMeaning::Windowing { scale, offset } = found else { panic!("{found:?}") };
    assert_eq!((scale, offset), ([20.0, 30.0, 1.0], [140.0, -100.0, 0.0]));
}

#[test]
fn intrinsics_are_recognized_and_their_transpose_is_for_row_vectors() {
    let k = [[615.2, 0.0, 320.7], [0.0, 614.9, 241.3], [0.0, 0.0, 1.0]];
    let PlanarMatrix::Intrinsics(found) = first(k).meaning else { panic!("intrinsics") };
    assert_eq!([found.fx, found.fy, found.cx, found.cy], [615.2, 614.9, 320.7, 241.3]);
    assert!(recognize_planar(transposed(k)).1);
    for (cx, cy) in [(640.0, 360.0), (320.0, 320.0)] {
        let rounded = [[1000.0, 0.0, cx], [0.0, 1000.0, cy], [0.0, 0.0, 1.0]];
        assert!(matches!(first(rounded).meaning, PlanarMatrix::Intrinsics(_)));
    }
}

#[test]
fn maps_of_the_plane_are_recognized() {
    let moved = |x: f64, y: f64| [[1.0, 0.0, x], [0.0, 1.0, y], [0.0, 0.0, 1.0]];
    assert_eq!(plane(moved(0.0, 0.0)), MatrixMeaning::Identity);
    assert_eq!(plane(moved(2.0, 3.0)), MatrixMeaning::Translation { by: [2.0, 3.0, 0.0] });
    let found = plane([[0.8, -0.6, 0.0], [0.6, 0.8, 0.0], [0.0, 0.0, 1.0]]);
    let MatrixMeaning::Rotation { axis, angle_degrees, .. } = found else { panic!("{found:?}") };
    assert!(axis == [0.0, 0.0, 1.0] && (angle_degrees - 36.869_898).abs() < 1e-6);
    let found = plane([[1.0, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert!(matches!(found, MatrixMeaning::Shear { .. }));
    let found = plane([[0.6, 0.8, 0.0], [0.8, -0.6, 0.0], [0.0, 0.0, 1.0]]);
    assert!(matches!(found, MatrixMeaning::Reflection { .. }), "{found:?}");
}

/// COLMAP's R: unlike maps of the plane, this rotation has no row (0, 0, 1).
#[test]
fn rotations_of_space_are_distinguished_from_maps_of_the_plane() {
    let (s, c) = libm::sincos(0.5);
    let rows = [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]];
    let PlanarMatrix::SpatialRotation { axis, angle_degrees } = first(rows).meaning else {
        panic!("a rotation")
    };
    assert_eq!(axis, [1.0, 0.0, 0.0]);
    assert!((angle_degrees - 0.5_f64.to_degrees()).abs() < 1e-9);
}

#[test]
fn a_homography_is_not_read_as_a_translation_for_row_vectors() {
    let (readings, transposed) =
        recognize_planar([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.1, 0.2, 1.0]]);
    assert_eq!(readings[0].meaning, PlanarMatrix::Homography);
    assert!(!transposed);
    let (readings, _) = recognize_planar([[f64::NAN; 3]; 3]);
    assert_eq!(readings[0].meaning, PlanarMatrix::Singular);
}
