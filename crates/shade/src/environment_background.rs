//! The environment as a background, as sharp as the picture and without banding.
//!
//! A sharp background evaluates the environment's source function at four positions in each pixel,
//! because the map that surfaces reflect is far coarser. If the picture has 8 bits per channel,
//! ordered dithering (Bayer, *An optimum method for two-level rendition of continuous-tone
//! pictures*, 1973) turns the steps of a smooth sky into an invisible pattern.

use super::approximations::{exp2_approx, floor_to_int, log2_approx};
use super::attributes::{PrimitiveIndices, UV, interpolate};
use super::fragment_lanes::FragmentLanes;
use super::lanes::{Lanes, Rgb, Vec3Lanes};
use super::surface_geometry::view_directions;
use super::vector::normalize_or_zero;
use super::{Draw, Shading};

/// Sample positions relative to the center of a pixel, in pixels, with no two in the same row or
/// column.
const SAMPLES: [[f32; 2]; 4] = [[-0.125, -0.375], [0.375, -0.125], [0.125, 0.375], [-0.375, 0.125]];

impl Shading<'_> {
    /// Computes the color of the environment behind everything, blurred as in a mirror with this
    /// roughness.
    ///
    /// The draw is a quad at the far plane. Its positions are used only for the view direction, and
    /// its texture coordinates are pixel coordinates of the picture.
    #[inline(always)]
    pub(super) fn shade_environment_background<const N: usize>(
        &self,
        draw: &Draw<'_>,
        primitives: &PrimitiveIndices<N>,
        fragments: &impl FragmentLanes<N>,
        blur: f32,
    ) -> [Lanes<N>; 4] {
        let vertices = draw.vertex_indices(primitives);
        let corners = draw.vertex_positions(&vertices);
        let positions: Vec3Lanes<N> = interpolate(&corners, &fragments.weights()).into();
        let mut color = Rgb::ZERO;
        if let Some(environment) = self.environment {
            color = match environment.source().filter(|_| blur == 0.0) {
                Some(_) => {
                    let right: Vec3Lanes<N> = interpolate(&corners, &fragments.weights_dx()).into();
                    let down: Vec3Lanes<N> = interpolate(&corners, &fragments.weights_dy()).into();
                    Rgb::from_fn(|lane| {
                        let place = [positions, right, down].map(|vectors| vectors.lane(lane));
                        self.sharp_environment(place)
                    })
                }
                None => {
                    let away = -view_directions(positions, self.viewer_position());
                    let light = environment.prefiltered_radiance(away, Lanes::splat(blur));
                    self.tone_mapper.map_colors(light)
                }
            };
        }
        if self.has_eight_bits {
            let pixels: [Lanes<N>; 2] =
                interpolate(&vertices.fetch_attributes(&draw.vertices, UV), &fragments.weights());
            color = Rgb::from_fn(|lane| dither(color.lane(lane), pixels.map(|at| at[lane])));
        }
        let Rgb { r, g, b } = color;
        [r, g, b, Lanes::ONE]
    }

    /// Computes the mean color of a background pixel from a position in it and the steps to the
    /// next pixels.
    #[inline(never)]
    fn sharp_environment(&self, [position, right, down]: [[f32; 3]; 3]) -> [f32; 3] {
        let mut sum = [0.0; 3];
        let Some(source) = self.environment.and_then(|environment| environment.source()) else {
            return sum;
        };
        for [x, y] in SAMPLES {
            let at = [0, 1, 2].map(|k: usize| position[k] + right[k] * x + down[k] * y);
            let towards_eye =
                view_directions(Vec3Lanes::<1>::splat(at), self.viewer_position()).lane(0);
            let away = normalize_or_zero(towards_eye.map(|coordinate| -coordinate));
            let color = self.tone_mapper.map_colors(Rgb::<1>::splat(source(away))).lane(0);
            for (sum, channel) in sum.iter_mut().zip(color) {
                *sum += 0.25 * channel.clamp(0.0, 1.0);
            }
        }
        sum
    }
}

/// Shifts a linear color by up to half an 8-bit sRGB code, depending on the pixel's position.
#[inline(never)]
fn dither(color: [f32; 3], pixel: [f32; 2]) -> [f32; 3] {
    let [x, y] = pixel.map(|coordinate| floor_to_int(coordinate) as u32);
    let offset = (bayer(x, y) as f32 + 0.5) / 64.0 - 0.5;
    color.map(|channel| {
        // The derivative of the sRGB decoding curve (IEC 61966-2-1).
        let slope = if channel <= 0.003_130_8 {
            1.0 / 12.92
        } else {
            2.4 / 1.055 * exp2_approx(log2_approx(channel.min(1.0)) * (1.4 / 2.4))
        };
        (channel + offset * slope / 255.0).max(0.0)
    })
}

/// Returns the threshold, from 0 to 63, at a position in Bayer's 8 × 8 matrix.
const fn bayer(x: u32, y: u32) -> u32 {
    let (a, b) = (x ^ y, y);
    let mut threshold = 0;
    let mut bit = 0;
    while bit < 3 {
        threshold = threshold << 2 | (a >> bit & 1) << 1 | b >> bit & 1;
        bit += 1;
    }
    threshold
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::SrgbEncoder;

    #[test]
    fn each_threshold_occurs_once() {
        let mut all: Vec<u32> = (0..64).map(|at| bayer(at % 8, at / 8)).collect();
        assert_eq!(all[..4], [0, 32, 8, 40]);
        all.sort_unstable();
        assert!(all.into_iter().eq(0..64));
    }

    #[test]
    fn the_mean_of_dithered_codes_is_the_color() {
        let encoder = SrgbEncoder::shared();
        for step in 1..200 {
            let exact = 0.1 + 0.004 * step as f32;
            let linear = crate::color::srgb_to_linear(f64::from(exact)) as f32;
            let codes = (0..64).map(|at| {
                let pixel = [(at % 8) as f32 + 0.5, (at / 8) as f32 + 0.5];
                f32::from(encoder.encode(dither([linear; 3], pixel)[0]))
            });
            let codes: Vec<f32> = codes.collect();
            let mean = codes.iter().sum::<f32>() / 64.0;
            assert!((mean - 255.0 * exact).abs() < 0.05, "{exact}: {mean}");
            assert!(codes.iter().all(|code| (code - 255.0 * exact).abs() <= 1.0));
        }
    }
}
