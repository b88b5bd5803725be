//! Checks a syntax tree against the declarations, after `ron` failed to read the text.
//!
//! Every mistake is reported once, at its position, without its consequences: an unreadable value
//! has no other mistakes, and a misspelled field is not reported as missing.
//!
//! ```text
//!  check ─► find_struct  ─► find_fields ─► check_fields ─► check …
//!       ├─► find_variant ─► check_variant_fields / check_inner / check_empty
//!       ├─► check_list, check_tuple
//!       └─► Notation: numbers, strings, colors, vectors
//! ```
//! The checker keeps the path to the value, for messages, and the scope of its mistakes: the
//! innermost field or element around it. Resolution later skips errors in a scope with a mistake.

mod corrections;
mod fields;
mod lists;
mod plain;
mod variant;

use super::{FieldEntry, Notation, Shape, TypeEntry, ValueType, VariantEntry};
use crate::mistake::{MAX_MISTAKES, Mistake};
use crate::syntax::{Group, Key, Node, NodeKind, SyntaxItem};
use crate::vocabulary::{Suggestion, suggest_field, suggest_variant};
use core::fmt::Write as _;
use core::ops::Range;
use std::path::Path;

use corrections::{bracket_map, bracket_string};
use fields::FoundFields;

/// A step of the path to the value that is being read: `camera`, `.LookAt`, `[2]`.
#[derive(Clone, Copy, Debug)]
enum Segment {
    /// A field of a struct or variant.
    Field(&'static str),
    /// A variant of an enum, which is part of the path in messages only.
    Variant(&'static str),
    /// An element of a list or tuple, counted from 0.
    Index(usize),
}

/// Collects the mistakes in a text.
#[derive(Debug, Default)]
pub(crate) struct Checker<'a> {
    /// The text of the file, to which the spans of nodes refer.
    source: &'a str,
    mistakes: Vec<Mistake>,
    /// The path from the scene to the value that is being checked.
    path: Vec<Segment>,
    /// The fields and elements around the value that is being read.
    scopes: Vec<Range<usize>>,
    /// The starts of values already reported as lacking list brackets.
    told_lists: Vec<usize>,
}

impl<'a> Checker<'a> {
    /// Creates a checker for a text; node spans index into `source`.
    pub(crate) fn new(source: &'a str) -> Self {
        Self { source, ..Self::default() }
    }
    /// Returns the mistakes, in the order in which they were found.
    pub(crate) fn finish(self) -> Vec<Mistake> {
        self.mistakes
    }

    /// Reports every mistake in a value of this type.
    ///
    /// Stops once there is one more mistake than can be reported.
    pub(crate) fn check(&mut self, node: &Node<'_>, value_type: &ValueType) {
        if self.is_full() {
            return;
        }
        match value_type {
            ValueType::Plain(_, Notation { check, .. }) => check(node, self),
            ValueType::List(element) => self.check_list(node, element),
            ValueType::Tuple(parts) => self.check_tuple(node, parts),
            ValueType::Declared(entry) => match entry.shape {
                Shape::Plain(Notation { check, .. }) => check(node, self),
                Shape::Variants(_) => self.check_variant(node, entry),
                Shape::Fields(_) => {
                    if let Some(fields) = self.find_struct(node, entry) {
                        self.check_fields(&fields);
                    }
                }
            },
        }
    }

    /// Whether there are more mistakes than can be reported.
    fn is_full(&self) -> bool {
        self.mistakes.len() > MAX_MISTAKES
    }

    /// Reports a mistake at `span`.
    ///
    /// `span` is underlined in the message. The scope of the mistake is the innermost field or
    /// element, or the span itself outside all fields.
    pub(crate) fn report(
        &mut self,
        span: Range<usize>,
        message: impl Into<String>,
        help: Option<String>,
    ) {
        let scope = self.scopes.last().cloned().unwrap_or_else(|| span.clone());
        self.mistakes.push(Mistake { scope, ..Mistake::new(span, message, help) });
    }

    /// Reports that a value does not have its field's type: `camera.view: expected …, found …`.
    ///
    /// Nodes that the parser could not read are skipped, since it has already reported them.
    pub(crate) fn report_type(&mut self, node: &Node<'_>, expected: &str, help: Option<String>) {
        if node.kind != NodeKind::Invalid {
            let message =
                format!("{}expected {expected}, found {}", self.path_prefix(), self.describe(node));
            self.report(node.span.clone(), message, help);
        }
    }

    /// Reports that a value has the right type but is out of range.
    pub(crate) fn report_value(&mut self, node: &Node<'_>, problem: &str, help: Option<String>) {
        let message = format!("{}{problem}", self.path_prefix());
        self.report(node.span.clone(), message, help);
    }

    /// Returns the path of the value that is being read, such as `camera.view.LookAt.eye[1]`; empty
    /// for the whole scene.
    ///
    /// A point precedes every name except the first; indices have none.
    fn path_text(&self) -> String {
        let mut text = String::new();
        for segment in &self.path {
            let point = if text.is_empty() { "" } else { "." };
            let _ = match segment {
                Segment::Field(name) | Segment::Variant(name) => write!(text, "{point}{name}"),
                Segment::Index(index) => write!(text, "[{index}]"),
            };
        }
        text
    }
    /// Returns the quoted path with which a message begins, or nothing for the whole scene.
    fn path_prefix(&self) -> String {
        let path = self.path_text();
        if path.is_empty() { path } else { format!("`{path}`: ") }
    }

    /// Returns the name of the scene field that the value belongs to.
    pub(crate) fn top_level_field(&self) -> Option<&'static str> {
        match self.path.first() {
            Some(Segment::Field(name)) => Some(name),
            _ => None,
        }
    }

    /// Returns the name of the innermost field around the value.
    pub(crate) fn innermost_field(&self) -> Option<&'static str> {
        self.path.iter().rev().find_map(|segment| match segment {
            Segment::Field(name) => Some(*name),
            _ => None,
        })
    }

    /// Describes a value for messages: quoted if it has at most 40 bytes, otherwise by its kind.
    fn describe(&self, node: &Node<'_>) -> String {
        let text = &self.source[node.span.clone()];
        match &node.kind {
            NodeKind::Number(_) | NodeKind::Word(_) | NodeKind::String(_) if text.len() <= 40 => {
                format!("`{text}`")
            }
            NodeKind::String(_) => "a string".to_owned(),
            NodeKind::Group(Group { name: Some(name), .. }) => format!("`{}(…)`", name.name),
            NodeKind::Group(Group { open: '[', .. }) => "a list […]".to_owned(),
            NodeKind::Group(_) => "values in parentheses (…)".to_owned(),
            _ => "something else".to_owned(),
        }
    }

    /// Finds the fields in the brackets of a struct; returns `None` if the node is not a struct.
    ///
    /// The type's name before the bracket is optional: `Camera(…)` and `(…)` are equivalent. A word
    /// that is a variant of another type gets a hint about where it belongs.
    fn find_struct<'n>(
        &mut self,
        node: &'n Node<'n>,
        entry: &'static TypeEntry,
    ) -> Option<FoundFields<'n>> {
        let Shape::Fields(fields) = entry.shape else { return None };
        let owner = Owner { key: entry.name.to_owned(), shown: entry.name };
        match &node.kind {
            NodeKind::Group(group) if group.open == '(' => {
                if let Some(name) = group.name.as_ref().filter(|name| name.name != entry.name) {
                    self.report_struct_name(name, entry)?;
                }
                self.find_fields(group, &node.span, &owner, fields)
            }
            NodeKind::Invalid => None,
            NodeKind::Word(word) if suggest_variant(entry, word, None).is_known() => {
                let suggestion = suggest_variant(entry, word, self.top_level_field());
                let message =
                    format!("{}expected `{}`, found `{word}`", self.path_prefix(), entry.name);
                self.report(node.span.clone(), message, Some(suggestion.help));
                None
            }
            _ => {
                let example = bracket_string(node, entry);
                let help = match example.or_else(|| self.bracket_list(node, entry)) {
                    Some(example) => format!("write {example}"),
                    None => {
                        format!("write {0}(…), or just (…), with its fields inside", entry.name)
                    }
                };
                self.report_type(node, &format!("`{}`", entry.name), Some(help));
                None
            }
        }
    }

    /// Reports a struct name that differs from the expected type's. Returns whether the struct is
    /// probably of that type anyway.
    ///
    /// The result is `Some` for an unknown name, such as a misspelling; the struct's fields are
    /// then checked too. It is `None` for a name that the language uses elsewhere, since none of
    /// its fields would be right.
    fn report_struct_name(&mut self, name: &Key<'_>, entry: &'static TypeEntry) -> Option<()> {
        let message = format!("expected `{}`, found `{}`", entry.name, name.name);
        let suggestion = suggest_variant(entry, name.name, self.top_level_field());
        let is_misspelt = name.name.eq_ignore_ascii_case(entry.name);
        let known = (suggestion.is_known() && !is_misspelt).then_some(suggestion.help);
        let is_known = known.is_some();
        let help = known.unwrap_or_else(|| format!("write {}(…), or just (…)", entry.name));
        self.report(name.span.clone(), message, Some(help));
        (!is_known).then_some(())
    }

    /// Finds the declared fields among the items of a group, and reports unknown, duplicate and
    /// missing fields.
    ///
    /// A missing field is reported only if every unknown field has another explanation: `modles:
    /// […]` is reported as a misspelling of `models`, and `models` is not reported as missing too.
    /// If no item has a name, the brackets hold a tuple or a list, and only the first item is
    /// reported. The time is proportional to items × declared fields.
    fn find_fields<'n>(
        &mut self,
        group: &'n Group<'n>,
        span: &Range<usize>,
        owner: &Owner,
        declared: &'static [FieldEntry],
    ) -> Option<FoundFields<'n>> {
        let (mut found, mut misspelt) = (FoundFields::<'n>::new(), FoundFields::<'n>::new());
        let (mut meant, mut unknown) = (Vec::<&'static str>::new(), 0);
        for item in &group.items {
            if self.is_full() {
                return None;
            }
            self.scopes.push(item.span());
            match &item.key {
                None => {
                    self.report_keyless_item(item, owner, declared);
                    if group.items.iter().all(|item| item.key.is_none()) {
                        self.scopes.pop();
                        return None;
                    }
                }
                Some(key) => match declared.iter().find(|field| field.name == key.name) {
                    None => {
                        unknown += 1;
                        let sibling = self.report_unknown_field(item, key, owner, declared);
                        // Mistakes inside a misspelled field are reported in the same run.
                        let structured = sibling.filter(|_| has_named_parts(&item.value));
                        let structured = structured
                            .and_then(|name| declared.iter().find(|field| field.name == name));
                        misspelt.extend(structured.map(|field| (field, item)));
                        meant.extend(sibling);
                    }
                    Some(field) if found.iter().any(|(other, _)| other.name == field.name) => {
                        let message = format!("duplicate field `{}`", field.name);
                        self.report(
                            key.span.clone(),
                            message,
                            Some("remove one of them".to_owned()),
                        );
                    }
                    Some(field) => found.push((field, item)),
                },
            }
            self.scopes.pop();
        }
        // An unexplained field may be a badly misspelled missing one.
        let has_unexplained = unknown > meant.len();
        for field in declared.iter().filter(|_| !has_unexplained) {
            let is_there = field.is_optional || meant.contains(&field.name);
            if !is_there && !found.iter().any(|(other, _)| other.name == field.name) {
                let message = format!("missing field `{}` in `{}`", field.name, owner.shown);
                let help = format!("add `{}: …`", field.name);
                self.report(span.clone(), message, Some(help));
            }
        }
        misspelt.retain(|(field, _)| found.iter().all(|(other, _)| other.name != field.name));
        found.extend(misspelt);
        Some(found)
    }

    /// Reports an unnamed value among fields, such as the 5 in `fov_y_degrees: 3,5`.
    fn report_keyless_item(
        &mut self,
        item: &SyntaxItem<'_>,
        owner: &Owner,
        declared: &'static [FieldEntry],
    ) {
        if item.value.kind == NodeKind::Invalid {
            return;
        }
        let found = self.describe(&item.value);
        // The only required field, such as `path` in `Model("model.glb")`.
        let mut required = declared.iter().filter(|field| !field.is_optional);
        let only = required.next().filter(|_| required.next().is_none());
        let mut help = "write fields as `name: value`".to_owned();
        match (&item.value.kind, only) {
            (NodeKind::String(_), Some(field)) if found.len() <= 80 => {
                help =
                    format!("write {}({}: {})", owner.shown, field.name, found.trim_matches('`'));
            }
            (NodeKind::Number(_), _) => help += "; in numbers, write a decimal point, not a comma",
            _ => {}
        }
        let message = format!("expected a field name, found {found}");
        self.report(item.value.span.clone(), message, Some(help));
    }

    /// Reports an undeclared field. Returns the field of the same struct that is probably meant.
    ///
    /// The suggestion is based on the fields of this struct, of the whole language, of other
    /// programs and of older scene files.
    fn report_unknown_field(
        &mut self,
        item: &SyntaxItem<'_>,
        key: &Key<'_>,
        owner: &Owner,
        declared: &'static [FieldEntry],
    ) -> Option<&'static str> {
        let names: Vec<&'static str> = declared.iter().map(|field| field.name).collect();
        let Suggestion { mut help, sibling, .. } =
            suggest_field(&owner.key, &names, key.name, self.top_level_field());
        let meant = declared.iter().find(|field| Some(field.name) == sibling);
        let list = meant.and_then(|field| self.write_as_list(&item.value, &(field.value_type)()));
        if let (Some(name), Some(list)) = (sibling, list) {
            help.push_str(&format!(" write {name}: {list}"));
            self.told_lists.push(item.value.span.start);
        }
        let message = format!("unexpected field `{}` in `{}`", key.name, owner.shown);
        // `top` and `bottom` of a gradient are two mistakes with one fix, which is shown once.
        let around = self.scopes.iter().rev().nth(1).map_or(0, |outer| outer.start);
        let is_known = self
            .mistakes
            .last()
            .is_some_and(|last| last.help.as_ref() == Some(&help) && last.span.start >= around);
        self.report(key.span.clone(), message, Some(help).filter(|_| !is_known));
        sibling
    }

    /// Finds the variant that a node names, and its brackets; returns `None` if there is no such
    /// variant.
    fn find_variant<'n>(
        &mut self,
        node: &'n Node<'n>,
        entry: &'static TypeEntry,
    ) -> Option<(&'static VariantEntry, Option<&'n Group<'n>>)> {
        let Shape::Variants(variants) = entry.shape else { return None };
        let (name, span, group) = match &node.kind {
            NodeKind::Word(word) => (*word, node.span.clone(), None),
            NodeKind::Group(group) if group.open == '(' && group.name.is_some() => {
                let name = group.name.as_ref()?;
                (name.name, name.span.clone(), Some(group))
            }
            _ => {
                self.report_no_variant(node, entry, variants);
                return None;
            }
        };
        let variant = variants.iter().find(|variant| variant.name == name);
        if variant.is_none() {
            let message = format!("`{name}` is not a valid `{}`", entry.name);
            let mut help = suggest_variant(entry, name, self.top_level_field()).help;
            let is_meant =
                |variant: &&VariantEntry| help == format!("did you mean `{}`?", variant.name);
            let meant = variants.iter().find(is_meant).filter(|_| group.is_none());
            if meant.is_some_and(VariantEntry::has_brackets) {
                help.insert_str(help.len() - "`?".len(), "()");
            }
            if let Some([SyntaxItem { key: None, value }]) =
                group.map(|group| group.items.as_slice())
                && name == entry.name
            {
                let inner = &self.source[value.span.clone()];
                help = format!("remove `{name}(…)` and write {inner}");
            }
            self.report(span, message, Some(help));
        }
        variant.map(|variant| (variant, group))
    }

    /// Reports a value that does not name a variant, and suggests a variant that can hold it, if
    /// any.
    ///
    /// For a string in place of a color, the hint is `Color("…")`; for a number, it is the variant
    /// that contains a number.
    fn report_no_variant(
        &mut self,
        node: &Node<'_>,
        entry: &'static TypeEntry,
        variants: &'static [VariantEntry],
    ) {
        let text = &self.source[node.span.clone()];
        let inner =
            |variant: &VariantEntry| variant.value_type.map(|value_type| value_type().words());
        let kinds: &[&str] = match &node.kind {
            NodeKind::String(_) => &["string", "Color"],
            NodeKind::Number(_) => &["whole number", "Positive"],
            NodeKind::Group(group) if group.items.len() == 3 => &["Triple"],
            _ => &[],
        };
        let fitting = variants
            .iter()
            .find(|&variant| inner(variant).is_some_and(|words| kinds.contains(&words.as_str())));
        let file = named_file(node).and_then(|name| variant_with_path(name, variants));
        let with_fields = node.group().and_then(|group| variant_with_fields(group, variants));
        let help = match (fitting, &node.kind) {
            _ if file.is_some() => format!("write {}", file.unwrap_or_default()),
            (None, _) if with_fields.is_some() => {
                format!("write {}{text}", with_fields.unwrap_or_default())
            }
            (Some(variant), _) => format!("did you mean `{}({text})`?", variant.name),
            (None, NodeKind::String(_)) => {
                suggest_variant(entry, text.trim_matches('"'), self.top_level_field()).help
            }
            (None, _) => {
                let written = |variant: &VariantEntry| match variant.has_brackets() {
                    true => format!("{}(…)", variant.name),
                    false => variant.name.to_owned(),
                };
                let written: Vec<String> = variants.iter().take(6).map(written).collect();
                let more = if variants.len() > 6 { ", …" } else { "" };
                format!(
                    "write one of {}{more}; `alberti scene doc {}` explains them",
                    written.join(", "),
                    entry.name
                )
            }
        };
        let quotes = if matches!(node.kind, NodeKind::String(_)) && named_file(node).is_none() {
            ", without quotation marks"
        } else {
            ""
        };
        let expected = format!("a value of `{}`{quotes}", entry.name);
        self.report_type(node, &expected, Some(help));
    }
}

/// Whether a value is a list, or has fields in brackets.
fn has_named_parts(node: &Node<'_>) -> bool {
    node.group()
        .is_some_and(|group| group.open == '[' || group.items.iter().any(|item| item.key.is_some()))
}

/// Returns the value if it is a file name: a string with an extension.
fn named_file<'n>(node: &'n Node<'_>) -> Option<&'n str> {
    let NodeKind::String(text) = &node.kind else { return None };
    let name: &str = text.trim_matches('"');
    Path::new(name).extension().map(|_| name)
}

/// Formats a file path as the first variant that requires one: `File(path: "studio.hdr")`.
fn variant_with_path(name: &str, variants: &[VariantEntry]) -> Option<String> {
    let has_path = |variant: &&VariantEntry| {
        variant.fields.iter().any(|field| field.name == "path" && !field.is_optional)
    };
    let variant = variants.iter().find(has_path)?;
    Some(format!("{}(path: \"{name}\")", variant.name))
}

/// Returns the first variant that declares every field in a group without a variant name.
fn variant_with_fields(group: &Group<'_>, variants: &[VariantEntry]) -> Option<&'static str> {
    let has = |variant: &VariantEntry, item: &SyntaxItem<'_>| {
        let is_key =
            |field: &FieldEntry| item.key.as_ref().is_some_and(|key| key.name == field.name);
        variant.fields.iter().any(is_key)
    };
    let fits = |variant: &&VariantEntry| group.items.iter().all(|item| has(variant, item));
    let is_bare = group.open == '(' && !group.items.is_empty();
    variants.iter().filter(|_| is_bare).find(fits).map(|variant| variant.name)
}

/// The owner of fields: a struct, or a variant of an enum.
struct Owner {
    /// The name in searches: `Model`, or `View::LookAt`.
    key: String,
    /// The name in messages: `Model`, or `LookAt`.
    shown: &'static str,
}
