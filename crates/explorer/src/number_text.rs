//! Number formatting in scene files and sentences.

/// Rounds a number to six decimals, as a person would write it in a scene file.
pub(crate) fn scene_number(value: f64) -> f64 {
    // Readers expect 0, not −0.
    libm::round(value * 1e6) / 1e6 + 0.0
}

/// Formats a number with at most this many decimals, without trailing zeros.
pub(crate) fn decimals(value: f64, count: i32) -> String {
    let scale = libm::pow(10.0, f64::from(count));
    format!("{}", libm::round(value * scale) / scale + 0.0)
}

/// Returns a number of triangles with its English noun.
pub(crate) fn count_triangles(count: usize) -> String {
    files::counted(count, "triangle", "triangles")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_no_trailing_zeros() {
        assert_eq!(scene_number(0.1 + 0.2).to_string(), "0.3");
        assert_eq!(scene_number(-1e-9).to_string(), "0");
        assert_eq!(decimals(36.869_897, 1), "36.9");
    }
}
