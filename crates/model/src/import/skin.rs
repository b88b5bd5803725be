//! Skins: joints and the matrices that go with them. One that is wrong is left out with a warning.

use super::accessor::Source;
use super::error::Fault;
use super::placement::affine;
use super::warnings::Warnings;
use crate::Skin;
use gltf::json::accessor::{ComponentType, Type};
use homog::Affine;

/// Reads all skins of a file.
pub(super) fn skins(source: &Source<'_>, warnings: &mut Warnings) -> Result<Vec<Skin>, Fault> {
    let mut skins = Vec::with_capacity(source.root.skins.len());
    for at in 0..source.root.skins.len() {
        match skin(source, at) {
            Err(fault) if fault.is_soft() => {
                warnings.soft(&fault, "the skin is left out");
                skins.push(Skin { joints: Vec::new(), inverse_bind: Vec::new() });
            }
            skin => skins.push(skin?),
        }
    }
    Ok(skins)
}

fn skin(source: &Source<'_>, at: usize) -> Result<Skin, Fault> {
    let json = &source.root.skins[at];
    let count = source.root.nodes.len();
    let joints: Vec<usize> = json.joints.iter().map(gltf::json::Index::value).collect();
    if let Some(place) = joints.iter().position(|&joint| joint >= count) {
        let pointer = format!("/skins/{at}/joints/{place}");
        return Err(Fault::unresolved(&pointer, "node", joints[place], count));
    }
    if joints.is_empty() {
        return Err(Fault::invalid(&format!("/skins/{at}/joints"), "there are no joints"));
    }
    let Some(accessor) = json.inverse_bind_matrices else {
        return Ok(Skin { inverse_bind: vec![Affine::IDENTITY; joints.len()], joints });
    };
    let pointer = format!("/skins/{at}/inverseBindMatrices");
    let elements = source.elements(accessor.value(), &pointer)?;
    if (elements.shape, elements.component) != (Type::Mat4, ComponentType::F32) {
        return Err(Fault::invalid(&pointer, "the matrices must be MAT4 of floats"));
    }
    if elements.count < joints.len() {
        let problem = format!("{} matrices for {} joints", elements.count, joints.len());
        return Err(Fault::invalid(&pointer, problem));
    }
    let matrices = source.floats::<16>(&elements.only(0..joints.len()))?;
    let inverse_bind: Option<Vec<_>> = matrices.iter().map(|m| affine(&m.map(f64::from))).collect();
    match inverse_bind {
        Some(inverse_bind) => Ok(Skin { joints, inverse_bind }),
        None => Err(Fault::invalid(&pointer, "the last row of a matrix is not 0, 0, 0, 1")),
    }
}
