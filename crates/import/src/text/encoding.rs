//! Normalizes encoded text: removes byte order marks, and converts UTF-16 to UTF-8.

use std::borrow::Cow;

/// Returns the text of a file in UTF-8, without a byte order mark.
///
/// UTF-16 is recognized by its byte order mark, and invalid characters become U+FFFD. Text without
/// such a mark is not changed: names may be in any encoding, but keywords and numbers are ASCII.
pub(crate) fn decode_text(bytes: &[u8]) -> Cow<'_, [u8]> {
    match bytes {
        [0xEF, 0xBB, 0xBF, text @ ..] => Cow::Borrowed(text),
        [0xFF, 0xFE, text @ ..] => Cow::Owned(utf_8_from_utf_16(text, u16::from_le_bytes)),
        [0xFE, 0xFF, text @ ..] => Cow::Owned(utf_8_from_utf_16(text, u16::from_be_bytes)),
        _ => Cow::Borrowed(bytes),
    }
}

/// Converts UTF-16 in the given byte order. An odd last byte is dropped.
fn utf_8_from_utf_16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Vec<u8> {
    let mut text = Vec::with_capacity(bytes.len() / 2);
    let units = bytes.as_chunks::<2>().0.iter().map(|&pair| unit(pair));
    for character in char::decode_utf16(units) {
        let character = character.unwrap_or(char::REPLACEMENT_CHARACTER);
        text.extend_from_slice(character.encode_utf8(&mut [0; 4]).as_bytes());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encodings_are_detected_by_byte_order_mark() {
        let units = "\u{FEFF}v ä𝄞".encode_utf16();
        let little: Vec<u8> = units.clone().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = units.flat_map(u16::to_be_bytes).collect();
        for bytes in [&little[..], &big, "\u{FEFF}v ä𝄞".as_bytes(), "v ä𝄞".as_bytes()] {
            assert_eq!(*decode_text(bytes), *"v ä𝄞".as_bytes());
        }
        assert_eq!(*decode_text(b"\xFF\xFE\x00\xD8a"), *"\u{FFFD}".as_bytes(), "lone surrogate");
        assert_eq!(*decode_text(b"v \xE4"), *b"v \xE4");
    }
}
