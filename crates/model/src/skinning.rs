//! Vertex skinning and morphing: computes the deformed vertices of a mesh in the current pose.
//!
//! Morph targets are added first, in mesh coordinates (glTF 2.0 §3.7.2.2):
//!
//! ```text
//!  v' = v + Σ wᵢ · deltaᵢ
//! ```
//!
//! A skinned vertex then follows the joints of the skin instead of the mesh's node (§3.7.3.3). This
//! is linear blend skinning: joint matrices are blended, not positions.
//!
//! ```text
//!  v" = Σ wᵢ · Jᵢ v'      Jᵢ = inverse bind matrixᵢ, then the joint's global transform
//! ```
//!
//! Normals are transformed by the inverse transpose of the blended matrix and normalized. Sums and
//! products are computed in f64 and in file order, so that every machine gets identical bits.

use super::{MeshInstance, Model, MorphTarget, Primitive, Skin};
use glam::{DMat3, DMat4, DVec3, Vec3};
use homog::{Affine, Model as ModelSpace};
use std::borrow::Cow;

/// The deformed vertices of a primitive: positions and normals after morphing and skinning.
///
/// Arrays are borrowed from the primitive if nothing deforms them.
#[derive(Clone, Debug)]
pub struct SkinnedPrimitive<'a> {
    /// Finite positions, one per vertex.
    pub positions: Cow<'a, [[f32; 3]]>,
    /// Unit normals, if the primitive has normals.
    pub normals: Option<Cow<'a, [[f32; 3]]>>,
    /// The transform from these positions to model space; the identity for a skinned primitive.
    pub to_model: Affine<ModelSpace, ModelSpace>,
}

impl Model {
    /// Deforms the vertices of one of the instance's primitives by applying morph targets, then the
    /// skin.
    ///
    /// Without a skin the result is in mesh coordinates, and `to_model` is the instance's
    /// transform. With a skin the result is in model space, and `to_model` is the identity. A
    /// vertex whose joint weights are all zero follows the node, like an unskinned vertex.
    ///
    /// ```
    /// # use model::{Model, SkinnedPrimitive};
    /// fn model_positions(model: &Model) -> Vec<[f64; 3]> {
    ///     let mut positions = Vec::new();
    ///     for (instance, primitive) in model.scene_primitives() {
    ///         let skinned = model.skin_primitive(instance, primitive);
    ///         for position in skinned.positions.iter() {
    ///             let point = skinned.to_model.transform_point(position.map(f64::from).into());
    ///             positions.push(point.into());
    ///         }
    ///     }
    ///     positions
    /// }
    /// # assert!(model_positions(&Model::default()).is_empty());
    /// ```
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
                let (joint_transforms, rigid) =
                    (self.joint_matrices(skin), instance.node_to_model.raw());
                skin_vertices(&morphed, |vertex| {
                    blend_joint_matrices(&joint_transforms, primitive, vertex).unwrap_or(rigid)
                })
            }
            _ => morphed,
        }
    }

    /// Deforms the tangents of one of the instance's primitives. Returns `None` if the primitive
    /// has no tangents.
    ///
    /// The tangents are in the coordinates of [`SkinnedPrimitive::to_model`]. They have unit
    /// length; w, the handedness of the bitangent, is unchanged. Unlike normals, tangents are
    /// transformed by the matrix itself.
    #[must_use]
    pub fn skin_tangents<'a>(
        &self,
        instance: MeshInstance,
        primitive: &'a Primitive,
    ) -> Option<Cow<'a, [[f32; 4]]>> {
        let mut tangents = Cow::Borrowed(primitive.tangents.as_deref()?);
        for (target, weight) in active_morph_targets(primitive, self.morph_weights(instance.node)) {
            let Some(deltas) = &target.tangents else { continue };
            for ([x, y, z, _], delta) in tangents.to_mut().iter_mut().zip(deltas) {
                let mut tangent = [[*x, *y, *z]];
                add_weighted_deltas(&mut tangent, &[*delta], weight);
                [[*x, *y, *z]] = tangent;
            }
        }
        let skin = self.nodes.get(instance.node).and_then(|node| self.skins.get(node.skin?));
        let joint_transforms = skin
            .filter(|_| !primitive.joint_indices.is_empty())
            .map(|skin| self.joint_matrices(skin));
        if joint_transforms.is_some() || matches!(tangents, Cow::Owned(_)) {
            let rigid = instance.node_to_model.raw();
            for (vertex, [x, y, z, _]) in tangents.to_mut().iter_mut().enumerate() {
                let map = joint_transforms
                    .as_ref()
                    .map(|b| blend_joint_matrices(b, primitive, vertex).unwrap_or(rigid));
                let tangent = to_f64([*x, *y, *z]);
                [*x, *y, *z] = unit_or_z(map.map_or(tangent, |map| map.transform_vector3(tangent)));
            }
        }
        Some(tangents)
    }

    /// Returns the vertex colors with the morph targets added, each channel clamped to [0, 1].
    #[must_use]
    pub fn morph_colors<'a>(
        &self,
        instance: MeshInstance,
        primitive: &'a Primitive,
    ) -> Option<Cow<'a, [[f32; 4]]>> {
        let mut colors = Cow::Borrowed(primitive.colors.as_deref()?);
        for (target, weight) in active_morph_targets(primitive, self.morph_weights(instance.node)) {
            if let Some(deltas) = &target.colors {
                add_weighted_deltas(colors.to_mut(), deltas, weight);
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

    /// Returns the texture coordinates of set `set` (`TEXCOORD_n`) with the morph targets added.
    #[must_use]
    pub fn morph_uvs<'a>(
        &self,
        instance: MeshInstance,
        primitive: &'a Primitive,
        set: usize,
    ) -> Option<Cow<'a, [[f32; 2]]>> {
        let mut uvs = Cow::Borrowed(primitive.uvs.get(set)?.as_slice());
        for (target, weight) in active_morph_targets(primitive, self.morph_weights(instance.node)) {
            if let Some(Some(deltas)) = target.uvs.get(set) {
                add_weighted_deltas(uvs.to_mut(), deltas, weight);
            }
        }
        Some(uvs)
    }

    /// Returns the morph weights in effect at a node: the node's, or else the mesh's.
    pub(super) fn morph_weights(&self, node: usize) -> &[f32] {
        let Some(node) = self.nodes.get(node) else { return &[] };
        let mesh = node.mesh.and_then(|mesh| self.meshes.get(mesh));
        node.morph_weights.as_deref().or(mesh.map(|mesh| &*mesh.morph_weights)).unwrap_or(&[])
    }

    /// Computes the joint matrices of a skin, from mesh coordinates to model space.
    ///
    /// The matrix of an out-of-range joint is the identity. The matrices are computed once per
    /// primitive, not per vertex.
    fn joint_matrices(&self, skin: &Skin) -> Vec<DMat4> {
        let bone = |(&joint, bind): (&usize, &Affine<ModelSpace, ModelSpace>)| {
            self.nodes.get(joint).map_or(DMat4::IDENTITY, |node| bind.then(node.to_model).raw())
        };
        skin.joints.iter().zip(&skin.inverse_bind_matrices).map(bone).collect()
    }
}

/// Returns the morph targets whose weight is finite and not zero, each with its weight.
///
/// Targets beyond the list of weights have weight 0. Most targets of a face rig are inactive, so
/// skipping them saves most of the time.
fn active_morph_targets<'a>(
    primitive: &'a Primitive,
    weights: &[f32],
) -> impl Iterator<Item = (&'a MorphTarget, f32)> {
    let targets = primitive.morph_targets.iter().zip(weights.iter().copied());
    targets.filter(|(_, weight)| *weight != 0.0 && weight.is_finite())
}

/// Adds the weighted deltas of the morph targets to positions and normals.
///
/// Without an active target, all arrays are borrowed. Morphed normals are normalized again.
/// Positions are summed target by target, in file order.
fn morph_vertices<'a>(primitive: &'a Primitive, weights: &[f32]) -> SkinnedPrimitive<'a> {
    let (mut positions, mut normals) =
        (Cow::Borrowed(&*primitive.positions), primitive.normals.as_deref().map(Cow::Borrowed));
    for (target, weight) in active_morph_targets(primitive, weights) {
        if let Some(deltas) = &target.positions {
            add_weighted_deltas(positions.to_mut(), deltas, weight);
        }
        if let (Some(normals), Some(deltas)) = (&mut normals, &target.normals) {
            add_weighted_deltas(normals.to_mut(), deltas, weight);
        }
    }
    if let Some(Cow::Owned(normals)) = &mut normals {
        normals.iter_mut().for_each(|normal| *normal = unit_or_z(to_f64(*normal)));
    }
    SkinnedPrimitive { positions, normals, to_model: Affine::IDENTITY }
}

/// Adds `weight` times the deltas of a morph target. Non-finite deltas are ignored.
///
/// A sum that exceeds the range of single precision becomes the largest finite number.
fn add_weighted_deltas<const N: usize>(values: &mut [[f32; N]], deltas: &[[f32; N]], weight: f32) {
    for (value, delta) in values.iter_mut().zip(deltas) {
        let sum: [f64; N] =
            std::array::from_fn(|k| f64::from(value[k]) + f64::from(delta[k]) * f64::from(weight));
        // A delta that contains NaN or infinity is ignored.
        if sum.iter().all(|x| x.is_finite()) {
            *value = sum.map(saturate_f32);
        }
    }
}

/// Computes the weighted mean of the joint matrices of a vertex. Returns `None` if all weights are
/// zero.
///
/// Dividing by the sum of the weights handles files whose weights do not add up to 1.
///
/// Negative weights are ignored. If the mean overflows, the weights are treated as zero, so a
/// hostile file cannot produce non-finite positions.
fn blend_joint_matrices(
    joint_transforms: &[DMat4],
    primitive: &Primitive,
    vertex: usize,
) -> Option<DMat4> {
    let (mut sum, mut total) = (DMat4::ZERO, 0.0);
    for (joints, weights) in primitive.joint_indices.iter().zip(&primitive.joint_weights) {
        for (joint, weight) in joints[vertex].into_iter().zip(weights[vertex]) {
            if let Some(bone) = joint_transforms.get(usize::from(joint)).filter(|_| weight > 0.0) {
                sum += *bone * f64::from(weight);
                total += f64::from(weight);
            }
        }
    }
    let mean = sum * (1.0 / total);
    (total > 0.0 && mean.is_finite()).then_some(mean)
}

/// Transforms each vertex by its blended matrix, and its normal by the inverse transpose.
///
/// The result is in model space, so `to_model` is the identity.
fn skin_vertices<'a>(
    morphed: &SkinnedPrimitive<'_>,
    map: impl Fn(usize) -> DMat4,
) -> SkinnedPrimitive<'a> {
    let mut positions = Vec::with_capacity(morphed.positions.len());
    let mut normals = morphed.normals.as_ref().map(|normals| Vec::with_capacity(normals.len()));
    for (vertex, &position) in morphed.positions.iter().enumerate() {
        let map = map(vertex);
        positions.push(to_f32_saturating(map.transform_point3(to_f64(position))));
        if let (Some(skinned), Some(normals)) = (&mut normals, &morphed.normals) {
            skinned.push(unit_or_z(normal_matrix(&map).mul_vec3(to_f64(normals[vertex]))));
        }
    }
    SkinnedPrimitive {
        positions: positions.into(),
        normals: normals.map(Cow::Owned),
        to_model: Affine::IDENTITY,
    }
}

/// Converts a vector to double precision, which all sums use.
fn to_f64(v: [f32; 3]) -> DVec3 {
    Vec3::from_array(v).as_dvec3()
}

/// Rounds to single precision. Numbers out of range become the largest finite number.
fn to_f32_saturating(v: DVec3) -> [f32; 3] {
    v.to_array().map(saturate_f32)
}

/// Rounds to single precision, clamped to finite numbers. NaN becomes 0.
fn saturate_f32(x: f64) -> f32 {
    const LARGEST: f64 = f32::MAX as f64;
    if x.is_nan() { 0.0 } else { x.clamp(-LARGEST, LARGEST) as f32 }
}

/// Returns the vector scaled to length 1, or +z if it has no direction.
fn unit_or_z(v: DVec3) -> [f32; 3] {
    to_f32_saturating(v.normalize_or(DVec3::Z))
}

/// Returns the normal matrix: the inverse transpose up to a positive factor, computed as the
/// cofactor matrix.
///
/// Unlike the inverse, it also exists for singular matrices. The sign keeps normals pointing
/// outward if the map is a reflection.
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

    /// Returns a model and its mesh instance: node 0, at x = 100. The first joint is node 1.
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
    fn a_skinned_mesh_follows_its_joints_not_its_node() {
        let mut arm = triangle();
        arm.joint_indices = vec![vec![[1, 0, 0, 0], [0, 1, 0, 0], [0, 9, 0, 0]]];
        arm.joint_weights =
            vec![vec![[1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0], [2.0, 1.0, 0.0, 0.0]]];
        // The elbow at y = 1 is rotated by a quarter turn about z, so up becomes left.
        let quarter = std::f64::consts::FRAC_1_SQRT_2;
        let turn = Affine::<ModelSpace, ModelSpace>::from_quaternion([0.0, 0.0, quarter, quarter]);
        let (mut model, instance) =
            model_with_joint(arm, turn.unwrap().then(translation_by(0.0, 1.0, 0.0)));
        model.nodes[0].skin = Some(0);
        let posed = model.skin_primitive(instance, &model.meshes[0].primitives[0]);
        assert_eq!(posed.to_model, Affine::IDENTITY);
        let nearly_equal =
            |a: [f32; 3], b: [f32; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(
            nearly_equal(posed.positions[0], [0.0, 0.0, 0.0]),
            "this vertex follows the node that is at rest"
        );
        assert!(
            nearly_equal(posed.positions[1], [0.0, 1.0, 0.0]),
            "the elbow itself does not move"
        );
        assert!(nearly_equal(posed.positions[2], [-1.0, 1.0, 0.0]), "a missing joint is ignored");
        let normals = posed.normals.unwrap();
        assert!(nearly_equal(normals[0], [1.0, 0.0, 0.0]));
        assert!(nearly_equal(normals[2], [0.0, 1.0, 0.0]));
    }

    #[test]
    fn morph_weights_come_from_the_node_or_the_mesh() {
        let mut primitive = triangle();
        let delta = |x: f32| Some(vec![[x, 0.0, 0.0]; 3]);
        primitive.morph_targets = vec![
            MorphTarget { positions: delta(2.0), ..MorphTarget::default() },
            MorphTarget { positions: delta(f32::NAN), ..MorphTarget::default() },
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
    fn eight_joints_in_two_sets_are_blended() {
        let mut arm = triangle();
        arm.joint_indices = vec![vec![[0, 1, 0, 1]; 3], vec![[1, 1, 1, 0]; 3]];
        // Joint 0 has moved by 3; joint 1 (the mesh's node) has not. Their total weights are 0.75
        // and 0.25.
        arm.joint_weights =
            vec![vec![[0.25, 0.125, 0.25, 0.0]; 3], vec![[0.0625, 0.0625, 0.0, 0.25]; 3]];
        let (mut model, instance) = model_with_joint(arm, translation_by(3.0, 1.0, 0.0));
        model.nodes[0].skin = Some(0);
        let posed = model.skin_primitive(instance, &model.meshes[0].primitives[0]);
        assert_eq!(posed.positions[0], [2.25, 0.0, 0.0]);
    }

    #[test]
    fn tangents_colors_and_texture_coordinates_are_deformed() {
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
        // A quarter turn about x maps z to −y.
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
