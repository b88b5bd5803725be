//! Explains a 3×3 matrix: a map of the plane, camera intrinsics or a rotation of space.

use super::super::plain_text::format_number;
use super::super::{Explanation, ItemValue, Step};
use super::check_finite;
use super::meaning::describe_meaning;
use homog::{HPoint2, Homography};
use recognition::{MatrixMeaning, MatrixReading, PlanarMatrix, PlanarReading, recognize_planar};

/// The maximum number of readings listed after the first.
const OTHER_READINGS: usize = 3;

/// Explains a 3×3 matrix for column vectors (x, y, w).
///
/// # Errors
/// Returns an error if an entry is not a finite number.
pub fn explain_planar_matrix(rows: [[f64; 3]; 3]) -> Result<Explanation, String> {
    check_finite(&rows)?;
    let map = Homography::from_rows(rows);
    let (readings, transposed) = recognize_planar(rows);
    let kind = Step::new("kind", "Kind of map", Some("HO-3"))
        .with_item("matrix", "matrix", ItemValue::PlanarMatrix(rows))
        .with_item("determinant", "determinant", map.determinant());
    let inverse = Step::new("inverse", "Inverse", None);
    let inverse = match map.inverse() {
        Some(found) => {
            inverse.with_item("inverse", "inverse", ItemValue::PlanarMatrix(found.rows()))
        }
        None => inverse.with_item("none", "none", "a dimension is lost: there is no inverse"),
    };
    let first = |readings: &[PlanarReading], rows: &[[f64; 3]; 3]| {
        readings.first().map_or(String::new(), |first| describe_planar(first, rows))
    };
    let stands = first(&readings, &rows);
    let mut steps = vec![kind, inverse, points_step(map), readings_step(&readings, &rows)];
    let mut verdict = format!("It is {stands}.");
    if transposed {
        let turned = [0, 1, 2].map(|i| [0, 1, 2].map(|j| rows[j][i]));
        let meant = first(&recognize_planar(turned).0, &turned);
        verdict = format!(
            "Transposed, it is {meant}. The matrix is for row vectors, or stored by columns. As given, \
             for column vectors, it is {stands}."
        );
        let step = Step::new("misprint", "It looks like a matrix for row vectors", None).with_item(
            "remedied",
            "then",
            ItemValue::PlanarMatrix(turned),
        );
        steps.push(step.with_item("remedied_reading", "meaning", meant));
    }
    Ok(Explanation { subject: "A 3 × 3 matrix for column vectors".to_owned(), steps, verdict })
}

/// Returns the step with the images of the unit square's corners.
fn points_step(map: Homography) -> Step {
    let image = |x: f64, y: f64| match map.transform_point(HPoint2::from_xy(x, y)).divide() {
        Some([x, y]) => format!("({}, {})", format_number(x), format_number(y)),
        None => "infinity".to_owned(),
    };
    let step = Step::new("points", "Images of the unit square's corners", Some("HO-3"));
    [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].into_iter().fold(step, |step, (x, y)| {
        let name = format!("({x}, {y})");
        step.with_item(format!("corner_{x}_{y}"), name, image(x, y))
    })
}

fn readings_step(readings: &[PlanarReading], rows: &[[f64; 3]; 3]) -> Step {
    let step = Step::new("readings", "Possible readings, most likely first", None);
    (0..).zip(readings.iter().take(1 + OTHER_READINGS)).fold(step, |step, (at, reading)| {
        let at: usize = at;
        step.with_item(at.to_string(), (at + 1).to_string(), describe_planar(reading, rows))
    })
}

fn describe_planar(reading: &PlanarReading, rows: &[[f64; 3]; 3]) -> String {
    match reading.meaning {
        PlanarMatrix::Plane(MatrixMeaning::Camera(camera)) => {
            let angle = libm::atan2(-camera.right[1], camera.right[0]).to_degrees();
            let [x, y] = [rows[0][2], rows[1][2]].map(|offset| offset / reading.factor);
            let [angle, x, y] = [angle, x, y].map(format_number);
            format!("a rotation by {angle}°, then a translation by ({x}, {y})")
        }
        PlanarMatrix::Plane(meaning) => {
            let of_space = MatrixReading { meaning, factor: reading.factor, cost: reading.cost };
            format!("{} (of the plane; z unchanged)", describe_meaning(&of_space))
        }
        PlanarMatrix::Intrinsics(k) => {
            let [fx, fy, cx, cy, skew] = [k.fx, k.fy, k.cx, k.cy, k.skew].map(format_number);
            format!("camera intrinsics K: fx {fx}, fy {fy}, cx {cx}, cy {cy}, skew {skew}")
        }
        PlanarMatrix::SpatialRotation { axis, angle_degrees } => {
            let [x, y, z] = axis.map(format_number);
            format!(
                "a rotation of space by {}° about ({x}, {y}, {z})",
                format_number(angle_degrees)
            )
        }
        PlanarMatrix::Homography => {
            "a projective map of the plane; its multiples are the same map".to_owned()
        }
        PlanarMatrix::Singular => "a map onto a line or a point".to_owned(),
    }
}
