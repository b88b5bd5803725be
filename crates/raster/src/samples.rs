//! Multisampling: the positions in a pixel at which coverage and depth are sampled.

use crate::screen_vertex::SUBPIXELS;

/// The number of coverage samples per pixel (multisample antialiasing).
///
/// Coverage and depth are determined at every sample; each visible surface is still shaded once per
/// pixel. The patterns are the standard patterns of Direct3D 11; the one with sixteen samples is
/// moved by 1/32 pixel, so that its samples, like the others, are balanced around the center.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Samples {
    /// One sample at the center of the pixel: no antialiasing.
    One,
    /// Four samples on a rotated grid.
    #[default]
    Four,
    /// Eight samples.
    Eight,
    /// Sixteen samples.
    Sixteen,
}

// Offsets from the center of the pixel in 1/16 pixel. No two samples of a pattern share a row or a
// column, so nearly horizontal and nearly vertical edges get as many steps as there are samples.
const ONE: [(i32, i32); 1] = [(0, 0)];
const FOUR: [(i32, i32); 4] = [(-4, -12), (12, -4), (-12, 4), (4, 12)];
const EIGHT: [(i32, i32); 8] =
    [(2, -6), (-2, 6), (10, 2), (-6, -10), (-10, 10), (-14, -2), (6, 14), (14, -14)];
const SIXTEEN: [(i32, i32); 16] = [
    (3, 3),
    (-1, -5),
    (-5, 5),
    (9, -1),
    (-9, -3),
    (5, 11),
    (11, 7),
    (7, -9),
    (-3, 13),
    (1, -13),
    (-7, -11),
    (-11, 9),
    (-15, 1),
    (15, -7),
    (13, 15),
    (-13, -15),
];

impl Samples {
    /// Returns the pattern with `count` samples, or `None` if `count` is not 1, 4, 8 or 16.
    #[must_use]
    pub const fn from_count(count: u32) -> Option<Self> {
        match count {
            1 => Some(Self::One),
            4 => Some(Self::Four),
            8 => Some(Self::Eight),
            16 => Some(Self::Sixteen),
            _ => None,
        }
    }

    /// Returns the number of samples per pixel.
    #[must_use]
    pub const fn count(self) -> usize {
        self.thirty_seconds().len()
    }

    /// Returns the offsets of the samples from the center of the pixel, in 1/32 pixel.
    const fn thirty_seconds(self) -> &'static [(i32, i32)] {
        match self {
            Self::One => &ONE,
            Self::Four => &FOUR,
            Self::Eight => &EIGHT,
            Self::Sixteen => &SIXTEEN,
        }
    }

    /// Returns the minimum and maximum offsets of a sample from the left or upper border of its
    /// pixel, in grid steps.
    pub(crate) fn offset_range(self) -> (i32, i32) {
        let all = self.thirty_seconds().iter().flat_map(|&(x, y)| [x, y]);
        let (least, greatest) =
            all.fold((0, 0), |(least, greatest), c| (c.min(least), c.max(greatest)));
        (SUBPIXELS / 2 + least * (SUBPIXELS / 32), SUBPIXELS / 2 + greatest * (SUBPIXELS / 32))
    }

    /// Returns the offsets of all samples: see [`sample_offset`](Self::sample_offset).
    pub(crate) fn sample_offsets(self) -> impl Iterator<Item = (i64, i64)> {
        (0..self.count()).map(move |sample| self.sample_offset(sample))
    }

    /// Returns the position of the first sample in pixels from the upper left corner of its pixel:
    /// (½, ½) with one sample.
    #[must_use]
    pub fn first_offset(self) -> [f32; 2] {
        let (x, y) = self.sample_offset(0);
        [x, y].map(|steps| steps as f32 / SUBPIXELS as f32)
    }

    /// Returns the offset of a sample from the upper left corner of its pixel, in grid steps.
    #[inline(always)]
    pub(crate) fn sample_offset(self, sample: usize) -> (i64, i64) {
        let (x, y) = grid_offset(self.thirty_seconds()[sample]);
        (i64::from(x), i64::from(y))
    }

    /// Returns the offsets of all samples from the upper left corner of their pixel, in grid steps.
    #[inline(always)]
    pub(crate) fn grid_offsets(self) -> impl Iterator<Item = (i32, i32)> {
        self.thirty_seconds().iter().map(|sample| grid_offset(*sample))
    }
}

/// Converts an offset from the center of the pixel in 1/16 pixel to an offset from its upper left
/// corner in grid steps. This is exact, because 1/16 pixel is 16 grid steps.
#[inline(always)]
const fn grid_offset(from_center: (i32, i32)) -> (i32, i32) {
    let (x, y) = from_center;
    (SUBPIXELS / 2 + x * (SUBPIXELS / 32), SUBPIXELS / 2 + y * (SUBPIXELS / 32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_inside_their_pixel_in_distinct_rows_and_columns() {
        for samples in [Samples::One, Samples::Four, Samples::Eight, Samples::Sixteen] {
            let offsets: Vec<_> = samples.sample_offsets().collect();
            for (i, a) in offsets.iter().enumerate() {
                assert!((0..256).contains(&a.0) && (0..256).contains(&a.1), "{a:?}");
                for b in &offsets[..i] {
                    assert!(a.0 != b.0 && a.1 != b.1, "{samples:?}: {a:?} and {b:?}");
                }
            }
        }
    }

    #[test]
    fn the_mean_sample_is_the_center_of_the_pixel() {
        for samples in [Samples::One, Samples::Four, Samples::Eight, Samples::Sixteen] {
            let sum = samples.sample_offsets().fold((0, 0), |sum, at| (sum.0 + at.0, sum.1 + at.1));
            let center = samples.count() as i64 * i64::from(SUBPIXELS / 2);
            assert_eq!(sum, (center, center), "{samples:?}");
        }
    }
}
