//! Percent-encoding of URIs and queries (RFC 3986 §2.1).

/// Decodes percent-encoded text, such as `%41` for A. Returns `None` if a `%` is not followed by
/// two hexadecimal digits or the result is not UTF-8.
#[must_use]
pub fn percent_decode(text: &str) -> Option<String> {
    String::from_utf8(percent_decode_bytes(text)?).ok()
}

/// Decodes percent-encoded text to bytes, such as `%41` to 0x41. Returns `None` if a `%` is not
/// followed by two hexadecimal digits.
pub(super) fn percent_decode_bytes(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&byte, after)) = rest.split_first() {
        rest = after;
        if byte == b'%' {
            let digit = |at: usize| char::from(*after.get(at)?).to_digit(16);
            bytes.push((digit(0)? * 16 + digit(1)?) as u8);
            rest = &after[2..];
        } else {
            bytes.push(byte);
        }
    }
    Some(bytes)
}

/// Encodes each UTF-8 byte that is not a letter, a digit or one of `-_.,~/`, so that the string can
/// be used as a relative path or a query value.
#[must_use]
pub fn percent_encode(text: &str) -> String {
    let mut encoded = String::with_capacity(text.len());
    for byte in text.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'_' | b'.' | b',' | b'~' | b'/' => {
                encoded.push(char::from(byte));
            }
            byte => encoded.push_str(&format!("%{byte:02X}")),
        }
    }
    encoded
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_survive_a_round_trip() {
        for name in ["a b.glb", "100 %.stl", "模型.obj", "a&b=c#d?+", "sub/a,b~c.glb"] {
            let encoded = percent_encode(name);
            let special = ['&', '=', '#', '?', '+', ' '];
            assert!(encoded.is_ascii() && !encoded.contains(special), "{encoded}");
            assert_eq!(percent_decode(&encoded).as_deref(), Some(name));
        }
    }

    #[test]
    fn only_hexadecimal_digits_of_either_case_are_decoded() {
        assert_eq!(percent_decode_bytes("%fF%41b").as_deref(), Some(&b"\xffAb"[..]));
        for broken in ["%", "%4", "%zz", "%+1", "%é", "%ff"] {
            assert_eq!(percent_decode(broken), None, "{broken}");
        }
    }
}
