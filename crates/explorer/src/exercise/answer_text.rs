//! Answers as people type them, split into entries: matrices, points, lists and named formulas.

use super::answer_error::AnswerError;

/// The longest answer that is read, in characters.
const MAX_CHARACTERS: usize = 4000;

/// The entries that an answer has.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum AnswerShape {
    /// A matrix of so many rows and columns.
    Matrix(usize, usize),
    /// Named numbers or formulas, in one part or several.
    Parts(&'static [&'static [&'static str]]),
}

impl AnswerShape {
    /// The numbers of entries in each row.
    pub(super) fn row_lengths(self) -> Vec<usize> {
        match self {
            Self::Matrix(rows, columns) => vec![columns; rows],
            Self::Parts(parts) => parts.iter().map(|names| names.len()).collect(),
        }
    }

    /// The names of entries that may be given by name.
    const fn names(self) -> &'static [&'static str] {
        match self {
            Self::Parts([names]) => names,
            _ => &[],
        }
    }
}

/// The entries of an answer, row by row. Their number is not checked.
///
/// # Errors
/// If there are none, or too much, or names that are not asked for.
pub(super) fn split_answer(
    text: &str,
    shape: AnswerShape,
) -> Result<Vec<Vec<String>>, AnswerError> {
    if text.chars().nth(MAX_CHARACTERS).is_some() {
        return Err(AnswerError::new(
            format!("the answer has more than {MAX_CHARACTERS} characters"),
            format!("答案超过 {MAX_CHARACTERS} 个字符"),
        ));
    }
    let text = without_brackets(&text.chars().map(plain_character).collect::<String>());
    let text = without_outer_parentheses(text.trim());
    let rows = match shape {
        AnswerShape::Parts([names]) => {
            let mut entries = split_at_top(text, |c| c == ';' || c == ',');
            if let ([only], true) = (entries.as_slice(), names.len() > 1) {
                entries = split_at_blanks(only);
            }
            vec![order_by_name(entries, shape.names())?]
        }
        _ => split_at_top(text, |c| c == ';').into_iter().map(split_row).collect(),
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

/// The character that stands for it in expressions: signs of typeset formulas, of full width, and
/// line breaks.
const fn plain_character(c: char) -> char {
    match c {
        '−' | '－' => '-',
        '·' | '×' | '⋅' | '＊' => '*',
        '÷' | '／' => '/',
        '＋' => '+',
        '＝' => '=',
        '，' | '、' => ',',
        '；' | '\n' => ';',
        '（' => '(',
        '）' => ')',
        other => other,
    }
}

/// The text without square and curly brackets; between two of them begins a row.
fn without_brackets(text: &str) -> String {
    let mut plain = String::new();
    let mut closed = false;
    for c in text.chars() {
        match c {
            '[' | '{' if closed => {
                plain.push(';');
                closed = false;
            }
            ']' | '}' => closed = true,
            '[' | '{' => {}
            ',' if closed => {}
            c => {
                closed &= c.is_whitespace();
                plain.push(c);
            }
        }
    }
    plain
}

/// The inside of parentheses around the whole, as of the point `(1, 2, 3)`.
fn without_outer_parentheses(text: &str) -> &str {
    let inner = text.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
    let Some(inner) = inner else { return text };
    let mut depth = 0_i32;
    let balanced = inner.chars().all(|c| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        depth >= 0
    });
    if balanced { inner } else { text }
}

/// The pieces between separators outside of parentheses, without those that are blank.
fn split_at_top(text: &str, separates: fn(char) -> bool) -> Vec<&str> {
    let mut depth = 0_i32;
    let pieces = text.split(move |c| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        depth <= 0 && separates(c)
    });
    pieces.map(str::trim).filter(|piece| !piece.is_empty()).collect()
}

/// The entries of a row: between commas, or else between blanks.
fn split_row(row: &str) -> Vec<String> {
    let entries = split_at_top(row, |c| c == ',');
    let entries = if let [only] = entries.as_slice() { split_at_blanks(only) } else { entries };
    entries.into_iter().map(str::to_owned).collect()
}

/// The entries between blanks, but not at the blanks of `a - b`, `a * b` and `(a + b)`.
fn split_at_blanks(row: &str) -> Vec<&str> {
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
            // A sign belongs to the entry that it touches.
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

/// Entries such as `A = n + f` without their names, in the order of the names.
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
            format!("give each of {known} once, such as `{} = …`; `{name}`", names[0]),
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
    fn matrices_are_read_in_every_notation() {
        for text in [
            "1 2/3 -3; 4 5 n-1",
            "1, 2/3, -3; 4, 5, n-1;",
            "1 2/3 −3\n4 5 n-1",
            "[[1, 2/3, -3], [4, 5, n-1]]",
            "[1 2/3 -3] [4 5 n-1]",
            "1 2/3 -3 4 5 n-1",
            "{1,2/3,-3},{4,5,n-1}",
            "1，2/3，-3；4，5，n-1",
        ] {
            assert_eq!(split(text, MATRIX), "1|2/3|-3;4|5|n-1", "{text}");
        }
        assert_eq!(
            split("a - b (c + d) 2 * e; -f - g 1 / 2 cos(30 °)", MATRIX),
            "a - b|(c + d)|2 * e;-f - g|1 / 2|cos(30 °)"
        );
        assert_eq!(split("1 2; 3", MATRIX), "1|2;3", "the number of entries is checked elsewhere");
    }

    #[test]
    fn points_and_formulas_are_read_in_every_notation() {
        for text in [
            "1, -2, 3",
            "(1, -2, 3)",
            "(1 -2 3)",
            "1 -2 3",
            "1; -2; 3",
            "z=3, x = 1; y=-2",
            "[1,-2,3]",
        ] {
            assert_eq!(split(text, POINT), "1|-2|3", "{text}");
        }
        assert_eq!(split("n f (a - b)/(a b)", FORMULA), "n f (a - b)/(a b)");
        assert_eq!(split("f(t) = (a)(b)", FORMULA), "(a)(b)");
        assert_eq!(split("(1)/(2), (3), (4)", POINT), "(1)/(2)|(3)|(4)");
    }

    #[test]
    fn what_cannot_be_split_is_named() {
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
