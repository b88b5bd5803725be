//! What a JSON pointer of an animation means (KHR_animation_pointer): a node's transform or weights, a number of a
//! material, light or camera, the transform of a texture.

use super::animation::Targets;
use super::material::uv_transform;
use crate::{Field, LIGHT, MATERIAL, Property, Target, TextureSlot, UvPart};
use gltf::json::Root;

/// What the values of a channel are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Kind {
    /// Translations or scales.
    Place,
    /// Quaternions.
    Rotation,
    /// As many weights as there are.
    Weights,
    /// So many numbers.
    Numbers(usize),
}

impl Kind {
    /// What the values of a property of a node are.
    pub(super) fn of(property: Property) -> Self {
        match property {
            Property::Translation | Property::Scale => Self::Place,
            Property::Rotation => Self::Rotation,
            Property::Weights => Self::Weights,
        }
    }
}

/// The target of a pointer and what its values are; `None` if there is no such thing, or none that changes here.
pub(super) fn target(
    root: &Root,
    targets: &mut Targets<'_>,
    pointer: &str,
) -> Option<(Target, Kind)> {
    let lights = pointer.strip_prefix("/extensions/KHR_lights_punctual");
    let mut steps = lights.unwrap_or(pointer).strip_prefix('/')?.splitn(3, '/');
    let (list, at, path) = (steps.next()?, number(steps.next()?)?, steps.next()?);
    match (list, lights) {
        ("nodes", None) => node(root, targets, at, path),
        ("meshes", None) => {
            let target = weight_of(root, at, path)?;
            let kind = if target.is_some() { Kind::Numbers(1) } else { Kind::Weights };
            Some((Target::MeshWeights { mesh: at, target }, kind))
        }
        ("materials", None) => {
            material(targets, at, path).or_else(|| texture(root, targets, at, path))
        }
        ("cameras", None) => {
            let field = Field::of_lens(path)?;
            let kind = &targets.cameras.get(at)?.kind;
            kind.has(field).then_some((Target::Field { field, of: at }, Kind::Numbers(1)))
        }
        ("lights", Some(_)) => {
            let field = Field::of_light(path)?;
            let Field::Light(row) = field else { return None };
            (LIGHT.get(row)?.numbers)(&mut targets.lights.get(at)?.clone())?;
            Some((Target::Field { field, of: at }, Kind::Numbers(field.width())))
        }
        _ => None,
    }
}

/// A number of a JSON pointer: digits only.
fn number(step: &str) -> Option<usize> {
    step.bytes().all(|byte| byte.is_ascii_digit()).then(|| step.parse().ok())?
}

fn node(root: &Root, targets: &Targets<'_>, at: usize, path: &str) -> Option<(Target, Kind)> {
    let node = targets.nodes.get(at)?;
    let property = match path {
        "translation" => Property::Translation,
        "rotation" => Property::Rotation,
        "scale" => Property::Scale,
        "weights" => Property::Weights,
        _ => {
            let target = weight_of(root, node.mesh?, path)??;
            return Some((Target::NodeWeight { node: at, target }, Kind::Numbers(1)));
        }
    };
    let fits = property == Property::Weights || node.parts.is_some();
    fits.then_some((Target::Node { node: at, property }, Kind::of(property)))
}

/// The morph target of a mesh that `weights/N` means, or all of them for `weights`.
fn weight_of(root: &Root, mesh: usize, path: &str) -> Option<Option<usize>> {
    let mesh = root.meshes.get(mesh)?;
    if path == "weights" {
        return Some(None);
    }
    let target = number(path.strip_prefix("weights/")?)?;
    let targets = mesh.primitives.iter().filter_map(|primitive| primitive.targets.as_ref());
    let count = targets.map(Vec::len).max().unwrap_or(0);
    (target < count).then_some(Some(target))
}

fn material(targets: &mut Targets<'_>, at: usize, path: &str) -> Option<(Target, Kind)> {
    let field = Field::of_material(path)?;
    let Field::Material(row) = field else { return None };
    (MATERIAL.get(row)?.numbers)(targets.materials.get_mut(at)?)?;
    Some((Target::Field { field, of: at }, Kind::Numbers(field.width())))
}

/// A part of the transform of a texture. The transform is noted, once for all its parts.
fn texture(
    root: &Root,
    targets: &mut Targets<'_>,
    at: usize,
    path: &str,
) -> Option<(Target, Kind)> {
    let (path, part) = path.split_once("/extensions/KHR_texture_transform/")?;
    let (part, width) = match part {
        "offset" => (UvPart::Offset, 2),
        "rotation" => (UvPart::Rotation, 1),
        "scale" => (UvPart::Scale, 2),
        _ => return None,
    };
    let (slot, _) = *TextureSlot::PATHS.iter().find(|(_, of)| *of == path)?;
    targets.materials.get_mut(at)?.texture_mut(slot)?;
    let same = |of: &crate::UvTransform| of.material == at && of.slot == slot;
    let known = targets.uv_transforms.iter().position(same);
    let transform = match known {
        Some(known) => known,
        None => {
            targets.uv_transforms.push(uv_transform(root, at, slot)?);
            targets.uv_transforms.len() - 1
        }
    };
    Some((Target::Texture { transform, part }, Kind::Numbers(width)))
}
