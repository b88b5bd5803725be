//! Microfacets: how a rough surface reflects light from one direction (glTF 2.0, Appendix B).
//!
//! With unit vectors l to the light, v to the viewer, n the normal, h halfway between l and v, and α the square of the
//! perceptual roughness:
//!
//! ```text
//!  D = α² / (π · ((n·h)² (α² − 1) + 1)²)                                       GGX (Trowbridge, Reitz 1975; Walter et al. 2007)
//!  V = ½ / (n·l √(α² + (1 − α²)(n·v)²) + n·v √(α² + (1 − α²)(n·l)²))           Smith, with heights correlated (Heitz 2014)
//!  F = F0 + (F90 − F0)(1 − v·h)⁵                                               Schlick 1994
//! ```

use super::fragment_lanes::{cross, dot};
use std::f32::consts::FRAC_1_PI;

/// The least perceptual roughness: below it the highlight of a light without size would have no size either.
pub(super) const MIN_ROUGHNESS: f32 = 0.045;

/// The directions that meet where a light is reflected.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShadingAngles {
    /// n·l, not below 0.
    pub(super) nl: f32,
    /// n·v, not below 0.
    pub(super) nv: f32,
    /// n·h.
    pub(super) nh: f32,
    /// v·h.
    pub(super) vh: f32,
    /// 1 − (n·h)², without cancellation where that is small: the square of n × h.
    pub(super) sin_squared: f32,
}

impl ShadingAngles {
    #[inline(always)]
    pub(super) fn new(n: [f32; 3], v: [f32; 3], l: [f32; 3]) -> Self {
        let sum = [l[0] + v[0], l[1] + v[1], l[2] + v[2]];
        let per = 1.0 / dot(sum, sum).max(1e-12).sqrt();
        let h = [sum[0] * per, sum[1] * per, sum[2] * per];
        let side = cross(n, h);
        Self {
            nl: dot(n, l).clamp(0.0, 1.0),
            nv: dot(n, v).clamp(0.0, 1.0),
            nh: dot(n, h).clamp(0.0, 1.0),
            vh: dot(v, h).clamp(0.0, 1.0),
            sin_squared: dot(side, side),
        }
    }

    /// D · V · n·l for α.
    #[inline(always)]
    pub(super) fn ggx_lobe(&self, alpha: f32) -> f32 {
        let square = alpha * alpha;
        let width = (self.sin_squared + self.nh * self.nh * square).max(1e-9);
        let distribution = FRAC_1_PI * square / (width * width);
        let rest = 1.0 - square;
        let root = |c: f32| (square + rest * c * c).sqrt();
        let both = self.nl * root(self.nv) + self.nv * root(self.nl);
        distribution * (0.5 * self.nl) / both.max(1e-6)
    }
}

/// x⁵.
#[inline(always)]
pub(super) fn pow5(x: f32) -> f32 {
    let square = x * x;
    square * square * x
}

/// α of a perceptual roughness.
#[inline(always)]
pub(super) fn roughness_to_alpha(roughness: f32) -> f32 {
    let kept = roughness.clamp(MIN_ROUGHNESS, 1.0);
    kept * kept
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The formulas as they stand in the specification, in double precision.
    fn by_the_book(n: [f64; 3], v: [f64; 3], l: [f64; 3], alpha: f64) -> f64 {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let unit = |a: [f64; 3]| a.map(|c| c / dot(a, a).sqrt());
        let h = unit([0, 1, 2].map(|k: usize| l[k] + v[k]));
        let (nl, nv, nh) = (dot(n, l), dot(n, v), dot(n, h));
        if nl <= 0.0 || nv <= 0.0 {
            return 0.0;
        }
        let a2 = alpha * alpha;
        let below = nh * nh * (a2 - 1.0) + 1.0;
        let d = a2 / (std::f64::consts::PI * below * below);
        let root = |c: f64| (a2 + (1.0 - a2) * c * c).sqrt();
        d * 0.5 / (nl * root(nv) + nv * root(nl)) * nl
    }

    #[test]
    fn lobes_are_those_of_the_specification() {
        let unit = |x: f64, y: f64| [x, y, (1.0 - x * x - y * y).sqrt()];
        for alpha in [0.002_025, 0.01, 0.1, 0.5, 1.0] {
            for step in 0..60 {
                let t = f64::from(step) / 60.0;
                let (v, l) = (unit(0.9 * t, 0.2), unit(-0.9 * t + 0.03 * t * t, -0.2 + 0.01 * t));
                let narrow = |a: [f64; 3]| a.map(|c| c as f32);
                let wide = |a: [f32; 3]| a.map(f64::from);
                let (v, l) = (narrow(v), narrow(l));
                let due = by_the_book([0.0, 0.0, 1.0], wide(v), wide(l), alpha);
                let found = ShadingAngles::new([0.0, 0.0, 1.0], v, l).ggx_lobe(alpha as f32);
                assert!(
                    (f64::from(found) - due).abs() <= due * 2e-3 + 1e-6,
                    "{alpha} {t}: {found} {due}"
                );
            }
        }
    }

    #[test]
    fn no_meeting_makes_a_number_that_is_none() {
        let n = [0.0, 0.0, 1.0];
        for (v, l) in [(n, [0.0, 0.0, -1.0]), ([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]), (n, n)] {
            for alpha in [roughness_to_alpha(0.0), 1.0] {
                let lobe = ShadingAngles::new(n, v, l).ggx_lobe(alpha);
                assert!(lobe.is_finite() && lobe >= 0.0, "{lobe}");
            }
        }
    }
}
