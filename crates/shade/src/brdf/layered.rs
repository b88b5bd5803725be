//! The layered BRDF: all light that the surfaces of a draw reflect to the viewer, layer by layer.
//!
//! ```text
//!            direct light   environment     the order in which light passes down
//!                 │              │
//!  clearcoat   ───┼──────────────┼───       reflects part of all light, composited last
//!  sheen       ───┼──────────────┼───       adds its lobe, attenuates the rest
//!  base        ───▼──────────────▼───       GGX specular and Lambert diffuse
//! ```
//!
//! Each layer is attenuated by the layers above with a scalar per fragment (albedo scaling), so
//! that layers take light from each other without creating any.

use super::anisotropy::Anisotropy;
use super::base::BaseBrdf;
use super::clearcoat::Clearcoat;
use super::sheen::Sheen;
use crate::ambient_occlusion::add_bounces;
use crate::environment::Environment;
use crate::lanes::{Lanes, Rgb};
use crate::light::Light;
use crate::light_shadow::LightShadow;
use crate::material_inputs::MaterialInputs;
use crate::shadow_receiver::ShadowReceiver;
use crate::surface_geometry::{SurfaceGeometry, TangentLanes};
use crate::transmission::{TransmissionFramebuffer, TransmittedShare};
use crate::{Draw, Tangents};
use std::f32::consts::FRAC_1_PI;

/// The BRDF of the surfaces at `N` fragments, and the radiance reflected so far.
///
/// It is created once per fragment. Then lights are added one by one, with the environment last,
/// and [`finish`](Self::finish) composites the clearcoat over the sum.
///
/// Layers that the material does not have are `None`, and cost a single branch for all lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LayeredBrdf<'a, const N: usize> {
    /// The parameters of the material.
    inputs: &'a MaterialInputs<N>,
    /// The surface with the normals from the normal map.
    geometry: SurfaceGeometry<N>,
    /// Lambert diffuse and GGX specular, dielectric or metal.
    base: BaseBrdf<N>,
    /// The Charlie lobe of KHR_materials_sheen.
    sheen: Option<Sheen<N>>,
    /// The frame along which the GGX lobe of the base is stretched.
    anisotropy: Option<Anisotropy<N>>,
    /// The GGX lobe of KHR_materials_clearcoat, composited last.
    clearcoat: Option<Clearcoat<N>>,
    /// The share of light from behind that is visible through the surface.
    pub(crate) transmission: Option<TransmittedShare<N>>,
    /// The light toward the viewer from below the clearcoat: initially emitted light, to which
    /// reflected light is added.
    radiance: Rgb<N>,
}

impl<'a, const N: usize> LayeredBrdf<'a, N> {
    /// Creates the BRDF of a draw's material on surfaces with these smooth normals. Its radiance is
    /// initially the emitted light.
    ///
    /// The normal map affects the base, sheen and anisotropy; shadows and ambient occlusion use the
    /// smooth normals.
    #[inline(always)]
    pub(crate) fn new(
        draw: &Draw<'_>,
        inputs: &'a MaterialInputs<N>,
        smooth: SurfaceGeometry<N>,
        tangents: &TangentLanes<N>,
    ) -> Self {
        let material = draw.material;
        let extensions = &material.extensions;
        let has_tangents = !matches!(draw.tangents, Tangents::None);
        // The clearcoat has a separate normal map; without it, the layer stays smooth over a bumpy
        // base.
        let clearcoat = extensions.clearcoat.as_deref().map(|clearcoat| {
            let mut geometry = smooth;
            if clearcoat.normal_texture.is_some() && has_tangents {
                geometry = smooth.with_tangent_normal(tangents, inputs.layers.clearcoat_normal);
            }
            Clearcoat::new(&inputs.layers, geometry)
        });
        let mut geometry = smooth;
        if has_tangents && material.normal_texture.is_some() {
            geometry = smooth.with_tangent_normal(tangents, inputs.tangent_normal);
        }
        let mut base = BaseBrdf::new(material, inputs, &geometry);
        let mut transmission = None;
        if material.is_transmissive() {
            transmission = Some(base.transmit_diffuse(draw, inputs));
        }
        let sheen = extensions.sheen.as_ref().map(|_| Sheen::new(&inputs.layers, &geometry));
        let anisotropy = extensions.anisotropy.as_ref().map(|anisotropy| {
            Anisotropy::new(inputs, &geometry, tangents, anisotropy.rotation, base.alpha)
        });
        let radiance = inputs.emitted;
        Self { inputs, geometry, base, sheen, anisotropy, clearcoat, transmission, radiance }
    }

    /// Adds the light from a scene's lights, reduced in shadow.
    ///
    /// `shadows` contains the shadow maps of the first lights in order; `receiver` is present if
    /// there are shadow maps.
    ///
    /// Lights have no size, so each takes one evaluation of the BRDF. They are summed in scene
    /// order, which determines the bits of the result.
    #[inline(always)]
    pub(crate) fn add_lights(
        &mut self,
        lights: &[Light],
        shadows: &[Option<LightShadow>],
        receiver: Option<&ShadowReceiver<N>>,
    ) {
        let mut ambient = [0.0; 3];
        for (index, light) in lights.iter().enumerate() {
            if let Some(lux) = light.ambient_lux() {
                ambient = [0, 1, 2].map(|k: usize| ambient[k] + lux[k]);
                continue;
            }
            let mut incident = light.incident_at(self.geometry.positions);
            if let (Some(Some(shadow)), Some(receiver)) = (shadows.get(index), receiver) {
                incident.apply_shadow(shadow, receiver);
            }
            // From the top layer down: sheen takes its share of the light before the base.
            if let Some(clearcoat) = &mut self.clearcoat {
                clearcoat.add_direct_light(&incident);
            }
            if let Some(sheen) = &self.sheen {
                sheen.add_direct_light(&self.geometry, &mut incident, &mut self.radiance);
            }
            let anisotropy = self.anisotropy.as_ref();
            self.base.add_direct_light(&self.geometry, &incident, anisotropy, &mut self.radiance);
        }
        // Ambient light is a uniform environment without a specular part, E / π from all
        // directions.
        if ambient != [0.0; 3] {
            self.add_diffuse(Rgb::splat(ambient.map(|lux| lux * FRAC_1_PI)));
        }
    }

    /// Adds the light from the environment: its irradiance reflected diffusely, and its prefiltered
    /// radiance reflected specularly.
    ///
    /// In the split-sum approximation, `Σ L · BRDF` becomes `prefiltered L(r, roughness)` times the
    /// specular albedo `F0 · A + F90 · B`. This is exact for a uniform environment; otherwise, the
    /// accuracy depends on how representative the light around the mirror direction is.
    ///
    /// The diffuse part is multiplied by the ambient occlusion; the specular part is multiplied by
    /// a function of ambient occlusion and viewing angle.
    #[inline(always)]
    pub(crate) fn add_environment(&mut self, environment: &Environment) {
        let SurfaceGeometry { normals, views, n_dot_v, .. } = self.geometry;
        // Diffuse image-based lighting.
        self.add_diffuse(environment.irradiance_over_pi(normals));
        // Specular image-based lighting: the first sum is from the environment, the second is in
        // the albedo. Split-sum approximation (Karis 2013).
        let roughness = self.base.roughness;
        let mirrors = match &self.anisotropy {
            Some(frame) => frame.bent_normals(normals, views, roughness),
            None => normals,
        };
        let light = environment.specular_radiance(mirrors, views, roughness);
        // Specular occlusion from ambient occlusion (Lagarde and de Rousiers 2014): at grazing
        // angles the mirror direction is less occluded than the hemisphere.
        let mut visibility = self.inputs.occlusion;
        if let Some(on_screen) = self.inputs.screen_visibility {
            visibility *= on_screen;
        }
        let sum = n_dot_v + visibility;
        let occlusion = (sum * sum - 1.0 + visibility).clamp(0.0, 1.0);
        // Albedo scaling by sheen, then the product of the split sum.
        let scale = self.base_scale() * occlusion;
        self.radiance += light * (self.base.specular_albedo * scale);
        if let Some(clearcoat) = &mut self.clearcoat {
            clearcoat.add_environment(environment);
        }
    }

    /// Adds diffuse light from all directions, specified as the radiance of a white Lambert
    /// surface.
    ///
    /// Sheen is handled separately: it reflects light from all directions according to its albedo.
    #[inline(always)]
    fn add_diffuse(&mut self, white: Rgb<N>) {
        let MaterialInputs { occlusion, screen_visibility, .. } = *self.inputs;
        // Lambert, below the specular interface and below sheen.
        let reflectance = self.base.diffuse * self.base.diffuse_transmittance * self.base_scale();
        // Screen-space occlusion comes from geometry, which may reflect some of the light that it
        // blocks.
        let mut light = white * occlusion;
        if let Some(visibility) = screen_visibility {
            light = light * add_bounces(visibility, reflectance);
        }
        self.radiance += reflectance * light;
        if let Some(sheen) = &self.sheen {
            self.radiance += sheen.reflectance() * light;
        }
    }

    /// Adds the light from behind that is visible through refracting or rough glass. Returns the
    /// part to add after tone mapping: the background and backdrop, and the alpha behind the
    /// surface.
    #[inline(always)]
    pub(crate) fn add_light_behind(
        &mut self,
        draw: &Draw<'_>,
        framebuffer: &TransmissionFramebuffer,
    ) -> Option<(Rgb<N>, Lanes<N>)> {
        let share = self.transmission?.color() * self.base_scale();
        let light = framebuffer.light_behind(draw, self.inputs, &self.geometry);
        self.radiance += light.radiance * share;
        let mut display = light.display * share;
        if let Some(clearcoat) = &self.clearcoat {
            display = display * clearcoat.transmittance();
        }
        Some((display, light.alpha))
    }

    /// Returns the fraction of light from all directions that sheen leaves for the base.
    #[inline(always)]
    fn base_scale(&self) -> Lanes<N> {
        match &self.sheen {
            Some(sheen) => sheen.base_scale(),
            None => Lanes::ONE,
        }
    }

    /// Returns the radiance of all layers, with the clearcoat over the rest.
    #[inline(always)]
    pub(crate) fn finish(&self) -> Rgb<N> {
        match &self.clearcoat {
            Some(clearcoat) => clearcoat.composite_over(self.radiance),
            None => self.radiance,
        }
    }
}
