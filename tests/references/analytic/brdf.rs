//! The glTF metallic-roughness BRDF in double precision, written from the specification (glTF 2.0,
//! Appendix B).
//!
//! It shares no code with the renderer. The energy that microfacets reflect onto each other is
//! restored by the factor `1 + F0 (1 − E)/E` (Turquin, *Practical multiple scattering compensation
//! for microfacet models*, 2019), with the directional albedo `E` integrated numerically.

use glam::DVec3;
use std::f64::consts::{FRAC_1_PI, PI};

/// The color and finish of a surface.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Material {
    /// The base color in linear light, from 0 to 1.
    pub base_color: [f64; 3],
    /// The coverage, from 0 to 1.
    pub alpha: f64,
    pub metallic: f64,
    /// The perceptual roughness, which is the square root of GGX's α.
    pub roughness: f64,
    /// Whether the base color is shown in any light (KHR_materials_unlit).
    pub unlit: bool,
}

impl Material {
    /// Creates an opaque dielectric.
    pub fn dielectric(base_color: [f64; 3], roughness: f64) -> Self {
        Self { base_color, alpha: 1.0, metallic: 0.0, roughness, unlit: false }
    }

    /// Creates an opaque metal.
    pub fn metal(base_color: [f64; 3], roughness: f64) -> Self {
        Self { metallic: 1.0, ..Self::dielectric(base_color, roughness) }
    }

    /// Creates an unlit color that is blended over the surfaces behind it.
    pub fn unlit(base_color: [f64; 3], alpha: f64) -> Self {
        Self { unlit: true, alpha, ..Self::dielectric(base_color, 1.0) }
    }

    /// Returns the linear light toward the viewer from a point with the unit normal `n`, where `v`
    /// is the unit direction to the viewer.
    pub fn shade(&self, n: DVec3, v: DVec3, lights: &Lights) -> [f64; 3] {
        if self.unlit {
            return self.base_color;
        }
        let l = -lights.sun_direction.normalize();
        let h = (l + v).normalize();
        let (nl, nv) = (n.dot(l).max(0.0), n.dot(v).clamp(1e-4, 1.0));
        let alpha = self.roughness * self.roughness;
        let schlick = {
            let grazing = 1.0 - v.dot(h);
            grazing * grazing * grazing * grazing * grazing
        };
        let lobe = distribution(n.dot(h), alpha) * visibility(nl, nv, alpha);
        let albedo = directional_albedo(nv, alpha);
        self.base_color.map(|base| {
            let f0 = 0.04 + (base - 0.04) * self.metallic;
            let diffuse = base * (1.0 - self.metallic) * FRAC_1_PI;
            let fresnel_of_dielectric = 0.04 + 0.96 * schlick;
            let specular = (f0 + (1.0 - f0) * schlick) * lobe * (1.0 + f0 * (1.0 / albedo - 1.0));
            lights.sun * nl * (diffuse * (1.0 - fresnel_of_dielectric) + specular)
                + lights.ambient * diffuse
        })
    }
}

/// One directional light and constant ambient light, in lux.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Lights {
    /// The direction in which the sunlight travels.
    pub sun_direction: DVec3,
    pub sun: f64,
    pub ambient: f64,
}

/// Computes D, the GGX distribution of half-vectors (Walter et al. 2007).
fn distribution(nh: f64, alpha: f64) -> f64 {
    let square = alpha * alpha;
    let width = nh * nh * (square - 1.0) + 1.0;
    square * FRAC_1_PI / (width * width)
}

/// Computes V, Smith's height-correlated masking and shadowing, divided by 4 n·l n·v (Heitz 2014).
fn visibility(nl: f64, nv: f64, alpha: f64) -> f64 {
    let square = alpha * alpha;
    let root = |c: f64| (square + (1.0 - square) * c * c).sqrt();
    0.5 / (nl * root(nv) + nv * root(nl)).max(1e-12)
}

/// Computes E, the fraction of white light from all directions that the lobe reflects to a viewer
/// at n·v, without Fresnel. It uses the midpoint rule over half-vectors distributed as D n·h.
pub fn directional_albedo(nv: f64, alpha: f64) -> f64 {
    const STEPS: u32 = 48;
    // Half a turn is enough, because the other half has the same values.
    const AZIMUTHS: u32 = 12;
    let turns: [(f64, f64); AZIMUTHS as usize] =
        std::array::from_fn(|index| libm::sincos(PI * (index as f64 + 0.5) / f64::from(AZIMUTHS)));
    let view = DVec3::new((1.0 - nv * nv).max(0.0).sqrt(), 0.0, nv);
    let mut sum = 0.0;
    for i in 0..STEPS {
        let u = (f64::from(i) + 0.5) / f64::from(STEPS);
        let cosine = ((1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u)).sqrt();
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        for (sin, cos) in turns {
            let half = DVec3::new(sine * cos, sine * sin, cosine);
            let vh = view.dot(half);
            let nl = 2.0 * vh * cosine - nv;
            if nl > 0.0 && vh > 0.0 {
                // The density of l is D n·h / (4 v·h); D cancels.
                sum += visibility(nl, nv, alpha) * nl * 4.0 * vh / cosine;
            }
        }
    }
    sum / f64::from(STEPS * AZIMUTHS)
}
