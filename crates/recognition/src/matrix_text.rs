//! Matrix text: sixteen or nine numbers as people and programs write them, also in source code.
//!
//! ```text
//!  1 0 0 2  0 1 0 1/2  0 0 1 -1e3  0 0 0 1              row by row
//!  [[1,0,0,2],[0,1,0,.5],[0,0,1,-1000],[0,0,0,1]]       row by row
//!  mat4(1.0, 0.0, …)   DMat4::from_cols_array(&[…])      column by column
//!  const double m[16] = { /* column by column */ … };    as the comment says
//! ```

use alloc::borrow::ToOwned as _;
use alloc::string::String;
use alloc::vec::Vec;

/// A matrix for column vectors, listed by rows, with the translation in the last column.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum GivenMatrix {
    /// A matrix in space, in homogeneous coordinates.
    Space([[f64; 4]; 4]),
    /// A matrix in the plane, in homogeneous coordinates.
    Plane([[f64; 3]; 3]),
}

/// A matrix and, for source code, the order in which it was read.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ParsedMatrix {
    /// The matrix.
    pub matrix: GivenMatrix,
    /// The order and the reason for it, such as `column by column, as in mat constructors`, or
    /// `None` for plain numbers.
    pub order: Option<&'static str>,
}

/// The reason why a string could not be parsed as a matrix.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MatrixTextError {
    /// A word is not a number.
    #[error("`{0}` is not a number")]
    NotANumber(String),
    /// The count of numbers is neither sixteen nor nine.
    #[error("expected 16 numbers, or 9 for a 3 × 3 matrix, found {0}")]
    WrongCount(usize),
}

/// Words in lower-case source code, whether they reveal an order by columns, and the order to
/// report. The first match in this list applies.
const ORDERS: [(&str, bool, &str); 13] = [
    ("column by column", true, "column by column, as its comment says"),
    ("row by row", false, "row by row, as its comment says"),
    ("column-major", true, "column by column, as its comment says"),
    ("row-major", false, "row by row, as its comment says"),
    ("from_cols", true, "column by column, as in from_cols"),
    ("fromarray", true, "column by column, as in fromArray"),
    ("bmatrix", false, "row by row, as in LaTeX"),
    ("mat4x4", true, "column by column, as in mat constructors"),
    ("mat3x3", true, "column by column, as in mat constructors"),
    ("mat4(", true, "column by column, as in mat constructors"),
    ("mat3(", true, "column by column, as in mat constructors"),
    ("=", false, "row by row, as assumed for source code; --column-major reads columns"),
    ("(", false, "row by row, as assumed for source code; --column-major reads columns"),
];

/// Parses the rows of a matrix from source code, or from sixteen or nine numbers that are separated
/// by brackets, commas or spaces.
///
/// The rows are for column vectors, with the translation in the last column. Numbers stored column
/// by column, as in OpenGL, are transposed; with `column_major`, all numbers are read by columns.
///
/// ```
/// use recognition::{GivenMatrix, parse_matrix};
///
/// let parsed = parse_matrix("mat3(1, 0, 0, 0, 1, 0, 2/3, 0.5, 1)", false)?;
/// let rows = [[1.0, 0.0, 2.0 / 3.0], [0.0, 1.0, 0.5], [0.0, 0.0, 1.0]];
/// assert_eq!(parsed.matrix, GivenMatrix::Plane(rows));
/// assert_eq!(parsed.order, Some("column by column, as in mat constructors"));
/// # Ok::<(), recognition::MatrixTextError>(())
/// ```
///
/// # Errors
/// Returns an error if a word is not a number, or if there are neither sixteen nor nine numbers.
pub fn parse_matrix(text: &str, column_major: bool) -> Result<ParsedMatrix, MatrixTextError> {
    if !is_code(text) {
        let matrix = matrix_of(&split_words(text), column_major)?;
        return Ok(ParsedMatrix { matrix, order: None });
    }
    let lower = text.to_lowercase();
    let known = ORDERS.iter().find(|(sign, ..)| lower.contains(sign));
    let (columns, order) = match known {
        _ if column_major => (true, "column by column, as --column-major says"),
        Some((_, columns, order)) => (*columns, *order),
        None => (false, "row by row"),
    };
    let body = without_comments(text).replace(" \\cdot 10^{", "e");
    let body = body.split_once('=').map_or(body.as_str(), |(_, value)| value);
    let is_name = |word: &&str| word.starts_with(|c: char| c.is_alphabetic() || c == '_');
    let words = split_words(body).into_iter().filter(|word| !is_name(word)).map(without_suffix);
    let matrix = matrix_of(&words.collect::<Vec<_>>(), columns)?;
    Ok(ParsedMatrix { matrix, order: Some(order) })
}

/// Whether a string contains names or comments in addition to numbers.
fn is_code(text: &str) -> bool {
    let signs = ["=", "mat", "Mat", "vec", "array", "Array", "//", "/*", "#", "\\begin", "set("];
    signs.iter().any(|sign| text.contains(sign))
}

/// Returns the text without C, Rust and Python comments.
fn without_comments(text: &str) -> String {
    let mut kept = String::new();
    let mut rest = text;
    while let Some((before, comment)) = rest.split_once("/*") {
        kept += before;
        rest = comment.split_once("*/").map_or("", |(_, after)| after);
    }
    kept += rest;
    let line = |line: &str| {
        let end = [line.find("//"), line.find('#')].into_iter().flatten().min();
        line[..end.unwrap_or(line.len())].to_owned()
    };
    kept.lines().map(line).collect::<Vec<_>>().join("\n")
}

fn split_words(text: &str) -> Vec<&str> {
    let between = |c: char| c.is_whitespace() || "[](){}<>,;|&\\:!".contains(c);
    text.split(between).filter(|word| !word.is_empty()).collect()
}

/// Returns a number in source code without its type suffix, as in `1.0f` or `1_f64`.
fn without_suffix(word: &str) -> &str {
    let suffixes = ["_f32", "_f64", "f32", "f64", "lf", "LF", "f", "F"];
    suffixes.iter().find_map(|suffix| word.strip_suffix(suffix)).unwrap_or(word)
}

fn matrix_of(words: &[&str], columns: bool) -> Result<GivenMatrix, MatrixTextError> {
    let numbers: Vec<f64> =
        words.iter().map(|word| parse_number(word)).collect::<Result<_, _>>()?;
    match numbers.len() {
        16 => Ok(GivenMatrix::Space(arrange(&numbers, columns))),
        9 => Ok(GivenMatrix::Plane(arrange(&numbers, columns))),
        found => Err(MatrixTextError::WrongCount(found)),
    }
}

/// Returns the rows of N × N numbers, which are listed by rows or by columns.
fn arrange<const N: usize>(listed: &[f64], columns: bool) -> [[f64; N]; N] {
    let at = |row: usize, column: usize| if columns { N * column + row } else { N * row + column };
    core::array::from_fn(|row| core::array::from_fn(|column| listed[at(row, column)]))
}

/// Parses a number or a fraction such as `2/3`; the typographic minus sign is accepted.
///
/// Division by zero results in infinity, which is rejected later, like all numbers that are not
/// finite.
///
/// # Errors
/// Returns an error if the word is neither a number nor a fraction.
pub fn parse_number(word: &str) -> Result<f64, MatrixTextError> {
    let fault = || MatrixTextError::NotANumber(word.to_owned());
    let parse = |digits: &str| digits.replace('−', "-").parse::<f64>().map_err(|_| fault());
    match word.split_once('/') {
        Some((above, below)) => Ok(parse(above)? / parse(below)?),
        None => parse(word),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString as _;

    const ROWS: [[f64; 4]; 4] =
        [[1.0, 0.0, 0.0, 2.0], [0.0, 1.0, 0.0, 0.5], [0.0, 0.0, 1.0, -1e3], [0.0, 0.0, 0.0, 1.0]];

    fn parse(text: &str, columns: bool) -> Result<GivenMatrix, String> {
        let parsed = parse_matrix(text, columns).map(|parsed| parsed.matrix);
        parsed.map_err(|error| error.to_string())
    }

    #[test]
    fn brackets_commas_and_fractions_are_accepted() {
        let space = Ok(GivenMatrix::Space(ROWS));
        assert_eq!(parse("1 0 0 2 0 1 0 1/2 0 0 1 −1e3 0 0 0 1", false), space);
        assert_eq!(parse("[[1,0,0,2],[0,1,0,.5],[0,0,1,-1000],[0,0,0,1]]", false), space);
        assert_eq!(parse("(1 0 0 0) (0 1 0 0) (0 0 1 0) (2 0.5 -1000 1)", true), space);
        let plane = GivenMatrix::Plane([[1.0, 0.0, -0.5], [0.0, 1.0, 2.0], [0.0, 0.0, 1.0]]);
        assert_eq!(parse("1 0 -.5 0 1 2 0 0 1", false), Ok(plane));
        let message = "expected 16 numbers, or 9 for a 3 × 3 matrix, found 3";
        assert_eq!(parse("1 2 3", false), Err(message.to_owned()));
        assert_eq!(parse("1 x", false), Err("`x` is not a number".to_owned()));
    }

    #[test]
    fn code_is_read_in_the_order_of_its_language() {
        let space = GivenMatrix::Space(ROWS);
        for (code, order) in [
            ("mat4(1.0, 0., 0, 0, 0,1,0,0, 0,0,1,0, 2.0, .5, -1e3, 1)", "mat constructors"),
            (
                "glm::mat4 m = mat4(vec4(1,0,0,0), vec4(0,1,0,0), vec4(0,0,1,0), vec4(2,.5f,-1e3f,1));",
                "mat",
            ),
            ("mat4x4<f32>(1,0,0,0, 0,1,0,0, 0,0,1,0, 2,0.5,-1000,1)", "column by column"),
            (
                "DMat4::from_cols_array(&[1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.,2.,0.5_f64,-1e3,1.])",
                "from_cols",
            ),
            ("float m[4][4] = {{1,0,0,2},{0,1,0,.5f},{0,0,1,-1e3f},{0,0,0,1}}; // m", "row by row"),
            ("m = np.array([[1,0,0,2],[0,1,0,.5],[0,0,1,-1e3],[0,0,0,1]], dtype=float)", "assumed"),
        ] {
            let parsed = parse_matrix(code, false).expect(code);
            assert_eq!(parsed.matrix, space, "{code}");
            assert!(parsed.order.is_some_and(|words| words.contains(order)), "{code}: {parsed:?}");
        }
    }
}
