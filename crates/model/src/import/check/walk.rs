//! The walk over a document by the tables of the schema.

use super::codes::{self, Code};
use super::document::{Document, escaped, whole};
use super::schema::core::ROOT;
use super::schema::extensions::PLACES;
use super::schema::{Collection, Kind, Member, Object, Range, Rule};
use serde_json::{Map, Value};
use std::collections::BTreeSet;
use std::fmt::Display;

/// Compares a whole document with the schema; notes what refers to what.
pub(super) fn walk(document: &Document<'_>) {
    let mut walker = Walker { document, pointer: String::new() };
    match document.root {
        Value::Object(members) => walker.object(members, &ROOT),
        other => walker.mistyped(other, "an object"),
    }
}

struct Walker<'a> {
    document: &'a Document<'a>,
    /// Where we are.
    pointer: String,
}

impl Walker<'_> {
    fn say(&self, code: &Code, message: impl Display) {
        self.document.findings.add(code, &self.pointer, message);
    }

    fn mistyped(&self, value: &Value, due: &str) {
        self.say(&codes::TYPE_MISMATCH, format_args!("{} is not {due}", Short(value)));
    }

    /// Goes down to a member or an item and comes back.
    fn at(&mut self, name: &str, work: impl FnOnce(&mut Self)) {
        let length = self.pointer.len();
        self.pointer.push('/');
        match name.contains(['~', '/']) {
            true => self.pointer.push_str(&escaped(name)),
            false => self.pointer.push_str(name),
        }
        work(self);
        self.pointer.truncate(length);
    }

    fn object(&mut self, members: &Map<String, Value>, object: &Object) {
        for member in object.members {
            match members.get(member.name) {
                Some(value) => self.at(member.name, |walker| walker.value(value, member.kind)),
                None if member.rule == Rule::Must => {
                    let name = member.name;
                    let message = format_args!("the member `{name}` is missing");
                    // Several may be missing of one object: each is a problem of its own.
                    let findings = &self.document.findings;
                    findings.add(
                        &codes::UNDEFINED_PROPERTY,
                        format_args!("{}/{name}", self.pointer),
                        message,
                    );
                }
                None => {}
            }
            self.rule(members, member);
        }
        for (name, value) in members {
            match name.as_str() {
                "extensions" => self.at(name, |walker| walker.extensions(value, object)),
                "extras" => {}
                _ if object.members.iter().any(|member| member.name == name) => {}
                _ => self.at(name, |walker| {
                    walker.say(&codes::UNEXPECTED_PROPERTY, "glTF has no such member here");
                }),
            }
        }
    }

    fn rule(&mut self, members: &Map<String, Value>, member: &Member) {
        let is_there = members.contains_key(member.name);
        match member.rule {
            Rule::With(other) if is_there && !members.contains_key(other) => {
                self.at(member.name, |walker| {
                    let message = format_args!("it means nothing without `{other}`");
                    walker.say(&codes::UNSATISFIED_DEPENDENCY, message);
                });
            }
            Rule::Either(other) if is_there == members.contains_key(other) => {
                let message = format_args!("either `{}` or `{other}` must be there", member.name);
                self.say(&codes::ONE_OF_MISMATCH, message);
            }
            Rule::Not(other) if is_there && members.contains_key(other) => {
                let message =
                    format_args!("there must not be both `{}` and `{other}`", member.name);
                self.say(&codes::ONE_OF_MISMATCH, message);
            }
            _ => {}
        }
    }

    fn extensions(&mut self, value: &Value, host: &Object) {
        let Value::Object(extensions) = value else { return self.mistyped(value, "an object") };
        for (name, value) in extensions {
            self.at(name, |walker| walker.extension(name, value, host));
        }
    }

    fn extension(&mut self, name: &str, value: &Value, host: &Object) {
        if !self.document.uses(name) {
            let message = format_args!("{} does not list it", "/extensionsUsed");
            self.say(&codes::UNDECLARED_EXTENSION, message);
        }
        let Value::Object(members) = value else { return self.mistyped(value, "an object") };
        let mut places = PLACES.iter().filter(|place| place.name == name).peekable();
        if places.peek().is_none() {
            return;
        }
        match places.find(|place| place.host == host.name) {
            Some(place) => self.object(members, &place.object),
            None => {
                let message = format_args!("the extension has no object in a {}", host.name);
                self.say(&codes::UNEXPECTED_EXTENSION_OBJECT, message);
            }
        }
    }

    fn value(&mut self, value: &Value, kind: Kind) {
        match kind {
            Kind::Any => {}
            Kind::Flag if value.is_boolean() => {}
            Kind::Flag => self.mistyped(value, "true or false"),
            Kind::Text if value.is_string() => {}
            Kind::Text => self.mistyped(value, "a text"),
            Kind::Version => self.version(value),
            Kind::Word(words) => self.word(value, words),
            Kind::Integer(least, most) => self.integer(value, least, most),
            Kind::Choice(numbers) => self.choice(value, numbers),
            Kind::Number(range) => match value.as_f64() {
                Some(number) => self.number(number, range),
                None => self.mistyped(value, "a number"),
            },
            Kind::Numbers(length, range) => self.numbers(value, length, range),
            Kind::Index(collection) => self.index(value, collection),
            Kind::Indices(collection) => self.indices(value, collection),
            Kind::Texts => self.texts(value),
            Kind::Object(object) => match value {
                Value::Object(members) => self.object(members, object),
                other => self.mistyped(other, "an object"),
            },
            Kind::Objects(object) => self.objects(value, object),
            Kind::Attributes => self.attributes(value),
            Kind::Targets => self.targets(value),
        }
    }

    fn version(&self, value: &Value) {
        let Some(text) = value.as_str() else { return self.mistyped(value, "a text") };
        let is_number = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
        if !text.split_once('.').is_some_and(|(major, minor)| is_number(major) && is_number(minor))
        {
            let message = format_args!("{} is not of the form 2.0", Short(value));
            self.say(&codes::PATTERN_MISMATCH, message);
        }
    }

    fn word(&self, value: &Value, words: &[&str]) {
        match value.as_str() {
            None => self.mistyped(value, "a text"),
            Some(word) if words.contains(&word) => {}
            Some(_) => {
                let message = format_args!("{} is none of {}", Short(value), words.join(", "));
                self.say(&codes::VALUE_NOT_IN_LIST, message);
            }
        }
    }

    fn integer(&self, value: &Value, least: u64, most: u64) {
        match (whole(value), value.as_f64()) {
            (Some(number), _) if (least..=most).contains(&number) => {}
            (Some(_), _) => self.out_of_range(value, least, most),
            (None, Some(number)) if number % 1.0 == 0.0 => self.out_of_range(value, least, most),
            (None, _) => self.mistyped(value, "a whole number"),
        }
    }

    fn out_of_range(&self, value: &Value, least: u64, most: u64) {
        let most = if most == u64::MAX { "any".to_owned() } else { most.to_string() };
        let message = format_args!("{} is not from {least} to {most}", Short(value));
        self.say(&codes::VALUE_NOT_IN_RANGE, message);
    }

    fn choice(&self, value: &Value, numbers: &[u64]) {
        match whole(value) {
            Some(number) if numbers.contains(&number) => {}
            None if value.as_f64().is_none() => self.mistyped(value, "a whole number"),
            _ => {
                let message = format_args!("{} is none of {numbers:?}", Short(value));
                self.say(&codes::VALUE_NOT_IN_LIST, message);
            }
        }
    }

    fn number(&self, number: f64, range: Range) {
        let Range { least, most, above } = range;
        let is_inside = if above { number > least } else { number >= least } && number <= most;
        if !is_inside {
            let from = if above { "above" } else { "from" };
            let message = format_args!("{number} is not {from} {least} to {most}");
            self.say(&codes::VALUE_NOT_IN_RANGE, message);
        }
    }

    fn numbers(&mut self, value: &Value, length: usize, range: Range) {
        let Value::Array(items) = value else { return self.mistyped(value, "an array of numbers") };
        if length != 0 && items.len() != length {
            let message = format_args!("there are {} numbers, and {length} are due", items.len());
            return self.say(&codes::ARRAY_LENGTH_NOT_IN_LIST, message);
        }
        if items.is_empty() {
            return self.say(&codes::EMPTY_ENTITY, "the array is empty");
        }
        for (at, item) in items.iter().enumerate() {
            match item.as_f64() {
                Some(number) if number >= range.least && number <= range.most => {}
                Some(number) => self.at(&at.to_string(), |walker| walker.number(number, range)),
                None => self.at(&at.to_string(), |walker| walker.strange(item, "a number")),
            }
        }
    }

    /// An item of an array that is of the wrong type.
    fn strange(&self, value: &Value, due: &str) {
        self.say(&codes::ARRAY_TYPE_MISMATCH, format_args!("{} is not {due}", Short(value)));
    }

    fn index(&self, value: &Value, collection: Collection) {
        match whole(value) {
            None if !value.is_number() => self.mistyped(value, "an index"),
            None => self.no_index(value),
            Some(_) if collection == Collection::AnimationSamplers => {}
            Some(index) if self.document.refer(collection, index) => {}
            Some(index) => self.unresolved(index, collection),
        }
    }

    fn no_index(&self, value: &Value) {
        let message = format_args!("{} is no index: 0 or a whole number above", Short(value));
        self.say(&codes::INVALID_INDEX, message);
    }

    fn unresolved(&self, index: u64, collection: Collection) {
        let (_, pointer, _) = Collection::ALL[collection as usize];
        let count =
            self.document.root.pointer(pointer).and_then(Value::as_array).map_or(0, Vec::len);
        let message = format_args!("there is no {pointer}/{index}: there are {count}");
        self.say(&codes::UNRESOLVED_REFERENCE, message);
    }

    fn indices(&mut self, value: &Value, collection: Collection) {
        let Value::Array(items) = value else { return self.mistyped(value, "an array of indices") };
        if items.is_empty() {
            return self.say(&codes::EMPTY_ENTITY, "the array is empty");
        }
        let mut known = BTreeSet::new();
        for (at, item) in items.iter().enumerate() {
            self.at(&at.to_string(), |walker| {
                if whole(item).is_some_and(|index| !known.insert(index)) {
                    walker.say(&codes::DUPLICATE_ELEMENTS, format_args!("{item} is there already"));
                }
                walker.index(item, collection);
            });
        }
    }

    fn texts(&mut self, value: &Value) {
        let Value::Array(items) = value else { return self.mistyped(value, "an array of texts") };
        if items.is_empty() {
            return self.say(&codes::EMPTY_ENTITY, "the array is empty");
        }
        let mut known = BTreeSet::new();
        for (at, item) in items.iter().enumerate() {
            self.at(&at.to_string(), |walker| match item.as_str() {
                None => walker.strange(item, "a text"),
                Some(text) if known.insert(text) => {}
                Some(_) => {
                    let message = format_args!("{} is there already", Short(item));
                    walker.say(&codes::DUPLICATE_ELEMENTS, message);
                }
            });
        }
    }

    fn objects(&mut self, value: &Value, object: &Object) {
        let Value::Array(items) = value else { return self.mistyped(value, "an array of objects") };
        if items.is_empty() {
            return self.say(&codes::EMPTY_ENTITY, "the array is empty");
        }
        // The arrays at the top are told like members, those inside like arrays, as the validator has it.
        let at_top = self.pointer.rfind('/') == Some(0);
        for (at, item) in items.iter().enumerate() {
            self.at(&at.to_string(), |walker| match item {
                Value::Object(members) => walker.object(members, object),
                other if at_top => walker.mistyped(other, "an object"),
                other => walker.strange(other, "an object"),
            });
        }
    }

    fn attributes(&mut self, value: &Value) {
        let Value::Object(members) = value else { return self.mistyped(value, "an object") };
        if members.is_empty() {
            self.say(&codes::EMPTY_ENTITY, "there are no attributes");
        }
        for (name, accessor) in members {
            self.at(name, |walker| match whole(accessor) {
                None => walker.no_index(accessor),
                Some(_) => walker.index(accessor, Collection::Accessors),
            });
        }
    }

    fn targets(&mut self, value: &Value) {
        let Value::Array(items) = value else { return self.mistyped(value, "an array of objects") };
        if items.is_empty() {
            return self.say(&codes::EMPTY_ENTITY, "the array is empty");
        }
        for (at, item) in items.iter().enumerate() {
            self.at(&at.to_string(), |walker| match item {
                Value::Object(_) => walker.attributes(item),
                other => walker.strange(other, "an object"),
            });
        }
    }
}

/// A value as a message quotes it: short, and arrays and objects by their kind.
struct Short<'a>(&'a Value);

impl Display for Short<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Value::Array(_) => f.write_str("an array"),
            Value::Object(_) => f.write_str("an object"),
            Value::String(text) if text.len() > 60 => f.write_str("a long text"),
            other => write!(f, "{other}"),
        }
    }
}
