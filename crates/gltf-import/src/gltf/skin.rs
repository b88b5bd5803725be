//! Skins: joints and inverse bind matrices. Invalid skins are skipped with a warning.
//!
//! A skin needs at least one joint, every joint must be a node, and any matrices must suffice for
//! all joints. The `skeleton` member is ignored, because it does not affect the joint matrices.

use super::accessor::AccessorReader;
use super::node_transform::affine_from_columns;
use crate::warnings::ImportWarnings;
use gltf::json::accessor::{ComponentType, Type};
use homog::Affine;
use model::{Diagnostic, Skin};

/// Reads all skins of a file.
///
/// An invalid skin remains in the list without joints, so that indices stay valid. References from
/// nodes to it are cleared later.
pub(super) fn import_skins(
    source: &AccessorReader<'_>,
    warnings: &mut ImportWarnings,
) -> Result<Vec<Skin>, Diagnostic> {
    let mut skins = Vec::with_capacity(source.root.skins.len());
    for at in 0..source.root.skins.len() {
        match read_skin(source, at) {
            Err(diagnostic) if diagnostic.is_downgradable() => {
                warnings.downgrade(&diagnostic, "the skin is skipped");
                skins.push(Skin { joints: Vec::new(), inverse_bind_matrices: Vec::new() });
            }
            skin => skins.push(skin?),
        }
    }
    Ok(skins)
}

/// Reads and checks one skin. Absent matrices are identities (glTF 2.0 §3.7.3.1).
///
/// Extra matrices, beyond the number of joints, are ignored.
///
/// # Errors
/// Fails if there are no joints, a joint does not exist, or the inverse bind matrices are too few,
/// not affine, or in the wrong format.
fn read_skin(source: &AccessorReader<'_>, at: usize) -> Result<Skin, Diagnostic> {
    let json = &source.root.skins[at];
    let count = source.root.nodes.len();
    let joints: Vec<usize> = json.joints.iter().map(gltf::json::Index::value).collect();
    if let Some(slot) = joints.iter().position(|&joint| joint >= count) {
        let pointer = format!("/skins/{at}/joints/{slot}");
        return Err(Diagnostic::unresolved_index(&pointer, "node", joints[slot], count));
    }
    if joints.is_empty() {
        return Err(Diagnostic::invalid(&format!("/skins/{at}/joints"), "the skin has no joints"));
    }
    let Some(accessor) = json.inverse_bind_matrices else {
        return Ok(Skin { inverse_bind_matrices: vec![Affine::IDENTITY; joints.len()], joints });
    };
    let pointer = format!("/skins/{at}/inverseBindMatrices");
    let elements = source.resolve_accessor(accessor.value(), &pointer)?;
    if (elements.element_type, elements.component_type) != (Type::Mat4, ComponentType::F32) {
        return Err(Diagnostic::invalid(&pointer, "the matrices must be floats of type MAT4"));
    }
    if elements.count < joints.len() {
        let message =
            format!("there are fewer matrices ({}) than joints ({})", elements.count, joints.len());
        return Err(Diagnostic::invalid(&pointer, message));
    }
    let matrices = source.read_floats::<16>(&elements.slice_range(0..joints.len()))?;
    let inverse_bind: Option<Vec<_>> =
        matrices.iter().map(|m| affine_from_columns(&m.map(f64::from))).collect();
    match inverse_bind {
        Some(inverse_bind) => Ok(Skin { joints, inverse_bind_matrices: inverse_bind }),
        None => Err(Diagnostic::invalid(&pointer, "the last row of a matrix is not 0, 0, 0, 1")),
    }
}
