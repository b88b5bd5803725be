//! A document under check: its JSON as it stands in the file, and what has been found so far.
//!
//! Everything here answers "what does the file say?" for members that may be missing or of any type: `None` then, and the
//! walk over the schema has told so already.

use super::findings::Findings;
use super::schema::Collection;
use serde_json::{Map, Value};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// A document under check.
pub(super) struct Document<'a> {
    pub(super) root: &'a Value,
    pub(super) findings: &'a Findings,
    /// Which things of each collection something refers to.
    used: RefCell<Vec<Vec<bool>>>,
    /// The extensions that the file says it uses.
    extensions: BTreeSet<&'a str>,
}

impl<'a> Document<'a> {
    pub(super) fn new(root: &'a Value, findings: &'a Findings) -> Self {
        let count = |(_, pointer, _): (Collection, &str, bool)| {
            root.pointer(pointer).and_then(Value::as_array).map_or(0, Vec::len)
        };
        let used = Collection::ALL.map(|collection| vec![false; count(collection)]).into();
        let extensions = items(root, "extensionsUsed").iter().filter_map(Value::as_str).collect();
        Self { root, findings, used: RefCell::new(used), extensions }
    }

    /// The things of an array at the top of the document.
    pub(super) fn all(&self, key: &str) -> &'a [Value] {
        items(self.root, key)
    }

    /// How many things a collection has, and that this one is used; `false` if it does not exist.
    pub(super) fn refer(&self, collection: Collection, index: u64) -> bool {
        let mut used = self.used.borrow_mut();
        let list = used.get_mut(collection as usize);
        let slot = list.and_then(|list| list.get_mut(usize::try_from(index).ok()?));
        slot.map(|slot| *slot = true).is_some()
    }

    /// The numbers of the things of a collection that nothing refers to.
    pub(super) fn unused(&self, collection: Collection) -> Vec<usize> {
        let used = self.used.borrow();
        let list = used.get(collection as usize).into_iter().flatten();
        list.enumerate().filter(|(_, used)| !**used).map(|(at, _)| at).collect()
    }

    /// Whether the file says that it uses an extension.
    pub(super) fn uses(&self, extension: &str) -> bool {
        self.extensions.contains(extension)
    }
}

/// The items of an array that is a member of an object.
pub(super) fn items<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

/// The members of an object that is a member of an object.
pub(super) fn members<'a>(value: &'a Value, key: &str) -> Option<&'a Map<String, Value>> {
    value.get(key).and_then(Value::as_object)
}

/// A whole number that is not negative, written as `1` or as `1.0`.
pub(super) fn whole(value: &Value) -> Option<u64> {
    // What is too large for an integer is larger than anything there is, and so is the largest integer.
    let from_float = |number: f64| (number >= 0.0 && number % 1.0 == 0.0).then_some(number as u64);
    value.as_u64().or_else(|| from_float(value.as_f64()?))
}

/// A member that is a whole number.
pub(super) fn integer(value: &Value, key: &str) -> Option<u64> {
    whole(value.get(key)?)
}

/// A member that is an index.
pub(super) fn index(value: &Value, key: &str) -> Option<usize> {
    usize::try_from(integer(value, key)?).ok()
}

/// A member that is a text.
pub(super) fn text<'a>(value: &'a Value, key: &str) -> Option<&'a str> {
    value.get(key)?.as_str()
}

/// A member that is an array of `N` numbers.
pub(super) fn numbers<const N: usize>(value: &Value, key: &str) -> Option<[f64; N]> {
    let numbers: Option<Vec<f64>> = value.get(key)?.as_array()?.iter().map(Value::as_f64).collect();
    numbers?.try_into().ok()
}

/// An extension's object in an object.
pub(super) fn extension<'a>(value: &'a Value, name: &str) -> Option<&'a Value> {
    value.get("extensions")?.get(name)
}

/// A name as a part of a JSON pointer (RFC 6901 §3).
pub(super) fn escaped(name: &str) -> String {
    name.replace('~', "~0").replace('/', "~1")
}
