//! Validation of animations: samplers, channels and their targets (glTF 2.0 §3.11).
//!
//! ```text
//!  channel ──sampler──► sampler ──input───► times, one for each keyframe
//!     │                    └──────output──► 1 value per keyframe (CUBICSPLINE: 3), × targets
//!     └──target──► node and path, or a JSON pointer (KHR_animation_pointer)
//! ```

use super::codes::{self, DiagnosticCode};
use super::data::{ElementRule, ElementRules};
use super::document::{
    CheckedDocument, array_items, extension_object, index_member, integer_member, string_member,
};
use super::formats;
use super::layout::{AccessorLayout, ComponentType, SCALAR};
use super::usage::{AccessorUse, UsageMap};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt::Display;

/// Validates all animations, and records rules for the elements of their accessors.
///
/// Samplers are validated first, because channels refer to them; unused samplers get a note.
///
/// The number of weights depends on the number of morph targets, which is taken from the mesh's
/// first primitive; the other primitives must match it.
pub(super) fn check_animations(
    document: &CheckedDocument<'_>,
    usage: &UsageMap<'_>,
    demands: &mut ElementRules,
) {
    let targets = |mesh: &Value| {
        array_items(mesh, "primitives").first().map_or(0, |p| array_items(p, "targets").len())
    };
    let targets: Vec<usize> = document.root_array("meshes").iter().map(targets).collect();
    for (at, animation) in document.root_array("animations").iter().enumerate() {
        let samplers = array_items(animation, "samplers");
        let mut checker = AnimationChecker {
            document,
            usage,
            demands: &mut *demands,
            samplers,
            targets: &targets,
            pointer: format!("/animations/{at}"),
        };
        for (number, sampler) in samplers.iter().enumerate() {
            checker.check_sampler(number, sampler);
        }
        let mut known = BTreeSet::new();
        let mut used = vec![false; samplers.len()];
        for (number, channel) in array_items(animation, "channels").iter().enumerate() {
            if let Some(slot) = index_member(channel, "sampler").and_then(|at| used.get_mut(at)) {
                *slot = true;
            }
            checker.check_channel(number, channel, &mut known);
        }
        for number in (0..used.len()).filter(|&number| !used[number]) {
            checker.report(
                &codes::UNUSED_OBJECT,
                &format!("samplers/{number}"),
                "unused: no channel refers to it",
            );
        }
    }
}

/// The context for validating one animation.
struct AnimationChecker<'a, 'd> {
    document: &'a CheckedDocument<'a>,
    usage: &'a UsageMap<'a>,
    /// The rules for accessor elements, collected for the pass over the data.
    demands: &'d mut ElementRules,
    /// The animation's samplers; channels refer to them by index.
    samplers: &'a [Value],
    /// The number of morph targets of each mesh.
    targets: &'a [usize],
    /// The JSON pointer of the animation.
    pointer: String,
}

impl<'a> AnimationChecker<'a, '_> {
    /// Reports a diagnostic at a member of the animation.
    fn report(&self, code: &DiagnosticCode, member: &str, message: impl Display) {
        self.document.diagnostics.add(code, format_args!("{}/{member}", self.pointer), message);
    }

    /// Returns the JSON of an accessor, if it exists.
    fn accessor_json(&self, at: Option<usize>) -> Option<&'a Value> {
        self.document.root_array("accessors").get(at?)
    }

    /// Validates the accessors of a sampler: their uses, their strides, and the keyframe times.
    ///
    /// Keyframes are stored contiguously: their buffer views must not have a `byteStride`, which is
    /// meant for interleaved vertex attributes.
    fn check_sampler(&mut self, number: usize, sampler: &Value) {
        for (key, role) in [("input", AccessorUse::Input), ("output", AccessorUse::Output)] {
            let Some(at) = index_member(sampler, key) else { continue };
            let member = format!("samplers/{number}/{key}");
            let pointer = format!("{}/{member}", self.pointer);
            if self.accessor_json(Some(at)).is_none() {
                continue;
            }
            self.usage.note_accessor(at, role, &pointer);
            if self.usage.has_stride(at) {
                let message = "byteStride must not be set on this buffer view";
                self.report(&codes::ANIMATION_SAMPLER_ACCESSOR_WITH_BYTESTRIDE, &member, message);
            }
            if role == AccessorUse::Input {
                self.check_input(at, sampler, &member, &pointer);
            }
        }
    }

    /// Validates that keyframe times are float scalars with bounds, and that a cubic spline has at
    /// least two keyframes.
    ///
    /// `min` and `max` are required here, because players derive the duration of an animation from
    /// them without reading the data. A cubic spline with one keyframe has no segment to
    /// interpolate.
    fn check_input(&mut self, at: usize, sampler: &Value, member: &str, pointer: &str) {
        let Some(accessor) = self.accessor_json(Some(at)) else { return };
        if accessor.get("min").is_none() || accessor.get("max").is_none() {
            let message = "an accessor with keyframe times must have min and max";
            self.report(&codes::ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS, member, message);
        }
        let Some(layout) = AccessorLayout::from_accessor(accessor) else { return };
        if (layout.element_type, layout.component_type, layout.normalized)
            == (SCALAR, ComponentType::F32, false)
        {
            self.demands.add(at, ElementRule::Times, pointer);
        } else {
            let message =
                format_args!("keyframe times cannot have the format {}", layout.format_name());
            self.report(&codes::ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT, member, message);
        }
        if string_member(sampler, "interpolation") == Some("CUBICSPLINE") && layout.count < 2 {
            let message = "a cubic spline needs at least two keyframes";
            self.report(&codes::ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS, member, message);
        }
    }

    /// Validates that a channel's sampler exists, and that its target can be animated and is not
    /// already animated by another channel.
    ///
    /// `known` contains the targets of the preceding channels, as pairs of node and path.
    ///
    /// With two channels for one property, the result would depend on the order of evaluation.
    /// The values for a JSON pointer are not checked here, because only the loader resolves their
    /// type.
    fn check_channel(
        &mut self,
        number: usize,
        channel: &'a Value,
        known: &mut BTreeSet<(usize, &'a str)>,
    ) {
        let Some(target) = channel.get("target").filter(|target| target.is_object()) else {
            return;
        };
        let member = format!("channels/{number}");
        let path = string_member(target, "path").unwrap_or("");
        let has_pointer = extension_object(target, "KHR_animation_pointer").is_some();
        if has_pointer {
            self.check_pointer_target(target, path, &member);
        }
        let node = index_member(target, "node");
        if let Some(node) = node.filter(|_| !has_pointer) {
            if !known.insert((node, path)) {
                let message = format_args!(
                    "duplicate target: another channel animates the {path} of node {node}"
                );
                self.report(
                    &codes::ANIMATION_DUPLICATE_TARGETS,
                    &format!("{member}/target"),
                    message,
                );
            }
            self.check_node_target(node, path, &member);
        }
        let Some(at) = index_member(channel, "sampler") else { return };
        let Some(sampler) = self.samplers.get(at) else {
            let count = self.samplers.len();
            let message = format_args!("sampler {at} does not exist: the array has length {count}");
            return self.report(
                &codes::UNRESOLVED_REFERENCE,
                &format!("{member}/sampler"),
                message,
            );
        };
        let mesh = node
            .and_then(|node| index_member(self.document.root_array("nodes").get(node)?, "mesh"));
        let targets = mesh.and_then(|mesh| self.targets.get(mesh).copied()).unwrap_or(0);
        self.check_output(sampler, path, targets as u64, &format!("{member}/sampler"));
    }

    /// Validates a target specified by a JSON pointer (KHR_animation_pointer): the path is
    /// `pointer`, and the node is absent.
    ///
    /// The extension fixes both members so that readers without support for it ignore the channel.
    fn check_pointer_target(&self, target: &Value, path: &str, member: &str) {
        if path != "pointer" {
            let message = format_args!(
                "with KHR_animation_pointer, the path must be \"pointer\", not {path:?}"
            );
            let code = &codes::KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_PATH;
            self.report(code, &format!("{member}/target/path"), message);
        }
        if target.get("node").is_some() {
            let message = "with KHR_animation_pointer, the target must not have a node";
            let code = &codes::KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_NODE;
            self.report(code, &format!("{member}/target/node"), message);
        }
    }

    /// Validates a target node: morph weights need morph targets, and a node with a matrix cannot
    /// be animated, because an animation replaces its translation, rotation or scale.
    fn check_node_target(&self, at: usize, path: &str, member: &str) {
        let Some(node) = self.document.root_array("nodes").get(at) else { return };
        let member = format!("{member}/target");
        if path == "weights" {
            let targets = index_member(node, "mesh").and_then(|mesh| self.targets.get(mesh));
            if targets.is_none_or(|&targets| targets == 0) {
                let message = format_args!("node {at} has no morph targets");
                let code = &codes::ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS;
                self.report(code, &member, message);
            }
        } else if node.get("matrix").is_some() {
            let message = format_args!("node {at} cannot be animated, because it has a matrix");
            self.report(&codes::ANIMATION_CHANNEL_TARGET_NODE_MATRIX, &member, message);
        }
    }

    /// Validates the format and the number of a channel's values.
    ///
    /// There is one value per keyframe, or one per keyframe and target for morph weights. A cubic
    /// spline has three times as many: in-tangents, values and out-tangents (glTF 2.0 §3.11).
    ///
    /// Quaternions must also have unit length; this is tested when the data is read. If the count
    /// is wrong, the loader cannot assign values to keyframes and skips the channel.
    fn check_output(&mut self, sampler: &Value, path: &str, targets: u64, member: &str) {
        let at = index_member(sampler, "output");
        let Some(layout) = self.accessor_json(at).and_then(AccessorLayout::from_accessor) else {
            return;
        };
        let spline = string_member(sampler, "interpolation") == Some("CUBICSPLINE");
        let Some(formats) = formats::animation_output_formats(path) else { return };
        if !formats::is_allowed(layout, &formats) {
            let message = format_args!("{path} cannot have the format {}", layout.format_name());
            self.report(&codes::ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT, member, message);
        } else if path == "rotation" {
            let pointer = format!("{}/{member}", self.pointer);
            self.demands.add(at.unwrap_or(0), ElementRule::Quaternions { spline }, &pointer);
        }
        let keys = self
            .accessor_json(index_member(sampler, "input"))
            .and_then(|a| integer_member(a, "count"));
        let each = if path == "weights" { targets } else { 1 } * if spline { 3 } else { 1 };
        let expected = keys.unwrap_or(0).saturating_mul(each);
        if expected != 0 && expected != layout.count {
            let message = format_args!(
                "the output accessor's count is {}, expected {expected}",
                layout.count
            );
            self.report(&codes::ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT, member, message);
        }
    }
}
