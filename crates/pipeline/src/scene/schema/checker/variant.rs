//! A variant of an enum, and what is in its brackets.

use super::{Checker, Fields, Owner};
use crate::scene::schema::{SceneValue, TypeEntry, ValueType, VariantEntry};
use crate::scene::syntax::{Group, Node, NodeKind, SyntaxItem};
use core::ops::Range;

/// A variant that is named in the text.
pub(in crate::scene) struct Variant<'n> {
    pub(super) entry: &'static TypeEntry,
    /// The declaration of the variant.
    pub(super) variant: &'static VariantEntry,
    /// Its brackets, if it has any.
    pub(super) group: Option<&'n Group<'n>>,
    pub(super) span: Range<usize>,
}

impl<'n> Variant<'n> {
    /// The name of the variant, one of those that are declared.
    pub(in crate::scene) fn name(&self) -> &'static str {
        self.variant.name
    }

    /// Whether nothing stands in the brackets of a variant that has no fields; reports what does.
    pub(in crate::scene) fn expect_empty(&self, checker: &mut Checker<'_>) -> bool {
        let Some(group) = self.group.filter(|group| !group.items.is_empty()) else { return true };
        let span = group.items[0].span().start..group.items[group.items.len() - 1].span().end;
        let message = format!("`{}` has no fields", self.variant.name);
        checker.report(span, message, Some(format!("write {}", self.variant.name)));
        false
    }

    /// The fields in the brackets; a variant without brackets has none.
    pub(in crate::scene) fn open_fields(&self, checker: &mut Checker<'_>) -> Option<Fields<'n>> {
        /// The brackets of a variant that is written without any.
        static EMPTY: Group<'static> = Group { name: None, open: '(', items: Vec::new() };
        let owner = Owner {
            key: format!("{}::{}", self.entry.name, self.variant.name),
            shown: self.variant.name,
        };
        let group: &'n Group<'n> = self.group.unwrap_or(&EMPTY);
        checker.read_fields(group, &self.span, &owner, self.variant.fields)
    }

    /// Reads the value in the brackets.
    ///
    /// ```text
    ///  Color("#fff")               one item without a name: that item is the value
    ///  FromModel(name: "front")    the brackets of the variant are those of the struct
    ///  Variant((1, 2, 3))          one item, a vector in its own brackets
    /// ```
    /// The second form is RON's extension `unwrap_variant_newtypes`. Without brackets a struct has
    /// all of its defaults, if it has no required field: `Lines` is `Lines()`.
    pub(in crate::scene) fn read_inner<T: SceneValue>(
        &self,
        checker: &mut Checker<'_>,
    ) -> Option<T> {
        let value_type = self.variant.value_type.map(|value_type| value_type());
        let Some(group) = self.group else {
            if value_type.as_ref().is_some_and(ValueType::has_only_optional_fields) {
                let kind = NodeKind::Group(Group { name: None, open: '(', items: Vec::new() });
                return T::from_node(&Node { span: self.span.clone(), kind }, checker);
            }
            let message = format!("`{}` needs a value in brackets", self.variant.name);
            let words = value_type.map_or(String::new(), |value_type| value_type.words());
            let help = format!("write {}(…) with a {words}", self.variant.name);
            checker.report(self.span.clone(), message, Some(help));
            return None;
        };
        if let [SyntaxItem { key: None, value }] = group.items.as_slice() {
            return T::from_node(value, checker);
        }
        let unnamed = Group { name: None, ..group.clone() };
        let name_length = group.name.as_ref().map_or(0, |name| name.span.len());
        let span = self.span.start + name_length..self.span.end;
        T::from_node(&Node { span, kind: NodeKind::Group(unnamed) }, checker)
    }
}
