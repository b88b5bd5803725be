//! Layouts: which texels of an image fragments read. That depends on its size and its sampler and not on its texels, so that
//! the textures of a material, which are most often alike in both, share it.

use model::{MipmapMode, Sampler, TextureFilter, WrapMode};

/// All of a texture that decides where it is read.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct TexelAddressing {
    /// Texels of a row and of a column of the full image.
    pub(super) width: i32,
    pub(super) height: i32,
    /// The number of the smallest level; the full image is level 0, and each has half the size of the one before.
    pub(super) last_level: i32,
    pub(super) sampler: Sampler,
}

/// Which levels each lane reads: number 0 is the full image magnified, number n level n − 1 reduced. The colour is that of
/// `near`, with a share of `far`.
#[derive(Clone, Copy, Debug)]
pub(super) struct LevelOfDetail<const N: usize> {
    pub(super) near_levels: [i32; N],
    pub(super) far_levels: [i32; N],
    pub(super) far_weights: [f32; N],
    /// Whether `far` counts in any lane.
    pub(super) is_trilinear: bool,
}

/// The four texels around a place on some level, which is each lane's own.
#[derive(Clone, Copy, Debug)]
pub(super) struct TexelQuads<const N: usize> {
    pub(super) levels: [i32; N],
    /// The texels' numbers in their level: the two of the upper row, and the two of the lower one.
    pub(super) texels: [[i32; N]; 4],
    /// How far the place is from the left texels to the right ones, and from the upper to the lower.
    pub(super) column_fractions: [f32; N],
    pub(super) row_fractions: [f32; N],
    /// Whether only the first of the four counts, in all lanes.
    pub(super) are_nearest: bool,
}

impl TexelAddressing {
    /// Whether it matters how many texels a pixel covers.
    #[inline(always)]
    fn needs_derivatives(&self) -> bool {
        self.last_level > 0 || self.sampler.mag_filter != self.sampler.min_filter
    }

    /// The levels for these derivatives of the texture coordinates by the pixel's column and row.
    #[inline(always)]
    pub(super) fn select_levels<const N: usize>(
        &self,
        [right, below]: &[[[f32; N]; 2]; 2],
    ) -> LevelOfDetail<N> {
        let mut choice = LevelOfDetail {
            near_levels: [1; N],
            far_levels: [1; N],
            far_weights: [0.0; N],
            is_trilinear: false,
        };
        if !self.needs_derivatives() {
            return choice;
        }
        let Sampler { mag_filter: magnify, min_filter: minify, mipmap_mode: mipmap, .. } =
            self.sampler;
        let (width, height) = (self.width as f32, self.height as f32);
        let round = if mipmap == MipmapMode::Nearest { 0.5 } else { 0.0 };
        for lane in 0..N {
            let (ru, rv) = (right[0][lane] * width, right[1][lane] * height);
            let (bu, bv) = (below[0][lane] * width, below[1][lane] * height);
            // The texels that a pixel covers along its longer side, squared.
            let squared = (ru * ru + rv * rv).max(bu * bu + bv * bv);
            let is_reduced = (squared > 1.0) & (squared < f32::INFINITY);
            let detail = 0.5 * log2_approx(if is_reduced { squared } else { 1.0 });
            let level = ((detail + round) as i32).min(self.last_level);
            let is_between = (mipmap == MipmapMode::Linear) & (level < self.last_level);
            let is_magnified = (magnify != minify) & (detail <= 0.0);
            let near = if is_magnified { 0 } else { 1 + level };
            let share = if is_between { detail - level as f32 } else { 0.0 };
            choice.near_levels[lane] = near;
            choice.far_levels[lane] = near + i32::from(share > 0.0);
            choice.far_weights[lane] = share;
            choice.is_trilinear |= share > 0.0;
        }
        choice
    }

    /// The cells of the levels with these numbers at a place.
    #[inline(always)]
    pub(super) fn locate_texels<const N: usize>(
        &self,
        numbers: &[i32; N],
        [u, v]: &[[f32; N]; 2],
    ) -> TexelQuads<N> {
        let Sampler { wrap_u, wrap_v, mag_filter: magnify, min_filter: minify, .. } = self.sampler;
        let (magnified, reduced) =
            (magnify == TextureFilter::Linear, minify == TextureFilter::Linear);
        let (mut levels, mut are_linear) = ([0; N], [false; N]);
        for lane in 0..N {
            levels[lane] = (numbers[lane] - 1).max(0);
            are_linear[lane] = if numbers[lane] == 0 { magnified } else { reduced };
        }
        let columns = TexelAxis::locate(u, self.width, &levels, &are_linear, wrap_u);
        let rows = TexelAxis::locate(v, self.height, &levels, &are_linear, wrap_v);
        let mut texels = [[0; N]; 4];
        for lane in 0..N {
            let upper = rows.first[lane] * columns.sizes[lane];
            let lower = rows.second[lane] * columns.sizes[lane];
            texels[0][lane] = upper + columns.first[lane];
            texels[1][lane] = upper + columns.second[lane];
            texels[2][lane] = lower + columns.first[lane];
            texels[3][lane] = lower + columns.second[lane];
        }
        let are_nearest = !magnified && !reduced;
        TexelQuads {
            levels,
            texels,
            column_fractions: columns.fractions,
            row_fractions: rows.fractions,
            are_nearest,
        }
    }
}

/// Where lanes are among the texels of a row or a column: between which two, and how far from the first to the second.
struct TexelAxis<const N: usize> {
    sizes: [i32; N],
    first: [i32; N],
    second: [i32; N],
    fractions: [f32; N],
}

impl<const N: usize> TexelAxis<N> {
    /// The axis of an image of a size, on a level of each lane; those that are not linear are on a texel.
    #[inline(always)]
    fn locate(
        coordinates: &[f32; N],
        size: i32,
        levels: &[i32; N],
        are_linear: &[bool; N],
        wrap: WrapMode,
    ) -> Self {
        let (mut sizes, mut first, mut second) = ([0; N], [0; N], [0; N]);
        let mut fractions = [0.0; N];
        for lane in 0..N {
            sizes[lane] = (size >> levels[lane]).max(1);
            let to_center = if are_linear[lane] { 0.5 } else { 0.0 };
            let x = coordinates[lane] * sizes[lane] as f32 - to_center;
            let cell = floor_to_int(x);
            first[lane] = cell;
            second[lane] = cell + 1;
            fractions[lane] = if are_linear[lane] { x - cell as f32 } else { 0.0 };
        }
        // Halves of a power of two are powers of two.
        let are_powers = size & (size - 1) == 0;
        let first = wrap_texels(&first, &sizes, are_powers, wrap);
        let second = wrap_texels(&second, &sizes, are_powers, wrap);
        Self { sizes, first, second, fractions }
    }
}

/// The largest whole number not above `x`; coordinates beyond a texture's reach stay in range.
#[inline(always)]
fn floor_to_int(x: f32) -> i32 {
    let cut = x.clamp(-1e9, 1e9) as i32;
    cut - i32::from((cut as f32) > x)
}

/// The texels that are shown in place of those with these numbers in rows of these sizes.
#[inline(always)]
fn wrap_texels<const N: usize>(
    cells: &[i32; N],
    sizes: &[i32; N],
    are_powers: bool,
    mode: WrapMode,
) -> [i32; N] {
    let mut wrapped = *cells;
    if mode == WrapMode::ClampToEdge {
        for lane in 0..N {
            wrapped[lane] = cells[lane].max(0).min(sizes[lane] - 1);
        }
        return wrapped;
    }
    let times = if mode == WrapMode::MirroredRepeat { 2 } else { 1 };
    if are_powers {
        for lane in 0..N {
            wrapped[lane] &= times * sizes[lane] - 1;
        }
    } else {
        let mut are_inside = true;
        for lane in 0..N {
            are_inside &= (cells[lane] >= 0) & (cells[lane] < times * sizes[lane]);
        }
        if !are_inside {
            for lane in 0..N {
                wrapped[lane] = cells[lane].rem_euclid(times * sizes[lane]);
            }
        }
    }
    if mode == WrapMode::MirroredRepeat {
        for lane in 0..N {
            wrapped[lane] = wrapped[lane].min(2 * sizes[lane] - 1 - wrapped[lane]);
        }
    }
    wrapped
}

/// The base-2 logarithm of a normal number not below 1, to about six digits: enough to mix levels by.
#[inline(always)]
fn log2_approx(x: f32) -> f32 {
    // log2(1 + t) / t between 0 and 1, fitted at the zeros of a Chebyshev polynomial.
    const FIT: [f32; 7] = [
        1.442_693_2,
        -0.721_162_74,
        0.477_705_93,
        -0.339_247_76,
        0.215_588_54,
        -0.096_066_25,
        0.020_490_346,
    ];
    let bits = x.to_bits();
    let exponent = (bits >> 23) as i32 - 127;
    let t = f32::from_bits(bits & 0x007f_ffff | 0x3f80_0000) - 1.0;
    let mut sum = FIT[6];
    for k in (0..6).rev() {
        sum = sum * t + FIT[k];
    }
    exponent as f32 + sum * t
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_outside_the_image_are_wrapped() {
        let row = |mode, size: i32| {
            let is_power = size & (size - 1) == 0;
            (-5..6).map(|at| wrap_texels(&[at], &[size], is_power, mode)[0]).collect::<Vec<_>>()
        };
        assert_eq!(row(WrapMode::Repeat, 3), [1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2]);
        assert_eq!(row(WrapMode::ClampToEdge, 3), [0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2]);
        assert_eq!(row(WrapMode::MirroredRepeat, 3), [1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0]);
        assert_eq!(row(WrapMode::Repeat, 2), [1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1]);
        assert_eq!(row(WrapMode::MirroredRepeat, 2), [0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1]);
        for mode in [WrapMode::Repeat, WrapMode::ClampToEdge, WrapMode::MirroredRepeat] {
            assert_eq!(row(mode, 1), [0; 11]);
        }
    }

    #[test]
    fn logarithms_are_right_to_six_digits() {
        assert_eq!(log2_approx(1.0), 0.0);
        for step in 0..100_000 {
            let x = 1.0 + step as f32 * step as f32 * 0.01;
            let exact = libm::log2(f64::from(x));
            assert!((f64::from(log2_approx(x)) - exact).abs() < 3e-6 + exact * 1e-7, "{x}");
        }
    }
}
