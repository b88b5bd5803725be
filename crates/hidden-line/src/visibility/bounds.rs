//! Boxes of a hierarchy, stored in single precision and rounded outward.

use super::bvh::Aabb;
use glam::DVec3;

/// A box in single precision.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) min: [f32; 3],
    pub(super) max: [f32; 3],
}

impl Bounds {
    pub(super) const EMPTY: Self = Self { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3] };

    /// Converts a box to coordinates relative to an origin, rounded outward.
    pub(super) fn around(area: &Aabb, origin: DVec3) -> Self {
        Self {
            min: (area.min - origin).to_array().map(round_down),
            max: (area.max - origin).to_array().map(round_up),
        }
    }

    /// Extends the box to contain another box.
    pub(super) fn extend(&mut self, other: &Self) {
        for k in 0..3 {
            self.min[k] = least(self.min[k], other.min[k]);
            self.max[k] = greatest(self.max[k], other.max[k]);
        }
    }

    /// Extends the box to contain a point.
    pub(super) fn extend_to(&mut self, point: [f32; 3]) {
        self.extend(&Self { min: point, max: point });
    }

    /// Returns the midpoint, which determines the bin of an item.
    pub(super) fn box_center(&self) -> [f32; 3] {
        [0, 1, 2].map(|k| (self.min[k] + self.max[k]) * 0.5)
    }

    pub(super) fn half_surface_area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|k| self.max[k] - self.min[k]);
        x * y + y * z + z * x
    }

    /// Whether two boxes have a point in common, including on their borders.
    pub(super) fn intersects(&self, other: &Self) -> bool {
        (0..3).all(|k| self.min[k] <= other.max[k] && other.min[k] <= self.max[k])
    }
}

impl Bounds {
    /// Whether a segment meets the box enlarged by a radius on all sides (slab test).
    pub(super) fn is_near_segment(&self, [from, to]: [DVec3; 2], radius: f64) -> bool {
        let (from, along) = (from.to_array(), (to - from).to_array());
        let mut interval = [0.0_f64, 1.0];
        for k in 0..3 {
            let low = f64::from(self.min[k]) - radius - from[k];
            let high = f64::from(self.max[k]) + radius - from[k];
            if along[k] == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return false;
                }
                continue;
            }
            let (a, b) = (low / along[k], high / along[k]);
            interval = [interval[0].max(a.min(b)), interval[1].min(a.max(b))];
        }
        interval[0] <= interval[1]
    }
}

/// Returns the smaller number. Without the NaN handling of `f32::min`, this is a single
/// instruction.
pub(super) fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// Returns the larger number, like [`least`].
pub(super) fn greatest(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// Rounds down to single precision.
pub(super) fn round_down(x: f64) -> f32 {
    let rounded = x as f32;
    if f64::from(rounded) > x { rounded.next_down() } else { rounded }
}

/// Rounds up to single precision.
pub(super) fn round_up(x: f64) -> f32 {
    let rounded = x as f32;
    if f64::from(rounded) < x { rounded.next_up() } else { rounded }
}
