//! The variables of an entry, and the crates' results as values.

use crate::book_formulas::name::Name;
use crate::book_formulas::value::Value;
use glam::{DMat3, DMat4};
use homog::{Affine, HPoint, Homography, Normal, Point, Projective, Space, Vector};
use std::collections::BTreeMap;
use std::error::Error;

pub type Answer = Result<Value, Box<dyn Error>>;

/// The values of a check line for an entry.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    variables: &'a str,
    values: &'a BTreeMap<Name, Value>,
}

impl<'a> Inputs<'a> {
    pub fn new(variables: &'a str, values: &'a BTreeMap<Name, Value>) -> Self {
        Self { variables, values }
    }

    /// Returns the values of all variables of the entry, in order; all must be numbers.
    pub fn numbers<const N: usize>(&self) -> Result<[f64; N], Box<dyn Error>> {
        self.these(self.variables)
    }

    /// Returns the values of the variables with these names, which are separated by spaces.
    pub fn these<const N: usize>(&self, names: &str) -> Result<[f64; N], Box<dyn Error>> {
        let numbers: Vec<f64> =
            names.split_whitespace().map(|name| self.number(name)).collect::<Result<_, _>>()?;
        let count = numbers.len();
        numbers.try_into().map_err(|_| format!("{count} variables, not {N}").into())
    }

    /// Returns the value of a variable, a number. The z-coordinate of a plane also follows from its
    /// distance, and vice versa.
    pub fn number(&self, name: &str) -> Result<f64, String> {
        let key = Name::parse(name).key();
        if let Some(value) = self.values.get(&key) {
            return value.to_number().map_err(|error| format!("`{key}`: {error}"));
        }
        let (twin, sign) = twin_of(name).ok_or_else(|| format!("`{key}` has no value"))?;
        let value = self.values.get(&Name::parse(twin).key());
        Ok(sign * value.ok_or_else(|| format!("`{key}` has no value"))?.to_number()?)
    }

    pub fn matrix(&self, name: &str) -> Result<&'a Value, String> {
        let key = Name::parse(name).key();
        let value = self.values.get(&key).or_else(|| self.values.get(&key.as_bold()));
        value.ok_or_else(|| format!("`{key}` has no value"))
    }

    /// Returns a vector, given by its bold name or by components `p_x p_y p_z` or `x_p y_p z_p`.
    pub fn vector(&self, letter: &str) -> Result<[f64; 3], String> {
        if let Some(value) = self.values.get(&Name::bold(letter)) {
            return value.to_column().map_err(|error| format!("`{letter}`: {error}"));
        }
        let components = components_of(letter).map(|names| names.map(|name| self.number(&name)));
        let found = components.into_iter().find(|names| names.iter().all(Result::is_ok));
        let [x, y, z] = found.ok_or_else(|| format!("the vector `{letter}` has no value"))?;
        Ok([x?, y?, z?])
    }

    /// Returns whether an entry with these variables accepts a value for this name.
    pub fn takes(variables: &str, name: &Name) -> bool {
        variables.split_whitespace().any(|variable| {
            let wanted = Name::parse(variable).key();
            let is_component = || {
                let all = components_of(&wanted.base);
                all.iter().flatten().any(|component| Name::parse(component).key() == *name)
            };
            let twin = twin_of(variable).map(|(twin, _)| Name::parse(twin).key());
            wanted == *name
                || twin.as_ref() == Some(name)
                || (wanted.is_bold && is_component())
                // Matrices may be bold.
                || (wanted.as_bold() == *name && !wanted.is_bold)
        })
    }
}

fn components_of(letter: &str) -> [[String; 3]; 2] {
    [
        ["x", "y", "z"].map(|axis| format!("{letter}_{axis}")),
        ["x", "y", "z"].map(|axis| format!("{axis}_{letter}")),
    ]
}

/// Returns the other name of a variable, and the factor between the two values.
fn twin_of(name: &str) -> Option<(&'static str, f64)> {
    Some(match name {
        "n" => ("N", -1.0),
        "N" => ("n", -1.0),
        "f" => ("F", -1.0),
        "F" => ("f", -1.0),
        "a" => ("aspect", 1.0),
        _ => return None,
    })
}

/// Returns the result for any type that converts to a value.
pub fn give(value: impl Into<Value>) -> Answer {
    Ok(value.into())
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::number(number)
    }
}

impl<const N: usize> From<[f64; N]> for Value {
    fn from(column: [f64; N]) -> Self {
        Self::column(&column)
    }
}

impl From<DMat4> for Value {
    fn from(matrix: DMat4) -> Self {
        Self::matrix(matrix.transpose().to_cols_array_2d())
    }
}

impl From<DMat3> for Value {
    fn from(matrix: DMat3) -> Self {
        Self::matrix(matrix.transpose().to_cols_array_2d())
    }
}

impl<A: Space, B: Space> From<Projective<A, B>> for Value {
    fn from(map: Projective<A, B>) -> Self {
        Self::matrix(map.rows())
    }
}

impl<A: Space, B: Space> From<Affine<A, B>> for Value {
    fn from(map: Affine<A, B>) -> Self {
        Self::matrix(map.rows())
    }
}

impl From<Homography> for Value {
    fn from(map: Homography) -> Self {
        Self::matrix(map.rows())
    }
}

impl<S: Space> From<Point<S>> for Value {
    fn from(point: Point<S>) -> Self {
        <[f64; 3]>::from(point).into()
    }
}

impl<S: Space> From<Vector<S>> for Value {
    fn from(vector: Vector<S>) -> Self {
        <[f64; 3]>::from(vector).into()
    }
}

impl<S: Space> From<Normal<S>> for Value {
    fn from(normal: Normal<S>) -> Self {
        normal.raw().to_array().into()
    }
}

impl<S: Space> From<HPoint<S>> for Value {
    fn from(point: HPoint<S>) -> Self {
        <[f64; 4]>::from(point).into()
    }
}
