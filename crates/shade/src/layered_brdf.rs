//! Reflection: all light that surfaces send on to the viewer, with the layers over them.

use super::base_brdf::BaseBrdf;
use super::environment::Environment;
use super::fragment_lanes::splat;
use super::layers::{Anisotropy, Clearcoat, Sheen};
use super::light::Light;
use super::material_inputs::MaterialInputs;
use super::shadow_map::ShadowMap;
use super::shadow_receiver::ShadowReceiver;
use super::surface_geometry::SurfaceGeometry;
use super::{Draw, Tangents};
use std::f32::consts::FRAC_1_PI;

/// What surfaces at some fragments reflect.
#[derive(Clone, Copy, Debug)]
pub(super) struct LayeredBrdf<'a, const N: usize> {
    inputs: &'a MaterialInputs<N>,
    geometry: SurfaceGeometry<N>,
    base: BaseBrdf<N>,
    sheen: Option<Sheen<N>>,
    anisotropy: Option<Anisotropy<N>>,
    clearcoat: Option<Clearcoat<N>>,
    /// The share of light that passes through the surface.
    pub(super) transmittance: [f32; N],
    /// The light below the coat.
    radiance: [[f32; N]; 3],
}

impl<'a, const N: usize> LayeredBrdf<'a, N> {
    /// The surfaces of a draw, which give off light by themselves and reflect none yet.
    #[inline(always)]
    pub(super) fn new(
        draw: &Draw<'_>,
        inputs: &'a MaterialInputs<N>,
        smooth: SurfaceGeometry<N>,
        tangents: &[[f32; N]; 4],
        emitted: [[f32; N]; 3],
    ) -> Self {
        let material = draw.material;
        let extensions = &material.extensions;
        let has_slopes = !matches!(draw.tangents, Tangents::None);
        let clearcoat = extensions.clearcoat.as_deref().map(|coat| {
            let is_bent = coat.normal_texture.is_some() && has_slopes;
            let slope = &inputs.layers.clearcoat_normal;
            Clearcoat::new(
                &inputs.layers,
                if is_bent { smooth.with_tangent_normal(tangents, slope) } else { smooth },
            )
        });
        let mut geometry = smooth;
        if has_slopes && material.normal_texture.is_some() {
            geometry = smooth.with_tangent_normal(tangents, &inputs.tangent_normal);
        }
        let mut base = BaseBrdf::new(material, inputs, &geometry);
        let mut transmittance = [0.0; N];
        if material.is_transmissive() {
            transmittance = base.transmit_diffuse(draw, inputs);
        }
        let sheen = extensions.sheen.as_ref().map(|_| Sheen::new(&inputs.layers, &geometry));
        let anisotropy = extensions
            .anisotropy
            .as_ref()
            .map(|grain| Anisotropy::new(inputs, &geometry, tangents, grain.rotation, &base.alpha));
        Self {
            inputs,
            geometry,
            base,
            sheen,
            anisotropy,
            clearcoat,
            transmittance,
            radiance: emitted,
        }
    }

    /// What of light from everywhere fibres leave for what is below.
    #[inline(always)]
    fn base_scale(&self) -> [f32; N] {
        self.sheen.as_ref().map_or([1.0; N], Sheen::base_scale)
    }

    /// Adds what the lights of a scene send, where their shadows are not; there are `receivers` if there are shadows.
    #[inline(always)]
    pub(super) fn add_lights(
        &mut self,
        lights: &[Light],
        shadows: &[Option<ShadowMap>],
        receivers: Option<&ShadowReceiver<N>>,
    ) {
        let mut everywhere = [0.0; 3];
        for (number, light) in lights.iter().enumerate() {
            if let Some(lux) = light.ambient_lux() {
                everywhere = [0, 1, 2].map(|k: usize| everywhere[k] + lux[k]);
                continue;
            }
            let mut arriving = light.incident_at(&self.geometry.positions);
            if let (Some(Some(map)), Some(receivers)) = (shadows.get(number), receivers) {
                arriving.apply_shadow(map, receivers);
            }
            if let Some(coat) = &mut self.clearcoat {
                coat.add_direct_light(&arriving);
            }
            if let Some(sheen) = &self.sheen {
                sheen.add_direct_light(&self.geometry, &mut arriving, &mut self.radiance);
            }
            self.base.add_direct_light(
                &self.geometry,
                &arriving,
                self.anisotropy.as_ref(),
                &mut self.radiance,
            );
        }
        if everywhere != [0.0; 3] {
            self.add_diffuse(&splat(everywhere.map(|lux| lux * FRAC_1_PI)));
        }
    }

    /// Adds what scatters light from everywhere: what a white matt surface would make of it is given.
    #[inline(always)]
    fn add_diffuse(&mut self, white: &[[f32; N]; 3]) {
        let left = self.base_scale();
        for channel in 0..3 {
            for lane in 0..N {
                let arriving = white[channel][lane] * self.inputs.occlusion[lane];
                let share =
                    self.base.diffuse[channel][lane] * self.base.diffuse_transmittance[lane];
                self.radiance[channel][lane] += share * left[lane] * arriving;
                if let Some(sheen) = &self.sheen {
                    self.radiance[channel][lane] += sheen.reflectance(channel, lane) * arriving;
                }
            }
        }
    }

    /// Adds the light of the surroundings.
    #[inline(always)]
    pub(super) fn add_environment(&mut self, environment: &Environment) {
        let SurfaceGeometry { normals, views, n_dot_v: cosines, .. } = self.geometry;
        self.add_diffuse(&environment.irradiance_over_pi(&normals));
        let mirrored = environment.specular_radiance(&normals, &views, &self.base.roughness);
        let left = self.base_scale();
        for lane in 0..N {
            // What is occluded from everywhere is less so where one looks in flatly (Lagarde, de Rousiers 2014).
            let open = self.inputs.occlusion[lane];
            let reach = cosines[lane] + open;
            let share = left[lane] * (reach * reach - 1.0 + open).clamp(0.0, 1.0);
            for channel in 0..3 {
                let whole = self.base.specular_albedo[channel][lane] * share;
                self.radiance[channel][lane] += mirrored[channel][lane] * whole;
            }
        }
        if let Some(coat) = &mut self.clearcoat {
            coat.add_environment(environment);
        }
    }

    /// All of it, the coat over the rest.
    #[inline(always)]
    pub(super) fn finish(&self) -> [[f32; N]; 3] {
        let mut whole = self.radiance;
        if let Some(coat) = &self.clearcoat {
            coat.composite_over(&mut whole);
        }
        whole
    }
}
