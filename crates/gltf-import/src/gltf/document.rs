//! JSON parsing: from bytes to the `gltf` crate's JSON types, via `serde_json::Value`.
//!
//! On their own, these types reject valid files (an integer written as `1.0`, a scene without
//! nodes, an animation channel without a target) and accept invalid files (an index of 2³² becomes
//! 0). Both problems are fixed in the `Value` before it is converted to these types. The nesting
//! depth and the number of values are limited before any value is built.
//!
//! ```text
//!  bytes ─limits─► Value ─normalize─► Value ─┬─ transforms in f64
//!                                           ├─ members without a type
//!                                           └─ gltf::json::Root
//! ```

use super::json_repair;
use super::node_transform::NodeTransform;
use super::untyped_members::UntypedMembers;
use crate::limits::Limits;
use crate::warnings::ImportWarnings;
use gltf::json::Root;
use model::{Diagnostic, codes};
use serde_json::{Map, Number, Value};

/// The parsed JSON of a file.
///
/// Parsing is complete before any buffer is read, so rejecting a file that is not glTF costs no
/// more than parsing it.
#[derive(Debug)]
pub(super) struct GltfDocument {
    /// The file's content except for the node transforms. Its indices have not been checked.
    pub(super) root: Root,
    /// The local transforms of the nodes, with finite numbers. The `gltf` crate would round them to
    /// single precision.
    pub(super) node_transforms: Vec<NodeTransform>,
    /// Members that the JSON types lack.
    pub(super) untyped: UntypedMembers,
}

impl GltfDocument {
    /// Parses and normalizes the JSON. In lenient mode, members of the wrong type are skipped.
    ///
    /// The order of the steps matters: untyped members are collected before channels without a
    /// target node are dropped, because channels with animation pointers have no target node.
    ///
    /// # Errors
    /// Fails if the text is not JSON, exceeds a limit, has an unsupported version, or has a member
    /// of the wrong type.
    pub(super) fn parse_json(
        text: &[u8],
        limits: &Limits,
        warnings: &mut ImportWarnings,
    ) -> Result<Self, Diagnostic> {
        check_json_limits(text, limits)?;
        let mut value: Value =
            serde_json::from_slice(text).map_err(|error| syntax_error(&error))?;
        check_gltf_version(&value, warnings)?;
        normalize_value(&mut value);
        insert_missing_scene_nodes(&mut value);
        let untyped = UntypedMembers::collect_from(&value);
        drop_untargeted_channels(&mut value);
        let placements = NodeTransform::take_transforms(&mut value, warnings)?;
        let root = json_repair::deserialize_document(&mut value, text.len(), warnings)?;
        Ok(Self { root, node_transforms: placements, untyped })
    }
}

/// Checks the nesting depth and the number of values against the limits, without building anything.
///
/// Text outside strings is scanned for brackets and commas. This is exact for well-formed JSON; for
/// other text an upper bound is enough. `serde_json` itself always stops at a depth of 128.
///
/// # Errors
/// Returns [`LIMIT_EXCEEDED`](model::codes::LIMIT_EXCEEDED) for `json_depth` or `json_values`.
///
/// An object counts as ten values, because it takes roughly ten times the memory of a number. The
/// time is linear in the length of the text, and strings are skipped in blocks.
pub fn check_json_limits(text: &[u8], limits: &Limits) -> Result<(), Diagnostic> {
    let (mut depth, mut values) = (0usize, 1usize);
    let mut at = 0;
    while let Some(&byte) = text.get(at) {
        at += 1;
        match byte {
            b'"' => at = end_of_string(text, at),
            b'[' | b'{' => {
                depth += 1;
                values += if byte == b'{' { 10 } else { 1 };
                if depth > limits.json_depth.min(127) {
                    let what = format!("brackets are nested {depth} levels deep at byte {at}");
                    return Err(Diagnostic::limit_exceeded(
                        "",
                        &what,
                        "json_depth",
                        limits.json_depth as u64,
                    ));
                }
            }
            b']' | b'}' => depth = depth.saturating_sub(1),
            b',' => values += 1,
            _ => {}
        }
    }
    if values > limits.json_values {
        let what = format!("the JSON has {values} values");
        return Err(Diagnostic::limit_exceeded(
            "",
            &what,
            "json_values",
            limits.json_values as u64,
        ));
    }
    Ok(())
}

/// Returns the position after the quote that ends the string containing `at`.
///
/// The character after a backslash is skipped, because it may be a quote. An unterminated string
/// extends to the end of the text; the JSON parser reports it.
fn end_of_string(text: &[u8], mut at: usize) -> usize {
    loop {
        // Data URIs may have megabytes without a quote, so skip whole blocks.
        while let Some(block) = text.get(at..at + 32) {
            if block.iter().fold(false, |found, &b| found | (b == b'"') | (b == b'\\')) {
                break;
            }
            at += 32;
        }
        match text.get(at) {
            None => return text.len(),
            Some(b'"') => return at + 1,
            Some(b'\\') => at += 2,
            Some(_) => at += 1,
        }
    }
}

/// Checks `asset.version` and `asset.minVersion`; only glTF 2.x is read.
///
/// A newer minor version is accepted, as the specification requires. A newer `minVersion` is an
/// error, or a warning in lenient mode. This check runs before the conversion to typed structs,
/// because a glTF 1.0 file would otherwise fail with a message about an arbitrary member.
fn check_gltf_version(value: &Value, warnings: &mut ImportWarnings) -> Result<(), Diagnostic> {
    let asset = &value["asset"];
    let Some(version) = asset["version"].as_str() else {
        let message = "the glTF version is missing";
        let help = if value["asset"].is_null() && value["models"].is_array() {
            "if this is a scene, write it in RON, for example \
             Scene(models: [(path: \"model.glb\")]), in a file that ends in .ron"
        } else {
            "check that this is a glTF file; a glTF 2.0 file contains \
             \"asset\": {\"version\": \"2.0\"}"
        };
        return Err(Diagnostic::error(
            codes::UNSUPPORTED_VERSION,
            "/asset/version",
            message.to_owned(),
            help,
        ));
    };
    let unknown = |key: &str, version: &str| {
        Diagnostic::error(
            codes::UNSUPPORTED_VERSION,
            &format!("/asset/{key}"),
            format!("the file is glTF {version}, but only glTF 2.0 is supported"),
            "convert it to glTF 2.0",
        )
    };
    if version.split('.').next() != Some("2") {
        return Err(unknown("version", version));
    }
    match asset["minVersion"].as_str() {
        Some(minimum) if minimum != "2.0" => {
            warnings.downgrade_if_lenient(unknown("minVersion", minimum), "it is read as glTF 2.0")
        }
        _ => Ok(()),
    }
}

/// Members whose numbers may exceed 32 bits.
///
/// Buffers may exceed 4 GiB, but the `gltf` crate stores indices in 32 bits.
const WIDE_MEMBERS: [&str; 3] = ["byteLength", "byteOffset", "count"];

/// Converts numbers such as `1.0` to integers, and removes `extras`.
///
/// `extras` contains application data, which may be large and of any type, and is not used here.
fn normalize_value(value: &mut Value) {
    match value {
        Value::Array(items) => items.iter_mut().for_each(normalize_value),
        Value::Object(members) => normalize_members(members),
        Value::Number(number) => *number = normalize_number(number, false),
        _ => {}
    }
}

/// Normalizes the members of an object. Their names determine which integers may exceed 32 bits.
fn normalize_members(members: &mut Map<String, Value>) {
    members.remove("extras");
    for (key, value) in members {
        match value {
            Value::Number(number) => {
                *number = normalize_number(number, WIDE_MEMBERS.contains(&key.as_str()));
            }
            _ => normalize_value(value),
        }
    }
}

/// Converts an integral number to an integer if it fits. Otherwise, it becomes floating point,
/// which the types reject as an index instead of using its lowest 32 bits.
///
/// `1.0` is a valid integer in JSON Schema, and some exporters write all numbers with a fractional
/// part.
fn normalize_number(number: &Number, wide: bool) -> Number {
    let limit = if wide { u64::MAX } else { u64::from(u32::MAX) };
    match (number.as_u64(), number.as_f64()) {
        (Some(integer), _) if integer <= limit => number.clone(),
        (Some(_), Some(float)) => Number::from_f64(float).unwrap_or_else(|| number.clone()),
        (None, Some(float)) if float >= 0.0 && float <= limit as f64 && float % 1.0 == 0.0 => {
            Number::from(float as u64)
        }
        _ => number.clone(),
    }
}

/// Adds an empty `nodes` to scenes without it, because it is optional in the specification but not
/// in the type.
fn insert_missing_scene_nodes(value: &mut Value) {
    for scene in objects_in(value, "scenes") {
        scene.entry("nodes").or_insert_with(|| Value::Array(Vec::new()));
    }
}

/// Removes animation channels without a target node. They must be ignored (glTF 2.0 §3.11);
/// channels that use KHR_animation_pointer have already been collected.
fn drop_untargeted_channels(value: &mut Value) {
    for animation in objects_in(value, "animations") {
        if let Some(Value::Array(channels)) = animation.get_mut("channels") {
            channels.retain(|c| c["target"].is_null() || !c["target"]["node"].is_null());
        }
    }
}

/// Returns the objects in a top-level array of the document.
fn objects_in<'a>(
    value: &'a mut Value,
    key: &str,
) -> impl Iterator<Item = &'a mut Map<String, Value>> {
    let items = value.get_mut(key).and_then(Value::as_array_mut);
    items.into_iter().flatten().filter_map(Value::as_object_mut)
}

/// Returns the error for text that is not JSON.
fn syntax_error(error: &serde_json::Error) -> Diagnostic {
    let message = format!("the JSON is not well formed: {error}");
    Diagnostic::error(codes::NOT_GLTF, "", message, "correct the JSON, or export the file again")
}

/// Returns the error for a member with the wrong type, with the JSON pointer to it.
///
/// The `gltf` crate's phrase for an index is replaced by plainer wording.
pub(super) fn type_error(pointer: &str, message: &str) -> Diagnostic {
    Diagnostic::invalid(pointer, message.replace("index into child of root", "an index"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(members: &str) -> Result<GltfDocument, Diagnostic> {
        let text = format!(r#"{{"asset": {{"version": "2.0"}}{members}}}"#);
        GltfDocument::parse_json(
            text.as_bytes(),
            &Limits::default(),
            &mut ImportWarnings::default(),
        )
    }

    #[test]
    fn unusual_but_valid_files_are_read() {
        let document = parse(
            r#", "scene": 0.0, "scenes": [{}], "buffers": [{"byteLength": 12.0}],
               "animations": [{"samplers": [], "channels": [{"sampler": 0, "target": {"path": "pointer"}}]}]"#,
        )
        .unwrap();
        assert_eq!(document.root.scene.unwrap().value(), 0);
        assert_eq!(document.root.buffers[0].byte_length.0, 12);
        assert!(document.root.animations[0].channels.is_empty());
    }

    #[test]
    fn errors_have_a_json_pointer() {
        for (members, pointer, message) in [
            (r#", "nodes": 3"#, "/nodes", "invalid type: integer `3`, expected a sequence"),
            (
                r#", "nodes": [{"mesh": "x"}]"#,
                "/nodes/0/mesh",
                "invalid type: string \"x\", expected an index",
            ),
            (
                r#", "scene": 4294967296"#,
                "/scene",
                "invalid type: floating point `4294967296.0`, expected an index",
            ),
            (r#", "meshes": [{}]"#, "/meshes/0", "missing field `primitives`"),
        ] {
            let diagnostic = parse(members).unwrap_err();
            assert_eq!((&*diagnostic.location, &*diagnostic.message), (pointer, message));
        }
    }

    #[test]
    fn unsupported_versions_are_rejected() {
        let message = |asset: &str| {
            let text = format!("{{{asset}}}");
            let document = GltfDocument::parse_json(
                text.as_bytes(),
                &Limits::default(),
                &mut ImportWarnings::default(),
            );
            document.err().map(|diagnostic| diagnostic.message)
        };
        assert_eq!(message(r#""asset": {"version": "2.1"}"#), None);
        assert_eq!(
            message(r#""asset": {"version": "1.0"}"#).unwrap(),
            "the file is glTF 1.0, but only glTF 2.0 is supported"
        );
        assert_eq!(
            message(r#""asset": {"version": "2.1", "minVersion": "2.1"}"#).unwrap(),
            "the file is glTF 2.1, but only glTF 2.0 is supported"
        );
        assert_eq!(message("").unwrap(), "the glTF version is missing");
    }

    #[test]
    fn depth_and_value_count_are_limited() {
        let deep = format!(r#", "extras": {}"#, "[".repeat(100_000));
        let diagnostic = parse(&deep).unwrap_err();
        assert_eq!(diagnostic.code, codes::LIMIT_EXCEEDED);
        assert!(diagnostic.sentence().contains("json_depth"), "{diagnostic}");
        let text = br#"{"asset": {"version": "2.0"}, "extras": "[[[[[[[\"[[[["}"#;
        let limits = Limits { json_depth: 2, json_values: 24, ..Limits::default() };
        let parse =
            |text: &[u8]| GltfDocument::parse_json(text, &limits, &mut ImportWarnings::default());
        assert!(parse(text).is_ok(), "brackets in strings do not count");
        let fault = parse(b"[{},{},{}]").unwrap_err();
        assert!(fault.sentence().contains("json_values"), "{diagnostic}");
    }
}
