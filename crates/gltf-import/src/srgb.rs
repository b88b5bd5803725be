//! The sRGB transfer function (IEC 61966-2-1), for formats that store sRGB-encoded colors.

use std::sync::OnceLock;

/// Converts an sRGB-encoded value to a linear value; both are in [0, 1].
pub fn linear_from_srgb(encoded: f32) -> f32 {
    if encoded <= 0.04045 {
        encoded / 12.92
    } else {
        libm::pow((f64::from(encoded) + 0.055) / 1.055, 2.4) as f32
    }
}

/// Returns the linear value of each 8-bit sRGB code.
pub fn linear_table() -> &'static [f32; 256] {
    static TABLE: OnceLock<[f32; 256]> = OnceLock::new();
    TABLE.get_or_init(|| std::array::from_fn(|code| linear_from_srgb(code as f32 / 255.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_match_the_standard() {
        for (encoded, linear) in
            [(0.0, 0.0), (0.04045, 0.003_130_805), (0.5, 0.214_041_14), (1.0, 1.0)]
        {
            assert!((linear_from_srgb(encoded) - linear).abs() < 1e-7, "{encoded}");
        }
    }
}
