//! The studio: a procedural environment of soft light and four softboxes.

use super::procedural_sky::smoothstep;
use super::vector::dot;

/// A softbox: a disk of light with a smooth rim.
struct Softbox {
    /// The unit direction of its middle, y up.
    direction: [f32; 3],
    /// The cosines to the direction at which its light begins and is full.
    cosines: [f32; 2],
    /// The radiance of the disk.
    color: [f32; 3],
}

/// Key light, fill, back light and a wide box above.
const SOFTBOXES: [Softbox; 4] = [
    Softbox { direction: [-0.58, 0.66, 0.48], cosines: [0.90, 0.94], color: [7.5, 7.2, 6.8] },
    Softbox { direction: [0.86, 0.29, 0.43], cosines: [0.93, 0.96], color: [3.0, 3.1, 3.3] },
    Softbox { direction: [0.35, 0.50, -0.79], cosines: [0.92, 0.95], color: [4.5, 4.5, 4.5] },
    Softbox { direction: [0.0, 1.0, 0.0], cosines: [0.80, 0.90], color: [1.6, 1.6, 1.6] },
];

/// The radiance of a photographer's studio from a direction, a unit vector with y up: soft light
/// from all directions, brighter from above, and four softboxes. The mean over all directions is
/// about 1.
#[must_use]
pub fn studio_radiance(direction: [f32; 3]) -> [f32; 3] {
    // Hemisphere light, then the boxes.
    let fill = 0.28 + 0.47 * smoothstep(-1.0, 1.0, direction[1]);
    let mut radiance = [fill; 3];
    for Softbox { direction: middle, cosines: [begins, full], color } in SOFTBOXES {
        let weight = smoothstep(begins, full, dot(direction, middle));
        radiance = [0, 1, 2].map(|k: usize| radiance[k] + weight * color[k]);
    }
    radiance
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::normalize;

    #[test]
    fn the_mean_radiance_is_about_one_and_the_floor_is_darker_than_the_ceiling() {
        let (rings, spokes) = (64, 64);
        let mut sum = 0.0;
        for (ring, spoke) in (0..rings).flat_map(|ring| (0..spokes).map(move |s| (ring, s))) {
            let y = (ring as f32 + 0.5) / rings as f32 * 2.0 - 1.0;
            let azimuth = (spoke as f32 + 0.5) / spokes as f32 * 2.0 * std::f32::consts::PI;
            let radius = (1.0 - y * y).sqrt();
            let [x, z] = [radius * libm::cosf(azimuth), radius * libm::sinf(azimuth)];
            sum += studio_radiance(normalize([x, y, z]))[1];
        }
        let mean = sum / (rings * spokes) as f32;
        assert!((0.8..1.2).contains(&mean), "{mean}");
        assert!(studio_radiance([0.0, -1.0, 0.0])[1] < 0.5 * studio_radiance([0.0, 1.0, 0.0])[1]);
    }
}
