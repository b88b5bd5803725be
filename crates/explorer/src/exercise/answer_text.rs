//! Splits typed answers (matrices, points, lists and named formulas) into entries.

use super::answer_error::AnswerError;
use super::answer_list::{FactoredList, split_rows, without_outer_parentheses};

/// The maximum length of an answer, in characters.
const MAX_CHARACTERS: usize = 4000;

/// The shape of an answer.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum AnswerShape {
    /// A matrix with this number of rows and columns.
    Matrix(usize, usize),
    /// Named numbers or formulas, in one or more parts.
    Parts(&'static [&'static [&'static str]]),
}

impl AnswerShape {
    /// Returns the number of entries in each row.
    pub(super) fn row_lengths(self) -> Vec<usize> {
        match self {
            Self::Matrix(rows, columns) => vec![columns; rows],
            Self::Parts(parts) => parts.iter().map(|names| names.len()).collect(),
        }
    }
}

/// Splits an answer into entries, row by row. The number of entries is not checked.
///
/// # Errors
/// Returns an error if the answer is empty or too long or if it contains unknown names.
pub(super) fn split_answer(
    text: &str,
    shape: AnswerShape,
) -> Result<Vec<Vec<String>>, AnswerError> {
    if text.chars().nth(MAX_CHARACTERS).is_some() {
        return Err(AnswerError::new(
            format!("an answer can have at most {MAX_CHARACTERS} characters"),
            format!("答案超过 {MAX_CHARACTERS} 个字符"),
        ));
    }
    let text = plain_text(text);
    let text = without_outer_parentheses(&text);
    let rows = match shape {
        AnswerShape::Parts([names]) => vec![split_values(text, names)?],
        _ => split_rows(text, shape)?,
    };
    let rows: Vec<Vec<String>> = rows.into_iter().filter(|row: &Vec<_>| !row.is_empty()).collect();
    if rows.is_empty() {
        return Err(AnswerError::new("the answer is empty", "答案为空"));
    }
    Ok(match (shape, rows.as_slice()) {
        (AnswerShape::Matrix(_, columns), [all])
            if shape.row_lengths().iter().sum::<usize>() == all.len() =>
        {
            all.chunks(columns).map(<[String]>::to_vec).collect()
        }
        _ => rows,
    })
}

/// Returns the text with plain operators, and with parentheses for all brackets except in `n_{x}`.
fn plain_text(text: &str) -> String {
    let (mut plain, mut open_subscripts) = (String::new(), 0);
    for c in text.chars() {
        match c {
            '{' if plain.ends_with('_') => open_subscripts += 1,
            '}' if open_subscripts > 0 => open_subscripts -= 1,
            'ₙ' => plain.push_str("_n"),
            c => plain.push(plain_character(c)),
        }
    }
    plain
}

/// Converts typeset operators, full-width characters and line breaks to the equivalent character in
/// expressions.
fn plain_character(c: char) -> char {
    match c {
        '−' | '－' => '-',
        '·' | '×' | '⋅' | '＊' => '*',
        '÷' | '／' => '/',
        '＋' => '+',
        '＝' => '=',
        '，' | '、' => ',',
        '；' | '\n' => ';',
        '（' | '[' | '{' | '［' | '【' => '(',
        '）' | ']' | '}' | '］' | '】' => ')',
        '₀'..='₉' => char::from_digit(u32::from(c) - u32::from('₀'), 10).unwrap_or(c),
        other => other,
    }
}

/// Returns the pieces between separators outside parentheses, without blank pieces.
pub(super) fn split_at_top(text: &str, separates: fn(char) -> bool) -> Vec<&str> {
    let mut depth = 0_i32;
    let pieces = text.split(move |c| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        depth <= 0 && separates(c)
    });
    pieces.map(str::trim).filter(|piece| !piece.is_empty()).collect()
}

/// Splits a row into entries, at commas or, if there are none, at spaces.
pub(super) fn split_row(row: &str) -> Vec<String> {
    let entries = split_at_top(row, |c| c == ',');
    let entries = if let [only] = entries.as_slice() { split_at_blanks(only) } else { entries };
    entries.into_iter().map(str::to_owned).collect()
}

/// Splits a row into entries at spaces, except for the spaces in `a - b`, `a * b` and `(a + b)`.
pub(super) fn split_at_blanks(row: &str) -> Vec<&str> {
    let operator = |c: char| matches!(c, '+' | '-' | '*' | '/' | '^' | '=');
    let (mut entries, mut begin, mut depth) = (Vec::new(), 0, 0_i32);
    for (at, c) in row.char_indices() {
        depth += i32::from(c == '(') - i32::from(c == ')');
        if !c.is_whitespace() || depth > 0 {
            continue;
        }
        let (before, after) = (row[..at].trim_end(), row[at..].trim_start());
        let mut next = after.chars();
        let joins = match next.next() {
            // A sign without a space after it belongs to the next entry.
            Some('+' | '-') => next.next().is_none_or(char::is_whitespace),
            Some(c) => c == '°' || operator(c),
            None => true,
        };
        if !joins && !before.ends_with(operator) && begin < before.len() {
            entries.push(row[begin..at].trim());
            begin = at;
        }
    }
    entries.push(row[begin..].trim());
    entries.retain(|entry| !entry.is_empty());
    entries
}

/// Returns the values of a row: a list, optionally times a factor, or named values.
fn split_values(text: &str, names: &[&str]) -> Result<Vec<String>, AnswerError> {
    let is_separator = |c: char| c == ';' || c == ',';
    let is_one = split_at_top(text, is_separator).len() <= 1 && text.matches('=').count() <= 1;
    if names.len() > 1 && is_one {
        // `(x, y) = (1, 2)` and `p = h (a, b, c, 1)`, but not `x = 1, y = 2`.
        let list = text.rsplit_once('=').map_or(text, |(_, list)| list.trim());
        if let Some(factored) = FactoredList::find(list, names.len()) {
            return factored.entries(names.len());
        }
    }
    let mut entries = split_at_top(text, is_separator);
    if let ([only], true) = (entries.as_slice(), names.len() > 1) {
        entries = split_at_blanks(only);
    }
    order_by_name(entries, names)
}

/// Removes names from entries such as `A = n + f`, and returns the entries in the order of the
/// names.
fn order_by_name(entries: Vec<&str>, names: &[&str]) -> Result<Vec<String>, AnswerError> {
    let named: Vec<Option<(&str, &str)>> =
        entries.iter().map(|entry| entry.split_once('=')).collect();
    if named.iter().all(Option::is_none) {
        return Ok(entries.into_iter().map(str::to_owned).collect());
    }
    if let ([Some((_, only))], 1) = (named.as_slice(), names.len()) {
        return Ok(vec![only.trim().to_owned()]);
    }
    let unknown = |name: &str| {
        let known = names.join(", ");
        AnswerError::new(
            format!("enter each of {known} once, as in `{} = …`; check `{name}`", names[0]),
            format!("请把 {known} 各给出一次，例如 `{} = …`；`{name}`", names[0]),
        )
    };
    let mut ordered = vec![None; names.len()];
    for (entry, found) in entries.iter().zip(named) {
        let (name, value) = found.ok_or_else(|| unknown(entry))?;
        let plain = name.trim().replace('_', "");
        let at = names.iter().position(|known| *known == plain).ok_or_else(|| unknown(entry))?;
        if ordered[at].replace(value.trim().to_owned()).is_some() {
            return Err(unknown(entry));
        }
    }
    let missing = ordered.iter().position(Option::is_none);
    missing.map_or(Ok(()), |at| Err(unknown(names[at])))?;
    Ok(ordered.into_iter().flatten().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    const MATRIX: AnswerShape = AnswerShape::Matrix(2, 3);
    const POINT: AnswerShape = AnswerShape::Parts(&[&["x", "y", "z"]]);
    const FORMULA: AnswerShape = AnswerShape::Parts(&[&["f"]]);

    fn split(text: &str, shape: AnswerShape) -> String {
        let rows = split_answer(text, shape).expect(text);
        rows.iter().map(|row| row.join("|")).collect::<Vec<_>>().join(";")
    }

    #[test]
    fn matrices_are_accepted_in_every_notation() {
        for text in [
            "1 2/3 -3; 4 5 n-1",
            "1, 2/3, -3; 4, 5, n-1;",
            "1 2/3 −3\n4 5 n-1",
            "[[1, 2/3, -3], [4, 5, n-1]]",
            "[1 2/3 -3] [4 5 n-1]",
            "1 2/3 -3 4 5 n-1",
            "{1,2/3,-3},{4,5,n-1}",
            "(1 2/3 -3); (4 5 n-1)",
            "(1, 2/3, -3), (4, 5, n-1)",
            "((1,2/3,-3),(4,5,n-1))",
            "[1,2/3,-3][4,5,n-1]",
            "[[1, 2/3, -3],\n [4, 5, n-1]]",
            "Q = 1 2/3 -3; 4 5 n-1",
            "M_cam=[1 2/3 -3; 4 5 n-1]",
            "u = (1, 2/3, -3); v = (4, 5, n-1)",
            "u=(1,2/3,-3), v=(4,5,n-1)",
            "1，2/3，-3；4，5，n-1",
        ] {
            assert_eq!(split(text, MATRIX), "1|2/3|-3;4|5|n-1", "{text}");
        }
        assert_eq!(
            split("a - b (c + d) 2 * e; -f - g 1 / 2 cos(30 °)", MATRIX),
            "a - b|(c + d)|2 * e;-f - g|1 / 2|cos(30 °)"
        );
        assert_eq!(split("1 2; 3", MATRIX), "1|2;3", "the number of entries is checked later");
    }

    #[test]
    fn points_and_formulas_are_accepted_in_every_notation() {
        for text in [
            "1, -2, 3",
            "(1, -2, 3)",
            "(1 -2 3)",
            "1 -2 3",
            "1; -2; 3",
            "z=3, x = 1; y=-2",
            "[1,-2,3]",
            "[[1],[-2],[3]]",
            "(x, y, z) = (1, -2, 3)",
        ] {
            assert_eq!(split(text, POINT).replace(['(', ')'], ""), "1|-2|3", "{text}");
        }
        assert_eq!(split("n f (a - b)/(a b)", FORMULA), "n f (a - b)/(a b)");
        assert_eq!(split("f(t) = (a)(b)", FORMULA), "(a)(b)");
        assert_eq!(split("f*n*[z1-z2]/{z1*z2}", FORMULA), "f*n*(z1-z2)/(z1*z2)");
        assert_eq!(split("[a]/[b]", FORMULA), "(a)/(b)");
        assert_eq!(split("z_{1} − z₂ fₙ", FORMULA), "z_1 - z2 f_n");
        assert_eq!(split("(1)/(2), (3), (4)", POINT), "(1)/(2)|(3)|(4)");
    }

    #[test]
    fn factors_before_or_after_a_list_multiply_its_entries() {
        for (text, entries) in [
            ("h(a,b,c)", "(h)*(a)|(h)*(b)|(h)*(c)"),
            ("h [a b c]", "(h)*(a)|(h)*(b)|(h)*(c)"),
            ("n*(1,1,1)", "(n)*(1)|(n)*(1)|(n)*(1)"),
            ("(1, 2, 3)/(n f)", "(1)/(n f)|(2)/(n f)|(3)/(n f)"),
            ("-(1, 2, 3)", "(-1)*(1)|(-1)*(2)|(-1)*(3)"),
            ("p = 1/2 (a, b, c)", "(1/2)*(a)|(1/2)*(b)|(1/2)*(c)"),
        ] {
            assert_eq!(split(text, POINT), entries, "{text}");
        }
        assert_eq!(split("2(1 2 3; 4 5 6)", MATRIX).matches("(2)*(").count(), 6);
        assert_eq!(split("(1,2,3); 1/z (x,y,z)", MATRIX), "1|2|3;(1/z)*(x)|(1/z)*(y)|(1/z)*(z)");
        let error = split_answer("1 + (a, b, c)", POINT).expect_err("a sum");
        assert!(error.to_string().contains("every entry"), "{error}");
    }

    #[test]
    fn errors_name_the_values_next_to_a_matrix() {
        for text in [
            "Q = [1, 2, 3; 4, 5, 6], c = n*f",
            "1 2 3; 4 5 6; c = n*f",
            "c = n*f; Q = [1 2 3; 4 5 6]",
            "1 2 3; c=n*f; 4 5 6",
        ] {
            let error = split_answer(text, MATRIX).expect_err(text);
            assert!(error.to_string().contains("without `c"), "{text}: {error}");
        }
    }

    #[test]
    fn invalid_answers_are_reported() {
        for (text, part) in [
            ("", "empty"),
            (" ; ,", "empty"),
            ("x=1, y=2", "`z`"),
            ("x=1, y=2, q=3", "`q=3`"),
            ("x=1, x=2, z=3", "`x=2`"),
            ("x=1, 2, z=3", "`2`"),
        ] {
            let error = split_answer(text, POINT).expect_err(text);
            assert!(error.to_string().contains(part), "{text}: {error}");
        }
        assert!(split_answer(&"1 ".repeat(3000), POINT).is_err());
    }
}
