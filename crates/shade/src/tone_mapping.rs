//! Tone mapping: exposure and a curve (Khronos PBR Neutral, ACES, AgX) convert scene light to
//! display colors.
//!
//! ```text
//!  display │        ______ Neutral, ACES, AgX: fade toward white
//!        1 │      ╱──────── None: clipped
//!          │    ╱
//!          │  ╱                       light = radiance · 2^EV
//!          └──────────────── light
//! ```
//!
//! Each fragment is tone mapped separately, before the samples of a pixel are averaged. Edges
//! against bright light therefore stay smooth, and backgrounds keep their colors. A transparent
//! picture composited over a color equals the opaque picture with that background.
//!
//! All three curves convert linear sRGB to linear sRGB; the picture is encoded later. The input has
//! no upper bound, and the output is at most 1.

use super::approximations::{exp2_approx, log2_approx};
use super::color::multiply_matrix;
use super::lanes::{Lanes, Rgb};
use crate::kernel_part::kernel_part;

/// The curve that compresses light above 1 into the range of a display.
///
/// The choice depends on the desired look: Neutral preserves base colors, ACES adds contrast, and
/// AgX fades saturated highlights to white.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum ToneMapping {
    /// No curve: light above 1 is clipped.
    #[default]
    None,
    /// Khronos PBR Neutral: colors below 0.8 are unchanged, and highlights fade to white (Khronos
    /// 2024).
    Neutral,
    /// The fit of the ACES reference transforms by Hill (2016).
    Aces,
    /// Sobotka's AgX (2022), with Wrensch's fit of its curve (2023).
    AgX,
}

/// The exposure and the tone curve.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ToneMapper {
    /// The factor for light: 2 to the power of the exposure value.
    pub exposure: f32,
    /// The curve.
    pub curve: ToneMapping,
}

impl Default for ToneMapper {
    fn default() -> Self {
        Self { exposure: 1.0, curve: ToneMapping::None }
    }
}

impl ToneMapper {
    /// Creates a tone mapper with an exposure correction in stops (EV).
    #[must_use]
    pub fn new(exposure_ev: f64, curve: ToneMapping) -> Self {
        Self { exposure: libm::exp2(exposure_ev) as f32, curve }
    }

    /// Maps linear light to linear display colors, which may be above 1 if there is no curve.
    ///
    /// Exposure is applied first. Negative light, which filtering may produce, becomes 0 under a
    /// curve.
    #[inline(always)]
    pub(super) fn map_colors<const N: usize>(&self, light: Rgb<N>) -> Rgb<N> {
        kernel_part!(N, self.apply_curve(light))
    }

    #[inline(always)]
    fn apply_curve<const N: usize>(&self, light: Rgb<N>) -> Rgb<N> {
        let mut light = light;
        if self.exposure != 1.0 {
            light = light * self.exposure;
        }
        if self.curve == ToneMapping::None {
            return light;
        }
        let light = light.map(|channel| channel.max(0.0));
        match self.curve {
            ToneMapping::None => light,
            ToneMapping::Neutral => khronos_neutral(light),
            ToneMapping::Aces => aces_filmic(light),
            ToneMapping::AgX => agx_tone_map(light),
        }
    }
}

/// Applies the Khronos PBR Neutral tone mapper, as specified.
///
/// ```text
///  color' = color − offset            offset = 0.04 if the smallest channel is above 0.08
///  peak'  = 1 − d² / (peak + d − s)   s = 0.8 − 0.04, d = 1 − s, for peaks above s
///  result = mix(color' · peak' / peak, peak', 1 − 1 / (0.15 (peak − peak') + 1))
/// ```
///
/// Below the start of compression, the curve is the identity minus the offset.
#[inline(always)]
fn khronos_neutral<const N: usize>(light: Rgb<N>) -> Rgb<N> {
    /// The start of highlight compression: 0.8 minus the reflectance of dielectrics.
    const START: f32 = 0.8 - 0.04;
    const DESATURATION: f32 = 0.15;
    // Subtract the Fresnel reflection of dielectrics, so that base colors are reproduced exactly.
    let least = light.r.min_lanes(light.g).min_lanes(light.b);
    let is_dark = least.is_below(0.08);
    let offset = (least - 6.25 * least * least).select(&is_dark, Lanes::splat(0.04));
    let color = light.map(|channel| channel - offset);
    // Compress the peak hyperbolically and fade to white.
    let peak = color.max_channel();
    let headroom = 1.0 - START;
    let compressed = 1.0 - headroom * headroom / (peak + headroom - START);
    let fade = 1.0 - 1.0 / (DESATURATION * (peak - compressed) + 1.0);
    let scale = compressed / peak.max(START);
    let is_kept = peak.is_below(START);
    color.map(|channel| {
        let mapped = channel * scale * (1.0 - fade) + compressed * fade;
        channel.select(&is_kept, mapped)
    })
}

/// From sRGB to the primaries of the ACES fit, including the reference rendering transform's change
/// of saturation.
const SRGB_TO_ACES: [[f32; 3]; 3] =
    [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]];
/// From the output of the ACES fit back to sRGB.
const ACES_TO_SRGB: [[f32; 3]; 3] =
    [[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]];

/// Applies ACES filmic tone mapping: the reference rendering and output transforms, fitted by a
/// rational function between two matrices (Hill 2016).
///
/// Both matrices combine a change of primaries with a change of saturation; each channel is a
/// quotient of quadratics.
#[inline(always)]
fn aces_filmic<const N: usize>(Rgb { r, g, b }: Rgb<N>) -> Rgb<N> {
    let [r, g, b] = multiply_matrix(&SRGB_TO_ACES, [r, g, b]);
    let mapped = Rgb { r, g, b }.map(|x| {
        // Clamp, because the squares of very bright light would be infinite, and their quotient
        // NaN.
        let x = x.min(1e9);
        let numerator = x * (x + 0.024_578_6) - 0.000_090_537;
        numerator / (x * (0.983_729 * x + 0.432_951) + 0.238_081)
    });
    let [r, g, b] = multiply_matrix(&ACES_TO_SRGB, [mapped.r, mapped.g, mapped.b]);
    Rgb { r, g, b }.map(|channel| channel.clamp(0.0, 1.0))
}

/// From sRGB to the inset primaries of AgX.
const SRGB_TO_AGX: [[f32; 3]; 3] = [
    [0.842_479_1, 0.078_433_6, 0.079_223_8],
    [0.042_328_3, 0.878_468_6, 0.079_166_1],
    [0.042_375_7, 0.078_433_6, 0.879_143],
];
/// From the inset primaries of AgX back to sRGB.
const AGX_TO_SRGB: [[f32; 3]; 3] = [
    [1.196_879, -0.098_020_9, -0.099_029_7],
    [-0.052_896_9, 1.151_903_1, -0.098_961_2],
    [-0.052_971_6, -0.098_043_5, 1.151_073_7],
];

/// Applies AgX tone mapping: a sigmoid of the logarithm of light in inset primaries (Sobotka 2022),
/// fitted by a polynomial (Wrensch 2023).
///
/// 16.5 stops are mapped to [0, 1]. The inset mixes channels, so saturated bright light naturally
/// fades to white.
#[inline(always)]
fn agx_tone_map<const N: usize>(Rgb { r, g, b }: Rgb<N>) -> Rgb<N> {
    let [r, g, b] = multiply_matrix(&SRGB_TO_AGX, [r, g, b]);
    let mapped = Rgb { r, g, b }.map(agx_sigmoid);
    let [r, g, b] = multiply_matrix(&AGX_TO_SRGB, [mapped.r, mapped.g, mapped.b]);
    // The curve yields codes for a display with a gamma of 2.2, but the result must be linear.
    Rgb { r, g, b }.map(|code| {
        code.clamp(0.0, 1.0).max(f32::MIN_POSITIVE).map(|code| exp2_approx(2.2 * log2_approx(code)))
    })
}

/// Computes the AgX curve, which maps light to codes by a polynomial of its logarithm.
#[inline(always)]
fn agx_sigmoid<const N: usize>(light: Lanes<N>) -> Lanes<N> {
    /// The range of light in stops.
    const MIN_EV: f32 = -12.473_93;
    const MAX_EV: f32 = 4.026_069;
    // Log encoding.
    let stops = light.max(1e-10).map(log2_approx).clamp(MIN_EV, MAX_EV);
    let x = (stops - MIN_EV) / (MAX_EV - MIN_EV);
    let square = x * x;
    let fourth = square * square;
    // The sigmoid is a polynomial of degree six.
    15.5 * fourth * square - 40.14 * fourth * x + 31.96 * fourth - 6.868 * square * x
        + 0.4298 * square
        + 0.1191 * x
        - 0.002_32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tone_mapped(curve: ToneMapping, light: [f32; 3]) -> [f32; 3] {
        ToneMapper { exposure: 1.0, curve }.map_colors(Rgb::<1>::splat(light)).lane(0)
    }

    #[test]
    fn neutral_preserves_colors_except_for_dielectric_reflection() {
        for light in [[0.5, 0.3, 0.2], [0.7, 0.7, 0.7], [0.2, 0.09, 0.5]] {
            let actual = tone_mapped(ToneMapping::Neutral, light);
            assert!((0..3).all(|k| (actual[k] - (light[k] - 0.04)).abs() < 1e-6), "{actual:?}");
        }
    }

    #[test]
    fn curves_increase_and_stay_in_range() {
        for curve in [ToneMapping::Neutral, ToneMapping::Aces, ToneMapping::AgX] {
            assert!(tone_mapped(curve, [0.0; 3]).iter().all(|c| *c < 0.01), "{curve:?}");
            let mut last = 0.0;
            for step in 0..400 {
                let light = 0.001 * libm::exp2f(step as f32 * 0.05);
                let [r, g, b] = tone_mapped(curve, [light; 3]);
                assert!(r <= 1.0 && r >= last - 1e-4 && (r - g).abs() + (g - b).abs() < 0.02);
                last = r;
            }
            assert!(last > 0.95, "{curve:?} {last}");
            for odd in [1e30, f32::INFINITY, f32::NAN, -1.0] {
                let actual = tone_mapped(curve, [odd, 0.5, 0.0]);
                let is_in_range = actual.iter().all(|c| c.is_nan() || *c <= 1.001);
                assert!(is_in_range, "{curve:?} {odd} {actual:?}");
            }
        }
    }

    #[test]
    fn a_stop_is_a_factor_of_two() {
        let light = Rgb::<1>::splat([0.25, 0.5, 1.0]);
        let darker = ToneMapper::new(-1.0, ToneMapping::None).map_colors(light);
        assert_eq!(darker.lane(0), [0.125, 0.25, 0.5]);
    }
}
