//! Posing: applies an animation at a given time to the nodes, morph weights and materials of a
//! model.
//!
//! Channels are sampled and applied in file order; then all global transforms are recomputed.
//! Deformed vertices are not stored: [`Model::skin_primitive`] computes them from the posed nodes
//! when a primitive is drawn.

use crate::{
    Animation, AnimationChannel, AnimationTarget, Model, NodeProperty, ObjectProperty, Trs,
};
use homog::Affine;

impl Model {
    /// Sets the model to the pose of an animation at a time in seconds.
    ///
    /// Anything that the animation does not target is unchanged, as are nodes whose transforms
    /// would overflow. An unknown animation is ignored. Times outside the animation give its first
    /// or last pose; to loop, pass the time modulo [`Animation::duration_seconds`].
    ///
    /// ```
    /// # let mut model = model::Model::default();
    /// for frame in 0..48 {
    ///     model.apply_animation(0, f64::from(frame) / 24.0);
    ///     // … draw the pose
    /// }
    /// ```
    pub fn apply_animation(&mut self, animation: usize, seconds: f64) {
        let animations = std::mem::take(&mut self.animations);
        if let Some(Animation { channels, .. }) = animations.get(animation) {
            for AnimationChannel { target, curve } in channels {
                self.apply_channel(*target, &curve.sample(seconds));
            }
            self.update_node_transforms();
        }
        self.animations = animations;
    }

    /// Sets the target of a channel to a value.
    ///
    /// Indices out of range are ignored, because a model built in code has not been checked. If a
    /// node has no weights, they start from the weights of its mesh.
    fn apply_channel(&mut self, target: AnimationTarget, value: &[f64]) {
        match target {
            AnimationTarget::Node { node, property } => {
                self.set_node_property(node, property, value);
            }
            AnimationTarget::NodeMorphWeight { node, target } => {
                let default_weights = self.morph_weights(node).to_vec();
                if let Some(node) = self.nodes.get_mut(node) {
                    set_morph_weights(
                        node.morph_weights.get_or_insert(default_weights),
                        Some(target),
                        value,
                    );
                }
            }
            AnimationTarget::MeshMorphWeights { mesh, target } => {
                if let Some(mesh) = self.meshes.get_mut(mesh) {
                    set_morph_weights(&mut mesh.morph_weights, target, value);
                }
            }
            AnimationTarget::ObjectProperty {
                property: ObjectProperty::Material(index),
                index: of,
            } => {
                if let Some(material) = self.materials.get_mut(of) {
                    material.set_property(index, value);
                }
            }
            AnimationTarget::ObjectProperty {
                property: ObjectProperty::Light(index),
                index: of,
            } => {
                if let Some(light) = self.lights.get_mut(of) {
                    light.set_property(index, value);
                }
            }
            AnimationTarget::ObjectProperty {
                property: ObjectProperty::Camera(index),
                index: of,
            } => {
                if let (Some(lens), &[value]) = (self.cameras.get_mut(of), value) {
                    lens.projection.set_property(index, value);
                }
            }
            AnimationTarget::TextureTransform { transform, part } => {
                let Some(transform) = self.uv_transforms.get_mut(transform) else { return };
                transform.set_part(part, value);
                let material = self.materials.get_mut(transform.material);
                if let Some(info) = material.and_then(|m| m.texture_mut(transform.slot)) {
                    info.uv_matrix = transform.to_matrix();
                }
            }
        }
    }

    /// Sets the morph weights or a TRS property of a node.
    fn set_node_property(&mut self, node: usize, property: NodeProperty, value: &[f64]) {
        let Some(node) = self.nodes.get_mut(node) else { return };
        if property == NodeProperty::Weights {
            set_morph_weights(node.morph_weights.get_or_insert_default(), None, value);
        } else if let Some(trs) = &mut node.trs {
            set_trs_property(trs, property, value);
        }
    }

    /// Recomputes all local and global transforms, parents first.
    ///
    /// A local transform that is invalid or would overflow falls back to the previous transform,
    /// then to the identity.
    ///
    /// The time is linear in the number of nodes. The traversal uses an explicit stack, so the
    /// hierarchy may have any depth.
    fn update_node_transforms(&mut self) {
        let mut stack: Vec<usize> =
            (0..self.nodes.len()).filter(|&index| self.nodes[index].parent.is_none()).collect();
        while let Some(index) = stack.pop() {
            let parent_transform =
                self.nodes[index].parent.map_or(Affine::IDENTITY, |up| self.nodes[up].to_model);
            let node = &mut self.nodes[index];
            let posed = node.trs.and_then(|trs| trs.to_affine());
            let candidates = [posed.unwrap_or(node.to_parent), node.to_parent, Affine::IDENTITY];
            let valid_transform =
                candidates.into_iter().find(|map| map.then(parent_transform).is_finite());
            node.to_parent = valid_transform.unwrap_or(Affine::IDENTITY);
            node.to_model = node.to_parent.then(parent_transform);
            stack.extend(&node.children);
        }
    }
}

/// Sets one weight or all weights.
///
/// If the target is beyond the end of the list, zeros are added first.
fn set_morph_weights(weights: &mut Vec<f32>, target: Option<usize>, value: &[f64]) {
    match (target, value) {
        (None, all) => *weights = all.iter().map(|&weight| weight as f32).collect(),
        (Some(target), &[weight]) => {
            if weights.len() <= target {
                weights.resize(target + 1, 0.0);
            }
            weights[target] = weight as f32;
        }
        _ => {}
    }
}

/// Sets the translation, rotation or scale. A value of the wrong length is ignored.
fn set_trs_property(trs: &mut Trs, property: NodeProperty, value: &[f64]) {
    match (property, value) {
        (NodeProperty::Translation, &[x, y, z]) => trs.translation = [x, y, z],
        (NodeProperty::Rotation, &[x, y, z, w]) => trs.rotation = [x, y, z, w],
        (NodeProperty::Scale, &[x, y, z]) => trs.scale = [x, y, z],
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        AnimationCurve, Interpolation, Material, Mesh, Node, TextureInfo, TextureSlot, UvTransform,
        UvTransformPart,
    };

    /// Returns a curve from one value at 0 s to another at 1 s.
    fn linear_curve(values: &[f32], width: usize) -> AnimationCurve {
        let (interpolation, times) = (Interpolation::Linear, vec![0.0, 1.0]);
        AnimationCurve { interpolation, times, values: values.to_vec(), components: width }
    }

    #[test]
    fn a_pose_moves_nodes_and_their_descendants() {
        let node = |parent: Option<usize>, children: &[usize], trs: Trs| Node {
            to_parent: trs.to_affine().unwrap(),
            trs: Some(trs),
            parent,
            children: children.to_vec(),
            ..Node::default()
        };
        let parent_transform = Trs { scale: [2.0; 3], ..Trs::default() };
        let below = Trs { translation: [1.0, 0.0, 0.0], ..Trs::default() };
        let channel =
            |node: usize, property: NodeProperty, values: &[f32], width: usize| AnimationChannel {
                target: AnimationTarget::Node { node, property },
                curve: linear_curve(values, width),
            };
        let largest = f32::MAX;
        let channels = vec![
            channel(0, NodeProperty::Translation, &[0.0, 0.0, 0.0, 0.0, 8.0, 0.0], 3),
            channel(1, NodeProperty::Rotation, &[0.0; 8], 4),
            channel(1, NodeProperty::Weights, &[0.0, 1.0, 1.0, 0.0], 2),
            channel(9, NodeProperty::Scale, &[largest; 6], 3),
        ];
        let mut model = Model {
            nodes: vec![node(None, &[1], parent_transform), node(Some(0), &[], below)],
            roots: vec![0],
            animations: vec![Animation { name: None, channels, duration_seconds: 1.0 }],
            ..Model::default()
        };
        model.apply_animation(1, 0.0);
        assert_eq!(model.nodes[1].to_model, Affine::IDENTITY, "there is no such animation");
        model.apply_animation(0, 0.25);
        let origin = model.node_instances()[1].node_to_model.transform_point(homog::Point::ORIGIN);
        assert_eq!(<[f64; 3]>::from(origin), [2.0, 2.0, 0.0], "an invalid rotation is not used");
        assert_eq!(model.nodes[1].to_model, model.node_instances()[1].node_to_model);
        assert_eq!(model.nodes[1].morph_weights, Some(vec![0.25, 0.75]));
    }

    #[test]
    fn pointers_animate_materials_weights_and_textures() {
        let info = TextureInfo { texture: 0, uv_set: 0, uv_matrix: TextureInfo::IDENTITY_UV };
        let material = Material { emissive_texture: Some(info), ..Material::default() };
        let slot = TextureSlot::Emissive;
        let transform =
            UvTransform { material: 0, slot, offset: [0.0; 2], rotation: 0.0, scale: [1.0; 2] };
        let field = ObjectProperty::for_material("pbrMetallicRoughness/metallicFactor").unwrap();
        let part = UvTransformPart::Offset;
        let targets = [
            (
                AnimationTarget::ObjectProperty { property: field, index: 0 },
                linear_curve(&[0.0, 0.5], 1),
            ),
            (
                AnimationTarget::ObjectProperty { property: field, index: 7 },
                linear_curve(&[0.0, 0.5], 1),
            ),
            (
                AnimationTarget::MeshMorphWeights { mesh: 0, target: Some(1) },
                linear_curve(&[0.0, 0.5], 1),
            ),
            (AnimationTarget::NodeMorphWeight { node: 0, target: 0 }, linear_curve(&[0.0, 1.0], 1)),
            (
                AnimationTarget::TextureTransform { transform: 0, part },
                linear_curve(&[0.0, 0.0, 2.0, 4.0], 2),
            ),
        ];
        let channels = targets.map(|(target, curve)| AnimationChannel { target, curve }).to_vec();
        let mesh = Mesh { morph_weights: vec![0.25, 0.0], ..Mesh::default() };
        let mut model = Model {
            nodes: vec![Node { mesh: Some(0), ..Node::default() }],
            meshes: vec![mesh],
            materials: vec![material],
            uv_transforms: vec![transform],
            animations: vec![Animation { name: None, channels, duration_seconds: 1.0 }],
            ..Model::default()
        };
        model.apply_animation(0, 0.5);
        assert_eq!(model.materials[0].metallic, 0.25);
        assert_eq!(model.meshes[0].morph_weights, [0.25, 0.25]);
        assert_eq!(model.nodes[0].morph_weights.as_deref(), Some(&[0.5, 0.25][..]));
        let map = model.materials[0].emissive_texture.unwrap().uv_matrix;
        assert_eq!(map, [[1.0, 0.0, 1.0], [0.0, 1.0, 2.0]]);
    }
}
