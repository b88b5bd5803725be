//! Posing: a model as an animation has it at a time.

use super::{Animation, Channel, Field, Model, Parts, Property, Target};
use homog::Affine;

impl Model {
    /// Poses the model as an animation has it at a time: nodes, weights of morph targets, and with KHR_animation_pointer
    /// materials, textures, lights and cameras. What it does not change stays; nodes that would leave the range of numbers
    /// do as well. Nothing happens if there is no such animation.
    pub fn pose(&mut self, animation: usize, seconds: f64) {
        let animations = std::mem::take(&mut self.animations);
        if let Some(Animation { channels, .. }) = animations.get(animation) {
            for Channel { target, curve } in channels {
                self.set(*target, &curve.at(seconds));
            }
            self.place_nodes();
        }
        self.animations = animations;
    }

    fn set(&mut self, target: Target, value: &[f64]) {
        match target {
            Target::Node { node, property } => self.set_node(node, property, value),
            Target::NodeWeight { node, target } => {
                let usual = self.morph_weights(node).to_vec();
                if let Some(node) = self.nodes.get_mut(node) {
                    set_weights(node.weights.get_or_insert(usual), Some(target), value);
                }
            }
            Target::MeshWeights { mesh, target } => {
                if let Some(mesh) = self.meshes.get_mut(mesh) {
                    set_weights(&mut mesh.weights, target, value);
                }
            }
            Target::Field { field: Field::Material(at), of } => {
                if let Some(material) = self.materials.get_mut(of) {
                    material.set(at, value);
                }
            }
            Target::Field { field: Field::Light(at), of } => {
                if let Some(light) = self.lights.get_mut(of) {
                    light.set(at, value);
                }
            }
            Target::Field { field: Field::Lens(at), of } => {
                if let (Some(lens), &[value]) = (self.cameras.get_mut(of), value) {
                    lens.kind.set(at, value);
                }
            }
            Target::Texture { transform, part } => {
                let Some(transform) = self.uv_transforms.get_mut(transform) else { return };
                transform.set(part, value);
                let material = self.materials.get_mut(transform.material);
                if let Some(used) = material.and_then(|m| m.texture_mut(transform.slot)) {
                    used.uv_map = transform.map();
                }
            }
        }
    }

    fn set_node(&mut self, node: usize, property: Property, value: &[f64]) {
        let Some(node) = self.nodes.get_mut(node) else { return };
        if property == Property::Weights {
            set_weights(node.weights.get_or_insert_default(), None, value);
        } else if let Some(parts) = &mut node.parts {
            set_part(parts, property, value);
        }
    }

    /// Tells every node its place anew, parents first.
    fn place_nodes(&mut self) {
        let mut open: Vec<usize> =
            (0..self.nodes.len()).filter(|&at| self.nodes[at].parent.is_none()).collect();
        while let Some(at) = open.pop() {
            let above =
                self.nodes[at].parent.map_or(Affine::IDENTITY, |up| self.nodes[up].to_model);
            let node = &mut self.nodes[at];
            let posed = node.parts.and_then(|parts| parts.to_parent());
            let candidates = [posed.unwrap_or(node.to_parent), node.to_parent, Affine::IDENTITY];
            let fits = candidates.into_iter().find(|map| map.then(above).is_finite());
            node.to_parent = fits.unwrap_or(Affine::IDENTITY);
            node.to_model = node.to_parent.then(above);
            open.extend(&node.children);
        }
    }
}

/// Sets one weight, or all of them.
fn set_weights(weights: &mut Vec<f32>, target: Option<usize>, value: &[f64]) {
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

fn set_part(parts: &mut Parts, property: Property, value: &[f64]) {
    match (property, value) {
        (Property::Translation, &[x, y, z]) => parts.translation = [x, y, z],
        (Property::Rotation, &[x, y, z, w]) => parts.rotation = [x, y, z, w],
        (Property::Scale, &[x, y, z]) => parts.scale = [x, y, z],
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Curve, Interpolation, Material, Mesh, Node, TextureSlot, TextureUse, UvPart, UvTransform,
    };

    /// From one value at 0 s to another at 1 s.
    fn line(values: &[f32], width: usize) -> Curve {
        let (interpolation, times) = (Interpolation::Linear, vec![0.0, 1.0]);
        Curve { interpolation, times, values: values.to_vec(), width }
    }

    #[test]
    fn a_pose_moves_nodes_and_what_hangs_on_them() {
        let node = |parent: Option<usize>, children: &[usize], parts: Parts| Node {
            to_parent: parts.to_parent().unwrap(),
            parts: Some(parts),
            parent,
            children: children.to_vec(),
            ..Node::default()
        };
        let above = Parts { scale: [2.0; 3], ..Parts::default() };
        let below = Parts { translation: [1.0, 0.0, 0.0], ..Parts::default() };
        let channel = |node: usize, property: Property, values: &[f32], width: usize| Channel {
            target: Target::Node { node, property },
            curve: line(values, width),
        };
        let largest = f32::MAX;
        let channels = vec![
            channel(0, Property::Translation, &[0.0, 0.0, 0.0, 0.0, 8.0, 0.0], 3),
            channel(1, Property::Rotation, &[0.0; 8], 4),
            channel(1, Property::Weights, &[0.0, 1.0, 1.0, 0.0], 2),
            channel(9, Property::Scale, &[largest; 6], 3),
        ];
        let mut model = Model {
            nodes: vec![node(None, &[1], above), node(Some(0), &[], below)],
            roots: vec![0],
            animations: vec![Animation { name: None, channels, duration_seconds: 1.0 }],
            ..Model::default()
        };
        model.pose(1, 0.0);
        assert_eq!(model.nodes[1].to_model, Affine::IDENTITY, "there is no such animation");
        model.pose(0, 0.25);
        let origin = model.instances()[1].node_to_model.point(homog::Point::ORIGIN);
        assert_eq!(<[f64; 3]>::from(origin), [2.0, 2.0, 0.0], "what is no rotation is not used");
        assert_eq!(model.nodes[1].to_model, model.instances()[1].node_to_model);
        assert_eq!(model.nodes[1].weights, Some(vec![0.25, 0.75]));
    }

    #[test]
    fn pointers_change_materials_weights_and_textures() {
        let used = TextureUse { texture: 0, uv_set: 0, uv_map: TextureUse::KEEP_UV };
        let material = Material { emissive_texture: Some(used), ..Material::default() };
        let slot = TextureSlot::Emissive;
        let lies =
            UvTransform { material: 0, slot, offset: [0.0; 2], rotation: 0.0, scale: [1.0; 2] };
        let field = Field::of_material("pbrMetallicRoughness/metallicFactor").unwrap();
        let part = UvPart::Offset;
        let targets = [
            (Target::Field { field, of: 0 }, line(&[0.0, 0.5], 1)),
            (Target::Field { field, of: 7 }, line(&[0.0, 0.5], 1)),
            (Target::MeshWeights { mesh: 0, target: Some(1) }, line(&[0.0, 0.5], 1)),
            (Target::NodeWeight { node: 0, target: 0 }, line(&[0.0, 1.0], 1)),
            (Target::Texture { transform: 0, part }, line(&[0.0, 0.0, 2.0, 4.0], 2)),
        ];
        let channels = targets.map(|(target, curve)| Channel { target, curve }).to_vec();
        let mesh = Mesh { weights: vec![0.25, 0.0], ..Mesh::default() };
        let mut model = Model {
            nodes: vec![Node { mesh: Some(0), ..Node::default() }],
            meshes: vec![mesh],
            materials: vec![material],
            uv_transforms: vec![lies],
            animations: vec![Animation { name: None, channels, duration_seconds: 1.0 }],
            ..Model::default()
        };
        model.pose(0, 0.5);
        assert_eq!(model.materials[0].metallic, 0.25);
        assert_eq!(model.meshes[0].weights, [0.25, 0.25]);
        assert_eq!(model.nodes[0].weights.as_deref(), Some(&[0.5, 0.25][..]));
        let map = model.materials[0].emissive_texture.unwrap().uv_map;
        assert_eq!(map, [[1.0, 0.0, 1.0], [0.0, 1.0, 2.0]]);
    }
}
