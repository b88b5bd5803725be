//! Texel addressing: the mip levels and texels that fragments read (Vulkan 1.3 §16.5–16.9).
//!
//! ```text
//!   derivatives ─► level of detail λ = log2(texels per pixel) ─► levels ⌊λ⌋ and ⌊λ⌋ + 1, fraction
//!   coordinates ─► texels of the level ─► wrap mode ─► four indices, fractions across and down
//! ```
//!
//! Addressing depends on the size and sampler of an image, not on its texels. The textures of a
//! material usually have the same size and sampler, so one computation serves all of them.

use crate::approximations::{floor_to_int, log2_approx};
use crate::lanes::Lanes;
use model::{MipmapMode, Sampler, TextureFilter, WrapMode};

/// The properties of a texture that determine which texels are read.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct TexelAddressing {
    /// Number of texels per row of the full image.
    pub(super) width: i32,
    /// Number of texels per column of the full image.
    pub(super) height: i32,
    /// The index of the smallest mip level. The full image is level 0, and each level has half the
    /// size of the previous level.
    pub(super) last_level: i32,
    /// The filters and wrap modes.
    pub(super) sampler: Sampler,
}

/// The mip levels that each lane reads, numbered so that 0 is the magnified full image and n is the
/// minified level n − 1.
///
/// Magnification has a separate number because its filter may differ.
#[derive(Clone, Copy, Debug)]
pub(super) struct LevelOfDetail<const N: usize> {
    /// The finer of the two levels, or the only one.
    pub(super) near_levels: [i32; N],
    /// The next coarser level, or the near level if the coarser level has no weight.
    pub(super) far_levels: [i32; N],
    /// The weights of the far levels in a linear interpolation from the near levels.
    pub(super) far_weights: Lanes<N>,
    /// Whether a far level has a weight in any lane.
    pub(super) is_trilinear: bool,
}

/// The four texels around a position on a mip level, for each lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct TexelQuads<const N: usize> {
    /// The mip levels, from 0 for the full image.
    pub(super) levels: [i32; N],
    /// The texel indices in their level: upper left, upper right, lower left, lower right.
    pub(super) texels: [[i32; N]; 4],
    /// The fraction of the way from the left to the right texels.
    pub(super) column_fractions: Lanes<N>,
    /// The fraction of the way from the upper to the lower texels.
    pub(super) row_fractions: Lanes<N>,
    /// Whether all lanes use the nearest filter, so that only the upper left texel has a weight.
    pub(super) are_nearest: bool,
}

impl TexelAddressing {
    /// Returns whether the number of texels covered by a pixel matters.
    #[inline(always)]
    fn needs_derivatives(&self) -> bool {
        self.last_level > 0 || self.sampler.mag_filter != self.sampler.min_filter
    }

    /// Selects mip levels: computes the level of detail from the derivatives of the texture
    /// coordinates with respect to the pixel's column and row (glTF 2.0 leaves the formula to
    /// OpenGL, 8.14.1).
    #[inline(always)]
    pub(super) fn select_levels<const N: usize>(
        &self,
        [dx, dy]: &[[Lanes<N>; 2]; 2],
    ) -> LevelOfDetail<N> {
        let mut lod = LevelOfDetail {
            near_levels: [1; N],
            far_levels: [1; N],
            far_weights: Lanes::ZERO,
            is_trilinear: false,
        };
        if !self.needs_derivatives() {
            return lod;
        }
        let Sampler { mag_filter, min_filter, mipmap_mode, .. } = self.sampler;
        let filters_differ = mag_filter != min_filter;
        let round = if mipmap_mode == MipmapMode::Nearest { 0.5 } else { 0.0 };
        let lambdas = self.levels_of_detail(dx, dy);
        // Use `&` instead of `&&`, values instead of branches, and one loop for each result, so that
        // all loops are vectorized.
        let mut near_levels = [0; N];
        for (near, lambda) in near_levels.iter_mut().zip(&lambdas.0) {
            // The level of detail, rounded down for trilinear filtering or to the nearest single
            // level.
            *near = floor_to_int(lambda + round).min(self.last_level);
        }
        if mipmap_mode == MipmapMode::Linear {
            for lane in 0..N {
                let far_weight = lambdas[lane] - near_levels[lane] as f32;
                let is_between = near_levels[lane] < self.last_level;
                lod.far_weights[lane] = if is_between { far_weight } else { 0.0 };
            }
        }
        for lane in 0..N {
            let is_magnified = filters_differ & (lambdas[lane] <= 0.0);
            lod.near_levels[lane] = if is_magnified { 0 } else { 1 + near_levels[lane] };
        }
        for lane in 0..N {
            let has_far = lod.far_weights[lane] > 0.0;
            lod.far_levels[lane] = lod.near_levels[lane] + i32::from(has_far);
        }
        lod.is_trilinear = lod.far_weights.0.iter().any(|weight| *weight > 0.0);
        lod
    }

    /// Computes the levels of detail λ, at least 0: the logarithms of the number of texels that a
    /// pixel covers along its longer side.
    #[inline(always)]
    fn levels_of_detail<const N: usize>(&self, dx: &[Lanes<N>; 2], dy: &[Lanes<N>; 2]) -> Lanes<N> {
        let (width, height) = (self.width as f32, self.height as f32);
        let (xu, xv, yu, yv) = (dx[0] * width, dx[1] * height, dy[0] * width, dy[1] * height);
        let squares = (xu * xu + xv * xv).max_lanes(yu * yu + yv * yv);
        squares.map(|square| {
            // Not minified if a texel is larger than the pixel or if the derivatives are not
            // finite.
            let is_minified = (square > 1.0) & (square < f32::INFINITY);
            0.5 * log2_approx(if is_minified { square } else { 1.0 })
        })
    }

    /// Locates the texels around a position, on levels numbered as in [`LevelOfDetail`].
    ///
    /// All four texels are computed even for lanes with nearest filtering, whose fractions are 0,
    /// because other lanes may filter linearly.
    #[inline(always)]
    pub(super) fn locate_texels<const N: usize>(
        &self,
        lod_levels: &[i32; N],
        [u, v]: [Lanes<N>; 2],
    ) -> TexelQuads<N> {
        let Sampler { wrap_u, wrap_v, mag_filter, min_filter, .. } = self.sampler;
        let is_mag_linear = mag_filter == TextureFilter::Linear;
        let is_min_linear = min_filter == TextureFilter::Linear;
        let (mut levels, mut are_linear) = ([0; N], [false; N]);
        for ((level, is_linear), lod) in levels.iter_mut().zip(&mut are_linear).zip(lod_levels) {
            *level = (lod - 1).max(0);
            *is_linear = if *lod == 0 { is_mag_linear } else { is_min_linear };
        }
        let columns = TexelAxis::locate(u, self.width, &levels, &are_linear, wrap_u);
        let rows = TexelAxis::locate(v, self.height, &levels, &are_linear, wrap_v);
        let mut quads = TexelQuads {
            levels,
            texels: [[0; N]; 4],
            column_fractions: columns.fractions,
            row_fractions: rows.fractions,
            are_nearest: !is_mag_linear && !is_min_linear,
        };
        for lane in 0..N {
            let upper = rows.first[lane] * columns.sizes[lane];
            let lower = rows.second[lane] * columns.sizes[lane];
            quads.texels[0][lane] = upper + columns.first[lane];
            quads.texels[1][lane] = upper + columns.second[lane];
            quads.texels[2][lane] = lower + columns.first[lane];
            quads.texels[3][lane] = lower + columns.second[lane];
        }
        quads
    }
}

/// Positions along a row or column of texels, with the two neighbors along that axis.
struct TexelAxis<const N: usize> {
    /// The number of texels of the level along this axis.
    sizes: [i32; N],
    /// The wrapped index of the texel before the position.
    first: [i32; N],
    /// The wrapped index of the texel after the position.
    second: [i32; N],
    /// The fraction of the way from the first to the second texel.
    fractions: Lanes<N>,
}

impl<const N: usize> TexelAxis<N> {
    /// Locates coordinates on an image whose full size is given, each on its lane's level.
    /// Coordinates that are not filtered linearly map to a single texel.
    #[inline(always)]
    fn locate(
        coordinates: Lanes<N>,
        size: i32,
        levels: &[i32; N],
        are_linear: &[bool; N],
        wrap: WrapMode,
    ) -> Self {
        let (mut sizes, mut first, mut second) = ([0; N], [0; N], [0; N]);
        let mut fractions = Lanes::ZERO;
        for lane in 0..N {
            sizes[lane] = (size >> levels[lane]).max(1);
            // Linear filtering passes through the texel centers, which are at half-integer
            // coordinates.
            let to_center = if are_linear[lane] { 0.5 } else { 0.0 };
            let x = coordinates[lane] * sizes[lane] as f32 - to_center;
            let texel = floor_to_int(x);
            first[lane] = texel;
            second[lane] = texel + 1;
            fractions[lane] = if are_linear[lane] { x - texel as f32 } else { 0.0 };
        }
        // Halves of a power of two are powers of two.
        let are_powers = size & (size - 1) == 0;
        let first = wrap_texels(&first, &sizes, are_powers, wrap);
        let second = wrap_texels(&second, &sizes, are_powers, wrap);
        Self { sizes, first, second, fractions }
    }
}

/// Applies a wrap mode: maps arbitrary texel indices to indices within rows of these sizes.
#[inline(always)]
fn wrap_texels<const N: usize>(
    texels: &[i32; N],
    sizes: &[i32; N],
    are_powers: bool,
    mode: WrapMode,
) -> [i32; N] {
    let mut wrapped = *texels;
    // Clamp to edge: the border texel extends indefinitely.
    if mode == WrapMode::ClampToEdge {
        for (texel, size) in wrapped.iter_mut().zip(sizes) {
            *texel = (*texel).max(0).min(size - 1);
        }
        return wrapped;
    }
    // Mirrored repeat has a period of two images; the second is mirrored.
    let images = if mode == WrapMode::MirroredRepeat { 2 } else { 1 };
    // Repeat: the remainder, which is a mask for a power of two.
    if are_powers {
        for (texel, size) in wrapped.iter_mut().zip(sizes) {
            *texel &= images * size - 1;
        }
    } else {
        // Division is slow, and usually all texels are already within the image.
        let mut are_inside = true;
        for (texel, size) in texels.iter().zip(sizes) {
            are_inside &= (*texel >= 0) & (*texel < images * size);
        }
        if !are_inside {
            for (texel, size) in wrapped.iter_mut().zip(sizes) {
                *texel = texel.rem_euclid(images * size);
            }
        }
    }
    // Mirrored repeat: the second half of the period runs backward.
    if mode == WrapMode::MirroredRepeat {
        for (texel, size) in wrapped.iter_mut().zip(sizes) {
            *texel = (*texel).min(2 * size - 1 - *texel);
        }
    }
    wrapped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_lane_selects_the_levels_of_its_number_of_texels_per_pixel() {
        let sampler = Sampler { mag_filter: TextureFilter::Nearest, ..Sampler::default() };
        let texels = [0.5, 1.5, 4.0, 6.0, 300.0, f32::NAN, f32::INFINITY, 0.0];
        let select = |mipmap_mode| {
            let sampler = Sampler { mipmap_mode, ..sampler };
            let addressing = TexelAddressing { width: 64, height: 64, last_level: 6, sampler };
            let steps = [Lanes(texels.map(|count| count / 64.0)), Lanes::ZERO];
            addressing.select_levels(&[steps, [Lanes::ZERO; 2]])
        };
        let lod = select(MipmapMode::Linear);
        assert_eq!(lod.near_levels, [0, 1, 3, 3, 7, 0, 0, 0]);
        assert_eq!(lod.far_levels, [0, 2, 3, 4, 7, 0, 0, 0]);
        let weights = [0.0, libm::log2f(1.5), 0.0, libm::log2f(1.5), 0.0, 0.0, 0.0, 0.0];
        for (weight, expected) in lod.far_weights.0.iter().zip(weights) {
            assert!((weight - expected).abs() < 1e-5, "{weight} {expected}");
        }
        assert!(lod.is_trilinear);
        let lod = select(MipmapMode::Nearest);
        assert_eq!(lod.near_levels, [0, 2, 3, 4, 7, 0, 0, 0]);
        assert_eq!((lod.far_levels, lod.is_trilinear), (lod.near_levels, false));
    }

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
}
