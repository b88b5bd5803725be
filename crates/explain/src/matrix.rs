//! Explains a matrix: its kind, its inverse, its meaning with parameters, and known misprints that
//! it resembles.
//!
//! Sixteen numbers can represent several projections, each in a different convention: OpenGL's and
//! the textbook's differ by the sign of z. The most likely reading comes first with all its
//! parameters; others follow, one per line. A misprint is reported only if the corrected matrix is
//! more plausible; if both are equally plausible, both are listed.

mod meaning;
mod planar;

pub use planar::explain_planar_matrix;

use super::plain_text::format_number;
use super::{Explanation, Step};
use glam::DMat4;
use homog::{Clip, HPointKind, Projective, View};
use meaning::{describe_meaning, meaning_steps};
use recognition::{
    MatrixMeaning, MatrixReading, Misprint, Recognition, Suspicion, SuspicionStrength, recognize,
};

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
    steps.extend((0..).zip(&found.suspicions).map(|(at, slip)| misprint_step(at, rows, slip)));
    let verdict = matrix_verdict(map, &found);
    Ok(Explanation { subject: "A matrix for column vectors".to_owned(), steps, verdict })
}

/// Returns the reading of the corrected matrix, with its title, if it is clearly more likely and
/// the matrix as given has no meaning worth reporting.
fn corrected_reading(found: &Recognition) -> Option<(MatrixReading, &'static str)> {
    let slip = found.misprint()?;
    let title = match slip.misprint {
        Misprint::Transposed => {
            "Most likely reading, transposed: the matrix is for row vectors, or stored by columns"
        }
        Misprint::LastRowNegated => "Most likely reading, with the last row negated",
        Misprint::WrongSign => "Most likely reading, with one sign flipped",
        _ => return None,
    };
    Some((recognize(slip.remedied?).first(), title))
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
    if matches!(misprint, Some(Misprint::LastRowNegated | Misprint::WrongSign)) {
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

/// Describes a position in a matrix, counted from 1.
fn place_words(row: usize, column: usize) -> String {
    format!("row {}, column {}", row + 1, column + 1)
}

/// Describes the entry with the wrong sign.
fn entry_words(rows: [[f64; 4]; 4], found: &Recognition) -> String {
    let changed = found.misprint().and_then(|slip| changed_entry(rows, slip));
    changed.map_or("one entry".to_owned(), |[row, column]| place_words(row, column))
}

/// Returns the first entry that the remedy changes, as row and column counted from 0.
fn changed_entry(rows: [[f64; 4]; 4], slip: &Suspicion) -> Option<[usize; 2]> {
    let remedied = slip.remedied?;
    let at = (0..16).find(|at| rows[at / 4][at % 4] != remedied[at / 4][at % 4])?;
    Some([at / 4, at % 4])
}

/// Returns the step with a known misprint, its correction, and the meaning of the corrected matrix.
///
/// The corrected matrix is shown only if the sixteen entries determine it. The first misprint has
/// the id `misprint`; later ones have `other_misprint`.
fn misprint_step(at: usize, rows: [[f64; 4]; 4], slip: &Suspicion) -> Step {
    let known = slip.misprint.id().unwrap_or("unnumbered");
    let title = match (slip.misprint, slip.strength) {
        (Misprint::Transposed, SuspicionStrength::Likely) => {
            "It looks like a matrix for row vectors, or one stored by columns".to_owned()
        }
        (Misprint::Transposed, SuspicionStrength::Equal) => {
            "It may also be a matrix for row vectors: the numbers are the same".to_owned()
        }
        (_, SuspicionStrength::Likely) if slip.misprint.id().is_none() => {
            "It looks like a sign error".to_owned()
        }
        (_, SuspicionStrength::Likely) => format!("It looks like a known misprint ({known})"),
        (_, SuspicionStrength::Equal) => {
            format!("It may also be a known misprint ({known}): the numbers are the same")
        }
    };
    let step = Step::new(if at == 0 { "misprint" } else { "other_misprint" }, title, None)
        .with_item("finding", "finding", slip.misprint.description())
        .with_item("remedy", "remedy", slip.misprint.remedy());
    let step = match (slip.misprint, changed_entry(rows, slip)) {
        (Misprint::WrongSign, Some([row, column])) => {
            step.with_item("entry", "entry", place_words(row, column))
        }
        _ => step,
    };
    // If the report is on the corrected matrix, it already has its reading.
    let corrected = [Misprint::Transposed, Misprint::LastRowNegated, Misprint::WrongSign];
    let likely = slip.strength == SuspicionStrength::Likely;
    let is_read = at == 0 && likely && corrected.contains(&slip.misprint);
    match slip.remedied {
        Some(remedied) if is_read => step.with_item("remedied", "then", remedied),
        Some(remedied) => step.with_item("remedied", "then", remedied).with_item(
            "remedied_reading",
            "meaning",
            describe_meaning(&recognize(remedied).first()),
        ),
        None => step,
    }
}

/// States the result in a sentence: the first reading, and the misprint if it is more plausible.
fn matrix_verdict(map: Projective<View, Clip>, found: &Recognition) -> String {
    let first = found.first();
    let misprint = found.misprint().map(|slip| slip.misprint);
    let what = if first.meaning.is_named() {
        format!("It is {}.", describe_meaning(&first))
    } else {
        format!("It is {}, but not a named transform or projection.", map.classify())
    };
    let turned = |slip: &Suspicion| {
        let transposed = slip.remedied.map(|matrix| recognize(matrix).first());
        transposed.map_or(String::new(), |reading| describe_meaning(&reading))
    };
    let corrected = corrected_reading(found);
    if let Some((reading, _)) =
        corrected.filter(|_| !matches!(misprint, Some(Misprint::Transposed)))
    {
        let corrected = describe_meaning(&reading);
        let slip = match misprint {
            Some(Misprint::LastRowNegated) => "its last row negated".to_owned(),
            _ => format!("the sign of {} flipped", entry_words(map.rows(), found)),
        };
        return format!("It looks like a misprint. With {slip}, it is {corrected}.");
    }
    if let Some((reading, _)) = corrected {
        let turned = describe_meaning(&reading);
        let stands = what.replacen("It is", "As given, for column vectors, it is", 1);
        return format!(
            "Transposed, it is {turned}. The matrix is for row vectors, or stored by columns. {stands}"
        );
    }
    if let Some(slip) = found.misprint() {
        return format!(
            "{what} But it looks like a misprint in which {}.",
            slip.misprint.description()
        );
    }
    match found.suspicions.first() {
        Some(slip) if slip.misprint == Misprint::Transposed => {
            format!("{what} For row vectors, the same numbers are {}.", turned(slip))
        }
        Some(slip) => {
            let id = slip.misprint.id().map_or(String::new(), |id| format!(" ({id})"));
            format!(
                "{what} A known misprint{id} has the same numbers; in it, {}.",
                slip.misprint.description()
            )
        }
        None => what,
    }
}
