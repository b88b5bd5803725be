//! Animations: key times and values become curves. A channel that cannot be used is left out with a warning.

use super::accessor::Source;
use super::attribute::{Format, KEYS, PAIRS, PLACE, TRIPLES, TURN};
use super::error::Fault;
use super::pointer::{self, Kind};
use super::untyped::PointerChannel;
use super::warnings::Warnings;
use crate::{
    Animation, Channel, Curve, Interpolation, Lens, Material, Node, Property, PunctualLight,
    Target, UvTransform,
};
use gltf::json;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::animation::{Interpolation as JsonInterpolation, Property as JsonProperty};
use gltf::json::validation::Checked;

/// What channels can change, and where textures get their transforms from.
pub(super) struct Targets<'a> {
    pub(super) nodes: &'a [Node],
    pub(super) materials: &'a mut [Material],
    pub(super) lights: &'a [PunctualLight],
    pub(super) cameras: &'a [Lens],
    pub(super) uv_transforms: &'a mut Vec<UvTransform>,
}

/// Reads all animations of a file.
pub(super) fn animations(
    source: &Source<'_>,
    pointers: &[PointerChannel],
    targets: &mut Targets<'_>,
    warnings: &mut Warnings,
) -> Result<Vec<Animation>, Fault> {
    let mut animations = Vec::with_capacity(source.root.animations.len());
    for (at, json) in source.root.animations.iter().enumerate() {
        let mut channels = Vec::with_capacity(json.channels.len());
        let reader = Reader { source, samplers: &json.samplers, animation: at };
        let mut keep = |read: Result<Channel, Fault>| match read {
            Err(fault) if fault.is_soft() => {
                warnings.soft(&fault, "the channel is left out");
                Ok(())
            }
            read => read.map(|channel| channels.push(channel)),
        };
        for (number, channel) in json.channels.iter().enumerate() {
            let pointer = format!("/animations/{at}/channels/{number}");
            keep(reader.channel(targets.nodes, channel, &pointer))?;
        }
        for json in pointers.iter().filter(|json| json.animation == at) {
            keep(reader.pointer_channel(targets, json))?;
        }
        let ends = channels.iter().filter_map(|channel| channel.curve.times.last());
        let duration_seconds = ends.map(|&time| f64::from(time)).fold(0.0, f64::max);
        animations.push(Animation { name: json.name.clone(), channels, duration_seconds });
    }
    Ok(animations)
}

struct Reader<'a> {
    source: &'a Source<'a>,
    samplers: &'a [json::animation::Sampler],
    animation: usize,
}

impl Reader<'_> {
    fn channel(
        &self,
        nodes: &[Node],
        json: &json::animation::Channel,
        pointer: &str,
    ) -> Result<Channel, Fault> {
        let node = json.target.node.value();
        let Some(target) = nodes.get(node) else {
            let pointer = format!("{pointer}/target/node");
            return Err(Fault::unresolved(&pointer, "node", node, nodes.len()));
        };
        let property = match json.target.path {
            Checked::Valid(JsonProperty::Translation) => Property::Translation,
            Checked::Valid(JsonProperty::Rotation) => Property::Rotation,
            Checked::Valid(JsonProperty::Scale) => Property::Scale,
            Checked::Valid(JsonProperty::MorphTargetWeights) => Property::Weights,
            Checked::Invalid => {
                let pointer = format!("{pointer}/target/path");
                return Err(Fault::invalid(&pointer, "the path is not known"));
            }
        };
        if property != Property::Weights && target.parts.is_none() {
            let problem = format!("node {node} has a matrix, which cannot be animated");
            return Err(Fault::invalid(&format!("{pointer}/target/node"), problem));
        }
        let kind = Kind::of(property);
        let curve = self.sampler(json.sampler.value(), kind, &format!("{pointer}/sampler"))?;
        Ok(Channel { target: Target::Node { node, property }, curve })
    }

    /// A channel that names its target by a pointer.
    fn pointer_channel(
        &self,
        targets: &mut Targets<'_>,
        json: &PointerChannel,
    ) -> Result<Channel, Fault> {
        let pointer = format!("/animations/{}/channels/{}", self.animation, json.channel);
        let Some((target, kind)) = pointer::target(self.source.root, targets, &json.target) else {
            let pointer = format!("{pointer}/target/extensions/KHR_animation_pointer/pointer");
            let problem = format!("\"{}\" is nothing that can be animated here", json.target);
            return Err(Fault::invalid(&pointer, problem));
        };
        let curve = self.sampler(json.sampler, kind, &format!("{pointer}/sampler"))?;
        Ok(Channel { target, curve })
    }

    /// The curve of a sampler; `pointer` is the member that names it.
    fn sampler(&self, sampler: usize, kind: Kind, pointer: &str) -> Result<Curve, Fault> {
        let Some(json) = self.samplers.get(sampler) else {
            return Err(Fault::unresolved(pointer, "sampler", sampler, self.samplers.len()));
        };
        self.curve(json, kind, &format!("/animations/{}/samplers/{sampler}", self.animation))
    }

    fn curve(
        &self,
        json: &json::animation::Sampler,
        kind: Kind,
        pointer: &str,
    ) -> Result<Curve, Fault> {
        let interpolation = match json.interpolation {
            Checked::Valid(JsonInterpolation::Linear) if kind == Kind::Rotation => {
                Interpolation::Spherical
            }
            Checked::Valid(JsonInterpolation::Linear) => Interpolation::Linear,
            Checked::Valid(JsonInterpolation::Step) => Interpolation::Step,
            Checked::Valid(JsonInterpolation::CubicSpline) => Interpolation::CubicSpline,
            Checked::Invalid => {
                let pointer = format!("{pointer}/interpolation");
                return Err(Fault::invalid(&pointer, "the interpolation is not known"));
            }
        };
        let times = self.times(json.input.value(), &format!("{pointer}/input"))?;
        let (accessor, pointer) = (json.output.value(), format!("{pointer}/output"));
        let values = match kind {
            Kind::Place => self.values::<3>(accessor, &PLACE, &pointer)?,
            Kind::Weights | Kind::Numbers(1) => self.values::<1>(accessor, &KEYS, &pointer)?,
            Kind::Numbers(2) => self.values::<2>(accessor, &PAIRS, &pointer)?,
            Kind::Numbers(3) => self.values::<3>(accessor, &TRIPLES, &pointer)?,
            Kind::Rotation | Kind::Numbers(_) => self.values::<4>(accessor, &TURN, &pointer)?,
        };
        let rows = if interpolation == Interpolation::CubicSpline { 3 } else { 1 } * times.len();
        let width = match kind {
            Kind::Place => 3,
            Kind::Rotation => 4,
            Kind::Weights => values.len() / rows,
            Kind::Numbers(width) => width,
        };
        if values.len() != rows * width || width == 0 {
            let problem = format!(
                "{} numbers are not enough, or too many, for {} keys",
                values.len(),
                times.len()
            );
            return Err(Fault::invalid(&pointer, problem));
        }
        Ok(Curve { interpolation, times, values, width })
    }

    /// The times of the keys: at least one, finite, rising.
    fn times(&self, accessor: usize, pointer: &str) -> Result<Vec<f32>, Fault> {
        let elements = self.source.elements(accessor, pointer)?;
        if (elements.shape, elements.component) != (Type::Scalar, ComponentType::F32) {
            return Err(Fault::invalid(pointer, "the times must be SCALAR of floats"));
        }
        let times = self.source.floats::<1>(&elements)?.into_flattened();
        let rise = times.windows(2).all(|pair| pair[0] < pair[1]);
        if times.is_empty() || !rise || times.iter().any(|time| !time.is_finite()) {
            return Err(Fault::invalid(pointer, "the times are not finite numbers that rise"));
        }
        Ok(times)
    }

    fn values<const N: usize>(
        &self,
        accessor: usize,
        format: &Format,
        pointer: &str,
    ) -> Result<Vec<f32>, Fault> {
        let mut elements = self.source.elements(accessor, pointer)?;
        format.check(&elements, pointer)?;
        // Integers are normalised even if the file forgot to say so: there is no other way to read them.
        elements.normalized = true;
        let values = self.source.floats::<N>(&elements)?.into_flattened();
        if values.iter().all(|value| value.is_finite()) {
            return Ok(values);
        }
        Err(Fault::invalid(pointer, "a value is not a finite number"))
    }
}
