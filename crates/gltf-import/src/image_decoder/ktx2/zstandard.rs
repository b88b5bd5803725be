//! Zstandard frames of known length, decoded within memory derived from it.

use ruzstd::frame::read_frame_header;
use ruzstd::io::Read;
use ruzstd::streaming_decoder::StreamingDecoder;

/// The largest window that is allocated for data shorter than that. KTX tools write a window of the
/// data's length.
const MAX_WINDOW_BYTES: u64 = 8 << 20;

/// Number of bytes taken from the decoder at a time: one block.
const STEP_BYTES: usize = 128 << 10;

/// Decompresses a frame that must have `length` bytes. A checksum is not verified.
///
/// # Errors
/// A message: the frame is broken, needs more memory than its data, or has another length.
pub(super) fn decompress(frame: &[u8], length: usize) -> Result<Vec<u8>, String> {
    let broken = || "the Zstandard data of the KTX2 image is broken".to_owned();
    let (header, _) = read_frame_header(frame).map_err(|_| broken())?;
    let window = header.header.window_size().map_err(|_| broken())?;
    if window > MAX_WINDOW_BYTES.max(length as u64) {
        return Err(format!(
            "the Zstandard data of the KTX2 image needs a window of {window} bytes"
        ));
    }
    let mut decoder = StreamingDecoder::new(frame).map_err(|_| broken())?;
    let mut data = vec![0; length];
    for step in data.chunks_mut(STEP_BYTES) {
        decoder.read_exact(step).map_err(|_| broken())?;
    }
    match decoder.read(&mut [0]) {
        Ok(0) => Ok(data),
        _ => Err(format!("the Zstandard data of the KTX2 image is longer than {length} bytes")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A frame with one uncompressed block (RFC 8878 §3.1).
    fn frame(window_or_length: [u8; 2], block: &[u8]) -> Vec<u8> {
        let header = (block.len() as u32) << 3 | 1;
        let magic = [0x28, 0xB5, 0x2F, 0xFD];
        [&magic[..], &window_or_length, &header.to_le_bytes()[..3], block].concat()
    }

    #[test]
    fn frames_have_the_length_that_is_expected() {
        // A single segment: the length follows instead of a window.
        let file = frame([0x20, 5], b"hello");
        assert_eq!(decompress(&file, 5).as_deref(), Ok(&b"hello"[..]));
        assert!(decompress(&file, 6).is_err(), "too short");
        assert!(decompress(&file, 4).is_err(), "too long");
        (0..file.len()).for_each(|end| assert!(decompress(&file[..end], 5).is_err(), "{end}"));
    }

    #[test]
    fn windows_are_bounded() {
        // A window of 2^(10 + exponent) bytes, the exponent in the upper five bits.
        assert!(decompress(&frame([0, 13 << 3], b"hello"), 5).is_ok());
        let message = decompress(&frame([0, 14 << 3], b"hello"), 5).unwrap_err();
        assert!(message.contains("window of 16777216 bytes"), "{message}");
    }
}
