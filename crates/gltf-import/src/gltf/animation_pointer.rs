//! Resolves JSON pointers to the properties that they animate (KHR_animation_pointer).
//!
//! Supports node transforms and weights, material, light and camera properties, and texture
//! transforms.
//!
//! ```text
//!  /nodes/3/rotation                                         four numbers, a quaternion
//!  /meshes/0/weights/1                                       one morph weight
//!  /materials/2/pbrMetallicRoughness/baseColorFactor         four numbers
//!  /extensions/KHR_lights_punctual/lights/0/intensity        one number
//! ```

use super::animation::AnimatedObjects;
use super::material::texture_transform;
use gltf::json::Root;
use model::object_model::{LIGHT_PROPERTIES, MATERIAL_PROPERTIES};
use model::{AnimationTarget, NodeProperty, ObjectProperty, TextureSlot, UvTransformPart};

/// The type of a channel's values.
///
/// It determines the accessor format and the number of components per keyframe.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum ChannelValueKind {
    /// Three floats.
    TranslationOrScale,
    /// Quaternions.
    Rotation,
    /// All morph weights, one per target.
    Weights,
    /// A fixed number of components.
    Numbers(usize),
}

impl ChannelValueKind {
    /// Returns the value type of a node property.
    pub(super) fn for_property(property: NodeProperty) -> Self {
        match property {
            NodeProperty::Translation | NodeProperty::Scale => Self::TranslationOrScale,
            NodeProperty::Rotation => Self::Rotation,
            NodeProperty::Weights => Self::Weights,
        }
    }
}

/// Resolves a pointer to its target and value type. Returns `None` if it does not identify an
/// animatable property.
///
/// The object must exist and have the property; a pointer into an absent extension or texture is
/// not a valid target. The supported paths do not contain JSON pointer escapes.
pub(super) fn resolve_pointer(
    root: &Root,
    targets: &mut AnimatedObjects<'_>,
    pointer: &str,
) -> Option<(AnimationTarget, ChannelValueKind)> {
    let lights = pointer.strip_prefix("/extensions/KHR_lights_punctual");
    let mut steps = lights.unwrap_or(pointer).strip_prefix('/')?.splitn(3, '/');
    let (list, index, path) = (steps.next()?, parse_index(steps.next()?)?, steps.next()?);
    match (list, lights) {
        ("nodes", None) => node_target(root, targets, index, path),
        ("meshes", None) => {
            let target = morph_target_index(root, index, path)?;
            let kind = if target.is_some() {
                ChannelValueKind::Numbers(1)
            } else {
                ChannelValueKind::Weights
            };
            Some((AnimationTarget::MeshMorphWeights { mesh: index, target }, kind))
        }
        ("materials", None) => material_target(targets, index, path)
            .or_else(|| texture_transform_target(root, targets, index, path)),
        ("cameras", None) => {
            let field = ObjectProperty::for_camera(path)?;
            let kind = &targets.cameras.get(index)?.projection;
            kind.has_property(field).then_some((
                AnimationTarget::ObjectProperty { property: field, index },
                ChannelValueKind::Numbers(1),
            ))
        }
        ("lights", Some(_)) => {
            let field = ObjectProperty::for_light(path)?;
            let ObjectProperty::Light(row) = field else { return None };
            // Checks that this kind of light has the property.
            (LIGHT_PROPERTIES.get(row)?.numbers_mut)(&mut targets.lights.get(index)?.clone())?;
            Some((
                AnimationTarget::ObjectProperty { property: field, index },
                ChannelValueKind::Numbers(field.component_count()),
            ))
        }
        _ => None,
    }
}

/// Parses a token of a JSON pointer as an index, which may contain only digits.
///
/// An empty token is rejected, and so is `+1`, although [`str::parse`] would accept it.
fn parse_index(step: &str) -> Option<usize> {
    step.bytes().all(|byte| byte.is_ascii_digit()).then(|| step.parse().ok())?
}

/// Returns the target for a property or a single morph weight of a node.
///
/// A node with a matrix has no translation, rotation and scale to animate.
fn node_target(
    root: &Root,
    targets: &AnimatedObjects<'_>,
    index: usize,
    path: &str,
) -> Option<(AnimationTarget, ChannelValueKind)> {
    let node = targets.nodes.get(index)?;
    let property = match path {
        "translation" => NodeProperty::Translation,
        "rotation" => NodeProperty::Rotation,
        "scale" => NodeProperty::Scale,
        "weights" => NodeProperty::Weights,
        _ => {
            let target = morph_target_index(root, node.mesh?, path)??;
            return Some((
                AnimationTarget::NodeMorphWeight { node: index, target },
                ChannelValueKind::Numbers(1),
            ));
        }
    };
    let fits = property == NodeProperty::Weights || node.trs.is_some();
    fits.then_some((
        AnimationTarget::Node { node: index, property },
        ChannelValueKind::for_property(property),
    ))
}

/// Returns `Some(Some(N))` for `weights/N`, or `Some(None)` for `weights`, which means all targets.
///
/// A mesh has as many targets as the primitive with the most. Returns `None` for any other path, or
/// if the target does not exist.
fn morph_target_index(root: &Root, mesh: usize, path: &str) -> Option<Option<usize>> {
    let mesh = root.meshes.get(mesh)?;
    if path == "weights" {
        return Some(None);
    }
    let target = parse_index(path.strip_prefix("weights/")?)?;
    let targets = mesh.primitives.iter().filter_map(|primitive| primitive.targets.as_ref());
    let count = targets.map(Vec::len).max().unwrap_or(0);
    (target < count).then_some(Some(target))
}

/// Returns the target for a numeric property of a material.
///
/// Access through the table reveals whether the material has the extension that defines the
/// property.
fn material_target(
    targets: &mut AnimatedObjects<'_>,
    index: usize,
    path: &str,
) -> Option<(AnimationTarget, ChannelValueKind)> {
    let field = ObjectProperty::for_material(path)?;
    let ObjectProperty::Material(row) = field else { return None };
    (MATERIAL_PROPERTIES.get(row)?.numbers_mut)(targets.materials.get_mut(index)?)?;
    Some((
        AnimationTarget::ObjectProperty { property: field, index },
        ChannelValueKind::Numbers(field.component_count()),
    ))
}

/// Returns the target for a property of a texture transform. The transform is added to the list
/// when one of its properties is first animated.
///
/// The file must contain the texture and its transform. The transform supplies the values of the
/// properties that are not animated.
fn texture_transform_target(
    root: &Root,
    targets: &mut AnimatedObjects<'_>,
    index: usize,
    path: &str,
) -> Option<(AnimationTarget, ChannelValueKind)> {
    let (path, part) = path.split_once("/extensions/KHR_texture_transform/")?;
    let (part, width) = match part {
        "offset" => (UvTransformPart::Offset, 2),
        "rotation" => (UvTransformPart::Rotation, 1),
        "scale" => (UvTransformPart::Scale, 2),
        _ => return None,
    };
    let (slot, _) = *TextureSlot::PATHS.iter().find(|(_, known)| *known == path)?;
    targets.materials.get_mut(index)?.texture_mut(slot)?;
    let is_same = |known: &model::UvTransform| known.material == index && known.slot == slot;
    let existing = targets.uv_transforms.iter().position(is_same);
    let transform = match existing {
        Some(existing) => existing,
        None => {
            targets.uv_transforms.push(texture_transform(root, index, slot)?);
            targets.uv_transforms.len() - 1
        }
    };
    Some((AnimationTarget::TextureTransform { transform, part }, ChannelValueKind::Numbers(width)))
}
