//! Suspicions: known misprints that explain a matrix about as well as its best reading.
//!
//! Each test undoes one misprint and reads the result. A misprint is assumed only if that reading
//! needs clearly fewer digits, or if the original matrix has no meaningful reading. These rules are
//! strict because every misprinted matrix is also the correct matrix of something less likely.

use super::matrix_reading::{is_moderate, readings_of, transpose};
use super::one_step::one_step_remedies;
use super::rounded::{Entries, Rounded};
use super::{MatrixMeaning, MatrixReading};
use crate::Misprint;
use alloc::vec::Vec;
use projection::{Convention, Frustum};

/// The saving in cost required to assume a misprint.
pub(crate) const SLIP: u32 = 6;
/// The minimum saving in cost at which a misprint counts as likely.
const MARGIN: u32 = 4;
/// The maximum extra cost, compared with the best reading, at which a misprint is still reported.
const TOLD: u32 = 4;

/// The confidence in a suspicion.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum SuspicionStrength {
    /// The original matrix has no meaningful reading, or is clearly less likely than the corrected
    /// one.
    Likely,
    /// The same numbers are also a correct matrix with a different meaning, which is equally
    /// likely.
    Equal,
}

/// A known misprint that a matrix may contain.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct Suspicion {
    /// The misprint.
    pub misprint: Misprint,
    /// The confidence in the suspicion.
    pub strength: SuspicionStrength,
    /// The rows of the matrix that was probably intended, or `None` if the missing numbers cannot
    /// be recovered.
    pub remedied: Option<[[f64; 4]; 4]>,
}

/// A misprint with its corrected matrix and the cost of the best reading of that matrix.
pub(crate) struct Remedy {
    pub(crate) misprint: Misprint,
    pub(crate) cost: u32,
    pub(crate) remedied: Option<[[f64; 4]; 4]>,
}

/// Returns the possible misprints in a matrix with the given readings, in descending order of
/// certainty.
pub(crate) fn suspicions_of(m: &Entries<4>, readings: &[MatrixReading]) -> Vec<Suspicion> {
    if !m.as_flattened().iter().all(|entry| is_moderate(entry.value)) {
        return Vec::new();
    }
    let Some(best) = readings.first() else { return Vec::new() };
    let tests: [fn(&Entries<4>, &MatrixReading) -> Option<Remedy>; 9] = [
        undo_transposition,
        undo_flat_third_row,
        undo_bottom_row_one,
        undo_ortho_offset_sign,
        undo_half_of_tangent,
        undo_degrees,
        tell_moved_apex,
        tell_frustum_offset_one,
        tell_repeated_translation,
    ];
    let mut remedies: Vec<Remedy> = tests.into_iter().filter_map(|test| test(m, best)).collect();
    remedies.extend(one_step_remedies(m, best));
    remedies.sort_by_key(|remedy| remedy.cost);
    let least = remedies.first().map_or(best.cost, |first| first.cost.min(best.cost));
    remedies.retain(|remedy| remedy.cost <= least + TOLD);
    remove_repetitions(&mut remedies);
    // A likely misprint makes the others that are as likely as it likely, too. Most matrices have a
    // misprint of one step that is less likely.
    let is_likely = least + MARGIN <= best.cost;
    remedies.retain(|remedy| is_likely || !remedy.misprint.takes_one_step());
    let suspicion = |remedy: Remedy| Suspicion {
        misprint: remedy.misprint,
        strength: if is_likely { SuspicionStrength::Likely } else { SuspicionStrength::Equal },
        remedied: remedy.remedied,
    };
    remedies.into_iter().map(suspicion).collect()
}

/// Keeps the most likely of the misprints with the same remedy.
fn remove_repetitions(remedies: &mut Vec<Remedy>) {
    let mut known: Vec<[[f64; 4]; 4]> = Vec::new();
    remedies.retain(|remedy| match remedy.remedied {
        Some(rows) if known.contains(&rows) => false,
        Some(rows) => {
            known.push(rows);
            true
        }
        None => true,
    });
}

pub(crate) fn matrix_of(m: &Entries<4>) -> [[f64; 4]; 4] {
    m.map(|row| row.map(|entry| entry.value))
}

/// Returns the remedy, with the cost of the best reading whose meaning is `wanted`.
fn remedy(
    misprint: Misprint,
    remedied: &Entries<4>,
    wanted: fn(&MatrixMeaning) -> bool,
) -> Option<Remedy> {
    let readings = readings_of(remedied);
    let named = readings.iter().find(|reading| wanted(&reading.meaning))?;
    Some(Remedy { misprint, cost: named.cost + SLIP, remedied: Some(matrix_of(remedied)) })
}

fn is_central(meaning: &MatrixMeaning) -> bool {
    matches!(meaning, MatrixMeaning::Perspective { .. } | MatrixMeaning::ApexMoved { .. })
}

/// Undoes swapped rows and columns (24): the matrix is for row vectors, or stored by columns.
fn undo_transposition(m: &Entries<4>, best: &MatrixReading) -> Option<Remedy> {
    let transposed = transpose(m);
    let symmetric = (0..4).all(|i| (0..4).all(|j| m[i][j].equals(m[j][i])));
    // A bottom row with vanishing points outside the unit cube is not a row-vector translation.
    let distant = matches!(best.meaning, MatrixMeaning::NPoint { .. })
        && m[3][..3].iter().all(|term| term.value.abs() < 1.0);
    if symmetric || distant {
        return None;
    }
    remedy(Misprint::Transposed, &transposed, MatrixMeaning::is_named)
}

/// Undoes M11: the third column of a rigid motion is zero. It is restored as the cross product of
/// the first two.
fn undo_flat_third_row(m: &Entries<4>, _: &MatrixReading) -> Option<Remedy> {
    let column = (0..3).all(|i| m[i][2].is_zero());
    if !column || m[2][3].is_zero() || !m[3][3].is(1.0) || !m[3][..3].iter().all(|x| x.is_zero()) {
        return None;
    }
    let (a, b) = ([m[0][0], m[1][0], m[2][0]], [m[0][1], m[1][1], m[2][1]]);
    let cross = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    let mut remedied = *m;
    for (row, entry) in [cross(1, 2), cross(2, 0), cross(0, 1)].into_iter().enumerate() {
        remedied[row][2] = if entry.is(1.0) { Rounded::ONE } else { entry };
    }
    let rigid = |meaning: &MatrixMeaning| {
        matches!(meaning, MatrixMeaning::Translation { .. } | MatrixMeaning::Camera(_))
    };
    remedy(Misprint::ThirdRowFlat, &remedied, rigid)
}

/// Undoes M14: the bottom row is (0, 0, −1, 1), below the depth row of a frustum (Eq7), or below
/// the identity or a scale of x and y (Eq4, Eq5). Programs that start with the identity leave the
/// same 1 in a projection that looks along +z: (0, 0, 1, 1).
fn undo_bottom_row_one(m: &Entries<4>, _: &MatrixReading) -> Option<Remedy> {
    let [x, y, z, w] = m;
    let opposite = !w[3].is_zero() && (w[2] + w[3]).is_zero();
    let remains = w[3].is(1.0) && !w[2].is_zero();
    if !(opposite || remains) || !w[0].is_zero() || !w[1].is_zero() {
        return None;
    }
    let mut remedied = *m;
    remedied[3][3] = Rounded::exact(0.0);
    let zeros = [x[1], x[2], x[3], y[0], y[2], y[3], z[0], z[1], z[3]];
    let bare = opposite
        && zeros.into_iter().all(Rounded::is_zero)
        && x[0].equals(y[1])
        && !x[0].is_zero()
        && z[2].equals(w[3]);
    if bare {
        let scale = x[0] / w[3];
        let cost = SLIP + if scale.is(1.0) { 0 } else { 2 * scale.digits() };
        let remedied = Some(matrix_of(&remedied));
        return Some(Remedy { misprint: Misprint::BottomRowOne, cost, remedied });
    }
    remedy(Misprint::BottomRowOne, &remedied, is_central)
}

/// Undoes M15: with the sign of the depth offset flipped, the matrix is a box in front of the eye.
fn undo_ortho_offset_sign(m: &Entries<4>, _: &MatrixReading) -> Option<Remedy> {
    let mut remedied = *m;
    remedied[2][3] = -m[2][3];
    let ahead = |meaning: &MatrixMeaning| match meaning {
        MatrixMeaning::Orthographic { volume, convention } => {
            let ordered = 0.0 < volume.near() && volume.near() < volume.far();
            *convention == Convention::OPENGL && ordered && volume.window().width() > 0.0
        }
        _ => false,
    };
    if m[2][3].is_zero() {
        return None;
    }
    // Every such box is also a Direct3D box with reversed depth and a different far plane.
    let found = remedy(Misprint::OrthoOffsetSign, &remedied, ahead)?;
    Some(Remedy { cost: found.cost + 2, ..found })
}

/// Returns the scales of x and y if the matrix is a centered perspective projection with w = ±z.
fn centered_scales(m: &Entries<4>) -> Option<[Rounded; 2]> {
    let central = !m[3][2].is_zero() && m[3][3].is_zero();
    let centered = m[0][2].is_zero() && m[1][2].is_zero() && m[0][3].is_zero();
    let unit = m[3][2].value.abs() == 1.0;
    (central && centered && unit).then_some([m[0][0], m[1][1]])
}

fn with_scale_y(m: &Entries<4>, [x, y]: [Rounded; 2], scale_y: Rounded) -> Entries<4> {
    let mut changed = *m;
    changed[0][0] = scale_y * (x / y);
    changed[1][1] = scale_y;
    changed
}

/// Undoes M17: 2/tan(fovy) instead of 1/tan(fovy/2).
fn undo_half_of_tangent(m: &Entries<4>, best: &MatrixReading) -> Option<Remedy> {
    let [x, y] = centered_scales(m).filter(|_| is_central(&best.meaning))?;
    let tangent = Rounded::exact(2.0) / y;
    // tan(θ/2) = (√(1 + tan²θ) − 1)/tan θ
    let root = (Rounded::ONE + tangent * tangent).sqrt();
    let scale = tangent / (root - Rounded::ONE);
    remedy(Misprint::HalfOfTangent, &with_scale_y(m, [x, y], scale), is_central)
}

/// Undoes M19: a scale that results from treating a multiple of five degrees as radians.
fn undo_degrees(m: &Entries<4>, best: &MatrixReading) -> Option<Remedy> {
    let [x, y] = centered_scales(m).filter(|_| best.meaning.is_named())?;
    let degrees = (2..=34_u32).map(|fives| f64::from(fives * 5)).find(|degrees| {
        let half = libm::tan(0.5 * degrees);
        let product = y * Rounded::exact(half);
        (product.value - 1.0).abs() <= product.error + 1e-12
    })?;
    let scale = Rounded::exact(1.0 / libm::tan(0.5 * degrees.to_radians()));
    let scale = Rounded { error: 4.0 * f64::EPSILON * scale.value, ..scale };
    remedy(Misprint::Degrees, &with_scale_y(m, [x, y], scale), is_central)
}

/// Reports M12 and returns the matrix of glFrustum with the same parameters.
fn tell_moved_apex(_: &Entries<4>, best: &MatrixReading) -> Option<Remedy> {
    let MatrixMeaning::ApexMoved { frustum, convention } = best.meaning else { return None };
    let through = Frustum::from_window(frustum.window(), frustum.near(), frustum.far()).ok()?;
    let remedied = Some(through.view_to_clip(convention).rows());
    Some(Remedy { misprint: Misprint::ApexMoved, cost: best.cost, remedied })
}

/// Reports M16: the window begins at x = 0, but y = 0 is neither its edge nor its center.
fn tell_frustum_offset_one(_: &Entries<4>, best: &MatrixReading) -> Option<Remedy> {
    let MatrixMeaning::Perspective { frustum, .. } = best.meaning else { return None };
    let w = frustum.window();
    let aside = w.bottom() != 0.0 && w.top() != 0.0 && w.bottom() != -w.top();
    let told = w.left() == 0.0 && aside;
    let misprint = Misprint::FrustumOffsetOne;
    told.then_some(Remedy { misprint, cost: best.cost, remedied: None })
}

/// Reports M6: t_y instead of t_z.
fn tell_repeated_translation(_: &Entries<4>, best: &MatrixReading) -> Option<Remedy> {
    let MatrixMeaning::Translation { by: [x, y, z] } = best.meaning else { return None };
    let told = y == z && y != 0.0 && x != y && x != 0.0;
    let misprint = Misprint::RepeatedTranslation;
    told.then_some(Remedy { misprint, cost: best.cost, remedied: None })
}
