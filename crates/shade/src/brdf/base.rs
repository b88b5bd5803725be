//! The base BRDF: Lambert diffuse under GGX specular, dielectric or metal (glTF 2.0, Appendix B).
//!
//! ```text
//!  dielectric = (1 − F) · base color / π + F · D V
//!  metal      = F(base color) · D V
//!  base       = mix(dielectric, metal, metallic)
//! ```
//!
//! Specular reflection is multiplied by the energy compensation in
//! [`directional_albedo`](super::directional_albedo), for the energy that a single bounce loses. In
//! light from all directions, the specular albedo determines the energy left for diffuse
//! reflection, just as F does in light from one direction.
//!
//! The F0 of a dielectric is ((n − 1) / (n + 1))² for the index of refraction n, or 0.04 for the
//! default of 1.5; the F0 of a metal is the base color. For both, F is Schlick's approximation of
//! Fresnel's equations.

use super::anisotropy::Anisotropy;
use super::directional_albedo::{DirectionalAlbedo, energy_compensation};
use super::microfacet::{MIN_ROUGHNESS, ShadingAngles, pow5, roughness_to_alpha};
use super::thin_film::thin_film_f0;
use crate::Draw;
use crate::lanes::{Lanes, Rgb};
use crate::light::IncidentLight;
use crate::material_inputs::{LayerInputs, MaterialInputs};
use crate::surface_geometry::SurfaceGeometry;
use crate::transmission::TransmittedShare;
use model::{Material, MaterialExtensions};
use std::f32::consts::FRAC_1_PI;

/// The parameters of the base BRDF at `N` fragments, resolved from the material.
#[derive(Clone, Copy, Debug)]
pub(super) struct BaseBrdf<const N: usize> {
    /// The diffuse albedo before subtracting the Fresnel reflection.
    pub(super) diffuse: Rgb<N>,
    /// The specular reflectance at normal incidence, a mix of dielectric and metal.
    f0: Rgb<N>,
    /// The specular reflectance at grazing angles.
    f90: Lanes<N>,
    /// The F0 of the dielectric interface over the diffuse part; for a color, the largest channel.
    dielectric_f0: Lanes<N>,
    /// The F90 of the dielectric interface over the diffuse part.
    dielectric_f90: Lanes<N>,
    /// The perceptual roughness, increased by the curvature within a pixel.
    pub(super) roughness: Lanes<N>,
    /// The GGX α.
    pub(super) alpha: Lanes<N>,
    /// The factor for specular reflection that accounts for multiple scattering.
    energy_compensation: Rgb<N>,
    /// The fraction of a white environment that is reflected specularly.
    pub(super) specular_albedo: Rgb<N>,
    /// The fraction of light from all directions that the interface transmits to the diffuse part.
    pub(super) diffuse_transmittance: Lanes<N>,
}

impl<const N: usize> BaseBrdf<N> {
    /// Resolves the BRDF of a material in its workflow (metallic-roughness or specular-glossiness).
    ///
    /// The order is: roughness and α, F0 and F90 of the workflow, the thin film, and finally
    /// everything that depends on the directional albedo.
    #[inline(always)]
    pub(super) fn new(
        material: &Material,
        inputs: &MaterialInputs<N>,
        geometry: &SurfaceGeometry<N>,
    ) -> Self {
        // Geometric specular antialiasing: if a pixel covers many normals of a curved surface, its
        // highlight is widened accordingly.
        let roughness = inputs.roughness.clamp(MIN_ROUGHNESS, 1.0);
        let roughness = (roughness + geometry.normal_variation).min(1.0);
        let mut brdf = Self {
            diffuse: Rgb::ZERO,
            f0: Rgb::ZERO,
            f90: Lanes::ONE,
            dielectric_f0: Lanes::ZERO,
            dielectric_f90: Lanes::ZERO,
            roughness,
            alpha: roughness_to_alpha(roughness),
            energy_compensation: Rgb::WHITE,
            specular_albedo: Rgb::ZERO,
            diffuse_transmittance: Lanes::ZERO,
        };
        let extensions = &material.extensions;
        if extensions.specular_glossiness.is_some() {
            brdf.set_specular_glossiness(inputs);
        } else {
            brdf.set_metallic_roughness(extensions, inputs);
        }
        if let Some(film) = &extensions.iridescence {
            brdf.apply_thin_film(film.ior, inputs, geometry);
        }
        // Split-sum table lookup (Karis 2013).
        let albedo = DirectionalAlbedo::lookup(brdf.roughness, geometry.n_dot_v);
        brdf.apply_directional_albedo(&albedo);
        brdf
    }

    /// Sets the parameters of the metallic-roughness workflow: a mix of dielectric and metal
    /// (KHR_materials_ior, KHR_materials_specular).
    ///
    /// Mixing F0 and F90 instead of two BRDFs gives one lobe instead of two. F is exactly the mix
    /// of both, because Schlick's approximation is linear in F0 and F90.
    #[inline(always)]
    fn set_metallic_roughness(
        &mut self,
        extensions: &MaterialExtensions,
        inputs: &MaterialInputs<N>,
    ) {
        // Dielectric: the F0 of its index of refraction, tinted and attenuated by
        // KHR_materials_specular.
        let LayerInputs { specular, specular_color, .. } = inputs.layers;
        let metallic = inputs.metallic;
        let base_color = inputs.base_color;
        // The Fresnel reflectance at normal incidence for an index of refraction against air.
        let root = (extensions.ior - 1.0) / (extensions.ior + 1.0);
        let ior_f0 = root * root;
        let dielectric_f0 = specular_color.map(|color| (ior_f0 * color).min(1.0) * specular);
        self.dielectric_f0 = dielectric_f0.max_channel().max(0.0);
        self.dielectric_f90 = specular;
        // Metals have no diffuse part, and their F0 is the base color.
        self.diffuse = base_color * (1.0 - metallic);
        self.f0 = dielectric_f0.zip(base_color, |dielectric, base| dielectric.lerp(base, metallic));
        self.f90 = specular.lerp(Lanes::ONE, metallic);
    }

    /// Sets the parameters of the specular-glossiness workflow: F0 is a color, and the diffuse part
    /// is scaled by one minus its largest channel (KHR_materials_pbrSpecularGlossiness).
    ///
    /// Glossiness is 1 − roughness. The workflow has no metalness or index of refraction.
    #[inline(always)]
    fn set_specular_glossiness(&mut self, inputs: &MaterialInputs<N>) {
        let specular = inputs.layers.specular_color;
        self.dielectric_f0 = specular.max_channel().min(1.0);
        self.dielectric_f90 = Lanes::ONE;
        self.diffuse = inputs.base_color * (1.0 - self.dielectric_f0);
        self.f0 = specular.map(|channel| channel.min(1.0));
    }

    /// Replaces a fraction of F0 with the F0 of a thin film over the interface
    /// (KHR_materials_iridescence).
    ///
    /// Schlick's approximation does not describe a film. This F0 makes the approximation yield the
    /// film's reflectance for the current view.
    #[inline(always)]
    fn apply_thin_film(
        &mut self,
        film_ior: f32,
        inputs: &MaterialInputs<N>,
        geometry: &SurfaceGeometry<N>,
    ) {
        let LayerInputs { iridescence, iridescence_thickness, .. } = inputs.layers;
        // Thin-film interference (Belcour and Barla 2017).
        let film_f0 = thin_film_f0(self.f0, film_ior, iridescence_thickness, geometry.n_dot_v);
        self.f0 = self.f0.zip(film_f0, |bare, film| bare.lerp(film, iridescence));
        // The film also covers the dielectric part of a surface: where the film reflects more, less
        // light reaches the diffuse part.
        let dielectric = 1.0 - inputs.metallic;
        let film = self.f0.map(|f0| f0.min_lanes(self.dielectric_f90) * dielectric);
        self.dielectric_f0 = self.dielectric_f0.max_lanes(film.max_channel());
    }

    /// Removes the transmitted fraction from diffuse reflection, and returns the share of the light
    /// behind the surface that is visible through it (KHR_materials_transmission).
    ///
    /// Only dielectric surfaces transmit light, and only the part that Fresnel reflection leaves.
    #[inline(always)]
    pub(super) fn transmit_diffuse(
        &mut self,
        draw: &Draw<'_>,
        inputs: &MaterialInputs<N>,
    ) -> TransmittedShare<N> {
        let transmission = inputs.layers.transmission;
        self.diffuse = self.diffuse * (1.0 - transmission);
        let dielectric = 1.0 - inputs.metallic;
        let fraction = transmission * dielectric * self.diffuse_transmittance;
        TransmittedShare::new(draw, inputs, fraction)
    }

    /// Derives the energy compensation, specular albedo and diffuse transmittance from the split
    /// sum.
    #[inline(always)]
    fn apply_directional_albedo(&mut self, albedo: &DirectionalAlbedo<N>) {
        let DirectionalAlbedo { f0_scale: a, f90_scale: b } = *albedo;
        // The specular albedo of the interface takes its energy from the diffuse part.
        let dielectric_albedo = (self.dielectric_f0 * a + self.dielectric_f90 * b)
            * energy_compensation(self.dielectric_f0, a + b);
        // 1 − E, for the diffuse part in light from all directions.
        self.diffuse_transmittance = 1.0 - dielectric_albedo;
        // Multiple-scattering energy compensation (Turquin 2019).
        self.energy_compensation = self.f0.map(|f0| energy_compensation(f0, a + b));
        self.specular_albedo = self.f0.map(|f0| f0 * a + self.f90 * b) * self.energy_compensation;
    }

    /// Adds the light from one direction that the base reflects to the viewer: the BRDF times the
    /// illuminance of the surface.
    ///
    /// ```text
    ///  L += E · ( diffuse · (1 − F_dielectric) · n·l / π  +  F · compensation · D V n·l )
    /// ```
    #[inline(always)]
    pub(super) fn add_direct_light(
        &self,
        geometry: &SurfaceGeometry<N>,
        light: &IncidentLight<N>,
        anisotropy: Option<&Anisotropy<N>>,
        radiance: &mut Rgb<N>,
    ) {
        let SurfaceGeometry { normals, views, .. } = *geometry;
        let angles = ShadingAngles::new(normals, views, light.to_light);
        // D · V · n·l, isotropic or stretched along the tangents.
        let lobe = match anisotropy {
            Some(anisotropy) => anisotropy.ggx_lobe(&angles, self.alpha, views, light.to_light),
            None => angles.ggx_lobe(self.alpha),
        };
        // Schlick Fresnel for the mixed surface and for the interface over the diffuse part.
        let schlick = pow5(1.0 - angles.v_dot_h);
        let fresnel = self.f0.map(|f0| f0.lerp(self.f90, schlick));
        let dielectric_fresnel = self.dielectric_f0.lerp(self.dielectric_f90, schlick);
        // Lambert, scaled by the energy that Fresnel leaves.
        let diffuse = angles.n_dot_l * FRAC_1_PI * (1.0 - dielectric_fresnel);
        // F · D V n·l, compensated for the energy that a single bounce loses.
        let specular = fresnel * self.energy_compensation * lobe;
        *radiance += light.lux * (self.diffuse * diffuse + specular);
    }
}
