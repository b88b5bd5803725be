//! meshopt mode ATTRIBUTES: each byte of an element is stored as the difference from the same byte
//! of the previous element.
//!
//! ```text
//!  stream:  version │ block │ … │ padding │ element before the first │ channel modes (version 1)
//!  block:   controls (version 1) │ all bytes 0 of its elements │ all bytes 1 │ …
//!  bytes n: two bits per group │ group of 16 │ group of 16 │ …
//! ```
//!
//! A group stores its differences with 0, 1, 2, 4 or 8 bits each. Below 8 bits, a difference of all
//! ones is an escape: its value follows in a byte after the group. Version 1 adds four-byte
//! channels whose deltas are bytes, 16-bit words or 32-bit XORs, and controls that store bytes
//! uncompressed or omit them. The format is specified in EXT_meshopt_compression (version 0 of the
//! attribute codec) and KHR_meshopt_compression (version 1). Storing bytes by position, not by
//! element, groups similar values: high bytes change rarely, so most of their groups take 0 bits
//! per difference.

use super::byte_stream::{ByteStream, StreamError};

/// Number of elements in a group.
///
/// The format fixes this number; with four bits per difference, a group is one 64-bit word.
const BYTE_GROUP_SIZE: usize = 16;

/// The maximum number of elements in a block.
///
/// A block has at most 8192 bytes, so blocks of long elements have fewer elements.
const VERTEX_BLOCK_MAX_SIZE: usize = 256;

/// Decodes elements of `stride` bytes, a multiple of four up to 256.
///
/// Time and memory are linear in `count * stride`, which the caller has charged to the budget.
///
/// # Errors
/// Fails if the header or a channel mode is unknown, the stream is too short, or bytes remain at
/// its end.
pub(super) fn decode_vertices(
    stream: &[u8],
    count: usize,
    stride: usize,
) -> Result<Vec<u8>, StreamError> {
    let mut stream = ByteStream::new(stream);
    let (has_controls, tail) = match stream.read_byte()? {
        0xA0 => (false, 32),
        0xA1 => (true, 24),
        other => return Err(StreamError::Header(other)),
    };
    let channel_modes = if has_controls { stride / 4 } else { 0 };
    let tail = stream.take_back(tail.max(stride + channel_modes))?;
    let (baseline, modes) = tail[tail.len() - stride - channel_modes..].split_at(stride);
    let channels = if has_controls {
        modes.iter().map(|&mode| DeltaChannel::new(mode)).collect::<Result<Vec<_>, _>>()?
    } else {
        vec![DeltaChannel::Bytes8; stride / 4]
    };
    let block_elements =
        (8192 / stride / BYTE_GROUP_SIZE * BYTE_GROUP_SIZE).min(VERTEX_BLOCK_MAX_SIZE);
    // A block takes at least one byte per channel, so reject streams that are far too short before
    // allocation.
    if stream.len() < count.div_ceil(block_elements).saturating_mul(stride / 4) {
        return Err(StreamError::Short);
    }
    let mut elements = vec![0; count * stride];
    let mut before = baseline.to_vec();
    for block in elements.chunks_mut(block_elements * stride) {
        let controls = if has_controls { Some(stream.take_front(stride / 4)?) } else { None };
        decode_vertex_block(&mut stream, controls, &channels, &before, block)?;
        before.copy_from_slice(&block[block.len() - stride..]);
    }
    stream.expect_end()?;
    Ok(elements)
}

/// Decodes one block into `elements`; `before` is the preceding element.
///
/// The deltas of four adjacent bytes are decoded together, because a channel combines them. Deltas
/// accumulate: each element is decoded from the previous element.
///
/// # Errors
/// Fails if the stream ends within the block.
fn decode_vertex_block(
    stream: &mut ByteStream<'_>,
    controls: Option<&[u8]>,
    channels: &[DeltaChannel],
    before: &[u8],
    elements: &mut [u8],
) -> Result<(), StreamError> {
    let stride = before.len();
    let count = elements.len() / stride;
    let mut deltas = [[0; VERTEX_BLOCK_MAX_SIZE]; 4];
    for (at, channel) in channels.iter().enumerate() {
        for (byte, deltas) in deltas.iter_mut().enumerate() {
            let control = controls.map(|controls| controls[at] >> (2 * byte) & 3);
            decode_byte_deltas(
                stream,
                control,
                &mut deltas[..count.next_multiple_of(BYTE_GROUP_SIZE)],
                count,
            )?;
        }
        let slot = 4 * at..4 * at + 4;
        let mut value = [0; 4];
        value.copy_from_slice(&before[slot.clone()]);
        for (number, element) in elements.chunks_exact_mut(stride).enumerate() {
            value = channel.apply_delta(value, deltas.map(|deltas| deltas[number]));
            element[slot.clone()].copy_from_slice(&value);
        }
    }
    Ok(())
}

/// Reads the deltas of one byte position for all elements of a block; `deltas` has space for whole
/// groups.
///
/// `control` is the two-bit control of version 1: 0 and 1 select a set of bit widths, 2 means all
/// zeros, and 3 means uncompressed bytes. Version 0 has no control and uses another set of widths.
/// The data begins with two bits per group, padded to whole bytes.
fn decode_byte_deltas(
    stream: &mut ByteStream<'_>,
    control: Option<u8>,
    deltas: &mut [u8],
    count: usize,
) -> Result<(), StreamError> {
    let bits = match control {
        None => [0, 2, 4, 8],
        Some(0) => [0, 1, 2, 4],
        Some(1) => [1, 2, 4, 8],
        Some(2) => {
            deltas.fill(0);
            return Ok(());
        }
        Some(_) => {
            deltas[..count].copy_from_slice(stream.take_front(count)?);
            return Ok(());
        }
    };
    let (groups, _) = deltas.as_chunks_mut::<BYTE_GROUP_SIZE>();
    let kinds = stream.take_front(groups.len().div_ceil(4))?;
    for (at, group) in groups.iter_mut().enumerate() {
        let kind = kinds[at / 4] >> (2 * (at % 4)) & 3;
        decode_byte_group(stream, bits[usize::from(kind)], group)?;
    }
    Ok(())
}

/// Unpacks a group of sixteen deltas of 0, 1, 2, 4 or 8 bits.
///
/// With 1, 2 or 4 bits, the largest value is an escape: the delta is the next byte after the packed
/// deltas. With 8 bits, every value is literal.
fn decode_byte_group(
    stream: &mut ByteStream<'_>,
    bits: usize,
    group: &mut [u8; BYTE_GROUP_SIZE],
) -> Result<(), StreamError> {
    match bits {
        0 => group.fill(0),
        8 => group.copy_from_slice(stream.take_front(BYTE_GROUP_SIZE)?),
        _ => {
            let packed = stream.take_front(BYTE_GROUP_SIZE * bits / 8)?;
            let (mask, per_byte) = ((1u8 << bits) - 1, 8 / bits);
            for (at, delta) in group.iter_mut().enumerate() {
                let slot = at % per_byte;
                // Single bits start at the low end of a byte, all other widths at the high end.
                let shift = if bits == 1 { slot } else { 8 - bits * (slot + 1) };
                let value = packed[at / per_byte] >> shift & mask;
                *delta = if value == mask { stream.read_byte()? } else { value };
            }
        }
    }
    Ok(())
}

/// The interpretation of a four-byte delta.
///
/// Version 0 has only bytes. 16-bit words suit quantized attributes; XORs suit floats,
/// because adjacent values share their sign and exponent.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum DeltaChannel {
    /// Four zigzag-coded byte differences.
    Bytes8,
    /// Two zigzag-coded 16-bit differences.
    Words16,
    /// The XOR of two 32-bit words, rotated left by this number of bits.
    Xor32(u32),
}

impl DeltaChannel {
    /// Decodes the channel that a mode byte declares.
    ///
    /// The low half is the kind; the high half is the rotation of an XOR.
    fn new(mode: u8) -> Result<Self, StreamError> {
        match (mode >> 4, mode & 15) {
            (0, 0) => Ok(Self::Bytes8),
            (0, 1) => Ok(Self::Words16),
            (rotation, 2) => Ok(Self::Xor32(u32::from(rotation))),
            _ => Err(StreamError::Channel(mode)),
        }
    }

    /// Applies a delta to the previous value.
    ///
    /// Zigzag coding maps 0, −1, 1, −2, … to 0, 1, 2, 3, …, so that small differences of either
    /// sign need few bits. All arithmetic wraps, as in the encoder.
    fn apply_delta(self, before: [u8; 4], delta: [u8; 4]) -> [u8; 4] {
        match self {
            Self::Bytes8 => std::array::from_fn(|at| {
                let delta = delta[at];
                before[at].wrapping_add(if delta & 1 == 0 { delta >> 1 } else { !(delta >> 1) })
            }),
            Self::Words16 => {
                let word =
                    |bytes: [u8; 4], at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
                let after = |at: usize| {
                    let delta = word(delta, at);
                    let delta = if delta & 1 == 0 { delta >> 1 } else { !(delta >> 1) };
                    word(before, at).wrapping_add(delta).to_le_bytes()
                };
                let ([a, b], [c, d]) = (after(0), after(2));
                [a, b, c, d]
            }
            Self::Xor32(rotation) => {
                let changed = u32::from_le_bytes(delta).rotate_right(rotation);
                (changed ^ u32::from_le_bytes(before)).to_le_bytes()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The example from the specification.
    const NIBBLES: [u8; 10] = [0x17, 0x5F, 0xF0, 0xBC, 0x77, 0xA9, 0x21, 0x00, 0x34, 0xB5];
    const DELTAS: [i8; 16] = [-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0];

    #[test]
    fn groups_of_every_width_are_decoded() {
        let read = |bits: usize, bytes: &[u8]| {
            let (mut group, mut stream) = ([0; BYTE_GROUP_SIZE], ByteStream::new(bytes));
            decode_byte_group(&mut stream, bits, &mut group)
                .and_then(|()| stream.expect_end())
                .map(|()| group)
        };
        let nibbles = read(4, &NIBBLES).unwrap();
        let unfolded = nibbles
            .map(|d| DeltaChannel::Bytes8.apply_delta([0; 4], [d, 0, 0, 0])[0].cast_signed());
        assert_eq!(unfolded, DELTAS);
        let low_first = read(1, &[0b0000_0101, 0x80, 7, 8, 9]).unwrap();
        assert_eq!(low_first, [7, 0, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9]);
        let high_first = read(2, &[0b0001_1011, 0, 0, 0x80, 9]).unwrap();
        assert_eq!(high_first, [0, 1, 2, 9, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0]);
        assert_eq!(read(0, &[]), Ok([0; BYTE_GROUP_SIZE]));
        assert_eq!(read(8, &[5; BYTE_GROUP_SIZE]), Ok([5; BYTE_GROUP_SIZE]));
        assert_eq!(read(8, &[5; BYTE_GROUP_SIZE - 1]), Err(StreamError::Short));
        assert_eq!(read(4, &NIBBLES[..9]), Err(StreamError::Short));
    }

    #[test]
    fn version_0_accumulates_byte_deltas() {
        // In 17 elements, the deltas of byte 0 are the example and a group of zeros, byte 1
        // increases by 1, and bytes 2 and 3 are constant.
        let mut stream = vec![0xA0, 0b0010];
        stream.extend(NIBBLES);
        stream.extend([0b0101, 0xAA, 0xAA, 0xAA, 0xAA, 0x80, 0, 0, 0, 0, 0]);
        stream.extend([0; 28]);
        stream.extend([10, 20, 30, 40]);
        let elements = decode_vertices(&stream, 17, 4).unwrap();
        let mut first = 10u8;
        for (at, element) in elements.chunks(4).enumerate() {
            first = first.wrapping_add_signed(DELTAS.get(at).copied().unwrap_or(0));
            assert_eq!(element, [first, 21 + at as u8, 30, 40], "element {at}");
        }
        for end in 0..stream.len() {
            let cut = decode_vertices(&stream[..end], 17, 4);
            assert_eq!(cut, Err(StreamError::Short), "truncated at {end}");
        }
        assert_eq!(decode_vertices(&stream, 16, 4), Err(StreamError::Long(4)));
        stream.insert(20, 0);
        assert_eq!(decode_vertices(&stream, 17, 4), Err(StreamError::Long(1)));
    }

    #[test]
    fn version_1_decodes_controls_and_three_delta_kinds() {
        let bits = 0x3F80_0000u32 ^ 0x4000_0000;
        let rotated = bits.rotate_left(4).to_le_bytes();
        // Three channels of two elements: bytes in one-bit groups and uncompressed, words, and
        // XORs rotated by 4.
        let mut stream = vec![0xA1, 0b10_10_11_01, 0b10_10_11_11, 0xFF];
        stream.extend([0, 0b01, 0, 6]); // byte 0, one group of one bit: 6 → +3, then 0
        stream.extend([1, 4]); // byte 1: −1, +2
        stream.extend([0x01, 0x02]); // low bytes of words
        stream.extend([0x02, 0x00]); // high bytes: 0x0201 → −257, 0x0002 → +1
        for byte in rotated {
            stream.extend([byte, 0]);
        }
        stream.extend([0; 9]);
        stream.extend([100, 100, 7, 8, 0x00, 0x10, 1, 2]);
        stream.extend(0x3F80_0000u32.to_le_bytes());
        stream.extend([0, 1, 0x42]);
        let elements = decode_vertices(&stream, 2, 12).unwrap();
        let two = 2.0f32.to_le_bytes();
        assert_eq!(elements[..8], [103, 99, 7, 8, 0xFF, 0x0E, 1, 2]);
        assert_eq!(elements[8..12], two);
        assert_eq!(elements[12..20], [103, 101, 7, 8, 0x00, 0x0F, 1, 2]);
        assert_eq!(elements[20..], two);
        for end in 0..stream.len() {
            // The channel modes are at the end, so other bytes take their place if the stream is
            // truncated.
            let cut = decode_vertices(&stream[..end], 2, 12).unwrap_err();
            let is_expected = matches!(cut, StreamError::Short | StreamError::Channel(_));
            assert!(is_expected, "at {end}: {cut}");
        }
        for mode in [0x03, 0x10, 0x11, 0x0F] {
            *stream.last_mut().unwrap() = mode;
            assert_eq!(decode_vertices(&stream, 2, 12), Err(StreamError::Channel(mode)));
        }
    }

    #[test]
    fn blocks_continue_from_the_previous_element() {
        // 300 elements of 64 bytes in blocks of 128, 128 and 44, with every byte increasing by one.
        let mut stream = vec![0xA1];
        for groups in [8usize, 8, 3] {
            stream.extend([0; 16]);
            for _ in 0..64 {
                stream.extend(vec![0xAA; groups.div_ceil(4)]);
                stream.extend(vec![0xAA; 4 * groups]);
            }
        }
        stream.extend([0; 64 + 16]);
        let elements = decode_vertices(&stream, 300, 64).unwrap();
        assert!(elements.chunks(64).enumerate().all(|(at, e)| e == [(at + 1) as u8; 64]));
        assert_eq!(decode_vertices(&stream, usize::MAX / 64, 64), Err(StreamError::Short));
    }
}
