//! Animations: samplers, channels, and what they move (glTF 2.0 §3.11).

use super::codes::{self, Code};
use super::data::{Demand, Demands};
use super::document::{Document, extension, index, integer, items, text};
use super::formats;
use super::layout::{Component, Layout, SCALAR};
use super::usage::{Usage, Use};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt::Display;

/// Checks all animations; notes what is demanded of accessors.
pub(super) fn check(document: &Document<'_>, usage: &Usage<'_>, demands: &mut Demands) {
    let targets =
        |mesh: &Value| items(mesh, "primitives").first().map_or(0, |p| items(p, "targets").len());
    let targets: Vec<usize> = document.all("meshes").iter().map(targets).collect();
    for (at, animation) in document.all("animations").iter().enumerate() {
        let samplers = items(animation, "samplers");
        let mut checker = Checker {
            document,
            usage,
            demands: &mut *demands,
            samplers,
            targets: &targets,
            pointer: format!("/animations/{at}"),
        };
        for (number, sampler) in samplers.iter().enumerate() {
            checker.sampler(number, sampler);
        }
        let mut known = BTreeSet::new();
        let mut used = vec![false; samplers.len()];
        for (number, channel) in items(animation, "channels").iter().enumerate() {
            if let Some(slot) = index(channel, "sampler").and_then(|at| used.get_mut(at)) {
                *slot = true;
            }
            checker.channel(number, channel, &mut known);
        }
        for number in (0..used.len()).filter(|&number| !used[number]) {
            checker.say(&codes::UNUSED_OBJECT, &format!("samplers/{number}"), "no channel uses it");
        }
    }
}

struct Checker<'a, 'd> {
    document: &'a Document<'a>,
    usage: &'a Usage<'a>,
    demands: &'d mut Demands,
    samplers: &'a [Value],
    /// How many morph targets each mesh has.
    targets: &'a [usize],
    pointer: String,
}

impl<'a> Checker<'a, '_> {
    fn say(&self, code: &Code, member: &str, message: impl Display) {
        self.document.findings.add(code, format_args!("{}/{member}", self.pointer), message);
    }

    fn accessor(&self, at: Option<usize>) -> Option<&'a Value> {
        self.document.all("accessors").get(at?)
    }

    fn sampler(&mut self, number: usize, sampler: &Value) {
        for (key, role) in [("input", Use::Input), ("output", Use::Output)] {
            let Some(at) = index(sampler, key) else { continue };
            let member = format!("samplers/{number}/{key}");
            let pointer = format!("{}/{member}", self.pointer);
            if self.accessor(Some(at)).is_none() {
                continue;
            }
            self.usage.accessor(at, role, &pointer);
            if self.usage.has_stride(at) {
                let message = "the view must not have a stride";
                self.say(&codes::ANIMATION_SAMPLER_ACCESSOR_WITH_BYTESTRIDE, &member, message);
            }
            if role == Use::Input {
                self.input(at, sampler, &member, &pointer);
            }
        }
    }

    fn input(&mut self, at: usize, sampler: &Value, member: &str, pointer: &str) {
        let Some(accessor) = self.accessor(Some(at)) else { return };
        if accessor.get("min").is_none() || accessor.get("max").is_none() {
            let message = "the accessor of times must have min and max";
            self.say(&codes::ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS, member, message);
        }
        let Some(layout) = Layout::of(accessor) else { return };
        if (layout.shape, layout.component, layout.normalized) == (SCALAR, Component::F32, false) {
            self.demands.add(at, Demand::Times, pointer);
        } else {
            let message = format_args!("times cannot be {}", layout.format());
            self.say(&codes::ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT, member, message);
        }
        if text(sampler, "interpolation") == Some("CUBICSPLINE") && layout.count < 2 {
            let message = "a spline needs two keys";
            self.say(&codes::ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS, member, message);
        }
    }

    fn channel(
        &mut self,
        number: usize,
        channel: &'a Value,
        known: &mut BTreeSet<(usize, &'a str)>,
    ) {
        let Some(target) = channel.get("target").filter(|target| target.is_object()) else {
            return;
        };
        let member = format!("channels/{number}");
        let path = text(target, "path").unwrap_or("");
        let has_pointer = extension(target, "KHR_animation_pointer").is_some();
        if has_pointer {
            self.by_pointer(target, path, &member);
        }
        let node = index(target, "node");
        if let Some(node) = node.filter(|_| !has_pointer) {
            if !known.insert((node, path)) {
                let message = format_args!("another channel moves the {path} of node {node}");
                self.say(&codes::ANIMATION_DUPLICATE_TARGETS, &format!("{member}/target"), message);
            }
            self.node(node, path, &member);
        }
        let Some(at) = index(channel, "sampler") else { return };
        let Some(sampler) = self.samplers.get(at) else {
            let count = self.samplers.len();
            let message = format_args!("there is no sampler {at}: there are {count}");
            return self.say(&codes::UNRESOLVED_REFERENCE, &format!("{member}/sampler"), message);
        };
        let mesh = node.and_then(|node| index(self.document.all("nodes").get(node)?, "mesh"));
        let targets = mesh.and_then(|mesh| self.targets.get(mesh).copied()).unwrap_or(0);
        self.output(sampler, path, targets as u64, &format!("{member}/sampler"));
    }

    fn by_pointer(&self, target: &Value, path: &str, member: &str) {
        if path != "pointer" {
            let message = format_args!("with a pointer the path must be \"pointer\", not {path:?}");
            let code = &codes::KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_PATH;
            self.say(code, &format!("{member}/target/path"), message);
        }
        if target.get("node").is_some() {
            let message = "with a pointer there must be no node";
            let code = &codes::KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_NODE;
            self.say(code, &format!("{member}/target/node"), message);
        }
    }

    fn node(&self, at: usize, path: &str, member: &str) {
        let Some(node) = self.document.all("nodes").get(at) else { return };
        let member = format!("{member}/target");
        if path == "weights" {
            let targets = index(node, "mesh").and_then(|mesh| self.targets.get(mesh));
            if targets.is_none_or(|&targets| targets == 0) {
                let message = format_args!("node {at} has no morph targets");
                let code = &codes::ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS;
                self.say(code, &member, message);
            }
        } else if node.get("matrix").is_some() {
            let message = format_args!("node {at} has a matrix, which cannot be animated");
            self.say(&codes::ANIMATION_CHANNEL_TARGET_NODE_MATRIX, &member, message);
        }
    }

    fn output(&mut self, sampler: &Value, path: &str, targets: u64, member: &str) {
        let at = index(sampler, "output");
        let Some(layout) = self.accessor(at).and_then(Layout::of) else { return };
        let spline = text(sampler, "interpolation") == Some("CUBICSPLINE");
        let Some(formats) = formats::outputs(path) else { return };
        if !formats::is_one_of(layout, &formats) {
            let message = format_args!("the {path} cannot be {}", layout.format());
            self.say(&codes::ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT, member, message);
        } else if path == "rotation" {
            let pointer = format!("{}/{member}", self.pointer);
            self.demands.add(at.unwrap_or(0), Demand::Quaternions { spline }, &pointer);
        }
        let keys = self.accessor(index(sampler, "input")).and_then(|a| integer(a, "count"));
        let each = if path == "weights" { targets } else { 1 } * if spline { 3 } else { 1 };
        let due = keys.unwrap_or(0).saturating_mul(each);
        if due != 0 && due != layout.count {
            let message = format_args!("there are {} values, and {due} are due", layout.count);
            self.say(&codes::ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT, member, message);
        }
    }
}
