//! Colors: linear light internally, sRGB for input and output (IEC 61966-2-1).
//!
//! ```text
//!  textures, #rrggbb ──► linear light ──► shading ──► SrgbEncoder, Srgb16Encoder ──► picture
//!                  table                              tables for 8 and 16 bits
//! ```
//!
//! Both directions use tables that are computed once with `libm`, so the bits are the same on every
//! machine.

mod primaries;
mod srgb16;

pub(crate) use primaries::{XYZ_TO_SRGB, multiply_matrix};
pub use srgb16::Srgb16Encoder;

use crate::lanes::{Lanes, map_to_lanes};
use raster::{Encode, F32x8, LANES};
use std::sync::OnceLock;

/// Converts an sRGB value to linear light, both from 0 to 1, with the electro-optical transfer
/// function.
pub fn srgb_to_linear(srgb: f64) -> f64 {
    if srgb <= 0.04045 { srgb / 12.92 } else { libm::pow((srgb + 0.055) / 1.055, 2.4) }
}

/// Returns the table of the linear light, 0 to 1, of each 8-bit sRGB value.
#[must_use]
pub fn srgb_to_linear_table() -> &'static [f32; 256] {
    static TABLE: OnceLock<[f32; 256]> = OnceLock::new();
    TABLE.get_or_init(|| std::array::from_fn(|code| srgb_to_linear(code as f64 / 255.0) as f32))
}

/// The bits of the smallest linear value that the encoder distinguishes from 0: 2⁻¹³, which is less
/// than half of the linear light of code 1.
const MIN_LIGHT_BITS: u32 = 0x3900_0000;

/// An encoder from linear light to the nearest 8-bit sRGB code, with a table of 2048 steps.
///
/// ```text
///  entry = code << 16 | carry        encode(x) = (entry of x + lower 16 bits of x) >> 16
/// ```
///
/// A float's upper 16 bits, the exponent and seven bits of the mantissa, identify one of 128 steps
/// in each octave. Codes are farther apart than steps, so a step contains at most one threshold
/// between two codes. The upper half of its table entry is the code at the beginning of the step.
/// The lower half is chosen so that adding the float's lower bits carries into the upper half from
/// the threshold on.
#[derive(Debug)]
pub struct SrgbEncoder {
    /// The code and the carry to the next code, for each step from the smallest value to 1.
    step_table: Box<[u32; 2048]>,
}

impl SrgbEncoder {
    /// Returns the encoder shared by the whole program, whose table is computed once.
    #[must_use]
    pub fn shared() -> &'static Self {
        static ENCODER: OnceLock<SrgbEncoder> = OnceLock::new();
        ENCODER.get_or_init(Self::new)
    }

    /// Builds the table.
    fn new() -> Self {
        let thresholds = code_thresholds();
        let entry = |step: usize| {
            let start = MIN_LIGHT_BITS + ((step as u32) << 16);
            let next = thresholds.partition_point(|&least| least <= f32::from_bits(start));
            let code = (next as u32 - 1) << 16;
            let threshold = thresholds.get(next).map_or(u32::MAX, |least| least.to_bits()) - start;
            code + 0x1_0000_u32.saturating_sub(threshold)
        };
        Self { step_table: Box::new(std::array::from_fn(entry)) }
    }

    /// Returns the nearest 8-bit sRGB code. Light outside \[0, 1\] is clamped, and NaN becomes 0.
    #[must_use]
    pub fn encode(&self, light: f32) -> u8 {
        self.encode_to_code(light) as u8
    }

    /// Returns the code as a `u32`. This function has no branches, so loops that call it are
    /// vectorized.
    #[inline(always)]
    fn encode_to_code(&self, light: f32) -> u32 {
        let least = f32::from_bits(MIN_LIGHT_BITS);
        let bits = if light > least { light.min(1.0) } else { least }.to_bits();
        // A table lookup by exponent and seven bits of the mantissa, then one addition for the
        // threshold.
        let step = self.step_table[((bits - MIN_LIGHT_BITS) >> 16 & 2047) as usize];
        (step + (bits & 0xffff)) >> 16
    }

    /// Encodes pixels as sRGB with straight alpha, from linear light multiplied by alpha. Red is in
    /// the lowest byte.
    #[inline(always)]
    fn encode_pixels<const N: usize>(&self, colors: &[Lanes<N>; 4]) -> [u32; N] {
        let [r, g, b, alpha] = *colors;
        let mut is_opaque = true;
        for alpha in &alpha.0 {
            is_opaque &= *alpha >= 1.0;
        }
        let mut pixels = [0; N];
        // Divide by alpha only if some lane needs it.
        for (shift, channel) in [(0, r), (8, g), (16, b)] {
            let mut straight = channel;
            if !is_opaque {
                straight = (channel / alpha).select(&alpha.is_below(1.0), channel);
            }
            for (pixel, light) in pixels.iter_mut().zip(&straight.0) {
                *pixel |= self.encode_to_code(*light) << shift;
            }
        }
        for (pixel, alpha) in pixels.iter_mut().zip(&alpha.0) {
            let alpha_code = (alpha.min(1.0) * 255.0 + 0.5) as u32;
            let opaque = *pixel | alpha_code << 24;
            *pixel = if *alpha <= 0.0 { 0 } else { opaque };
        }
        pixels
    }

    /// Encodes a pixel as sRGB with straight alpha, from linear light multiplied by alpha.
    #[must_use]
    pub fn encode_pixel(&self, color: [f32; 4]) -> [u8; 4] {
        let [pixel] = self.encode_pixels(&color.map(Lanes::<1>::splat));
        pixel.to_le_bytes()
    }
}

impl Encode<[u8; 4]> for &SrgbEncoder {
    #[inline(always)]
    fn encode_pixel(&self, color: [f32; 4]) -> [u8; 4] {
        SrgbEncoder::encode_pixel(self, color)
    }

    #[inline(always)]
    fn encode_eight(&self, colors: &[F32x8; 4]) -> [[u8; 4]; LANES] {
        self.encode_pixels(&map_to_lanes(colors, Lanes)).map(u32::to_le_bytes)
    }
}

/// Returns, for each code, the smallest linear light for which it is the nearest code. The first
/// entry is `f32::MIN`, so every value reaches at least code 0.
fn code_thresholds() -> [f32; 256] {
    let threshold = |code: usize| srgb_to_linear((code as f64 - 0.5) / 255.0) as f32;
    std::array::from_fn(|code| if code == 0 { f32::MIN } else { threshold(code) })
}

/// Parses `#rgb` or `#rrggbb` as a linear color. Returns `None` for any other text.
#[must_use]
pub fn parse_hex_color(text: &str) -> Option<[f32; 3]> {
    Some(parse_hex_srgb(text)?.map(|code| srgb_to_linear_table()[usize::from(code)]))
}

/// Parses `#rgb` or `#rrggbb` as 8-bit sRGB codes. Returns `None` for any other text.
#[must_use]
pub fn parse_hex_srgb(text: &str) -> Option<[u8; 3]> {
    let digits = text.strip_prefix('#').filter(|d| d.bytes().all(|b| b.is_ascii_hexdigit()))?;
    let six_digits: String = match digits.len() {
        3 => digits.chars().flat_map(|digit| [digit, digit]).collect(),
        6 => digits.to_owned(),
        _ => return None,
    };
    let number = u32::from_str_radix(&six_digits, 16).ok()?;
    let [_, r, g, b] = number.to_be_bytes();
    Some([r, g, b])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_survives_a_round_trip() {
        for code in 0..=255_u8 {
            let light = srgb_to_linear_table()[usize::from(code)];
            assert_eq!(SrgbEncoder::shared().encode(light), code);
        }
    }

    #[test]
    fn encoding_rounds_to_the_nearest_code() {
        let encoder = SrgbEncoder::shared();
        for step in 0..100_000 {
            let light = step as f32 / 99_999.0;
            let nearest = (linear_to_srgb(f64::from(light)) * 255.0).round();
            let actual = f64::from(encoder.encode(light));
            let exact = linear_to_srgb(f64::from(light)) * 255.0;
            assert!(actual == nearest || (exact - actual).abs() < 0.50001, "{light}: {actual}");
        }
        assert_eq!([f32::NAN, -1.0, 2.0].map(|light| encoder.encode(light)), [0, 0, 255]);
    }

    #[test]
    fn codes_change_only_at_their_thresholds() {
        let (encoder, thresholds) = (SrgbEncoder::shared(), code_thresholds());
        let expected = |light: f32| thresholds.partition_point(|&least| least <= light) - 1;
        let agrees = |bits: u32| {
            let light = f32::from_bits(bits);
            assert_eq!(usize::from(encoder.encode(light)), expected(light), "{light}");
        };
        for threshold in &thresholds[1..] {
            (threshold.to_bits() - 2..threshold.to_bits() + 2).for_each(agrees);
        }
        (0..=1.0_f32.to_bits()).step_by(211).for_each(agrees);
    }

    #[test]
    fn eight_pixels_at_once_match_single_pixels() {
        let encoder = SrgbEncoder::shared();
        let alphas = [1.0, 0.5, 0.0, -1.0, f32::NAN, 2.0, 1e-30, 0.999];
        for light in [0.0, -0.5, 0.2, 0.499, 1.0, 7.0, f32::NAN, f32::INFINITY] {
            let lane = |k: usize| [light, light * 0.5, light * 0.25, alphas[k]];
            let channel = |n: usize| std::array::from_fn(|k| lane(k)[n]);
            let eight = [0, 1, 2, 3].map(channel);
            let one_by_one: [_; 8] = std::array::from_fn(|k| encoder.encode_pixel(lane(k)));
            assert_eq!((&encoder).encode_eight(&eight), one_by_one);
        }
        assert_eq!(encoder.encode_pixel([0.5, 0.25, 0.0, 0.5]), [255, 188, 0, 128]);
    }

    fn linear_to_srgb(light: f64) -> f64 {
        if light <= 0.003_130_8 {
            light * 12.92
        } else {
            1.055 * libm::pow(light, 1.0 / 2.4) - 0.055
        }
    }

    #[test]
    fn hex_colors_are_parsed_as_in_css() {
        assert_eq!(parse_hex_color("#fff"), Some([1.0; 3]));
        assert_eq!(parse_hex_color("#ff0000"), Some([1.0, 0.0, 0.0]));
        for wrong in ["", "#", "fff", "#ff", "#ffffg0", "#+12345", "#äöü"] {
            assert_eq!(parse_hex_color(wrong), None, "{wrong}");
        }
    }
}
