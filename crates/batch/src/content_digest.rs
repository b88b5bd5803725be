//! Sizes and SHA-256 hashes of file contents, with hexadecimal text.

use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::io::Read;

/// The size of the blocks in which content is hashed.
const PIECE_BYTES: usize = 1 << 16;

/// The size and SHA-256 of a sequence of bytes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct ContentDigest {
    /// The number of bytes.
    pub bytes: u64,
    /// The SHA-256 of the bytes.
    pub sha256: [u8; 32],
}

impl ContentDigest {
    /// Hashes everything from a reader, in blocks of 64 KiB.
    ///
    /// # Errors
    /// Returns an error if the reader fails.
    pub fn of_reader(reader: &mut dyn Read) -> std::io::Result<Self> {
        let (mut hash, mut bytes, mut piece) = (Sha256::new(), 0, vec![0; PIECE_BYTES]);
        loop {
            let count = reader.read(&mut piece)?;
            if count == 0 {
                return Ok(Self { bytes, sha256: hash.finalize().into() });
            }
            hash.update(&piece[..count]);
            bytes += count as u64;
        }
    }
}

/// Returns the SHA-256 of bytes in hexadecimal.
#[must_use]
pub fn hexadecimal_sha256(bytes: &[u8]) -> String {
    to_hexadecimal(&Sha256::digest(bytes))
}

/// Formats bytes in hexadecimal, two digits each.
#[must_use]
pub fn to_hexadecimal(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(2 * bytes.len());
    for byte in bytes {
        let _ = write!(text, "{byte:02x}");
    }
    text
}

/// Parses a SHA-256 in hexadecimal.
pub(super) fn parse_sha256(text: &str) -> Option<[u8; 32]> {
    let mut sha256 = [0; 32];
    if text.len() != 2 * sha256.len() {
        return None;
    }
    for (at, byte) in sha256.iter_mut().enumerate() {
        let digit = |at: usize| char::from(text.as_bytes()[at]).to_digit(16);
        *byte = u8::try_from(digit(2 * at)? * 16 + digit(2 * at + 1)?).ok()?;
    }
    Some(sha256)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hexadecimal_is_parsed_exactly() {
        assert_eq!(parse_sha256(&"0f".repeat(32)), Some([15; 32]));
        for wrong in ["", "0f", &"0g".repeat(32), &"ä".repeat(32), &"+f".repeat(32)] {
            assert_eq!(parse_sha256(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn content_read_in_several_blocks_has_the_hash_of_the_whole() {
        let content: Vec<u8> = (0..3 * PIECE_BYTES + 5).map(|at| at as u8).collect();
        let hash = ContentDigest::of_reader(&mut &content[..]).expect("a slice can be read");
        assert_eq!(hash.bytes, content.len() as u64);
        assert_eq!(to_hexadecimal(&hash.sha256), hexadecimal_sha256(&content));
    }
}
