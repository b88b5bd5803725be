//! Reading a JSON document into types, with the place of the first fault.
//!
//! A deserializer that steps into lists and objects itself and notes where it is; everything else
//! is `serde_json`'s. Wrapping its deserializer from outside, as `serde_path_to_error` does, takes
//! a second copy of the code of every type of glTF.

use serde::de::value::BorrowedStrDeserializer;
use serde::de::{Deserialize, DeserializeSeed, Deserializer, Error as _, Visitor};
use serde::de::{MapAccess, SeqAccess, Unexpected};
use serde_json::{Error, Map, Value};
use std::cell::RefCell;

/// Reads a document.
///
/// # Errors
/// The first fault: the JSON pointer to it (RFC 6901), and what is wrong.
pub(super) fn deserialize_located<'de, T: Deserialize<'de>>(
    value: &'de Value,
) -> Result<T, (String, Error)> {
    let path = RefCell::new(Vec::new());
    let located = LocatedJson { value, path: &path };
    T::deserialize(located).map_err(|error| {
        let pointer = path.borrow().iter().map(Step::to_pointer).collect();
        (pointer, error)
    })
}

/// A step from a list or an object to what is in it.
enum Step<'de> {
    Index(usize),
    Key(&'de str),
}

impl Step<'_> {
    fn to_pointer(&self) -> String {
        match self {
            Self::Index(index) => format!("/{index}"),
            Self::Key(key) => format!("/{}", key.replace('~', "~0").replace('/', "~1")),
        }
    }
}

/// The steps to where reading is; after a fault, to the fault.
type Path<'de> = RefCell<Vec<Step<'de>>>;

/// A value of the document, at the end of the path.
#[derive(Clone, Copy)]
struct LocatedJson<'de, 'p> {
    value: &'de Value,
    path: &'p Path<'de>,
}

impl<'de> LocatedJson<'de, '_> {
    fn visit_items<V: Visitor<'de>>(
        self,
        items: &'de [Value],
        visitor: V,
    ) -> Result<V::Value, Error> {
        let depth = self.path.borrow().len();
        let mut access = Items { items: items.iter(), next: 0, depth, path: self.path };
        let read = visitor.visit_seq(&mut access)?;
        if access.items.len() == 0 {
            return Ok(read);
        }
        Err(Error::invalid_length(items.len(), &"fewer elements in array"))
    }

    fn visit_members<V: Visitor<'de>>(
        self,
        members: &'de Map<String, Value>,
        visitor: V,
    ) -> Result<V::Value, Error> {
        let depth = self.path.borrow().len();
        let mut access = Members { members: members.iter(), value: None, depth, path: self.path };
        let read = visitor.visit_map(&mut access)?;
        if access.members.len() == 0 {
            return Ok(read);
        }
        Err(Error::invalid_length(members.len(), &"fewer elements in map"))
    }
}

/// Methods whose values are neither lists nor objects.
macro_rules! leave_to_serde_json {
    ($($method:ident)*) => {$(
        fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
            self.value.$method(visitor)
        }
    )*};
}

/// Methods whose values are lists or objects. Not even their errors are left to `serde_json`: that
/// would compile its reading of each type.
macro_rules! step_into {
    ($($method:ident($($type:ty),*))*) => {$(
        fn $method<V: Visitor<'de>>(self, $(_: $type,)* visitor: V) -> Result<V::Value, Error> {
            match self.value {
                Value::Array(items) => self.visit_items(items, visitor),
                Value::Object(members) => self.visit_members(members, visitor),
                leaf => Err(Error::invalid_type(unexpected(leaf), &visitor)),
            }
        }
    )*};
}

/// A value that is neither a list nor an object, for messages.
fn unexpected(leaf: &Value) -> Unexpected<'_> {
    match leaf {
        Value::Bool(value) => Unexpected::Bool(*value),
        Value::String(text) => Unexpected::Str(text),
        Value::Number(number) => match (number.as_u64(), number.as_i64()) {
            (Some(value), _) => Unexpected::Unsigned(value),
            (None, Some(value)) => Unexpected::Signed(value),
            (None, None) => Unexpected::Float(number.as_f64().unwrap_or_default()),
        },
        _ => Unexpected::Unit,
    }
}

impl<'de> Deserializer<'de> for LocatedJson<'de, '_> {
    type Error = Error;

    leave_to_serde_json! {
        deserialize_bool deserialize_i8 deserialize_i16 deserialize_i32 deserialize_i64
        deserialize_i128 deserialize_u8 deserialize_u16 deserialize_u32 deserialize_u64
        deserialize_u128 deserialize_f32 deserialize_f64 deserialize_char deserialize_str
        deserialize_string deserialize_bytes deserialize_byte_buf deserialize_unit
        deserialize_identifier deserialize_ignored_any
    }

    step_into! {
        deserialize_seq()
        deserialize_tuple(usize)
        deserialize_tuple_struct(&'static str, usize)
        deserialize_map()
        deserialize_struct(&'static str, &'static [&'static str])
    }

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self.value {
            Value::Null => visitor.visit_unit(),
            Value::Bool(value) => visitor.visit_bool(*value),
            Value::Number(number) => number.deserialize_any(visitor),
            Value::String(text) => visitor.visit_borrowed_str(text),
            Value::Array(items) => self.visit_items(items, visitor),
            Value::Object(members) => self.visit_members(members, visitor),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        if self.value.is_null() { visitor.visit_none() } else { visitor.visit_some(self) }
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.value.deserialize_unit_struct(name, visitor)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Error> {
        // A type of its own, which takes the text as it is.
        if name.starts_with("$serde_json") {
            return self.value.deserialize_newtype_struct(name, visitor);
        }
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.value.deserialize_enum(name, variants, visitor)
    }
}

/// Reads a value one step further along a path. The step is taken back if there is no fault.
fn step<'de, S: DeserializeSeed<'de>>(
    path: &Path<'de>,
    (depth, step): (usize, Step<'de>),
    value: &'de Value,
    seed: S,
) -> Result<S::Value, Error> {
    let mut steps = path.borrow_mut();
    // A fault before this may have been forgiven.
    steps.truncate(depth);
    steps.push(step);
    drop(steps);
    let read = seed.deserialize(LocatedJson { value, path })?;
    path.borrow_mut().truncate(depth);
    Ok(read)
}

/// The items of a list.
struct Items<'de, 'p> {
    items: std::slice::Iter<'de, Value>,
    next: usize,
    depth: usize,
    path: &'p Path<'de>,
}

impl<'de> SeqAccess<'de> for Items<'de, '_> {
    type Error = Error;

    fn next_element_seed<S: DeserializeSeed<'de>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, Error> {
        let Some(value) = self.items.next() else { return Ok(None) };
        let place = (self.depth, Step::Index(self.next));
        self.next += 1;
        step(self.path, place, value, seed).map(Some)
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.items.len())
    }
}

/// The members of an object.
struct Members<'de, 'p> {
    members: serde_json::map::Iter<'de>,
    /// The member whose key has been read, and whose value comes next.
    value: Option<(&'de str, &'de Value)>,
    depth: usize,
    path: &'p Path<'de>,
}

impl<'de> MapAccess<'de> for Members<'de, '_> {
    type Error = Error;

    fn next_key_seed<S: DeserializeSeed<'de>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, Error> {
        let Some((key, value)) = self.members.next() else { return Ok(None) };
        self.value = Some((key, value));
        seed.deserialize(BorrowedStrDeserializer::<Error>::new(key)).map(Some)
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, Error> {
        let (key, value) = self.value.take().ok_or_else(|| Error::custom("value is missing"))?;
        step(self.path, (self.depth, Step::Key(key)), value, seed)
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.members.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;
    use std::collections::BTreeMap;

    type Document = BTreeMap<String, Vec<(u8, Option<bool>)>>;

    #[test]
    fn what_fits_is_read() {
        let value = json!({"a": [[1, true], [2, null]], "b": []});
        let read: Document = deserialize_located(&value).unwrap();
        assert_eq!(read["a"], [(1, Some(true)), (2, None)]);
        assert!(read["b"].is_empty());
    }

    #[test]
    fn faults_have_the_pointer_and_the_words_of_serde_json() {
        for (value, pointer) in [
            (json!({"a": [[1, true], [2, 3]]}), "/a/1/1"),
            (json!({"a": [[1, true], [256, true]]}), "/a/1/0"),
            (json!({"a": [], "b/~": [[1]]}), "/b~1~0/0"),
            (json!({"a": [[1, true, 0]]}), "/a/0"),
            (json!({"a": [[1, true], null]}), "/a/1"),
            (json!({"a": {"x": [1]}}), "/a"),
            (json!({"a": -1}), "/a"),
            (json!({"a": 0.5}), "/a"),
            (json!({"a": "x"}), "/a"),
            (json!({"a": true}), "/a"),
            (json!(7), ""),
        ] {
            let (found, error) = deserialize_located::<Document>(&value).unwrap_err();
            let expected = Document::deserialize(&value).unwrap_err();
            assert_eq!((found.as_str(), error.to_string()), (pointer, expected.to_string()));
        }
    }
}
