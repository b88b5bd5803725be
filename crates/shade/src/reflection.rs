//! Reflection: all light that surfaces send on to the viewer, with the layers over them.

use super::environment::Environment;
use super::inputs::Inputs;
use super::layers::{Coat, Grain, Sheen};
use super::light::Light;
use super::normal::Facing;
use super::receiver::Receivers;
use super::seen::in_all;
use super::shadow::ShadowMap;
use super::substance::Substance;
use super::{Draw, Tangents};
use std::f32::consts::FRAC_1_PI;

/// What surfaces at some fragments reflect.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reflection<'a, const N: usize> {
    inputs: &'a Inputs<N>,
    facing: Facing<N>,
    substance: Substance<N>,
    sheen: Option<Sheen<N>>,
    grain: Option<Grain<N>>,
    coat: Option<Coat<N>>,
    /// The share of light that passes through the surface.
    pub(super) passing: [f32; N],
    /// The light below the coat.
    sums: [[f32; N]; 3],
}

impl<'a, const N: usize> Reflection<'a, N> {
    /// The surfaces of a draw, which give off light by themselves and reflect none yet.
    #[inline(always)]
    pub(super) fn of(
        draw: &Draw<'_>,
        inputs: &'a Inputs<N>,
        smooth: Facing<N>,
        tangents: &[[f32; N]; 4],
        emitted: [[f32; N]; 3],
    ) -> Self {
        let material = draw.material;
        let extensions = &material.extensions;
        let has_slopes = !matches!(draw.tangents, Tangents::None);
        let coat = extensions.clearcoat.as_deref().map(|coat| {
            let is_bent = coat.normal_texture.is_some() && has_slopes;
            let slope = &inputs.layers.coat_slope;
            Coat::of(&inputs.layers, if is_bent { smooth.bent(tangents, slope) } else { smooth })
        });
        let mut facing = smooth;
        if has_slopes && material.normal_texture.is_some() {
            facing = smooth.bent(tangents, &inputs.slope);
        }
        let mut substance = Substance::of(material, inputs, &facing);
        let mut passing = [0.0; N];
        if material.transmits() {
            passing = substance.pass(draw, inputs);
        }
        let sheen = extensions.sheen.as_ref().map(|_| Sheen::of(&inputs.layers, &facing));
        let grain = extensions
            .anisotropy
            .as_ref()
            .map(|grain| Grain::of(inputs, &facing, tangents, grain.rotation, &substance.alpha));
        Self { inputs, facing, substance, sheen, grain, coat, passing, sums: emitted }
    }

    /// What of light from everywhere fibres leave for what is below.
    #[inline(always)]
    fn left(&self) -> [f32; N] {
        self.sheen.as_ref().map_or([1.0; N], Sheen::left)
    }

    /// Adds what the lights of a scene send, where their shadows are not; there are `receivers` if there are shadows.
    #[inline(always)]
    pub(super) fn add_lights(
        &mut self,
        lights: &[Light],
        shadows: &[Option<ShadowMap>],
        receivers: Option<&Receivers<N>>,
    ) {
        let mut everywhere = [0.0; 3];
        for (number, light) in lights.iter().enumerate() {
            if let Some(lux) = light.ambient() {
                everywhere = [0, 1, 2].map(|k: usize| everywhere[k] + lux[k]);
                continue;
            }
            let mut arriving = light.at(&self.facing.places);
            if let (Some(Some(map)), Some(receivers)) = (shadows.get(number), receivers) {
                arriving.shade(map, receivers);
            }
            if let Some(coat) = &mut self.coat {
                coat.reflect(&arriving);
            }
            if let Some(sheen) = &self.sheen {
                sheen.reflect(&self.facing, &mut arriving, &mut self.sums);
            }
            self.substance.reflect(&self.facing, &arriving, self.grain.as_ref(), &mut self.sums);
        }
        if everywhere != [0.0; 3] {
            self.scatter(&in_all(everywhere.map(|lux| lux * FRAC_1_PI)));
        }
    }

    /// Adds what scatters light from everywhere: what a white matt surface would make of it is given.
    #[inline(always)]
    fn scatter(&mut self, white: &[[f32; N]; 3]) {
        let left = self.left();
        for channel in 0..3 {
            for lane in 0..N {
                let arriving = white[channel][lane] * self.inputs.occlusion[lane];
                let share = self.substance.diffuse[channel][lane] * self.substance.through[lane];
                self.sums[channel][lane] += share * left[lane] * arriving;
                if let Some(sheen) = &self.sheen {
                    self.sums[channel][lane] += sheen.share(channel, lane) * arriving;
                }
            }
        }
    }

    /// Adds the light of the surroundings.
    #[inline(always)]
    pub(super) fn add_environment(&mut self, environment: &Environment) {
        let Facing { normals, views, cosines, .. } = self.facing;
        self.scatter(&environment.scattered(&normals));
        let mirrored = environment.mirrored(&normals, &views, &self.substance.roughness);
        let left = self.left();
        for lane in 0..N {
            // What is occluded from everywhere is less so where one looks in flatly (Lagarde, de Rousiers 2014).
            let open = self.inputs.occlusion[lane];
            let reach = cosines[lane] + open;
            let share = left[lane] * (reach * reach - 1.0 + open).clamp(0.0, 1.0);
            for channel in 0..3 {
                let whole = self.substance.mirrored[channel][lane] * share;
                self.sums[channel][lane] += mirrored[channel][lane] * whole;
            }
        }
        if let Some(coat) = &mut self.coat {
            coat.mirror(environment);
        }
    }

    /// All of it, the coat over the rest.
    #[inline(always)]
    pub(super) fn whole(&self) -> [[f32; N]; 3] {
        let mut whole = self.sums;
        if let Some(coat) = &self.coat {
            coat.cover(&mut whole);
        }
        whole
    }
}
