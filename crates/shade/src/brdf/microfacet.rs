//! The microfacet BRDF: GGX distribution, Smith height-correlated visibility, Schlick Fresnel
//! (glTF 2.0, Appendix B).
//!
//! Let l be the unit vector to the light, v the unit vector to the viewer, n the normal, h halfway
//! between l and v, and α the square of the perceptual roughness. Then
//!
//! ```text
//!  D = α² / (π · ((n·h)² (α² − 1) + 1)²)          GGX: Trowbridge, Reitz 1975; Walter et al. 2007
//!  V = ½ / (n·l √(α² + (1 − α²)(n·v)²)
//!         + n·v √(α² + (1 − α²)(n·l)²))           Smith, height-correlated: Heitz 2014
//!  F = F0 + (F90 − F0)(1 − v·h)⁵                  Schlick 1994
//! ```
//!
//! `V` is Smith's masking-shadowing `G₂` divided by the Cook-Torrance denominator `4 n·l n·v`.
//!
//! All directions are in world space, on the visible side of the surface; cosines below 0 are
//! clamped to 0. Lobes are `D · V · n·l`: they exclude Fresnel, which differs between base and
//! clearcoat, and include the cosine of Lambert's law for the light.

use crate::lanes::{Lanes, Vec3Lanes};
use std::f32::consts::FRAC_1_PI;
use std::ops::Mul;

/// The minimum perceptual roughness, because at 0 the highlight of a punctual light would be
/// infinitely small.
///
/// The GGX peak 1 / (π α²) is then about 78,000, well within `f32`.
pub(super) const MIN_ROUGHNESS: f32 = 0.045;

/// The cosines between normal, view, light and half vector that BRDF terms depend on.
///
/// They are computed once per light and shared by all terms with the same normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShadingAngles<const N: usize> {
    /// n·l, not below 0.
    pub(super) n_dot_l: Lanes<N>,
    /// n·v, not below 0.
    pub(super) n_dot_v: Lanes<N>,
    /// n·h, not below 0.
    pub(super) n_dot_h: Lanes<N>,
    /// v·h, not below 0.
    pub(super) v_dot_h: Lanes<N>,
    /// 1 − (n·h)², computed as the squared length of n × h to avoid cancellation for small values.
    pub(super) sin_squared_h: Lanes<N>,
}

impl<const N: usize> ShadingAngles<N> {
    /// Computes the cosines of the angles between unit vectors: the normal, and the directions to
    /// the viewer and the light.
    ///
    /// The half vector is the normal of the microfacets that reflect l to v.
    #[inline(always)]
    pub(super) fn new(n: Vec3Lanes<N>, v: Vec3Lanes<N>, l: Vec3Lanes<N>) -> Self {
        // The half vector is zero instead of NaN if light and view are opposite.
        let sum = l + v;
        let h = sum * (1.0 / sum.dot(sum).max(1e-12).sqrt());
        let n_cross_h = n.cross(h);
        Self {
            n_dot_l: n.dot(l).clamp(0.0, 1.0),
            n_dot_v: n.dot(v).clamp(0.0, 1.0),
            n_dot_h: n.dot(h).clamp(0.0, 1.0),
            v_dot_h: v.dot(h).clamp(0.0, 1.0),
            sin_squared_h: n_cross_h.dot(n_cross_h),
        }
    }

    /// Computes the GGX specular lobe with the cosine factor but without Fresnel: `D · V · n·l`.
    #[inline(always)]
    pub(super) fn ggx_lobe(&self, alpha: Lanes<N>) -> Lanes<N> {
        // GGX depends only on α².
        let alpha_squared = alpha * alpha;
        // GGX distribution, with (n·h)² (α² − 1) + 1 written as sin² + (n·h)² α²: the form in the
        // specification loses all digits in the highlight of a smooth surface.
        let width = (self.sin_squared_h + self.n_dot_h * self.n_dot_h * alpha_squared).max(1e-9);
        let distribution = FRAC_1_PI * alpha_squared / (width * width);
        // Smith height-correlated visibility (Heitz 2014).
        let one_minus = 1.0 - alpha_squared;
        // cosθ √(1 + α² tan²θ), the root in Smith's Λ for GGX.
        let lambda = |cosine: Lanes<N>| (alpha_squared + one_minus * cosine * cosine).sqrt();
        let masking = self.n_dot_l * lambda(self.n_dot_v) + self.n_dot_v * lambda(self.n_dot_l);
        // V = G₂ / (4 n·l n·v), bounded if both directions are at grazing angles.
        distribution * (0.5 * self.n_dot_l) / masking.max(1e-6)
    }
}

/// Computes x⁵, the weight of F90 in Schlick's Fresnel approximation for x = 1 − cosine.
///
/// This takes three multiplications, in the same order for every lane and instruction set.
#[inline(always)]
pub(super) fn pow5<T: Copy + Mul<Output = T>>(x: T) -> T {
    let square = x * x;
    square * square * x
}

/// Returns the GGX α, the square of the perceptual roughness, after the roughness is raised to at
/// least [`MIN_ROUGHNESS`].
///
/// Squaring makes equal steps of the parameter look equal (Burley 2012; glTF 2.0, Appendix B).
#[inline(always)]
pub(super) fn roughness_to_alpha<const N: usize>(roughness: Lanes<N>) -> Lanes<N> {
    let bounded = roughness.clamp(MIN_ROUGHNESS, 1.0);
    bounded * bounded
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the lobe for one light.
    fn ggx_lobe(n: [f32; 3], v: [f32; 3], l: [f32; 3], alpha: f32) -> f32 {
        let [n, v, l] = [n, v, l].map(Vec3Lanes::<1>::splat);
        ShadingAngles::new(n, v, l).ggx_lobe(Lanes([alpha]))[0]
    }

    /// Evaluates the formulas in double precision, as written in the specification.
    fn specified_lobe(n: [f64; 3], v: [f64; 3], l: [f64; 3], alpha: f64) -> f64 {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let unit = |a: [f64; 3]| a.map(|c| c / dot(a, a).sqrt());
        let h = unit([0, 1, 2].map(|k: usize| l[k] + v[k]));
        let (n_dot_l, n_dot_v, n_dot_h) = (dot(n, l), dot(n, v), dot(n, h));
        if n_dot_l <= 0.0 || n_dot_v <= 0.0 {
            return 0.0;
        }
        let a2 = alpha * alpha;
        let denominator = n_dot_h * n_dot_h * (a2 - 1.0) + 1.0;
        let d = a2 / (std::f64::consts::PI * denominator * denominator);
        let lambda = |c: f64| (a2 + (1.0 - a2) * c * c).sqrt();
        d * 0.5 / (n_dot_l * lambda(n_dot_v) + n_dot_v * lambda(n_dot_l)) * n_dot_l
    }

    #[test]
    fn lobes_match_the_specification() {
        let unit = |x: f64, y: f64| [x, y, (1.0 - x * x - y * y).sqrt()];
        for alpha in [0.002_025, 0.01, 0.1, 0.5, 1.0] {
            for step in 0..60 {
                let t = f64::from(step) / 60.0;
                let (v, l) = (unit(0.9 * t, 0.2), unit(-0.9 * t + 0.03 * t * t, -0.2 + 0.01 * t));
                let [v, l] = [v, l].map(|vector| vector.map(|c| c as f32));
                let [v64, l64] = [v, l].map(|vector| vector.map(f64::from));
                let expected = specified_lobe([0.0, 0.0, 1.0], v64, l64, alpha);
                let actual = f64::from(ggx_lobe([0.0, 0.0, 1.0], v, l, alpha as f32));
                assert!(
                    (actual - expected).abs() <= expected * 2e-3 + 1e-6,
                    "{alpha} {t}: {actual} {expected}"
                );
            }
        }
    }

    #[test]
    fn lobes_are_finite_for_opposite_or_perpendicular_vectors() {
        let n = [0.0, 0.0, 1.0];
        for (v, l) in [(n, [0.0, 0.0, -1.0]), ([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]), (n, n)] {
            for alpha in [roughness_to_alpha(Lanes([0.0]))[0], 1.0] {
                let lobe = ggx_lobe(n, v, l, alpha);
                assert!(lobe.is_finite() && lobe >= 0.0, "{lobe}");
            }
        }
    }
}
