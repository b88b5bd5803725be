//! `alberti matrix`: classification of a 4x4 matrix.
//!
//! The numbers come from other programs, logs or books, so any brackets and separators are
//! accepted, and the report names the convention (handedness, depth range, row or column vectors)
//! that makes sense of them.

use super::CliError;
use pipeline::explain::explain_matrix;
use std::io::{Read as _, Write as _};

/// Arguments of `alberti matrix`.
#[derive(Debug, clap::Args)]
pub(crate) struct MatrixArgs {
    /// Sixteen numbers, row by row [default: read from the standard input]
    ///
    /// Brackets and commas between them are ignored; fractions such as 2/3 are numbers.
    #[arg(allow_hyphen_values = true)]
    numbers: Vec<String>,
    /// Read the numbers column by column, as OpenGL, glTF and glam store them
    #[arg(long)]
    column_major: bool,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

/// Prints the classification of a matrix.
///
/// # Errors
/// If there are not sixteen numbers, or one of them is not finite.
pub(crate) fn run(args: &MatrixArgs) -> Result<(), CliError> {
    let text = if args.numbers.is_empty() { read_stdin()? } else { args.numbers.join(" ") };
    let rows = parse_matrix(&text, args.column_major).map_err(CliError::Usage)?;
    let found = explain_matrix(rows).map_err(CliError::Usage)?;
    let text = if args.json { format!("{:#}\n", found.to_json()) } else { found.to_string() };
    std::io::stdout().write_all(text.as_bytes())?;
    Ok(())
}

/// Reads the standard input as text, up to a limit that sixteen numbers cannot reach.
///
/// Further bytes are not read, and surplus numbers give the error of a wrong count.
fn read_stdin() -> Result<String, CliError> {
    const MAX_BYTES: u64 = 1 << 16;
    let mut bytes = Vec::new();
    let read = std::io::stdin().take(MAX_BYTES).read_to_end(&mut bytes);
    let fault =
        |problem: String| CliError::Usage(format!("cannot read the standard input: {problem}"));
    read.map_err(|error| fault(error.to_string()))?;
    String::from_utf8(bytes).map_err(|_| fault("it is not UTF-8 text".to_owned()))
}

/// Parses the rows of a matrix from sixteen numbers between any brackets, commas and spaces.
///
/// ```text
/// 1 0 0 2  0 1 0 1/2  0 0 1 -1e3  0 0 0 1
/// [[1,0,0,2],[0,1,0,.5],[0,0,1,-1000],[0,0,0,1]]
/// ```
/// Rows are for column vectors: translation is in the fourth column. Numbers stored column by
/// column, as in OpenGL, are transposed here.
fn parse_matrix(text: &str, columns: bool) -> Result<[[f64; 4]; 4], String> {
    let between = |c: char| c.is_whitespace() || "[](){},;|".contains(c);
    let words = text.split(between).filter(|word| !word.is_empty());
    let numbers: Vec<f64> = words.map(parse_number).collect::<Result<_, _>>()?;
    let listed: [f64; 16] = numbers
        .try_into()
        .map_err(|numbers: Vec<f64>| format!("expected 16 numbers, found {}", numbers.len()))?;
    let at = |row: usize, column: usize| if columns { 4 * column + row } else { 4 * row + column };
    Ok(std::array::from_fn(|row| std::array::from_fn(|column| listed[at(row, column)])))
}

/// Parses a number or a fraction such as `2/3`.
///
/// A division by zero gives an infinite number, which is rejected later with all others that are
/// not finite.
fn parse_number(word: &str) -> Result<f64, String> {
    let fault = || format!("`{word}` is not a number");
    let parse = |digits: &str| digits.parse::<f64>().map_err(|_| fault());
    match word.split_once('/') {
        Some((above, below)) => Ok(parse(above)? / parse(below)?),
        None => parse(word),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_commas_and_fractions_are_accepted() {
        let rows = [
            [1.0, 0.0, 0.0, 2.0],
            [0.0, 1.0, 0.0, 0.5],
            [0.0, 0.0, 1.0, -1e3],
            [0.0, 0.0, 0.0, 1.0],
        ];
        assert_eq!(parse_matrix("1 0 0 2 0 1 0 1/2 0 0 1 -1e3 0 0 0 1", false), Ok(rows));
        assert_eq!(parse_matrix("[[1,0,0,2],[0,1,0,.5],[0,0,1,-1000],[0,0,0,1]]", false), Ok(rows));
        assert_eq!(parse_matrix("(1 0 0 0) (0 1 0 0) (0 0 1 0) (2 0.5 -1000 1)", true), Ok(rows));
        assert_eq!(parse_matrix("1 2 3", false), Err("expected 16 numbers, found 3".to_owned()));
        assert_eq!(parse_matrix("1 x", false), Err("`x` is not a number".to_owned()));
    }
}
