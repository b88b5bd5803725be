//! Environments: light from all around, as a surface needs it.
//!
//! Scattered light is the irradiance by direction, nine numbers a channel (Ramamoorthi and Hanrahan 2001). Mirrored light is a
//! chain of pictures of the surroundings, each blurred as a surface of some roughness would see it: the first of the two sums
//! of Karis 2013, whose second is [`Albedo`](super::albedo::Albedo).
//!
//! Directions lie on a square by the octahedral map (Engelhardt and Dachsbacher 2008), with directions at the nodes of a
//! grid: the borders fold onto themselves, and nothing has a seam.

mod filter;
mod harmonics;
mod octahedron;

use super::seen::dots;
use filter::{LEVELS, Levels};
use harmonics::Harmonics;
pub(crate) use octahedron::unit;
use octahedron::{Octahedron, between};

/// Light from all around: radiance, linear.
#[derive(Clone, PartialEq, Debug)]
pub struct Environment {
    harmonics: Harmonics,
    /// From mirrors to the roughest.
    levels: Levels,
}

impl Environment {
    /// The environment with this radiance in each direction, a unit vector of the world.
    #[must_use]
    pub fn of(radiance: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        let sharp = Octahedron::of(257, radiance);
        Self { harmonics: Harmonics::of(&sharp), levels: Levels::of(sharp) }
    }

    /// The light that white matt surfaces with these unit normals scatter: irradiance over π.
    #[inline(always)]
    pub(super) fn scattered<const N: usize>(&self, normals: &[[f32; N]; 3]) -> [[f32; N]; 3] {
        self.harmonics.scattered(normals)
    }

    /// The mean light around the directions in which surfaces mirror the viewer, as wide as they are rough.
    #[inline(always)]
    pub(super) fn mirrored<const N: usize>(
        &self,
        normals: &[[f32; N]; 3],
        views: &[[f32; N]; 3],
        roughness: &[f32; N],
    ) -> [[f32; N]; 3] {
        let cosines = dots(normals, views);
        let mut ways = [[0.0; N]; 3];
        for axis in 0..3 {
            for lane in 0..N {
                ways[axis][lane] = 2.0 * cosines[lane] * normals[axis][lane] - views[axis][lane];
            }
        }
        self.blurred(&ways, roughness)
    }

    /// The light from around directions of any length but 0, blurred as by surfaces of these roughnesses.
    #[inline(always)]
    pub(super) fn blurred<const N: usize>(
        &self,
        ways: &[[f32; N]; 3],
        roughness: &[f32; N],
    ) -> [[f32; N]; 3] {
        let (mut near, mut share) = ([0; N], [0.0; N]);
        for lane in 0..N {
            let place = roughness[lane].clamp(0.0, 1.0) * (LEVELS - 1) as f32;
            let level = (place as i32).min(LEVELS as i32 - 2);
            near[lane] = level as usize;
            share[lane] = place - level as f32;
        }
        let colors = between(|level| self.levels.level(level), &near, &share, ways);
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
        let white = Environment::of(|_| [1.0; 3]);
        for n in [[0.0_f32, 0.0, 1.0], [0.6, -0.8, 0.0], [-0.48, 0.6, 0.64]] {
            let normals = n.map(|c| [c]);
            let scattered = white.scattered(&normals);
            assert!(scattered.iter().all(|[c]| (c - 1.0).abs() < 1e-3), "{scattered:?}");
            for roughness in [0.0, 0.3, 0.55, 1.0] {
                let mirrored = white.mirrored(&normals, &normals, &[roughness]);
                assert!(mirrored.iter().all(|[c]| (c - 1.0).abs() < 1e-4), "{mirrored:?}");
            }
        }
    }

    #[test]
    fn a_bright_half_lights_the_half_that_faces_it() {
        // The irradiance of a hemisphere of light is π for what faces it, and π (1 + cosθ) / 2 in all.
        let half = Environment::of(|[_, y, _]| [if y > 0.0 { 1.0 } else { 0.0 }, 0.5, 0.0]);
        for cosine in [1.0_f32, 0.5, 0.0, -0.5, -1.0] {
            let normal = [(1.0 - cosine * cosine).sqrt(), cosine, 0.0];
            let [[r], [g], [b]] = half.scattered(&normal.map(|c| [c]));
            assert!((r - 0.5 * (1.0 + cosine)).abs() < 0.06, "{cosine}: {r}");
            assert!((g - 0.5).abs() < 1e-3 && b.abs() < 1e-6);
        }
        let up = [[0.0], [1.0], [0.0]];
        assert!((half.blurred(&up, &[0.5])[0][0] - 1.0).abs() < 0.06);
        let level: Vec<f32> =
            [0.0, 0.4, 0.8].map(|r| half.blurred(&[[1.0], [0.2], [0.0]], &[r])[0][0]).to_vec();
        assert!(level[0] > level[1] && level[1] > level[2] && level[2] > 0.5, "{level:?}");
    }
}
