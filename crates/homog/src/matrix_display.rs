//! Readable matrices: aligned columns, and fractions where they are exact.
//!
//! ```text
//! [ 2    0   -1 ]        not   DMat3 { x_axis: DVec3(2.0, 0.0, 0.0), y_axis: DVec3(0.0, 3.0,
//! [ 0    3    0 ]              0.6666666666666666), z_axis: DVec3(-1.0, 0.0, 0.3333333333333333) }
//! [ 0  2/3  1/3 ]
//! ```
//!
//! A number with at most three decimal places is written unchanged. Otherwise it becomes a fraction
//! p/q with q < 1000 if the quotient is exactly this f64, as for 2/3 but not for π. All other
//! numbers are rounded to six digits. A precision, as in `{:.4}`, writes every number with that
//! many decimals.

use crate::{Affine, Homography, Projective, Space};
use core::fmt::{self, Write};

/// A matrix formatted for display, returned by the `display` method of each map type.
#[derive(Clone, Copy, Debug)]
pub struct MatrixDisplay<const N: usize> {
    rows: [[f64; N]; N],
}

impl<const N: usize> MatrixDisplay<N> {
    /// Creates the display of a matrix from its rows.
    #[must_use]
    pub const fn from_rows(rows: [[f64; N]; N]) -> Self {
        Self { rows }
    }
}

impl<A: Space, B: Space> Projective<A, B> {
    /// Returns this matrix in readable form.
    #[must_use]
    pub fn display(self) -> MatrixDisplay<4> {
        MatrixDisplay::from_rows(self.rows())
    }
}

impl<A: Space, B: Space> Affine<A, B> {
    /// Returns this matrix in readable form.
    #[must_use]
    pub fn display(self) -> MatrixDisplay<4> {
        MatrixDisplay::from_rows(self.rows())
    }
}

impl Homography {
    /// Returns this matrix in readable form.
    ///
    /// ```
    /// use homog::Homography;
    /// let w = [0.0, 2.0 / 3.0, 1.0 / 3.0];
    /// let map = Homography::from_rows([[2.0, 0.0, -1.0], [0.0, 3.0, 0.0], w]);
    /// assert_eq!(map.display().to_string(), "\
    /// [ 2    0   -1 ]
    /// [ 0    3    0 ]
    /// [ 0  2/3  1/3 ]");
    /// ```
    #[must_use]
    pub fn display(self) -> MatrixDisplay<3> {
        MatrixDisplay::from_rows(self.rows())
    }
}

impl<const N: usize> fmt::Display for MatrixDisplay<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cells =
            self.rows.map(|row| row.map(|entry| MatrixCell::format_entry(entry, f.precision())));
        let widths: [usize; N] =
            core::array::from_fn(|j| cells.iter().map(|row| row[j].length).max().unwrap_or(0));
        for (i, row) in cells.iter().enumerate() {
            f.write_str(if i == 0 { "[ " } else { "\n[ " })?;
            for (j, cell) in row.iter().enumerate() {
                let gap = if j == 0 { "" } else { "  " };
                write!(f, "{gap}{:>width$}", cell.as_str(), width = widths[j])?;
            }
            f.write_str(" ]")?;
        }
        Ok(())
    }
}

/// The text of one entry, in a fixed buffer that needs no allocator. Longer text is truncated.
#[derive(Clone, Copy)]
struct MatrixCell {
    bytes: [u8; 40],
    length: usize,
}

impl MatrixCell {
    fn format_entry(entry: f64, decimals: Option<usize>) -> Self {
        let mut cell = Self { bytes: [0; 40], length: 0 };
        // Writing fails when the cell is full; the cell then shows the part that fits.
        let _ = match decimals {
            Some(decimals) => write!(cell, "{:.decimals$}", entry + 0.0),
            None => cell.write_number(entry + 0.0),
        };
        cell
    }

    fn write_number(&mut self, x: f64) -> fmt::Result {
        let size = x.abs();
        if !x.is_finite() || has_three_decimals(x) {
            return write!(self, "{x}");
        }
        if let Some((p, q)) = simple_fraction(x) {
            return write!(self, "{p}/{q}");
        }
        if !(1e-4..1e6).contains(&size) {
            return write!(self, "{x:.5e}");
        }
        let decimals = usize::try_from(5 - libm::floor(libm::log10(size)) as i32).unwrap_or(0);
        write!(self, "{x:.decimals$}")
    }

    fn as_str(&self) -> &str {
        core::str::from_utf8(&self.bytes[..self.length]).unwrap_or_default()
    }
}

impl Write for MatrixCell {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let room = self.bytes.get_mut(self.length..self.length + text.len()).ok_or(fmt::Error)?;
        room.copy_from_slice(text.as_bytes());
        self.length += text.len();
        Ok(())
    }
}

/// Returns whether x is exactly the f64 nearest to a number with at most three decimal places.
fn has_three_decimals(x: f64) -> bool {
    let thousandths = libm::round(x * 1000.0);
    x.abs() < 1e9 && thousandths / 1000.0 == x
}

/// Returns the fraction p/q with the smallest q whose value, rounded to f64, is exactly `x`.
fn simple_fraction(x: f64) -> Option<(i64, i64)> {
    if x.abs() >= 1e6 {
        return None;
    }
    (2..1000_i64).find_map(|q| {
        let p = libm::round(x * q as f64);
        (p != 0.0 && p / q as f64 == x).then_some((p as i64, q))
    })
}

#[cfg(test)]
mod tests {
    extern crate alloc;
    use super::*;
    use crate::{Clip, View};
    use alloc::{format, string::ToString};

    fn number(x: f64) -> alloc::string::String {
        MatrixCell::format_entry(x, None).as_str().to_string()
    }

    #[test]
    fn numbers_are_exact_or_rounded_to_six_digits() {
        for (x, want) in [
            (0.0, "0"),
            (-0.0, "0"),
            (319.5, "319.5"),
            (0.125, "0.125"),
            (2.0 / 3.0, "2/3"),
            (-320.0 / 3.0, "-320/3"),
            (1.0 / 7.0, "1/7"),
            (1.0 / 1024.0, "0.000976562"),
            (core::f64::consts::PI, "3.14159"),
            (-1234.567891, "-1234.57"),
            (1e-20, "1.00000e-20"),
            (123e30, "1.23000e32"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(number(x), want);
        }
    }

    #[test]
    fn columns_are_aligned() {
        let rows = [
            [-1.0, 0.0, -0.5, 0.0],
            [0.0, -4.0 / 3.0, 1.0 / 3.0, 0.0],
            [0.0, 0.0, 2.0, 6.0],
            [0.0, 0.0, 1.0, 0.0],
        ];
        let map = Projective::<View, Clip>::from_rows(rows);
        let lines = "\
[ -1     0  -0.5  0 ]
[  0  -4/3   1/3  0 ]
[  0     0     2  6 ]
[  0     0     1  0 ]";
        assert_eq!(map.display().to_string(), lines);
        let fixed = format!("{:.2}", map.display());
        assert_eq!(fixed.lines().nth(1), Some("[  0.00  -1.33   0.33  0.00 ]"));
        let huge = format!("{:.300}", map.display());
        assert_eq!(huge.lines().count(), 4, "entries are truncated, but rows are not lost");
    }
}
