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

use super::{MeshInstance, Model, MorphTarget, Primitive, Skin};
use glam::{DMat3, DMat4, DVec3};
use homog::{Affine, Model as ModelSpace};
use std::borrow::Cow;

/// The vertices of a primitive, ready to be placed.
#[derive(Clone, Debug)]
pub struct SkinnedPrimitive<'a> {
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
    pub fn skin_primitive<'a>(
        &self,
        instance: MeshInstance,
        primitive: &'a Primitive,
    ) -> SkinnedPrimitive<'a> {
        let morphed = SkinnedPrimitive {
            to_model: instance.node_to_model,
            ..morph_vertices(primitive, self.morph_weights(instance.node))
        };
        let skin = self.nodes.get(instance.node).and_then(|node| self.skins.get(node.skin?));
        match skin {
            Some(skin) if !primitive.joint_indices.is_empty() => {
                let (bones, rigid) = (self.joint_matrices(skin), instance.node_to_model.raw());
                skin_vertices(&morphed, |vertex| {
                    blend_joint_matrices(&bones, primitive, vertex).unwrap_or(rigid)
                })
            }
            _ => morphed,
        }
    }

    /// The tangents of a primitive of an instance's mesh as its nodes stand, for [`Posed::to_model`], if it has tangents.
    /// They are of unit length; w is as it was.
    #[must_use]
    pub fn skin_tangents<'a>(
        &self,
        instance: MeshInstance,
        primitive: &'a Primitive,
    ) -> Option<Cow<'a, [[f32; 4]]>> {
        let mut tangents = Cow::Borrowed(primitive.tangents.as_deref()?);
        for (target, weight) in active_morph_targets(primitive, self.morph_weights(instance.node)) {
            let Some(differences) = &target.tangents else { continue };
            for ([x, y, z, _], difference) in tangents.to_mut().iter_mut().zip(differences) {
                let mut tangent = [[*x, *y, *z]];
                add_weighted_deltas(&mut tangent, &[*difference], weight);
                [[*x, *y, *z]] = tangent;
            }
        }
        let skin = self.nodes.get(instance.node).and_then(|node| self.skins.get(node.skin?));
        let bones = skin
            .filter(|_| !primitive.joint_indices.is_empty())
            .map(|skin| self.joint_matrices(skin));
        if bones.is_some() || matches!(tangents, Cow::Owned(_)) {
            let rigid = instance.node_to_model.raw();
            for (vertex, [x, y, z, _]) in tangents.to_mut().iter_mut().enumerate() {
                let map = bones
                    .as_ref()
                    .map(|b| blend_joint_matrices(b, primitive, vertex).unwrap_or(rigid));
                let tangent = to_f64([*x, *y, *z]);
                [*x, *y, *z] = unit_or_z(map.map_or(tangent, |map| map.transform_vector3(tangent)));
            }
        }
        Some(tangents)
    }

    /// The vertex colours of a primitive of an instance's mesh with its morph targets added, each in [0, 1].
    #[must_use]
    pub fn morph_colors<'a>(
        &self,
        instance: MeshInstance,
        primitive: &'a Primitive,
    ) -> Option<Cow<'a, [[f32; 4]]>> {
        let mut colors = Cow::Borrowed(primitive.colors.as_deref()?);
        for (target, weight) in active_morph_targets(primitive, self.morph_weights(instance.node)) {
            if let Some(differences) = &target.colors {
                add_weighted_deltas(colors.to_mut(), differences, weight);
            }
        }
        if let Cow::Owned(colors) = &mut colors {
            colors
                .as_flattened_mut()
                .iter_mut()
                .for_each(|channel| *channel = channel.clamp(0.0, 1.0));
        }
        Some(colors)
    }

    /// A set of texture coordinates of a primitive of an instance's mesh with its morph targets added.
    #[must_use]
    pub fn morph_uvs<'a>(
        &self,
        instance: MeshInstance,
        primitive: &'a Primitive,
        set: usize,
    ) -> Option<Cow<'a, [[f32; 2]]>> {
        let mut uvs = Cow::Borrowed(primitive.uvs.get(set)?.as_slice());
        for (target, weight) in active_morph_targets(primitive, self.morph_weights(instance.node)) {
            if let Some(Some(differences)) = target.uvs.get(set) {
                add_weighted_deltas(uvs.to_mut(), differences, weight);
            }
        }
        Some(uvs)
    }

    /// How much of each morph target a node shows.
    pub(super) fn morph_weights(&self, node: usize) -> &[f32] {
        let Some(node) = self.nodes.get(node) else { return &[] };
        let mesh = node.mesh.and_then(|mesh| self.meshes.get(mesh));
        node.morph_weights.as_deref().or(mesh.map(|mesh| &*mesh.morph_weights)).unwrap_or(&[])
    }

    /// For each joint of a skin the map from the mesh to the model.
    fn joint_matrices(&self, skin: &Skin) -> Vec<DMat4> {
        let bone = |(&joint, bind): (&usize, &Affine<ModelSpace, ModelSpace>)| {
            self.nodes.get(joint).map_or(DMat4::IDENTITY, |node| bind.then(node.to_model).raw())
        };
        skin.joints.iter().zip(&skin.inverse_bind_matrices).map(bone).collect()
    }
}

/// The morph targets that are shown, each with how much of it is.
fn active_morph_targets<'a>(
    primitive: &'a Primitive,
    weights: &[f32],
) -> impl Iterator<Item = (&'a MorphTarget, f32)> {
    let targets = primitive.morph_targets.iter().zip(weights.iter().copied());
    targets.filter(|(_, weight)| *weight != 0.0 && weight.is_finite())
}

/// The vertices with the differences of the morph targets added.
fn morph_vertices<'a>(primitive: &'a Primitive, weights: &[f32]) -> SkinnedPrimitive<'a> {
    let (mut positions, mut normals) =
        (Cow::Borrowed(&*primitive.positions), primitive.normals.as_deref().map(Cow::Borrowed));
    for (target, weight) in active_morph_targets(primitive, weights) {
        if let Some(differences) = &target.positions {
            add_weighted_deltas(positions.to_mut(), differences, weight);
        }
        if let (Some(normals), Some(differences)) = (&mut normals, &target.normals) {
            add_weighted_deltas(normals.to_mut(), differences, weight);
        }
    }
    if let Some(Cow::Owned(normals)) = &mut normals {
        normals.iter_mut().for_each(|normal| *normal = unit_or_z(to_f64(*normal)));
    }
    SkinnedPrimitive { positions, normals, to_model: Affine::IDENTITY }
}

fn add_weighted_deltas<const N: usize>(
    values: &mut [[f32; N]],
    differences: &[[f32; N]],
    weight: f32,
) {
    for (value, difference) in values.iter_mut().zip(differences) {
        let sum: [f64; N] = std::array::from_fn(|k| {
            f64::from(value[k]) + f64::from(difference[k]) * f64::from(weight)
        });
        // A difference that is no number changes nothing.
        if sum.iter().all(|x| x.is_finite()) {
            *value = sum.map(saturate_f32);
        }
    }
}

/// The weighted mean of the maps of a vertex's joints; `None` if it has no weight.
fn blend_joint_matrices(bones: &[DMat4], primitive: &Primitive, vertex: usize) -> Option<DMat4> {
    let (mut sum, mut total) = (DMat4::ZERO, 0.0);
    for (joints, weights) in primitive.joint_indices.iter().zip(&primitive.joint_weights) {
        for (joint, weight) in joints[vertex].into_iter().zip(weights[vertex]) {
            if let Some(bone) = bones.get(usize::from(joint)).filter(|_| weight > 0.0) {
                sum += *bone * f64::from(weight);
                total += f64::from(weight);
            }
        }
    }
    let mean = sum * (1.0 / total);
    (total > 0.0 && mean.is_finite()).then_some(mean)
}

/// The vertices with a map applied to each.
fn skin_vertices<'a>(
    shape: &SkinnedPrimitive<'_>,
    map: impl Fn(usize) -> DMat4,
) -> SkinnedPrimitive<'a> {
    let mut positions = Vec::with_capacity(shape.positions.len());
    let mut normals = shape.normals.as_ref().map(|normals| Vec::with_capacity(normals.len()));
    for (vertex, &position) in shape.positions.iter().enumerate() {
        let map = map(vertex);
        positions.push(to_f32_saturating(map.transform_point3(to_f64(position))));
        if let (Some(bent), Some(normals)) = (&mut normals, &shape.normals) {
            bent.push(unit_or_z(normal_matrix(&map).mul_vec3(to_f64(normals[vertex]))));
        }
    }
    SkinnedPrimitive {
        positions: positions.into(),
        normals: normals.map(Cow::Owned),
        to_model: Affine::IDENTITY,
    }
}

fn to_f64(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

/// In single precision, where what is too large becomes the largest number.
fn to_f32_saturating(v: DVec3) -> [f32; 3] {
    v.to_array().map(saturate_f32)
}

fn saturate_f32(x: f64) -> f32 {
    const LARGEST: f64 = f32::MAX as f64;
    if x.is_nan() { 0.0 } else { x.clamp(-LARGEST, LARGEST) as f32 }
}

fn unit_or_z(v: DVec3) -> [f32; 3] {
    to_f32_saturating(v.normalize_or(DVec3::Z))
}

/// The matrix that maps normals: the inverse transposed, but for a positive factor.
fn normal_matrix(map: &DMat4) -> DMat3 {
    let (x, y, z) = (map.x_axis.truncate(), map.y_axis.truncate(), map.z_axis.truncate());
    let mirror = if x.dot(y.cross(z)) < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * mirror
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mesh, Node};
    use homog::Vector;

    fn node_at(to_model: Affine<ModelSpace, ModelSpace>) -> Node {
        Node { to_parent: to_model, trs: None, to_model, ..Node::default() }
    }

    fn translation_by(x: f64, y: f64, z: f64) -> Affine<ModelSpace, ModelSpace> {
        Affine::translation(Vector::new(x, y, z))
    }

    /// A mesh of three vertices on node 0, which stands at x = 100; node 1 is its joint.
    fn model_with_joint(
        primitive: Primitive,
        joint: Affine<ModelSpace, ModelSpace>,
    ) -> (Model, MeshInstance) {
        let mut carrier = node_at(translation_by(100.0, 0.0, 0.0));
        carrier.mesh = Some(0);
        let mesh = Mesh { primitives: vec![primitive], ..Mesh::default() };
        let model = Model {
            meshes: vec![mesh],
            nodes: vec![carrier, node_at(joint)],
            skins: vec![Skin {
                joints: vec![1, 0],
                inverse_bind_matrices: vec![
                    translation_by(0.0, -1.0, 0.0),
                    translation_by(-100.0, 0.0, 0.0),
                ],
            }],
            ..Model::default()
        };
        (model, MeshInstance { node: 0, node_to_model: translation_by(100.0, 0.0, 0.0) })
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
        let (model, instance) = model_with_joint(triangle(), Affine::IDENTITY);
        let posed = model.skin_primitive(instance, &model.meshes[0].primitives[0]);
        assert!(matches!(posed.positions, Cow::Borrowed(_)));
        assert_eq!(posed.to_model, instance.node_to_model);
    }

    #[test]
    fn a_skinned_mesh_follows_its_joints_and_not_its_node() {
        let mut arm = triangle();
        arm.joint_indices = vec![vec![[1, 0, 0, 0], [0, 1, 0, 0], [0, 9, 0, 0]]];
        arm.joint_weights =
            vec![vec![[1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0], [2.0, 1.0, 0.0, 0.0]]];
        // The elbow is at y = 1 and has turned by a quarter about z: up becomes left.
        let quarter = std::f64::consts::FRAC_1_SQRT_2;
        let turn = Affine::<ModelSpace, ModelSpace>::from_quaternion([0.0, 0.0, quarter, quarter]);
        let (mut model, instance) =
            model_with_joint(arm, turn.unwrap().then(translation_by(0.0, 1.0, 0.0)));
        model.nodes[0].skin = Some(0);
        let posed = model.skin_primitive(instance, &model.meshes[0].primitives[0]);
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
        primitive.morph_targets = vec![
            MorphTarget { positions: difference(2.0), ..MorphTarget::default() },
            MorphTarget { positions: difference(f32::NAN), ..MorphTarget::default() },
            MorphTarget { normals: Some(vec![[-1.0, 1.0, 0.0]; 3]), ..MorphTarget::default() },
        ];
        let (mut model, instance) = model_with_joint(primitive, Affine::IDENTITY);
        model.meshes[0].morph_weights = vec![0.5, 1.0];
        let posed = model.skin_primitive(instance, &model.meshes[0].primitives[0]);
        assert_eq!(posed.positions[1], [1.0, 1.0, 0.0]);
        assert_eq!(posed.normals.unwrap()[1], [1.0, 0.0, 0.0]);
        model.nodes[0].morph_weights = Some(vec![0.0, 0.0, 1.0]);
        let posed = model.skin_primitive(instance, &model.meshes[0].primitives[0]);
        assert_eq!(posed.positions[1], [0.0, 1.0, 0.0]);
        assert_eq!(posed.normals.unwrap()[1], [0.0, 1.0, 0.0]);
        assert_eq!(posed.to_model, instance.node_to_model);
    }

    #[test]
    fn eight_joints_of_two_sets_count_by_their_weights() {
        let mut arm = triangle();
        arm.joint_indices = vec![vec![[0, 1, 0, 1]; 3], vec![[1, 1, 1, 0]; 3]];
        // Joint 0 has moved by 3, joint 1 (the mesh's own node) stands: in all 0.75 and 0.25 of the weight.
        arm.joint_weights =
            vec![vec![[0.25, 0.125, 0.25, 0.0]; 3], vec![[0.0625, 0.0625, 0.0, 0.25]; 3]];
        let (mut model, instance) = model_with_joint(arm, translation_by(3.0, 1.0, 0.0));
        model.nodes[0].skin = Some(0);
        let posed = model.skin_primitive(instance, &model.meshes[0].primitives[0]);
        assert_eq!(posed.positions[0], [2.25, 0.0, 0.0]);
    }

    #[test]
    fn tangents_colours_and_texture_coordinates_follow() {
        let mut primitive = triangle();
        primitive.tangents = Some(vec![[0.0, 1.0, 0.0, -1.0]; 3]);
        primitive.colors = Some(vec![[0.5, 0.5, 0.5, 1.0]; 3]);
        primitive.uvs = vec![vec![[0.0, 0.0]; 3], vec![[0.25, 0.5]; 3]];
        primitive.morph_targets = vec![MorphTarget {
            tangents: Some(vec![[0.0, -1.0, 1.0]; 3]),
            colors: Some(vec![[0.25, -1.0, 0.0, 1.0]; 3]),
            uvs: vec![None, Some(vec![[1.0, 1.0]; 3])],
            ..MorphTarget::default()
        }];
        let (mut model, instance) = model_with_joint(primitive, Affine::IDENTITY);
        let posed = |model: &Model| {
            let primitive = &model.meshes[0].primitives[0];
            let tangents = model.skin_tangents(instance, primitive).unwrap().into_owned();
            let colors = model.morph_colors(instance, primitive).unwrap().into_owned();
            let uvs = model.morph_uvs(instance, primitive, 1).unwrap().into_owned();
            (tangents[2], colors[2], uvs[2])
        };
        assert_eq!(posed(&model), ([0.0, 1.0, 0.0, -1.0], [0.5, 0.5, 0.5, 1.0], [0.25, 0.5]));
        model.meshes[0].morph_weights = vec![1.0];
        assert_eq!(posed(&model), ([0.0, 0.0, 1.0, -1.0], [0.75, 0.0, 0.5, 1.0], [1.25, 1.5]));
        // A quarter turn about x takes z to −y.
        let half = std::f64::consts::FRAC_1_SQRT_2;
        model.nodes[1].to_model = Affine::from_quaternion([half, 0.0, 0.0, half]).unwrap();
        model.nodes[0].skin = Some(0);
        let primitive = &mut model.meshes[0].primitives[0];
        (primitive.joint_indices, primitive.joint_weights) =
            (vec![vec![[0; 4]; 3]], vec![vec![[1.0, 0.0, 0.0, 0.0]; 3]]);
        let (tangent, ..) = posed(&model);
        assert!((tangent[1] + 1.0).abs() < 1e-6 && tangent[3] == -1.0, "{tangent:?}");
    }
}
