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

use super::addressing::{LevelOfDetail, TexelAddressing, TexelQuads};

/// How lanes read textures of one layout: places along a line, and what each place stands for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Footprint<const N: usize> {
    /// The middle of the line, in texture coordinates.
    center: [[f32; N]; 2],
    /// How many places.
    tap_counts: [f32; N],
    /// The line in texture coordinates, from end to end.
    major_axis: [[f32; N]; 2],
    /// The levels that are read at each place.
    lod: LevelOfDetail<N>,
}

/// One of the places, in all lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tap<const N: usize> {
    /// The cells of its level, and those of the level behind.
    pub(super) cells: [TexelQuads<N>; 2],
    /// How many of the two count.
    pub(super) level_count: usize,
    /// How much they count against those before.
    pub(super) level_weights: [[f32; N]; 2],
    /// How much the place counts: nothing in lanes that have fewer.
    pub(super) tap_weights: [f32; N],
}

impl<const N: usize> Footprint<N> {
    /// The number of places in the lane that has most.
    #[inline(always)]
    pub(crate) fn max_tap_count(&self) -> u32 {
        let mut count = 1.0_f32;
        for taps in self.tap_counts {
            count = count.max(taps);
        }
        count as u32
    }

    /// The place with this number, from 0 on.
    #[inline(always)]
    pub(crate) fn tap(&self, layout: &TexelAddressing, number: u32) -> Tap<N> {
        let number = number as f32;
        let (mut place, mut parts) = (self.center, [0.0; N]);
        for lane in 0..N {
            let along = (number + 0.5) / self.tap_counts[lane] - 0.5;
            parts[lane] =
                if number < self.tap_counts[lane] { 1.0 / self.tap_counts[lane] } else { 0.0 };
            for axis in 0..2 {
                place[axis][lane] += self.major_axis[axis][lane] * along;
            }
        }
        let LevelOfDetail {
            near_levels: near,
            far_levels: far,
            far_weights: share,
            is_trilinear: is_mixed,
        } = &self.lod;
        let near = layout.locate_texels(near, &place);
        let (mut cells, mut count) = ([near; 2], 1);
        if *is_mixed {
            cells[1] = layout.locate_texels(far, &place);
            count = 2;
        }
        Tap { cells, level_count: count, level_weights: [[1.0; N], *share], tap_weights: parts }
    }
}

impl TexelAddressing {
    /// The footprints of pixels at `uvs[0]`, with the derivatives `uvs[1]` by the column and `uvs[2]` by the row, as at most
    /// so many places.
    #[inline(always)]
    pub(crate) fn footprint<const N: usize>(
        &self,
        [middle, right, below]: &[[[f32; N]; 2]; 3],
        most: u32,
    ) -> Footprint<N> {
        let (mut taps, mut line) = ([1.0; N], [[0.0; N]; 2]);
        let mut steps = [*right, *below];
        if most > 1 && self.last_level > 0 {
            self.fit_anisotropy(most as f32, &mut taps, &mut line, &mut steps);
        }
        Footprint {
            center: *middle,
            tap_counts: taps,
            major_axis: line,
            lod: self.select_levels(&steps),
        }
    }

    /// Lays long footprints along a line, and leaves steps that stand for each place of it.
    ///
    /// The axes of the ellipse that a pixel covers are those of J Jᵀ: J, its derivatives in texels, maps the unit circle to it.
    #[inline(always)]
    fn fit_anisotropy<const N: usize>(
        &self,
        most: f32,
        taps: &mut [f32; N],
        line: &mut [[f32; N]; 2],
        [right, below]: &mut [[[f32; N]; 2]; 2],
    ) {
        let (width, height) = (self.width as f32, self.height as f32);
        for lane in 0..N {
            let (ru, rv) = (right[0][lane] * width, right[1][lane] * height);
            let (bu, bv) = (below[0][lane] * width, below[1][lane] * height);
            let (uu, vv, uv) = (ru * ru + bu * bu, rv * rv + bv * bv, ru * rv + bu * bv);
            let (sum, area) = (uu + vv, ru * bv - rv * bu);
            let root = ((uu - vv) * (uu - vv) + 4.0 * uv * uv).sqrt();
            let longer = (0.5 * (sum + root)).sqrt();
            let shorter = area.abs() / longer;
            // What is no larger than a texel is read as it is.
            let count = floor_positive(longer / shorter.max(1.0) + 0.5).min(most);
            let is_long = (count > 1.0) & (longer < 1e6);
            // The longer axis is an eigenvector; of its two forms the one that does not vanish.
            let x = if uu > vv { 0.5 * (uu - vv + root) } else { uv };
            let y = if uu > vv { uv } else { 0.5 * (vv - uu + root) };
            let per = 1.0 / (x * x + y * y).sqrt();
            let (x, y) = (x * per / width, y * per / height);
            let reach = (longer / count).max(shorter);
            taps[lane] = if is_long { count } else { 1.0 };
            line[0][lane] = if is_long { x * longer } else { 0.0 };
            line[1][lane] = if is_long { y * longer } else { 0.0 };
            right[0][lane] = if is_long { x * reach } else { right[0][lane] };
            right[1][lane] = if is_long { y * reach } else { right[1][lane] };
            below[0][lane] = if is_long { 0.0 } else { below[0][lane] };
            below[1][lane] = if is_long { 0.0 } else { below[1][lane] };
        }
    }
}

/// The largest whole number not above a positive one; numbers too large for it are out of use here.
#[inline(always)]
fn floor_positive(x: f32) -> f32 {
    x.clamp(0.0, 1e6) as i32 as f32
}

#[cfg(test)]
mod tests {
    use crate::{MipChain, TexelEncoding};
    use model::{Image, Sampler};

    #[test]
    fn a_long_footprint_is_the_ellipse_of_its_derivatives() {
        let image = Image { width: 64, height: 64, rgba: vec![[0; 4]; 64 * 64] };
        let chain = MipChain::new(&image, Sampler::default(), TexelEncoding::Linear);
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
            let (mut taps, mut line, mut steps) = ([1.0], [[0.0]; 2], [uvs[1], uvs[2]]);
            chain.addressing().fit_anisotropy(8.0, &mut taps, &mut line, &mut steps);
            assert_eq!(taps, [4.0]);
            let [[x], [y]] = line;
            let [due_x, due_y] = rotated(12.0, 0.0, turn);
            let across = x * due_y - y * due_x;
            assert!(across.abs() < 1e-3 && ((x * x + y * y).sqrt() * 64.0 - 12.0).abs() < 1e-3);
            let [[x], [y]] = steps[0];
            assert!(((x * x + y * y).sqrt() * 64.0 - 3.0).abs() < 1e-3);
        }
    }
}
