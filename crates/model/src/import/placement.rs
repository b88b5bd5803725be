//! The transforms of nodes, in the double precision that JSON has.

use super::error::Fault;
use super::warnings::Warnings;
use crate::Parts;
use glam::{DMat4, DVec4};
use homog::{Affine, Model};
use serde_json::{Map, Value};

/// A node's own transform, as the file gives it; every number is finite.
#[derive(Clone, Debug)]
pub(super) enum Placement {
    /// A matrix, column by column.
    Matrix([f64; 16]),
    /// Scale, then rotate, then move.
    Parts(Parts),
}

impl Placement {
    /// Takes the transforms out of the nodes of a document.
    pub(super) fn take_all(
        document: &mut Value,
        warnings: &mut Warnings,
    ) -> Result<Vec<Self>, Fault> {
        let nodes = document.get_mut("nodes").and_then(Value::as_array_mut);
        let take = |(at, node): (usize, &mut Value)| match node.as_object_mut() {
            Some(node) => Self::take(node, at),
            None => Err(Fault::invalid(&format!("/nodes/{at}"), "an object is due")),
        };
        let forgiving = |taken: Result<Self, Fault>| match taken {
            Err(fault) => warnings
                .forgive(fault, "the node stays where its parent is")
                .map(|()| Self::Parts(Parts::default())),
            taken => taken,
        };
        nodes.into_iter().flatten().enumerate().map(take).map(forgiving).collect()
    }

    fn take(node: &mut Map<String, Value>, at: usize) -> Result<Self, Fault> {
        let matrix = numbers(node, at, "matrix")?;
        let translation = numbers(node, at, "translation")?;
        let rotation = numbers(node, at, "rotation")?;
        let scale = numbers(node, at, "scale")?;
        Ok(match matrix {
            Some(matrix) => Self::Matrix(matrix),
            None => Self::Parts(Parts {
                translation: translation.unwrap_or(Parts::default().translation),
                rotation: rotation.unwrap_or(Parts::default().rotation),
                scale: scale.unwrap_or(Parts::default().scale),
            }),
        })
    }

    /// The parts, if it is given in parts.
    pub(super) fn parts(&self) -> Option<Parts> {
        match self {
            Self::Matrix(_) => None,
            Self::Parts(parts) => Some(*parts),
        }
    }

    /// The transform as a map, or why there is none.
    pub(super) fn to_parent(&self, pointer: &str) -> Result<Affine<Model, Model>, Fault> {
        match self {
            Self::Matrix(columns) => affine(columns).ok_or_else(|| {
                let row = [3, 7, 11, 15].map(|at| columns[at]);
                let problem = format!("the last row of the matrix is {row:?} and not [0, 0, 0, 1]");
                Fault::invalid(&format!("{pointer}/matrix"), problem)
            }),
            Self::Parts(parts) => parts.to_parent().ok_or_else(|| {
                let problem = format!("{:?} is not a rotation", parts.rotation);
                Fault::invalid(&format!("{pointer}/rotation"), problem)
            }),
        }
    }
}

/// A matrix of 16 numbers, column by column, as an affine map; `None` if its last row is clearly not (0, 0, 0, 1).
/// Exporters that invert a matrix in single precision leave a last row that is so but for rounding.
pub(super) fn affine(columns: &[f64; 16]) -> Option<Affine<Model, Model>> {
    let mut matrix = DMat4::from_cols_array(columns);
    let off = (matrix.row(3) - DVec4::W).abs().max_element();
    for axis in 0..4 {
        matrix.col_mut(axis).w = if axis == 3 { 1.0 } else { 0.0 };
    }
    Affine::from_raw(matrix).filter(|map| off < 1e-3 && map.is_finite())
}

/// Takes the member `key` of a node, an array of `N` numbers.
fn numbers<const N: usize>(
    node: &mut Map<String, Value>,
    at: usize,
    key: &str,
) -> Result<Option<[f64; N]>, Fault> {
    let Some(value) = node.remove(key) else { return Ok(None) };
    let numbers: Option<Vec<f64>> =
        value.as_array().and_then(|items| items.iter().map(Value::as_f64).collect());
    match numbers.and_then(|numbers| <[f64; N]>::try_from(numbers).ok()) {
        Some(numbers) => Ok(Some(numbers)),
        None => Err(Fault::invalid(&format!("/nodes/{at}/{key}"), format!("{N} numbers are due"))),
    }
}
