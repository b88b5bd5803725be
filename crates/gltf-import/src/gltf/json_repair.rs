//! Lenient JSON deserialization: removes members of the wrong type so that the rest can be loaded.
//!
//! Deserialization into typed structs is all or nothing: one mesh without primitives makes the
//! whole document fail. So the offending member is removed and deserialization is tried again. If
//! the member is mandatory, the item that contains it is replaced by an empty item, so that the
//! indices of all other items stay the same.

use super::document::type_error;
use crate::warnings::ImportWarnings;
use gltf::json::Root;
use model::Diagnostic;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Total bytes of JSON that may be deserialized again: enough for ten repairs of a six-megabyte
/// file, or hundreds of repairs of a small file.
const REPAIR_BYTE_BUDGET: usize = 64 << 20;

/// Maximum number of repairs in a file of any size.
const MAX_REPAIRS: usize = 500;

/// Deserializes a document. In lenient mode, skips parts of the wrong type. `length` is the length
/// of the document's text.
///
/// In strict mode, the first mistake is an error. Each pass finds one mistake, so the cost is the
/// number of mistakes times the length of the text; the budget limits this for hostile files.
///
/// # Errors
/// Fails if a mistake cannot or must not be repaired, or the budget is exhausted.
pub(super) fn deserialize_document(
    value: &mut Value,
    length: usize,
    warnings: &mut ImportWarnings,
) -> Result<Root, Diagnostic> {
    let mut repairs_left = (REPAIR_BYTE_BUDGET / length.max(1)).min(MAX_REPAIRS);
    loop {
        let diagnostic = match deserialize_root(value) {
            Ok(root) => return Ok(root),
            Err(diagnostic) => diagnostic,
        };
        let repaired = if repairs_left > 0 { repair_at(value, &diagnostic.location) } else { None };
        let Some(consequence) = repaired else { return Err(diagnostic) };
        warnings.downgrade_if_lenient(diagnostic, consequence)?;
        repairs_left -= 1;
    }
}

/// Serializes the value and deserializes the text. The text parser is already compiled for the
/// types of the `gltf` crate, and the column of an error locates the offending value.
///
/// # Errors
/// Returns the first mistake.
fn deserialize_root(value: &Value) -> Result<Root, Diagnostic> {
    let text = value.to_string();
    Root::from_str(&text).map_err(|error| {
        // The text is well formed, so only an array with too many items stops the parser early, one
        // byte into the first extra item.
        let place = if error.is_syntax() {
            Place::Within(error.column() - 1)
        } else {
            Place::At(error.column())
        };
        let mut pointer = String::new();
        end_unless_found(value, 0, &place, &mut pointer);
        let message = match (&place, value.pointer(&pointer).and_then(Value::as_array)) {
            (Place::Within(_), Some(items)) => {
                format!("invalid length {}, expected fewer elements in the array", items.len())
            }
            _ => {
                let message = error.to_string();
                message.rsplit_once(" at line ").map_or("", |(message, _)| message).to_owned()
            }
        };
        type_error(&pointer, &message)
    })
}

/// A value in serialized JSON, identified by a byte offset.
enum Place {
    /// The value that ends at this offset, or the array or object that begins there.
    At(usize),
    /// The innermost value that contains this offset.
    Within(usize),
}

/// Searches a value, whose text begins at `start`, for a place.
///
/// Returns the end of the value, or `None` if the value is or contains the place; `pointer` then
/// points to the place.
fn end_unless_found(
    value: &Value,
    start: usize,
    place: &Place,
    pointer: &mut String,
) -> Option<usize> {
    let is_container = value.is_array() || value.is_object();
    if is_container && matches!(place, Place::At(offset) if *offset == start) {
        return None;
    }
    let parent = pointer.len();
    let mut end = start + usize::from(is_container);
    match value {
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                let _ = write!(pointer, "/{index}");
                // Each item is followed by a comma or the closing bracket.
                end = end_unless_found(item, end, place, pointer)? + 1;
                pointer.truncate(parent);
            }
            // An empty container still has two brackets.
            end = end.max(start + 2);
        }
        Value::Object(members) => {
            for (key, member) in members {
                let _ = write!(pointer, "/{}", key.replace('~', "~0").replace('/', "~1"));
                let colon = json!(key).to_string().len();
                end = end_unless_found(member, end + colon + 1, place, pointer)? + 1;
                pointer.truncate(parent);
            }
            end = end.max(start + 2);
        }
        leaf => end += leaf.to_string().len(),
    }
    let (Place::At(offset) | Place::Within(offset)) = *place;
    (offset <= start || offset > end).then_some(end)
}

/// Removes the member at a pointer, or empties the item that contains it. Returns a description of
/// the repair, or `None` if no repair is possible.
///
/// The repair depends on the depth of the pointer. If a whole collection is wrong, it is removed;
/// if an item is wrong, it is emptied. If a member inside an item is wrong, the member is removed,
/// or the item is emptied if that does not help.
fn repair_at(document: &mut Value, pointer: &str) -> Option<&'static str> {
    let steps: Vec<&str> = pointer.split('/').skip(1).collect();
    match *steps.as_slice() {
        [] => None,
        [collection] => {
            document.as_object_mut()?.remove(collection).map(|_| "all of it is skipped")
        }
        [collection, at] => replace_with_empty(document, collection, at),
        [collection, at, ..] => {
            let removed = remove_member(document, pointer);
            removed.or_else(|| replace_with_empty(document, collection, at))
        }
    }
}

/// Lists whose items are not referred to by index, so that a single item can be removed.
const UNREFERENCED_LISTS: [&str; 4] = ["primitives", "channels", "children", "nodes"];

/// Removes a member of an object or an item of one of the [`UNREFERENCED_LISTS`]. Items of other
/// arrays are referred to by index or position, as in `joints`, so the whole array is removed
/// instead.
fn remove_member(document: &mut Value, pointer: &str) -> Option<&'static str> {
    let (parent, last) = pointer.rsplit_once('/')?;
    let name = parent.rsplit('/').next()?;
    match document.pointer_mut(parent)? {
        Value::Object(members) => {
            let key = last.replace("~1", "/").replace("~0", "~");
            members.remove(&key).map(|_| "it is skipped")
        }
        Value::Array(items) if UNREFERENCED_LISTS.contains(&name) => {
            let at = last.parse().ok().filter(|&at: &usize| at < items.len())?;
            items.remove(at);
            Some("it is skipped")
        }
        Value::Array(_) => remove_member(document, parent),
        _ => None,
    }
}

/// Replaces an item in a top-level collection with an empty item.
///
/// Empty items have only the members needed for deserialization; references to them are reported as
/// errors. Returns `None` if the item is already empty, which ends the repair.
fn replace_with_empty(document: &mut Value, collection: &str, at: &str) -> Option<&'static str> {
    let nothing = match collection {
        "accessors" => json!({"componentType": 5126, "count": 0, "type": "SCALAR"}),
        "animations" => json!({"channels": [], "samplers": []}),
        "buffers" => json!({"byteLength": 0}),
        "bufferViews" => json!({"buffer": 0, "byteLength": 0}),
        "cameras" => json!({"type": "none"}),
        "images" | "materials" | "nodes" | "samplers" | "textures" => json!({}),
        "meshes" => json!({"primitives": []}),
        "scenes" => json!({"nodes": []}),
        "skins" => json!({"joints": []}),
        // Items of this collection are not referred to by index, so remove the whole member.
        _ => {
            let members = document.as_object_mut()?;
            return members.remove(collection).map(|_| "all of it is skipped");
        }
    };
    let slot = document.get_mut(collection)?.as_array_mut()?.get_mut(at.parse::<usize>().ok()?)?;
    let changes = *slot != nothing;
    *slot = nothing;
    changes.then_some("it is replaced by an empty item")
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::codes;

    fn deserialize_with_warnings(mut document: Value) -> (Result<Root, Diagnostic>, Vec<String>) {
        let mut warnings = ImportWarnings::new(true);
        let root = deserialize_document(&mut document, 1000, &mut warnings);
        let messages =
            warnings.into_list().into_iter().map(|w| format!("{} {}", w.location, w.message));
        (root, messages.collect())
    }

    #[test]
    fn mistyped_members_are_skipped_and_indices_preserved() {
        let (root, messages) = deserialize_with_warnings(json!({
            "asset": {"version": "2.0"},
            "extensionsUsed": ["a", 7],
            "meshes": [
                {},
                {"primitives": [{"attributes": 5}, {"attributes": {"POSITION": 0}}]},
                {"primitives": "none"}
            ],
            "nodes": [{"mesh": "x", "children": [1, null]}, 3],
            "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 2, "red", 1], "metallicFactor": 0}}],
            "textures": 1,
        }));
        let root = root.expect("a document");
        let primitives: Vec<usize> = root.meshes.iter().map(|mesh| mesh.primitives.len()).collect();
        assert_eq!(primitives, [0, 1, 0], "{messages:#?}");
        assert_eq!((root.nodes.len(), root.textures.len()), (2, 0));
        assert_eq!(root.nodes[0].children.as_ref().map(Vec::len), Some(1));
        assert_eq!(root.materials[0].pbr_metallic_roughness.metallic_factor.0, 0.0);
        assert!(
            messages.iter().any(|line| line.starts_with("/meshes/0 missing field `primitives`"))
        );
        assert!(messages.iter().any(|line| line.starts_with("/nodes/1 ")), "{messages:#?}");
    }

    #[test]
    fn errors_have_a_pointer_and_the_serde_json_message() {
        for (document, pointer, message) in [
            (json!({"nodes": 3}), "/nodes", "invalid type: integer `3`, expected a sequence"),
            (json!({"nodes": {"x": [1]}}), "/nodes", "invalid type: map, expected a sequence"),
            (
                json!({"nodes": [{}, {"children": [0, true]}]}),
                "/nodes/1/children/1",
                "invalid type: boolean `true`, expected an index",
            ),
            (
                json!({"nodes": [{}, {"children": [0, [7]]}]}),
                "/nodes/1/children/1",
                "invalid type: sequence, expected an index",
            ),
            (
                json!({"nodes": [{}, {"children": [0, 0.5]}]}),
                "/nodes/1/children/1",
                "invalid type: floating point `0.5`, expected an index",
            ),
            (json!({"nodes": [null]}), "/nodes/0", "invalid type: null, expected struct Node"),
            (
                json!({"extensionsUsed": ["/~\"\n", {}]}),
                "/extensionsUsed/1",
                "invalid type: map, expected a string",
            ),
            (
                json!({"materials": [{"emissiveFactor": [1, 2]}]}),
                "/materials/0/emissiveFactor",
                "invalid length 2, expected an array of length 3",
            ),
            (
                json!({"materials": [{"emissiveFactor": [1, 2, 3, 4, 5]}]}),
                "/materials/0/emissiveFactor",
                "invalid length 5, expected fewer elements in the array",
            ),
            (
                json!({"materials": [{"emissiveFactor": [1, 2, 3, [4]]}]}),
                "/materials/0/emissiveFactor",
                "invalid length 4, expected fewer elements in the array",
            ),
            (
                json!({"meshes": [{"primitives": []}, {"name": "a/b"}]}),
                "/meshes/1",
                "missing field `primitives`",
            ),
            (json!(7), "", "invalid type: integer `7`, expected struct Root"),
        ] {
            let mut document = document;
            if let Some(members) = document.as_object_mut() {
                members.insert("asset".to_owned(), json!({"version": "2.0", "a/~": "é\u{7}"}));
            }
            let diagnostic = deserialize_root(&document).unwrap_err();
            assert_eq!((&*diagnostic.location, &*diagnostic.message), (pointer, message));
        }
    }

    #[test]
    fn unrepairable_documents_fail_after_finitely_many_steps() {
        let many: Vec<Value> = (0..2000).map(|_| json!({"primitives": 1})).collect();
        for (document, location) in [
            (json!([]), ""),
            (json!({"asset": 3}), ""),
            (json!({"asset": {"version": "2.0"}, "meshes": many}), "/meshes/250/primitives"),
        ] {
            let diagnostic = deserialize_with_warnings(document).0.unwrap_err();
            assert_eq!((diagnostic.code, &*diagnostic.location), (codes::INVALID_DATA, location));
        }
    }
}
