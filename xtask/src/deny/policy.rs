//! The policy of `deny.toml`: the lists of strings that the checks here need.

use std::collections::BTreeMap;

/// Lists by section and name, such as `licenses.allow`.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Policy {
    lists: BTreeMap<String, Vec<String>>,
}

impl Policy {
    /// Reads sections and the lists of strings in them; all other values are for `cargo deny`.
    pub fn parse(text: &str) -> Result<Self, String> {
        let (mut section, mut lists) = (String::new(), BTreeMap::new());
        let mut lines = text.lines().map(without_comment).map(str::trim);
        while let Some(line) = lines.next() {
            if let Some(name) = line.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
                section = name.to_owned();
            } else if let Some((name, value)) =
                line.split_once(" = ").filter(|(_, v)| v.starts_with('['))
            {
                let mut value = value.to_owned();
                while !value.ends_with(']') {
                    value +=
                        lines.next().ok_or_else(|| format!("deny.toml: `{name}` has no end"))?;
                }
                // Every other part between quotation marks is a string.
                let texts = value.split('"').skip(1).step_by(2).map(str::to_owned).collect();
                lists.insert(format!("{section}.{name}"), texts);
            }
        }
        Ok(Self { lists })
    }

    /// A list that the policy must have.
    pub fn list(&self, name: &str) -> Result<&[String], String> {
        self.lists.get(name).map(Vec::as_slice).ok_or_else(|| format!("deny.toml has no `{name}`"))
    }
}

/// A line without its comment; no string in the policy contains a `#`.
fn without_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_read_over_lines_and_comments() {
        let text = "[licenses]\nallow = [\n    \"MIT\", # the usual\n    \"Zlib\",\n]\nconfidence = 0.9\n\
            [bans]\nskip = []\n";
        let policy = Policy::parse(text).unwrap();
        assert_eq!(policy.list("licenses.allow").unwrap(), ["MIT", "Zlib"]);
        assert!(policy.list("bans.skip").unwrap().is_empty());
        assert!(policy.list("bans.deny").is_err());
        assert!(Policy::parse("[a]\nb = [\n\"c\"").is_err());
    }
}
