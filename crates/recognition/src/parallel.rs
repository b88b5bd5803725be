//! Readings of parallel projections as view volumes: orthographic boxes and oblique prisms.

use super::convention_list::CONVENTIONS;
use super::matrix_reading::factor_cost;
use super::perspective::{MIRRORED, SHALLOW, is_shallow};
use super::rounded::{Entries, Rounded, divide_entries};
use super::{MatrixMeaning, MatrixReading};
use alloc::vec::Vec;
use projection::{Convention, Oblique, Orthographic};

/// Adds the readings as orthographic boxes (OR-1, GL-3) or oblique prisms (VV-1).
pub(crate) fn read_boxes(m: &Entries<4>, found: &mut Vec<MatrixReading>) {
    let zeros = [m[0][1], m[1][0], m[2][0], m[2][1], m[3][0], m[3][1], m[3][2]];
    let factor = m[3][3];
    if factor.is_zero() || !zeros.into_iter().all(Rounded::is_zero) {
        return;
    }
    let unit = divide_entries(m, factor);
    if [unit[0][0], unit[1][1], unit[2][2]].into_iter().any(Rounded::is_zero) {
        return;
    }
    for (convention, rarity) in CONVENTIONS {
        let reading = box_reading(&unit, convention).map(|(meaning, cost)| MatrixReading {
            meaning,
            factor: factor.simplest(),
            cost: cost + box_rarity(convention, rarity) + factor_cost(factor),
        });
        found.extend(reading);
    }
}

/// Returns the rarity of a convention for boxes. Few programs reverse the depth of a box, because
/// it gains nothing. The textbook's depth (Shirley and Marschner, ch. 8) does not count as
/// reversed.
pub(crate) fn box_rarity(convention: Convention, rarity: u32) -> u32 {
    let reversed = convention.near_depth() > convention.far_depth();
    if reversed && convention != Convention::CHAPTER { rarity + 1 } else { rarity }
}

fn box_reading(unit: &Entries<4>, convention: Convention) -> Option<(MatrixMeaning, u32)> {
    let [x, y, z, _] = unit;
    let (ahead, top) = (Rounded::exact(convention.ahead()), Rounded::exact(convention.top()));
    // A view volume also maps z; a matrix that leaves z unchanged maps only the plane.
    let mut cost = if z[2].is(1.0) && z[3].is_zero() { MIRRORED } else { 2 };
    let mut edges = |scale: Rounded, offset: Rounded| {
        cost += if scale.value < 0.0 { MIRRORED } else { 0 };
        [(-Rounded::ONE - offset) / scale, (Rounded::ONE - offset) / scale]
    };
    let [l, r] = edges(x[0], x[3]);
    let [b, t] = edges(y[1] * top, y[3] * top);
    let is_screen = convention.top() > 0.0 && is_from_top_left([l, r, b, t]);
    cost -= if is_screen { MIRRORED } else { 0 };
    let distance = |depth: f64| (Rounded::exact(depth) - z[3]) / (z[2] * ahead);
    let (near, far) = (distance(convention.near_depth()), distance(convention.far_depth()));
    cost += pair_cost(l, r) + pair_cost(b, t) + pair_cost(near, far);
    cost += if is_shallow(near, far) { SHALLOW } else { 0 };
    // The depths that gluOrtho2D passes to glOrtho for two-dimensional pictures.
    let is_plane_depth = is_screen && near.is(-1.0) && far.is(1.0);
    cost += if is_plane_depth { 0 } else { order_cost(near, far) };
    let volume = Orthographic::new(
        l.simplest(),
        r.simplest(),
        b.simplest(),
        t.simplest(),
        near.simplest(),
        far.simplest(),
    )
    .ok()?;
    let slants = [x[2] / x[0], y[2] / y[1]];
    if slants.into_iter().all(Rounded::is_zero) {
        return Some((MatrixMeaning::Orthographic { volume, convention }, cost));
    }
    // `Oblique` defines its slants for a camera that looks along −z.
    let [slant_x, slant_y] = slants.map(|slant| slant * -ahead);
    let projection = oblique_by_slants(slant_x, slant_y, 0.0)?;
    let cost = cost + 2 + oblique_cost(slant_x, slant_y);
    Some((MatrixMeaning::ObliqueVolume { projection, volume, convention }, cost))
}

/// Returns whether a window is measured in whole pixels from the upper left corner: left and top
/// are 0, right and bottom are positive.
fn is_from_top_left([l, r, b, t]: [Rounded; 4]) -> bool {
    let is_side = |side: Rounded| side.value > 1.5 && side.is(libm::round(side.value));
    l.is_zero() && t.is_zero() && is_side(r) && is_side(b)
}

/// Returns twice the number of digits of two edges, or of one edge if the other is its negative.
fn pair_cost(low: Rounded, high: Rounded) -> u32 {
    let second = if (low + high).is_zero() { 0 } else { low.decimal_digits() };
    2 * (high.decimal_digits() + second)
}

/// Returns the cost of the order and signs of near and far. It is 0 if both planes are in front of
/// the eye and in ascending order.
fn order_cost(near: Rounded, far: Rounded) -> u32 {
    match (near.value, far.value) {
        (near, far) if near > far => MIRRORED,
        (_, far_value) if far_value < 0.0 => MIRRORED,
        (near_value, _) if near_value < 0.0 && !near.is_zero() => 6,
        _ => 0,
    }
}

/// Returns the oblique projection onto z = `plane_z` for the slants of x and y, as in x' = x +
/// slant z. It is built from its length and angle if these have fewer digits than the slants.
pub(crate) fn oblique_by_slants(x: Rounded, y: Rounded, plane_z: f64) -> Option<Oblique> {
    let (length, phi) = length_and_angle(x, y);
    let direction = if length.digits() + phi.digits() < x.digits() + y.digits() {
        let (sin, cos) = libm::sincos(phi.simplest().to_radians());
        [length.simplest() * cos, length.simplest() * sin]
    } else {
        [x.simplest(), y.simplest()]
    };
    Oblique::by_direction(homog::Vector::new(direction[0], direction[1], -1.0), plane_z).ok()
}

/// Returns the length and the angle, in degrees, at which a unit of depth is drawn.
fn length_and_angle(x: Rounded, y: Rounded) -> (Rounded, Rounded) {
    let length = (x * x + y * y).sqrt();
    let value = libm::atan2(y.value, x.value).to_degrees();
    let across = (x.error + y.error) / length.value.max(f64::MIN_POSITIVE);
    let error = across.to_degrees() + 4.0 * f64::EPSILON * value.abs();
    (length, Rounded { value, error })
}

/// Returns twice the digits of the length and angle or of the two slants, whichever is less.
pub(crate) fn oblique_cost(x: Rounded, y: Rounded) -> u32 {
    let (length, angle) = length_and_angle(x, y);
    let angle = if x.is_zero() { 1 } else { angle.digits() };
    2 * (length.digits() + angle).min(x.digits() + y.digits())
}
