//! Node transforms, in the double precision of JSON numbers.
//!
//! The `gltf` crate stores transforms in single precision, which would cause errors of millimeters
//! in models far from the origin, as is common in CAD and map data. So the transforms are removed
//! from the JSON before it is deserialized.

use crate::warnings::ImportWarnings;
use glam::{DMat4, DVec4};
use homog::{Affine, Model};
use model::{Diagnostic, Trs};
use serde_json::{Map, Value};

/// A node's local transform as stored in the file. All numbers are finite.
///
/// A matrix takes precedence over translation, rotation and scale in files that have both.
#[derive(Clone, Debug)]
pub(super) enum NodeTransform {
    /// A matrix in column-major order.
    Matrix([f64; 16]),
    /// Translation, rotation and scale.
    Trs(Trs),
}

impl NodeTransform {
    /// Removes the transforms from the nodes of a document and returns them.
    ///
    /// The result has one entry per node, in order.
    ///
    /// # Errors
    /// Fails if a transform is not an array of the right length. In lenient mode, it becomes the
    /// identity.
    pub(super) fn take_transforms(
        document: &mut Value,
        warnings: &mut ImportWarnings,
    ) -> Result<Vec<Self>, Diagnostic> {
        let nodes = document.get_mut("nodes").and_then(Value::as_array_mut);
        let take = |(node_index, node): (usize, &mut Value)| match node.as_object_mut() {
            Some(node) => Self::take_transform(node, node_index),
            None => Err(Diagnostic::invalid(&format!("/nodes/{node_index}"), "expected an object")),
        };
        let downgrade = |taken: Result<Self, Diagnostic>| match taken {
            Err(diagnostic) => warnings
                .downgrade_if_lenient(diagnostic, "the transform is ignored")
                .map(|()| Self::Trs(Trs::default())),
            taken => taken,
        };
        nodes.into_iter().flatten().enumerate().map(take).map(downgrade).collect()
    }

    /// Removes the transform from a node.
    ///
    /// # Errors
    /// Fails if a member is present but is not an array of the right length.
    fn take_transform(
        node: &mut Map<String, Value>,
        node_index: usize,
    ) -> Result<Self, Diagnostic> {
        let matrix = take_numbers(node, node_index, "matrix")?;
        let translation = take_numbers(node, node_index, "translation")?;
        let rotation = take_numbers(node, node_index, "rotation")?;
        let scale = take_numbers(node, node_index, "scale")?;
        Ok(match matrix {
            Some(matrix) => Self::Matrix(matrix),
            None => Self::Trs(Trs {
                translation: translation.unwrap_or(Trs::default().translation),
                rotation: rotation.unwrap_or(Trs::default().rotation),
                scale: scale.unwrap_or(Trs::default().scale),
            }),
        })
    }

    /// Returns the transform as TRS, or `None` for a matrix.
    pub(super) fn to_trs(&self) -> Option<Trs> {
        match self {
            Self::Matrix(_) => None,
            Self::Trs(trs) => Some(*trs),
        }
    }

    /// Returns the transform as an affine map.
    ///
    /// # Errors
    /// Fails if the matrix is not affine, or the rotation is a quaternion of length 0.
    pub(super) fn to_affine(&self, pointer: &str) -> Result<Affine<Model, Model>, Diagnostic> {
        match self {
            Self::Matrix(columns) => affine_from_columns(columns).ok_or_else(|| {
                let row = [3, 7, 11, 15].map(|node_index| columns[node_index]);
                let message = format!("the last row of the matrix is {row:?}, not [0, 0, 0, 1]");
                Diagnostic::invalid(&format!("{pointer}/matrix"), message)
            }),
            Self::Trs(trs) => trs.to_affine().ok_or_else(|| {
                let message = format!("{:?} is not a rotation", trs.rotation);
                Diagnostic::invalid(&format!("{pointer}/rotation"), message)
            }),
        }
    }
}

/// Converts a column-major matrix to an affine map. Returns `None` if its last row is clearly not
/// (0, 0, 0, 1).
///
/// Exporters that invert a matrix in single precision leave rounding errors in the last row. A
/// deviation of up to 0.001 is accepted and corrected, because later products rely on an exact last
/// row.
pub(super) fn affine_from_columns(columns: &[f64; 16]) -> Option<Affine<Model, Model>> {
    let mut matrix = DMat4::from_cols_array(columns);
    let deviation = (matrix.row(3) - DVec4::W).abs().max_element();
    for axis in 0..4 {
        matrix.col_mut(axis).w = if axis == 3 { 1.0 } else { 0.0 };
    }
    Affine::from_raw(matrix).filter(|map| deviation < 1e-3 && map.is_finite())
}

/// Removes the member `key` of a node, an array of `N` numbers.
fn take_numbers<const N: usize>(
    node: &mut Map<String, Value>,
    node_index: usize,
    key: &str,
) -> Result<Option<[f64; N]>, Diagnostic> {
    let Some(value) = node.remove(key) else { return Ok(None) };
    let numbers: Option<Vec<f64>> =
        value.as_array().and_then(|items| items.iter().map(Value::as_f64).collect());
    match numbers.and_then(|numbers| <[f64; N]>::try_from(numbers).ok()) {
        Some(numbers) => Ok(Some(numbers)),
        None => Err(Diagnostic::invalid(
            &format!("/nodes/{node_index}/{key}"),
            format!("expected {N} numbers"),
        )),
    }
}
