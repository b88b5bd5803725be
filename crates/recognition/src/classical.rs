//! Readings of the classical projections, either onto a plane, which makes them singular, or
//! depth-preserving (MV-1, AX-1, OB-1, OB-2, ONE-1, TWO-1, THREE-1).

use super::matrix_reading::factor_cost;
use super::parallel::{oblique_by_slants, oblique_cost};
use super::rigid::orthonormal_rows;
use super::rounded::{Entries, Rounded, divide_entries};
use super::{MatrixMeaning, MatrixReading};
use alloc::vec::Vec;
use glam::DVec3;
use homog::Normal;
use projection::{Axonometric, NPoint, PrincipalPlane};

/// Adds the readings as classical projections.
pub(crate) fn read_classical(m: &Entries<4>, found: &mut Vec<MatrixReading>) {
    let factor = m[3][3];
    if factor.is_zero() {
        return found.extend(read_central(m));
    }
    let unit = divide_entries(m, factor);
    let affine = (0..3).all(|j| unit[3][j].is_zero());
    let reading = if affine {
        read_principal_view(&unit)
            .or_else(|| read_oblique(&unit))
            .or_else(|| read_planometric(&unit))
            .or_else(|| read_axonometric(&unit))
    } else {
        read_n_point(&unit)
    };
    found.extend(reading.map(|(meaning, cost)| MatrixReading {
        meaning,
        factor: factor.simplest(),
        cost: cost + factor_cost(factor),
    }));
}

/// Returns the reading as a perspective projection from the origin onto the plane z = d. The rows
/// are x, y, z or 0, and w = z/d.
fn read_central(m: &Entries<4>) -> Option<MatrixReading> {
    let factor = m[0][0];
    if factor.is_zero() || m[3][2].is_zero() {
        return None;
    }
    let unit = divide_entries(m, factor);
    let (is_kept, is_flat) = (is_unit_row(&unit[2], 2), is_zero_row(&unit[2]));
    let is_picture = (0..2).all(|i| is_unit_row(&unit[i], i)) && (is_kept || is_flat);
    let is_by_depth = [0, 1, 3].into_iter().all(|j| unit[3][j].is_zero());
    let plane = Rounded::ONE / unit[3][2];
    let meaning =
        MatrixMeaning::CentralOntoPlane { plane_z: plane.simplest(), onto_plane: is_flat };
    let cost = 4 + 2 * plane.digits() + factor_cost(factor);
    let reading = MatrixReading { meaning, factor: factor.simplest(), cost };
    (is_picture && is_by_depth).then_some(reading)
}

fn is_unit_row(row: &[Rounded; 4], one: usize) -> bool {
    (0..4).all(|j| row[j].is(if j == one { 1.0 } else { 0.0 }))
}

fn is_zero_row(row: &[Rounded; 4]) -> bool {
    row.iter().all(|entry| entry.is_zero())
}

/// Returns the reading as diag(0, 1, 1, 1) or a similar matrix: T_yoz, T_zox, T_xoy (MV-1 to MV-3).
fn read_principal_view(m: &Entries<4>) -> Option<(MatrixMeaning, u32)> {
    let dropped = (0..3).find(|&i| is_zero_row(&m[i]))?;
    let kept = (0..3).filter(|&i| i != dropped).all(|i| is_unit_row(&m[i], i));
    kept.then_some((MatrixMeaning::PrincipalView { plane: PrincipalPlane::ALL[dropped] }, 2))
}

/// Returns the reading with x' = x + (z − z_p) slant, y' likewise, and z' = z_p or z (OB-1, OB-2).
fn read_oblique(m: &Entries<4>) -> Option<(MatrixMeaning, u32)> {
    let [x, y, z, _] = m;
    let keeps_axes = x[0].is(1.0) && x[1].is_zero() && y[0].is_zero() && y[1].is(1.0);
    let flat = [z[0], z[1], z[2]].into_iter().all(Rounded::is_zero);
    let kept = is_unit_row(z, 2);
    if !keeps_axes || !(flat || kept) {
        return None;
    }
    // If depth is preserved, the plane is where the shear leaves points unchanged.
    let steeper = if x[2].value.abs() >= y[2].value.abs() { x } else { y };
    let slanted = !steeper[2].is_zero();
    let plane = if flat || !slanted { z[3] } else { -steeper[3] / steeper[2] };
    let fixed = |row: &[Rounded; 4]| (row[3] + row[2] * plane).is_zero();
    if !fixed(x) || !fixed(y) || (kept && !slanted) {
        return None;
    }
    let projection = oblique_by_slants(x[2], y[2], plane.simplest())?;
    let cost = 3 + oblique_cost(x[2], y[2]) + 2 * plane.digits();
    let meaning = if flat {
        MatrixMeaning::ObliqueOntoPlane { projection }
    } else {
        MatrixMeaning::ObliqueShear { projection }
    };
    Some((meaning, cost))
}

/// Reads a rotated ground plan with heights added to y' (`Planometric`). Heights are y, as in the
/// library, or z, as on a map.
fn read_planometric(m: &Entries<4>) -> Option<(MatrixMeaning, u32)> {
    let [x, y, z, _] = m;
    let moved = [x[3], y[3], z[3]].into_iter().any(|offset| !offset.is_zero());
    let (up, away) = if x[1].is_zero() { (1, -y[2]) } else { (2, y[1]) };
    let across = if up == 1 { x[2] } else { -x[1] };
    let (cos, sin) = (x[0], y[0]);
    let turned = cos.equals(away) && sin.equals(across) && x[up].is_zero();
    let unit = (cos * cos + sin * sin).is_within(1.0, cos.error + sin.error + 1e-12);
    let (flat, kept) = (is_zero_row(z), is_unit_row(z, up));
    let height = y[up];
    if moved || !turned || !unit || !(flat || kept) || height.is_zero() || height.value < 0.0 {
        return None;
    }
    let value = libm::atan2(sin.value, cos.value).to_degrees();
    let error = (sin.error + cos.error).to_degrees() + 8.0 * f64::EPSILON * value.abs();
    let turn = Rounded { value, error };
    let meaning = MatrixMeaning::Planometric {
        turn_degrees: turn.simplest(),
        height: height.simplest(),
        z_up: up == 2,
        onto_plane: flat,
    };
    Some((meaning, 5 + 2 * (turn.digits() + height.digits())))
}

/// Returns the reading of two rows of a rotation and a row of zeros as an axonometric projection
/// onto the picture plane (AX-1).
fn read_axonometric(m: &Entries<4>) -> Option<(MatrixMeaning, u32)> {
    let [x, y, z, _] = m;
    let (a, b) = ([x[0], x[1], x[2]], [y[0], y[1], y[2]]);
    let stays = x[3].is_zero() && y[3].is_zero() && is_zero_row(z);
    let cross = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    let out = [cross(1, 2), cross(2, 0), cross(0, 1)];
    let [u, v, w] = orthonormal_rows(&[a, b, out]).filter(|_| stays)?;
    let error = 4.0 * a.iter().chain(&b).fold(1e-9, |error: f64, entry| error.max(entry.error));
    let normal = equalize_lengths(w, error);
    let projection = Axonometric::by_normal(Normal::from_raw(normal)).ok()?;
    let turn = projection.depth_preserving().raw();
    let same = |row: usize, ours: DVec3| (turn.row(row).truncate() - ours).length() < error;
    let meaning = MatrixMeaning::AxonometricOntoPlane { projection };
    (same(0, u) && same(1, v)).then_some((meaning, 8))
}

/// Makes coordinates equal if rounding cannot distinguish them, so that an isometric normal stays
/// isometric.
fn equalize_lengths(normal: DVec3, error: f64) -> DVec3 {
    let mut lengths = normal.to_array();
    for [i, j] in [[0, 1], [1, 2], [0, 2]] {
        if (lengths[i].abs() - lengths[j].abs()).abs() < error {
            lengths[j] = libm::copysign(lengths[i], lengths[j]);
        }
    }
    lengths.into()
}

/// Reads the identity, or the identity with z dropped, above the row (p, q, r, 1).
fn read_n_point(m: &Entries<4>) -> Option<(MatrixMeaning, u32)> {
    let (kept, flat) = (is_unit_row(&m[2], 2), is_zero_row(&m[2]));
    if !(is_unit_row(&m[0], 0) && is_unit_row(&m[1], 1) && (kept || flat)) {
        return None;
    }
    let terms = [m[3][0], m[3][1], m[3][2]];
    let [p, q, r] = terms.map(Rounded::simplest);
    let projection = NPoint::new(p, q, r).ok()?;
    let fewest = |term: Rounded| match term {
        zero if zero.is_zero() => 0,
        term => term.digits().min((Rounded::ONE / term).digits()),
    };
    let digits: u32 = terms.into_iter().map(fewest).sum();
    // A matrix with vanishing points inside the unit cube is more likely a translation for row
    // vectors.
    let close = kept && terms.into_iter().any(|term| term.value.abs() > 1.0);
    let cost = if close { 11 } else { 3 };
    Some((MatrixMeaning::NPoint { projection, onto_plane: flat }, cost + 2 * digits))
}
