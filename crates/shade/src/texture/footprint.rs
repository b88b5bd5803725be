//! Anisotropic filtering: the footprint of a pixel on a texture, sampled along its longer axis.
//!
//! ```text
//!      ┌──────────────╱╱╲      a pixel's image on the texture is roughly an ellipse. On a floor
//!      │       ●  ●  ●  ╱      that recedes from the viewer the ellipse is long, and any mip
//!      │    ●  ●  ●    ╱       level is either too blurred across it or too sharp along it
//!      ╲╲_____________╱
//! ```
//!
//! The texture is therefore read at several taps along the longer axis, on the mip level whose
//! texels are as large as the shorter axis. The sources are:
//! - Heckbert, *Fundamentals of texture mapping and image warping*, 1989;
//! - McCormack and others, *Feline: fast elliptical lines for anisotropic texture mapping*, 1999.
//!
//! Taps on a line approximate the elliptical weighted average (EWA: Greene and Heckbert 1986),
//! which weights every texel within the ellipse by a Gaussian.

use super::UvLanes;
use super::addressing::{LevelOfDetail, TexelAddressing, TexelQuads};
use crate::approximations::floor_to_int;
use crate::lanes::Lanes;

/// The footprints of pixels on textures with the same addressing: taps on a line, all on the same
/// levels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Footprint<const N: usize> {
    /// The middle of the line, in texture coordinates.
    center: [Lanes<N>; 2],
    /// The number of taps, at least 1.
    tap_counts: Lanes<N>,
    /// The line in texture coordinates, from end to end; zero if there is only one tap.
    major_axis: [Lanes<N>; 2],
    /// The mip levels of each tap.
    lod: LevelOfDetail<N>,
}

/// One tap of the footprints, in all lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tap<const N: usize> {
    /// The texels of the nearer mip level and the next.
    pub(super) quads: [TexelQuads<N>; 2],
    /// The number of levels, 1 or 2, with a weight in any lane.
    pub(super) level_count: usize,
    /// The weights of the levels, each relative to the preceding levels.
    pub(super) level_weights: [Lanes<N>; 2],
    /// The weight of the tap in its footprint: 0 in lanes with fewer taps.
    pub(super) tap_weights: Lanes<N>,
}

impl<const N: usize> Footprint<N> {
    /// Returns the maximum number of taps over all lanes.
    #[inline(always)]
    pub(crate) fn max_tap_count(&self) -> u32 {
        let mut count = 1.0_f32;
        for taps in self.tap_counts.0 {
            count = count.max(taps);
        }
        count as u32
    }

    /// Returns the tap at an index starting at 0. Taps are at the midpoints of equal parts of the
    /// line.
    #[cfg_attr(not(any(target_family = "wasm", debug_assertions)), inline(always))]
    #[cfg_attr(any(target_family = "wasm", debug_assertions), inline(never))]
    pub(crate) fn tap(&self, addressing: &TexelAddressing, index: u32) -> Tap<N> {
        let index = index as f32;
        let along = (index + 0.5) / self.tap_counts - 0.5;
        let tap_weights =
            self.tap_counts.map(|count| if index < count { 1.0 / count } else { 0.0 });
        let [u, v] = self.center;
        let position = [u + self.major_axis[0] * along, v + self.major_axis[1] * along];
        let LevelOfDetail { near_levels, far_levels, far_weights, is_trilinear } = &self.lod;
        let near = addressing.locate_texels(near_levels, position);
        let (mut quads, mut level_count) = ([near; 2], 1);
        if *is_trilinear {
            quads[1] = addressing.locate_texels(far_levels, position);
            level_count = 2;
        }
        Tap { quads, level_count, level_weights: [Lanes::ONE, *far_weights], tap_weights }
    }
}

impl TexelAddressing {
    /// Computes the footprints of pixels, with at most `anisotropy` taps.
    ///
    /// The number of taps is the rounded ratio of the axes, and at least 1.
    #[cfg_attr(not(any(target_family = "wasm", debug_assertions)), inline(always))]
    #[cfg_attr(any(target_family = "wasm", debug_assertions), inline(never))]
    pub(crate) fn footprint<const N: usize>(
        &self,
        uvs: &UvLanes<N>,
        anisotropy: u32,
    ) -> Footprint<N> {
        let mut tap_counts = Lanes::ONE;
        let mut major_axis = [Lanes::ZERO; 2];
        let mut steps = [uvs.dx, uvs.dy];
        // Without mip levels every tap would read full-size texels, so use one tap and accept
        // aliasing.
        if anisotropy > 1 && self.last_level > 0 {
            let most = anisotropy as f32;
            self.fit_anisotropy(most, &mut tap_counts, &mut major_axis, &mut steps);
        }
        Footprint { center: uvs.uv, tap_counts, major_axis, lod: self.select_levels(&steps) }
    }

    /// Fits the ellipse of a pixel's footprint. A long ellipse becomes a line of taps, and the
    /// derivatives are replaced by the steps for a single tap.
    ///
    /// J, the derivatives in texels, maps the unit circle to the ellipse. The squared lengths of
    /// the ellipse's axes are the eigenvalues of J Jᵀ, and the longer axis is an eigenvector.
    #[inline(always)]
    fn fit_anisotropy<const N: usize>(
        &self,
        most: f32,
        tap_counts: &mut Lanes<N>,
        major_axis: &mut [Lanes<N>; 2],
        [dx, dy]: &mut [[Lanes<N>; 2]; 2],
    ) {
        let (width, height) = (self.width as f32, self.height as f32);
        for lane in 0..N {
            // J in texels, then J Jᵀ = (uu uv; uv vv).
            let (xu, xv) = (dx[0][lane] * width, dx[1][lane] * height);
            let (yu, yv) = (dy[0][lane] * width, dy[1][lane] * height);
            let (uu, vv, uv) = (xu * xu + yu * yu, xv * xv + yv * yv, xu * xv + yu * yv);
            // The trace and determinant of the 2 × 2 matrix; the determinant of J is the product of
            // the axes.
            let (trace, area) = (uu + vv, xu * yv - xv * yu);
            // The longer axis is the square root of the larger eigenvalue.
            let root = ((uu - vv) * (uu - vv) + 4.0 * uv * uv).sqrt();
            let longer = (0.5 * (trace + root)).sqrt();
            let shorter = area.abs() / longer;
            // Along an axis shorter than a texel, the texture is magnified, so no taps are added.
            let ratio = (longer / shorter.max(1.0) + 0.5).max(0.0);
            let count = (floor_to_int(ratio) as f32).min(most);
            let is_long = (count > 1.0) & (longer < 1e6);
            // Use the form of the eigenvector that does not vanish.
            let x = if uu > vv { 0.5 * (uu - vv + root) } else { uv };
            let y = if uu > vv { uv } else { 0.5 * (vv - uu + root) };
            let inv_length = 1.0 / (x * x + y * y).sqrt();
            let (x, y) = (x * inv_length / width, y * inv_length / height);
            // The distance between taps, if the tap limit makes it longer than the minor axis.
            let step = (longer / count).max(shorter);
            tap_counts[lane] = if is_long { count } else { 1.0 };
            major_axis[0][lane] = if is_long { x * longer } else { 0.0 };
            major_axis[1][lane] = if is_long { y * longer } else { 0.0 };
            dx[0][lane] = if is_long { x * step } else { dx[0][lane] };
            dx[1][lane] = if is_long { y * step } else { dx[1][lane] };
            dy[0][lane] = if is_long { 0.0 } else { dy[0][lane] };
            dy[1][lane] = if is_long { 0.0 } else { dy[1][lane] };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{MipChain, TexelEncoding};
    use model::{Image, Sampler};

    #[test]
    fn long_footprints_fit_the_ellipse_of_their_derivatives() {
        let image = Image { width: 64, height: 64, rgba: vec![[0; 4]; 64 * 64] };
        let mip_chain = MipChain::new(&image, Sampler::default(), TexelEncoding::Linear);
        // The ellipse has axes of 12 and 3 texels and is rotated, as are the pixel's axes.
        for (angle, pixel_angle) in [(0.0, 0.0), (0.4, 0.0), (1.2, 0.7), (2.5, 1.9), (1.5, 0.3)] {
            let rotate = |x: f32, y: f32, angle: f32| {
                let (sine, cosine) = (libm::sinf(angle), libm::cosf(angle));
                [cosine * x - sine * y, sine * x + cosine * y]
            };
            let derivative = |x: f32, y: f32| {
                let [x, y] = rotate(x, y, pixel_angle);
                rotate(12.0 * x, 3.0 * y, angle).map(|texels| Lanes([texels / 64.0]))
            };
            let mut steps = [derivative(1.0, 0.0), derivative(0.0, 1.0)];
            let (mut tap_counts, mut major_axis) = (Lanes::<1>::ONE, [Lanes::ZERO; 2]);
            let addressing = mip_chain.addressing();
            addressing.fit_anisotropy(8.0, &mut tap_counts, &mut major_axis, &mut steps);
            assert_eq!(tap_counts, Lanes([4.0]));
            let [x, y] = major_axis.map(|axis| axis[0]);
            let [expected_x, expected_y] = rotate(12.0, 0.0, angle);
            let across = x * expected_y - y * expected_x;
            assert!(across.abs() < 1e-3 && ((x * x + y * y).sqrt() * 64.0 - 12.0).abs() < 1e-3);
            let [x, y] = steps[0].map(|step| step[0]);
            assert!(((x * x + y * y).sqrt() * 64.0 - 3.0).abs() < 1e-3);
        }
    }
}
