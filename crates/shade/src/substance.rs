//! Substance: what of the light that arrives at a surface leaves it towards the viewer (glTF 2.0, Appendix B).
//!
//! ```text
//!  dielectric = (1 − F) · base / π  +  F · D V          metal = F(base) · D V          surface = mix(dielectric, metal, metallic)
//! ```
//!
//! Highlights are multiplied by what [`Albedo`] says they lack. Light from everywhere loses to the highlights what they reflect
//! in all, as light from one direction loses F.

use super::Draw;
use super::albedo::{Albedo, compensation};
use super::inputs::{Inputs, Layers};
use super::layers::{Grain, film_f0};
use super::light::Arriving;
use super::microfacet::{LEAST_ROUGHNESS, Meeting, alpha_of, fifth};
use super::normal::Facing;
use super::seen::lane_of;
use super::transmission::{grey_of, tint};
use model::{Material, MaterialExtensions};
use std::f32::consts::FRAC_1_PI;

/// What surfaces do with light at some fragments.
#[derive(Clone, Copy, Debug)]
pub(super) struct Substance<const N: usize> {
    /// The share of light that is scattered, before highlights take theirs.
    pub(super) diffuse: [[f32; N]; 3],
    /// The share of light that is mirrored straight back, and at grazing angles.
    f0: [[f32; N]; 3],
    f90: [f32; N],
    /// The same for the interface over what scatters; colours take their largest channel.
    over0: [f32; N],
    over90: [f32; N],
    /// The perceptual roughness, and α.
    pub(super) roughness: [f32; N],
    pub(super) alpha: [f32; N],
    /// What highlights are multiplied by.
    gain: [[f32; N]; 3],
    /// The share of white surroundings that is mirrored.
    pub(super) mirrored: [[f32; N]; 3],
    /// The share of light from everywhere that gets through to what scatters.
    pub(super) through: [f32; N],
}

impl<const N: usize> Substance<N> {
    #[inline(always)]
    pub(super) fn of(material: &Material, inputs: &Inputs<N>, facing: &Facing<N>) -> Self {
        let mut roughness = inputs.roughness;
        let mut alpha = [0.0; N];
        for lane in 0..N {
            // Where a pixel sees many directions of a curved surface, its highlight is as wide as they are.
            let least = roughness[lane].clamp(LEAST_ROUGHNESS, 1.0);
            roughness[lane] = (least + facing.turns[lane]).min(1.0);
            alpha[lane] = alpha_of(roughness[lane]);
        }
        let zero = [0.0; N];
        let mut substance = Self {
            diffuse: [zero; 3],
            f0: [zero; 3],
            f90: [1.0; N],
            over0: zero,
            over90: zero,
            roughness,
            alpha,
            gain: [[1.0; N]; 3],
            mirrored: [zero; 3],
            through: zero,
        };
        let extensions = &material.extensions;
        if extensions.specular_glossiness.is_some() {
            substance.older(inputs);
        } else {
            substance.metallic_roughness(extensions, inputs);
        }
        if let Some(film) = &extensions.iridescence {
            substance.film(film.ior, inputs, facing);
        }
        substance.balance(&Albedo::of(&substance.roughness, &facing.cosines));
        substance
    }

    /// Metalness mixes what reflects like glass or paint and what reflects like metal (KHR_materials_ior, KHR_materials_specular).
    #[inline(always)]
    fn metallic_roughness(&mut self, extensions: &MaterialExtensions, inputs: &Inputs<N>) {
        let Layers { specular, specular_color, .. } = &inputs.layers;
        let root = (extensions.ior - 1.0) / (extensions.ior + 1.0);
        let usual = root * root;
        for lane in 0..N {
            let metallic = inputs.metallic[lane];
            self.over90[lane] = specular[lane];
            self.f90[lane] = specular[lane] + (1.0 - specular[lane]) * metallic;
            for channel in 0..3 {
                let base = inputs.base[channel][lane];
                let dielectric = (usual * specular_color[channel][lane]).min(1.0) * specular[lane];
                self.over0[lane] = self.over0[lane].max(dielectric);
                self.diffuse[channel][lane] = base * (1.0 - metallic);
                self.f0[channel][lane] = dielectric + (base - dielectric) * metallic;
            }
        }
    }

    /// What highlights do not take is scattered (KHR_materials_pbrSpecularGlossiness).
    #[inline(always)]
    fn older(&mut self, inputs: &Inputs<N>) {
        let specular = &inputs.layers.specular_color;
        for lane in 0..N {
            let most = specular[0][lane].max(specular[1][lane]).max(specular[2][lane]).min(1.0);
            self.over0[lane] = most;
            self.over90[lane] = 1.0;
            for channel in 0..3 {
                self.diffuse[channel][lane] = inputs.base[channel][lane] * (1.0 - most);
                self.f0[channel][lane] = specular[channel][lane].min(1.0);
            }
        }
    }

    /// A thin film in the place of a part of the interface (KHR_materials_iridescence).
    #[inline(always)]
    fn film(&mut self, ior: f32, inputs: &Inputs<N>, facing: &Facing<N>) {
        for lane in 0..N {
            let [share, thickness] = [inputs.layers.film[lane], inputs.layers.film_thickness[lane]];
            let below = lane_of(&self.f0, lane);
            let colors = film_f0(below, ior, thickness, facing.cosines[lane]);
            let mut over = self.over0[lane];
            for channel in 0..3 {
                self.f0[channel][lane] += (colors[channel] - below[channel]) * share;
                over = over.max(
                    self.f0[channel][lane].min(self.over90[lane]) * (1.0 - inputs.metallic[lane]),
                );
            }
            self.over0[lane] = over;
        }
    }

    /// Lets a share of the light that would be scattered pass, and returns how much of all light does, as through a grey as bright as the
    /// tint; of colours see [`transmission`](super::transmission).
    #[inline(always)]
    pub(super) fn pass(&mut self, draw: &Draw<'_>, inputs: &Inputs<N>) -> [f32; N] {
        let mut passing = [0.0; N];
        for lane in 0..N {
            let share = inputs.layers.transmission[lane];
            for channel in 0..3 {
                self.diffuse[channel][lane] *= 1.0 - share;
            }
            let grey = grey_of(tint(&draw.material.extensions, inputs, draw.scale, lane));
            let dielectric = 1.0 - inputs.metallic[lane];
            passing[lane] = (share * dielectric * self.through[lane] * grey).clamp(0.0, 1.0);
        }
        passing
    }

    /// What follows from the albedo.
    #[inline(always)]
    fn balance(&mut self, albedo: &Albedo<N>) {
        for lane in 0..N {
            let (a, b) = (albedo.a[lane], albedo.b[lane]);
            let taken = (self.over0[lane] * a + self.over90[lane] * b)
                * compensation(self.over0[lane], a + b);
            self.through[lane] = 1.0 - taken;
            for channel in 0..3 {
                let f0 = self.f0[channel][lane];
                self.gain[channel][lane] = compensation(f0, a + b);
                self.mirrored[channel][lane] =
                    (f0 * a + self.f90[lane] * b) * self.gain[channel][lane];
            }
        }
    }

    /// Adds what leaves of the light from one direction.
    #[inline(always)]
    pub(super) fn reflect(
        &self,
        facing: &Facing<N>,
        arriving: &Arriving<N>,
        grain: Option<&Grain<N>>,
        sums: &mut [[f32; N]; 3],
    ) {
        let (mut lobes, mut grazing, mut scattered) = ([0.0; N], [0.0; N], [0.0; N]);
        for lane in 0..N {
            let meeting = Meeting::of(
                lane_of(&facing.normals, lane),
                lane_of(&facing.views, lane),
                lane_of(&arriving.towards, lane),
            );
            lobes[lane] = meeting.lobe(self.alpha[lane]);
            let share = fifth(1.0 - meeting.vh);
            grazing[lane] = share;
            let over = self.over0[lane] + (self.over90[lane] - self.over0[lane]) * share;
            scattered[lane] = meeting.nl * FRAC_1_PI * (1.0 - over);
        }
        if let Some(grain) = grain {
            for lane in 0..N {
                let [n, v, l] = [&facing.normals, &facing.views, &arriving.towards]
                    .map(|vectors| lane_of(vectors, lane));
                let meeting = Meeting::of(n, v, l);
                lobes[lane] = grain.lobe(&meeting, self.alpha[lane], v, l, lane);
            }
        }
        for channel in 0..3 {
            for lane in 0..N {
                let f0 = self.f0[channel][lane];
                let fresnel = f0 + (self.f90[lane] - f0) * grazing[lane];
                let mirrored = fresnel * self.gain[channel][lane] * lobes[lane];
                let leaving = self.diffuse[channel][lane] * scattered[lane] + mirrored;
                sums[channel][lane] += arriving.lux[channel][lane] * leaving;
            }
        }
    }
}
