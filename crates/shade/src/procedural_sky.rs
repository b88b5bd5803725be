//! A procedural clear sky: the Preetham model of daylight.
//!
//! Preetham, Shirley and Smits, *A practical analytic model for daylight*, 1999. The luminance and
//! chromaticity in each direction are the zenith values times a ratio of Perez's distribution:
//!
//! ```text
//!  Y(θ, γ) = Y_zenith · F(θ, γ) / F(0, θ_sun)        θ  angle to the zenith
//!  F(θ, γ) = (1 + A e^(B / cosθ)) ·                  γ  angle to the sun
//!            (1 + C e^(D γ) + E cos²γ)
//! ```

use super::color::{XYZ_TO_SRGB, multiply_matrix};
use super::vector::{dot, normalize};
use std::f32::consts::PI;

/// A clear sky over gray ground, without the disk of the sun. The unit is 10 kcd/m².
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PreethamSky {
    /// The unit direction to the sun, which is above the horizon.
    to_sun: [f32; 3],
    /// The luminance Y and chromaticities x and y at the zenith, divided by the value of the
    /// distribution there.
    zenith: [f32; 3],
    /// The color below the horizon.
    ground: [f32; 3],
}

/// The turbidity (haziness) of the air: 2 is very clear, 10 is mist.
const TURBIDITY: f32 = 2.5;

/// The coefficients A to E of Perez's distribution for Y, x and y, each as a factor of the
/// turbidity and a constant (Preetham et al., appendix 2).
const PEREZ: [[[f32; 2]; 5]; 3] = [
    [[0.1787, -1.4630], [-0.3554, 0.4275], [-0.0227, 5.3251], [0.1206, -2.5771], [-0.0670, 0.3703]],
    [
        [-0.0193, -0.2592],
        [-0.0665, 0.0008],
        [-0.0004, 0.2125],
        [-0.0641, -0.8989],
        [-0.0033, 0.0452],
    ],
    [
        [-0.0167, -0.2608],
        [-0.0950, 0.0092],
        [-0.0079, 0.2102],
        [-0.0441, -1.6537],
        [-0.0109, 0.0529],
    ],
];

/// The chromaticities x and y at the zenith, as polynomials that are cubic in the sun's angle from
/// the zenith and quadratic in the turbidity.
const ZENITH: [[[f32; 4]; 3]; 2] = [
    [
        [0.001_66, -0.003_75, 0.002_09, 0.0],
        [-0.029_03, 0.063_77, -0.032_02, 0.003_94],
        [0.116_93, -0.211_96, 0.060_52, 0.258_86],
    ],
    [
        [0.002_75, -0.006_10, 0.003_17, 0.0],
        [-0.042_14, 0.089_70, -0.041_53, 0.005_16],
        [0.153_46, -0.267_56, 0.066_70, 0.266_88],
    ],
];

impl PreethamSky {
    /// Creates the sky with the sun in a direction, a unit vector in the world with y up. A sun
    /// below the horizon is raised to the horizon.
    #[must_use]
    pub fn new([x, y, z]: [f32; 3]) -> Self {
        let to_sun = normalize([x, y.max(0.02), z]);
        let sun_angle = libm::acosf(to_sun[1].clamp(-1.0, 1.0));
        // The luminance and chromaticities at the zenith.
        let chi = (4.0 / 9.0 - TURBIDITY / 120.0) * (PI - 2.0 * sun_angle);
        let luminance =
            (4.0453 * TURBIDITY - 4.9710) * libm::tanf(chi) - 0.2155 * TURBIDITY + 2.4192;
        let cubic = |[a, b, c, d]: [f32; 4]| ((a * sun_angle + b) * sun_angle + c) * sun_angle + d;
        let quadratic =
            |[a, b, c]: [[f32; 4]; 3]| (cubic(a) * TURBIDITY + cubic(b)) * TURBIDITY + cubic(c);
        let [x, y] = ZENITH.map(quadratic);
        let zenith = [luminance.max(0.1) * 0.1, x, y];
        let mut sky = Self { to_sun, zenith, ground: [0.0; 3] };
        for (component, zenith) in sky.zenith.iter_mut().enumerate() {
            *zenith /= perez_distribution(component, 1.0, sun_angle);
        }
        // The ground is a mean of the horizon, darkened and desaturated.
        let horizon = [[1.0, 0.05, 0.0], [-0.5, 0.05, 0.85], [-0.5, 0.05, -0.85]]
            .map(|direction| sky.radiance(direction));
        let mean =
            [0, 1, 2].map(|k: usize| horizon.iter().map(|color| color[k]).sum::<f32>() / 3.0);
        let gray = (mean[0] + mean[1] + mean[2]) / 3.0;
        sky.ground = mean.map(|c| 0.15 * c + 0.1 * gray);
        sky
    }

    /// Returns the radiance from a direction, a unit vector, in linear sRGB.
    #[must_use]
    pub fn radiance(&self, direction: [f32; 3]) -> [f32; 3] {
        // Clamp, because the distribution diverges at the horizon.
        let cosine = direction[1].max(0.01);
        let gamma = libm::acosf(dot(direction, self.to_sun).clamp(-1.0, 1.0));
        let [luminance, x, y] =
            [0, 1, 2].map(|k: usize| self.zenith[k] * perez_distribution(k, cosine, gamma));
        // xyY to XYZ to sRGB.
        // Chromaticities to tristimulus values: X = x Y / y, Z = (1 − x − y) Y / y.
        let scale = luminance / y.max(1e-3);
        let xyz = [x * scale, luminance, (1.0 - x - y) * scale];
        let sky = multiply_matrix(&XYZ_TO_SRGB, xyz);
        let above = smoothstep(-0.02, 0.01, direction[1]);
        [0, 1, 2].map(|k: usize| self.ground[k] + (sky[k].max(0.0) - self.ground[k]) * above)
    }
}

/// Computes Perez's distribution for a component (Y, x or y), from the cosine of the angle to the
/// zenith and the angle to the sun in radians.
///
/// Perez, Seals and Michalsky 1993, with five coefficients that are linear in the turbidity.
fn perez_distribution(component: usize, cosine: f32, gamma: f32) -> f32 {
    // A sets the gradient near the horizon, and B its width. C and D set the glow around the sun. E
    // sets the backscatter.
    let [a, b, c, d, e] = PEREZ[component].map(|[factor, constant]| factor * TURBIDITY + constant);
    let sun_cosine = libm::cosf(gamma);
    let horizon = 1.0 + a * libm::expf(b / cosine);
    horizon * (1.0 + c * libm::expf(d * gamma) + e * sun_cosine * sun_cosine)
}

/// Interpolates from 0 at `from` to 1 at `to` with a Hermite polynomial, as in GLSL.
pub(super) fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sky_is_blue_above_and_bright_around_the_sun() {
        let to_sun = normalize([0.5, 0.6, 0.2]);
        let sky = PreethamSky::new(to_sun);
        let [r, g, b] = sky.radiance(normalize([-0.3, 1.0, -0.2]));
        assert!(b > g && g > r && r > 0.0, "{r} {g} {b}");
        let sum = |direction: [f32; 3]| sky.radiance(normalize(direction)).iter().sum::<f32>();
        assert!(sum([0.5, 0.6, 0.25]) > 1.5 * sum([-0.5, 0.6, -0.2]));
        for direction in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.3, -0.01, 0.2]] {
            let radiance = sky.radiance(normalize(direction));
            assert!(radiance.iter().all(|c| c.is_finite() && *c >= 0.0), "{radiance:?}");
        }
        let night = PreethamSky::new([0.0, -1.0, 0.0]);
        assert!(night.radiance([0.0, 1.0, 0.0]).iter().all(|c| c.is_finite()));
    }
}
