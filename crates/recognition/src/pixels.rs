//! Readings of a perspective and a viewport in one matrix, from view or world space to pixels
//! (PL-1).
//!
//! Sixteen numbers do not distinguish the size of the image from the window unless the window is
//! centered on the line of sight. In that case, the line of sight meets the image at its center.

use super::perspective::read_frusta;
use super::placed::read_placed_perspective;
use super::rounded::{Entries, Rounded};
use super::{MatrixMeaning, MatrixReading};
use alloc::vec::Vec;

/// The minimum size of an image, in pixels, that can be distinguished from an off-center window.
const LEAST_SIZE: f64 = 16.0;

/// An image and its pixel convention.
#[derive(Clone, Copy)]
struct Pixels {
    size: [f64; 2],
    y_down: bool,
    integer_centers: bool,
}

/// Adds the readings as a perspective to pixels, with integer or half-integer centers.
pub(crate) fn read_perspective_to_pixels(m: &Entries<4>, found: &mut Vec<MatrixReading>) {
    let [x, y, _, w] = m;
    let dot = |a: &[Rounded; 4], b: &[Rounded; 4]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let square = dot(w, w);
    if square.is_zero() {
        return;
    }
    let center = [dot(x, w) / square, dot(y, w) / square];
    for (shift, integer_centers) in [(0.5, true), (0.0, false)] {
        let size = center.map(|c| (c + Rounded::exact(shift)) * Rounded::exact(2.0));
        let whole = |side: Rounded| side.is_within(libm::round(side.value), 1e-9 * side.value);
        if size.iter().any(|&side| side.value < LEAST_SIZE || !whole(side)) {
            continue;
        }
        let size = size.map(|side| libm::round(side.value));
        let digits: u32 = size.map(|side| Rounded::exact(side).digits()).iter().sum();
        for y_down in [false, true] {
            let pixels = Pixels { size, y_down, integer_centers };
            let cost = 8 + 2 * digits + u32::from(y_down);
            found.extend(best_reading(&without_viewport(m, &pixels), pixels, cost));
        }
    }
}

/// Computes M_vp⁻¹ M, with the depth row unchanged. The offsets of points on the line of sight are
/// exactly 0.
fn without_viewport(m: &Entries<4>, pixels: &Pixels) -> Entries<4> {
    let shift = if pixels.integer_centers { 0.5 } else { 0.0 };
    let sign = if pixels.y_down { -1.0 } else { 1.0 };
    let row = |at: usize, size: f64, sign: f64| {
        let (scale, center) =
            (Rounded::exact(sign * 2.0 / size), Rounded::exact(size / 2.0 - shift));
        [0, 1, 2, 3].map(|j| {
            let entry = m[at][j] - center * m[3][j];
            // Pixel coordinates are large compared with the remainder, so their rounding determines
            // its error.
            let noise = 4.0 * f64::EPSILON * (size * m[3][j].value).abs();
            Rounded { error: entry.error + noise, ..entry } * scale
        })
    };
    [row(0, pixels.size[0], 1.0), row(1, pixels.size[1], sign), m[2], m[3]]
}

/// Returns the most likely remaining perspective with a window centered on the line of sight.
fn best_reading(clip: &Entries<4>, pixels: Pixels, cost: u32) -> Option<MatrixReading> {
    let mut left = Vec::new();
    read_frusta(clip, &mut left);
    read_placed_perspective(clip, &mut left);
    left.sort_by_key(|reading| reading.cost);
    left.into_iter().find_map(|reading| {
        let (camera, frustum, lens, convention) = match reading.meaning {
            MatrixMeaning::Perspective { frustum, lens, convention } => {
                (None, frustum, lens, convention)
            }
            MatrixMeaning::CameraPerspective { camera, frustum, lens, convention } => {
                (Some(camera), frustum, lens, convention)
            }
            _ => return None,
        };
        let Pixels { size, y_down, integer_centers } = pixels;
        let meaning = MatrixMeaning::PerspectiveToPixels {
            size,
            y_down,
            integer_centers,
            camera,
            frustum,
            lens,
            convention,
        };
        let ordered = frustum.window().width() > 0.0 && frustum.window().height() > 0.0;
        ordered.then_some(MatrixReading { meaning, cost: reading.cost + cost, ..reading })
    })
}
