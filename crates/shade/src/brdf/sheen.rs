//! Sheen: retroreflective cloth fibers with the Charlie distribution (KHR_materials_sheen).
//!
//! Estevez and Kulla, *Production friendly microfacet sheen BRDF*, 2017:
//!
//! ```text
//!  D = (2 + 1/α) sinθₕ^(1/α) / 2π          distribution of the fiber normals
//!  G = 1 / (1 + Λ(n·v) + Λ(n·l))           shadowing, with a fit for Λ by the authors
//!  sheen = color · D · G / (4 n·l n·v)
//! ```
//!
//! Sheen takes its energy from the layers below, which are scaled by `1 − max(color) · E` (albedo
//! scaling, as in the extension). `E` is the directional albedo of white sheen: the integral of the
//! lobe over the hemisphere.

mod table;

use super::directional_albedo::locate_entries;
use super::microfacet::ShadingAngles;
use crate::lanes::{Lanes, Rgb};
use crate::light::IncidentLight;
use crate::material_inputs::LayerInputs;
use crate::surface_geometry::SurfaceGeometry;
use std::f32::consts::FRAC_1_PI;
use table::TABLE;

/// The minimum perceptual roughness, below which the lobe is too narrow for `f32` and the table.
const MIN_SHEEN_ROUGHNESS: f32 = 0.07;

/// The sheen layer at `N` fragments.
///
/// It keeps the sum of base and sheen within the incoming energy.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheen<const N: usize> {
    /// The reflectance of the fibers, by channel.
    color: Rgb<N>,
    /// The perceptual roughness, not below [`MIN_SHEEN_ROUGHNESS`]; α is its square.
    roughness: Lanes<N>,
    /// The largest channel of the color; the layers below are attenuated equally in all channels.
    max_color: Lanes<N>,
    /// The directional albedo of white sheen toward the viewer.
    albedo: Lanes<N>,
}

impl<const N: usize> Sheen<N> {
    /// Creates the layer described by a material's inputs, as seen by a viewer.
    #[inline(always)]
    pub(super) fn new(layers: &LayerInputs<N>, geometry: &SurfaceGeometry<N>) -> Self {
        let roughness = layers.sheen_roughness.clamp(MIN_SHEEN_ROUGHNESS, 1.0);
        Self {
            color: layers.sheen_color,
            roughness,
            max_color: layers.sheen_color.max_channel(),
            albedo: sheen_albedo(geometry.n_dot_v, roughness),
        }
    }

    /// Adds the sheen in light from one direction, and reduces the light to the part that passes to
    /// the layers below.
    #[inline(always)]
    pub(super) fn add_direct_light(
        &self,
        geometry: &SurfaceGeometry<N>,
        light: &mut IncidentLight<N>,
        radiance: &mut Rgb<N>,
    ) {
        let SurfaceGeometry { normals, views, .. } = *geometry;
        let angles = ShadingAngles::new(normals, views, light.to_light);
        *radiance += light.lux * self.color * charlie_lobe(self.roughness, &angles);
        // Albedo scaling uses the larger of the albedos for view and light, so that the BRDF stays
        // reciprocal.
        let light_albedo = sheen_albedo(angles.n_dot_l, self.roughness);
        let base_scale = 1.0 - self.max_color * self.albedo.max_lanes(light_albedo);
        // The base receives only the light that sheen leaves.
        light.lux = light.lux * base_scale;
    }

    /// Returns the fraction of light from all directions that is left for the layers below.
    #[inline(always)]
    pub(super) fn base_scale(&self) -> Lanes<N> {
        1.0 - self.max_color * self.albedo
    }

    /// Returns the fraction of light from all directions that the layer reflects.
    #[inline(always)]
    pub(super) fn reflectance(&self) -> Rgb<N> {
        self.color * self.albedo
    }
}

/// Computes the Charlie lobe of white sheen with the cosine factor: `D · V · n·l`.
///
/// The distribution of Estevez and Kulla 2017 has its maximum at grazing half vectors: fibers are
/// perpendicular to the surface and light up at silhouettes.
#[cfg_attr(not(any(target_family = "wasm", debug_assertions)), inline(always))]
#[cfg_attr(any(target_family = "wasm", debug_assertions), inline(never))]
fn charlie_lobe<const N: usize>(roughness: Lanes<N>, angles: &ShadingAngles<N>) -> Lanes<N> {
    let inv_alpha = 1.0 / (roughness * roughness);
    let (n_dot_l, n_dot_v) = (angles.n_dot_l, angles.n_dot_v);
    // Charlie distribution, an exponentiated sine.
    let sine_squared = angles.sin_squared_h.clamp(0.0, 1.0);
    let exponent = 0.5 * inv_alpha;
    let sine_power = Lanes::from_fn(|lane| libm::powf(sine_squared[lane], exponent[lane]));
    let distribution = (2.0 + inv_alpha) * sine_power * (0.5 * FRAC_1_PI);
    // Visibility, bounded if view and light are at grazing angles.
    let alpha = 1.0 / inv_alpha;
    let lambda =
        |cosine: Lanes<N>| Lanes::from_fn(|lane| charlie_lambda(cosine[lane], alpha[lane]));
    let shadowing = 1.0 + lambda(n_dot_v) + lambda(n_dot_l);
    let visibility = (0.25 / (shadowing * n_dot_v * n_dot_l).max(1e-6)).min(1.0);
    distribution * visibility * n_dot_l
}

/// Computes Smith's Λ for the Charlie distribution with the fit of Estevez and Kulla 2017, table 1.
///
/// The fit has two branches, whose exponents are point-symmetric about a cosine of 0.5.
fn charlie_lambda(cosine: f32, alpha: f32) -> f32 {
    // Coefficients for smooth and rough fibers, interpolated by (1 − α)².
    let weight = (1.0 - alpha) * (1.0 - alpha);
    let mix = |rough: f32, smooth: f32| rough + (smooth - rough) * weight;
    let [a, b, c] = [mix(21.5473, 25.3245), mix(3.82987, 3.32435), mix(0.198_23, 0.168_01)];
    let [d, e] = [mix(-1.977_6, -1.273_93), mix(-4.320_54, -4.859_67)];
    let fit = |x: f32| a / (1.0 + b * libm::powf(x, c)) + d * x + e;
    let exponent = if cosine < 0.5 { fit(cosine) } else { 2.0 * fit(0.5) - fit(1.0 - cosine) };
    libm::expf(exponent)
}

/// Looks up the directional albedo of white sheen, the integral of the lobe over the hemisphere,
/// with bilinear interpolation in the table. The result is at most 1.
///
/// The table has sixteen roughness values by sixteen square roots of the cosine; the root puts more
/// entries near grazing angles.
#[cfg_attr(not(any(target_family = "wasm", debug_assertions)), inline(always))]
#[cfg_attr(any(target_family = "wasm", debug_assertions), inline(never))]
fn sheen_albedo<const N: usize>(cosine: Lanes<N>, roughness: Lanes<N>) -> Lanes<N> {
    let (rows, s) = locate_entries(roughness * 15.0);
    let (columns, t) = locate_entries(cosine.sqrt() * 15.0);
    // Gather four entries for each lane.
    Lanes::from_fn(|lane| {
        let (row, column) = (rows[lane] as usize, columns[lane] as usize);
        let across = |row: &[f32; 16]| row[column] + (row[column + 1] - row[column]) * t[lane];
        let (upper, lower) = (across(&TABLE[row]), across(&TABLE[row + 1]));
        upper + (lower - upper) * s[lane]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Vec3Lanes;
    use std::f32::consts::PI;

    #[test]
    fn the_table_contains_the_integrals_of_the_lobe() {
        let n = Vec3Lanes::<1>::splat([0.0, 0.0, 1.0]);
        for roughness in [0.2, 0.37, 0.6, 1.0].map(|roughness| Lanes([roughness])) {
            for degrees in [5.0_f32, 40.0, 80.0] {
                let angle = degrees.to_radians();
                let v = [libm::sinf(angle), 0.0, libm::cosf(angle)];
                let (rings, spokes) = (400, 128);
                let mut sum = 0.0;
                for (ring, spoke) in (0..rings).flat_map(|r| (0..spokes).map(move |s| (r, s))) {
                    let height = (ring as f32 + 0.5) / rings as f32;
                    let azimuth = (spoke as f32 + 0.5) / spokes as f32 * 2.0 * PI;
                    let radius = (1.0 - height * height).sqrt();
                    let l = [radius * libm::cosf(azimuth), radius * libm::sinf(azimuth), height];
                    let angles = ShadingAngles::new(n, Vec3Lanes::splat(v), Vec3Lanes::splat(l));
                    sum += charlie_lobe(roughness, &angles)[0];
                }
                let integral = sum * 2.0 * PI / (rings * spokes) as f32;
                let fitted = sheen_albedo(Lanes([v[2]]), roughness)[0];
                assert!(
                    (integral.min(1.0) - fitted).abs() < 0.02,
                    "{roughness:?} {degrees}: {integral} {fitted}"
                );
            }
        }
    }
}
