//! The fields in the brackets of a struct or a variant, read by their names.

use super::{Checker, Segment};
use crate::scene::schema::SceneValue;
use crate::scene::syntax::SyntaxItem;

/// The fields of a struct or a variant that are in the text.
pub(in crate::scene) struct Fields<'n> {
    /// The declared fields that were found, each once, in the order of the text.
    pub(super) items: Vec<(&'static str, &'n SyntaxItem<'n>)>,
}

impl Fields<'_> {
    /// The value of a field. A field that is left out, or that cannot be read, has the value of
    /// `default`, if it has one.
    ///
    /// The default also stands in for a value that cannot be read, so that one mistake does not
    /// make the struct and everything around it unreadable.
    pub(in crate::scene) fn read<T: SceneValue>(
        &self,
        checker: &mut Checker<'_>,
        name: &'static str,
        default: fn() -> Option<T>,
    ) -> Option<T> {
        let Some((_, item)) = self.items.iter().find(|(found, _)| *found == name) else {
            return default();
        };
        checker.path.push(Segment::Field(name));
        checker.scopes.push(item.span());
        let value = T::from_node(&item.value, checker);
        checker.scopes.pop();
        checker.path.pop();
        value.or_else(default)
    }
}
