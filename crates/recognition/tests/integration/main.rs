//! Tests of recognition: a table of 120 matrices from books, graphics APIs and programs, half of
//! them wrong, and 10,000 random matrices.
// The test names document them.
#![allow(missing_docs)]

mod formulas;
mod generated_table;
mod generated_views;
mod hand_typed;
mod misprints;
mod placed;
mod planar;
mod random_matrices;
mod right_matrices;
mod rigid;
#[allow(dead_code, reason = "the law tests in `projection` use the rest")]
#[path = "../../../projection/tests/integration/laws/samples.rs"]
mod samples;
mod table;
mod wrong_matrices;

use glam::{DMat4, DVec4};
use projection::AxonometricKind;
use recognition::{MatrixMeaning, recognize};

/// The entries are 1/√2, 1/√6 and √(2/3) with three to nine decimals.
#[test]
fn a_rounded_isometric_projection_is_isometric() {
    for decimals in 3..10 {
        let round = |x: f64| format!("{x:.decimals$}").parse::<f64>().expect("a number");
        let [side, down, up] = [0.5_f64, 1.0 / 6.0, 2.0 / 3.0].map(|square| round(square.sqrt()));
        let columns = [[side, -down], [0.0, up], [-side, -down]];
        let [x, y, z] = columns.map(|[x, y]| DVec4::new(x, y, 0.0, 0.0));
        let found = recognize(rows_of(DMat4::from_cols(x, y, z, DVec4::W))).first().meaning;
        let MatrixMeaning::AxonometricOntoPlane { projection } = found else {
            panic!("{decimals}: {found:?}")
        };
        assert_eq!(projection.kind(), AxonometricKind::Isometric, "{decimals}");
    }
}

/// (x, y, z) with w = z/d, for d of either sign, also multiplied by a factor (Foley, van Dam and
/// others 1990, equation 6.5). With d < 0, it is the slides' projection onto the plane z = d.
#[test]
fn the_perspective_from_the_origin_onto_a_plane_is_recognized() {
    for (plane, multiple) in [(2.0, 1.0), (-2.0, 1.0), (0.5, 1.0), (-3.0, -3.0), (4.0, 4.0)] {
        let rows = DMat4::from_cols(
            DVec4::X,
            DVec4::Y,
            DVec4::new(0.0, 0.0, 1.0, 1.0 / plane),
            DVec4::ZERO,
        );
        let found = recognize(rows_of(rows * multiple));
        let expected = MatrixMeaning::CentralOntoPlane { plane_z: plane, onto_plane: false };
        assert_eq!((found.first().meaning, found.first().factor), (expected, multiple));
        assert_eq!(found.misprint(), None, "{plane}");
    }
    // One third, rounded to four decimals.
    let rounded = DVec4::new(0.0, 0.0, 1.0, 0.3333);
    let found = recognize(rows_of(DMat4::from_cols(DVec4::X, DVec4::Y, rounded, DVec4::ZERO)));
    let expected = MatrixMeaning::CentralOntoPlane { plane_z: 3.0, onto_plane: false };
    assert_eq!(found.first().meaning, expected);
}

/// Computer vision textbooks print this form, which discards depth.
#[test]
fn the_perspective_onto_a_plane_may_drop_z() {
    let rows = DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::W, DVec4::ZERO);
    let expected = MatrixMeaning::CentralOntoPlane { plane_z: 1.0, onto_plane: true };
    assert_eq!(recognize(rows_of(rows)).first().meaning, expected);
}

proptest::proptest! {
    #![proptest_config(samples::cases(512))]

    /// Every matrix has a reading, at least as an unnamed map, and recognition never panics.
    #[test]
    fn any_matrix_has_a_reading(entries in proptest::array::uniform16(any_entry())) {
        let found = recognize(rows_of(DMat4::from_cols_array(&entries)));
        proptest::prop_assert!(!found.readings.is_empty());
    }
}

fn any_entry() -> impl proptest::strategy::Strategy<Value = f64> {
    proptest::prop_oneof![
        4 => -10.0..10.0,
        1 => proptest::num::f64::ANY,
        2 => proptest::sample::select(vec![0.0, -0.0, 1.0, -1.0, f64::MAX, 5e-324]),
    ]
}

fn rows_of(matrix: DMat4) -> [[f64; 4]; 4] {
    matrix.transpose().to_cols_array_2d()
}
