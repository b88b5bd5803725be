//! Checks the fields in the brackets of a struct or a variant.

use super::{Checker, Segment};
use crate::schema::FieldEntry;
use crate::syntax::{Node, NodeKind, SyntaxItem};

/// The fields of a struct or a variant found in the text, in text order, misspelled ones last.
pub(super) type FoundFields<'n> = Vec<(&'static FieldEntry, &'n SyntaxItem<'n>)>;

impl Checker<'_> {
    /// Reports the mistakes in the values of fields.
    pub(super) fn check_fields(&mut self, fields: &FoundFields<'_>) {
        for (field, item) in fields {
            self.path.push(Segment::Field(field.name));
            self.scopes.push(item.span());
            let value_type = (field.value_type)();
            match &item.value.kind {
                NodeKind::Word("None") if field.accepts_none => {}
                NodeKind::Group(group) if field.accepts_none && is_some(&item.value) => {
                    self.check_inner("Some", Some(group), &item.value, &value_type);
                }
                _ => self.check(&item.value, &value_type),
            }
            self.scopes.pop();
            self.path.pop();
        }
    }
}

/// Whether a value is written `Some(…)`.
fn is_some(node: &Node<'_>) -> bool {
    let name = node.group().and_then(|group| group.name.as_ref());
    name.is_some_and(|name| name.name == "Some")
}
