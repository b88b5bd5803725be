//! Numbers, columns and matrices as one type.

use std::fmt;

/// A matrix. A number is a 1 × 1 matrix, and a point or vector is a column.
#[derive(Clone, PartialEq, Debug)]
pub struct Value {
    rows: usize,
    columns: usize,
    /// The entries, row by row.
    entries: Vec<f64>,
}

impl Value {
    pub fn number(number: f64) -> Self {
        Self { rows: 1, columns: 1, entries: vec![number] }
    }

    pub fn column(entries: &[f64]) -> Self {
        Self { rows: entries.len(), columns: 1, entries: entries.to_vec() }
    }

    /// Creates a matrix from its rows.
    pub fn matrix<const R: usize, const C: usize>(rows: [[f64; C]; R]) -> Self {
        Self { rows: R, columns: C, entries: rows.concat() }
    }

    pub fn from_rows(rows: &[Vec<f64>]) -> Result<Self, String> {
        let columns = rows.first().map_or(0, Vec::len);
        if columns == 0 || rows.iter().any(|row| row.len() != columns) {
            return Err("the rows of the matrix have different lengths".to_owned());
        }
        Ok(Self { rows: rows.len(), columns, entries: rows.concat() })
    }

    pub fn diagonal(entries: &[f64]) -> Self {
        Self::from_entries(
            entries.len(),
            entries.len(),
            |i, k| {
                if i == k { entries[i] } else { 0.0 }
            },
        )
    }

    fn from_entries(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let places = (0..rows).flat_map(|i| (0..columns).map(move |k| (i, k)));
        Self { rows, columns, entries: places.map(|(i, k)| entry(i, k)).collect() }
    }

    pub fn shape(&self) -> [usize; 2] {
        [self.rows, self.columns]
    }

    pub fn entries(&self) -> &[f64] {
        &self.entries
    }

    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.entries[row * self.columns + column]
    }

    pub fn is_column(&self) -> bool {
        self.columns == 1 && self.rows > 1
    }

    pub fn to_number(&self) -> Result<f64, String> {
        match self.entries[..] {
            [number] => Ok(number),
            _ => Err(format!("expected a number, found {}", self.describe())),
        }
    }

    /// Returns the entries of a column of `N`.
    pub fn to_column<const N: usize>(&self) -> Result<[f64; N], String> {
        let wrong = || format!("expected a column of {N}, found {}", self.describe());
        if self.columns == 1 { self.entries[..].try_into().ok() } else { None }.ok_or_else(wrong)
    }

    /// Returns the rows of an `N` × `N` matrix.
    pub fn to_square<const N: usize>(&self) -> Result<[[f64; N]; N], String> {
        if self.shape() != [N, N] {
            return Err(format!("expected a {N} × {N} matrix, found {}", self.describe()));
        }
        Ok(std::array::from_fn(|i| std::array::from_fn(|k| self.at(i, k))))
    }

    /// Describes the shape in words.
    pub fn describe(&self) -> String {
        match self.shape() {
            [1, 1] => "a number".to_owned(),
            [n, 1] => format!("a column of {n}"),
            [1, n] => format!("a row of {n}"),
            [n, m] => format!("a {n} × {m} matrix"),
        }
    }

    pub fn map(&self, each: impl Fn(f64) -> f64) -> Self {
        Self { entries: self.entries.iter().map(|&entry| each(entry)).collect(), ..*self }
    }

    pub fn plus(&self, other: &Self) -> Result<Self, String> {
        if self.shape() != other.shape() {
            return Err(format!("{} plus {}", self.describe(), other.describe()));
        }
        Ok(Self::from_entries(self.rows, self.columns, |i, k| self.at(i, k) + other.at(i, k)))
    }

    pub fn minus(&self, other: &Self) -> Result<Self, String> {
        self.plus(&other.map(|entry| -entry))
    }

    /// Returns the matrix product. A number multiplies each entry.
    pub fn times(&self, other: &Self) -> Result<Self, String> {
        match (self.to_number(), other.to_number()) {
            (Ok(number), _) => Ok(other.map(|entry| number * entry)),
            (_, Ok(number)) => Ok(self.map(|entry| entry * number)),
            _ if self.columns == other.rows => {
                Ok(Self::from_entries(self.rows, other.columns, |i, k| {
                    (0..self.columns).map(|j| self.at(i, j) * other.at(j, k)).sum()
                }))
            }
            _ => Err(format!("{} times {}", self.describe(), other.describe())),
        }
    }

    /// Evaluates `\cdot`: the dot product of two columns, or the plain product of other values.
    pub fn dot(&self, other: &Self) -> Result<Self, String> {
        if self.is_column() && other.is_column() {
            return self.transpose().times(other);
        }
        self.times(other)
    }

    /// Evaluates `\times`: the cross product of two columns, or the plain product of other values.
    pub fn cross(&self, other: &Self) -> Result<Self, String> {
        if !self.is_column() || !other.is_column() {
            return self.times(other);
        }
        let ([a, b, c], [d, e, f]) = (self.to_column()?, other.to_column()?);
        Ok(Self::column(&[b * f - c * e, c * d - a * f, a * e - b * d]))
    }

    pub fn divided_by(&self, other: &Self) -> Result<Self, String> {
        let number = other.to_number()?;
        if number == 0.0 {
            return Err("division by zero".to_owned());
        }
        Ok(self.map(|entry| entry / number))
    }

    pub fn transpose(&self) -> Self {
        Self::from_entries(self.columns, self.rows, |i, k| self.at(k, i))
    }

    /// Returns the length of a column or the absolute value of a number.
    pub fn length(&self) -> Result<Self, String> {
        if self.columns != 1 {
            return Err(format!("{} has no length", self.describe()));
        }
        if let [number] = self.entries[..] {
            return Ok(Self::number(number.abs()));
        }
        Ok(Self::number(self.entries.iter().map(|entry| entry * entry).sum::<f64>().sqrt()))
    }

    pub fn determinant(&self) -> Result<Self, String> {
        Ok(Self::number(self.clone().eliminate()?.0))
    }

    pub fn inverse(&self) -> Result<Self, String> {
        if let Ok(number) = self.to_number() {
            return Self::number(1.0).divided_by(&Self::number(number));
        }
        match self.clone().eliminate()? {
            (_, Some(inverse)) => Ok(inverse),
            (_, None) => Err("the matrix has no inverse".to_owned()),
        }
    }

    /// Computes the determinant and, if that is not 0, the inverse by Gauss–Jordan elimination with
    /// partial pivoting.
    fn eliminate(mut self) -> Result<(f64, Option<Self>), String> {
        if self.rows != self.columns {
            return Err(format!("{} is not square", self.describe()));
        }
        let mut inverse = Self::diagonal(&vec![1.0; self.rows]);
        let mut determinant = 1.0;
        for k in 0..self.rows {
            let pivot = (k..self.rows)
                .max_by(|&i, &j| self.at(i, k).abs().total_cmp(&self.at(j, k).abs()))
                .filter(|&i| self.at(i, k) != 0.0);
            let Some(pivot) = pivot else { return Ok((0.0, None)) };
            if pivot != k {
                self.swap_rows(k, pivot);
                inverse.swap_rows(k, pivot);
                determinant = -determinant;
            }
            determinant *= self.at(k, k);
            let divisor = self.at(k, k);
            self.divide_row(k, divisor);
            inverse.divide_row(k, divisor);
            for i in (0..self.rows).filter(|&i| i != k) {
                let factor = -self.at(i, k);
                self.add_row(i, k, factor);
                inverse.add_row(i, k, factor);
            }
        }
        Ok((determinant, Some(inverse)))
    }

    fn swap_rows(&mut self, a: usize, b: usize) {
        for k in 0..self.columns {
            self.entries.swap(a * self.columns + k, b * self.columns + k);
        }
    }

    fn divide_row(&mut self, row: usize, divisor: f64) {
        let start = row * self.columns;
        for entry in &mut self.entries[start..start + self.columns] {
            *entry /= divisor;
        }
    }

    fn add_row(&mut self, to: usize, from: usize, factor: f64) {
        for k in 0..self.columns {
            let addend = factor * self.at(from, k);
            self.entries[to * self.columns + k] += addend;
        }
    }

    /// Joins two blocks side by side.
    pub fn beside(&self, right: &Self) -> Result<Self, String> {
        Ok(self.transpose().above(&right.transpose())?.transpose())
    }

    /// Joins two blocks, the first above the second.
    pub fn above(&self, below: &Self) -> Result<Self, String> {
        if self.columns != below.columns {
            return Err(format!(
                "{} cannot be above {} in a matrix",
                self.describe(),
                below.describe()
            ));
        }
        let entries = [&self.entries[..], &below.entries[..]].concat();
        Ok(Self { rows: self.rows + below.rows, columns: self.columns, entries })
    }

    /// Returns whether all entries are finite.
    pub fn is_finite(&self) -> bool {
        self.entries.iter().all(|entry| entry.is_finite())
    }

    /// Returns whether the shapes are the same and no entry differs by more than `relative` times
    /// the largest expected entry.
    pub fn is_close(&self, expected: &Self, relative: f64) -> bool {
        let largest = expected.entries.iter().fold(0.0, |most: f64, entry| most.max(entry.abs()));
        let limit = relative * if largest > 0.0 { largest } else { 1.0 };
        let mut pairs = self.entries.iter().zip(&expected.entries);
        self.shape() == expected.shape() && pairs.all(|(a, b)| (a - b).abs() <= limit)
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let [number] = self.entries[..] {
            return write!(f, "{number}");
        }
        let rows = self
            .entries
            .chunks(self.columns)
            .map(|row| row.iter().map(f64::to_string).collect::<Vec<_>>().join(" "));
        write!(f, "[{}]", rows.collect::<Vec<_>>().join("; "))
    }
}

#[cfg(test)]
mod tests {
    use super::Value;

    #[test]
    fn the_inverse_and_determinant_use_pivots() {
        let matrix = Value::matrix([[0.0, 2.0, 1.0], [4.0, 0.0, 0.0], [0.0, 3.0, 2.0]]);
        assert!((matrix.determinant().unwrap().to_number().unwrap() + 4.0).abs() < 1e-15);
        let product = matrix.times(&matrix.inverse().unwrap()).unwrap();
        assert!(product.is_close(&Value::diagonal(&[1.0; 3]), 1e-15), "{product}");
        assert!(Value::matrix([[1.0, 2.0], [2.0, 4.0]]).inverse().is_err());
    }

    #[test]
    fn mismatched_shapes_are_errors() {
        let (column, matrix) = (Value::column(&[1.0, 2.0, 3.0]), Value::diagonal(&[1.0; 4]));
        assert!(matrix.times(&column).is_err());
        assert!(column.times(&column).is_err());
        assert!(column.plus(&Value::number(1.0)).is_err());
        assert!(!column.is_close(&column.transpose(), 1.0));
        assert_eq!(column.dot(&column).unwrap(), Value::number(14.0));
    }

    #[test]
    fn blocks_form_a_matrix() {
        let top = Value::diagonal(&[2.0, 3.0]).beside(&Value::column(&[4.0, 5.0])).unwrap();
        let all = top.above(&Value::matrix([[0.0, 0.0, 1.0]])).unwrap();
        assert_eq!(all, Value::matrix([[2.0, 0.0, 4.0], [0.0, 3.0, 5.0], [0.0, 0.0, 1.0]]));
    }
}
