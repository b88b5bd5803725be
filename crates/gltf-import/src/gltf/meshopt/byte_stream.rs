//! Byte streams of the meshopt codecs: bounds-checked reading from both ends.
//!
//! Streams are untrusted, so every read is checked. Each error is a separate variant, because the
//! message is the only clue to the bug in the encoder.

/// The reason why a stream is invalid.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub(super) enum StreamError {
    /// The first byte does not match the codec.
    #[error("the stream begins with {0:#04x}, an unknown version for its mode")]
    Header(u8),
    /// There are fewer bytes than the elements need.
    #[error("the stream ends too early")]
    Short,
    /// There are more bytes than the elements need.
    #[error("extra bytes at the end of the stream: {0}")]
    Long(usize),
    /// An element refers to another that has not been decoded yet.
    #[error("the stream refers to an edge or vertex that is not yet decoded")]
    Unwritten,
    /// The delta mode of a channel is unknown.
    #[error("a channel of the stream has the unknown mode {0:#04x}")]
    Channel(u8),
    /// The table of common vertex codes is invalid.
    #[error("the corner table of the stream is invalid")]
    Table,
    /// A variable-length integer has too many bytes.
    #[error("a number in the stream has more than five bytes")]
    Number,
}

/// The bytes of a stream that have not been read.
///
/// Reads from the front and the back meet in the middle; [`ByteStream::expect_end`] requires that
/// nothing is left between them.
#[derive(Clone, Debug)]
pub(super) struct ByteStream<'a>(&'a [u8]);

impl<'a> ByteStream<'a> {
    /// Creates a stream from all of its bytes.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    /// Reads the next byte.
    pub(super) fn read_byte(&mut self) -> Result<u8, StreamError> {
        let (&byte, rest) = self.0.split_first().ok_or(StreamError::Short)?;
        self.0 = rest;
        Ok(byte)
    }

    /// Returns the next `count` bytes.
    pub(super) fn take_front(&mut self, count: usize) -> Result<&'a [u8], StreamError> {
        let (bytes, rest) = self.0.split_at_checked(count).ok_or(StreamError::Short)?;
        self.0 = rest;
        Ok(bytes)
    }

    /// Takes the last `count` bytes; tables are stored at the end of a stream.
    pub(super) fn take_back(&mut self, count: usize) -> Result<&'a [u8], StreamError> {
        let rest = self.0.len().checked_sub(count).ok_or(StreamError::Short)?;
        let (rest, bytes) = self.0.split_at(rest);
        self.0 = rest;
        Ok(bytes)
    }

    /// Reads a variable-length integer (LEB128): seven bits per byte, lowest first. The highest bit
    /// of a byte is set if another byte follows.
    ///
    /// # Errors
    /// Returns [`StreamError::Number`] if the fifth byte announces a sixth, and
    /// [`StreamError::Short`] if the stream ends first.
    pub(super) fn read_varint(&mut self) -> Result<u32, StreamError> {
        let mut number = 0;
        for shift in [0, 7, 14, 21, 28] {
            let byte = self.read_byte()?;
            number |= u32::from(byte & 0x7F) << shift;
            if byte < 0x80 {
                return Ok(number);
            }
        }
        Err(StreamError::Number)
    }

    /// Checks that every byte has been read.
    pub(super) fn expect_end(self) -> Result<(), StreamError> {
        if self.0.is_empty() { Ok(()) } else { Err(StreamError::Long(self.0.len())) }
    }

    /// Returns the number of remaining bytes.
    pub(super) fn len(&self) -> usize {
        self.0.len()
    }
}

/// Decodes a zigzag-coded difference, whose sign is the lowest bit: 0, 1, 2, 3 mean 0, −1, 1, −2.
///
/// A negative difference is returned as its two's complement, for wrapping addition.
pub(super) fn decode_zigzag(number: u32) -> u32 {
    if number & 1 == 0 { number >> 1 } else { !(number >> 1) }
}

/// Appends an index in two or four bytes; two bytes hold its lower half.
///
/// `stride` is 2 or 4. In a valid stream, two-byte indices are less than 65536.
pub(super) fn push_index(indices: &mut Vec<u8>, index: u32, stride: usize) {
    indices.extend(&index.to_le_bytes()[..stride]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn varints_have_seven_bits_per_byte() {
        for (bytes, number) in [
            (&[0x7F][..], Ok(0x7F)),
            (&[0x81, 0x04], Ok(0x201)),
            (&[0xFF, 0xA0, 0x05], Ok(0x1_507F)),
            (&[0xFF, 0xFF, 0xFF, 0xFF, 0x7F], Ok(u32::MAX)),
            (&[0xFF, 0xFF, 0xFF, 0xFF, 0xFF], Err(StreamError::Number)),
            (&[0x80, 0x80], Err(StreamError::Short)),
            (&[], Err(StreamError::Short)),
        ] {
            assert_eq!(ByteStream::new(bytes).read_varint(), number, "{bytes:x?}");
        }
    }

    #[test]
    fn zigzag_differences_are_decoded() {
        let signed: Vec<i32> = (0..5).map(|n| decode_zigzag(n).cast_signed()).collect();
        assert_eq!(signed, [0, -1, 1, -2, 2]);
        assert_eq!(decode_zigzag(u32::MAX).cast_signed(), i32::MIN);
    }
}
