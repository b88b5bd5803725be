//! Reading textures, in all lanes at once.

use super::{Level, MipChain};
use crate::model::{Filter, Mipmap, Sampler, Wrap};

/// Which levels each lane reads: number 0 is the full image magnified, number n level n − 1 reduced. The colour is that of
/// `near`, with a share of `far`.
struct Choice<const N: usize> {
    near: [i32; N],
    far: [i32; N],
    share: [f32; N],
}

impl MipChain<'_> {
    /// Whether it matters how many texels a pixel covers.
    #[inline(always)]
    pub(in crate::shade) fn wants_derivatives(&self) -> bool {
        self.levels.len() > 1 || self.sampler.magnify != self.sampler.minify
    }

    /// The texture's colours, linear with straight alpha, at `uvs[0]`; `uvs[1]` and `uvs[2]` are the derivatives by the
    /// pixel's column and row, which say how many texels a pixel covers. Alpha is 1 if it does not count.
    #[inline(always)]
    pub(in crate::shade) fn sample<const N: usize>(
        &self,
        uvs: &[[[f32; N]; 2]; 3],
        alpha_counts: bool,
    ) -> [[f32; N]; 4] {
        let Choice { near, far, share } = self.choice(uvs);
        let (mut least, mut greatest) = (near[0], far[0]);
        for lane in 1..N {
            least = least.min(near[lane]);
            greatest = greatest.max(far[lane]);
        }
        let (mut colors, mut behind) = ([[0.0; N]; 4], [[0.0; N]; 4]);
        for number in least..=greatest {
            let (mut is_near, mut is_far) = ([false; N], [false; N]);
            let mut is_read = false;
            for lane in 0..N {
                is_near[lane] = near[lane] == number;
                is_far[lane] = far[lane] == number;
                is_read |= is_near[lane] | is_far[lane];
            }
            if !is_read {
                continue;
            }
            let texels = self.read(number, &uvs[0], alpha_counts);
            for k in 0..4 {
                for lane in 0..N {
                    let texel = texels[k][lane];
                    colors[k][lane] = if is_near[lane] { texel } else { colors[k][lane] };
                    behind[k][lane] = if is_far[lane] { texel } else { behind[k][lane] };
                }
            }
        }
        mix(&mut colors, &behind, &share);
        colors
    }

    /// The levels that each lane reads.
    #[inline(always)]
    fn choice<const N: usize>(&self, [_, right, below]: &[[[f32; N]; 2]; 3]) -> Choice<N> {
        let mut choice = Choice { near: [1; N], far: [1; N], share: [0.0; N] };
        if !self.wants_derivatives() {
            return choice;
        }
        let Sampler { magnify, minify, mipmap, .. } = self.sampler;
        let last = self.levels.len() as i32 - 1;
        let (width, height) = (self.levels[0].width as f32, self.levels[0].height as f32);
        let round = if mipmap == Mipmap::Nearest { 0.5 } else { 0.0 };
        for lane in 0..N {
            let (ru, rv) = (right[0][lane] * width, right[1][lane] * height);
            let (bu, bv) = (below[0][lane] * width, below[1][lane] * height);
            // The texels that a pixel covers along its longer side, squared.
            let squared = (ru * ru + rv * rv).max(bu * bu + bv * bv);
            let is_reduced = squared > 1.0 && squared < f32::INFINITY;
            let detail = if is_reduced { 0.5 * log2(squared) } else { 0.0 };
            let level = ((detail + round) as i32).min(last);
            let is_between = mipmap == Mipmap::Linear && level < last;
            let share = if is_between { detail - level as f32 } else { 0.0 };
            let is_magnified = magnify != minify && detail <= 0.0;
            let near = if is_magnified { 0 } else { 1 + level };
            choice.near[lane] = near;
            choice.far[lane] = near + i32::from(share > 0.0);
            choice.share[lane] = share;
        }
        choice
    }

    /// The texels of one of the numbers of a [`Choice`].
    #[inline(always)]
    fn read<const N: usize>(
        &self,
        number: i32,
        [u, v]: &[[f32; N]; 2],
        alpha_counts: bool,
    ) -> [[f32; N]; 4] {
        let level = &self.levels[(number - 1).max(0) as usize];
        let Sampler { wrap_u, wrap_v, magnify, minify, .. } = self.sampler;
        let filter = if number == 0 { magnify } else { minify };
        let to_center = if filter == Filter::Linear { 0.5 } else { 0.0 };
        let (left, s) = split(u, level.width, to_center);
        let (top, t) = split(v, level.height, to_center);
        let fetch = Fetch { level, to_linear: self.to_linear, alpha_counts };
        let columns = wrapped(&left, level.width, wrap_u);
        let rows = wrapped(&top, level.height, wrap_v);
        let mut colors = fetch.colors(&columns, &rows);
        if filter == Filter::Linear {
            let next_columns = wrapped(&next(&left), level.width, wrap_u);
            let next_rows = wrapped(&next(&top), level.height, wrap_v);
            mix(&mut colors, &fetch.colors(&next_columns, &rows), &s);
            let mut lower = fetch.colors(&columns, &next_rows);
            mix(&mut lower, &fetch.colors(&next_columns, &next_rows), &s);
            mix(&mut colors, &lower, &t);
        }
        colors
    }
}

/// What single texels are fetched from.
struct Fetch<'a> {
    level: &'a Level<'a>,
    to_linear: &'static [f32; 256],
    alpha_counts: bool,
}

impl Fetch<'_> {
    #[inline(always)]
    fn colors<const N: usize>(&self, columns: &[i32; N], rows: &[i32; N]) -> [[f32; N]; 4] {
        let mut colors = [[1.0; N]; 4];
        let mut alphas = [0; N];
        let texels: &[[u8; 4]] = &self.level.texels;
        for lane in 0..N {
            let [r, g, b, a] = texels[(rows[lane] * self.level.width + columns[lane]) as usize];
            colors[0][lane] = self.to_linear[usize::from(r)];
            colors[1][lane] = self.to_linear[usize::from(g)];
            colors[2][lane] = self.to_linear[usize::from(b)];
            alphas[lane] = i32::from(a);
        }
        if self.alpha_counts {
            for lane in 0..N {
                colors[3][lane] = alphas[lane] as f32 / 255.0;
            }
        }
        colors
    }
}

/// The whole and the broken part of coordinates in texels, counted from `to_center` on.
#[inline(always)]
fn split<const N: usize>(
    coordinates: &[f32; N],
    size: i32,
    to_center: f32,
) -> ([i32; N], [f32; N]) {
    let (mut cells, mut rests) = ([0; N], [0.0; N]);
    for lane in 0..N {
        let x = coordinates[lane] * size as f32 - to_center;
        cells[lane] = floor(x);
        rests[lane] = x - cells[lane] as f32;
    }
    (cells, rests)
}

/// The largest whole number not above `x`; coordinates beyond a texture's reach stay in range.
#[inline(always)]
fn floor(x: f32) -> i32 {
    let cut = x.clamp(-1e9, 1e9) as i32;
    cut - i32::from((cut as f32) > x)
}

#[inline(always)]
fn next<const N: usize>(cells: &[i32; N]) -> [i32; N] {
    let mut next = *cells;
    for cell in &mut next {
        *cell += 1;
    }
    next
}

/// Moves colours by a share of the way to others.
#[inline(always)]
fn mix<const N: usize>(from: &mut [[f32; N]; 4], to: &[[f32; N]; 4], share: &[f32; N]) {
    for (from, to) in from.iter_mut().zip(to) {
        for lane in 0..N {
            from[lane] += (to[lane] - from[lane]) * share[lane];
        }
    }
}

/// The texels that are shown in place of those with these numbers in a row of `size`.
#[inline(always)]
fn wrapped<const N: usize>(cells: &[i32; N], size: i32, mode: Wrap) -> [i32; N] {
    let mut wrapped = *cells;
    let period = if mode == Wrap::Mirror { 2 * size } else { size };
    if mode == Wrap::Clamp {
        for cell in &mut wrapped {
            *cell = (*cell).clamp(0, size - 1);
        }
        return wrapped;
    }
    if size & (size - 1) == 0 {
        for cell in &mut wrapped {
            *cell &= period - 1;
        }
    } else {
        let mut is_inside = true;
        for cell in wrapped {
            is_inside &= (0..period).contains(&cell);
        }
        if !is_inside {
            for cell in &mut wrapped {
                *cell = cell.rem_euclid(period);
            }
        }
    }
    if mode == Wrap::Mirror {
        for cell in &mut wrapped {
            *cell = (*cell).min(period - 1 - *cell);
        }
    }
    wrapped
}

/// The base-2 logarithm of a normal number above 1, to about six digits: enough to mix levels by.
#[inline(always)]
fn log2(x: f32) -> f32 {
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
        let row = |mode, size| (-5..6).map(|at| wrapped(&[at], size, mode)[0]).collect::<Vec<_>>();
        assert_eq!(row(Wrap::Repeat, 3), [1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2]);
        assert_eq!(row(Wrap::Clamp, 3), [0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2]);
        assert_eq!(row(Wrap::Mirror, 3), [1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0]);
        assert_eq!(row(Wrap::Repeat, 2), [1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1]);
        assert_eq!(row(Wrap::Mirror, 2), [0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1]);
        for mode in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
            assert_eq!(row(mode, 1), [0; 11]);
        }
    }

    #[test]
    fn logarithms_are_right_to_six_digits() {
        for step in 0..100_000 {
            let x = 1.0 + step as f32 * step as f32 * 0.01;
            let exact = libm::log2(f64::from(x));
            assert!((f64::from(log2(x)) - exact).abs() < 3e-6 + exact * 1e-7, "{x}");
        }
    }
}
