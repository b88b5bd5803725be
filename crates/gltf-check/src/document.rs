//! The document under validation: its raw JSON, the diagnostics so far, and which objects are used.
//!
//! The functions in this module treat members of the wrong type as missing, because the schema walk
//! has already reported them.

use super::diagnostics::Diagnostics;
use super::schema::Collection;
use serde_json::{Map, Value};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// A document under validation.
pub(super) struct CheckedDocument<'a> {
    /// The root of the JSON.
    pub(super) root: &'a Value,
    /// The collection that receives the diagnostics of every check.
    pub(super) diagnostics: &'a Diagnostics,
    /// For each collection, whether each of its objects is used.
    used_flags: RefCell<Vec<Vec<bool>>>,
    /// The names in `extensionsUsed`.
    extensions: BTreeSet<&'a str>,
}

impl<'a> CheckedDocument<'a> {
    /// Prepares a document for validation.
    pub(super) fn new(root: &'a Value, diagnostics: &'a Diagnostics) -> Self {
        let count = |(_, pointer, _): (Collection, &str, bool)| {
            root.pointer(pointer).and_then(Value::as_array).map_or(0, Vec::len)
        };
        let used = Collection::ALL.map(|collection| vec![false; count(collection)]).into();
        let extensions =
            array_items(root, "extensionsUsed").iter().filter_map(Value::as_str).collect();
        Self { root, diagnostics, used_flags: RefCell::new(used), extensions }
    }

    /// Returns the items of a top-level array.
    pub(super) fn root_array(&self, key: &str) -> &'a [Value] {
        array_items(self.root, key)
    }

    /// Marks an object as used. Returns `false` if it does not exist.
    pub(super) fn mark_used(&self, collection: Collection, index: u64) -> bool {
        let mut used = self.used_flags.borrow_mut();
        let list = used.get_mut(collection as usize);
        let slot = list.and_then(|list| list.get_mut(usize::try_from(index).ok()?));
        slot.map(|slot| *slot = true).is_some()
    }

    /// Returns the indices of a collection's objects that nothing refers to.
    pub(super) fn unused_indices(&self, collection: Collection) -> Vec<usize> {
        let used = self.used_flags.borrow();
        let list = used.get(collection as usize).into_iter().flatten();
        list.enumerate().filter(|(_, used)| !**used).map(|(at, _)| at).collect()
    }

    /// Returns whether an extension is listed in `extensionsUsed`.
    pub(super) fn uses_extension(&self, extension: &str) -> bool {
        self.extensions.contains(extension)
    }
}

/// Returns the items of an array member; the slice is empty if the member is absent or not an
/// array.
pub(super) fn array_items<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

/// Returns the contents of a member that is an object.
pub(super) fn object_members<'a>(value: &'a Value, key: &str) -> Option<&'a Map<String, Value>> {
    value.get(key).and_then(Value::as_object)
}

/// Converts a non-negative integer, which may be written as `1` or as `1.0`.
pub(super) fn as_whole_number(value: &Value) -> Option<u64> {
    // The cast saturates: a number too large for u64 becomes u64::MAX, which is also out of range.
    let from_float = |number: f64| (number >= 0.0 && number % 1.0 == 0.0).then_some(number as u64);
    value.as_u64().or_else(|| from_float(value.as_f64()?))
}

/// Returns a member if it is a non-negative integer.
pub(super) fn integer_member(value: &Value, key: &str) -> Option<u64> {
    as_whole_number(value.get(key)?)
}

/// Returns a member if it is an index.
pub(super) fn index_member(value: &Value, key: &str) -> Option<usize> {
    usize::try_from(integer_member(value, key)?).ok()
}

/// Returns a member if it is a string.
pub(super) fn string_member<'a>(value: &'a Value, key: &str) -> Option<&'a str> {
    value.get(key)?.as_str()
}

/// Returns a member if it is an array of `N` numbers.
pub(super) fn number_array<const N: usize>(value: &Value, key: &str) -> Option<[f64; N]> {
    let numbers: Option<Vec<f64>> = value.get(key)?.as_array()?.iter().map(Value::as_f64).collect();
    numbers?.try_into().ok()
}

/// Returns the extension with this name in an object.
pub(super) fn extension_object<'a>(value: &'a Value, name: &str) -> Option<&'a Value> {
    value.get("extensions")?.get(name)
}

/// Escapes a name as a JSON pointer token (RFC 6901 §3).
pub(super) fn escape_pointer_token(name: &str) -> String {
    name.replace('~', "~0").replace('/', "~1")
}
