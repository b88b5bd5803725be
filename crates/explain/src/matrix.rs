//! Explains a matrix: its kind, its inverse, its meaning with parameters, and known misprints that
//! it resembles.
//!
//! Sixteen numbers can represent several projections, each in a different convention: OpenGL's and
//! the textbook's differ by the sign of z. The most likely reading comes first with all its
//! parameters; others follow, one per line. A misprint is reported only if the corrected matrix is
//! more plausible; if both are equally plausible, both are listed.

mod meaning;
mod planar;
mod slip;

pub use planar::explain_planar_matrix;

use super::plain_text::format_number;
use super::{Explanation, Step};
use glam::DMat4;
use homog::{Clip, HPointKind, Projective, View};
use meaning::{describe_meaning, meaning_steps};
use recognition::{MatrixMeaning, MatrixReading, Misprint, Recognition, recognize};
use slip::{corrected_reading, matrix_verdict, misprint_steps};

/// The maximum number of readings listed after the first.
const OTHER_READINGS: usize = 5;

/// The maximum extra cost of a listed reading: the cost of four digits and a rare convention.
const LESS_LIKELY: u32 = 10;

/// Explains a 4×4 matrix for column vectors.
///
/// The transposed matrix (for row vectors, or stored by columns and read by rows) is reported only
/// if its reading is more likely. The report then shows the corrected matrix.
///
/// # Errors
/// Returns an error if an entry is not a finite number.
pub fn explain_matrix(rows: [[f64; 4]; 4]) -> Result<Explanation, String> {
    check_finite(&rows)?;
    let map = Projective::<View, Clip>::from_rows(rows);
    let found = recognize(map.rows());
    let mut steps = vec![kind_step(rows, map), inverse_step(map)];
    steps.extend(affine_step(map, &found.first().meaning));
    steps.push(vanishing_points_step(map));
    steps.extend(match corrected_reading(&found) {
        Some((corrected, title)) => {
            meaning_steps(&corrected).map(|step| Step { title: title.to_owned(), ..step })
        }
        None => meaning_steps(&found.first()),
    });
    steps.extend(other_readings_step(&found));
    steps.extend(misprint_steps(rows, &found));
    let verdict = matrix_verdict(map, &found);
    Ok(Explanation { subject: "A matrix for column vectors".to_owned(), steps, verdict })
}

/// Returns an error that names the row and column, from 1, of the first entry that is not finite.
fn check_finite<const N: usize>(rows: &[[f64; N]; N]) -> Result<(), String> {
    match rows.as_flattened().iter().position(|entry| !entry.is_finite()) {
        Some(at) => {
            let (row, column) = (at / N + 1, at % N + 1);
            Err(format!("the entry in row {row}, column {column} is not a finite number"))
        }
        None => Ok(()),
    }
}

/// Returns the step with the inverse matrix, or with the reason if the matrix is singular.
fn inverse_step(map: Projective<View, Clip>) -> Step {
    let step = Step::new("inverse", "Inverse", Some("IV-1"));
    match map.inverse() {
        Some(inverse) => {
            step.with_item("inverse", "inverse", without_rounding(map.raw(), inverse.raw()))
        }
        None => step.with_item("none", "none", "a dimension is lost: the matrix has no inverse"),
    }
}

/// Returns the rows of an inverse, with 0 for rounding noise. An entry is noise if it is below the
/// error bound of Gaussian elimination, ε |M⁻¹| |M| |M⁻¹| by entries (Higham 2002, chapter 14). It
/// is also noise if M M⁻¹ and M⁻¹ M are the identity without it.
#[must_use]
pub fn without_rounding(matrix: DMat4, inverse: DMat4) -> [[f64; 4]; 4] {
    let size = |m: DMat4| DMat4::from_cols_array(&m.to_cols_array().map(f64::abs));
    let bound = size(inverse) * size(matrix) * size(inverse) * (4.0 * f64::EPSILON);
    let (entries, errors) = (inverse.to_cols_array(), bound.to_cols_array());
    let clean = |at: usize| {
        let (row, column) = (at % 4, at / 4);
        let reach = matrix.col(row).abs().max_element().max(matrix.row(column).abs().max_element());
        let is_noise =
            entries[at].abs() <= errors[at] || entries[at].abs() * reach <= 4.0 * f64::EPSILON;
        if is_noise { 0.0 } else { entries[at] }
    };
    std::array::from_fn(|row| std::array::from_fn(|column| clean(4 * column + row)))
}

/// Returns the step with the kind of map, affine or projective, and its rank and determinant.
///
/// A rank below 4 means that a dimension is lost, as in a projection onto a plane. A negative
/// determinant means that orientation is reversed, as by a change of handedness.
fn kind_step(rows: [[f64; 4]; 4], map: Projective<View, Clip>) -> Step {
    let found = map.classify();
    Step::new("kind", "Kind of map", Some("HO-3"))
        .with_item("matrix", "matrix", rows)
        .with_item("kind", "kind", found.to_string())
        .with_item("rank", "rank", found.rank as f64)
        .with_item("determinant", "determinant", map.raw().determinant())
}

/// Returns the parts of an affine map: translation, scale of each axis, shear and handedness.
///
/// Returns `None` unless the last row is a multiple of (0, 0, 0, 1). With the columns a₁, a₂, a₃ of
/// the upper left 3 × 3:
///
/// ```text
///  scales      |a₁|, |a₂|, |a₃|
///  shear       |aᵢ · aⱼ| > 1e-9 |aᵢ| |aⱼ| for some pair
///  handedness  sign of (a₁ × a₂) · a₃
/// ```
/// The tolerance is relative to the lengths, so that scales of 1e-6 do not hide a shear.
fn affine_step(map: Projective<View, Clip>, meaning: &MatrixMeaning) -> Option<Step> {
    let matrix = map.to_affine()?.raw();
    let axes = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(glam::DVec4::truncate);
    let lengths = axes.map(glam::DVec3::length);
    let slant = |a: usize, b: usize| axes[a].dot(axes[b]).abs() > 1e-9 * lengths[a] * lengths[b];
    let rigid = is_rigid(meaning) || matches!(meaning, MatrixMeaning::Rotation { .. });
    let slanted = slant(0, 1) || slant(1, 2) || slant(2, 0);
    let angles = if slanted && rigid {
        "the axes stay at right angles except for rounding: a rotation"
    } else if slanted {
        "the axes do not stay at right angles: there is a shear"
    } else {
        "the axes stay at right angles: a rotation and scaling"
    };
    let determinant = axes[0].cross(axes[1]).dot(axes[2]);
    let handedness = match determinant {
        turn if turn > 0.0 => "kept",
        turn if turn < 0.0 => "reversed, as in a mirror",
        _ => "lost: the image is flat",
    };
    let step = Step::new("affine", "Parts of the map", Some("HO-4, HO-5"))
        .with_item("translation", "translation", matrix.w_axis.truncate().to_array())
        .with_item("scales", "lengths of the axes", lengths)
        .with_item("angles", "angles", angles)
        .with_item("handedness", "handedness", handedness);
    Some(step)
}

/// Whether a map is a rotation with a translation: a camera, its pose or a model transform.
fn is_rigid(meaning: &MatrixMeaning) -> bool {
    matches!(
        meaning,
        MatrixMeaning::Camera(_)
            | MatrixMeaning::CameraPose(_)
            | MatrixMeaning::ModelTransform { scale: [1.0, 1.0, 1.0], .. }
    )
}

/// Returns the step with the vanishing points of the three axes.
///
/// The vanishing point of a direction d is M (d, 0): for an axis, a column of the matrix. Columns
/// with w ≠ 0 give one-, two- and three-point perspective (VN-1). w has a relative tolerance of
/// 1e-12.
fn vanishing_points_step(map: Projective<View, Clip>) -> Step {
    let points = map.principal_vanishing_points(1e-12);
    let words = |meaning: HPointKind<Clip>| match meaning {
        HPointKind::Finite(point) => {
            let [x, y, z] = <[f64; 3]>::from(point).map(format_number);
            format!("vanishes at ({x}, {y}, {z})")
        }
        HPointKind::AtInfinity(_) => "stays parallel".to_owned(),
        HPointKind::Invalid => "has no image".to_owned(),
    };
    let step = Step::new("vanishing_points", "Vanishing points of the axes", Some("VN-1"));
    ["x", "y", "z"]
        .into_iter()
        .zip(points)
        .fold(step, |step, (axis, point)| step.with_item(axis, axis, words(point)))
}

/// Returns the step with the readings after the first, beginning with the equally likely ones.
fn other_readings_step(found: &Recognition) -> Option<Step> {
    let misprint = found.misprint().map(|slip| slip.misprint);
    if misprint.is_some_and(Misprint::takes_one_step) {
        return None;
    }
    let turned = misprint == Some(Misprint::Transposed);
    let equal = if turned { 0 } else { found.equal_readings().count() };
    let most = found.first().cost + LESS_LIKELY;
    // Programs use any rigid matrix as a camera, a camera pose or a model transform.
    let rigid = is_rigid(&found.first().meaning);
    let told = |reading: &&MatrixReading| {
        let likely = reading.cost <= most || (rigid && is_rigid(&reading.meaning));
        reading.meaning.is_named() && likely
    };
    let first_stands = usize::from(!turned);
    let named = found.readings.iter().skip(first_stands).filter(told);
    let others: Vec<_> = named.take(OTHER_READINGS).collect();
    if others.is_empty() {
        return None;
    }
    let step = Step::new("readings", "Other readings", None);
    Some((0..).zip(others).fold(step, |step, (at, reading): (usize, _)| {
        let name = match at < equal {
            true => "equally likely",
            false if turned => "less likely, as given",
            false => "less likely",
        };
        step.with_item(at.to_string(), name, describe_meaning(reading))
    }))
}
