//! meshopt mode INDICES: each index is stored as its difference from one of two baselines.
//!
//! Line lists and strips often alternate between two distant sequences of vertices, each of which
//! one baseline follows. The lowest bit of a number selects the baseline; the other bits are a
//! zigzag-coded difference:
//!
//! ```text
//!  varint  d d d d d s b     b: baseline 0 or 1    s: sign    d: difference
//! ```

use super::byte_stream::{ByteStream, StreamError, decode_zigzag, push_index};

/// Decodes indices of `stride` bytes, which is 2 or 4.
///
/// The last four bytes are padding, which lets other decoders read past the end of an index.
///
/// # Errors
/// Fails if the header is unknown, the stream ends too early, or bytes remain at its end.
pub(super) fn decode_index_sequence(
    stream: &[u8],
    count: usize,
    stride: usize,
) -> Result<Vec<u8>, StreamError> {
    let mut stream = ByteStream::new(stream);
    match stream.read_byte()? {
        0xD1 => {}
        other => return Err(StreamError::Header(other)),
    }
    stream.take_back(4)?;
    // An index takes at least one byte, so reject short streams before allocation.
    if stream.len() < count {
        return Err(StreamError::Short);
    }
    let mut indices = Vec::with_capacity(count * stride);
    let mut last = [0u32; 2];
    for _ in 0..count {
        let number = stream.read_varint()?;
        let base = &mut last[number as usize & 1];
        *base = base.wrapping_add(decode_zigzag(number >> 1));
        push_index(&mut indices, *base, stride);
    }
    stream.expect_end()?;
    Ok(indices)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_baselines_are_decoded() {
        // +3 and +5 from 0 on baseline 0, −100 from 0 on baseline 1, then −1 on baseline 0.
        let stream = [0xD1, 6 << 1, 4 << 1, 0x8F, 0x03, 1 << 1, 0, 0, 0, 0];
        let last = |index: u32, stride: usize| index.to_le_bytes()[..stride].to_vec();
        for stride in [2, 4] {
            let expected = [3, 5, (-100i32).cast_unsigned(), 4].map(|i| last(i, stride)).concat();
            assert_eq!(decode_index_sequence(&stream, 4, stride), Ok(expected));
        }
        for end in 0..stream.len() {
            let cut = decode_index_sequence(&stream[..end], 4, 2);
            assert_eq!(cut, Err(StreamError::Short), "truncated at {end}");
        }
        assert_eq!(decode_index_sequence(&stream, 3, 2), Err(StreamError::Long(1)));
        assert_eq!(decode_index_sequence(&stream, 5, 2), Err(StreamError::Short));
        assert_eq!(decode_index_sequence(&stream, usize::MAX, 4), Err(StreamError::Short));
        assert_eq!(
            decode_index_sequence(&[0xD0, 0, 0, 0, 0], 0, 2),
            Err(StreamError::Header(0xD0))
        );
    }
}
