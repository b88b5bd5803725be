//! Clearcoat: a smooth dielectric layer over all other layers (KHR_materials_clearcoat).
//!
//! ```text
//!  result = mix(below, GGX lobe, clearcoat · F(n·v))      F with F0 = 0.04, of index 1.5
//! ```
//!
//! The layer attenuates everything below by its Fresnel reflectance for the view direction only, as
//! the extension specifies. Refraction by the layer is ignored.

use super::microfacet::{ShadingAngles, pow5, roughness_to_alpha};
use crate::environment::Environment;
use crate::lanes::{Lanes, Rgb};
use crate::light::IncidentLight;
use crate::material_inputs::LayerInputs;
use crate::surface_geometry::SurfaceGeometry;

/// The F0 for an index of refraction of 1.5.
///
/// ((1.5 − 1) / (1.5 + 1))² = 0.04, fixed by the extension.
const CLEARCOAT_F0: f32 = 0.04;

/// The clear layer at `N` fragments, and the light that it has reflected so far.
///
/// Its lobe is always isotropic GGX, with a separate normal map.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clearcoat<const N: usize> {
    /// The surface with the clearcoat's normals.
    geometry: SurfaceGeometry<N>,
    /// The perceptual roughness, increased by the curvature within a pixel.
    roughness: Lanes<N>,
    /// The GGX α.
    alpha: Lanes<N>,
    /// The fraction of light that the layer reflects: its strength times Fresnel.
    reflectance: Lanes<N>,
    /// The reflected light, not yet multiplied by the reflectance.
    specular_light: Rgb<N>,
}

impl<const N: usize> Clearcoat<N> {
    /// Creates the layer over a surface. `geometry` has the clearcoat's normals.
    #[inline(always)]
    pub(super) fn new(layers: &LayerInputs<N>, geometry: SurfaceGeometry<N>) -> Self {
        // Geometric specular antialiasing, as in the base.
        let roughness = (layers.clearcoat_roughness + geometry.normal_variation).clamp(0.0, 1.0);
        // Schlick Fresnel for the view direction.
        let fresnel = CLEARCOAT_F0 + (1.0 - CLEARCOAT_F0) * pow5(1.0 - geometry.n_dot_v);
        Self {
            geometry,
            roughness,
            alpha: roughness_to_alpha(roughness),
            reflectance: layers.clearcoat * fresnel,
            specular_light: Rgb::ZERO,
        }
    }

    /// Adds the GGX reflection of light from one direction.
    ///
    /// This excludes Fresnel: the layer's reflectance depends on the view, and is applied once in
    /// [`composite_over`](Self::composite_over).
    #[cfg_attr(not(any(target_family = "wasm", debug_assertions)), inline(always))]
    #[cfg_attr(any(target_family = "wasm", debug_assertions), inline(never))]
    pub(super) fn add_direct_light(&mut self, light: &IncidentLight<N>) {
        let SurfaceGeometry { normals, views, .. } = self.geometry;
        let angles = ShadingAngles::new(normals, views, light.to_light);
        self.specular_light += light.lux * angles.ggx_lobe(self.alpha);
    }

    /// Adds the prefiltered radiance of the environment in the mirror direction.
    ///
    /// This is the split sum with a Fresnel factor instead of the directional albedo; for a smooth
    /// layer, which is the common case, the two agree.
    #[inline(always)]
    pub(super) fn add_environment(&mut self, environment: &Environment) {
        let SurfaceGeometry { normals, views, .. } = self.geometry;
        self.specular_light += environment.specular_radiance(normals, views, self.roughness);
    }

    /// Computes the fraction of the light from below that the layer lets through.
    #[inline(always)]
    pub(super) fn transmittance(&self) -> Lanes<N> {
        1.0 - self.reflectance
    }

    /// Composites the layer over the light from below.
    ///
    /// Linear interpolation conserves energy: the light below is reduced by the fraction of light
    /// that the layer reflects.
    #[inline(always)]
    pub(super) fn composite_over(&self, below: Rgb<N>) -> Rgb<N> {
        below.zip(self.specular_light, |below, light| below.lerp(light, self.reflectance))
    }
}
