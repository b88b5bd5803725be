//! Number formatting for captions and tables.
//!
//! Captions should be short and identical on every machine, so the digits come from Rust's
//! correctly rounded formatting, never from a logarithm.

/// Formats a number with at most `digits` significant digits and no trailing zeros. Very small and
/// very large numbers get an exponent.
///
/// Decimal notation is used from 1e-4 to just below 1e6, and scientific notation otherwise.
/// Positive infinity, as of some far planes, prints as `infinite`. −∞ and NaN print as in Rust.
pub(super) fn format_short(x: f64, digits: usize) -> String {
    if !x.is_finite() {
        return if x > 0.0 { "infinite".to_owned() } else { format!("{x}") };
    }
    // Round before choosing the notation, so that 9.9996 counts as 10; −0 becomes 0.
    let rounded: f64 = format!("{x:.*e}", digits.saturating_sub(1)).parse().unwrap_or(x);
    let rounded = rounded + 0.0;
    let size = rounded.abs();
    if size == 0.0 || (1e-4..1e6).contains(&size) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_formatted_as_short_as_possible() {
        let cases = [
            (1.0 / 3.0, "0.3333"),
            (9.999_96, "10"),
            (-0.0, "0"),
            (2.0, "2"),
            (123_456.0, "123500"),
            (5.96e-8, "5.96e-8"),
            (f64::INFINITY, "infinite"),
        ];
        for (x, text) in cases {
            assert_eq!(format_short(x, 4), text);
        }
    }
}
