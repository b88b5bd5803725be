//! The walk over a document by the tables of the schema.

use super::codes::{self, DiagnosticCode};
use super::document::{CheckedDocument, as_whole_number, escape_pointer_token};
use super::schema::core::ROOT;
use super::schema::extensions::EXTENSION_OBJECTS;
use super::schema::{Collection, MemberSchema, NumberRange, ObjectSchema, PresenceRule, ValueKind};
use serde_json::{Map, Value};
use std::collections::BTreeSet;
use std::fmt::Display;

/// Compares a whole document with the schema; notes what refers to what.
pub(super) fn check_schema(document: &CheckedDocument<'_>) {
    let mut walker = SchemaWalker { document, pointer: String::new() };
    match document.root {
        Value::Object(members) => walker.check_object(members, &ROOT),
        other => walker.report_type_mismatch(other, "an object"),
    }
}

struct SchemaWalker<'a> {
    document: &'a CheckedDocument<'a>,
    /// Where we are.
    pointer: String,
}

impl SchemaWalker<'_> {
    fn report(&self, code: &DiagnosticCode, message: impl Display) {
        self.document.diagnostics.add(code, &self.pointer, message);
    }

    fn report_type_mismatch(&self, value: &Value, expected: &str) {
        self.report(&codes::TYPE_MISMATCH, format_args!("{} is not {expected}", ShortValue(value)));
    }

    /// Goes down to a member or an item and comes back.
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

    fn check_object(&mut self, members: &Map<String, Value>, object: &ObjectSchema) {
        for member in object.members {
            match members.get(member.name) {
                Some(value) => {
                    self.descend(member.name, |walker| walker.check_value(value, member.kind))
                }
                None if member.rule == PresenceRule::Required => {
                    let name = member.name;
                    let message = format_args!("the member `{name}` is missing");
                    // Several may be missing of one object: each is a problem of its own.
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
                    walker.report(&codes::UNEXPECTED_PROPERTY, "glTF has no such member here");
                }),
            }
        }
    }

    fn check_presence(&mut self, members: &Map<String, Value>, member: &MemberSchema) {
        let is_there = members.contains_key(member.name);
        match member.rule {
            PresenceRule::Requires(other) if is_there && !members.contains_key(other) => {
                self.descend(member.name, |walker| {
                    let message = format_args!("it means nothing without `{other}`");
                    walker.report(&codes::UNSATISFIED_DEPENDENCY, message);
                });
            }
            PresenceRule::ExactlyOne(other) if is_there == members.contains_key(other) => {
                let message = format_args!("either `{}` or `{other}` must be there", member.name);
                self.report(&codes::ONE_OF_MISMATCH, message);
            }
            PresenceRule::Excludes(other) if is_there && members.contains_key(other) => {
                let message =
                    format_args!("there must not be both `{}` and `{other}`", member.name);
                self.report(&codes::ONE_OF_MISMATCH, message);
            }
            _ => {}
        }
    }

    fn check_extensions(&mut self, value: &Value, parent: &ObjectSchema) {
        let Value::Object(extensions) = value else {
            return self.report_type_mismatch(value, "an object");
        };
        for (name, value) in extensions {
            self.descend(name, |walker| walker.check_extension(name, value, parent));
        }
    }

    fn check_extension(&mut self, name: &str, value: &Value, parent: &ObjectSchema) {
        if !self.document.uses_extension(name) {
            let message = format_args!("{} does not list it", "/extensionsUsed");
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
                let message = format_args!("the extension has no object in a {}", parent.name);
                self.report(&codes::UNEXPECTED_EXTENSION_OBJECT, message);
            }
        }
    }

    fn check_value(&mut self, value: &Value, kind: ValueKind) {
        match kind {
            ValueKind::Any => {}
            ValueKind::Boolean if value.is_boolean() => {}
            ValueKind::Boolean => self.report_type_mismatch(value, "true or false"),
            ValueKind::Text if value.is_string() => {}
            ValueKind::Text => self.report_type_mismatch(value, "a text"),
            ValueKind::Version => self.check_version(value),
            ValueKind::EnumString(words) => self.check_enum_string(value, words),
            ValueKind::Integer(least, most) => self.check_integer(value, least, most),
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

    fn check_version(&self, value: &Value) {
        let Some(text) = value.as_str() else { return self.report_type_mismatch(value, "a text") };
        let is_number = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
        if !text.split_once('.').is_some_and(|(major, minor)| is_number(major) && is_number(minor))
        {
            let message = format_args!("{} is not of the form 2.0", ShortValue(value));
            self.report(&codes::PATTERN_MISMATCH, message);
        }
    }

    fn check_enum_string(&self, value: &Value, words: &[&str]) {
        match value.as_str() {
            None => self.report_type_mismatch(value, "a text"),
            Some(word) if words.contains(&word) => {}
            Some(_) => {
                let message = format_args!("{} is none of {}", ShortValue(value), words.join(", "));
                self.report(&codes::VALUE_NOT_IN_LIST, message);
            }
        }
    }

    fn check_integer(&self, value: &Value, least: u64, most: u64) {
        match (as_whole_number(value), value.as_f64()) {
            (Some(number), _) if (least..=most).contains(&number) => {}
            (Some(_), _) => self.report_out_of_range(value, least, most),
            (None, Some(number)) if number % 1.0 == 0.0 => {
                self.report_out_of_range(value, least, most)
            }
            (None, _) => self.report_type_mismatch(value, "a whole number"),
        }
    }

    fn report_out_of_range(&self, value: &Value, least: u64, most: u64) {
        let most = if most == u64::MAX { "any".to_owned() } else { most.to_string() };
        let message = format_args!("{} is not from {least} to {most}", ShortValue(value));
        self.report(&codes::VALUE_NOT_IN_RANGE, message);
    }

    fn check_enum_integer(&self, value: &Value, numbers: &[u64]) {
        match as_whole_number(value) {
            Some(number) if numbers.contains(&number) => {}
            None if value.as_f64().is_none() => self.report_type_mismatch(value, "a whole number"),
            _ => {
                let message = format_args!("{} is none of {numbers:?}", ShortValue(value));
                self.report(&codes::VALUE_NOT_IN_LIST, message);
            }
        }
    }

    fn check_number(&self, number: f64, range: NumberRange) {
        let NumberRange { min: least, max: most, exclusive_min: above } = range;
        let is_inside = if above { number > least } else { number >= least } && number <= most;
        if !is_inside {
            let from = if above { "above" } else { "from" };
            let message = format_args!("{number} is not {from} {least} to {most}");
            self.report(&codes::VALUE_NOT_IN_RANGE, message);
        }
    }

    fn check_numbers(&mut self, value: &Value, length: usize, range: NumberRange) {
        let Value::Array(items) = value else {
            return self.report_type_mismatch(value, "an array of numbers");
        };
        if length != 0 && items.len() != length {
            let message = format_args!("there are {} numbers, and {length} are due", items.len());
            return self.report(&codes::ARRAY_LENGTH_NOT_IN_LIST, message);
        }
        if items.is_empty() {
            return self.report(&codes::EMPTY_ENTITY, "the array is empty");
        }
        for (at, item) in items.iter().enumerate() {
            match item.as_f64() {
                Some(number) if number >= range.min && number <= range.max => {}
                Some(number) => {
                    self.descend(&at.to_string(), |walker| walker.check_number(number, range))
                }
                None => self.descend(&at.to_string(), |walker| {
                    walker.report_item_mismatch(item, "a number")
                }),
            }
        }
    }

    /// An item of an array that is of the wrong type.
    fn report_item_mismatch(&self, value: &Value, expected: &str) {
        self.report(
            &codes::ARRAY_TYPE_MISMATCH,
            format_args!("{} is not {expected}", ShortValue(value)),
        );
    }

    fn check_index(&self, value: &Value, collection: Collection) {
        match as_whole_number(value) {
            None if !value.is_number() => self.report_type_mismatch(value, "an index"),
            None => self.report_invalid_index(value),
            Some(_) if collection == Collection::AnimationSamplers => {}
            Some(index) if self.document.mark_used(collection, index) => {}
            Some(index) => self.report_unresolved(index, collection),
        }
    }

    fn report_invalid_index(&self, value: &Value) {
        let message = format_args!("{} is no index: 0 or a whole number above", ShortValue(value));
        self.report(&codes::INVALID_INDEX, message);
    }

    fn report_unresolved(&self, index: u64, collection: Collection) {
        let (_, pointer, _) = Collection::ALL[collection as usize];
        let count =
            self.document.root.pointer(pointer).and_then(Value::as_array).map_or(0, Vec::len);
        let message = format_args!("there is no {pointer}/{index}: there are {count}");
        self.report(&codes::UNRESOLVED_REFERENCE, message);
    }

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
                    walker.report(
                        &codes::DUPLICATE_ELEMENTS,
                        format_args!("{item} is there already"),
                    );
                }
                walker.check_index(item, collection);
            });
        }
    }

    fn check_strings(&mut self, value: &Value) {
        let Value::Array(items) = value else {
            return self.report_type_mismatch(value, "an array of texts");
        };
        if items.is_empty() {
            return self.report(&codes::EMPTY_ENTITY, "the array is empty");
        }
        let mut known = BTreeSet::new();
        for (at, item) in items.iter().enumerate() {
            self.descend(&at.to_string(), |walker| match item.as_str() {
                None => walker.report_item_mismatch(item, "a text"),
                Some(text) if known.insert(text) => {}
                Some(_) => {
                    let message = format_args!("{} is there already", ShortValue(item));
                    walker.report(&codes::DUPLICATE_ELEMENTS, message);
                }
            });
        }
    }

    fn check_objects(&mut self, value: &Value, object: &ObjectSchema) {
        let Value::Array(items) = value else {
            return self.report_type_mismatch(value, "an array of objects");
        };
        if items.is_empty() {
            return self.report(&codes::EMPTY_ENTITY, "the array is empty");
        }
        // The arrays at the top are told like members, those inside like arrays, as the validator has it.
        let at_top = self.pointer.rfind('/') == Some(0);
        for (at, item) in items.iter().enumerate() {
            self.descend(&at.to_string(), |walker| match item {
                Value::Object(members) => walker.check_object(members, object),
                other if at_top => walker.report_type_mismatch(other, "an object"),
                other => walker.report_item_mismatch(other, "an object"),
            });
        }
    }

    fn check_attributes(&mut self, value: &Value) {
        let Value::Object(members) = value else {
            return self.report_type_mismatch(value, "an object");
        };
        if members.is_empty() {
            self.report(&codes::EMPTY_ENTITY, "there are no attributes");
        }
        for (name, accessor) in members {
            self.descend(name, |walker| match as_whole_number(accessor) {
                None => walker.report_invalid_index(accessor),
                Some(_) => walker.check_index(accessor, Collection::Accessors),
            });
        }
    }

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

/// A value as a message quotes it: short, and arrays and objects by their kind.
struct ShortValue<'a>(&'a Value);

impl Display for ShortValue<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Value::Array(_) => f.write_str("an array"),
            Value::Object(_) => f.write_str("an object"),
            Value::String(text) if text.len() > 60 => f.write_str("a long text"),
            other => write!(f, "{other}"),
        }
    }
}
