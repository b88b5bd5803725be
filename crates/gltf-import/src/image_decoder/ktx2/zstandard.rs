//! Decodes Zstandard frames of known length, with memory bounded by that length.

use ruzstd::frame::read_frame_header;
use ruzstd::io::Read;
use ruzstd::streaming_decoder::StreamingDecoder;

/// The largest window that is allocated for data shorter than the window. KTX tools set the window
/// size to the length of the data.
const MAX_WINDOW_BYTES: u64 = 8 << 20;

/// Number of bytes read from the decoder at a time: one block.
const STEP_BYTES: usize = 128 << 10;

/// Decompresses a frame that must contain `length` bytes. The checksum is not verified.
///
/// # Errors
/// Returns a message if the frame is broken, needs too large a window, or has the wrong length.
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

    /// Returns a frame with one uncompressed block (RFC 8878 §3.1).
    fn frame(window_or_length: [u8; 2], block: &[u8]) -> Vec<u8> {
        let header = (block.len() as u32) << 3 | 1;
        let magic = [0x28, 0xB5, 0x2F, 0xFD];
        [&magic[..], &window_or_length, &header.to_le_bytes()[..3], block].concat()
    }

    #[test]
    fn frames_must_have_the_expected_length() {
        // In a single segment, the content length replaces the window size.
        let file = frame([0x20, 5], b"hello");
        assert_eq!(decompress(&file, 5).as_deref(), Ok(&b"hello"[..]));
        assert!(decompress(&file, 6).is_err(), "too short");
        assert!(decompress(&file, 4).is_err(), "too long");
        (0..file.len()).for_each(|end| assert!(decompress(&file[..end], 5).is_err(), "{end}"));
    }

    #[test]
    fn windows_are_bounded() {
        // The window has 2^(10 + exponent) bytes; the exponent is in the upper five bits.
        assert!(decompress(&frame([0, 13 << 3], b"hello"), 5).is_ok());
        let message = decompress(&frame([0, 14 << 3], b"hello"), 5).unwrap_err();
        assert!(message.contains("window of 16777216 bytes"), "{message}");
    }
}
