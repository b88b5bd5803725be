//! Parses LaTeX variable names: letters, accents, subscripts, primes.

use crate::book_formulas::name::Name;
use crate::book_formulas::parser::{Parser, describe};
use crate::book_formulas::token::TokenKind;

const GREEK: [&str; 27] = [
    "alpha",
    "beta",
    "gamma",
    "delta",
    "epsilon",
    "varepsilon",
    "zeta",
    "eta",
    "theta",
    "kappa",
    "lambda",
    "mu",
    "nu",
    "xi",
    "rho",
    "sigma",
    "tau",
    "phi",
    "varphi",
    "chi",
    "psi",
    "omega",
    "Delta",
    "Theta",
    "Lambda",
    "Phi",
    "ell",
];

/// Commands that make a letter bold, as in a vector or a matrix.
const BOLD: [&str; 5] = ["mathbf", "boldsymbol", "bm", "vec", "bold"];

/// Commands whose argument is a word.
const WORDS: [&str; 3] = ["mathrm", "mathit", "mathsf"];

/// Returns whether a command is a Greek letter.
pub fn is_greek(command: &str) -> bool {
    GREEK.contains(&command)
}

/// Returns whether a command begins a name.
pub fn begins_name(command: &str) -> bool {
    is_greek(command) || BOLD.contains(&command) || WORDS.contains(&command)
}

/// Parses a name with its subscript and its primes.
pub fn parse_name(parser: &mut Parser<'_>) -> Result<Name, String> {
    let mut name = parse_base(parser)?;
    loop {
        if parser.take('\'') {
            name.primes += 1;
        } else if parser.is_at('_') && name.subscript.is_empty() {
            parser.at += 1;
            name.subscript = parse_subscript(parser)?;
        } else if is_prime_in_exponent(parser) {
            skip_group(parser, 1)?;
            name.primes += 1;
        } else {
            return Ok(name);
        }
    }
}

fn parse_base(parser: &mut Parser<'_>) -> Result<Name, String> {
    let Some(token) = parser.next_token().cloned() else { return Err("missing name".into()) };
    parser.at += 1;
    match &token.kind {
        TokenKind::Letter(letter) => Ok(Name::plain(&letter.to_string())),
        TokenKind::Command(greek) if is_greek(greek) => Ok(Name::plain(greek)),
        TokenKind::Command(bold) if BOLD.contains(&bold.as_str()) => {
            let braced = parser.take('{');
            let inner = parse_name(parser)?;
            if braced {
                parser.expect('}')?;
            }
            Ok(inner.as_bold())
        }
        TokenKind::Command(word) if WORDS.contains(&word.as_str()) => {
            Ok(Name::plain(&read_word(parser)?))
        }
        _ => Err(format!("{} is not a name", describe(&token))),
    }
}

/// Parses `{word}` after `\operatorname`, `\mathrm` or `\begin`.
pub fn read_word(parser: &mut Parser<'_>) -> Result<String, String> {
    let mut word = String::new();
    let braced = parser.take('{');
    while let Some(token) = parser.next_token().cloned() {
        match token.kind {
            TokenKind::Letter(letter) => word.push(letter),
            TokenKind::Number(number) => word.push_str(&number.to_string()),
            TokenKind::Symbol('*') => word.push('*'),
            _ => break,
        }
        parser.at += 1;
        if !braced {
            return Ok(word);
        }
    }
    if braced {
        parser.expect('}')?;
    }
    Ok(word)
}

/// Parses a subscript into its letters, numbers and words, including `\min` and `\max` but not
/// commas.
fn parse_subscript(parser: &mut Parser<'_>) -> Result<Vec<String>, String> {
    let mut depth = 0_usize;
    let mut parts = Vec::new();
    loop {
        let Some(token) = parser.next_token().cloned() else {
            return Err("unclosed subscript".to_owned());
        };
        parser.at += 1;
        match token.kind {
            TokenKind::Symbol('{') => depth += 1,
            TokenKind::Symbol('}') => depth = depth.saturating_sub(1),
            TokenKind::Symbol(symbol @ ('+' | '-' | '/')) => parts.push(symbol.to_string()),
            TokenKind::Symbol(_) => {}
            TokenKind::Letter(letter) => parts.push(letter.to_string()),
            TokenKind::Number(number) => parts.push(number.to_string()),
            // The letters of a word follow in braces.
            TokenKind::Command(word) if word == "text" || WORDS.contains(&word.as_str()) => {
                continue;
            }
            TokenKind::Command(name) => parts.push(name),
        }
        if depth == 0 {
            return Ok(parts);
        }
    }
}

/// Skips a subscript, such as the label under a brace.
pub fn skip_subscript(parser: &mut Parser<'_>) -> Result<(), String> {
    if parser.take('_') { parse_subscript(parser).map(|_| ()) } else { Ok(()) }
}

fn is_prime_in_exponent(parser: &Parser<'_>) -> bool {
    let is = |ahead: usize, test: &dyn Fn(&TokenKind) -> bool| {
        parser.tokens.get(parser.at + ahead).is_some_and(|token| test(&token.kind))
    };
    let prime = |kind: &TokenKind| *kind == TokenKind::Command("prime".to_owned());
    parser.is_at('^')
        && (is(1, &prime) || (is(1, &|kind| *kind == TokenKind::Symbol('{')) && is(2, &prime)))
}

/// Skips `ahead` tokens and a group or a token after them.
fn skip_group(parser: &mut Parser<'_>, ahead: usize) -> Result<(), String> {
    parser.at += ahead;
    let braced = parser.take('{');
    parser.at += 1;
    if braced { parser.expect('}') } else { Ok(()) }
}
