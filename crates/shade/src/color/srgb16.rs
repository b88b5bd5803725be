//! Converts linear light to 16-bit sRGB: exactly the nearest of 65,536 codes.
//!
//! The thresholds between codes are in a table. A float's exponent and the first seven bits of its
//! mantissa identify one of 128 steps in each octave, and a second table has the code at the
//! beginning of each step. A binary search then covers at most about 180 thresholds.

use super::srgb_to_linear;
use raster::Encode;
use std::sync::OnceLock;

/// The bits of 2⁻²¹, which is below the threshold of the first code, 2⁻²⁰·⁷ in linear light.
const MIN_LIGHT_BITS: u32 = (127 - 21) << 23;
/// The number of steps from that value to 1, with 128 per octave.
const STEP_COUNT: usize = 21 * 128 + 1;

/// An encoder from linear light to the nearest 16-bit sRGB code.
#[derive(Debug)]
pub struct Srgb16Encoder {
    /// For each code except the first, the smallest linear light for which it is the nearest code.
    thresholds: Box<[f32]>,
    /// For each step, the code at the beginning of the step.
    step_codes: Box<[u16]>,
}

impl Srgb16Encoder {
    /// Returns the encoder shared by the whole program, whose tables are computed once.
    #[must_use]
    pub fn shared() -> &'static Self {
        static ENCODER: OnceLock<Srgb16Encoder> = OnceLock::new();
        ENCODER.get_or_init(Self::new)
    }

    /// Builds the tables.
    fn new() -> Self {
        let threshold = |code: u32| srgb_to_linear((f64::from(code) - 0.5) / 65_535.0) as f32;
        let thresholds: Box<[f32]> = (1..=65_535).map(threshold).collect();
        let start = |step: usize| {
            let light = f32::from_bits(MIN_LIGHT_BITS + ((step as u32) << 16));
            thresholds.partition_point(|&least| least <= light) as u16
        };
        let step_codes = (0..STEP_COUNT).map(start).collect();
        Self { thresholds, step_codes }
    }

    /// Returns the nearest 16-bit sRGB code. Light outside \[0, 1\] is clamped, and NaN becomes 0.
    #[must_use]
    pub fn encode(&self, light: f32) -> u16 {
        let least = f32::from_bits(MIN_LIGHT_BITS);
        let light = if light > least { light.min(1.0) } else { return 0 };
        // The step narrows the search to the thresholds within it.
        let step = ((light.to_bits() - MIN_LIGHT_BITS) >> 16) as usize;
        let from = self.step_codes[step];
        let to = self.step_codes.get(step + 1).copied().unwrap_or(u16::MAX);
        let candidates = &self.thresholds[usize::from(from)..usize::from(to)];
        from + candidates.partition_point(|&least| least <= light) as u16
    }
}

impl Encode<[u16; 4]> for &Srgb16Encoder {
    fn encode_pixel(&self, [r, g, b, alpha]: [f32; 4]) -> [u16; 4] {
        // As in the 8-bit encoder, the pixel is transparent if alpha is NaN or not above 0.
        if alpha.is_nan() || alpha <= 0.0 {
            return [0; 4];
        }
        let straight = |channel: f32| if alpha < 1.0 { channel / alpha } else { channel };
        let [r, g, b] = [r, g, b].map(|channel| self.encode(straight(channel)));
        [r, g, b, (alpha.min(1.0) * 65_535.0 + 0.5) as u16]
    }
}

#[cfg(test)]
mod tests {
    use super::super::SrgbEncoder;
    use super::*;

    #[test]
    fn every_code_survives_a_round_trip() {
        let encoder = Srgb16Encoder::shared();
        for code in 0..=65_535_u16 {
            let light = srgb_to_linear(f64::from(code) / 65_535.0) as f32;
            assert_eq!(encoder.encode(light), code);
        }
        assert_eq!([f32::NAN, -1.0, 0.0, 2.0].map(|l| encoder.encode(l)), [0, 0, 0, 65_535]);
    }

    #[test]
    fn codes_change_only_at_their_thresholds() {
        let encoder = Srgb16Encoder::shared();
        for (code, &least) in (1..=65_535).zip(&encoder.thresholds) {
            let below = f32::from_bits(least.to_bits() - 1);
            assert_eq!([encoder.encode(below), encoder.encode(least)], [code - 1, code]);
        }
    }

    #[test]
    fn eight_bit_codes_are_nearest_to_sixteen_bit_codes() {
        let (deep, flat) = (Srgb16Encoder::shared(), SrgbEncoder::shared());
        for step in 0..=100_000 {
            let light = step as f32 / 100_000.0;
            let fine = f64::from(deep.encode(light)) / 257.0;
            let coarse = f64::from(flat.encode(light));
            // Half an 8-bit code plus half a 16-bit code.
            assert!((fine - coarse).abs() <= 0.5 + 0.5 / 257.0 + 1e-9, "{light}: {fine} {coarse}");
        }
    }

    #[test]
    fn pixels_have_straight_alpha() {
        let encoder = Srgb16Encoder::shared();
        let half = encoder.encode(0.5);
        assert_eq!(encoder.encode_pixel([0.25, 0.5, 0.0, 0.5]), [half, 65_535, 0, 32_768]);
        assert_eq!(encoder.encode_pixel([0.5; 4].map(|c: f32| -c)), [0; 4]);
        assert_eq!(encoder.encode_pixel([0.5, 0.5, 0.5, f32::NAN]), [0; 4]);
    }
}
