//! Schema validation: walks a document, guided by the tables in [`schema`](super::schema).
//!
//! Every value is compared with the kind that the tables specify for its member. Every index that
//! resolves marks its target as used, for the notes about unused objects. The codes match the
//! Khronos validator, including its distinction between members and array items.
//!
//! The walk is a recursive descent. [`SchemaWalker::check_value`] dispatches on the kind of a
//! value; for objects and arrays, the walk descends with one more token on the JSON pointer:
//!
//! ```text
//!  check_object ──► check_value ──► check_number, check_index, …   leaves
//!       ▲               │
//!       └───────────────┴─► check_objects, check_object            inner nodes
//! ```
//!
//! The recursion is as deep as the schema, not the file: members that are not in the tables are
//! reported but never entered. The time is linear in the size of the JSON.

use super::codes::{self, DiagnosticCode};
use super::document::{CheckedDocument, as_whole_number, escape_pointer_token};
use super::schema::core::ROOT;
use super::schema::extensions::EXTENSION_OBJECTS;
use super::schema::{Collection, MemberSchema, NumberRange, ObjectSchema, PresenceRule, ValueKind};
use serde_json::{Map, Value};
use std::collections::BTreeSet;
use std::fmt::Display;

/// Validates a whole document against the schema and records all references.
///
/// A root that is not an object ends the walk with a single `TYPE_MISMATCH`. Later checks see
/// missing and mistyped members as absent, so that each defect is reported once, here.
pub(super) fn check_schema(document: &CheckedDocument<'_>) {
    let mut walker = SchemaWalker { document, pointer: String::new() };
    match document.root {
        Value::Object(members) => walker.check_object(members, &ROOT),
        other => walker.report_type_mismatch(other, "an object"),
    }
}

/// The state of the walk: the document and the JSON pointer of the current value.
///
/// One buffer holds the pointer for the whole walk: tokens are appended on the way down and removed
/// on the way up, so a value without a defect requires no allocation.
struct SchemaWalker<'a> {
    /// The document, which records references and diagnostics.
    document: &'a CheckedDocument<'a>,
    /// The JSON pointer of the current value.
    pointer: String,
}

impl SchemaWalker<'_> {
    /// Reports a diagnostic at the current value.
    fn report(&self, code: &DiagnosticCode, message: impl Display) {
        self.document.diagnostics.add(code, &self.pointer, message);
    }

    /// Reports a member of the wrong type.
    fn report_type_mismatch(&self, value: &Value, expected: &str) {
        self.report(&codes::TYPE_MISMATCH, format_args!("{} is not {expected}", ShortValue(value)));
    }

    /// Calls `work` with the token of a member or item appended to the JSON pointer.
    ///
    /// Tokens are escaped as in RFC 6901: `~` becomes `~0` and `/` becomes `~1`. Almost all names
    /// contain neither character and are appended without a copy.
    fn descend(&mut self, name: &str, work: impl FnOnce(&mut Self)) {
        let length = self.pointer.len();
        self.pointer.push('/');
        match name.contains(['~', '/']) {
            true => self.pointer.push_str(&escape_pointer_token(name)),
            false => self.pointer.push_str(name),
        }
        work(self);
        self.pointer.truncate(length);
    }

    /// Validates an object: known, required and unknown members, and extensions.
    ///
    /// The first loop follows the schema and finds missing members; the second follows the file and
    /// finds unknown members. `extras` may contain anything (glTF 2.0 §5.16) and is not entered.
    fn check_object(&mut self, members: &Map<String, Value>, object: &ObjectSchema) {
        for member in object.members {
            match members.get(member.name) {
                Some(value) => {
                    self.descend(member.name, |walker| walker.check_value(value, member.kind));
                }
                None if member.rule == PresenceRule::Required => {
                    let name = member.name;
                    let message = format_args!("missing property `{name}`");
                    // The pointer names the missing member, so that each gets a separate
                    // diagnostic.
                    let diagnostics = &self.document.diagnostics;
                    diagnostics.add(
                        &codes::UNDEFINED_PROPERTY,
                        format_args!("{}/{name}", self.pointer),
                        message,
                    );
                }
                None => {}
            }
            self.check_presence(members, member);
        }
        for (name, value) in members {
            match name.as_str() {
                "extensions" => self.descend(name, |walker| walker.check_extensions(value, object)),
                "extras" => {}
                _ if object.members.iter().any(|member| member.name == name) => {}
                _ => self.descend(name, |walker| {
                    walker.report(&codes::UNEXPECTED_PROPERTY, "unexpected property");
                }),
            }
        }
    }

    /// Validates a member's rule about the presence of other members.
    ///
    /// `UNSATISFIED_DEPENDENCY` is reported at the member that requires another. `ONE_OF_MISMATCH`
    /// is reported at the parent, because neither member is more wrong than the other.
    fn check_presence(&mut self, members: &Map<String, Value>, member: &MemberSchema) {
        let is_there = members.contains_key(member.name);
        match member.rule {
            PresenceRule::Requires(other) if is_there && !members.contains_key(other) => {
                self.descend(member.name, |walker| {
                    let message = format_args!("this property requires `{other}`");
                    walker.report(&codes::UNSATISFIED_DEPENDENCY, message);
                });
            }
            PresenceRule::ExactlyOne(other) if is_there == members.contains_key(other) => {
                let message =
                    format_args!("exactly one of `{}` and `{other}` is required", member.name);
                self.report(&codes::ONE_OF_MISMATCH, message);
            }
            PresenceRule::Excludes(other) if is_there && members.contains_key(other) => {
                let message =
                    format_args!("`{}` and `{other}` are mutually exclusive", member.name);
                self.report(&codes::ONE_OF_MISMATCH, message);
            }
            _ => {}
        }
    }

    /// Validates the member `extensions`, which must be an object with one member per extension
    /// (glTF 2.0 §3.12).
    fn check_extensions(&mut self, value: &Value, parent: &ObjectSchema) {
        let Value::Object(extensions) = value else {
            return self.report_type_mismatch(value, "an object");
        };
        for (name, value) in extensions {
            self.descend(name, |walker| walker.check_extension(name, value, parent));
        }
    }

    /// Validates an extension object: it must be declared, and allowed in this parent.
    ///
    /// For extensions that are not in the tables, only the declaration is checked. A known
    /// extension in an object where its specification does not allow it is an
    /// `UNEXPECTED_EXTENSION_OBJECT`; its members are not validated, because their meaning there is
    /// unknown.
    fn check_extension(&mut self, name: &str, value: &Value, parent: &ObjectSchema) {
        if !self.document.uses_extension(name) {
            let message = format_args!("the extension is not listed in {}", "/extensionsUsed");
            self.report(&codes::UNDECLARED_EXTENSION, message);
        }
        let Value::Object(members) = value else {
            return self.report_type_mismatch(value, "an object");
        };
        let mut places = EXTENSION_OBJECTS.iter().filter(|place| place.name == name).peekable();
        if places.peek().is_none() {
            return;
        }
        match places.find(|place| place.parent == parent.name) {
            Some(place) => self.check_object(members, &place.object),
            None => {
                let message = format_args!(
                    "this extension is not allowed in an object of type `{}`",
                    parent.name
                );
                self.report(&codes::UNEXPECTED_EXTENSION_OBJECT, message);
            }
        }
    }

    /// Validates any value, according to its kind in the schema.
    fn check_value(&mut self, value: &Value, kind: ValueKind) {
        match kind {
            ValueKind::Any => {}
            ValueKind::Boolean if value.is_boolean() => {}
            ValueKind::Boolean => self.report_type_mismatch(value, "true or false"),
            ValueKind::Text if value.is_string() => {}
            ValueKind::Text => self.report_type_mismatch(value, "a string"),
            ValueKind::Version => self.check_version(value),
            ValueKind::EnumString(words) => self.check_enum_string(value, words),
            ValueKind::Integer(min, max) => self.check_integer(value, min, max),
            ValueKind::EnumInteger(numbers) => self.check_enum_integer(value, numbers),
            ValueKind::Number(range) => match value.as_f64() {
                Some(number) => self.check_number(number, range),
                None => self.report_type_mismatch(value, "a number"),
            },
            ValueKind::Numbers(length, range) => self.check_numbers(value, length, range),
            ValueKind::Index(collection) => self.check_index(value, collection),
            ValueKind::Indices(collection) => self.check_indices(value, collection),
            ValueKind::Texts => self.check_strings(value),
            ValueKind::Object(object) => match value {
                Value::Object(members) => self.check_object(members, object),
                other => self.report_type_mismatch(other, "an object"),
            },
            ValueKind::Objects(object) => self.check_objects(value, object),
            ValueKind::Attributes => self.check_attributes(value),
            ValueKind::Targets => self.check_morph_targets(value),
        }
    }

    /// Validates a version string of the form `2.0`: two decimal numbers separated by a dot (glTF
    /// 2.0 §5.9).
    fn check_version(&self, value: &Value) {
        let Some(text) = value.as_str() else {
            return self.report_type_mismatch(value, "a string");
        };
        let is_number = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
        if !text.split_once('.').is_some_and(|(major, minor)| is_number(major) && is_number(minor))
        {
            let message = format_args!("{} is not a version such as 2.0", ShortValue(value));
            self.report(&codes::PATTERN_MISMATCH, message);
        }
    }

    /// Validates a string against a fixed list of values.
    ///
    /// A string that is not in the list gets only a warning, because an extension may define more
    /// values.
    fn check_enum_string(&self, value: &Value, words: &[&str]) {
        match value.as_str() {
            None => self.report_type_mismatch(value, "a string"),
            Some(word) if words.contains(&word) => {}
            Some(_) => {
                let message =
                    format_args!("{} is not one of {}", ShortValue(value), words.join(", "));
                self.report(&codes::VALUE_NOT_IN_LIST, message);
            }
        }
    }

    /// Validates an integer in an inclusive range.
    ///
    /// `1.0` is accepted as an integer, as in the glTF JSON schema; `1.5` has the wrong type. A
    /// negative integer does not fit in `u64`, so it is a separate case that is also reported as
    /// out of range.
    fn check_integer(&self, value: &Value, min: u64, max: u64) {
        match (as_whole_number(value), value.as_f64()) {
            (Some(number), _) if (min..=max).contains(&number) => {}
            (Some(_), _) => self.report_out_of_range(value, min, max),
            (None, Some(number)) if number % 1.0 == 0.0 => {
                self.report_out_of_range(value, min, max);
            }
            (None, _) => self.report_type_mismatch(value, "an integer"),
        }
    }

    /// Reports an integer that is out of range. The message includes the maximum only if the schema
    /// has one.
    fn report_out_of_range(&self, value: &Value, min: u64, max: u64) {
        let code = &codes::VALUE_NOT_IN_RANGE;
        if max == u64::MAX {
            self.report(code, format_args!("{} is less than {min}", ShortValue(value)));
        } else {
            let value = ShortValue(value);
            self.report(code, format_args!("{value} is not in the range {min} to {max}"));
        }
    }

    /// Validates an integer against a fixed list of values, such as the OpenGL constants of a
    /// sampler.
    ///
    /// As in the Khronos validator, a fractional number is reported as a value outside the list,
    /// not as a value of the wrong type.
    fn check_enum_integer(&self, value: &Value, numbers: &[u64]) {
        match as_whole_number(value) {
            Some(number) if numbers.contains(&number) => {}
            None if value.as_f64().is_none() => self.report_type_mismatch(value, "an integer"),
            _ => {
                let message = format_args!("{} is not one of {numbers:?}", ShortValue(value));
                self.report(&codes::VALUE_NOT_IN_LIST, message);
            }
        }
    }

    /// Validates a number in a range.
    ///
    /// The bracket in the message indicates whether the minimum is excluded: `(0, 1]` or `[0, 1]`.
    fn check_number(&self, number: f64, range: NumberRange) {
        let NumberRange { min, max, exclusive_min } = range;
        let is_inside = if exclusive_min { number > min } else { number >= min } && number <= max;
        if !is_inside {
            let code = &codes::VALUE_NOT_IN_RANGE;
            let open = if exclusive_min { '(' } else { '[' };
            match (max == f64::INFINITY, exclusive_min) {
                (true, true) => {
                    self.report(code, format_args!("{number} is not greater than {min}"));
                }
                (true, false) => self.report(code, format_args!("{number} is less than {min}")),
                _ => self.report(code, format_args!("{number} is not in {open}{min}, {max}]")),
            }
        }
    }

    /// Validates an array of numbers, each in a range.
    ///
    /// `length` is the required number of items, or 0 for any length above 0. A wrong length ends
    /// the check, because the positions of the items would be meaningless.
    fn check_numbers(&mut self, value: &Value, length: usize, range: NumberRange) {
        let Value::Array(items) = value else {
            return self.report_type_mismatch(value, "an array of numbers");
        };
        if length != 0 && items.len() != length {
            let message = format_args!("expected {length} numbers, found {}", items.len());
            return self.report(&codes::ARRAY_LENGTH_NOT_IN_LIST, message);
        }
        if items.is_empty() {
            return self.report(&codes::EMPTY_ENTITY, "the array is empty");
        }
        for (at, item) in items.iter().enumerate() {
            match item.as_f64() {
                Some(number) if number >= range.min && number <= range.max => {}
                Some(number) => {
                    self.descend(&at.to_string(), |walker| walker.check_number(number, range));
                }
                None => self.descend(&at.to_string(), |walker| {
                    walker.report_item_mismatch(item, "a number");
                }),
            }
        }
    }

    /// Reports an array item of the wrong type.
    fn report_item_mismatch(&self, value: &Value, expected: &str) {
        self.report(
            &codes::ARRAY_TYPE_MISMATCH,
            format_args!("{} is not {expected}", ShortValue(value)),
        );
    }

    /// Validates an index, and marks its target as used.
    ///
    /// Sampler indices in an animation are relative to that animation and are resolved with it. A
    /// value such as `-1` or `1.5` is an `INVALID_INDEX`; an index past the end of its collection
    /// is an `UNRESOLVED_REFERENCE`.
    fn check_index(&self, value: &Value, collection: Collection) {
        match as_whole_number(value) {
            None if !value.is_number() => self.report_type_mismatch(value, "an index"),
            None => self.report_invalid_index(value),
            Some(_) if collection == Collection::AnimationSamplers => {}
            Some(index) if self.document.mark_used(collection, index) => {}
            Some(index) => self.report_unresolved(index, collection),
        }
    }

    /// Reports a number that cannot be an index because it is negative or fractional.
    fn report_invalid_index(&self, value: &Value) {
        let message = format_args!("{} is not a valid index", ShortValue(value));
        self.report(&codes::INVALID_INDEX, message);
    }

    /// Reports an index past the end of its collection.
    fn report_unresolved(&self, index: u64, collection: Collection) {
        let (_, pointer, _) = Collection::ALL[collection as usize];
        let count =
            self.document.root.pointer(pointer).and_then(Value::as_array).map_or(0, Vec::len);
        let message =
            format_args!("{pointer}/{index} does not exist: the array has length {count}");
        self.report(&codes::UNRESOLVED_REFERENCE, message);
    }

    /// Validates a non-empty array of distinct indices, such as the children of a node.
    ///
    /// Duplicates are reported with a separate code, in addition to the check of each index.
    fn check_indices(&mut self, value: &Value, collection: Collection) {
        let Value::Array(items) = value else {
            return self.report_type_mismatch(value, "an array of indices");
        };
        if items.is_empty() {
            return self.report(&codes::EMPTY_ENTITY, "the array is empty");
        }
        let mut known = BTreeSet::new();
        for (at, item) in items.iter().enumerate() {
            self.descend(&at.to_string(), |walker| {
                if as_whole_number(item).is_some_and(|index| !known.insert(index)) {
                    walker
                        .report(&codes::DUPLICATE_ELEMENTS, format_args!("{item} is a duplicate"));
                }
                walker.check_index(item, collection);
            });
        }
    }

    /// Validates a non-empty array of distinct strings, such as `extensionsUsed`.
    fn check_strings(&mut self, value: &Value) {
        let Value::Array(items) = value else {
            return self.report_type_mismatch(value, "an array of strings");
        };
        if items.is_empty() {
            return self.report(&codes::EMPTY_ENTITY, "the array is empty");
        }
        let mut known = BTreeSet::new();
        for (at, item) in items.iter().enumerate() {
            self.descend(&at.to_string(), |walker| match item.as_str() {
                None => walker.report_item_mismatch(item, "a string"),
                Some(text) if known.insert(text) => {}
                Some(_) => {
                    let message = format_args!("{} is a duplicate", ShortValue(item));
                    walker.report(&codes::DUPLICATE_ELEMENTS, message);
                }
            });
        }
    }

    /// Validates a non-empty array of objects.
    ///
    /// glTF forbids empty arrays everywhere (`minItems: 1`): a file without animations must omit
    /// `animations`.
    fn check_objects(&mut self, value: &Value, object: &ObjectSchema) {
        let Value::Array(items) = value else {
            return self.report_type_mismatch(value, "an array of objects");
        };
        if items.is_empty() {
            return self.report(&codes::EMPTY_ENTITY, "the array is empty");
        }
        // The Khronos validator reports mistyped items of top-level arrays like members, and
        // mistyped items of inner arrays with another code.
        let at_top = self.pointer.rfind('/') == Some(0);
        for (at, item) in items.iter().enumerate() {
            self.descend(&at.to_string(), |walker| match item {
                Value::Object(members) => walker.check_object(members, object),
                other if at_top => walker.report_type_mismatch(other, "an object"),
                other => walker.report_item_mismatch(other, "an object"),
            });
        }
    }

    /// Validates an attributes object: accessor indices by attribute name (glTF 2.0 §3.7.2.1).
    ///
    /// The names themselves are validated with the meshes.
    fn check_attributes(&mut self, value: &Value) {
        let Value::Object(members) = value else {
            return self.report_type_mismatch(value, "an object");
        };
        if members.is_empty() {
            self.report(&codes::EMPTY_ENTITY, "the object has no attributes");
        }
        for (name, accessor) in members {
            self.descend(name, |walker| match as_whole_number(accessor) {
                None => walker.report_invalid_index(accessor),
                Some(_) => walker.check_index(accessor, Collection::Accessors),
            });
        }
    }

    /// Validates morph targets: a non-empty array of attributes objects (glTF 2.0 §3.7.2.2).
    fn check_morph_targets(&mut self, value: &Value) {
        let Value::Array(items) = value else {
            return self.report_type_mismatch(value, "an array of objects");
        };
        if items.is_empty() {
            return self.report(&codes::EMPTY_ENTITY, "the array is empty");
        }
        for (at, item) in items.iter().enumerate() {
            self.descend(&at.to_string(), |walker| match item {
                Value::Object(_) => walker.check_attributes(item),
                other => walker.report_item_mismatch(other, "an object"),
            });
        }
    }
}

/// A value as quoted in a message; arrays, objects and long strings appear only as their type.
///
/// This keeps a message to one short line.
struct ShortValue<'a>(&'a Value);

impl Display for ShortValue<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Value::Array(_) => f.write_str("an array"),
            Value::Object(_) => f.write_str("an object"),
            Value::String(text) if text.len() > 60 => f.write_str("a long string"),
            other => write!(f, "{other}"),
        }
    }
}
