//! Readings of central projections: frusta in sixteen conventions, the textbook's P (Shirley and
//! Marschner, ch. 8), and the inverses of both.

use super::convention_list::conventions_looking;
use super::matrix_reading::factor_cost;
use super::rounded::{Entries, Rounded, divide_entries};
use super::{Lens, MatrixMeaning, MatrixReading};
use alloc::vec::Vec;
use projection::{ApexMovedFrustum, Convention, Frustum};

/// The cost that a mirrored window adds to the digits of a reading.
pub(crate) const MIRRORED: u32 = 14;

/// The cost of an angle of view above 150° in both directions.
const WIDE: u32 = 6;

/// The cost of the inverse of a projection with reversed depth and an infinite far plane.
const INFINITE_INVERSE: u32 = 14;

/// The cost of a volume whose far plane is at most at twice the near distance.
pub(crate) const SHALLOW: u32 = 5;

/// Adds the readings as frusta (GL-1, PE-2) or as the lesson's frustum with its apex moved (LW-1).
pub(crate) fn read_frusta(m: &Entries<4>, found: &mut Vec<MatrixReading>) {
    let zeros = [m[0][1], m[1][0], m[2][0], m[2][1], m[3][0], m[3][1], m[3][3]];
    if !zeros.into_iter().all(Rounded::is_zero) || m[3][2].is_zero() {
        return;
    }
    for sign in [1.0, -1.0] {
        let factor = Rounded { value: sign * m[3][2].value.abs(), ..m[3][2] };
        let unit = divide_entries(m, factor);
        for (convention, rarity) in conventions_looking(unit[3][2].value.signum()) {
            // With the textbook's sign, w = z, which is negative in front of the eye.
            let natural = sign > 0.0 || convention == Convention::CHAPTER;
            let factor_digits = if natural && factor.is(sign) { 0 } else { factor_cost(factor) };
            let rare = if convention == Convention::CHAPTER && sign < 0.0 { 0 } else { rarity };
            let reading = frustum_reading(&unit, convention).map(|(meaning, cost)| MatrixReading {
                meaning,
                factor: factor.simplest(),
                cost: cost + rare + factor_digits,
            });
            found.extend(reading);
        }
    }
}

/// Reads the frustum of a matrix with the bottom row (0, 0, ±1, 0).
fn frustum_reading(unit: &Entries<4>, convention: Convention) -> Option<(MatrixMeaning, u32)> {
    let [x, y, z, w] = unit;
    let ahead = Rounded::exact(w[2].value.signum());
    let top = Rounded::exact(convention.top());
    let (near, far) = depth_planes(z[2] * ahead, z[3], convention)?;
    let shifts = [(x[2], x[3], x[0]), (y[2], y[3], y[1] * top)];
    if shifts.iter().any(|shift| shift.2.is_zero()) {
        return None;
    }
    let (mut cost, mut window, mut apex) = (0, [near; 4], [Rounded::exact(0.0); 2]);
    for (axis, (slant, offset, scale)) in shifts.into_iter().enumerate() {
        let sign = if axis == 1 { top } else { Rounded::ONE };
        let center = -slant * ahead * sign;
        if !offset.is_zero() {
            apex[axis] = -offset * sign / scale;
            if !center.is_zero() {
                return None;
            }
        }
        let edge = |side: Rounded| (center + side) / scale * near + apex[axis];
        (window[2 * axis], window[2 * axis + 1]) = (edge(-Rounded::ONE), edge(Rounded::ONE));
        cost += if scale.value < 0.0 { MIRRORED } else { 0 };
    }
    // The lens is described by the window, or by the apex and the window relative to it.
    let [around_x, around_y] = apex;
    let [l, r, b, t] = window;
    let centered = [l - around_x, r - around_x, b - around_y, t - around_y];
    let by_apex = around_x.digits() + around_y.digits();
    let lens = (by_apex + lens_digits(centered, near, y[1] * top, x[0]))
        .min(window.into_iter().map(Rounded::digits).sum());
    let meaning = named_frustum(window, near, far, apex, convention)?;
    cost += if is_extremely_wide(window, near) { WIDE } else { 0 };
    Some((meaning, cost + planes_cost(near, far) + 2 * lens))
}

/// Returns whether the angle of view exceeds 150° in both directions.
fn is_extremely_wide([l, r, b, t]: [Rounded; 4], near: Rounded) -> bool {
    let angle = |low: Rounded, high: Rounded| {
        (high / near).atan_degrees().value - (low / near).atan_degrees().value
    };
    angle(l, r).abs() > 150.0 && angle(b, t).abs() > 150.0
}

/// Returns the cost of the near and far planes.
///
/// A matrix rounded to a few decimals may have near = 0.1 in one convention and near = 0.05 in
/// another. People prefer powers of ten. A volume that ends before twice its near distance is rare,
/// but the textbook's matrix of near = 1, far = 9 is also the one of near = 1, far = 1.8 with
/// reversed depth.
pub(crate) fn planes_cost(near: Rounded, far: Option<Rounded>) -> u32 {
    let digits = near.decimal_digits() + far.map_or(0, Rounded::decimal_digits);
    let usual = if near.is_power_of_ten() { 0 } else { 2 };
    let shallow = far.is_some_and(|far| is_shallow(near, far));
    2 * digits + usual + if shallow { SHALLOW } else { 0 }
}

/// Returns whether the far plane is at most at twice the positive near distance.
pub(crate) fn is_shallow(near: Rounded, far: Rounded) -> bool {
    let excess = far - near * Rounded::exact(2.0);
    near.value > 0.0 && (excess.value <= 0.0 || excess.is_zero())
}

/// Returns the frustum, or the lesson's frustum if the apex is not at the origin.
fn named_frustum(
    window: [Rounded; 4],
    near: Rounded,
    far: Option<Rounded>,
    apex: [Rounded; 2],
    convention: Convention,
) -> Option<MatrixMeaning> {
    let [l, r, b, t] = window.map(Rounded::simplest);
    let (n, f) = (near.simplest(), far.map_or(f64::INFINITY, Rounded::simplest));
    if apex.into_iter().all(Rounded::is_zero) {
        let frustum = Frustum::new(l, r, b, t, n, f).ok()?;
        return Some(MatrixMeaning::Perspective {
            frustum,
            lens: read_lens(window, near),
            convention,
        });
    }
    let frustum = ApexMovedFrustum::new(l, r, b, t, n, f).ok()?;
    Some(MatrixMeaning::ApexMoved { frustum, convention })
}

/// Returns the angles, aspect ratio and focal lengths of a lens from its window on the near plane.
pub(crate) fn read_lens([l, r, b, t]: [Rounded; 4], near: Rounded) -> Lens {
    let angle = |low: Rounded, high: Rounded| {
        ((high / near).atan_degrees() - (low / near).atan_degrees()).simplest()
    };
    let two = Rounded::exact(2.0);
    Lens {
        fov_x_degrees: angle(l, r).abs(),
        fov_y_degrees: angle(b, t).abs(),
        aspect: ((r - l) / (t - b)).simplest().abs(),
        focal_lengths: [(r - l, near), (t - b, near)].map(|(d, n)| (two * n / d).simplest().abs()),
    }
}

/// Returns the smallest number of digits that describes the lens: by its window or, if it is
/// centered, by its two scales or by an angle and an aspect ratio.
pub(crate) fn lens_digits(
    window: [Rounded; 4],
    near: Rounded,
    scale_y: Rounded,
    scale_x: Rounded,
) -> u32 {
    let [l, r, b, t] = window;
    let centered = (l + r).is_zero() && (b + t).is_zero();
    if !centered {
        return window.into_iter().map(Rounded::digits).sum();
    }
    let two = Rounded::exact(2.0);
    let angle = |side: Rounded| (two * (side / near).atan_degrees()).digits();
    let by_angle = angle(t).min(angle(r)) + (r / t).digits();
    by_angle.min(r.digits() + t.digits()).min(scale_y.digits() + scale_x.digits())
}

/// Returns the distances D at which factor + offset/D equals the near and far depths, if 0 < near <
/// far. The far distance is `None` if it may be infinite within rounding.
pub(crate) fn depth_planes(
    factor: Rounded,
    offset: Rounded,
    convention: Convention,
) -> Option<(Rounded, Option<Rounded>)> {
    let near = offset / (Rounded::exact(convention.near_depth()) - factor);
    if !(near.value.is_finite() && near.value > 0.0) {
        return None;
    }
    let gap = Rounded::exact(convention.far_depth()) - factor;
    if gap.value.abs() <= gap.error.max(16.0 * f64::EPSILON) {
        return Some((near, None));
    }
    let far = offset / gap;
    (far.value > near.value).then_some((near, Some(far)))
}

/// Adds the reading as the textbook's P (PE-1): n scales x and y, and the third row has n + f and
/// −fn.
pub(crate) fn read_p(m: &Entries<4>, found: &mut Vec<MatrixReading>) {
    let factor = m[3][2];
    let zeros = [m[0][1], m[0][2], m[0][3], m[1][0], m[1][2], m[1][3], m[2][0], m[2][1]];
    let bottom = [m[3][0], m[3][1], m[3][3]];
    if factor.is_zero() || !zeros.into_iter().chain(bottom).all(Rounded::is_zero) {
        return;
    }
    let unit = divide_entries(m, factor);
    let n = unit[0][0];
    let f = unit[2][2] - n;
    if n.equals(unit[1][1]) && (n * f + unit[2][3]).is_zero() {
        found.extend(p_reading(n, f, false, factor, factor.is(1.0)));
    }
}

/// Adds the reading as the inverse of P in either printed form: unscaled, or times nf.
pub(crate) fn read_p_inverse(m: &Entries<4>, found: &mut Vec<MatrixReading>) {
    let factor = m[2][3];
    let zeros = [m[0][3], m[1][3]];
    if !is_inverse_shaped(m) || !zeros.into_iter().all(Rounded::is_zero) {
        return;
    }
    let unit = divide_entries(m, factor);
    let n = Rounded::ONE / unit[0][0];
    let f = -Rounded::ONE / (n * unit[3][2]);
    let same = unit[0][0].equals(unit[1][1]) && (unit[3][3] * n * f).equals(n + f);
    if same {
        let printed = factor.is(1.0) || factor.equals(n * f);
        found.extend(p_reading(n, f, true, factor, printed));
    }
}

fn p_reading(
    n: Rounded,
    f: Rounded,
    inverse: bool,
    factor: Rounded,
    printed: bool,
) -> Option<MatrixReading> {
    // The textbook's planes are in front of the eye: 0 > n > f.
    let behind = if n.value > 0.0 { 4 } else { 0 };
    let cost =
        behind + 2 * (n.digits() + f.digits()) + if printed { 0 } else { factor_cost(factor) };
    let (n, f) = (n.simplest(), f.simplest());
    if n * f <= 0.0 || n == f {
        return None;
    }
    let meaning = if inverse {
        MatrixMeaning::ChapterPInverse { n, f }
    } else {
        MatrixMeaning::ChapterP { n, f }
    };
    Some(MatrixReading { meaning, factor: factor.simplest(), cost })
}

/// Returns whether a matrix has the zeros of an inverted frustum matrix (IV-1).
fn is_inverse_shaped(m: &Entries<4>) -> bool {
    let zeros = [m[0][1], m[0][2], m[1][0], m[1][2], m[2][0], m[2][1], m[2][2], m[3][0], m[3][1]];
    let needed = [m[0][0], m[1][1], m[2][3], m[3][2]];
    zeros.into_iter().all(Rounded::is_zero) && !needed.into_iter().any(Rounded::is_zero)
}

/// Adds the readings as an inverted frustum matrix, from clip to view space (IV-1).
pub(crate) fn read_inverse_frusta(m: &Entries<4>, found: &mut Vec<MatrixReading>) {
    if !is_inverse_shaped(m) {
        return;
    }
    let (zero, one) = (Rounded::exact(0.0), Rounded::ONE);
    let (x, y, w) = (m[0][0], m[1][1], m[2][3]);
    let forward = [
        [one / x, zero, -m[0][3] / (x * w), zero],
        [zero, one / y, -m[1][3] / (y * w), zero],
        [zero, zero, -m[3][3] / (m[3][2] * w), one / m[3][2]],
        [zero, zero, one / w, zero],
    ];
    let mut inverses = Vec::new();
    read_frusta(&forward, &mut inverses);
    // Without m[3][3], the matrix is more likely the transpose of Unreal's, for row vectors, than the
    // inverse of a reversed infinite projection.
    let rare = if m[3][3].is_zero() { INFINITE_INVERSE } else { 2 };
    found.extend(inverses.into_iter().filter_map(|reading| match reading.meaning {
        MatrixMeaning::Perspective { frustum, lens, convention } => Some(MatrixReading {
            meaning: MatrixMeaning::InversePerspective { frustum, lens, convention },
            factor: 1.0 / reading.factor,
            cost: reading.cost + rare,
        }),
        _ => None,
    }));
}
