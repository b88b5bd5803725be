//! Environments: light from all around, as a surface needs it.
//!
//! Scattered light is the irradiance by direction, nine numbers a channel (Ramamoorthi and Hanrahan 2001). Mirrored light is a
//! chain of pictures of the surroundings, each blurred as a surface of some roughness would see it: the first of the two sums
//! of Karis 2013, whose second is [`Albedo`](super::albedo::Albedo).
//!
//! Directions lie on a square by the octahedral map (Engelhardt and Dachsbacher 2008), with directions at the nodes of a
//! grid: the borders fold onto themselves, and nothing has a seam.

mod irradiance;
mod octahedral_map;
mod prefilter;

use super::fragment_lanes::dot_lanes;
use irradiance::IrradianceHarmonics;
pub(crate) use octahedral_map::normalize;
use octahedral_map::{OctahedralMap, sample_trilinear};
use prefilter::{LEVEL_COUNT, PrefilteredLevels};

/// Light from all around: radiance, linear.
#[derive(Clone, PartialEq, Debug)]
pub struct Environment {
    irradiance: IrradianceHarmonics,
    /// From mirrors to the roughest.
    prefiltered: PrefilteredLevels,
}

impl Environment {
    /// The environment with this radiance in each direction, a unit vector of the world.
    #[must_use]
    pub fn from_radiance(radiance: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        let sharp = OctahedralMap::from_function(257, radiance);
        Self {
            irradiance: IrradianceHarmonics::project(&sharp),
            prefiltered: PrefilteredLevels::new(sharp),
        }
    }

    /// The light that white matt surfaces with these unit normals scatter: irradiance over π.
    #[inline(always)]
    pub(super) fn irradiance_over_pi<const N: usize>(
        &self,
        normals: &[[f32; N]; 3],
    ) -> [[f32; N]; 3] {
        self.irradiance.irradiance_over_pi(normals)
    }

    /// The mean light around the directions in which surfaces mirror the viewer, as wide as they are rough.
    #[inline(always)]
    pub(super) fn specular_radiance<const N: usize>(
        &self,
        normals: &[[f32; N]; 3],
        views: &[[f32; N]; 3],
        roughness: &[f32; N],
    ) -> [[f32; N]; 3] {
        let cosines = dot_lanes(normals, views);
        let mut ways = [[0.0; N]; 3];
        for axis in 0..3 {
            for lane in 0..N {
                ways[axis][lane] = 2.0 * cosines[lane] * normals[axis][lane] - views[axis][lane];
            }
        }
        self.prefiltered_radiance(&ways, roughness)
    }

    /// The light from around directions of any length but 0, blurred as by surfaces of these roughnesses.
    #[inline(always)]
    pub(super) fn prefiltered_radiance<const N: usize>(
        &self,
        ways: &[[f32; N]; 3],
        roughness: &[f32; N],
    ) -> [[f32; N]; 3] {
        let (mut near, mut share) = ([0; N], [0.0; N]);
        for lane in 0..N {
            let place = roughness[lane].clamp(0.0, 1.0) * (LEVEL_COUNT - 1) as f32;
            let level = (place as i32).min(LEVEL_COUNT as i32 - 2);
            near[lane] = level as usize;
            share[lane] = place - level as f32;
        }
        let colors = sample_trilinear(|level| self.prefiltered.level(level), &near, &share, ways);
        let mut light = [[0.0; N]; 3];
        for channel in 0..3 {
            for lane in 0..N {
                light[channel][lane] = colors[lane][channel];
            }
        }
        light
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_surroundings_are_white_to_every_surface() {
        let white = Environment::from_radiance(|_| [1.0; 3]);
        for n in [[0.0_f32, 0.0, 1.0], [0.6, -0.8, 0.0], [-0.48, 0.6, 0.64]] {
            let normals = n.map(|c| [c]);
            let scattered = white.irradiance_over_pi(&normals);
            assert!(scattered.iter().all(|[c]| (c - 1.0).abs() < 1e-3), "{scattered:?}");
            for roughness in [0.0, 0.3, 0.55, 1.0] {
                let mirrored = white.specular_radiance(&normals, &normals, &[roughness]);
                assert!(mirrored.iter().all(|[c]| (c - 1.0).abs() < 1e-4), "{mirrored:?}");
            }
        }
    }

    #[test]
    fn a_bright_half_lights_the_half_that_faces_it() {
        // The irradiance of a hemisphere of light is π for what faces it, and π (1 + cosθ) / 2 in all.
        let half =
            Environment::from_radiance(|[_, y, _]| [if y > 0.0 { 1.0 } else { 0.0 }, 0.5, 0.0]);
        for cosine in [1.0_f32, 0.5, 0.0, -0.5, -1.0] {
            let normal = [(1.0 - cosine * cosine).sqrt(), cosine, 0.0];
            let [[r], [g], [b]] = half.irradiance_over_pi(&normal.map(|c| [c]));
            assert!((r - 0.5 * (1.0 + cosine)).abs() < 0.06, "{cosine}: {r}");
            assert!((g - 0.5).abs() < 1e-3 && b.abs() < 1e-6);
        }
        let up = [[0.0], [1.0], [0.0]];
        assert!((half.prefiltered_radiance(&up, &[0.5])[0][0] - 1.0).abs() < 0.06);
        let level: Vec<f32> = [0.0, 0.4, 0.8]
            .map(|r| half.prefiltered_radiance(&[[1.0], [0.2], [0.0]], &[r])[0][0])
            .to_vec();
        assert!(level[0] > level[1] && level[1] > level[2] && level[2] > 0.5, "{level:?}");
    }
}
