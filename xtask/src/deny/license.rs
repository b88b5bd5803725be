//! Evaluates SPDX license expressions against a list of allowed licenses.

/// Returns whether the licenses in a list satisfy an expression. `/` is an old spelling of `OR`.
pub fn is_satisfied(expression: &str, allowed: &[String]) -> bool {
    let spaced = expression.replace('/', " OR ").replace('(', " ( ").replace(')', " ) ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    let mut rest = &words[..];
    let satisfied = alternatives(&mut rest, allowed);
    satisfied == Some(true) && rest.is_empty()
}

/// Evaluates `A OR B OR …`. Returns `None` if it is not an expression.
fn alternatives(words: &mut &[&str], allowed: &[String]) -> Option<bool> {
    let mut any = conjunction(words, allowed)?;
    while take(words, "OR") {
        any |= conjunction(words, allowed)?;
    }
    Some(any)
}

/// Evaluates `A AND B AND …`.
fn conjunction(words: &mut &[&str], allowed: &[String]) -> Option<bool> {
    let mut all = license(words, allowed)?;
    while take(words, "AND") {
        all &= license(words, allowed)?;
    }
    Some(all)
}

/// Evaluates a license with or without an exception, or an expression in parentheses.
fn license(words: &mut &[&str], allowed: &[String]) -> Option<bool> {
    if take(words, "(") {
        let inner = alternatives(words, allowed)?;
        return take(words, ")").then_some(inner);
    }
    let (name, rest) = words.split_first()?;
    *words = rest;
    if ["OR", "AND", "WITH", ")"].contains(name) {
        return None;
    }
    let mut name = (*name).to_owned();
    if take(words, "WITH") {
        let (exception, rest) = words.split_first()?;
        *words = rest;
        name = format!("{name} WITH {exception}");
    }
    Some(allowed.contains(&name))
}

fn take(words: &mut &[&str], wanted: &str) -> bool {
    let rest = words.split_first().filter(|(word, _)| **word == wanted).map(|(_, rest)| rest);
    *words = rest.unwrap_or(words);
    rest.is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_alternative_is_enough_and_all_parts_are_needed() {
        let allowed = ["MIT", "Zlib"].map(str::to_owned);
        let table = [
            ("MIT", true),
            ("GPL-3.0-only", false),
            ("Apache-2.0 OR MIT", true),
            ("MIT/Apache-2.0", true),
            ("Zlib AND (MIT OR Apache-2.0)", true),
            ("(MIT OR Apache-2.0) AND Unicode-3.0", false),
            ("GPL-3.0-only AND MIT OR Zlib", true),
            ("Apache-2.0 WITH LLVM-exception OR Apache-2.0", false),
            ("Apache-2.0 WITH LLVM-exception OR MIT", true),
            ("", false),
            ("MIT OR", false),
            ("(MIT", false),
            ("MIT Zlib", false),
        ];
        for (expression, expected) in table {
            assert_eq!(is_satisfied(expression, &allowed), expected, "{expression}");
        }
    }
}
