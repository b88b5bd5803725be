//! Readings as maps to pixels: viewports (VP-1 to VP-3) and camera intrinsics (OpenCV).

use super::rounded::{Entries, Rounded};
use super::{MatrixMeaning, MatrixReading};
use alloc::vec::Vec;

/// A viewport, which maps [−1, 1]² to a rectangle of pixels and the depths [−1, 1] to a depth
/// range.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct ViewportReading {
    /// The column coordinate of the left edge.
    pub x: f64,
    /// The row coordinate of the edge from which rows are counted.
    pub y: f64,
    /// The width in pixels.
    pub width: f64,
    /// The height in pixels.
    pub height: f64,
    /// True if rows count from the top, so that y = +1 maps to the smaller row.
    pub y_down: bool,
    /// True if pixel centers have integer coordinates, as in the textbook (Shirley and Marschner,
    /// ch. 8), so that the image begins at −½.
    pub integer_centers: bool,
    /// The depths to which z = −1 and z = +1 map.
    pub depth: [f64; 2],
}

/// The intrinsic matrix K of a pinhole camera, in pixels (Hartley and Zisserman 2004, OpenCV).
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct IntrinsicsReading {
    /// The focal length in pixel widths.
    pub fx: f64,
    /// The focal length in pixel heights.
    pub fy: f64,
    /// The column coordinate of the principal point.
    pub cx: f64,
    /// The row coordinate of the principal point.
    pub cy: f64,
    /// The skew of the pixel axes; 0 in most cameras.
    pub skew: f64,
}

/// Adds the reading as a viewport, if its size and origin are in whole pixels.
pub(crate) fn read_viewport(m: &Entries<4>, found: &mut Vec<MatrixReading>) {
    let zeros = [m[0][1], m[0][2], m[1][0], m[1][2], m[2][0], m[2][1]];
    let bottom = [m[3][0], m[3][1], m[3][2]];
    let affine = zeros.into_iter().chain(bottom).all(Rounded::is_zero) && m[3][3].is(1.0);
    let half_height = Rounded { value: m[1][1].value.abs(), ..m[1][1] };
    let depth = [m[2][3] - m[2][2], m[2][3] + m[2][2]].map(Rounded::simplest);
    let in_range = depth == [-1.0, 1.0] || depth.iter().all(|d| (0.0..=1.0).contains(d));
    if !affine || m[0][0].value < 1.0 || half_height.value < 1.0 || !in_range {
        return;
    }
    let (two, half) = (Rounded::exact(2.0), Rounded::exact(0.5));
    for shift in [half, Rounded::exact(0.0)] {
        let size = [m[0][0] * two, half_height * two];
        let origin = [m[0][3] - m[0][0] + shift, m[1][3] - half_height + shift];
        let whole = |number: &Rounded| number.is(libm::round(number.value));
        if !size.iter().chain(&origin).all(whole) || origin.iter().any(|o| o.value < -0.4) {
            continue;
        }
        let [width, height, x, y] =
            [size[0], size[1], origin[0], origin[1]].map(|number| libm::round(number.value));
        let digits: u32 = size.into_iter().chain(origin).map(Rounded::digits).sum();
        let moved = if x == 0.0 && y == 0.0 { 0 } else { 2 };
        let viewport = ViewportReading {
            x,
            y,
            width,
            height,
            y_down: m[1][1].value < 0.0,
            integer_centers: shift.value > 0.0,
            depth,
        };
        let meaning = MatrixMeaning::Viewport(viewport);
        found.push(MatrixReading { meaning, factor: 1.0, cost: 1 + moved + 2 * digits.min(12) });
    }
}

/// Reads the intrinsics from a matrix with the rows (fx, skew, cx), (0, fy, cy), (0, 0, 1).
///
/// The matrix is a different map if a scale is below 20, if the scales differ by a factor of 2, or
/// if the principal point is not to the right of and below the first pixel.
pub(crate) fn intrinsics_of(k: &Entries<3>) -> Option<(IntrinsicsReading, u32)> {
    let zeros = [k[1][0], k[2][0], k[2][1]];
    if !zeros.into_iter().all(Rounded::is_zero) || !k[2][2].is(1.0) {
        return None;
    }
    let [fx, skew, cx] = k[0];
    let [_, fy, cy] = k[1];
    let alike = (0.5..2.0).contains(&(fx.value / fy.value));
    let slight = skew.value.abs() < 0.1 * fx.value;
    let inside = cx.value > 1.0 && cy.value > 1.0;
    if !(fx.value >= 20.0 && fy.value >= 20.0 && alike && slight && inside) {
        return None;
    }
    let same = if fx.equals(fy) { 0 } else { fy.digits() };
    let square = if cx.equals(cy) { 0 } else { cy.digits() };
    let digits = fx.digits() + same + cx.digits() + square + skew.digits();
    let [fx, fy, cx, cy, skew] = [fx, fy, cx, cy, skew].map(Rounded::simplest);
    Some((IntrinsicsReading { fx, fy, cx, cy, skew }, 3 + 2 * digits))
}

/// Adds the reading as a 4×4 intrinsic matrix: K extended by a row and a column of the identity.
pub(crate) fn read_intrinsics(m: &Entries<4>, found: &mut Vec<MatrixReading>) {
    let zeros = [m[0][3], m[1][3], m[2][3], m[3][0], m[3][1], m[3][2]];
    if !zeros.into_iter().all(Rounded::is_zero) || !m[3][3].is(1.0) {
        return;
    }
    let [x, y, z, _] = m;
    let k = [[x[0], x[1], x[2]], [y[0], y[1], y[2]], [z[0], z[1], z[2]]];
    found.extend(intrinsics_of(&k).map(|(intrinsics, cost)| MatrixReading {
        meaning: MatrixMeaning::Intrinsics(intrinsics),
        factor: 1.0,
        cost,
    }));
}
