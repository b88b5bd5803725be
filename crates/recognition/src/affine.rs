//! Readings of affine matrices as maps of space: translations, scales, windowing, shears, and model
//! transforms composed of translation, rotation and scale.

use super::matrix_reading::factor_cost;
use super::rigid::{axis_angle, is_square_frame, largest_error};
use super::rounded::{Entries, Rounded, divide_entries};
use super::{MatrixMeaning, MatrixReading};
use alloc::vec::Vec;
use glam::{DMat3, DVec3};

/// Adds every reading of a matrix with the bottom row (0, 0, 0, s).
pub(crate) fn read_affine(m: &Entries<4>, found: &mut Vec<MatrixReading>) {
    let factor = m[3][3];
    if factor.is_zero() || ![m[3][0], m[3][1], m[3][2]].into_iter().all(Rounded::is_zero) {
        return;
    }
    let unit = divide_entries(m, factor);
    let mut push = |meaning: MatrixMeaning, cost: u32| {
        let factor_digits = factor_cost(factor);
        found.push(MatrixReading {
            meaning,
            factor: factor.simplest(),
            cost: cost + factor_digits,
        });
    };
    let off_diagonal = [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)];
    let slanted = off_diagonal.into_iter().filter(|&(i, j)| !unit[i][j].is_zero()).count();
    let diagonal = [unit[0][0], unit[1][1], unit[2][2]];
    let offset = [unit[0][3], unit[1][3], unit[2][3]];
    if diagonal.into_iter().any(Rounded::is_zero) && slanted == 0 {
        return;
    }
    if slanted == 0 {
        read_diagonal(diagonal, offset, &mut push);
    } else if diagonal.into_iter().all(|entry| entry.is(1.0)) && slanted <= 2 {
        let entries = off_diagonal.map(|(i, j)| unit[i][j]);
        // A matrix that adds both x and y to z is usually an oblique projection for row vectors.
        let rare = if unit[2][0].is_zero() || unit[2][1].is_zero() { 0 } else { 4 };
        let cost = 4 + rare + 2 * (total_digits(&entries) + total_digits(&offset));
        let linear = [0, 1, 2].map(|i| [0, 1, 2].map(|j| unit[i][j].simplest()));
        push(MatrixMeaning::Shear { linear, offset: offset.map(Rounded::simplest) }, cost);
    }
    if slanted > 0 {
        read_model_transform(&unit, &mut push);
    }
}

fn total_digits(numbers: &[Rounded]) -> u32 {
    numbers.iter().map(|number| number.digits()).sum()
}

fn read_diagonal(
    scale: [Rounded; 3],
    offset: [Rounded; 3],
    push: &mut impl FnMut(MatrixMeaning, u32),
) {
    let stays = offset.into_iter().all(Rounded::is_zero);
    let mirrored = scale.into_iter().filter(|factor| factor.value < 0.0).count() as u32;
    if scale.into_iter().all(|factor| factor.is(1.0)) {
        let by = offset.map(Rounded::simplest);
        let meaning =
            if stays { MatrixMeaning::Identity } else { MatrixMeaning::Translation { by } };
        push(meaning, 2 * total_digits(&offset));
        return;
    }
    if stays {
        let uniform = scale[0].equals(scale[1]) && scale[1].equals(scale[2]);
        let digits = if uniform { scale[0].digits() } else { total_digits(&scale) };
        let factors = scale.map(Rounded::simplest);
        push(MatrixMeaning::Scale { factors }, 1 + 2 * digits + 2 * mirrored);
        return;
    }
    // A number shared by several axes counts once.
    let different = |numbers: &[Rounded; 3]| -> u32 {
        let repeated = |at: usize| numbers[..at].iter().any(|earlier| earlier.equals(numbers[at]));
        let new = (0..3).filter(|&at| !repeated(at) && !numbers[at].is(1.0));
        new.map(|at| numbers[at].digits()).sum()
    };
    let digits = different(&scale) + different(&offset);
    // A view volume would also map z.
    let planar = scale[2].is(1.0) && offset[2].is_zero();
    let base = match (planar, scale[0].value < 0.0) {
        (true, _) => 4,
        (false, false) => 12,
        (false, true) => 18,
    };
    let (scale, offset) = (scale.map(Rounded::simplest), offset.map(Rounded::simplest));
    push(MatrixMeaning::Windowing { scale, offset }, base + 2 * digits + mirrored);
}

/// Adds the reading as a translation, rotation and scale of the axes, if the columns are
/// perpendicular and not all of length 1.
fn read_model_transform(unit: &Entries<4>, push: &mut impl FnMut(MatrixMeaning, u32)) {
    let columns = [0, 1, 2].map(|j| [0, 1, 2].map(|i| unit[i][j]));
    let lengths = columns.map(|[x, y, z]| (x * x + y * y + z * z).sqrt());
    if lengths.into_iter().any(Rounded::is_zero) {
        return;
    }
    let axes = [0, 1, 2].map(|j| columns[j].map(|entry| entry / lengths[j]));
    let unscaled = lengths.into_iter().all(|length| length.is(1.0) || is_nearly_one(length));
    if unscaled || !is_square_frame(&axes) {
        return;
    }
    let mut vectors = axes.map(|axis| DVec3::from_array(axis.map(|entry| entry.value)));
    let mut scale = lengths.map(Rounded::simplest);
    if DMat3::from_cols_array_2d(&vectors.map(|v| v.to_array())).determinant() < 0.0 {
        (vectors[2], scale[2]) = (-vectors[2], -scale[2]);
    }
    let rotation = DMat3::from_cols(vectors[0], vectors[1], vectors[2]);
    let (axis, angle_degrees) = axis_angle(rotation, largest_error(&axes));
    let offset = [unit[0][3], unit[1][3], unit[2][3]];
    let uniform = lengths[0].equals(lengths[1]) && lengths[1].equals(lengths[2]);
    let digits = if uniform { lengths[0].digits() } else { total_digits(&lengths) };
    let meaning = MatrixMeaning::ModelTransform {
        translation: offset.map(Rounded::simplest),
        axis,
        angle_degrees,
        scale,
    };
    push(meaning, 10 + 2 * (digits + total_digits(&offset)));
}

/// Returns whether a length may be 1, given the rounding of three entries.
fn is_nearly_one(length: Rounded) -> bool {
    length.is_within(1.0, length.error + 1e-12)
}
