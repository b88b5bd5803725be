//! The footprint of a pixel on a texture, and reading a texture along it.
//!
//! ```text
//!      ┌──────────────╱╱╲      a pixel's image on the texture is about an ellipse: where a floor runs
//!      │       ●  ●  ●  ╱      away from the viewer a long one, and one level of the mip chain is too
//!      │    ●  ●  ●    ╱       blurred across it or too sharp along it
//!      ╲╲_____________╱
//! ```
//!
//! So it is read at several places along the longer axis, on the level whose texels are as large as the shorter one (Heckbert,
//! *Fundamentals of texture mapping and image warping*, 1989; McCormack and others, *Feline*, 1999).

use super::MipChain;

/// How lanes read a texture: places along a line, and what each place stands for.
struct Footprint<const N: usize> {
    /// How many places.
    taps: [f32; N],
    /// The line in texture coordinates, from end to end.
    line: [[f32; N]; 2],
    /// The derivatives that choose the level.
    steps: [[[f32; N]; 2]; 2],
}

impl MipChain<'_> {
    /// As [`sample`](Self::sample), at up to `most` places along the longer axis of each pixel's footprint.
    #[inline(always)]
    pub(in crate::shade) fn sample_along<const N: usize>(
        &self,
        uvs: &[[[f32; N]; 2]; 3],
        alpha_counts: bool,
        most: u32,
    ) -> [[f32; N]; 4] {
        if most <= 1 || self.levels.len() == 1 {
            return self.sample(uvs, alpha_counts);
        }
        let footprint = self.footprint(uvs, most as f32);
        let mut count = 1.0_f32;
        for taps in footprint.taps {
            count = count.max(taps);
        }
        if count == 1.0 {
            return self.sample(uvs, alpha_counts);
        }
        self.mean(uvs, alpha_counts, &footprint, count as u32)
    }

    /// The mean of what is read at the places of a footprint, `count` in the lane that has most.
    #[inline(always)]
    fn mean<const N: usize>(
        &self,
        uvs: &[[[f32; N]; 2]; 3],
        alpha_counts: bool,
        footprint: &Footprint<N>,
        count: u32,
    ) -> [[f32; N]; 4] {
        let Footprint { taps, line, steps } = footprint;
        let mut sums = [[0.0; N]; 4];
        for tap in 0..count {
            let mut places = [uvs[0], steps[0], steps[1]];
            for lane in 0..N {
                let along = (tap as f32 + 0.5) / taps[lane] - 0.5;
                for axis in 0..2 {
                    places[0][axis][lane] += line[axis][lane] * along;
                }
            }
            let texels = self.sample(&places, alpha_counts);
            for lane in 0..N {
                let share = if (tap as f32) < taps[lane] { 1.0 / taps[lane] } else { 0.0 };
                for channel in 0..4 {
                    sums[channel][lane] += texels[channel][lane] * share;
                }
            }
        }
        sums
    }

    /// The axes of the ellipse that a pixel covers, from its derivatives in texels: J of the unit circle has the axes of J Jᵀ.
    #[inline(always)]
    fn footprint<const N: usize>(&self, uvs: &[[[f32; N]; 2]; 3], most: f32) -> Footprint<N> {
        let (width, height) = (self.levels[0].width as f32, self.levels[0].height as f32);
        let mut footprint =
            Footprint { taps: [1.0; N], line: [[0.0; N]; 2], steps: [uvs[1], uvs[2]] };
        for lane in 0..N {
            let (ru, rv) = (uvs[1][0][lane] * width, uvs[1][1][lane] * height);
            let (bu, bv) = (uvs[2][0][lane] * width, uvs[2][1][lane] * height);
            let (uu, vv, uv) = (ru * ru + bu * bu, rv * rv + bv * bv, ru * rv + bu * bv);
            let (sum, area) = (uu + vv, ru * bv - rv * bu);
            let root = ((uu - vv) * (uu - vv) + 4.0 * uv * uv).sqrt();
            let longer = (0.5 * (sum + root)).sqrt();
            let shorter = area.abs() / longer;
            // What is no larger than a texel is read as it is.
            let taps = floor(longer / shorter.max(1.0) + 0.5).min(most);
            if !(taps > 1.0 && longer < 1e6) {
                continue;
            }
            // The longer axis is an eigenvector; of its two forms the one that does not vanish.
            let (x, y) =
                if uu > vv { (0.5 * (uu - vv + root), uv) } else { (uv, 0.5 * (vv - uu + root)) };
            let per = 1.0 / (x * x + y * y).sqrt();
            let (x, y) = (x * per / width, y * per / height);
            let reach = (longer / taps).max(shorter);
            footprint.taps[lane] = taps;
            footprint.line[0][lane] = x * longer;
            footprint.line[1][lane] = y * longer;
            footprint.steps[0][0][lane] = x * reach;
            footprint.steps[0][1][lane] = y * reach;
            footprint.steps[1][0][lane] = 0.0;
            footprint.steps[1][1][lane] = 0.0;
        }
        footprint
    }
}

/// The largest whole number not above a positive one; numbers too large for it are out of use here.
#[inline(always)]
fn floor(x: f32) -> f32 {
    x.clamp(0.0, 1e6) as i32 as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Image, Sampler};
    use crate::shade::Texels;

    #[test]
    fn a_long_footprint_is_the_ellipse_of_its_derivatives() {
        let image = Image { width: 64, height: 64, rgba: vec![[0; 4]; 64 * 64] };
        let chain = MipChain::new(&image, Sampler::default(), Texels::Linear);
        // Axes of 12 and 3 texels, turned by an angle; the pixel's own axes are turned too.
        for (turn, own) in [(0.0, 0.0), (0.4, 0.0), (1.2, 0.7), (2.5, 1.9), (1.5, 0.3)] {
            let rotated = |x: f32, y: f32, by: f32| {
                let (sine, cosine) = (libm::sinf(by), libm::cosf(by));
                [cosine * x - sine * y, sine * x + cosine * y]
            };
            let column = |x: f32, y: f32| {
                let [x, y] = rotated(x, y, own);
                rotated(12.0 * x, 3.0 * y, turn).map(|texels| [texels / 64.0])
            };
            let uvs = [[[0.0], [0.0]], column(1.0, 0.0), column(0.0, 1.0)];
            let footprint = chain.footprint(&uvs, 8.0);
            assert_eq!(footprint.taps, [4.0]);
            let [[x], [y]] = footprint.line;
            let [due_x, due_y] = rotated(12.0, 0.0, turn);
            let across = x * due_y - y * due_x;
            assert!(across.abs() < 1e-3 && ((x * x + y * y).sqrt() * 64.0 - 12.0).abs() < 1e-3);
            let [[x], [y]] = footprint.steps[0];
            assert!(((x * x + y * y).sqrt() * 64.0 - 3.0).abs() < 1e-3);
        }
    }
}
