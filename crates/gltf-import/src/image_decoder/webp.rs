//! WebP decoding; rejects frames larger than the image before the decoder allocates them.
//!
//! ```text
//!  RIFF length WEBP │ VP8X canvas │ VP8 frame       chunks: id, length, bytes, padded to even
//!                                 │ ANMF position, VP8 frame
//! ```
//! Source: RFC 9649 (the container) and RFC 6386 §9.1 (the frame header).

use super::{blank_texels, checked_image};
use image_webp::WebPDecoder;
use model::Image;
use std::io::Cursor;

/// Reads the width and height from the header.
///
/// # Errors
/// Fails if the container is invalid.
pub(super) fn size(bytes: &[u8]) -> Result<(u32, u32), String> {
    Ok(decoder(bytes)?.dimensions())
}

/// Returns the message for a WebP that cannot be decoded.
fn problem(error: &image_webp::DecodingError) -> String {
    format!("the WebP is broken: {error}")
}

/// Returns a WebP decoder whose memory is limited to 1 GiB.
///
/// # Errors
/// Fails if the container is invalid.
fn decoder(bytes: &[u8]) -> Result<WebPDecoder<Cursor<&[u8]>>, String> {
    let mut decoder = WebPDecoder::new(Cursor::new(bytes)).map_err(|error| problem(&error))?;
    decoder.set_memory_limit(1 << 30);
    Ok(decoder)
}

/// Decodes the first frame of a lossy or lossless WebP.
///
/// Without an alpha channel the decoder produces RGB, so alpha is added here.
pub(super) fn decode(bytes: &[u8]) -> Result<Image, String> {
    let mut decoder = decoder(bytes)?;
    let (width, height) = decoder.dimensions();
    check_frame_sizes(bytes, (width, height))?;
    if decoder.has_alpha() {
        let mut rgba = blank_texels(width, height);
        decoder.read_image(rgba.as_flattened_mut()).map_err(|error| problem(&error))?;
        return Ok(Image { width, height, rgba });
    }
    let mut rgb = vec![0; decoder.output_buffer_size().ok_or("the WebP is too large")?];
    decoder.read_image(&mut rgb).map_err(|error| problem(&error))?;
    let rgba = rgb.as_chunks().0.iter().map(|&[r, g, b]| [r, g, b, 255]);
    checked_image(width, height, rgba.collect())
}

/// Checks that all lossy frames fit in an image of this size.
///
/// A file of a few bytes may declare a frame that takes hundreds of megabytes, and the decoder
/// allocates before it compares the sizes.
fn check_frame_sizes(file: &[u8], size: (u32, u32)) -> Result<(), String> {
    let chunks = file.get(12..).unwrap_or_default();
    for (name, bytes) in RiffChunks(chunks) {
        match &name {
            b"ANMF" => {
                let frames = RiffChunks(bytes.get(16..).unwrap_or_default());
                frames
                    .into_iter()
                    .try_for_each(|(name, bytes)| check_frame_size(name, bytes, size))?;
            }
            _ => check_frame_size(name, bytes, size)?,
        }
    }
    Ok(())
}

/// Checks one chunk. All chunks except `VP8 ` are accepted.
///
/// The 14-bit width and height of a key frame follow its start code `9D 01 2A`.
///
/// # Errors
/// Returns a message with both sizes.
fn check_frame_size(name: [u8; 4], bytes: &[u8], size: (u32, u32)) -> Result<(), String> {
    if &name != b"VP8 " {
        return Ok(());
    }
    let Some(&[_, _, _, 0x9D, 0x01, 0x2A, w0, w1, h0, h1]) = bytes.first_chunk() else {
        return Ok(());
    };
    // The upper two bits are an upscaling hint, which does not affect the decoded size.
    let side = |low, high| u32::from(u16::from_le_bytes([low, high]) & 0x3FFF);
    let (w, h) = (side(w0, w1), side(h0, h1));
    let (width, height) = size;
    if w <= width && h <= height {
        return Ok(());
    }
    Err(format!("the WebP has a frame of {w} x {h} texels in an image of {width} x {height}"))
}

/// An iterator over RIFF chunks, with their ids and data. The last chunk may be truncated.
///
/// Chunks are padded to an even length. The data of an `ANMF` chunk, an animation frame, contains
/// nested chunks.
struct RiffChunks<'a>(&'a [u8]);

impl<'a> Iterator for RiffChunks<'a> {
    type Item = ([u8; 4], &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let (&[a, b, c, d, l0, l1, l2, l3], rest) = self.0.split_first_chunk()?;
        let length = u32::from_le_bytes([l0, l1, l2, l3]) as usize;
        self.0 = rest.get(length.saturating_add(length & 1)..).unwrap_or_default();
        Some(([a, b, c, d], &rest[..length.min(rest.len())]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chunk(name: &[u8; 4], bytes: &[u8]) -> Vec<u8> {
        let mut chunk = [&name[..], &(bytes.len() as u32).to_le_bytes(), bytes].concat();
        chunk.resize(chunk.len().next_multiple_of(2), 0);
        chunk
    }

    fn frame(width: u16, height: u16) -> Vec<u8> {
        let [w, h] = [width, height].map(u16::to_le_bytes);
        chunk(b"VP8 ", &[&[0, 0, 0, 0x9D, 0x01, 0x2A], &w[..], &h[..]].concat())
    }

    #[test]
    fn oversized_frames_are_found_in_every_chunk() {
        let (small, wide, high) = (frame(8, 4), frame(9, 4), frame(8, 5));
        let moving = |frame: &[u8]| chunk(b"ANMF", &[&[0; 16], frame].concat());
        let fits = |chunks: &[&[u8]]| {
            let file = [b"RIFF\0\0\0\0WEBP", &chunks.concat()[..]].concat();
            check_frame_sizes(&file, (8, 4))
        };
        let odd = chunk(b"ICCP", &[1, 2, 3]);
        assert_eq!(fits(&[]), Ok(()));
        assert_eq!(fits(&[&small]), Ok(()));
        assert_eq!(fits(&[&odd, &moving(&small), &small]), Ok(()));
        let too_large =
            |size: &str| Err(format!("the WebP has a frame of {size} texels in an image of 8 x 4"));
        assert_eq!(fits(&[&wide]), too_large("9 x 4"));
        assert_eq!(fits(&[&odd, &small, &high]), too_large("8 x 5"));
        assert_eq!(fits(&[&moving(&small), &moving(&wide)]), too_large("9 x 4"));
        assert_eq!(fits(&[&small, b"VP8 \xFF\xFF\xFF\xFF\0\0\0\x9D\x01"]), Ok(()), "truncated");
        assert_eq!(fits(&[&frame(0x4008, 0xC004)]), Ok(()), "with upscaling hints");
    }
}
