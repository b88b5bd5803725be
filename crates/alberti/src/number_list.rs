//! Lists of decimals and fractions, separated by commas, spaces or brackets as in textbooks.

/// Parses a list of numbers such as `1, -2/3, 0.5` or `[1 0 0 4] [0 1 0 2]`.
///
/// # Errors
/// Returns an error if something between the separators is not a finite number.
pub(crate) fn parse_number_list(text: &str) -> Result<Vec<f64>, String> {
    let between = |c: char| c.is_whitespace() || "[](){},;|".contains(c);
    text.split(between).filter(|word| !word.is_empty()).map(parse_number).collect()
}

/// Parses a list of exactly `N` numbers.
///
/// # Errors
/// Returns an error if the count is not `N`, or if a number is not finite.
pub(crate) fn parse_numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let numbers = parse_number_list(text)?;
    let count = numbers.len();
    let fault = |_| format!("expected {N} numbers separated by commas, found {count}");
    numbers.try_into().map_err(fault)
}

/// Parses a decimal number, or a fraction such as `2/3`.
fn parse_number(word: &str) -> Result<f64, String> {
    let fault = || format!("`{word}` is not a finite number or fraction");
    let parse = |digits: &str| digits.parse::<f64>().map_err(|_| fault());
    let number = match word.split_once('/') {
        Some((above, below)) => parse(above)? / parse(below)?,
        None => parse(word)?,
    };
    if number.is_finite() { Ok(number) } else { Err(fault()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_and_brackets_are_accepted_and_infinities_rejected() {
        assert_eq!(parse_number_list("[1, -2/4]\n(.5 1e2)"), Ok(vec![1.0, -0.5, 0.5, 100.0]));
        assert_eq!(parse_numbers::<2>("1,2"), Ok([1.0, 2.0]));
        assert!(parse_numbers::<3>("1,2").is_err_and(|words| words.contains("found 2")));
        for wrong in ["x", "1/0", "inf", "nan", "1/2/3"] {
            assert!(parse_number_list(wrong).is_err_and(|words| words.contains(wrong)), "{wrong}");
        }
    }
}
