//! The studio: a procedural environment with evenly lit walls, a dark floor and softboxes.
//!
//! ```text
//!          ▬▬▬  overhead strip
//!    ▓▓            ▬▬▬▬▬  back light
//!    ▓▓ key    ▌              walls   ‖ ── horizon: a mirror shows where the floor begins
//!            ▌  strips left and right
//!   ░░░░░░░░░░░░░░░░░░░░░░░   floor
//! ```
//!
//! Matte surfaces receive the studio's smooth irradiance. Metals reflect its contrast: narrow
//! strips that are far brighter than the walls, and a floor that is far darker.

use super::procedural_sky::smoothstep;
use super::vector::{cross, dot, normalize};

/// A softbox: a luminous rectangle with soft edges, one unit away.
struct Softbox {
    /// The direction of the center, of any length, with y up.
    direction: [f32; 3],
    /// Half the width and half the height.
    half_size: [f32; 2],
    /// The radiance of the rectangle.
    radiance: f32,
}

/// The key light, strips to the left and right, the back light and a strip overhead.
const SOFTBOXES: [Softbox; 5] = [
    Softbox { direction: [-0.70, 0.36, 0.62], half_size: [0.46, 0.48], radiance: 1.62 },
    Softbox { direction: [-0.93, 0.10, -0.35], half_size: [0.16, 0.80], radiance: 1.62 },
    Softbox { direction: [0.90, 0.16, 0.40], half_size: [0.20, 0.75], radiance: 1.62 },
    Softbox { direction: [0.35, 0.36, -0.87], half_size: [0.80, 0.22], radiance: 1.62 },
    Softbox { direction: [0.0, 1.0, 0.05], half_size: [0.65, 0.16], radiance: 1.5 },
];
/// The fade on each side of a softbox's edges, as fractions of its half width and half height.
const SOFTBOX_FADE: [f32; 2] = [0.25, 0.15];

/// Computes the studio's radiance from a direction, a unit vector with y up.
///
/// The radiance of a matte white surface (the irradiance over π) is at most 1.04; facing the floor,
/// it is 0.21. The studio's radiance never exceeds 2.17, so mirrors do not clip at a strength of
/// 0.45, which bare models use.
#[must_use]
pub fn studio_radiance(direction: [f32; 3]) -> [f32; 3] {
    let height = direction[1];
    let floor = 0.12 + 0.14 * smoothstep(-1.0, 0.0, height);
    let walls = 0.50 + 0.06 * smoothstep(0.0, 1.0, height);
    let horizon = smoothstep(-0.03, 0.05, height);
    let mut radiance = floor + (walls - floor) * horizon;
    for softbox in &SOFTBOXES {
        radiance += softbox.radiance * softbox.coverage(direction);
    }
    [radiance; 3]
}

impl Softbox {
    /// Computes how much the rectangle covers a direction, from 0 outside to 1 inside.
    fn coverage(&self, direction: [f32; 3]) -> f32 {
        let center = normalize(self.direction);
        let across = normalize(cross([0.0, 1.0, 0.0], center));
        let along = cross(center, across);
        let ahead = dot(direction, center);
        if ahead <= 1e-3 {
            return 0.0;
        }
        // The point on the rectangle's plane in this direction.
        let place = [dot(direction, across) / ahead, dot(direction, along) / ahead];
        [0, 1].iter().fold(1.0, |coverage, &k: &usize| {
            let (half, fade) = (self.half_size[k], SOFTBOX_FADE[k]);
            let outside = smoothstep(half * (1.0 - fade), half * (1.0 + fade), place[k].abs());
            coverage * (1.0 - outside)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns unit vectors evenly distributed over the sphere (the Fibonacci spiral).
    fn sphere(count: usize) -> impl Iterator<Item = [f32; 3]> {
        (0..count).map(move |index| {
            let y = 1.0 - (2.0 * index as f32 + 1.0) / count as f32;
            let azimuth = 2.399_963_2 * index as f32;
            let radius = (1.0 - y * y).sqrt();
            [radius * libm::cosf(azimuth), y, radius * libm::sinf(azimuth)]
        })
    }

    /// Computes the radiance of a matte white surface with this normal: the cosine-weighted
    /// integral over the hemisphere, divided by π.
    fn matte_white(normal: [f32; 3]) -> f32 {
        let count = 40_000;
        let light = |d: [f32; 3]| studio_radiance(d)[1] * dot(d, normal).max(0.0);
        4.0 * sphere(count).map(light).sum::<f32>() / count as f32
    }

    #[test]
    fn hemisphere_integrals_match_the_calibrated_values() {
        for (normal, expected) in [
            ([0.0, 1.0, 0.0], 1.01),
            ([0.0, -1.0, 0.0], 0.21),
            ([0.0, 0.0, 1.0], 0.68),
            ([0.0, 0.0, -1.0], 0.65),
            ([1.0, 0.0, 0.0], 0.69),
            ([-1.0, 0.0, 0.0], 0.81),
        ] {
            let white = matte_white(normal);
            assert!((white - expected).abs() < 0.01, "{normal:?} {white}");
        }
        let most = sphere(200).map(matte_white).fold(0.0, f32::max);
        assert!((1.03..1.05).contains(&most), "{most}");
    }

    #[test]
    fn a_mirror_reflects_contrast() {
        let radiances = || sphere(5000).map(|direction| studio_radiance(direction)[0]);
        let (least, most) = radiances()
            .fold((f32::MAX, 0.0), |(least, most): (f32, f32), radiance| {
                (least.min(radiance), most.max(radiance))
            });
        assert!(most > 15.0 * least && most < 2.2, "{least} {most}");
        // The floor starts at the horizon.
        assert!(studio_radiance([0.0, 0.1, 1.0])[0] > 1.8 * studio_radiance([0.0, -0.1, 1.0])[0]);
    }
}
