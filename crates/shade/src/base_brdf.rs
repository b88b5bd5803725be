//! Substance: what of the light that arrives at a surface leaves it towards the viewer (glTF 2.0, Appendix B).
//!
//! ```text
//!  dielectric = (1 − F) · base / π  +  F · D V          metal = F(base) · D V          surface = mix(dielectric, metal, metallic)
//! ```
//!
//! Highlights are multiplied by what [`Albedo`] says they lack. Light from everywhere loses to the highlights what they reflect
//! in all, as light from one direction loses F.

use super::Draw;
use super::directional_albedo::{DirectionalAlbedo, energy_compensation};
use super::fragment_lanes::lane_vector;
use super::layers::{Anisotropy, thin_film_f0};
use super::light::IncidentLight;
use super::material_inputs::{LayerInputs, MaterialInputs};
use super::microfacet::{MIN_ROUGHNESS, ShadingAngles, pow5, roughness_to_alpha};
use super::surface_geometry::SurfaceGeometry;
use super::transmission::{luminance, transmission_tint};
use model::{Material, MaterialExtensions};
use std::f32::consts::FRAC_1_PI;

/// What surfaces do with light at some fragments.
#[derive(Clone, Copy, Debug)]
pub(super) struct BaseBrdf<const N: usize> {
    /// The share of light that is scattered, before highlights take theirs.
    pub(super) diffuse: [[f32; N]; 3],
    /// The share of light that is mirrored straight back, and at grazing angles.
    f0: [[f32; N]; 3],
    f90: [f32; N],
    /// The same for the interface over what scatters; colours take their largest channel.
    dielectric_f0: [f32; N],
    dielectric_f90: [f32; N],
    /// The perceptual roughness, and α.
    pub(super) roughness: [f32; N],
    pub(super) alpha: [f32; N],
    /// What highlights are multiplied by.
    energy_compensation: [[f32; N]; 3],
    /// The share of white surroundings that is mirrored.
    pub(super) specular_albedo: [[f32; N]; 3],
    /// The share of light from everywhere that gets through to what scatters.
    pub(super) diffuse_transmittance: [f32; N],
}

impl<const N: usize> BaseBrdf<N> {
    #[inline(always)]
    pub(super) fn new(
        material: &Material,
        inputs: &MaterialInputs<N>,
        facing: &SurfaceGeometry<N>,
    ) -> Self {
        let mut roughness = inputs.roughness;
        let mut alpha = [0.0; N];
        for lane in 0..N {
            // Where a pixel sees many directions of a curved surface, its highlight is as wide as they are.
            let least = roughness[lane].clamp(MIN_ROUGHNESS, 1.0);
            roughness[lane] = (least + facing.normal_variation[lane]).min(1.0);
            alpha[lane] = roughness_to_alpha(roughness[lane]);
        }
        let zero = [0.0; N];
        let mut substance = Self {
            diffuse: [zero; 3],
            f0: [zero; 3],
            f90: [1.0; N],
            dielectric_f0: zero,
            dielectric_f90: zero,
            roughness,
            alpha,
            energy_compensation: [[1.0; N]; 3],
            specular_albedo: [zero; 3],
            diffuse_transmittance: zero,
        };
        let extensions = &material.extensions;
        if extensions.specular_glossiness.is_some() {
            substance.set_specular_glossiness(inputs);
        } else {
            substance.set_metallic_roughness(extensions, inputs);
        }
        if let Some(film) = &extensions.iridescence {
            substance.apply_thin_film(film.ior, inputs, facing);
        }
        substance.apply_directional_albedo(&DirectionalAlbedo::lookup(
            &substance.roughness,
            &facing.n_dot_v,
        ));
        substance
    }

    /// Metalness mixes what reflects like glass or paint and what reflects like metal (KHR_materials_ior, KHR_materials_specular).
    #[inline(always)]
    fn set_metallic_roughness(
        &mut self,
        extensions: &MaterialExtensions,
        inputs: &MaterialInputs<N>,
    ) {
        let LayerInputs { specular, specular_color, .. } = &inputs.layers;
        let root = (extensions.ior - 1.0) / (extensions.ior + 1.0);
        let usual = root * root;
        for lane in 0..N {
            let metallic = inputs.metallic[lane];
            self.dielectric_f90[lane] = specular[lane];
            self.f90[lane] = specular[lane] + (1.0 - specular[lane]) * metallic;
            for channel in 0..3 {
                let base = inputs.base[channel][lane];
                let dielectric = (usual * specular_color[channel][lane]).min(1.0) * specular[lane];
                self.dielectric_f0[lane] = self.dielectric_f0[lane].max(dielectric);
                self.diffuse[channel][lane] = base * (1.0 - metallic);
                self.f0[channel][lane] = dielectric + (base - dielectric) * metallic;
            }
        }
    }

    /// What highlights do not take is scattered (KHR_materials_pbrSpecularGlossiness).
    #[inline(always)]
    fn set_specular_glossiness(&mut self, inputs: &MaterialInputs<N>) {
        let specular = &inputs.layers.specular_color;
        for lane in 0..N {
            let most = specular[0][lane].max(specular[1][lane]).max(specular[2][lane]).min(1.0);
            self.dielectric_f0[lane] = most;
            self.dielectric_f90[lane] = 1.0;
            for channel in 0..3 {
                self.diffuse[channel][lane] = inputs.base[channel][lane] * (1.0 - most);
                self.f0[channel][lane] = specular[channel][lane].min(1.0);
            }
        }
    }

    /// A thin film in the place of a part of the interface (KHR_materials_iridescence).
    #[inline(always)]
    fn apply_thin_film(
        &mut self,
        ior: f32,
        inputs: &MaterialInputs<N>,
        facing: &SurfaceGeometry<N>,
    ) {
        for lane in 0..N {
            let [share, thickness] =
                [inputs.layers.iridescence[lane], inputs.layers.iridescence_thickness[lane]];
            let below = lane_vector(&self.f0, lane);
            let colors = thin_film_f0(below, ior, thickness, facing.n_dot_v[lane]);
            let mut over = self.dielectric_f0[lane];
            for channel in 0..3 {
                self.f0[channel][lane] += (colors[channel] - below[channel]) * share;
                over = over.max(
                    self.f0[channel][lane].min(self.dielectric_f90[lane])
                        * (1.0 - inputs.metallic[lane]),
                );
            }
            self.dielectric_f0[lane] = over;
        }
    }

    /// Lets a share of the light that would be scattered pass, and returns how much of all light does, as through a grey as bright as the
    /// tint; of colours see [`transmission`](super::transmission).
    #[inline(always)]
    pub(super) fn transmit_diffuse(
        &mut self,
        draw: &Draw<'_>,
        inputs: &MaterialInputs<N>,
    ) -> [f32; N] {
        let mut passing = [0.0; N];
        for lane in 0..N {
            let share = inputs.layers.transmission[lane];
            for channel in 0..3 {
                self.diffuse[channel][lane] *= 1.0 - share;
            }
            let grey = luminance(transmission_tint(
                &draw.material.extensions,
                inputs,
                draw.world_scale,
                lane,
            ));
            let dielectric = 1.0 - inputs.metallic[lane];
            passing[lane] =
                (share * dielectric * self.diffuse_transmittance[lane] * grey).clamp(0.0, 1.0);
        }
        passing
    }

    /// What follows from the albedo.
    #[inline(always)]
    fn apply_directional_albedo(&mut self, albedo: &DirectionalAlbedo<N>) {
        for lane in 0..N {
            let (a, b) = (albedo.f0_scale[lane], albedo.f90_scale[lane]);
            let taken = (self.dielectric_f0[lane] * a + self.dielectric_f90[lane] * b)
                * energy_compensation(self.dielectric_f0[lane], a + b);
            self.diffuse_transmittance[lane] = 1.0 - taken;
            for channel in 0..3 {
                let f0 = self.f0[channel][lane];
                self.energy_compensation[channel][lane] = energy_compensation(f0, a + b);
                self.specular_albedo[channel][lane] =
                    (f0 * a + self.f90[lane] * b) * self.energy_compensation[channel][lane];
            }
        }
    }

    /// Adds what leaves of the light from one direction.
    #[inline(always)]
    pub(super) fn add_direct_light(
        &self,
        facing: &SurfaceGeometry<N>,
        arriving: &IncidentLight<N>,
        grain: Option<&Anisotropy<N>>,
        sums: &mut [[f32; N]; 3],
    ) {
        let (mut lobes, mut grazing, mut scattered) = ([0.0; N], [0.0; N], [0.0; N]);
        for lane in 0..N {
            let meeting = ShadingAngles::new(
                lane_vector(&facing.normals, lane),
                lane_vector(&facing.views, lane),
                lane_vector(&arriving.to_light, lane),
            );
            lobes[lane] = meeting.ggx_lobe(self.alpha[lane]);
            let share = pow5(1.0 - meeting.vh);
            grazing[lane] = share;
            let over = self.dielectric_f0[lane]
                + (self.dielectric_f90[lane] - self.dielectric_f0[lane]) * share;
            scattered[lane] = meeting.nl * FRAC_1_PI * (1.0 - over);
        }
        if let Some(grain) = grain {
            for lane in 0..N {
                let [n, v, l] = [&facing.normals, &facing.views, &arriving.to_light]
                    .map(|vectors| lane_vector(vectors, lane));
                let meeting = ShadingAngles::new(n, v, l);
                lobes[lane] = grain.specular_lobe(&meeting, self.alpha[lane], v, l, lane);
            }
        }
        for channel in 0..3 {
            for lane in 0..N {
                let f0 = self.f0[channel][lane];
                let fresnel = f0 + (self.f90[lane] - f0) * grazing[lane];
                let mirrored = fresnel * self.energy_compensation[channel][lane] * lobes[lane];
                let leaving = self.diffuse[channel][lane] * scattered[lane] + mirrored;
                sums[channel][lane] += arriving.lux[channel][lane] * leaving;
            }
        }
    }
}
