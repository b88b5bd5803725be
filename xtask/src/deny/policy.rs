//! The policy from `deny.toml`: the lists of strings that these checks need.

use std::collections::BTreeMap;

/// Lists by section and name, such as `licenses.allow`.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Policy {
    lists: BTreeMap<String, Vec<String>>,
}

impl Policy {
    /// Reads sections and the lists of strings in them. All other values are for `cargo deny` and
    /// are ignored.
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
                    value += lines
                        .next()
                        .ok_or_else(|| format!("deny.toml: the list `{name}` is not closed"))?;
                }
                // After splitting at quotation marks, every second part is a string.
                let texts = value.split('"').skip(1).step_by(2).map(str::to_owned).collect();
                lists.insert(format!("{section}.{name}"), texts);
            }
        }
        Ok(Self { lists })
    }

    /// Returns a list that the policy must have.
    pub fn list(&self, name: &str) -> Result<&[String], String> {
        self.lists.get(name).map(Vec::as_slice).ok_or_else(|| format!("deny.toml has no `{name}`"))
    }
}

/// Removes the comment from a line. No string in the policy contains a `#`.
fn without_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_may_span_lines_and_contain_comments() {
        let text = "[licenses]\nallow = [\n    \"MIT\", # the usual\n    \"Zlib\",\n]\nconfidence = 0.9\n\
            [bans]\nskip = []\n";
        let policy = Policy::parse(text).unwrap();
        assert_eq!(policy.list("licenses.allow").unwrap(), ["MIT", "Zlib"]);
        assert!(policy.list("bans.skip").unwrap().is_empty());
        assert!(policy.list("bans.deny").is_err());
        assert!(Policy::parse("[a]\nb = [\n\"c\"").is_err());
    }
}
