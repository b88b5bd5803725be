//! Fixed-point formatting: writes lengths exactly and as short as possible, with at most three
//! decimals.
//!
//! SVG and PDF use millimeters, and pages use micrometers. A number of thousandths is written digit
//! by digit, so there is no rounding and no dependence on a locale, and both formats get the same
//! digits. Leading and trailing zeros are omitted, as both grammars allow.

/// Writes a number given in thousandths: 12500 as `12.5`, −250 as `-.25`.
///
/// Zero is `0`; otherwise an integer part of zero is omitted. Supports every `i64`, including the
/// minimum.
pub(super) fn write_thousandths(out: &mut Vec<u8>, number: i64) {
    if number < 0 {
        out.push(b'-');
    }
    let (whole, part) = (number.unsigned_abs() / 1000, number.unsigned_abs() % 1000);
    if whole > 0 || part == 0 {
        out.extend_from_slice(whole.to_string().as_bytes());
    }
    if part > 0 {
        let digits = format!(".{part:03}");
        out.extend_from_slice(digits.trim_end_matches('0').as_bytes());
    }
}

/// Formats a number given in thousandths.
pub(super) fn format_thousandths(number: i64) -> String {
    let mut out = Vec::new();
    write_thousandths(&mut out, number);
    String::from_utf8_lossy(&out).into_owned()
}

/// Formats a length in millimeters, rounded to the micrometer.
///
/// This is for sizes and line widths, which are not on the grid. Halves round away from zero.
pub(super) fn format_millimeters(millimeters: f64) -> String {
    format_thousandths(libm::round(millimeters * 1000.0) as i64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_exact() {
        for (number, written) in [
            (0, "0"),
            (7, ".007"),
            (-250, "-.25"),
            (1000, "1"),
            (-12_500, "-12.5"),
            (100_000, "100"),
            (1_234_567, "1234.567"),
            (i64::from(i32::MIN), "-2147483.648"),
        ] {
            assert_eq!(format_thousandths(number), written);
            assert_eq!(written.parse::<f64>().map(|x| libm::round(x * 1e3) as i64), Ok(number));
        }
        assert_eq!(format_millimeters(297.0), "297");
    }
}
