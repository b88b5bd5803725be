//! Decimal number parsing: correctly rounded, and fast for numbers with few digits.
//!
//! An integer of at most 2⁵³ and a power of ten of at most 10²² are both exact, so their product or
//! quotient is rounded only once (Clinger 1990). The standard library parses all other numbers.

/// Powers of ten that doubles represent exactly.
const POWERS_OF_TEN: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Parses a decimal number as the nearest double. Returns `None` if the token is not a number.
///
/// Accepts `1`, `-.5`, `+2.`, `1e-3`, `1.5D+2` (Fortran), `nan`, `inf`, and the Microsoft C
/// runtime's spellings of the last two: `1.#QNAN`, `-1.#IND`, `1.#INF`.
#[inline]
pub(crate) fn parse_f64(token: &[u8]) -> Option<f64> {
    fast_decimal(token).or_else(|| slow_decimal(token))
}

/// Parses a decimal number as the nearest float; accepts the same input as [`parse_f64`].
///
/// A double halfway between two floats may itself be the result of rounding; the digits are then
/// parsed again.
#[inline]
pub(crate) fn parse_f32(token: &[u8]) -> Option<f32> {
    let value = parse_f64(token)?;
    round_to_f32(value).or_else(|| standard_form(token).parse().ok())
}

/// Parses an integer with an optional sign. Returns `None` if the token is not an integer or does
/// not fit in 64 bits.
#[inline]
pub(crate) fn parse_integer(token: &[u8]) -> Option<i64> {
    let (is_negative, digits) = match token {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] | digits => (false, digits),
    };
    if digits.is_empty() {
        return None;
    }
    let mut value = 0i64;
    for byte in digits {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            return None;
        }
        value = value.checked_mul(10)?.checked_add(i64::from(digit))?;
    }
    Some(if is_negative { -value } else { value })
}

/// Parses the float at the beginning of a string, and returns it with the length of its token, in
/// one pass. Returns `None` unless it has few digits and a small exponent and is followed by white
/// space.
#[inline]
pub(super) fn simple_decimal(text: &[u8]) -> Option<(f32, usize)> {
    let (value, length) = scan_decimal(text)?;
    let is_token = text.get(length).is_some_and(|byte| *byte <= b' ');
    round_to_f32(value).filter(|_| is_token).map(|number| (number, length))
}

/// Returns the float nearest to a correctly rounded double, or `None` if the double may have been
/// rounded to the midpoint of two floats.
#[inline]
fn round_to_f32(value: f64) -> Option<f32> {
    let is_halfway = value.to_bits() & 0x1FFF_FFFF == 0x1000_0000;
    let is_subnormal = value != 0.0 && value.abs() < f64::from(f32::MIN_POSITIVE);
    (!(is_halfway || is_subnormal) || !value.is_finite()).then_some(value as f32)
}

/// Parses a number with few digits and a small exponent by one exact operation. Returns `None` for
/// any other token.
#[inline]
fn fast_decimal(token: &[u8]) -> Option<f64> {
    scan_decimal(token).filter(|(_, length)| *length == token.len()).map(|(value, _)| value)
}

/// Parses the number at the beginning of a string by one exact operation, and returns it with its
/// length. Returns `None` if it has too many digits or too large an exponent for this.
#[inline]
fn scan_decimal(text: &[u8]) -> Option<(f64, usize)> {
    let digit_at = |at: usize| text.get(at).map(|byte| byte.wrapping_sub(b'0')).filter(|d| *d <= 9);
    let is_negative = text.first() == Some(&b'-');
    let first = usize::from(is_negative || text.first() == Some(&b'+'));
    let (mut at, mut mantissa) = (first, 0u64);
    while let Some(digit) = digit_at(at) {
        mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
        at += 1;
    }
    let (mut digits, mut power) = (at - first, 0i32);
    if text.get(at) == Some(&b'.') {
        let point = at;
        at += 1;
        while let Some(digit) = digit_at(at) {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
            at += 1;
        }
        digits += at - point - 1;
        power = -i32::try_from(at - point - 1).ok()?;
    }
    // Nineteen digits cannot overflow 64 bits; more might.
    if digits == 0 || digits > 19 || mantissa > 1 << 53 {
        return None;
    }
    if let Some(b'e' | b'E' | b'd' | b'D') = text.get(at) {
        at += 1;
        let sign = text.get(at).copied();
        at += usize::from(matches!(sign, Some(b'-' | b'+')));
        let (start, mut exponent) = (at, 0);
        // A fourth digit is not consumed, so the callers see that the token is longer.
        while let Some(digit) = digit_at(at).filter(|_| at < start + 3) {
            exponent = 10 * exponent + i32::from(digit);
            at += 1;
        }
        if at == start {
            return None;
        }
        power += if sign == Some(b'-') { -exponent } else { exponent };
    }
    let factor = *POWERS_OF_TEN.get(power.unsigned_abs() as usize)?;
    let magnitude = if power < 0 { mantissa as f64 / factor } else { mantissa as f64 * factor };
    Some((if is_negative { -magnitude } else { magnitude }, at))
}

/// Parses any number with the standard library, then tries the words for NaN and infinity.
#[cold]
fn slow_decimal(token: &[u8]) -> Option<f64> {
    if let Ok(value) = standard_form(token).parse() {
        return Some(value);
    }
    let sign = if token.first() == Some(&b'-') { -1.0 } else { 1.0 };
    let word = token.strip_prefix(b"-").or(token.strip_prefix(b"+")).unwrap_or(token);
    let begins_with =
        |start: &[u8]| word.get(..start.len()).is_some_and(|word| word.eq_ignore_ascii_case(start));
    if begins_with(b"1.#INF") || begins_with(b"inf") {
        return Some(sign * f64::INFINITY);
    }
    (begins_with(b"1.#") || begins_with(b"nan")).then_some(f64::NAN)
}

/// Returns the number in the standard library's form, with `e` for the exponent.
fn standard_form(token: &[u8]) -> String {
    let letter = |byte: &u8| if matches!(byte, b'd' | b'D') { 'e' } else { char::from(*byte) };
    token.iter().map(letter).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_match_the_standard_library() {
        for text in [
            "0",
            "-0",
            "1",
            "+1",
            "-1.5",
            ".5",
            "5.",
            "1e3",
            "1E+3",
            "-2.5e-3",
            "0.1",
            "3.14159265",
            "9007199254740993",
            "123456789012345678901234567890",
            "1e22",
            "1e23",
            "1e-22",
            "1e-23",
            "1e400",
            "1e-400",
            "5e-324",
            "4.9406564584124654e-324",
            "0.000000000000000000000001",
            "1.7976931348623157e308",
            "2.2250738585072011e-308",
            "inf",
            "-Infinity",
            "0e99999999999",
        ] {
            let expected: f64 = text.parse().unwrap();
            assert_eq!(parse_f64(text.as_bytes()).unwrap().to_bits(), expected.to_bits(), "{text}");
            let expected: f32 = text.parse().unwrap();
            assert_eq!(parse_f32(text.as_bytes()).unwrap().to_bits(), expected.to_bits(), "{text}");
            let simple = simple_decimal(format!("{text} ").as_bytes());
            let expected = (expected.to_bits(), text.len());
            assert!(simple.is_none_or(|(x, length)| (x.to_bits(), length) == expected), "{text}");
        }
        // 1 + 2⁻²⁴ + 2⁻⁶⁰ is halfway between two floats only after rounding to a double.
        let text = "1.000000059604644776258";
        assert_eq!((text.parse::<f64>().unwrap() as f32).to_bits(), 1f32.to_bits());
        assert_eq!(parse_f32(text.as_bytes()).unwrap().to_bits(), 1f32.to_bits() + 1);
    }

    #[test]
    fn printed_floats_are_parsed_exactly() {
        let mut bits = 1u32;
        for _ in 0..20_000 {
            bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let value = f32::from_bits(bits);
            if value.is_finite() {
                for text in [format!("{value}"), format!("{value:e}"), format!("{value:.9e}")] {
                    assert_eq!(parse_f32(text.as_bytes()).unwrap().to_bits(), bits, "{text}");
                }
            }
        }
    }

    #[test]
    fn fortran_and_microsoft_spellings_are_accepted() {
        assert_eq!(parse_f64(b"1.5D+2"), Some(150.0));
        assert!(parse_f64(b"-1.#IND").unwrap().is_nan());
        assert!(parse_f64(b"nan(ind)").unwrap().is_nan());
        assert_eq!(parse_f64(b"-1.#INF00"), Some(f64::NEG_INFINITY));
        for wrong in ["", "-", ".", "e5", "1e", "1,5", "0x10", "1.2.3", "--1", "1 2", "ä"] {
            assert_eq!(parse_f64(wrong.as_bytes()), None, "{wrong}");
            assert_eq!(parse_f32(wrong.as_bytes()), None, "{wrong}");
        }
    }

    #[test]
    fn integers_are_parsed() {
        assert_eq!(parse_integer(b"-17"), Some(-17));
        assert_eq!(parse_integer(b"+9223372036854775807"), Some(i64::MAX));
        for wrong in ["", "-", "1.0", "9223372036854775808", "1_000"] {
            assert_eq!(parse_integer(wrong.as_bytes()), None, "{wrong}");
        }
    }
}
