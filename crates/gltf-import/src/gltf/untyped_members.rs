//! JSON members that the `gltf` crate's types lack, collected before deserialization.
//!
//! These are animation channels whose target is a JSON pointer (KHR_animation_pointer), and the
//! texture coordinates and colors of morph targets, which glTF 2.0 §3.7.2.2 allows in addition to
//! positions, normals and tangents.

use serde_json::Value;
use std::collections::BTreeMap;

/// Members that deserialization would lose.
#[derive(Debug, Default)]
pub(super) struct UntypedMembers {
    /// Channels with pointers, in the order of the file.
    pub(super) pointer_channels: Vec<PointerChannel>,
    /// The additional attributes of morph targets by mesh, primitive and target index: the
    /// attribute names with their accessors.
    pub(super) extra_morph_attributes: BTreeMap<(usize, usize, usize), Vec<(String, usize)>>,
}

/// An animation channel whose target is a JSON pointer (KHR_animation_pointer).
#[derive(Debug, PartialEq, Eq)]
pub(super) struct PointerChannel {
    /// Index of the animation.
    pub(super) animation: usize,
    /// Index of the channel in the animation.
    pub(super) channel: usize,
    /// Index of the sampler in the animation; out of range if the file does not specify it.
    pub(super) sampler: usize,
    /// JSON pointer to the animated property.
    pub(super) target: String,
}

impl UntypedMembers {
    /// Collects the members from a document. Members of unexpected types are skipped, because
    /// deserialization will reject them.
    pub(super) fn collect_from(document: &Value) -> Self {
        Self {
            pointer_channels: collect_pointer_channels(document),
            extra_morph_attributes: collect_morph_attributes(document),
        }
    }
}

/// Iterates over the items of an array member with their indices; empty if the member is absent.
fn indexed_items<'a>(json: &'a Value, key: &str) -> impl Iterator<Item = (usize, &'a Value)> {
    json.get(key).and_then(Value::as_array).into_iter().flatten().enumerate()
}

/// Returns the index in a JSON number. If it is absent, returns `usize::MAX`, which is always out
/// of range.
fn index_or_max(value: Option<&Value>) -> usize {
    value.and_then(Value::as_u64).and_then(|at| usize::try_from(at).ok()).unwrap_or(usize::MAX)
}

/// Collects the animation channels whose target has the extension KHR_animation_pointer.
fn collect_pointer_channels(document: &Value) -> Vec<PointerChannel> {
    let mut collected = Vec::new();
    for (animation, json) in indexed_items(document, "animations") {
        for (channel, json) in indexed_items(json, "channels") {
            let target = json.pointer("/target/extensions/KHR_animation_pointer/pointer");
            if let Some(target) = target.and_then(Value::as_str) {
                let (sampler, target) = (index_or_max(json.get("sampler")), target.to_owned());
                collected.push(PointerChannel { animation, channel, sampler, target });
            }
        }
    }
    collected
}

/// Collects the texture coordinates and colors of morph targets by mesh, primitive and target
/// index.
fn collect_morph_attributes(
    document: &Value,
) -> BTreeMap<(usize, usize, usize), Vec<(String, usize)>> {
    let mut collected = BTreeMap::new();
    for (mesh, json) in indexed_items(document, "meshes") {
        for (primitive_index, json) in indexed_items(json, "primitives") {
            for (target, json) in indexed_items(json, "targets") {
                let members = json.as_object().into_iter().flatten();
                let further = members
                    .filter(|(name, _)| name.starts_with("TEXCOORD_") || name.starts_with("COLOR_"))
                    .map(|(name, accessor)| (name.clone(), index_or_max(Some(accessor))));
                let further: Vec<_> = further.collect();
                if !further.is_empty() {
                    collected.insert((mesh, primitive_index, target), further);
                }
            }
        }
    }
    collected
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn pointers_and_morph_attributes_are_collected() {
        let pointer = json!({"KHR_animation_pointer": {"pointer": "/nodes/0/scale"}});
        let untyped = UntypedMembers::collect_from(&json!({
            "animations": [{"channels": [
                {"sampler": 0, "target": {"node": 0, "path": "scale"}},
                {"sampler": 2, "target": {"path": "pointer", "extensions": pointer}},
                {"target": {"path": "pointer", "extensions": {"KHR_animation_pointer": 7}}},
            ]}],
            "meshes": [{"primitives": [{}, {"targets": [
                {"POSITION": 1, "NORMAL": 2},
                {"POSITION": 1, "COLOR_0": 3, "TEXCOORD_1": 4},
            ]}]}],
        }));
        let target = "/nodes/0/scale".to_owned();
        let channel = PointerChannel { animation: 0, channel: 1, sampler: 2, target };
        assert_eq!(untyped.pointer_channels, [channel]);
        let further = vec![("COLOR_0".to_owned(), 3), ("TEXCOORD_1".to_owned(), 4)];
        assert_eq!(untyped.extra_morph_attributes, BTreeMap::from([((0, 1, 1), further)]));
        assert!(
            UntypedMembers::collect_from(&json!({"animations": 3, "meshes": [7]}))
                .pointer_channels
                .is_empty()
        );
    }
}
