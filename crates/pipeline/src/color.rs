//! Colours: linear light inside, sRGB at the ends (IEC 61966-2-1).
//!
//! Both directions go by tables that are computed once with `libm`, so the bits are the same everywhere.

use std::sync::OnceLock;

/// Linear light of an sRGB value between 0 and 1.
fn linear_of(srgb: f64) -> f64 {
    if srgb <= 0.04045 { srgb / 12.92 } else { libm::pow((srgb + 0.055) / 1.055, 2.4) }
}

/// The linear light, 0 to 1, of each 8-bit sRGB value.
#[must_use]
pub(crate) fn linear_table() -> &'static [f32; 256] {
    static TABLE: OnceLock<[f32; 256]> = OnceLock::new();
    TABLE.get_or_init(|| std::array::from_fn(|code| linear_of(code as f64 / 255.0) as f32))
}

/// Finds the nearest 8-bit sRGB value of linear light.
#[derive(Debug)]
pub(crate) struct SrgbEncoder {
    /// The least linear light whose nearest value is the index; the first is never reached.
    thresholds: [f32; 256],
    /// For each of 4096 equal steps of linear light, the value at its beginning: where the search starts.
    starts: [u8; 4096],
}

impl SrgbEncoder {
    /// The encoder; made once.
    #[must_use]
    pub(crate) fn shared() -> &'static Self {
        static ENCODER: OnceLock<SrgbEncoder> = OnceLock::new();
        ENCODER.get_or_init(Self::new)
    }

    fn new() -> Self {
        let threshold = |code: usize| linear_of((code as f64 - 0.5) / 255.0) as f32;
        let thresholds: [f32; 256] =
            std::array::from_fn(|code| if code == 0 { f32::MIN } else { threshold(code) });
        let starts = std::array::from_fn(|step| {
            let light = step as f32 / 4095.0;
            (thresholds.partition_point(|&least| least <= light) - 1) as u8
        });
        Self { thresholds, starts }
    }

    /// The nearest 8-bit sRGB value; light beyond [0, 1] (and NaN, as 0) is cut off.
    #[must_use]
    pub(crate) fn encode(&self, light: f32) -> u8 {
        let light = if light > 0.0 { light.min(1.0) } else { 0.0 };
        let mut code = self.starts[(light * 4095.0) as usize];
        while code < 255 && self.thresholds[usize::from(code) + 1] <= light {
            code += 1;
        }
        code
    }

    /// A pixel for a file: sRGB with straight alpha, from linear light multiplied by alpha.
    #[must_use]
    pub(crate) fn pixel(&self, [r, g, b, alpha]: [f32; 4]) -> [u8; 4] {
        if alpha <= 0.0 {
            return [0; 4];
        }
        let straight =
            |channel: f32| self.encode(if alpha < 1.0 { channel / alpha } else { channel });
        [straight(r), straight(g), straight(b), (alpha.min(1.0) * 255.0 + 0.5) as u8]
    }
}

/// Linear red, green and blue of a colour written `#rgb` or `#rrggbb`; `None` if it is written otherwise.
#[must_use]
pub(crate) fn parse_hex(text: &str) -> Option<[f32; 3]> {
    let digits = text.strip_prefix('#').filter(|d| d.bytes().all(|b| b.is_ascii_hexdigit()))?;
    let wide: String = match digits.len() {
        3 => digits.chars().flat_map(|digit| [digit, digit]).collect(),
        6 => digits.to_owned(),
        _ => return None,
    };
    let number = u32::from_str_radix(&wide, 16).ok()?;
    let [_, r, g, b] = number.to_be_bytes();
    Some([r, g, b].map(|code| linear_table()[usize::from(code)]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_survives_the_way_to_linear_light_and_back() {
        for code in 0..=255_u8 {
            let light = linear_table()[usize::from(code)];
            assert_eq!(SrgbEncoder::shared().encode(light), code);
        }
    }

    #[test]
    fn encoding_rounds_to_the_nearest_value() {
        let encoder = SrgbEncoder::shared();
        for step in 0..100_000 {
            let light = step as f32 / 99_999.0;
            let nearest = (srgb_of(f64::from(light)) * 255.0).round();
            let found = f64::from(encoder.encode(light));
            let exact = srgb_of(f64::from(light)) * 255.0;
            assert!(found == nearest || (exact - found).abs() < 0.50001, "{light}: {found}");
        }
        assert_eq!([f32::NAN, -1.0, 2.0].map(|light| encoder.encode(light)), [0, 0, 255]);
    }

    fn srgb_of(light: f64) -> f64 {
        if light <= 0.003_130_8 {
            light * 12.92
        } else {
            1.055 * libm::pow(light, 1.0 / 2.4) - 0.055
        }
    }

    #[test]
    fn colours_are_read_as_on_a_web_page() {
        assert_eq!(parse_hex("#fff"), Some([1.0; 3]));
        assert_eq!(parse_hex("#ff0000"), Some([1.0, 0.0, 0.0]));
        for wrong in ["", "#", "fff", "#ff", "#ffffg0", "#+12345", "#äöü"] {
            assert_eq!(parse_hex(wrong), None, "{wrong}");
        }
    }
}
