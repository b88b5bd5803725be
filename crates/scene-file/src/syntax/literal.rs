//! Reads RON literals: string escapes and number notations.

/// Decodes a string literal: `"…"` with escapes, or `r"…"` and `r#"…"#` verbatim.
///
/// # Errors
/// Returns the byte offset of the first invalid escape in the literal, and the reason.
pub(crate) fn unescape_string(literal: &str) -> Result<String, (usize, &'static str)> {
    if let Some(raw) = literal.strip_prefix('r') {
        let hashes = raw.chars().take_while(|c| *c == '#').count();
        return Ok(raw[hashes + 1..raw.len() - hashes - 1].to_owned());
    }
    let body = &literal[1..literal.len() - 1];
    let mut text = String::with_capacity(body.len());
    let mut rest = body;
    while let Some(at) = rest.find('\\') {
        text.push_str(&rest[..at]);
        let offset = 1 + body.len() - rest.len() + at;
        let (character, length) =
            unescape_character(&rest[at + 1..]).map_err(|problem| (offset, problem))?;
        text.extend(character);
        rest = &rest[at + 1 + length..];
    }
    text.push_str(rest);
    Ok(text)
}

/// Decodes an escape after its backslash; returns the character and the length of the escape. A
/// backslash at the end of a line continues the string after the next line's indentation and
/// produces no character.
fn unescape_character(rest: &str) -> Result<(Option<char>, usize), &'static str> {
    let single = |character: char| Ok((Some(character), 1));
    match rest.chars().next() {
        Some(quote @ ('\'' | '"' | '\\')) => single(quote),
        Some('n') => single('\n'),
        Some('r') => single('\r'),
        Some('t') => single('\t'),
        Some('0') => single('\0'),
        Some('\r' | '\n') => Ok((None, rest.len() - rest.trim_start().len())),
        Some('x') => {
            let digits = rest.get(1..3).filter(|digits| is_hexadecimal(digits));
            let code = digits.and_then(|digits| u8::from_str_radix(digits, 16).ok());
            let code = code
                .filter(u8::is_ascii)
                .ok_or("\\x must be followed by two hexadecimal digits, up to 7f")?;
            Ok((Some(char::from(code)), 3))
        }
        Some('u') => {
            let problem = "\\u must be followed by a character code, such as \\u{e9}";
            let digits = rest[1..].strip_prefix('{').and_then(|rest| rest.split_once('}'));
            let (digits, _) = digits.filter(|(digits, _)| is_hexadecimal(digits)).ok_or(problem)?;
            let code = u32::from_str_radix(digits, 16).ok().and_then(char::from_u32);
            Ok((Some(code.ok_or(problem)?), 3 + digits.len()))
        }
        _ => Err("unknown escape; write a backslash as \\\\"),
    }
}

/// Whether the text is not empty and consists of hexadecimal digits.
fn is_hexadecimal(digits: &str) -> bool {
    !digits.is_empty() && digits.chars().all(|digit| digit.is_ascii_hexdigit())
}

/// Whether a word looks like a number, valid or not: it begins with a digit after an optional sign
/// and point, or is `inf` or `NaN`.
pub(crate) fn looks_like_number(word: &str) -> bool {
    let unsigned = word.strip_prefix(['+', '-']).unwrap_or(word);
    let digits = unsigned.strip_prefix('.').unwrap_or(unsigned);
    digits.starts_with(|c: char| c.is_ascii_digit()) || matches!(unsigned, "inf" | "NaN")
}

/// Parses a number: decimal with an optional point and exponent, `inf` or `NaN`. Digits may be
/// grouped with underscores. Returns `None` if the word is not a number.
pub(crate) fn parse_number(word: &str) -> Option<f64> {
    let digits = without_underscores(word)?;
    // `f64::from_str` accepts "infinity" and "nan" in any case; RON does not.
    let is_decimal = digits.starts_with(|c: char| "+-.0123456789".contains(c));
    let is_named = matches!(digits.trim_start_matches(['+', '-']), "inf" | "NaN");
    let has_letters = digits.contains(|c: char| c.is_ascii_alphabetic() && !matches!(c, 'e' | 'E'));
    let plausible = is_named || (is_decimal && !has_letters);
    digits.parse().ok().filter(|_| plausible)
}

/// Parses a whole number without a point or an exponent; returns `None` if the word is not one or
/// is out of range.
pub(crate) fn parse_integer(word: &str) -> Option<i128> {
    let (negative, unsigned) = match word.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, word.strip_prefix('+').unwrap_or(word)),
    };
    let radices = [("0x", 16), ("0o", 8), ("0b", 2)];
    let prefixed =
        radices.iter().find_map(|(prefix, radix)| Some((unsigned.strip_prefix(prefix)?, *radix)));
    let (digits, radix) = prefixed.unwrap_or((unsigned, 10));
    let digits = without_underscores(digits)?;
    let is_plain = digits.starts_with(|c: char| c.is_digit(radix));
    let value = i128::from_str_radix(&digits, radix).ok().filter(|_| is_plain)?;
    Some(if negative { -value } else { value })
}

/// Removes the underscores that group digits; returns `None` if an underscore comes first.
fn without_underscores(digits: &str) -> Option<String> {
    (!digits.starts_with('_')).then(|| digits.replace('_', ""))
}
