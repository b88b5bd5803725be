//! Lists in parentheses: matrices by rows, and factors in front of a list.

use super::answer_error::AnswerError;
use super::answer_text::{AnswerShape, split_at_blanks, split_at_top, split_row};

/// A list in parentheses with the text before and after it, such as `h (a, b, c)` or `(1, 2)/3`.
pub(super) struct FactoredList<'a> {
    text: &'a str,
    before: &'a str,
    list: &'a str,
    behind: &'a str,
}

impl<'a> FactoredList<'a> {
    /// Finds the list in text that contains exactly one list. `count` entries separated by spaces
    /// also form a list.
    pub(super) fn find(text: &'a str, count: usize) -> Option<Self> {
        if split_at_top(text, is_separator).len() > 1 {
            return None;
        }
        let groups = top_groups(text);
        let is_list = |(begin, end): &&(usize, usize)| {
            split_at_top(&text[begin + 1..*end], is_separator).len() > 1
        };
        let mut lists = groups.iter().filter(is_list);
        let found = match (lists.next(), lists.next()) {
            (Some(only), None) => Some(only),
            (None, _) if split_at_blanks(text).len() != count => groups
                .last()
                .filter(|(begin, end)| split_at_blanks(&text[begin + 1..*end]).len() == count),
            _ => None,
        };
        let (begin, end) = *found?;
        let list = &text[begin + 1..end];
        Some(Self { text, before: text[..begin].trim(), list, behind: text[end + 1..].trim() })
    }

    /// Returns the entries, multiplied by the factors before and after the list. Without
    /// separators, the list is split at spaces if `count` is greater than 1.
    pub(super) fn entries(&self, count: usize) -> Result<Vec<String>, AnswerError> {
        let entries = split_at_top(self.list, is_separator);
        let entries = match entries.as_slice() {
            [only] if count > 1 => split_at_blanks(only),
            _ => entries,
        };
        self.multiply(entries.into_iter().map(str::to_owned).collect())
    }

    fn multiply(&self, entries: Vec<String>) -> Result<Vec<String>, AnswerError> {
        let factor = match self.before.strip_suffix('*').unwrap_or(self.before).trim_end() {
            "-" => "-1",
            factor => factor,
        };
        if factor.ends_with(['+', '-', '*', '/', '^'])
            || !(self.behind.is_empty() || self.behind.starts_with(['*', '/']))
        {
            let text = self.text;
            return Err(AnswerError::new(
                format!("`{text}` is not a list: write out every entry"),
                format!("`{text}` 不是列表：请逐个写出每个元素"),
            ));
        }
        let multiply = |entry: String| match (factor, self.behind) {
            ("", "") => entry,
            ("", behind) => format!("({entry}){behind}"),
            (factor, behind) => format!("({factor})*({entry}){behind}"),
        };
        Ok(entries.into_iter().map(multiply).collect())
    }
}

const fn is_separator(c: char) -> bool {
    matches!(c, ',' | ';')
}

/// Returns the positions of each pair of top-level parentheses.
fn top_groups(text: &str) -> Vec<(usize, usize)> {
    let (mut groups, mut depth, mut begin) = (Vec::new(), 0_i32, 0);
    for (at, c) in text.char_indices() {
        match c {
            '(' => {
                if depth == 0 {
                    begin = at;
                }
                depth += 1;
            }
            ')' => {
                depth -= 1;
                if depth == 0 {
                    groups.push((begin, at));
                }
                depth = depth.max(0);
            }
            _ => {}
        }
    }
    groups
}

/// Removes parentheses around the whole text, as in the point `(1, 2, 3)`.
pub(super) fn without_outer_parentheses(text: &str) -> &str {
    let mut text = text.trim();
    while let [(0, end)] = *top_groups(text).as_slice()
        && end + 1 == text.len()
    {
        text = text[1..end].trim();
    }
    text
}

/// Splits text into the rows of a matrix or into several parts.
pub(super) fn split_rows(text: &str, shape: AnswerShape) -> Result<Vec<Vec<String>>, AnswerError> {
    let text = match shape {
        AnswerShape::Matrix(..) => without_matrix_name(text),
        AnswerShape::Parts(_) => text,
    };
    let count = shape.row_lengths().into_iter().max().unwrap_or(0);
    // Applies a factor of the whole matrix. Without one, `text` has no outer parentheses.
    if let Some(matrix) = FactoredList::find(text, 0)
        && (matrix.list.contains(';') || matrix.list.contains('('))
        && !(matrix.before.is_empty() && matrix.behind.is_empty())
    {
        let rows = split_plain_rows(matrix.list, count)?;
        return rows.into_iter().map(|row| matrix.multiply(row)).collect();
    }
    split_plain_rows(without_outer_parentheses(text), count)
}

fn split_plain_rows(text: &str, count: usize) -> Result<Vec<Vec<String>>, AnswerError> {
    let mut rows = split_at_top(text, |c| c == ';');
    if let [only] = *rows.as_slice() {
        let is_named_list = only.matches('=').count() > 1
            || only.split_once('=').is_some_and(|(before, _)| before.contains(','));
        rows = if is_named_list {
            split_at_top(only, |c| c == ',')
        } else {
            rows_in_parentheses(only).unwrap_or(rows)
        };
    }
    let rows = without_row_names(rows)?.into_iter();
    let split = |row: &str| {
        let row = without_outer_parentheses(row.trim_matches([',', ' ']));
        match FactoredList::find(row, count) {
            Some(list) => list.entries(count),
            None => Ok(split_row(row)),
        }
    };
    rows.map(split).collect()
}

/// Returns rows such as `(1 0) (0 1)` or `(1, 0), (0, 1)`, if all rows are in parentheses.
fn rows_in_parentheses(text: &str) -> Option<Vec<&str>> {
    let groups = top_groups(text);
    let mut end = 0;
    let mut rows = Vec::new();
    for (begin, close) in groups {
        let between = text.get(end..begin)?;
        let row = &text[begin + 1..close];
        if !between.chars().all(|c| c == ',' || c.is_whitespace()) || split_row(row).len() < 2 {
            return None;
        }
        rows.push(row);
        end = close + 1;
    }
    (rows.len() > 1 && text[end..].trim_matches([',', ' ']).is_empty()).then_some(rows)
}

/// Removes the name of the matrix from `Q = …`. The name begins with a capital letter.
fn without_matrix_name(text: &str) -> &str {
    let belongs = |c: char| c.is_alphanumeric() || matches!(c, '_' | '\'' | '^' | '-' | '(' | ')');
    match text.split_once('=') {
        Some((name, matrix)) if name.starts_with(char::is_uppercase) => {
            if name.trim().chars().all(belongs) { matrix.trim() } else { text }
        }
        _ => text,
    }
}

/// Removes row names if all rows have one, as in `u = …; v = …; w = …`.
fn without_row_names(rows: Vec<&str>) -> Result<Vec<&str>, AnswerError> {
    let values: Vec<&str> =
        rows.iter().filter_map(|row| Some(row.split_once('=')?.1.trim())).collect();
    if values.is_empty() {
        return Ok(rows);
    }
    if values.len() == rows.len() && !rows.iter().any(|row| row.starts_with(char::is_uppercase)) {
        return Ok(values);
    }
    let beside = rows.iter().find(|row| row.contains('=') && !row.starts_with(char::is_uppercase));
    let beside = beside.or_else(|| rows.iter().find(|row| row.contains('='))).unwrap_or(&rows[0]);
    Err(AnswerError::new(
        format!("enter only the matrix, without `{beside}`"),
        format!("只需给出矩阵本身：请去掉 `{beside}`"),
    ))
}
