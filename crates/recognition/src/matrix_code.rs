//! Matrices as source code and LaTeX.
//!
//! | language | order | form |
//! | --- | --- | --- |
//! | C, GLSL, Rust | by columns, as in OpenGL, glTF and glam | array, `mat4`, `[[f64; 4]; 4]` |
//! | Python, LaTeX | by rows | list of lists, `bmatrix` |
//!
//! Numbers are written with the fewest digits that read back as the same f64.

use alloc::borrow::ToOwned as _;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::Write as _;

/// A language in which a matrix can be written.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum CodeLanguage {
    /// C: an array of 16 or 9 doubles, column by column.
    C,
    /// GLSL: a `mat4` or `mat3`, column by column.
    Glsl,
    /// Python: a list of rows.
    Python,
    /// Rust: an array of columns, as in glam.
    Rust,
    /// LaTeX: a `bmatrix`.
    Latex,
}

impl CodeLanguage {
    /// Returns the matrix with the given rows as a statement in the language, or as a LaTeX
    /// formula.
    ///
    /// ```
    /// use recognition::CodeLanguage;
    ///
    /// let code = CodeLanguage::Python.format_matrix([[1.0, 0.5], [0.0, 1.0]]);
    /// assert_eq!(code, "matrix = [  # row by row\n    [1.0, 0.5],\n    [0.0, 1.0],\n]\n");
    /// ```
    #[must_use]
    pub fn format_matrix<const N: usize>(self, rows: [[f64; N]; N]) -> String {
        let columns: [[f64; N]; N] =
            core::array::from_fn(|column| core::array::from_fn(|row| rows[row][column]));
        match self {
            Self::C => {
                let body = lines(columns, "    ", ",");
                format!("const double matrix[{}] = {{ /* column by column */\n{body}}};\n", N * N)
            }
            Self::Glsl => {
                let body = lines(columns, "    ", ",");
                let body = body.trim_end_matches(",\n");
                format!("const mat{N} matrix = mat{N}( // column by column\n{body}\n);\n")
            }
            Self::Python => {
                let body = lines(rows, "    [", "],");
                format!("matrix = [  # row by row\n{body}]\n")
            }
            Self::Rust => {
                let body = lines(columns, "    [", "],");
                format!("let matrix: [[f64; {N}]; {N}] = [ // column by column\n{body}];\n")
            }
            Self::Latex => {
                let body = latex_lines(rows);
                format!("\\begin{{bmatrix}}\n{body}\\end{{bmatrix}}\n")
            }
        }
    }
}

/// Formats a number with a point or an exponent, so that every language reads it as a float.
fn number(x: f64) -> String {
    format!("{:?}", x + 0.0)
}

fn lines<const N: usize>(vectors: [[f64; N]; N], open: &str, close: &str) -> String {
    vectors.iter().fold(String::new(), |mut text, vector| {
        let entries: Vec<String> = vector.iter().copied().map(number).collect();
        let _ = writeln!(text, "{open}{}{close}", entries.join(", "));
        text
    })
}

/// Formats the rows of a `bmatrix`; powers of ten are written as factors.
fn latex_lines<const N: usize>(rows: [[f64; N]; N]) -> String {
    rows.iter().fold(String::new(), |mut text, row| {
        let entries: Vec<String> = row.iter().map(|&x| latex_number(x)).collect();
        let _ = writeln!(text, "  {} \\\\", entries.join(" & "));
        text
    })
}

fn latex_number(x: f64) -> String {
    let text = number(x);
    let text = text.strip_suffix(".0").unwrap_or(&text);
    match text.split_once('e') {
        Some((digits, exponent)) => format!("{digits} \\cdot 10^{{{exponent}}}"),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: [[f64; 3]; 3] = [[1.0, 0.5, -0.0], [0.0, 1e-9, 2.0], [0.0, 0.0, 1.0]];

    #[test]
    fn each_language_has_its_order_and_brackets() {
        let code = |language: CodeLanguage| language.format_matrix(ROWS);
        let python = "matrix = [  # row by row\n    [1.0, 0.5, 0.0],\n    [0.0, 1e-9, 2.0],\n    [0.0, 0.0, 1.0],\n]\n";
        assert_eq!(code(CodeLanguage::Python), python);
        let glsl = "const mat3 matrix = mat3( // column by column\n    1.0, 0.0, 0.0,\n    0.5, 1e-9, 0.0,\n    0.0, 2.0, 1.0\n);\n";
        assert_eq!(code(CodeLanguage::Glsl), glsl);
        assert!(code(CodeLanguage::C).starts_with("const double matrix[9] = {"));
        assert!(code(CodeLanguage::Rust).contains("    [0.5, 1e-9, 0.0],\n"));
        assert!(code(CodeLanguage::Latex).contains("  0 & 1 \\cdot 10^{-9} & 2 \\\\\n"));
    }
}
