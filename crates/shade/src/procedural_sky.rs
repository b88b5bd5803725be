//! Surroundings that need no file: a studio and a sky.

use std::f32::consts::PI;

/// A studio: soft light from all around, brighter from above, and four soft boxes. The mean is about 1.
#[must_use]
pub fn studio_radiance([x, y, z]: [f32; 3]) -> [f32; 3] {
    /// Direction, the cosines at which a box begins and is full, its light.
    const BOXES: [([f32; 3], [f32; 2], [f32; 3]); 4] = [
        ([-0.58, 0.66, 0.48], [0.90, 0.94], [7.5, 7.2, 6.8]),
        ([0.86, 0.29, 0.43], [0.93, 0.96], [3.0, 3.1, 3.3]),
        ([0.35, 0.50, -0.79], [0.92, 0.95], [4.5, 4.5, 4.5]),
        ([0.0, 1.0, 0.0], [0.80, 0.90], [1.6, 1.6, 1.6]),
    ];
    let around = 0.28 + 0.47 * smoothstep(-1.0, 1.0, y);
    let mut light = [around; 3];
    for ([bx, by, bz], [begins, full], color) in BOXES {
        let share = smoothstep(begins, full, x * bx + y * by + z * bz);
        light = [0, 1, 2].map(|k: usize| light[k] + share * color[k]);
    }
    light
}

fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A clear sky without the disk of the sun, over grey ground: Preetham, Shirley and Smits, *A practical analytic model for
/// daylight*, 1999, in units of 10 kcd/m².
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PreethamSky {
    /// The unit direction to the sun, which is above the horizon.
    to_sun: [f32; 3],
    /// Luminance and chromaticities at the zenith, over what the distribution has there.
    zenith: [f32; 3],
    ground: [f32; 3],
}

/// How hazy the air is: 2 is very clear, 10 is mist.
const TURBIDITY: f32 = 2.5;

/// The distributions of luminance and of the chromaticities x and y: five numbers each, as factor and summand of the turbidity.
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

/// The chromaticities at the zenith: cubic in the sun's angle, quadratic in the turbidity.
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
    /// The sky with the sun in a direction, a unit vector; a sun below the horizon is brought up to it.
    #[must_use]
    pub fn new([x, y, z]: [f32; 3]) -> Self {
        let sun = super::environment::normalize([x, y.max(0.02), z]);
        let angle = libm::acosf(sun[1].clamp(-1.0, 1.0));
        let chi = (4.0 / 9.0 - TURBIDITY / 120.0) * (PI - 2.0 * angle);
        let luminance =
            (4.0453 * TURBIDITY - 4.9710) * libm::tanf(chi) - 0.2155 * TURBIDITY + 2.4192;
        let cubic = |[a, b, c, d]: [f32; 4]| ((a * angle + b) * angle + c) * angle + d;
        let quadratic =
            |[a, b, c]: [[f32; 4]; 3]| (cubic(a) * TURBIDITY + cubic(b)) * TURBIDITY + cubic(c);
        let [x, y] = ZENITH.map(quadratic);
        let mut sky =
            Self { to_sun: sun, zenith: [luminance.max(0.1) * 0.1, x, y], ground: [0.0; 3] };
        for (at, zenith) in sky.zenith.iter_mut().enumerate() {
            *zenith /= perez_distribution(at, 1.0, angle);
        }
        let horizon =
            [[1.0, 0.05, 0.0], [-0.5, 0.05, 0.85], [-0.5, 0.05, -0.85]].map(|w| sky.radiance(w));
        let mean =
            [0, 1, 2].map(|k: usize| horizon.iter().map(|color| color[k]).sum::<f32>() / 3.0);
        let grey = (mean[0] + mean[1] + mean[2]) / 3.0;
        sky.ground = mean.map(|c| 0.15 * c + 0.1 * grey);
        sky
    }

    /// The light from a direction, a unit vector.
    #[must_use]
    pub fn radiance(&self, way: [f32; 3]) -> [f32; 3] {
        let above = smoothstep(-0.02, 0.01, way[1]);
        let cosine = way[1].max(0.01);
        let towards: f32 = (0..3).map(|k| way[k] * self.to_sun[k]).sum();
        let gamma = libm::acosf(towards.clamp(-1.0, 1.0));
        let [luminance, x, y] =
            [0, 1, 2].map(|k: usize| self.zenith[k] * perez_distribution(k, cosine, gamma));
        let per = luminance / y.max(1e-3);
        let (big_x, big_z) = (x * per, (1.0 - x - y) * per);
        let sky = [
            3.240_454_2 * big_x - 1.537_138_5 * luminance - 0.498_531_4 * big_z,
            -0.969_266 * big_x + 1.876_010_8 * luminance + 0.041_556 * big_z,
            0.055_643_4 * big_x - 0.204_025_9 * luminance + 1.057_225_2 * big_z,
        ];
        [0, 1, 2].map(|k: usize| self.ground[k] + (sky[k].max(0.0) - self.ground[k]) * above)
    }
}

/// The distribution of Perez: by the cosine to the zenith and the angle to the sun.
fn perez_distribution(which: usize, cosine: f32, gamma: f32) -> f32 {
    let [a, b, c, d, e] = PEREZ[which].map(|[factor, summand]| factor * TURBIDITY + summand);
    let around = libm::cosf(gamma);
    (1.0 + a * libm::expf(b / cosine)) * (1.0 + c * libm::expf(d * gamma) + e * around * around)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::environment::normalize;

    #[test]
    fn the_sky_is_blue_above_and_bright_around_the_sun() {
        let sun = normalize([0.5, 0.6, 0.2]);
        let sky = PreethamSky::new(sun);
        let [r, g, b] = sky.radiance(normalize([-0.3, 1.0, -0.2]));
        assert!(b > g && g > r && r > 0.0, "{r} {g} {b}");
        let sum = |way: [f32; 3]| sky.radiance(normalize(way)).iter().sum::<f32>();
        assert!(sum([0.5, 0.6, 0.25]) > 1.5 * sum([-0.5, 0.6, -0.2]));
        for way in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.3, -0.01, 0.2]] {
            assert!(sky.radiance(normalize(way)).iter().all(|c| c.is_finite() && *c >= 0.0));
        }
        let night = PreethamSky::new([0.0, -1.0, 0.0]);
        assert!(night.radiance([0.0, 1.0, 0.0]).iter().all(|c| c.is_finite()));
    }
}
