//! The secret in the server's address.
//!
//! Every user of the machine can connect to the loopback address. Only requests to the full
//! address, whose path begins with the token, are answered.

use super::CliError;

/// Bytes of randomness in a token: too many to guess.
const TOKEN_BYTES: usize = 16;

/// Returns a new token of hexadecimal digits.
///
/// # Errors
/// Returns an error if the system cannot provide random bytes.
pub(super) fn new_token() -> Result<String, CliError> {
    let mut bytes = [0_u8; TOKEN_BYTES];
    getrandom::fill(&mut bytes).map_err(|error| {
        CliError::Usage(format!(
            "cannot read random bytes from the system: {error}\n  = help: the page address must be \
             secret; check that /dev/urandom is readable"
        ))
    })?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Returns the rest of a path after the token and a slash; `None` without the token.
///
/// The comparison takes the same time regardless of how many digits match.
pub(super) fn strip_token<'a>(path: &'a str, token: &str) -> Option<&'a str> {
    let (given, rest) = path.split_once('/')?;
    let pairs = given.bytes().zip(token.bytes());
    let difference = pairs.fold(0, |sum, (given, right)| sum | (given ^ right));
    (given.len() == token.len() && difference == 0).then_some(rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tokens_differ_and_have_32_digits() {
        let tokens = [new_token().expect("a token"), new_token().expect("another")];
        assert_ne!(tokens[0], tokens[1]);
        for token in tokens {
            assert!(token.len() == 32 && token.bytes().all(|digit| digit.is_ascii_hexdigit()));
        }
    }

    #[test]
    fn only_the_full_token_grants_access() {
        assert_eq!(strip_token("abc/main.js", "abc"), Some("main.js"));
        assert_eq!(strip_token("abc/", "abc"), Some(""));
        for path in ["", "abc", "main.js", "ab/main.js", "abd/main.js", "abcd/main.js", "/abc/"] {
            assert_eq!(strip_token(path, "abc"), None, "{path}");
        }
    }
}
