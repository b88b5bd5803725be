//! The sRGB transfer function (IEC 61966-2-1), for colors that formats store as they are displayed.

/// The linear value of an sRGB encoded one; both are in [0, 1].
pub(super) fn linear_from_srgb(encoded: f32) -> f32 {
    if encoded <= 0.04045 {
        encoded / 12.92
    } else {
        libm::pow((f64::from(encoded) + 0.055) / 1.055, 2.4) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_the_standard() {
        for (encoded, linear) in
            [(0.0, 0.0), (0.04045, 0.003_130_805), (0.5, 0.214_041_14), (1.0, 1.0)]
        {
            assert!((linear_from_srgb(encoded) - linear).abs() < 1e-7, "{encoded}");
        }
    }
}
