//! Query strings: percent-encoded pairs of keys and values.

use crate::ExplorerError;
use import::percent_decode;

/// The maximum length of a query, in bytes.
const MAX_QUERY_BYTES: usize = 16 * 1024;

/// The pairs of a query string that have not been taken yet, in order.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Query {
    pairs: Vec<(String, String)>,
}

impl Query {
    /// Parses a query string, with or without a leading `#` or `?`.
    ///
    /// # Errors
    /// Returns an error if a pair lacks `=`, if percent-encoding is broken, if a key is repeated,
    /// or if the query is too long.
    pub(crate) fn parse(text: &str) -> Result<Self, ExplorerError> {
        if text.len() > MAX_QUERY_BYTES {
            let message = format!("the request has {} bytes", text.len());
            let help = format!("use at most {MAX_QUERY_BYTES} bytes");
            return Err(ExplorerError::new("malformed_query", message, help));
        }
        let mut pairs: Vec<(String, String)> = Vec::new();
        let text = text.strip_prefix(['#', '?']).unwrap_or(text);
        for pair in text.split('&').filter(|pair| !pair.is_empty()) {
            let (key, value) = pair.split_once('=').ok_or_else(|| missing_equals_sign(pair))?;
            let (key, value) = (decode(key)?, decode(value)?);
            if pairs.iter().any(|(known, _)| *known == key) {
                let message = format!("duplicate key `{key}`");
                return Err(ExplorerError::new("repeated_key", message, "write it only once"));
            }
            pairs.push((key, value));
        }
        Ok(Self { pairs })
    }

    /// Removes a key and returns its value.
    pub(crate) fn take(&mut self, key: &str) -> Option<String> {
        let at = self.pairs.iter().position(|(known, _)| known == key)?;
        Some(self.pairs.remove(at).1)
    }

    /// Returns the first key that has not been taken.
    pub(crate) fn first_key(&self) -> Option<&str> {
        self.pairs.first().map(|(key, _)| key.as_str())
    }
}

fn missing_equals_sign(pair: &str) -> ExplorerError {
    let message = format!("`{pair}` has no value");
    ExplorerError::new("malformed_query", message, format!("write it as `{pair}=…`"))
}

/// Decodes `%41` to A and `+` to a space.
fn decode(text: &str) -> Result<String, ExplorerError> {
    percent_decode(&text.replace('+', " ")).ok_or_else(|| {
        let message = format!("`{text}` is not percent-encoded UTF-8");
        ExplorerError::new("malformed_query", message, "write a percent sign as %25")
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use import::percent_encode;

    #[test]
    fn pairs_are_decoded_and_can_be_taken_only_once() {
        let mut query = Query::parse("#v=1&model=a%20b+c%E4%B8%AD.glb").expect("a query");
        assert_eq!(query.take("model").as_deref(), Some("a b c中.glb"));
        assert_eq!((query.take("model"), query.first_key()), (None, Some("v")));
    }

    #[test]
    fn invalid_queries_are_reported() {
        for (text, code) in [
            ("near", "malformed_query"),
            ("near=%4", "malformed_query"),
            ("near=%ff", "malformed_query"),
            ("near=1&near=2", "repeated_key"),
        ] {
            assert_eq!(Query::parse(text).expect_err(text).code, code);
        }
        assert!(Query::parse(&"a".repeat(MAX_QUERY_BYTES + 1)).is_err());
    }

    #[test]
    fn decoding_reverses_encoding() {
        let text = "Ä b+c&d=e%/中.glb";
        assert_eq!(decode(&percent_encode(text)).as_deref(), Ok(text));
    }
}
