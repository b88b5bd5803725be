//! Screen vertices, snapped to the fixed-point grid on which coverage is exact.
//!
//! Coverage uses only integers. A vertex is rounded once to the nearest multiple of 1/256 pixel (8
//! subpixel bits, as Direct3D requires and GPUs use), and from there on every edge function is
//! exact. Vertices shared by triangles are snapped identically, so no gap can open between them.
//! The price is an error of at most 1/512 pixel in each vertex coordinate.

use core::num::NonZeroU32;
use homog::{Point, Screen};

/// The subpixel bits of a coordinate: the grid is 1/256 pixel.
pub const SUBPIXEL_BITS: u32 = 8;
/// Grid steps per pixel.
pub const SUBPIXELS: i32 = 1 << SUBPIXEL_BITS;
/// The minimum and maximum coordinates of a vertex in pixels. Geometry beyond them must be clipped.
///
/// This leaves a guard band of 8192 pixels around a picture with sides of
/// [`MAX_SIDE`](crate::MAX_SIDE) (CL-4), so few triangles need clipping at the sides of the
/// picture. No triangle is then wider or taller than 32768 pixels, and its edge functions, divided
/// by 256, change by less than 2³⁰ across a tile.
pub const GUARD_BAND: core::ops::RangeInclusive<f64> = -8192.0..=24576.0;

/// [`GUARD_BAND`] in grid steps.
pub(crate) const GRID_RANGE: core::ops::RangeInclusive<i32> = -8192 * SUBPIXELS..=24576 * SUBPIXELS;

/// The maximum magnitude of a depth, chosen so that no step in the evaluation of a depth plane
/// overflows.
pub const MAX_DEPTH: f32 = 1_048_576.0;

/// A vertex after perspective divide, viewport transform and snapping. It can always be drawn.
///
/// x points right and y down, in 1/256 pixel. Depth is 1 at the near plane and 0 at the far plane
/// (reversed z); larger is nearer.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ScreenVertex {
    pub(crate) x: i32,
    pub(crate) y: i32,
    pub(crate) depth: f32,
    /// The bits of 1/w. Since 1/w is positive, they are not all 0, and an `Option` takes no extra
    /// space.
    inv_w: NonZeroU32,
}

impl ScreenVertex {
    /// Creates a vertex on the grid.
    ///
    /// Returns `None` if the vertex cannot be drawn: it is outside [`GUARD_BAND`], its depth is
    /// beyond ±2²⁰ or NaN, or 1/w is not positive and finite.
    #[inline]
    #[must_use]
    pub fn new(x: i32, y: i32, depth: f32, inv_w: f32) -> Option<Self> {
        let on_grid = GRID_RANGE.contains(&x) & GRID_RANGE.contains(&y);
        Self::new_if_drawable(on_grid, x, y, depth, inv_w)
    }

    /// Creates a vertex if it is `on_grid` and otherwise drawable.
    ///
    /// This is branchless, so a loop over eight vertices compiles to vector instructions.
    #[inline(always)]
    pub(crate) fn new_if_drawable(
        on_grid: bool,
        x: i32,
        y: i32,
        depth: f32,
        inv_w: f32,
    ) -> Option<Self> {
        let is_drawable =
            on_grid & (depth.abs() <= MAX_DEPTH) & (inv_w > 0.0) & (inv_w < f32::INFINITY);
        let bits = if is_drawable { inv_w.to_bits() } else { 0 };
        NonZeroU32::new(bits).map(|inv_w| Self { x, y, depth, inv_w })
    }

    /// Snaps a screen point (pixels, y down; z is the depth), given the clip-space w by which it
    /// was divided.
    ///
    /// Returns `None` if the point cannot be drawn: a coordinate is not finite or outside
    /// [`GUARD_BAND`], the depth is beyond ±2²⁰, or w is not positive. Geometry clipped to the view
    /// volume with a guard band can always be drawn.
    #[must_use]
    pub fn snap(point: Point<Screen>, w: f64) -> Option<Self> {
        let (x, y) = (snap_coordinate(point.x())?, snap_coordinate(point.y())?);
        Self::new(x, y, point.z() as f32, (1.0 / w) as f32)
    }

    /// Returns x in grid steps from the left border of the picture.
    #[must_use]
    pub const fn x(&self) -> i32 {
        self.x
    }

    /// Returns y in grid steps from the top border of the picture.
    #[must_use]
    pub const fn y(&self) -> i32 {
        self.y
    }

    /// Returns the depth: 1 at the near plane, 0 at the far plane; larger is nearer.
    #[must_use]
    pub const fn depth(&self) -> f32 {
        self.depth
    }

    /// Returns 1/w for the clip-space w, a factor of the weights in perspective-correct
    /// interpolation (IN-2). It is 1 in parallel projections.
    #[inline(always)]
    #[must_use]
    pub const fn inv_w(&self) -> f32 {
        f32::from_bits(self.inv_w.get())
    }
}

/// Returns the nearest grid step, with halves rounded up, or `None` outside the guard band.
///
/// Halves round up on both sides of 0, so moving a picture by whole pixels moves its grid with it.
fn snap_coordinate(pixels: f64) -> Option<i32> {
    let step = || (pixels * f64::from(SUBPIXELS) + 0.5).floor() as i32;
    GUARD_BAND.contains(&pixels).then(step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snapping_rounds_to_the_nearest_grid_step_and_moves_with_whole_pixels() {
        let x_of = |x| ScreenVertex::snap(Point::new(x, 0.0, 0.5), 2.0).map(|v| v.x);
        assert_eq!(x_of(1.0), Some(256));
        assert_eq!(x_of(1.0 + 0.5 / 256.0), Some(257));
        assert_eq!(x_of(-1.0 + 0.5 / 256.0), Some(-255), "halves round up on both sides of 0");
        assert_eq!(x_of(-1.0 - 0.4 / 256.0), Some(-256));
    }

    #[test]
    fn points_that_cannot_be_drawn_give_no_vertex() {
        for x in [f64::NAN, f64::INFINITY, -8192.1, 24576.1] {
            assert_eq!(ScreenVertex::snap(Point::new(x, 0.0, 0.0), 1.0), None, "x = {x}");
            assert_eq!(ScreenVertex::snap(Point::new(0.0, x, 0.0), 1.0), None, "y = {x}");
        }
        assert_eq!(ScreenVertex::snap(Point::new(0.0, 0.0, f64::NAN), 1.0), None);
        assert_eq!(ScreenVertex::snap(Point::new(0.0, 0.0, 0.0), 0.0), None);
        assert_eq!(ScreenVertex::snap(Point::new(0.0, 0.0, 0.0), f64::NAN), None);
    }
}
