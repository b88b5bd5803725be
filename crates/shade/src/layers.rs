//! Layers over and in a surface: clear coat, fibres, long highlights and thin films, as the KHR_materials extensions have them.

use super::environment::Environment;
use super::fragment_lanes::{dot, lane_vector};
use super::light::IncidentLight;
use super::material_inputs::{LayerInputs, MaterialInputs};
use super::microfacet::{ShadingAngles, pow5, roughness_to_alpha};
use super::sheen::{charlie_lobe, sheen_albedo};
use super::surface_geometry::SurfaceGeometry;
use std::f32::consts::{FRAC_1_PI, PI};

/// A clear coat: a smooth layer of index of refraction 1.5 that reflects before anything below does
/// (KHR_materials_clearcoat).
#[derive(Clone, Copy, Debug)]
pub(super) struct Clearcoat<const N: usize> {
    geometry: SurfaceGeometry<N>,
    /// The perceptual roughness.
    roughness: [f32; N],
    alpha: [f32; N],
    /// The share of light that it reflects: its strength times Schlick's Fresnel for the normal.
    reflectance: [f32; N],
    /// What it reflects.
    specular_light: [[f32; N]; 3],
}

impl<const N: usize> Clearcoat<N> {
    /// The coat over a surface; `facing` has the coat's own normals.
    #[inline(always)]
    pub(super) fn new(layers: &LayerInputs<N>, facing: SurfaceGeometry<N>) -> Self {
        let mut coat = Self {
            geometry: facing,
            roughness: layers.clearcoat_roughness,
            alpha: [0.0; N],
            reflectance: [0.0; N],
            specular_light: [[0.0; N]; 3],
        };
        for lane in 0..N {
            coat.roughness[lane] =
                (layers.clearcoat_roughness[lane] + facing.normal_variation[lane]).clamp(0.0, 1.0);
            coat.alpha[lane] = roughness_to_alpha(coat.roughness[lane]);
            let fresnel = 0.04 + 0.96 * pow5(1.0 - facing.n_dot_v[lane]);
            coat.reflectance[lane] = layers.clearcoat[lane] * fresnel;
        }
        coat
    }

    /// Adds what it reflects of the light from one direction.
    #[inline(always)]
    pub(super) fn add_direct_light(&mut self, arriving: &IncidentLight<N>) {
        for lane in 0..N {
            let meeting = ShadingAngles::new(
                lane_vector(&self.geometry.normals, lane),
                lane_vector(&self.geometry.views, lane),
                lane_vector(&arriving.to_light, lane),
            );
            let lobe = meeting.ggx_lobe(self.alpha[lane]);
            for channel in 0..3 {
                self.specular_light[channel][lane] += arriving.lux[channel][lane] * lobe;
            }
        }
    }

    /// Adds what it mirrors of the surroundings.
    #[inline(always)]
    pub(super) fn add_environment(&mut self, environment: &Environment) {
        let SurfaceGeometry { normals, views, .. } = &self.geometry;
        let light = environment.specular_radiance(normals, views, &self.roughness);
        for channel in 0..3 {
            for lane in 0..N {
                self.specular_light[channel][lane] += light[channel][lane];
            }
        }
    }

    /// Lays it over what is below.
    #[inline(always)]
    pub(super) fn composite_over(&self, below: &mut [[f32; N]; 3]) {
        for channel in 0..3 {
            for lane in 0..N {
                let color = &mut below[channel][lane];
                *color += (self.specular_light[channel][lane] - *color) * self.reflectance[lane];
            }
        }
    }
}

/// Fibres that stand on a surface (KHR_materials_sheen): Estevez and Kulla, *Production friendly microfacet sheen BRDF*,
/// 2017.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheen<const N: usize> {
    color: [[f32; N]; 3],
    roughness: [f32; N],
    /// The largest channel of the colour.
    max_color: [f32; N],
    /// The share of white surroundings that white fibres reflect to the viewer.
    albedo: [f32; N],
}

impl<const N: usize> Sheen<N> {
    #[inline(always)]
    pub(super) fn new(layers: &LayerInputs<N>, facing: &SurfaceGeometry<N>) -> Self {
        let [r, g, b] = &layers.sheen_color;
        let mut sheen = Self {
            color: layers.sheen_color,
            roughness: layers.sheen_roughness,
            max_color: [0.0; N],
            albedo: [0.0; N],
        };
        for lane in 0..N {
            sheen.roughness[lane] = sheen.roughness[lane].clamp(0.07, 1.0);
            sheen.max_color[lane] = r[lane].max(g[lane]).max(b[lane]);
            sheen.albedo[lane] = sheen_albedo(facing.n_dot_v[lane], sheen.roughness[lane]);
        }
        sheen
    }

    /// Takes its share of the light from one direction, and adds what it reflects of it.
    #[inline(always)]
    pub(super) fn add_direct_light(
        &self,
        facing: &SurfaceGeometry<N>,
        arriving: &mut IncidentLight<N>,
        sums: &mut [[f32; N]; 3],
    ) {
        for lane in 0..N {
            let meeting = ShadingAngles::new(
                lane_vector(&facing.normals, lane),
                lane_vector(&facing.views, lane),
                lane_vector(&arriving.to_light, lane),
            );
            let lobe = charlie_lobe(self.roughness[lane], &meeting);
            let other = sheen_albedo(meeting.nl, self.roughness[lane]);
            let left = 1.0 - self.max_color[lane] * self.albedo[lane].max(other);
            for channel in 0..3 {
                let lux = &mut arriving.lux[channel][lane];
                sums[channel][lane] += *lux * self.color[channel][lane] * lobe;
                *lux *= left;
            }
        }
    }

    /// What of light from everywhere is left for what is below.
    #[inline(always)]
    pub(super) fn base_scale(&self) -> [f32; N] {
        let mut left = [1.0; N];
        for lane in 0..N {
            left[lane] = 1.0 - self.max_color[lane] * self.albedo[lane];
        }
        left
    }

    /// The share of light from everywhere that it reflects.
    #[inline(always)]
    pub(super) fn reflectance(&self, channel: usize, lane: usize) -> f32 {
        self.color[channel][lane] * self.albedo[lane]
    }
}

/// Which way highlights are long, and how rough the surface is along and across (KHR_materials_anisotropy).
#[derive(Clone, Copy, Debug)]
pub(super) struct Anisotropy<const N: usize> {
    tangents: [[f32; N]; 3],
    bitangents: [[f32; N]; 3],
    /// α along the grain.
    tangent_alpha: [f32; N],
}

impl<const N: usize> Anisotropy<N> {
    /// The grain of a surface whose tangents lie so, turned by an angle.
    #[inline(always)]
    pub(super) fn new(
        inputs: &MaterialInputs<N>,
        facing: &SurfaceGeometry<N>,
        tangents: &[[f32; N]; 4],
        rotation: f32,
        alpha: &[f32; N],
    ) -> Self {
        let (sin, cos) = (libm::sinf(rotation), libm::cosf(rotation));
        let zero = [[0.0; N]; 3];
        let mut grain = Self { tangents: zero, bitangents: zero, tangent_alpha: *alpha };
        for lane in 0..N {
            let n = lane_vector(&facing.normals, lane);
            let t = [tangents[0][lane], tangents[1][lane], tangents[2][lane]];
            let up = dot(n, t);
            let flat = [t[0] - n[0] * up, t[1] - n[1] * up, t[2] - n[2] * up];
            let square = dot(flat, flat);
            let per = if square > 1e-12 { 1.0 / square.sqrt() } else { 0.0 };
            let t = [flat[0] * per, flat[1] * per, flat[2] * per];
            let side = if tangents[3][lane] < 0.0 { -1.0 } else { 1.0 };
            let b = super::fragment_lanes::cross(n, t).map(|c| c * side);
            let [x, y] = [inputs.layers.anisotropy[0][lane], inputs.layers.anisotropy[1][lane]];
            let length = (x * x + y * y).sqrt().max(1e-6);
            let (x, y) = ((cos * x - sin * y) / length, (sin * x + cos * y) / length);
            for axis in 0..3 {
                grain.tangents[axis][lane] = t[axis] * x + b[axis] * y;
                grain.bitangents[axis][lane] = b[axis] * x - t[axis] * y;
            }
            let strength = inputs.layers.anisotropy[2][lane].clamp(0.0, 1.0);
            let kept = if per > 0.0 { strength * strength } else { 0.0 };
            grain.tangent_alpha[lane] = alpha[lane] + (1.0 - alpha[lane]) * kept;
        }
        grain
    }

    /// D · V · n·l where light meets the surface (Burley 2012; Heitz 2014).
    #[inline(always)]
    pub(super) fn specular_lobe(
        &self,
        meeting: &ShadingAngles,
        alpha: f32,
        v: [f32; 3],
        l: [f32; 3],
        lane: usize,
    ) -> f32 {
        let (t, b) = (lane_vector(&self.tangents, lane), lane_vector(&self.bitangents, lane));
        let (wide, narrow) = (self.tangent_alpha[lane], alpha);
        let sum = [l[0] + v[0], l[1] + v[1], l[2] + v[2]];
        let per = 1.0 / dot(sum, sum).max(1e-12).sqrt();
        let (th, bh) = (dot(t, sum) * per / wide, dot(b, sum) * per / narrow);
        let spread = (th * th + bh * bh + meeting.nh * meeting.nh).max(1e-9);
        let distribution = FRAC_1_PI / (wide * narrow * spread * spread);
        let root = |way: [f32; 3], cosine: f32| {
            let (along, across) = (wide * dot(t, way), narrow * dot(b, way));
            (along * along + across * across + cosine * cosine).sqrt()
        };
        let both = meeting.nl * root(v, meeting.nv) + meeting.nv * root(l, meeting.nl);
        distribution * (0.5 * meeting.nl) / both.max(1e-6)
    }
}

/// The share of light that a surface with a thin film mirrors (KHR_materials_iridescence), as the F0 that leads to it: Belcour and
/// Barla, *A practical extension to microfacet theory for the modeling of varying iridescence*, 2017.
///
/// `f0` is that of the surface below, `thickness` in nanometres, `cosine` that of the view.
pub(super) fn thin_film_f0(f0: [f32; 3], ior: f32, thickness: f32, cosine: f32) -> [f32; 3] {
    let start = (thickness / 0.03).clamp(0.0, 1.0);
    let ior = 1.0 + (ior - 1.0) * start * start * (3.0 - 2.0 * start);
    let sine_squared = (1.0 - cosine * cosine) / (ior * ior);
    let inside = (1.0 - sine_squared).max(0.0).sqrt();
    let schlick = |f0: f32, cosine: f32| f0 + (1.0 - f0) * pow5(1.0 - cosine);
    let mirrored = |a: f32, b: f32| {
        let root = (a - b) / (a + b);
        root * root
    };
    let first = schlick(mirrored(ior, 1.0), cosine);
    let passed = 1.0 - first;
    let path = 2.0 * ior * thickness * inside;
    let mut shares = [0.0; 3];
    let mut series = [[0.0; 3]; 2];
    let mut shifts = [0.0; 3];
    for channel in 0..3 {
        let root = (f0[channel] + 1e-4).clamp(0.0, 0.9999).sqrt();
        let below = (1.0 + root) / (1.0 - root);
        let second = schlick(mirrored(below, ior), inside);
        let both = (first * second).clamp(1e-5, 0.9999);
        let reflected = passed * passed * second / (1.0 - both);
        shares[channel] = first + reflected;
        series[0][channel] = (reflected - passed) * both.sqrt();
        series[1][channel] = series[0][channel] * both.sqrt();
        // Half a wave is lost where light is reflected by what is denser.
        shifts[channel] = PI + if below < ior { PI } else { 0.0 };
    }
    for (order, terms) in series.iter().enumerate() {
        let order = (order + 1) as f32;
        let seen = spectral_sensitivity(order * path, shifts.map(|shift| order * shift));
        for channel in 0..3 {
            shares[channel] += 2.0 * terms[channel] * seen[channel];
        }
    }
    let grazing = pow5(1.0 - cosine).clamp(0.0, 0.9999);
    shares.map(|share| ((share.clamp(0.0, 1.0) - grazing) / (1.0 - grazing)).clamp(0.0, 1.0))
}

/// How the eye sees waves with this difference of paths in nanometres: the Fourier transform of the CIE's curves, as Gaussians, in
/// linear sRGB.
fn spectral_sensitivity(path: f32, shifts: [f32; 3]) -> [f32; 3] {
    let phase = 2.0 * PI * path * 1e-9;
    let bell = |value: f32, place: f32, variance: f32, shift: f32| {
        let wave = libm::cosf(place * phase + shift) * libm::expf(-phase * phase * variance);
        value * (2.0 * PI * variance).sqrt() * wave / 1.068_5e-7
    };
    let x = bell(5.4856e-13, 1.681e6, 4.3278e9, shifts[0])
        + bell(9.747e-14, 2.2399e6, 4.5282e9, shifts[0]);
    let y = bell(4.4201e-13, 1.7953e6, 9.3046e9, shifts[1]);
    let z = bell(5.2481e-13, 2.2084e6, 6.6121e9, shifts[2]);
    [
        3.240_454_2 * x - 1.537_138_5 * y - 0.498_531_4 * z,
        -0.969_266 * x + 1.876_010_8 * y + 0.041_556 * z,
        0.055_643_4 * x - 0.204_025_9 * y + 1.057_225_2 * z,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_film_changes_nothing_and_no_film_makes_light() {
        for f0 in [0.02, 0.04, 0.3, 0.9] {
            let bare = thin_film_f0([f0; 3], 1.3, 0.0, 0.8);
            assert!(bare.iter().all(|found| (found - f0).abs() < 0.03), "{f0} {bare:?}");
            for step in 0..200 {
                let thickness = step as f32 * 6.0;
                for cosine in [1.0, 0.7, 0.3, 0.05, 0.0] {
                    let found = thin_film_f0([f0, f0 * 0.5, 0.0], 1.4, thickness, cosine);
                    assert!(found.iter().all(|share| (0.0..=1.0).contains(share)), "{found:?}");
                }
            }
        }
    }
}
