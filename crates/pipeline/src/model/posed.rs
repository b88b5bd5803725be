//! The rest pose: where the vertices of a mesh are in the model, with the bending of a skin applied.
//!
//! A skinned vertex does not follow the node that carries its mesh but the joints of the skin (glTF 2.0 §3.7.3.3):
//!
//! ```text
//!  v' = Σ wᵢ · (inverse_bindᵢ, then jointᵢ's place in the model) v
//! ```
//!
//! Sums and products in f64 and in the order of the file.

use super::{Instance, Model, Primitive, Skin};
use glam::{DMat3, DMat4, DVec3};
use homog::{Affine, Model as ModelSpace};
use std::borrow::Cow;

/// The vertices of a primitive, ready to be placed.
#[derive(Clone, Debug)]
pub struct Posed<'a> {
    /// Positions, one for each vertex, finite.
    pub positions: Cow<'a, [[f32; 3]]>,
    /// Unit normals, if the primitive has normals.
    pub normals: Option<Cow<'a, [[f32; 3]]>>,
    /// From these positions to the model.
    pub to_model: Affine<ModelSpace, ModelSpace>,
}

impl Model {
    /// A primitive of an instance's mesh at rest: the arrays as they are and the node's place for a rigid one; for a
    /// skinned one the bent arrays in the model's coordinates and the identity.
    #[must_use]
    pub fn posed<'a>(&self, instance: Instance, primitive: &'a Primitive) -> Posed<'a> {
        let skin = self.nodes.get(instance.node).and_then(|node| self.skins.get(node.skin?));
        match (skin, &primitive.joints, &primitive.weights) {
            (Some(skin), Some(joints), Some(weights)) => {
                let bones = self.bones(skin);
                let rigid = instance.node_to_model.raw();
                let vertices: Vec<DMat4> = joints
                    .iter()
                    .zip(weights)
                    .map(|(joints, weights)| blend(&bones, joints, weights).unwrap_or(rigid))
                    .collect();
                bent(primitive, &vertices)
            }
            _ => Posed {
                positions: Cow::Borrowed(&primitive.positions),
                normals: primitive.normals.as_deref().map(Cow::Borrowed),
                to_model: instance.node_to_model,
            },
        }
    }

    /// For each joint of a skin the map from the mesh to the model.
    fn bones(&self, skin: &Skin) -> Vec<DMat4> {
        let bone = |(&joint, bind): (&usize, &Affine<ModelSpace, ModelSpace>)| {
            self.nodes.get(joint).map_or(DMat4::IDENTITY, |node| bind.then(node.to_model).raw())
        };
        skin.joints.iter().zip(&skin.inverse_bind).map(bone).collect()
    }
}

/// The weighted mean of the maps of a vertex's joints; `None` if it has no weight.
fn blend(bones: &[DMat4], joints: &[u16; 4], weights: &[f32; 4]) -> Option<DMat4> {
    let (mut sum, mut total) = (DMat4::ZERO, 0.0);
    for (&joint, &weight) in joints.iter().zip(weights) {
        if let Some(bone) = bones.get(usize::from(joint)).filter(|_| weight > 0.0) {
            sum += *bone * f64::from(weight);
            total += f64::from(weight);
        }
    }
    let mean = sum * (1.0 / total);
    (total > 0.0 && mean.is_finite()).then_some(mean)
}

fn bent<'a>(primitive: &'a Primitive, vertices: &[DMat4]) -> Posed<'a> {
    let wide = |v: &[f32; 3]| DVec3::from(v.map(f64::from));
    let narrow = |v: DVec3| v.to_array().map(|x| x.clamp(-FARTHEST, FARTHEST) as f32);
    let place = |(m, p): (&DMat4, &[f32; 3])| narrow(m.transform_point3(wide(p)));
    let turn =
        |(m, n): (&DMat4, &[f32; 3])| narrow(cofactors(m).mul_vec3(wide(n)).normalize_or(DVec3::Z));
    let positions = vertices.iter().zip(&primitive.positions).map(place).collect();
    let normals =
        primitive.normals.as_ref().map(|normals| vertices.iter().zip(normals).map(turn).collect());
    Posed { positions, normals, to_model: Affine::IDENTITY }
}

/// Products of large numbers stay numbers.
const FARTHEST: f64 = f32::MAX as f64;

/// The matrix that maps normals: the inverse transposed, but for a positive factor.
fn cofactors(m: &DMat4) -> DMat3 {
    let (x, y, z) = (m.x_axis.truncate(), m.y_axis.truncate(), m.z_axis.truncate());
    let mirror = if x.dot(y.cross(z)) < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * mirror
}
