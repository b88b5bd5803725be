//! Lenient JSON deserialization: removes members of the wrong type so that the rest can be loaded.
//!
//! The typed structs are all or nothing: one mesh without primitives makes the whole document fail.
//! So the offending member is removed. If it is mandatory, the item that contains it is replaced by
//! an empty one, so that all others keep their indices. Then deserialization is tried again.

use super::document::type_error;
use crate::warnings::ImportWarnings;
use gltf::json::Root;
use model::Diagnostic;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Total bytes of JSON that may be deserialized again: ten repairs of a six-megabyte file, hundreds
/// of a small one.
const REPAIR_BYTE_BUDGET: usize = 64 << 20;

/// Maximum number of repairs in one file, however small.
const MAX_REPAIRS: usize = 500;

/// Deserializes a document; in lenient mode, skips the parts that do not fit. `length` is the
/// length of its text.
///
/// In strict mode, the first mistake is the error. Each pass finds one mistake, so the cost is the
/// number of mistakes times the length of the text; the budget limits it for hostile files.
///
/// # Errors
/// Fails if a mistake cannot or must not be repaired, or the budget is spent.
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

/// Deserializes the value's text: the `gltf` crate has already compiled that code for its types,
/// and the column of an error leads back to the value.
///
/// # Errors
/// Returns the first mistake.
fn deserialize_root(value: &Value) -> Result<Root, Diagnostic> {
    let text = value.to_string();
    Root::from_str(&text).map_err(|error| {
        // The text is well-formed, so only an array with too many items ends the parser early. It
        // stops one byte into the first extra item.
        let place = if error.is_syntax() {
            Place::Within(error.column() - 1)
        } else {
            Place::At(error.column())
        };
        let mut pointer = String::new();
        end_unless_found(value, 0, &place, &mut pointer);
        let message = match (&place, value.pointer(&pointer).and_then(Value::as_array)) {
            (Place::Within(_), Some(items)) => {
                format!("invalid length {}, expected fewer elements in array", items.len())
            }
            _ => {
                let message = error.to_string();
                message.rsplit_once(" at line ").map_or("", |(message, _)| message).to_owned()
            }
        };
        type_error(&pointer, &message)
    })
}

/// A value in a text, given by a byte offset.
enum Place {
    /// The value that ends here, or the array or object that begins here.
    At(usize),
    /// The innermost value that extends to both sides of this offset.
    Within(usize),
}

/// Searches the value whose text begins at `start` for a place.
///
/// Returns the end of the value, or `None` if the value is or contains the place: `pointer` then
/// leads to it.
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
                // A comma or the bracket follows each item.
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

/// Removes the member at a pointer, or empties the item that contains it; returns a description of
/// the repair, `None` if none is possible.
///
/// The depth of the pointer decides: an error in a whole collection removes it, one in an item
/// empties the item, and one below removes the member, or empties the item if that does not help.
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

/// Lists whose items are not referred to by index, so that one of them can be removed.
const UNREFERENCED_LISTS: [&str; 4] = ["primitives", "channels", "children", "nodes"];

/// Removes a member of an object or an item of a list; other arrays are removed as a whole.
///
/// Items of other lists are referred to by index or position, as in `joints`, so the whole list is
/// removed instead.
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

/// Replaces an item of a top-level collection by an empty one.
///
/// The empty items are the smallest that deserialize; using one is an error that is reported at its
/// use. `None` if the item is already empty, which ends the repair.
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
        // Not a collection whose items are referred to by index: the whole member is removed.
        _ => {
            let members = document.as_object_mut()?;
            return members.remove(collection).map(|_| "all of it is skipped");
        }
    };
    let slot = document.get_mut(collection)?.as_array_mut()?.get_mut(at.parse::<usize>().ok()?)?;
    let changes = *slot != nothing;
    *slot = nothing;
    changes.then_some("an empty one replaces it")
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
    fn what_does_not_fit_is_left_out_and_the_rest_keeps_its_numbers() {
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
    fn faults_have_the_pointer_and_the_words_of_serde_json() {
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
                "invalid length 5, expected fewer elements in array",
            ),
            (
                json!({"materials": [{"emissiveFactor": [1, 2, 3, [4]]}]}),
                "/materials/0/emissiveFactor",
                "invalid length 4, expected fewer elements in array",
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
    fn what_cannot_be_repaired_is_an_error_after_finitely_many_steps() {
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
