//! Converts the channels and samplers of animations to keyframe curves. Invalid channels are
//! skipped with a warning.
//!
//! A sampler has keyframe times (`input`) and values (`output`); a channel selects the property
//! that a sampler sets. LINEAR means slerp for rotations. Values may be normalized integers, which
//! become floats here.

use super::accessor::AccessorReader;
use super::animation_pointer::{self, ChannelValueKind};
use super::attribute::{
    AllowedFormats, ROTATION, SCALAR_VALUES, TRANSLATION_OR_SCALE, VEC2_VALUES, VEC3_VALUES,
};
use super::untyped_members::PointerChannel;
use crate::warnings::ImportWarnings;
use files::counted;
use gltf::json;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::animation::{Interpolation as JsonInterpolation, Property as JsonProperty};
use gltf::json::validation::Checked;
use model::{
    Animation, AnimationChannel, AnimationCurve, AnimationTarget, Diagnostic, Interpolation,
    Material, ModelCamera, Node, NodeProperty, PunctualLight, UvTransform,
};

/// The objects that channels can animate, and the texture transforms that they do animate.
pub(super) struct AnimatedObjects<'a> {
    /// The nodes, for transforms and morph weights.
    pub(super) nodes: &'a [Node],
    /// The materials; mutable only because the property table provides no shared access.
    pub(super) materials: &'a mut [Material],
    /// Punctual lights.
    pub(super) lights: &'a [PunctualLight],
    /// Cameras.
    pub(super) cameras: &'a [ModelCamera],
    /// The texture transforms that channels animate; each is appended on first use.
    pub(super) uv_transforms: &'a mut Vec<UvTransform>,
}

/// Reads all animations of a file.
///
/// Channels that target a node come first, then channels that target a pointer. The duration is the
/// time of the last keyframe in any channel, in seconds.
///
/// # Errors
/// Fails if a limit is exceeded or a file cannot be read; errors in channels are only warnings.
pub(super) fn import_animations(
    source: &AccessorReader<'_>,
    pointers: &[PointerChannel],
    targets: &mut AnimatedObjects<'_>,
    warnings: &mut ImportWarnings,
) -> Result<Vec<Animation>, Diagnostic> {
    let mut animations = Vec::with_capacity(source.root.animations.len());
    for (at, json) in source.root.animations.iter().enumerate() {
        let mut channels = Vec::with_capacity(json.channels.len());
        let reader = AnimationReader { source, samplers: &json.samplers, animation: at };
        // An error in a channel discards only that channel, but an exceeded limit ends the import.
        let mut keep = |read: Result<AnimationChannel, Diagnostic>| match read {
            Err(diagnostic) if diagnostic.is_downgradable() => {
                warnings.downgrade(&diagnostic, "the channel is skipped");
                Ok(())
            }
            read => read.map(|channel| channels.push(channel)),
        };
        for (number, channel) in json.channels.iter().enumerate() {
            let pointer = format!("/animations/{at}/channels/{number}");
            keep(reader.read_channel(targets.nodes, channel, &pointer))?;
        }
        for json in pointers.iter().filter(|json| json.animation == at) {
            keep(reader.read_pointer_channel(targets, json))?;
        }
        let ends = channels.iter().filter_map(|channel| channel.curve.times.last());
        let duration_seconds = ends.map(|&time| f64::from(time)).fold(0.0, f64::max);
        animations.push(Animation { name: json.name.clone(), channels, duration_seconds });
    }
    Ok(animations)
}

/// Reads the channels of one animation.
///
/// A sampler is read again for each channel that uses it, because sharing is rare and curves are
/// small.
struct AnimationReader<'a> {
    source: &'a AccessorReader<'a>,
    /// The samplers of the animation, which its channels refer to.
    samplers: &'a [json::animation::Sampler],
    /// Index of the animation.
    animation: usize,
}

impl AnimationReader<'_> {
    /// Reads a channel that targets a node.
    ///
    /// # Errors
    /// Fails if the node or sampler does not exist, the path is unknown, the node has a matrix, or
    /// the curve is invalid.
    fn read_channel(
        &self,
        nodes: &[Node],
        json: &json::animation::Channel,
        pointer: &str,
    ) -> Result<AnimationChannel, Diagnostic> {
        let node = json.target.node.value();
        let Some(target) = nodes.get(node) else {
            let pointer = format!("{pointer}/target/node");
            return Err(Diagnostic::unresolved_index(&pointer, "node", node, nodes.len()));
        };
        let property = match json.target.path {
            Checked::Valid(JsonProperty::Translation) => NodeProperty::Translation,
            Checked::Valid(JsonProperty::Rotation) => NodeProperty::Rotation,
            Checked::Valid(JsonProperty::Scale) => NodeProperty::Scale,
            Checked::Valid(JsonProperty::MorphTargetWeights) => NodeProperty::Weights,
            Checked::Invalid => {
                let pointer = format!("{pointer}/target/path");
                return Err(Diagnostic::invalid(&pointer, "unknown path"));
            }
        };
        if property != NodeProperty::Weights && target.trs.is_none() {
            let message = format!("node {node} has a matrix, which cannot be animated");
            return Err(Diagnostic::invalid(&format!("{pointer}/target/node"), message));
        }
        let kind = ChannelValueKind::for_property(property);
        let curve = self.read_sampler(json.sampler.value(), kind, &format!("{pointer}/sampler"))?;
        Ok(AnimationChannel { target: AnimationTarget::Node { node, property }, curve })
    }

    /// Reads a channel whose target is a JSON pointer (KHR_animation_pointer).
    ///
    /// # Errors
    /// Fails if the pointer does not identify a supported property, or the curve is invalid.
    fn read_pointer_channel(
        &self,
        targets: &mut AnimatedObjects<'_>,
        json: &PointerChannel,
    ) -> Result<AnimationChannel, Diagnostic> {
        let pointer = format!("/animations/{}/channels/{}", self.animation, json.channel);
        let Some((target, kind)) =
            animation_pointer::resolve_pointer(self.source.root, targets, &json.target)
        else {
            let pointer = format!("{pointer}/target/extensions/KHR_animation_pointer/pointer");
            let message = format!("\"{}\" is not a property that can be animated", json.target);
            return Err(Diagnostic::invalid(&pointer, message));
        };
        let curve = self.read_sampler(json.sampler, kind, &format!("{pointer}/sampler"))?;
        Ok(AnimationChannel { target, curve })
    }

    /// Reads the curve of a sampler; `pointer` is the member that refers to it.
    ///
    /// # Errors
    /// Fails if the sampler does not exist or its curve is invalid.
    fn read_sampler(
        &self,
        sampler: usize,
        kind: ChannelValueKind,
        pointer: &str,
    ) -> Result<AnimationCurve, Diagnostic> {
        let Some(json) = self.samplers.get(sampler) else {
            return Err(Diagnostic::unresolved_index(
                pointer,
                "sampler",
                sampler,
                self.samplers.len(),
            ));
        };
        self.read_curve(json, kind, &format!("/animations/{}/samplers/{sampler}", self.animation))
    }

    /// Reads keyframe times and values, and checks that their counts match.
    ///
    /// The number of values per keyframe depends on the property: 3 for translation and scale, 4
    /// for rotation, and one per morph target for weights. Cubic splines have three times as many:
    /// in-tangent, value and out-tangent.
    ///
    /// # Errors
    /// Fails if the interpolation is unknown, times do not increase, or there are too few or too
    /// many values.
    fn read_curve(
        &self,
        json: &json::animation::Sampler,
        kind: ChannelValueKind,
        pointer: &str,
    ) -> Result<AnimationCurve, Diagnostic> {
        let interpolation = match json.interpolation {
            // Linear interpolation of rotations is spherical (glTF 2.0, appendix C.4).
            Checked::Valid(JsonInterpolation::Linear) if kind == ChannelValueKind::Rotation => {
                Interpolation::Spherical
            }
            Checked::Valid(JsonInterpolation::Linear) => Interpolation::Linear,
            Checked::Valid(JsonInterpolation::Step) => Interpolation::Step,
            Checked::Valid(JsonInterpolation::CubicSpline) => Interpolation::CubicSpline,
            Checked::Invalid => {
                let pointer = format!("{pointer}/interpolation");
                return Err(Diagnostic::invalid(&pointer, "unknown interpolation"));
            }
        };
        let times = self.read_key_times(json.input.value(), &format!("{pointer}/input"))?;
        let (accessor, pointer) = (json.output.value(), format!("{pointer}/output"));
        let values = match kind {
            ChannelValueKind::TranslationOrScale => {
                self.read_values::<3>(accessor, &TRANSLATION_OR_SCALE, &pointer)?
            }
            ChannelValueKind::Weights | ChannelValueKind::Numbers(1) => {
                self.read_values::<1>(accessor, &SCALAR_VALUES, &pointer)?
            }
            ChannelValueKind::Numbers(2) => {
                self.read_values::<2>(accessor, &VEC2_VALUES, &pointer)?
            }
            ChannelValueKind::Numbers(3) => {
                self.read_values::<3>(accessor, &VEC3_VALUES, &pointer)?
            }
            ChannelValueKind::Rotation | ChannelValueKind::Numbers(_) => {
                self.read_values::<4>(accessor, &ROTATION, &pointer)?
            }
        };
        let rows = if interpolation == Interpolation::CubicSpline { 3 } else { 1 } * times.len();
        let width = match kind {
            ChannelValueKind::TranslationOrScale => 3,
            ChannelValueKind::Rotation => 4,
            ChannelValueKind::Weights => values.len() / rows,
            ChannelValueKind::Numbers(width) => width,
        };
        if values.len() != rows * width || width == 0 {
            let message = format!(
                "wrong number of values: {} for {}",
                counted(values.len(), "value", "values"),
                counted(times.len(), "key", "keys")
            );
            return Err(Diagnostic::invalid(&pointer, message));
        }
        Ok(AnimationCurve { interpolation, times, values, components: width })
    }

    /// Reads the keyframe times: at least one, finite and strictly increasing.
    ///
    /// The binary search and the division by time differences are safe only if times strictly
    /// increase.
    ///
    /// # Errors
    /// Fails if the accessor is not a SCALAR of floats, or the times violate the rules.
    fn read_key_times(&self, accessor: usize, pointer: &str) -> Result<Vec<f32>, Diagnostic> {
        let elements = self.source.resolve_accessor(accessor, pointer)?;
        if (elements.element_type, elements.component_type) != (Type::Scalar, ComponentType::F32) {
            return Err(Diagnostic::invalid(pointer, "the times must be floats of type SCALAR"));
        }
        let times = self.source.read_floats::<1>(&elements)?.into_flattened();
        let rise = times.windows(2).all(|pair| pair[0] < pair[1]);
        if times.is_empty() || !rise || times.iter().any(|time| !time.is_finite()) {
            return Err(Diagnostic::invalid(
                pointer,
                "the times must be finite and strictly increasing",
            ));
        }
        Ok(times)
    }

    /// Reads the values as one flat array of finite numbers.
    ///
    /// # Errors
    /// Fails if the format is not allowed, or a value is not finite.
    fn read_values<const N: usize>(
        &self,
        accessor: usize,
        format: &AllowedFormats,
        pointer: &str,
    ) -> Result<Vec<f32>, Diagnostic> {
        let mut elements = self.source.resolve_accessor(accessor, pointer)?;
        format.check_elements(&elements, pointer)?;
        // Integers are normalized even without `normalized`: keyframe values have no other integer
        // format, and some exporters omit the flag.
        elements.normalized = true;
        let values = self.source.read_floats::<N>(&elements)?.into_flattened();
        if values.iter().all(|value| value.is_finite()) {
            return Ok(values);
        }
        Err(Diagnostic::invalid(pointer, "a value is not a finite number"))
    }
}
