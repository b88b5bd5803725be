//! Matrices as people type them: with entries of different precision, for row vectors, or for
//! projections that the builders do not produce.

use super::formulas::*;
use glam::DMat4;
use projection::{Classical, Convention, Planometric, ProjectionClass};
use recognition::{MatrixMeaning, Misprint, Recognition, recognize};

fn recognized(rows: Rows) -> Recognition {
    recognize(rows)
}

/// The matrix of an isometric camera at (5, 5, 5): 1/√2, 1/√6, √(2/3) and 1/√3 have four to six
/// decimals, and −5√3 has five or more.
#[test]
fn one_entry_with_more_digits_does_not_hide_a_camera() {
    let round = |x: f64, digits: usize| format!("{x:.digits$}").parse::<f64>().expect("a number");
    for distance in [-8.660_254_037_844_387, -8.660_254, -8.66025] {
        for digits in [4, 5, 6] {
            let squares = [0.5_f64, 1.0 / 6.0, 2.0 / 3.0, 1.0 / 3.0];
            let [side, down, up, ahead] = squares.map(|square| round(square.sqrt(), digits));
            let rows = [
                [side, 0.0, -side, 0.0],
                [-down, up, -down, 0.0],
                [ahead, ahead, ahead, distance],
                [0.0, 0.0, 0.0, 1.0],
            ];
            let found = recognized(rows).first().meaning;
            let MatrixMeaning::Camera(camera) = found else { panic!("{rows:?}: {found:?}") };
            assert!(camera.eye.iter().all(|x| (x - 5.0).abs() < 2e-3), "{:?}", camera.eye);
            // The same matrix for row vectors.
            let turned = recognized(transposed(rows));
            assert_eq!(turned.misprint().map(|m| m.misprint), Some(Misprint::Transposed));
        }
    }
}

/// Without transposition, a matrix stored column by column has only a far-fetched reading.
#[test]
fn a_transposed_translation_is_not_a_three_point_perspective() {
    for by in [[3.0, 4.0, 5.0], [10.0, -2.0, 0.5], [0.0, 0.0, -5.0]] {
        let found = recognized(transposed(translation(by)));
        assert_eq!(found.misprint().map(|m| m.misprint), Some(Misprint::Transposed), "{by:?}");
    }
    // Three vanishing points outside the unit cube are plausible.
    let mut rows = scale([1.0; 3]);
    rows[3] = [0.1, 0.2, 0.3, 1.0];
    assert_eq!(recognized(rows).misprint(), None);
    let mut oblique = scale([1.0; 3]);
    (oblique[0][2], oblique[1][2]) = (0.25, 0.433);
    let found = recognized(transposed(oblique));
    assert_eq!(found.misprint().map(|m| m.misprint), Some(Misprint::Transposed));
}

/// C77, C78, with sines and cosines of three to six decimals.
#[test]
fn rounded_cavalier_and_cabinet_projections_are_recognized() {
    for (length, class) in [(1.0, ProjectionClass::Cavalier), (0.5, ProjectionClass::Cabinet)] {
        for degrees in [30.0, 45.0, 60.0, -135.0_f64] {
            let (sin, cos) = libm::sincos(degrees.to_radians());
            let mut flat = scale([1.0, 1.0, 0.0]);
            (flat[0][2], flat[1][2]) = (length * cos, length * sin);
            for decimals in 3..=6 {
                let found = recognized(rounded(flat, decimals)).first().meaning;
                let MatrixMeaning::ObliqueOntoPlane { projection } = found else {
                    panic!("{degrees}, {decimals}: {found:?}")
                };
                assert_eq!(Classical::Oblique(projection).class(), class, "{degrees}, {decimals}");
                let off = (projection.phi().to_degrees() - degrees).abs();
                assert!(off < 1e-9, "{degrees}, {decimals}: {off}");
            }
        }
    }
}

#[test]
fn the_military_projection_is_recognized() {
    for (turn, decimals) in [(30.0, 4), (45.0, 3), (45.0, 12), (-20.0, 6)] {
        let military = Planometric::military(f64::to_radians(turn)).expect("valid");
        let of = |matrix: DMat4| rounded(matrix.transpose().to_cols_array_2d(), decimals);
        for (matrix, flat) in
            [(military.onto_plane().raw(), true), (military.depth_preserving().raw(), false)]
        {
            let found = recognized(of(matrix)).first().meaning;
            let expected = MatrixMeaning::Planometric {
                turn_degrees: turn,
                height: 1.0,
                z_up: false,
                onto_plane: flat,
            };
            assert_eq!(found, expected, "{turn}, {decimals}");
        }
        // The plan is in x and y, with heights along z.
        let (s, c) = libm::sincos(turn.to_radians());
        let rows = [[c, -s, 0.0, 0.0], [s, c, 0.5, 0.0], [0.0; 4], [0.0, 0.0, 0.0, 1.0]];
        let found = recognized(rounded(rows, decimals)).first().meaning;
        let expected = MatrixMeaning::Planometric {
            turn_degrees: turn,
            height: 0.5,
            z_up: true,
            onto_plane: true,
        };
        assert_eq!(found, expected, "{turn}, {decimals}");
    }
}

/// PL-1: M_vp M_per and M_vp M_per M_cam, in both pixel conventions.
#[test]
fn a_perspective_projection_to_pixels_is_recognized() {
    let view = m_cam([4.0, 3.0, 6.0], [-4.0, -3.0, -6.0], [0.0, 1.0, 0.0]);
    let mut half = m_vp(640.0, 480.0, false);
    (half[0][3], half[1][3]) = (320.0, 240.0);
    let window = [-4.0, 4.0, -3.0, 3.0];
    for (pixels, integer, down) in [
        (m_vp(640.0, 480.0, false), true, false),
        (m_vp(640.0, 480.0, true), true, true),
        (half, false, false),
    ] {
        for (projection, convention) in [
            (m_per(window, -2.0, -10.0), Convention::CHAPTER),
            (gl_frustum(window, 2.0, 10.0), Convention::OPENGL),
        ] {
            let bare = product(pixels, projection);
            for (rows, placed) in [(bare, false), (product(bare, view), true)] {
                let found = recognized(rows).first().meaning;
                let MatrixMeaning::PerspectiveToPixels {
                    size,
                    y_down,
                    integer_centers,
                    camera,
                    frustum,
                    convention: read,
                    ..
                } = found
                else {
                    panic!("{integer}, {down}, {placed}: {found:?}")
                };
                assert_eq!(size, [640.0, 480.0]);
                assert_eq!((integer_centers, y_down), (integer, down));
                assert_eq!(read, convention);
                let off_by = (frustum.near() - 2.0).abs() + (frustum.window().right() - 4.0).abs();
                assert!(off_by < 1e-9 && (frustum.far() - 10.0).abs() < 1e-9, "{frustum:?}");
                assert_eq!(camera.is_some(), placed);
                let off = |eye: [f64; 3]| eye.into_iter().zip([4.0, 3.0, 6.0]).map(|(a, b)| a - b);
                assert!(camera.is_none_or(|c| off(c.eye).all(|x| x.abs() < 1e-9)));
            }
        }
    }
}

/// M13 (+mid_y), M18 (+yw_min) and M22 ((1 − z)/2) print correct matrices for other parameters.
/// None of the sixteen entries shows the misprint, so the matrices are read as printed and have no
/// row in the table.
#[test]
fn misprints_that_are_other_correct_matrices_are_read_as_printed() {
    let m13 = recognized(translation([-1.0, 0.5, 0.0]));
    assert_eq!(m13.first().meaning, MatrixMeaning::Translation { by: [-1.0, 0.5, 0.0] });
    let m18 = recognized(product(scale([100.0, 50.0, 1.0]), translation([-2.0, 1.0, 0.0])));
    let windowing =
        MatrixMeaning::Windowing { scale: [100.0, 50.0, 1.0], offset: [-200.0, 50.0, 0.0] };
    assert_eq!(m18.first().meaning, windowing);
    let m22 = recognized(product(translation([0.0, 0.0, 0.5]), scale([1.0, 1.0, -0.5])));
    assert!(m22.first().meaning.is_named(), "{:?}", m22.first());
    for found in [m13, m18, m22] {
        assert_eq!(found.misprint(), None, "{:?}", found.first());
    }
}

/// The entries are sines and cosines, so their decimals limit the meaningful digits of the angle.
#[test]
fn angles_have_no_more_digits_than_the_entries_justify() {
    for (decimals, off) in [(3, 0.06), (4, 6e-3), (6, 6e-5)] {
        let turned = rounded(product(rotation_x(20.0), rotation_y(-35.0)), decimals);
        let MatrixMeaning::Rotation { angle_degrees, .. } = recognized(turned).first().meaning
        else {
            panic!("a rotation")
        };
        let digits = format!("{angle_degrees}").len();
        assert!(digits <= decimals + 3, "{decimals}: {angle_degrees}");
        // cos(θ/2) = cos 10° cos 17.5°
        let half = libm::cos(10_f64.to_radians()) * libm::cos(17.5_f64.to_radians());
        let exact = 2.0 * libm::acos(half).to_degrees();
        assert!((angle_degrees - exact).abs() < 2.0 * off, "{decimals}: {angle_degrees}, {exact}");
    }
}
