//! Linear gradients, interpolated in sRGB as in CSS (CSS Images 3, §3.1).
//!
//! ```text
//!   ┌───────────┐     The gradient line passes through the center at an angle. Colors are
//!   │╲ color 0  │     constant perpendicular to it; the first and last occur where their lines
//!   │ ╲         │     of constant color touch the corners of the picture.
//!   │  ╲ ──►    │
//!   │   ╲color 1│
//!   └───────────┘
//! ```

use crate::color::srgb_to_linear;

/// Number of steps in the table. With linear interpolation, the error is smaller than 16 bits can
/// resolve.
const TABLE_STEPS: usize = 1024;

/// A linear gradient through equally spaced colors.
#[derive(Clone, PartialEq, Debug)]
pub struct Gradient {
    /// Linear colors at equal distances along the gradient line, from start to end.
    table: Vec<[f32; 3]>,
    /// The fractions of the gradient line covered by a step across and a step down the whole
    /// picture.
    axis: [f32; 2],
}

impl Gradient {
    /// Creates a gradient through one or more colors, given as sRGB codes, for a picture of this
    /// size.
    ///
    /// The gradient runs down at an angle of 0 radians, and to the right at a quarter turn.
    #[must_use]
    pub fn new(colors: &[[u8; 3]], angle: f64, [width, height]: [u32; 2]) -> Self {
        let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
        let (across, down) = (f64::from(width) * sine, f64::from(height) * cosine);
        // The length of the gradient line from corner to corner, as in CSS.
        let length = across.abs() + down.abs();
        let axis = [across / length, down / length].map(|component| component as f32);
        let last = colors.len().saturating_sub(1);
        let mixed = |step: usize| {
            let position = step as f64 / TABLE_STEPS as f64 * last as f64;
            let first = (position as usize).min(last.saturating_sub(1));
            let (from, to) = (colors[first], colors[(first + 1).min(last)]);
            let fraction = position - first as f64;
            [0, 1, 2].map(|k| {
                let [a, b] = [from[k], to[k]].map(|code: u8| f64::from(code) / 255.0);
                srgb_to_linear(a + (b - a) * fraction) as f32
            })
        };
        Self { table: (0..=TABLE_STEPS).map(mixed).collect(), axis }
    }

    /// Returns the linear, opaque color at a position in fractions of the picture.
    pub(super) fn color_at(&self, [x, y]: [f32; 2]) -> [f32; 4] {
        let [across, down] = self.axis;
        let along = (0.5 + (x - 0.5) * across + (y - 0.5) * down).clamp(0.0, 1.0);
        let step = along * TABLE_STEPS as f32;
        let first = (step as usize).min(TABLE_STEPS - 1);
        let fraction = step - first as f32;
        let (from, to) = (self.table[first], self.table[first + 1]);
        let [r, g, b] = [0, 1, 2].map(|k| from[k] + (to[k] - from[k]) * fraction);
        [r, g, b, 1.0]
    }

    /// Returns the linear, opaque color at the center.
    #[must_use]
    pub fn center_color(&self) -> [f32; 4] {
        self.color_at([0.5, 0.5])
    }
}
