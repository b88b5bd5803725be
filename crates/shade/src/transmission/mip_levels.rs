//! The mip levels of the transmission framebuffer, from full size to one texel, in floating point.
//!
//! ```text
//!   level 0      one texel per pixel, sampled bilinearly, so unblurred light stays sharp
//!   level 1 …    each texel is the mean of 2 × 2 in the previous level, sampled with a quadratic
//!                B-spline; bilinear sampling would show these large texels as diamonds
//! ```
//!
//! Texel (i, j) of level k covers the pixels starting at (i, j) · 2ᵏ. Halved sizes are rounded up,
//! so that levels are not shifted relative to each other. Alpha is premultiplied.

use raster::for_each_parallel;

/// A picture at full size, half size, quarter size and so on.
#[derive(Clone, Debug)]
pub(super) struct MipLevels {
    /// The levels from full size to a single texel.
    levels: Vec<FramebufferLevel>,
}

/// A mip level, with its texels in rows from the top.
#[derive(Clone, Debug)]
struct FramebufferLevel {
    /// The width and height in texels.
    size: [usize; 2],
    /// The inverse of the number of full-size pixels per texel along a side, a power of two.
    scale: f32,
    texels: Vec<[f32; 4]>,
}

impl MipLevels {
    /// Builds the levels of a picture of this size, with up to `threads` threads.
    pub(super) fn new(texels: Vec<[f32; 4]>, size: [u32; 2], threads: usize) -> Self {
        let size = size.map(|side| side as usize);
        let mut levels = vec![FramebufferLevel { size, scale: 1.0, texels }];
        while let Some(next) = levels.last().and_then(|level| level.downsample(threads)) {
            levels.push(next);
        }
        Self { levels }
    }

    /// Samples the mean around a position in full-size pixels, interpolated between levels.
    ///
    /// Positions beyond the border have the value at the border. `level` is 0 for the full size,
    /// and is clamped to the existing levels.
    #[inline(always)]
    pub(super) fn sample(&self, position: [f32; 2], level: f32) -> [f32; 4] {
        let level = level.max(0.0).min((self.levels.len() - 1) as f32);
        let near = level as usize;
        let fraction = level - near as f32;
        let mut value = match near {
            0 => self.levels[0].sample_bilinear(position),
            _ => self.levels[near].sample_spline(position),
        };
        if fraction > 0.0 {
            let far = self.levels[near + 1].sample_spline(position);
            for (value, far) in value.iter_mut().zip(far) {
                *value += (far - *value) * fraction;
            }
        }
        value
    }
}

impl FramebufferLevel {
    /// Computes the level of half the size with a box filter, or returns `None` for a single texel.
    /// A last row or column without a partner is paired with itself.
    fn downsample(&self, threads: usize) -> Option<Self> {
        let [width, height] = self.size;
        if self.texels.len() <= 1 {
            return None;
        }
        let size = [width.div_ceil(2), height.div_ceil(2)];
        let mut texels = vec![[0.0; 4]; size[0] * size[1]];
        let row = |y: usize| &self.texels[y * width..(y + 1) * width];
        for_each_parallel(threads, texels.chunks_mut(size[0]).enumerate(), |(y, target)| {
            let (upper, lower) = (row(2 * y), row((2 * y + 1).min(height - 1)));
            let pairs = upper.chunks(2).zip(lower.chunks(2));
            for (texel, (upper, lower)) in target.iter_mut().zip(pairs) {
                let last = upper.len() - 1;
                let (a, b, c, d) = (upper[0], upper[last], lower[0], lower[last]);
                *texel = [0, 1, 2, 3].map(|k: usize| ((a[k] + b[k]) + (c[k] + d[k])) * 0.25);
            }
        });
        Some(Self { size, scale: self.scale * 0.5, texels })
    }

    /// Interpolates bilinearly between texel centers.
    #[inline(always)]
    fn sample_bilinear(&self, position: [f32; 2]) -> [f32; 4] {
        let [width, height] = self.size;
        let (columns, s) = locate_pair(position[0] * self.scale, width);
        let (rows, t) = locate_pair(position[1] * self.scale, height);
        let mut sum = [0.0; 4];
        for (row, row_weight) in rows.into_iter().zip([1.0 - t, t]) {
            for (column, weight) in columns.into_iter().zip([1.0 - s, s]) {
                add_scaled(&mut sum, self.texels[row * width + column], row_weight * weight);
            }
        }
        sum
    }

    /// Evaluates the quadratic B-spline over 3 × 3 texels, which is smooth and nowhere negative,
    /// with weights that sum to 1.
    #[inline(always)]
    fn sample_spline(&self, position: [f32; 2]) -> [f32; 4] {
        let [width, height] = self.size;
        let (columns, column_weights) = locate_triple(position[0] * self.scale, width);
        let (rows, row_weights) = locate_triple(position[1] * self.scale, height);
        let mut sum = [0.0; 4];
        for (row, row_weight) in rows.into_iter().zip(row_weights) {
            for (column, weight) in columns.into_iter().zip(column_weights) {
                add_scaled(&mut sum, self.texels[row * width + column], row_weight * weight);
            }
        }
        sum
    }
}

/// Returns the two texels whose centers enclose a coordinate, and its fraction of the way between
/// them.
#[inline(always)]
fn locate_pair(coordinate: f32, count: usize) -> ([usize; 2], f32) {
    let from_center = (coordinate - 0.5).max(0.0).min((count - 1) as f32);
    let first = from_center as usize;
    ([first, (first + 1).min(count - 1)], from_center - first as f32)
}

/// Returns the three texels around a coordinate, and their weights in a quadratic B-spline.
#[inline(always)]
fn locate_triple(coordinate: f32, count: usize) -> ([usize; 3], [f32; 3]) {
    let inside = coordinate.max(0.0).min(count as f32);
    let middle = (inside as usize).min(count - 1);
    // The distance from the center of the middle texel, −½ to ½.
    let d = inside - middle as f32 - 0.5;
    let (before, after) = (0.5 - d, 0.5 + d);
    let weights = [0.5 * before * before, 0.75 - d * d, 0.5 * after * after];
    ([middle.saturating_sub(1), middle, (middle + 1).min(count - 1)], weights)
}

/// Adds a texel times a weight.
#[inline(always)]
fn add_scaled(sum: &mut [f32; 4], texel: [f32; 4], weight: f32) {
    for (sum, channel) in sum.iter_mut().zip(texel) {
        *sum += channel * weight;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniform_pictures_have_uniform_levels() {
        for size in [[1, 1], [7, 5], [64, 33]] {
            let levels = MipLevels::new(
                vec![[0.25, 3.0, 0.0, 1.0]; size[0] * size[1]],
                size.map(|side| side as u32),
                2,
            );
            for (x, y, level) in
                [(-3.0, 0.0, 0.0), (3.2, 2.9, 1.5), (99.0, 1.0, 9.0), (f32::NAN, 0.0, 2.0)]
            {
                let [r, g, b, alpha] = levels.sample([x, y], level);
                let is_near = (r - 0.25).abs() < 1e-6 && (g - 3.0).abs() < 1e-5;
                assert!(is_near && b == 0.0 && (alpha - 1.0).abs() < 1e-6, "{size:?} {x} {level}");
            }
        }
    }

    #[test]
    fn edge_blur_is_symmetric_and_widens_with_the_level() {
        let edge = |x: usize| if x < 64 { [0.0; 4] } else { [1.0; 4] };
        let levels = MipLevels::new((0..128 * 128).map(|n| edge(n % 128)).collect(), [128; 2], 1);
        let mut last = f32::INFINITY;
        for step in 0..=20 {
            let level = step as f32 * 0.25;
            let at = |x: f32| levels.sample([x, 50.0], level)[0];
            assert!((at(64.0) - 0.5).abs() < 1e-6, "{level}");
            assert!((at(64.0 + 7.0) + at(64.0 - 7.0) - 1.0).abs() < 1e-5, "{level}");
            let slope = at(64.5) - at(63.5);
            assert!(slope < last, "{level}: {slope} after {last}");
            last = slope;
        }
    }
}
