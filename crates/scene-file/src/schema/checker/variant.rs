//! Checks a variant of an enum and the contents of its brackets.

use super::{Checker, Owner, Segment};
use crate::schema::{Shape, TypeEntry, ValueType, VariantEntry};
use crate::syntax::{Group, Node, NodeKind, SyntaxItem};

impl Checker<'_> {
    /// Reports the mistakes in an enum value.
    pub(super) fn check_variant(&mut self, node: &Node<'_>, entry: &'static TypeEntry) {
        let Some((variant, group)) = self.find_variant(node, entry) else { return };
        self.path.push(Segment::Variant(variant.name));
        match variant.value_type {
            Some(value_type) => self.check_inner(variant.name, group, node, &value_type()),
            None if variant.fields.is_empty() => self.check_empty(variant.name, group),
            None => self.check_variant_fields(variant, group, node, entry),
        }
        self.path.pop();
    }

    /// Reports brackets after a variant that takes none.
    fn check_empty(&mut self, name: &str, group: Option<&Group<'_>>) {
        let Some(group) = group else { return };
        let message = format!("`{name}` has no fields");
        let span = match group.items.as_slice() {
            [] => group.name.as_ref().map_or(0..0, |name| name.span.clone()),
            [first, .., last] => first.span().start..last.span().end,
            [only] => only.span(),
        };
        self.report(span, message, Some(format!("write {name}")));
    }

    /// Reports the mistakes in the fields of a variant.
    fn check_variant_fields(
        &mut self,
        variant: &'static VariantEntry,
        group: Option<&Group<'_>>,
        node: &Node<'_>,
        entry: &TypeEntry,
    ) {
        let Some(group) = group else {
            let is_complete = variant.fields.iter().all(|field| field.is_optional);
            return self.report_no_brackets(variant.name, node, is_complete, "with its fields");
        };
        let owner = Owner { key: format!("{}::{}", entry.name, variant.name), shown: variant.name };
        if let Some(fields) = self.find_fields(group, &node.span, &owner, variant.fields) {
            self.check_fields(&fields);
        }
    }

    /// Reports a variant without its required brackets, which may be empty if all fields have
    /// defaults.
    fn report_no_brackets(&mut self, name: &str, node: &Node<'_>, is_complete: bool, with: &str) {
        let message = format!("`{name}` needs brackets");
        let help = if is_complete {
            format!("write {name}()")
        } else {
            format!("write {name}(…) {with}")
        };
        self.report(node.span.clone(), message, Some(help));
    }

    /// Reports the mistakes in the value inside the brackets of a variant, or of `Some`.
    ///
    /// ```text
    ///  Color("#fff")               one item without a name: that item is the value
    ///  FromModel(name: "front")    the variant and its struct share one pair of brackets
    ///  Point(1, 2, 3)              likewise for a vector
    /// ```
    /// The second form is RON's extension `unwrap_variant_newtypes`. A struct can only be written
    /// this way.
    pub(super) fn check_inner(
        &mut self,
        name: &str,
        group: Option<&Group<'_>>,
        node: &Node<'_>,
        value_type: &ValueType,
    ) {
        let Some(group) = group else {
            let is_complete = value_type.has_only_optional_fields();
            let with = format!("with a {}", value_type.words());
            return self.report_no_brackets(name, node, is_complete, &with);
        };
        let is_struct = matches!(value_type, ValueType::Declared(entry)
            if matches!(entry.shape, Shape::Fields(_)));
        match group.items.as_slice() {
            [SyntaxItem { key: None, value }] if !is_struct => self.check(value, value_type),
            [SyntaxItem { key: None, value: Node { span, kind: NodeKind::Group(_) } }]
                if is_struct =>
            {
                let message = format!("`{name}` takes its fields in one pair of brackets");
                self.report(span.clone(), message, Some(format!("write {name}(…)")));
            }
            _ => {
                let unnamed = Group { name: None, ..group.clone() };
                let name_length = group.name.as_ref().map_or(0, |name| name.span.len());
                let span = node.span.start + name_length..node.span.end;
                self.check(&Node { span, kind: NodeKind::Group(unnamed) }, value_type);
            }
        }
    }
}
