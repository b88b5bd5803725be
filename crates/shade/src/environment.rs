//! Image-based lighting: the irradiance and prefiltered radiance of an environment.
//!
//! ```text
//!                     ┌─► irradiance    diffuse:  9 spherical harmonics per channel
//!  radiance by        │
//!  direction ─────────┼─► level 0       mirror    ┐
//!  (octahedral map)   ├─► level 1       …         ├ specular: GGX-prefiltered mip levels
//!                     └─► level 5       roughness 1
//! ```
//!
//! Diffuse light is the irradiance by direction (Ramamoorthi and Hanrahan 2001). Specular light is
//! the first sum of the split-sum approximation (Karis, *Real shading in Unreal Engine 4*, 2013),
//! as a mip chain prefiltered for increasing roughness. The second sum is the directional albedo of
//! the BRDF.
//!
//! The octahedral map (Engelhardt and Dachsbacher 2008) maps directions to a square, and radiance
//! is sampled at the nodes of a grid. The borders fold onto themselves, so there is no seam.

mod irradiance;
mod octahedral_map;
mod prefilter;

use super::approximations::floor_to_int;
use super::lanes::{Lanes, Rgb, Vec3Lanes};
use irradiance::IrradianceHarmonics;
use octahedral_map::{OctahedralMap, sample_trilinear};
use prefilter::{LEVEL_COUNT, PrefilteredLevels};
use std::fmt;
use std::sync::Arc;

/// A function from directions, as unit vectors in world space, to radiance.
type Radiance = dyn Fn([f32; 3]) -> [f32; 3] + Send + Sync;

/// The source of an environment, for pictures in which the environment itself is visible.
#[derive(Clone)]
struct Source(Arc<Radiance>);

impl PartialEq for Source {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl fmt::Debug for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Source")
    }
}

/// Number of nodes along a side of the octahedral map. The 256 intervals between them span about 1°
/// each.
const SIDE: usize = 257;

/// Light from all directions: linear radiance, prepared for diffuse and specular lookups.
#[derive(Clone, PartialEq, Debug)]
pub struct Environment {
    /// The diffuse light as nine spherical harmonics per channel.
    irradiance: IrradianceHarmonics,
    /// The specular light, from mirrors to the roughest surfaces.
    prefiltered: PrefilteredLevels,
    /// The radiance shown as a background, which is finer than the map.
    source: Option<Source>,
}

impl Environment {
    /// Creates an environment from a function that maps directions, as unit vectors in world space,
    /// to radiance.
    ///
    /// The function is called once for each of about 66,000 directions. Prefiltered levels are
    /// computed when first needed by a surface.
    #[must_use]
    pub fn from_radiance(radiance: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        let map = OctahedralMap::from_function(SIDE, radiance);
        Self {
            irradiance: IrradianceHarmonics::project(&map),
            prefiltered: PrefilteredLevels::new(map),
            source: None,
        }
    }

    /// Creates an environment as [`from_radiance`](Self::from_radiance) does, but keeps the
    /// function, so that the background is rendered at the picture's full resolution.
    #[must_use]
    pub fn from_source(radiance: impl Fn([f32; 3]) -> [f32; 3] + Send + Sync + 'static) -> Self {
        let made = Self::from_radiance(&radiance);
        Self { source: Some(Source(Arc::new(radiance))), ..made }
    }

    /// Returns the function that the environment was created from, if it was kept.
    pub(super) fn source(&self) -> Option<&Radiance> {
        self.source.as_ref().map(|source| &*source.0)
    }

    /// Computes the radiance of white Lambert surfaces with these unit normals: irradiance over π.
    #[cfg_attr(not(any(target_family = "wasm", debug_assertions)), inline(always))]
    #[cfg_attr(any(target_family = "wasm", debug_assertions), inline(never))]
    pub(super) fn irradiance_over_pi<const N: usize>(&self, normals: Vec3Lanes<N>) -> Rgb<N> {
        self.irradiance.irradiance_over_pi(normals)
    }

    /// Computes the prefiltered radiance in the mirror direction of the view.
    #[inline(always)]
    pub(super) fn specular_radiance<const N: usize>(
        &self,
        normals: Vec3Lanes<N>,
        views: Vec3Lanes<N>,
        roughness: Lanes<N>,
    ) -> Rgb<N> {
        // r = 2 (n·v) n − v
        let mirrored = normals * (2.0 * normals.dot(views)) - views;
        self.prefiltered_radiance(mirrored, roughness)
    }

    /// Computes the radiance around directions of any nonzero length, prefiltered for a perceptual
    /// roughness, with trilinear interpolation between the two nearest levels.
    ///
    /// Level 0 is for mirrors, and level 5 is for roughness 1.
    #[cfg_attr(not(any(target_family = "wasm", debug_assertions)), inline(always))]
    #[cfg_attr(any(target_family = "wasm", debug_assertions), inline(never))]
    pub(super) fn prefiltered_radiance<const N: usize>(
        &self,
        directions: Vec3Lanes<N>,
        roughness: Lanes<N>,
    ) -> Rgb<N> {
        // The levels are evenly spaced in perceptual roughness.
        let level = roughness.clamp(0.0, 1.0) * (LEVEL_COUNT - 1) as f32;
        let mut near_levels = [0; N];
        for (near, level) in near_levels.iter_mut().zip(&level.0) {
            *near = floor_to_int(*level).min(LEVEL_COUNT as i32 - 2) as usize;
        }
        let fractions = Lanes::from_fn(|lane| level[lane] - near_levels[lane] as f32);
        let texels = sample_trilinear(
            #[inline(always)]
            |level| self.prefiltered.level(level),
            &near_levels,
            fractions,
            directions,
        );
        Rgb::from_fn(|lane| {
            let [r, g, b, _] = texels[lane];
            [r, g, b]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_white_environment_lights_every_surface_white() {
        let white = Environment::from_radiance(|_| [1.0; 3]);
        for n in [[0.0_f32, 0.0, 1.0], [0.6, -0.8, 0.0], [-0.48, 0.6, 0.64]] {
            let normals = Vec3Lanes::<1>::splat(n);
            let diffuse = white.irradiance_over_pi(normals).lane(0);
            assert!(diffuse.iter().all(|c| (c - 1.0).abs() < 1e-3), "{diffuse:?}");
            for roughness in [0.0, 0.3, 0.55, 1.0] {
                let specular = white.specular_radiance(normals, normals, Lanes([roughness]));
                let specular = specular.lane(0);
                assert!(specular.iter().all(|c| (c - 1.0).abs() < 1e-4), "{specular:?}");
            }
        }
    }

    #[test]
    fn a_bright_hemisphere_lights_the_surfaces_that_face_it() {
        // The irradiance from a bright hemisphere is π (1 + cosθ) / 2 for a normal at an angle θ
        // from its pole.
        let half =
            Environment::from_radiance(|[_, y, _]| [if y > 0.0 { 1.0 } else { 0.0 }, 0.5, 0.0]);
        for cosine in [1.0_f32, 0.5, 0.0, -0.5, -1.0] {
            let normal = [(1.0 - cosine * cosine).sqrt(), cosine, 0.0];
            let [r, g, b] = half.irradiance_over_pi(Vec3Lanes::<1>::splat(normal)).lane(0);
            assert!((r - 0.5 * (1.0 + cosine)).abs() < 0.06, "{cosine}: {r}");
            assert!((g - 0.5).abs() < 1e-3 && b.abs() < 1e-6);
        }
        let red = |direction, roughness| {
            let direction = Vec3Lanes::<1>::splat(direction);
            half.prefiltered_radiance(direction, Lanes([roughness])).r[0]
        };
        assert!((red([0.0, 1.0, 0.0], 0.5) - 1.0).abs() < 0.06);
        let levels = [0.0, 0.4, 0.8].map(|roughness| red([1.0, 0.2, 0.0], roughness));
        assert!(levels[0] > levels[1] && levels[1] > levels[2] && levels[2] > 0.5, "{levels:?}");
    }
}
