//! Thin-film interference: iridescence, as on soap bubbles and oil (KHR_materials_iridescence).
//!
//! Belcour and Barla, *A practical extension to microfacet theory for the modeling of varying
//! iridescence*, 2017. Light is reflected by the top of the film and, after one or more passes, by
//! the surface below. The parts interfere with a phase that grows with the path length in the film:
//!
//! ```text
//!   ╲   ╱   ╱   ╱      R = R₀ + Σ Cₘ · cos(m · phase)      air
//!  ──╲─╱───╱───╱──
//!     ╲╱╲ ╱ ╲ ╱        optical path difference              film
//!  ────╲───╲─────      2 · ior · thickness · cosθ
//!                                                           base
//! ```
//!
//! The sum over the spectrum is computed in Fourier space, where the sensitivity curves of the eye
//! are Gaussians. The result is returned as the F0 that yields it in Schlick's approximation.

use super::microfacet::pow5;
use crate::approximations::{cosine_of_turns, exp2_approx};
use crate::color::{XYZ_TO_SRGB, multiply_matrix};
use crate::lanes::{Lanes, Rgb};
use std::f32::consts::{LOG2_E, PI};

/// Computes the F0 of surfaces under a thin film at the given view cosines.
///
/// `f0` is the surface's F0 without the film, `ior` is the film's index of refraction, and
/// `thickness` is in nanometers. As the thickness approaches 0, the film's index approaches 1, as
/// in air.
///
/// Each channel of F0 gives an index of refraction for the base, so interference on a colored metal
/// is computed per channel. The cost is two harmonics with four Gaussians and cosines each.
#[cfg_attr(not(any(target_family = "wasm", debug_assertions)), inline(always))]
#[cfg_attr(any(target_family = "wasm", debug_assertions), inline(never))]
pub(super) fn thin_film_f0<const N: usize>(
    f0: Rgb<N>,
    ior: f32,
    thickness: Lanes<N>,
    cosine: Lanes<N>,
) -> Rgb<N> {
    // As the film vanishes, its index of refraction becomes 1.
    let start = (thickness / 0.03).clamp(0.0, 1.0);
    let ior = 1.0 + (ior - 1.0) * start * start * (3.0 - 2.0 * start);
    // Snell's law: the cosine inside the film.
    let sine_squared = (1.0 - cosine * cosine) / (ior * ior);
    let film_cosine = (1.0 - sine_squared).max(0.0).sqrt();
    // First interface, air to film.
    let r12 = schlick_fresnel(normal_reflectance(ior, Lanes::ONE), cosine);
    let t121 = 1.0 - r12;
    // Second interface, film to base, with the base's index of refraction from its F0.
    let base_ior = f0.map(|f0| {
        let root = (f0 + 1e-4).clamp(0.0, 0.9999).sqrt();
        (1.0 + root) / (1.0 - root)
    });
    let r23 = base_ior.map(|base| schlick_fresnel(normal_reflectance(base, ior), film_cosine));
    // The constant term and the first two harmonics of the series of reflections.
    let r123 = r23.map(|r23| (r12 * r23).clamp(1e-5, 0.9999));
    let rs = r23.zip(r123, |r23, r123| t121 * t121 * r23 / (1.0 - r123));
    let root = r123.map(Lanes::sqrt);
    let first = rs.map(|rs| rs - t121) * root;
    // Reflection by a denser medium shifts the phase by half a wave; phases are in turns.
    let half = Lanes::splat(0.5);
    let shifts = base_ior.map(|base| Lanes::ONE.select(&(base - ior).is_below(0.0), half));
    // Airy summation in Fourier space: each harmonic times the eye's response to its optical path
    // difference, 2 n d cosθ in the film.
    let path = 2.0 * ior * thickness * film_cosine;
    let once = spectral_sensitivity(path, shifts);
    let twice = spectral_sensitivity(2.0 * path, shifts * 2.0);
    let reflectance = rs.map(|rs| r12 + rs) + (first * once + first * root * twice) * 2.0;
    // The F0 for which Schlick's approximation gives this reflectance at the cosine.
    let schlick = pow5(1.0 - cosine).clamp(0.0, 0.9999);
    reflectance.map(|total| ((total.clamp(0.0, 1.0) - schlick) / (1.0 - schlick)).clamp(0.0, 1.0))
}

/// Computes the Fresnel reflectance at normal incidence between media with these indices of
/// refraction.
///
/// This is ((a − b) / (a + b))², for non-absorbing media.
#[inline(always)]
fn normal_reflectance<const N: usize>(a: Lanes<N>, b: Lanes<N>) -> Lanes<N> {
    let root = (a - b) / (a + b);
    root * root
}

/// Evaluates Schlick's approximation with F90 = 1.
///
/// Schlick 1994, for an interface that reflects all light at grazing angles.
#[inline(always)]
fn schlick_fresnel<const N: usize>(f0: Lanes<N>, cosine: Lanes<N>) -> Lanes<N> {
    f0 + (1.0 - f0) * pow5(1.0 - cosine)
}

/// Computes the response of the eye, in linear sRGB, to waves with an optical path difference in
/// nanometers. This is the Fourier transform of the CIE 1931 curves, fitted by Gaussians (Belcour
/// and Barla 2017).
///
/// X, Y and Z use separate phase shifts in turns, one per channel of the base, and are converted to
/// sRGB.
#[inline(always)]
fn spectral_sensitivity<const N: usize>(path: Lanes<N>, shifts: Rgb<N>) -> Rgb<N> {
    // In meters; the product with a wave number is a phase in turns.
    let path = path * 1e-9;
    let gaussian = |value: f32, center: f32, variance: f32, shift: Lanes<N>| {
        let wave = (path * center + shift).map(cosine_of_turns);
        let exponent = path * path * (-4.0 * PI * PI * variance * LOG2_E);
        let height = value * (2.0 * PI * variance).sqrt() / 1.068_5e-7;
        wave * exponent.map(exp2_approx) * height
    };
    let x = gaussian(5.4856e-13, 1.681e6, 4.3278e9, shifts.r)
        + gaussian(9.747e-14, 2.2399e6, 4.5282e9, shifts.r);
    let y = gaussian(4.4201e-13, 1.7953e6, 9.3046e9, shifts.g);
    let z = gaussian(5.2481e-13, 2.2084e6, 6.6121e9, shifts.b);
    let [r, g, b] = multiply_matrix(&XYZ_TO_SRGB, [x, y, z]);
    Rgb { r, g, b }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the F0 of one surface.
    fn film_f0(f0: [f32; 3], ior: f32, thickness: f32, cosine: f32) -> [f32; 3] {
        thin_film_f0(Rgb::<1>::splat(f0), ior, Lanes([thickness]), Lanes([cosine])).lane(0)
    }

    #[test]
    fn vanishing_films_keep_the_base_f0_and_films_create_no_light() {
        for f0 in [0.02, 0.04, 0.3, 0.9] {
            let bare = film_f0([f0; 3], 1.3, 0.0, 0.8);
            assert!(bare.iter().all(|actual| (actual - f0).abs() < 0.03), "{f0} {bare:?}");
            for step in 0..200 {
                let thickness = step as f32 * 6.0;
                for cosine in [1.0, 0.7, 0.3, 0.05, 0.0] {
                    let actual = film_f0([f0, f0 * 0.5, 0.0], 1.4, thickness, cosine);
                    assert!(actual.iter().all(|c| (0.0..=1.0).contains(c)), "{actual:?}");
                }
            }
        }
    }
}
