//! Numbers and formulas as people type them: `80/21`, `3z - 2`, `-n*f`, `(n_x-1)/2`, `1+sqrt(3)`.
//!
//! ```text
//! sum     = product { (+ | -) product }
//! product = { - } power { (* | /) { - } power | power }       n f = n*f, but not after /
//! power   = value [ ^ { - } power | ² | ³ ]
//! value   = number [°] | letters | function ( sum ) | √ value | ( sum )
//! ```

use super::answer_error::AnswerError;
use std::f64::consts::PI;

/// The maximum nesting depth of parentheses, roots and powers.
const MAX_DEPTH: usize = 64;
/// The maximum length of a name that is read as a product of symbols.
const MAX_NAME_BYTES: usize = 24;

/// The symbols of an exercise and their values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Letters<'a> {
    pub(super) names: &'a [&'a str],
    pub(super) values: &'a [f64],
}

impl Letters<'_> {
    /// Returns the value of a symbol or a product of symbols: `nf` is n times f. An underscore may
    /// be part of a symbol, as in `n_x`, but cannot separate two symbols: `f_n` is not a product.
    fn value(self, written: &str) -> Option<f64> {
        if written.is_empty() {
            return Some(1.0);
        }
        if written.len() > MAX_NAME_BYTES {
            return None;
        }
        let begins = self.names.iter().zip(self.values);
        let mut begins: Vec<(&str, f64)> = begins
            .filter_map(|(name, value)| Some((without_name(written, name)?, *value)))
            .collect();
        // Tries longer names first, so that z1z2 is not read as z followed by 1z2.
        begins.sort_by_key(|(rest, _)| rest.len());
        begins.into_iter().find_map(|(rest, value)| Some(value * self.value(rest)?))
    }
}

/// Returns the text after the name of a symbol. Underscores in the name are ignored.
fn without_name<'a>(written: &'a str, name: &str) -> Option<&'a str> {
    let mut rest = written;
    for (at, c) in name.char_indices() {
        if at > 0 {
            rest = rest.strip_prefix('_').unwrap_or(rest);
        }
        rest = rest.strip_prefix(c)?;
    }
    Some(rest)
}

/// Evaluates an expression for these values of its symbols.
///
/// # Errors
/// Returns an error if the text is not an expression or has no finite value.
pub(super) fn evaluate(entry: &str, letters: Letters<'_>) -> Result<f64, AnswerError> {
    let characters: Vec<char> = entry.chars().collect();
    let mut parser = Parser { entry, characters: &characters, at: 0, depth: 0, letters };
    let value = parser.sum()?;
    if let Some(rest) = parser.peek() {
        return Err(AnswerError::unexpected(&rest.to_string(), entry));
    }
    if value.is_finite() {
        return Ok(value);
    }
    let each = letters.names.iter().zip(letters.values);
    let at: Vec<String> = each.map(|(name, value)| format!("{name} = {value}")).collect();
    let at = at.join(", ");
    Err(AnswerError::new(
        format!("`{entry}` is not a finite number (for {at})").replace(" (for )", ""),
        format!("`{entry}` 不是有限数 {at}").trim_end().to_owned(),
    ))
}

/// A parser that evaluates an expression while parsing it.
struct Parser<'a> {
    entry: &'a str,
    characters: &'a [char],
    at: usize,
    depth: usize,
    letters: Letters<'a>,
}

impl Parser<'_> {
    /// Returns the next nonblank character.
    fn peek(&mut self) -> Option<char> {
        while self.characters.get(self.at).is_some_and(|c| c.is_whitespace()) {
            self.at += 1;
        }
        self.characters.get(self.at).copied()
    }

    /// Consumes the next character if it is the expected character; returns whether it is.
    fn pass(&mut self, expected: char) -> bool {
        let found = self.peek() == Some(expected);
        self.at += usize::from(found);
        found
    }

    /// Consumes and returns the longest run of characters that belong to a token.
    fn word(&mut self, belongs: fn(char) -> bool) -> String {
        let rest = self.characters.get(self.at..).unwrap_or_default();
        let word: String = rest.iter().copied().take_while(|c| belongs(*c)).collect();
        self.at += word.chars().count();
        word
    }

    fn sum(&mut self) -> Result<f64, AnswerError> {
        let mut value = self.product()?;
        loop {
            if self.pass('+') {
                value += self.product()?;
            } else if self.pass('-') {
                value -= self.product()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn product(&mut self) -> Result<f64, AnswerError> {
        let mut value = self.signed_power()?;
        let mut divided = false;
        loop {
            if self.pass('*') {
                value *= self.signed_power()?;
                divided = false;
            } else if self.pass('/') {
                value /= self.signed_power()?;
                divided = true;
            } else if self.peek().is_some_and(|c| c.is_alphabetic() || c == '(' || c == '√') {
                if divided {
                    return Err(AnswerError::ambiguous_quotient(self.entry));
                }
                value *= self.power()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn signed_power(&mut self) -> Result<f64, AnswerError> {
        let mut sign = 1.0;
        loop {
            if self.pass('-') {
                sign = -sign;
            } else if !self.pass('+') {
                return Ok(sign * self.power()?);
            }
        }
    }

    fn power(&mut self) -> Result<f64, AnswerError> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(AnswerError::new(
                format!("`{}` is nested too deeply", self.entry),
                format!("`{}` 嵌套过深", self.entry),
            ));
        }
        let base = self.value()?;
        let value = if self.pass('^') {
            libm::pow(base, self.signed_power()?)
        } else if self.pass('²') {
            base * base
        } else if self.pass('³') {
            base * base * base
        } else {
            base
        };
        self.depth -= 1;
        Ok(value)
    }

    fn value(&mut self) -> Result<f64, AnswerError> {
        match self.peek() {
            None => Err(AnswerError::incomplete(self.entry)),
            Some('(') => self.bracket(),
            Some('√') => {
                self.at += 1;
                Ok(libm::sqrt(self.power()?))
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if vulgar_fraction(c).is_some() => {
                self.at += 1;
                vulgar_fraction(c).ok_or_else(|| AnswerError::incomplete(self.entry))
            }
            Some(c) if c.is_alphabetic() => self.named(),
            Some(c) => Err(AnswerError::unexpected(&c.to_string(), self.entry)),
        }
    }

    fn bracket(&mut self) -> Result<f64, AnswerError> {
        self.at += 1;
        let value = self.sum()?;
        if self.pass(')') { Ok(value) } else { Err(AnswerError::incomplete(self.entry)) }
    }

    /// Parses a decimal number, optionally with an exponent and optionally in degrees.
    fn number(&mut self) -> Result<f64, AnswerError> {
        let mut digits = self.word(|c| c.is_ascii_digit() || c == '.');
        if let Some(exponent) = self.exponent() {
            digits += &exponent;
        }
        let wrong = || AnswerError::unexpected(&digits, self.entry);
        let value = digits.parse::<f64>().map_err(|_| wrong())?;
        Ok(if self.pass('°') { value * (PI / 180.0) } else { value })
    }

    /// Parses the exponent of a decimal number, if a digit follows the e.
    fn exponent(&mut self) -> Option<String> {
        let rest = self.characters.get(self.at..)?;
        let sign = usize::from(matches!(rest.get(1), Some('-' | '+')));
        if !matches!(rest.first(), Some('e' | 'E')) || !rest.get(1 + sign)?.is_ascii_digit() {
            return None;
        }
        let begin: String = rest.iter().take(1 + sign).collect();
        self.at += 1 + sign;
        Some(begin + &self.word(|c| c.is_ascii_digit()))
    }

    /// Parses a symbol, a product of symbols, or a function.
    fn named(&mut self) -> Result<f64, AnswerError> {
        let written = self.word(|c| c.is_alphabetic() || c.is_ascii_digit() || c == '_');
        if let Some(value) = self.letters.value(&written) {
            return Ok(value);
        }
        if matches!(written.as_str(), "pi" | "π") {
            return Ok(PI);
        }
        let name = written.trim_end_matches(|c: char| c.is_ascii_digit());
        let Some(function) = function_named(name) else {
            let product = written.replace('_', "*");
            let letters = written.replace('_', "");
            let is_subscript = letters.len() < written.trim_matches('_').len()
                && self.letters.value(&letters).is_some();
            return Err(if is_subscript {
                AnswerError::subscript(&written, &product)
            } else {
                AnswerError::unknown_name(&written, self.letters.names)
            });
        };
        if name == written && self.peek() == Some('(') {
            return Ok(function(self.bracket()?));
        }
        self.peek();
        let rest = self.word(|c| c.is_alphanumeric() || matches!(c, '.' | '_'));
        let degrees = if self.pass('°') { "°" } else { "" };
        let argument = format!("{}{rest}{degrees}", &written[name.len()..]);
        Err(AnswerError::missing_brackets(name, &argument))
    }
}

fn function_named(name: &str) -> Option<fn(f64) -> f64> {
    Some(match name {
        "sqrt" => libm::sqrt,
        "sin" => libm::sin,
        "cos" => libm::cos,
        "tan" => libm::tan,
        "cot" => |angle| 1.0 / libm::tan(angle),
        "atan" | "arctan" => libm::atan,
        "abs" => f64::abs,
        _ => return None,
    })
}

const fn vulgar_fraction(c: char) -> Option<f64> {
    Some(match c {
        '½' => 0.5,
        '⅓' => 1.0 / 3.0,
        '⅔' => 2.0 / 3.0,
        '¼' => 0.25,
        '¾' => 0.75,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const LETTERS: Letters<'_> = Letters {
        names: &["n", "f", "nx", "z1", "z2", "wR"],
        values: &[-2.0, -6.0, 7.0, 3.0, 5.0, 4.0],
    };

    fn value(text: &str) -> f64 {
        evaluate(text, LETTERS).expect(text)
    }

    #[test]
    fn expressions_have_standard_precedence() {
        for (text, expected) in [
            ("80/21", 80.0 / 21.0),
            ("-n*f", -12.0),
            ("n + f", -8.0),
            ("1 - 2 - 3", -4.0),
            ("2*3^2", 18.0),
            ("-2^2", -4.0),
            ("2^-1", 0.5),
            ("2^3^2", 512.0),
            ("8/4/2", 1.0),
            ("8/-4", -2.0),
            ("(n_x - 1)/2", 3.0),
            ("2n", -4.0),
            ("nf", 12.0),
            ("n f (z_1 - z2)/(z1 z2)", 12.0 * -2.0 / 15.0),
            ("z1z2", 15.0),
            ("2(n+f)(n-f)", 2.0 * -8.0 * 4.0),
            ("w_R", 4.0),
            ("1.5e-3", 0.0015),
            (".5", 0.5),
            ("½ + ¾", 1.25),
            ("√3", 3.0_f64.sqrt()),
            ("2√(1+3)", 4.0),
            ("sqrt(3)^2", 3.0),
            ("pi", PI),
            ("--3", 3.0),
            ("n²", 4.0),
            ("2n² z1³", 216.0),
            ("z1²/2", 4.5),
            ("-n²", -4.0),
            ("z_1z_2", 15.0),
        ] {
            assert!((value(text) - expected).abs() <= 1e-12 * expected.abs(), "{text}");
        }
    }

    #[test]
    fn angles_are_radians_unless_written_with_a_degree_sign() {
        for (text, expected) in [
            ("cos(60°)", 0.5),
            ("sin(pi/6)", 0.5),
            ("tan(45 °)", 1.0),
            ("cot(45°)", 1.0),
            ("4 atan(1)", PI),
            ("cos(60)", -0.952_412_980_415_156_3),
            ("abs(-3)", 3.0),
        ] {
            assert!((value(text) - expected).abs() < 1e-12, "{text}");
        }
    }

    #[test]
    fn invalid_expressions_are_reported() {
        for (text, part) in [
            ("", "incomplete"),
            ("n+", "incomplete"),
            ("(n", "incomplete"),
            ("n)", "`)`"),
            ("2 3", "`3`"),
            ("n 2", "`2`"),
            ("q", "the symbols are n, f, nx"),
            ("nq", "`nq`"),
            ("1/n f", "ambiguous"),
            ("1/2(n)", "ambiguous"),
            ("sqrt 3", "write `sqrt(3)`"),
            ("cos30°", "write `cos(30°)`"),
            ("cos 30 °", "write `cos(30°)`"),
            ("2cos30", "write `cos(30)`"),
            ("sin", "write `sin(…)`"),
            ("f_n", "write `f*n`"),
            ("n+f_n", "`f_n`"),
            ("n_", "`n_`"),
            ("1/(n-n)", "not a finite number"),
            ("sqrt(n)", "not a finite number"),
            ("1.2.3", "`1.2.3`"),
            ("n$f", "`$`"),
        ] {
            let error = evaluate(text, LETTERS).expect_err(text);
            assert!(error.to_string().contains(part), "{text}: {error}");
            assert!(!error.message.zh.is_empty());
        }
    }

    #[test]
    fn deep_and_long_expressions_terminate() {
        let deep = "(".repeat(5000);
        assert!(evaluate(&deep, LETTERS).is_err_and(|error| error.to_string().contains("deeply")));
        assert!(evaluate(&"2^".repeat(5000), LETTERS).is_err());
        assert!(evaluate(&"√".repeat(5000), LETTERS).is_err());
        assert!((value(&format!("{}1", "1+".repeat(1000))) - 1001.0).abs() < 1e-9);
        assert!(evaluate(&"-".repeat(5000), LETTERS).is_err());
    }
}
