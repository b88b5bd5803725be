//! The pose: where the vertices of a mesh are in the model, with morph targets added and the bending of a skin applied.
//!
//! Weights of the morph targets come first, in the mesh's coordinates (glTF 2.0 §3.7.2.2):
//!
//! ```text
//!  v' = v + Σ wᵢ · differenceᵢ
//! ```
//!
//! A skinned vertex then does not follow the node that carries its mesh but the joints of the skin (§3.7.3.3):
//!
//! ```text
//!  v" = Σ wᵢ · (inverse_bindᵢ, then jointᵢ's place in the model) v'
//! ```
//!
//! Sums and products in f64 and in the order of the file.

use super::{Instance, Model, MorphTarget, Primitive, Skin};
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
    /// A primitive of an instance's mesh as its nodes stand. Without weights and skin the arrays are as they are, and
    /// `to_model` is the node's place; with a skin they are in the model's coordinates, and `to_model` is the identity.
    #[must_use]
    pub fn posed<'a>(&self, instance: Instance, primitive: &'a Primitive) -> Posed<'a> {
        let morphed = Posed {
            to_model: instance.node_to_model,
            ..morphed(primitive, self.morph_weights(instance.node))
        };
        let skin = self.nodes.get(instance.node).and_then(|node| self.skins.get(node.skin?));
        match (skin, &primitive.joints, &primitive.weights) {
            (Some(skin), Some(joints), Some(weights)) => {
                let (bones, rigid) = (self.bones(skin), instance.node_to_model.raw());
                let vertices = joints.iter().zip(weights);
                let map = |(j, w): (&_, &_)| blend(&bones, *j, *w).unwrap_or(rigid);
                bent(&morphed, &vertices.map(map).collect::<Vec<_>>())
            }
            _ => morphed,
        }
    }

    /// How much of each morph target a node shows.
    fn morph_weights(&self, node: usize) -> &[f32] {
        let Some(node) = self.nodes.get(node) else { return &[] };
        let mesh = node.mesh.and_then(|mesh| self.meshes.get(mesh));
        node.weights.as_deref().or(mesh.map(|mesh| &*mesh.weights)).unwrap_or(&[])
    }

    /// For each joint of a skin the map from the mesh to the model.
    fn bones(&self, skin: &Skin) -> Vec<DMat4> {
        let bone = |(&joint, bind): (&usize, &Affine<ModelSpace, ModelSpace>)| {
            self.nodes.get(joint).map_or(DMat4::IDENTITY, |node| bind.then(node.to_model).raw())
        };
        skin.joints.iter().zip(&skin.inverse_bind).map(bone).collect()
    }
}

/// The vertices with the differences of the morph targets added.
fn morphed<'a>(primitive: &'a Primitive, weights: &[f32]) -> Posed<'a> {
    let shown = |(_, weight): &(&MorphTarget, &f32)| **weight != 0.0 && weight.is_finite();
    let targets: Vec<_> = primitive.targets.iter().zip(weights).filter(shown).collect();
    let (mut positions, mut normals) =
        (Cow::Borrowed(&*primitive.positions), primitive.normals.as_deref().map(Cow::Borrowed));
    for (target, &weight) in targets {
        if let Some(differences) = &target.positions {
            add(positions.to_mut(), differences, weight);
        }
        if let (Some(normals), Some(differences)) = (&mut normals, &target.normals) {
            add(normals.to_mut(), differences, weight);
        }
    }
    if let Some(Cow::Owned(normals)) = &mut normals {
        normals.iter_mut().for_each(|normal| *normal = unit(wide(*normal)));
    }
    Posed { positions, normals, to_model: Affine::IDENTITY }
}

fn add(values: &mut [[f32; 3]], differences: &[[f32; 3]], weight: f32) {
    for (value, difference) in values.iter_mut().zip(differences) {
        let sum = wide(*value) + wide(*difference) * f64::from(weight);
        // A difference that is no number changes nothing.
        *value = if sum.is_finite() { narrow(sum) } else { *value };
    }
}

/// The weighted mean of the maps of a vertex's joints; `None` if it has no weight.
fn blend(bones: &[DMat4], joints: [u16; 4], weights: [f32; 4]) -> Option<DMat4> {
    let (mut sum, mut total) = (DMat4::ZERO, 0.0);
    for (joint, weight) in joints.into_iter().zip(weights) {
        if let Some(bone) = bones.get(usize::from(joint)).filter(|_| weight > 0.0) {
            sum += *bone * f64::from(weight);
            total += f64::from(weight);
        }
    }
    let mean = sum * (1.0 / total);
    (total > 0.0 && mean.is_finite()).then_some(mean)
}

/// The vertices with a map applied to each.
fn bent<'a>(shape: &Posed<'_>, maps: &[DMat4]) -> Posed<'a> {
    let place = |(map, &p): (&DMat4, &[f32; 3])| narrow(map.transform_point3(wide(p)));
    let turn = |(map, &n): (&DMat4, &[f32; 3])| unit(cofactors(map).mul_vec3(wide(n)));
    let positions = maps.iter().zip(&*shape.positions).map(place).collect();
    let normals = shape.normals.as_ref();
    let normals = normals.map(|normals| maps.iter().zip(&**normals).map(turn).collect());
    Posed { positions, normals, to_model: Affine::IDENTITY }
}

fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

/// In single precision, where what is too large becomes the largest number.
fn narrow(v: DVec3) -> [f32; 3] {
    const LARGEST: f64 = f32::MAX as f64;
    v.to_array().map(|x| if x.is_nan() { 0.0 } else { x.clamp(-LARGEST, LARGEST) as f32 })
}

fn unit(v: DVec3) -> [f32; 3] {
    narrow(v.normalize_or(DVec3::Z))
}

/// The matrix that maps normals: the inverse transposed, but for a positive factor.
fn cofactors(map: &DMat4) -> DMat3 {
    let (x, y, z) = (map.x_axis.truncate(), map.y_axis.truncate(), map.z_axis.truncate());
    let mirror = if x.dot(y.cross(z)) < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * mirror
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Mesh, Node};
    use homog::Vector;

    fn node(to_model: Affine<ModelSpace, ModelSpace>) -> Node {
        Node {
            name: None,
            to_parent: to_model,
            parts: None,
            to_model,
            parent: None,
            children: Vec::new(),
            mesh: None,
            places: None,
            weights: None,
            skin: None,
            camera: None,
        }
    }

    fn shift(x: f64, y: f64, z: f64) -> Affine<ModelSpace, ModelSpace> {
        Affine::translation(Vector::new(x, y, z))
    }

    /// A mesh of three vertices on node 0, which stands at x = 100; node 1 is its joint.
    fn model(primitive: Primitive, joint: Affine<ModelSpace, ModelSpace>) -> (Model, Instance) {
        let mut carrier = node(shift(100.0, 0.0, 0.0));
        carrier.mesh = Some(0);
        let mesh = Mesh { primitives: vec![primitive], ..Mesh::default() };
        let model = Model {
            meshes: vec![mesh],
            nodes: vec![carrier, node(joint)],
            skins: vec![Skin {
                joints: vec![1, 0],
                inverse_bind: vec![shift(0.0, -1.0, 0.0), shift(-100.0, 0.0, 0.0)],
            }],
            ..Model::default()
        };
        (model, Instance { node: 0, node_to_model: shift(100.0, 0.0, 0.0) })
    }

    fn triangle() -> Primitive {
        Primitive {
            indices: vec![0, 1, 2],
            positions: vec![[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 2.0, 0.0]],
            normals: Some(vec![[1.0, 0.0, 0.0]; 3]),
            ..Primitive::default()
        }
    }

    #[test]
    fn a_rigid_mesh_is_borrowed() {
        let (model, instance) = model(triangle(), Affine::IDENTITY);
        let posed = model.posed(instance, &model.meshes[0].primitives[0]);
        assert!(matches!(posed.positions, Cow::Borrowed(_)));
        assert_eq!(posed.to_model, instance.node_to_model);
    }

    #[test]
    fn a_skinned_mesh_follows_its_joints_and_not_its_node() {
        let mut arm = triangle();
        arm.joints = Some(vec![[1, 0, 0, 0], [0, 1, 0, 0], [0, 9, 0, 0]]);
        arm.weights = Some(vec![[1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0], [2.0, 1.0, 0.0, 0.0]]);
        // The elbow is at y = 1 and has turned by a quarter about z: up becomes left.
        let quarter = std::f64::consts::FRAC_1_SQRT_2;
        let turn = Affine::<ModelSpace, ModelSpace>::from_quaternion([0.0, 0.0, quarter, quarter]);
        let (mut model, instance) = model(arm, turn.unwrap().then(shift(0.0, 1.0, 0.0)));
        model.nodes[0].skin = Some(0);
        let posed = model.posed(instance, &model.meshes[0].primitives[0]);
        assert_eq!(posed.to_model, Affine::IDENTITY);
        let near = |a: [f32; 3], b: [f32; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(near(posed.positions[0], [0.0, 0.0, 0.0]), "it hangs on the node that is at rest");
        assert!(near(posed.positions[1], [0.0, 1.0, 0.0]), "the elbow itself stays");
        assert!(near(posed.positions[2], [-1.0, 1.0, 0.0]), "weights count by their share");
        let normals = posed.normals.unwrap();
        assert!(near(normals[0], [1.0, 0.0, 0.0]));
        assert!(near(normals[2], [0.0, 1.0, 0.0]));
    }

    #[test]
    fn morph_targets_add_by_the_nodes_weights_or_else_the_meshs() {
        let mut primitive = triangle();
        let difference = |x: f32| Some(vec![[x, 0.0, 0.0]; 3]);
        primitive.targets = vec![
            MorphTarget { positions: difference(2.0), normals: None },
            MorphTarget { positions: difference(f32::NAN), normals: None },
            MorphTarget { positions: None, normals: Some(vec![[-1.0, 1.0, 0.0]; 3]) },
        ];
        let (mut model, instance) = model(primitive, Affine::IDENTITY);
        model.meshes[0].weights = vec![0.5, 1.0];
        let posed = model.posed(instance, &model.meshes[0].primitives[0]);
        assert_eq!(posed.positions[1], [1.0, 1.0, 0.0]);
        assert_eq!(posed.normals.unwrap()[1], [1.0, 0.0, 0.0]);
        model.nodes[0].weights = Some(vec![0.0, 0.0, 1.0]);
        let posed = model.posed(instance, &model.meshes[0].primitives[0]);
        assert_eq!(posed.positions[1], [0.0, 1.0, 0.0]);
        assert_eq!(posed.normals.unwrap()[1], [0.0, 1.0, 0.0]);
        assert_eq!(posed.to_model, instance.node_to_model);
    }
}
