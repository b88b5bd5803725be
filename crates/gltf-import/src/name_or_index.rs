//! Selection of a scene or variant in a file, by name or index.
//!
//! `--scene 2` and `--scene Kitchen` both become a [`NameOrIndex`]. Errors list the available
//! names.

use model::{Diagnostic, codes};

/// A name or an index that selects one of several items.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum NameOrIndex {
    /// The index in the file, from 0.
    Index(usize),
    /// The name in the file.
    Name(String),
}

impl NameOrIndex {
    /// Finds the index of the selected item among items with these names. The error lists them.
    ///
    /// An out-of-range index is also tried as a name, because names may be numeric.
    pub(super) fn find_among(
        &self,
        names: &[Option<&str>],
        what: &str,
        pointer: &str,
    ) -> Result<usize, Diagnostic> {
        let named = |wanted: &str| names.iter().position(|name| *name == Some(wanted));
        let (selected, wanted) = match self {
            Self::Index(at) if *at < names.len() => (Some(*at), at.to_string()),
            Self::Index(at) => (named(&at.to_string()), at.to_string()),
            Self::Name(name) => (named(name), name.clone()),
        };
        selected.ok_or_else(|| {
            let available = names.iter().enumerate().map(|(at, name)| match name {
                Some(name) => format!("{at} `{name}`"),
                None => at.to_string(),
            });
            let available: Vec<String> = available.collect();
            let message = match available.as_slice() {
                [] => format!("the file has no {what}s, so `{wanted}` cannot be chosen"),
                _ => format!("there is no {what} `{wanted}`"),
            };
            let help = match available.as_slice() {
                [] => format!("omit the {what}"),
                _ if wanted.ends_with(".ron") => format!(
                    "a {what} is chosen by its name or index in the file; to render a scene \
                     file, make it the input: `alberti render {wanted}`"
                ),
                [only] => format!("the only one is {only}"),
                available => format!("choose one of {}", available.join(", ")),
            };
            Diagnostic::error(codes::NO_SUCH_ITEM, pointer, message, &help)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_are_found_by_index_or_name_and_errors_list_them() {
        let names = [Some("day"), None, Some("7")];
        let among = |choice: NameOrIndex| choice.find_among(&names, "scene", "/scenes");
        assert_eq!(among(NameOrIndex::Index(1)), Ok(1));
        assert_eq!(among(NameOrIndex::Index(7)), Ok(2), "a name made of digits");
        assert_eq!(among(NameOrIndex::Name("day".to_owned())), Ok(0));
        let diagnostic = among(NameOrIndex::Name("night".to_owned())).unwrap_err();
        assert_eq!(diagnostic.code, codes::NO_SUCH_ITEM);
        assert_eq!(diagnostic.message, "there is no scene `night`");
        assert_eq!(diagnostic.help.unwrap(), "choose one of 0 `day`, 1, 2 `7`");
        let diagnostic = NameOrIndex::Index(0).find_among(&[], "variant", "/v").unwrap_err();
        assert_eq!(diagnostic.help.unwrap(), "omit the variant");
    }
}
