//! An explanation as plain text, with labels in a column and aligned matrices.
//!
//! ```text
//!  1. Camera: from the world to view space (CA-1, CA-2)
//!     eye                     (4, 3, 6)
//!     R, u v w to the axes    [ 0.83205 0       -0.5547  0 ]
//!                             [ …                        ]
//! ```

use super::{Explanation, ExplanationEntry, ItemValue, Step};
use std::fmt::{self, Display, Formatter};

/// The maximum width of the introduction in characters.
const LINE_WIDTH: usize = 100;

impl Display for Explanation {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.subject)?;
        if let Some(words) = self.introduction() {
            f.write_str("\n")?;
            write_wrapped(f, words)?;
        }
        for (number, step) in (1..).zip(&self.steps) {
            writeln!(f, "\n{number}. {}{}", step.title, FormulaSuffix(step))?;
            let width = step.items.iter().map(|item| item.name.chars().count()).max().unwrap_or(0);
            for item in &step.items {
                write_item_text(f, item, width)?;
            }
        }
        writeln!(f, "\n{}", self.verdict)
    }
}

/// Writes a paragraph wrapped to lines of at most 100 characters.
fn write_wrapped(f: &mut Formatter<'_>, words: &str) -> fmt::Result {
    let mut line = String::new();
    for word in words.split_whitespace() {
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > LINE_WIDTH {
            writeln!(f, "{line}")?;
            line.clear();
        }
        line += if line.is_empty() { "" } else { " " };
        line += word;
    }
    writeln!(f, "{line}")
}

/// The formula ids of a step, to be formatted as ` (CA-1, CA-2)`, or as nothing if it has none.
struct FormulaSuffix<'a>(&'a Step);

impl Display for FormulaSuffix<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.0.formula.map_or(Ok(()), |formula| write!(f, " ({formula})"))
    }
}

/// Writes an item with its label padded to `width`.
///
/// The label is on the first line only; the other rows of a matrix are indented below it. `width`
/// counts characters, not bytes, for labels such as `x, y = ±distance`.
fn write_item_text(f: &mut Formatter<'_>, item: &ExplanationEntry, width: usize) -> fmt::Result {
    let lines = match &item.value {
        ItemValue::Matrix(rows) => format_matrix(rows),
        ItemValue::PlanarMatrix(rows) => format_matrix(rows),
        ItemValue::Numbers(numbers) => {
            let all: Vec<String> = numbers.iter().copied().map(format_number).collect();
            format!("({})", all.join(", "))
        }
        ItemValue::Number(value) => format_number(*value),
        ItemValue::Text(words) => words.clone(),
    };
    let mut name = item.name.as_str();
    for line in lines.lines() {
        writeln!(f, "   {name:width$}  {line}")?;
        name = "";
    }
    Ok(())
}

/// Formats a matrix with aligned columns, one row per line, and the numbers formatted as in lists.
fn format_matrix<const N: usize>(rows: &[[f64; N]; N]) -> String {
    let cells = rows.map(|row| row.map(format_number));
    let width = |column: usize| cells.iter().map(|row| row[column].len()).max().unwrap_or(0);
    let widths: [usize; N] = std::array::from_fn(width);
    let lines = cells.map(|row| {
        let padded = row.iter().zip(widths).map(|(cell, width)| format!("{cell:>width$}"));
        format!("[ {} ]", padded.collect::<Vec<_>>().join("  "))
    });
    lines.join("\n")
}

/// Formats a number with up to seven significant digits, without trailing zeros; −0 as 0.
///
/// ```text
///  0, 1e-4 ≤ |x| < 1e9   decimal     0.333333   123456.8
///  otherwise             scientific  1.5e-9
/// ```
/// The digits before the point are counted in the rounded number, so 9.9999999 becomes 10 instead
/// of a number with eight digits. Infinities print as `inf`.
pub(super) fn format_number(x: f64) -> String {
    // Turns −0 into 0.
    let x = x + 0.0;
    let size = x.abs();
    if !(size == 0.0 || (1e-4..1e9).contains(&size)) {
        return format_scientific(x);
    }
    let before = format!("{size:.0}").len().min(7);
    let digits = format!("{x:.*}", 7 - before);
    if digits.contains('.') {
        digits.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        digits
    }
}

/// Formats a very small, very large or infinite number, such as `1.5e-9`.
fn format_scientific(x: f64) -> String {
    let text = format!("{x:.6e}");
    match text.split_once('e') {
        Some((digits, power)) => {
            format!("{}e{power}", digits.trim_end_matches('0').trim_end_matches('.'))
        }
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_at_most_seven_significant_digits() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (1.5, "1.5"),
            (-100.0, "-100"),
            (1.0 / 3.0, "0.333333"),
            (123_456.789, "123456.8"),
            (1e-9, "1e-9"),
            (-1.25e-7, "-1.25e-7"),
            (2.0e12, "2e12"),
            (f64::INFINITY, "inf"),
        ];
        for (x, text) in cases {
            assert_eq!(format_number(x), text);
        }
    }

    /// One third is printed in the same way in a matrix and in coordinates.
    #[test]
    fn numbers_are_printed_alike_in_matrices_and_lists() {
        let third = 1.0 / 3.0;
        let step = Step::new("one", "One", None)
            .with_item("matrix", "matrix", [[third, 0.0, 0.0, 1e-9]; 4])
            .with_item("list", "list", [third, 1e-9]);
        let (subject, verdict) = ("A third".to_owned(), String::new());
        let text = Explanation { subject, steps: vec![step], verdict }.to_string();
        assert_eq!(text.matches("0.333333").count(), 5, "{text}");
        assert_eq!(text.matches("1e-9").count(), 5, "{text}");
    }
}
