//! LaTeX tokens.

/// A token and its line in the block, counted from 0.
#[derive(Clone, PartialEq, Debug)]
pub struct Token {
    pub kind: TokenKind,
    pub line: usize,
}

#[derive(Clone, PartialEq, Debug)]
pub enum TokenKind {
    Number(f64),
    Letter(char),
    /// A command name without its backslash: `frac` for `\frac`, and `\` for `\\`.
    Command(String),
    /// An operator, bracket or accent.
    Symbol(char),
}

impl Token {
    pub fn is_symbol(&self, symbol: char) -> bool {
        self.kind == TokenKind::Symbol(symbol)
    }

    pub fn is_command(&self, name: &str) -> bool {
        matches!(&self.kind, TokenKind::Command(command) if command == name)
    }
}

/// Layout commands and symbols, which do not affect the value.
const LAYOUT: [&str; 19] = [
    ",",
    ";",
    "!",
    ":",
    " ",
    "quad",
    "qquad",
    "left",
    "right",
    "big",
    "bigl",
    "bigr",
    "Big",
    "Bigl",
    "Bigr",
    "displaystyle",
    "textstyle",
    "biggl",
    "biggr",
];

const SYMBOLS: &str = "+-*/^_()[]{}|,.&=<>:'";

/// Splits a block into tokens and drops layout commands. An error is a line number and a message.
pub fn tokenize(latex: &str) -> Result<Vec<Token>, (usize, String)> {
    let mut tokens = Vec::new();
    for (line, text) in latex.lines().enumerate() {
        let mut rest = text.trim_start();
        while let Some(first) = rest.chars().next() {
            let (kind, length) = match first {
                '\\' => read_command(rest),
                '0'..='9' if takes_one_digit(&tokens) => read_number(&rest[..1]),
                '0'..='9' => read_number(rest),
                'a'..='z' | 'A'..='Z' => (Some(TokenKind::Letter(first)), 1),
                '~' => (None, 1),
                _ if SYMBOLS.contains(first) => (Some(TokenKind::Symbol(first)), 1),
                _ => return Err((line, format!("unknown character {first:?}"))),
            };
            tokens.extend(kind.map(|kind| Token { kind, line }));
            rest = rest[length..].trim_start();
        }
    }
    Ok(tokens)
}

/// Returns whether the next number is a single digit: `\frac12` is one half, and `x^23` is x² times
/// 3.
fn takes_one_digit(tokens: &[Token]) -> bool {
    let is_fraction =
        |token: &Token| ["frac", "tfrac", "dfrac"].iter().any(|name| token.is_command(name));
    match tokens {
        [.., fraction, last] if is_fraction(fraction) => matches!(last.kind, TokenKind::Number(_)),
        [.., last] => is_fraction(last) || last.is_symbol('^') || last.is_symbol('_'),
        [] => false,
    }
}

fn read_number(text: &str) -> (Option<TokenKind>, usize) {
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(text);
    let fraction = text[whole..].strip_prefix('.').map_or(0, digits);
    let length = if fraction == 0 { whole } else { whole + 1 + fraction };
    (text[..length].parse().ok().map(TokenKind::Number), length)
}

fn read_command(text: &str) -> (Option<TokenKind>, usize) {
    let letters = text[1..].bytes().take_while(u8::is_ascii_alphabetic).count();
    let length = 1 + letters.max(text[1..].chars().next().map_or(0, char::len_utf8).min(1));
    let name = text.get(1..length).unwrap_or_default();
    if LAYOUT.contains(&name) {
        // `\left.` is an invisible bracket.
        let dot = matches!(name, "left" | "right") && text[length..].starts_with('.');
        return (None, length + usize::from(dot));
    }
    // `\\[4pt]` starts a new row after some space.
    let distance = text[length..].strip_prefix('[').and_then(|rest| rest.split_once(']'));
    let distance = distance.filter(|(inner, _)| name == "\\" && inner.ends_with(['t', 'm', 'x']));
    let length = length + distance.map_or(0, |(inner, _)| inner.len() + 2);
    (Some(TokenKind::Command(name.to_owned())), length)
}

#[cfg(test)]
mod tests {
    use super::{TokenKind, tokenize};

    fn kinds(latex: &str) -> Vec<TokenKind> {
        tokenize(latex).unwrap().into_iter().map(|token| token.kind).collect()
    }

    #[test]
    fn numbers_letters_commands_and_symbols_are_tokens() {
        use TokenKind::{Command, Letter, Number, Symbol};
        assert_eq!(kinds("2.5fn."), [Number(2.5), Letter('f'), Letter('n'), Symbol('.')]);
        assert_eq!(kinds("\\left(\\, 2 \\right)"), [Symbol('('), Number(2.0), Symbol(')')]);
        let row = [Command("\\".to_owned()), Command("alpha".to_owned())];
        assert_eq!(kinds("\\\\[4pt] \\alpha"), row);
        assert_eq!(kinds("\\|"), [Command("|".to_owned())]);
        assert_eq!(kinds("\\frac12"), [Command("frac".to_owned()), Number(1.0), Number(2.0)]);
    }

    #[test]
    fn unknown_characters_are_reported_with_their_line() {
        assert_eq!(tokenize("a\n\u{2212}b").unwrap_err().0, 1);
        assert!(tokenize("\\").is_ok());
    }
}
