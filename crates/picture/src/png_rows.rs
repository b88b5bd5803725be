//! PNG streaming: compresses pixels as they arrive, so the whole picture never needs to be in
//! memory.

use crate::Channel;
use png::{BitDepth, ColorType, Compression, Encoder, SrgbRenderingIntent, StreamWriter};
use std::io::{self, Write};

/// The size of a data chunk (IDAT) in the file, in bytes.
const CHUNK_BYTES: usize = 1 << 20;
/// The number of pixels converted to bytes and passed to the compressor at once.
const PIXELS_PER_WRITE: usize = 1 << 13;

/// The pixel stream of a PNG file that is being written, with rows from the top.
///
/// The bytes of the file do not depend on how many pixels are written at a time.
pub struct PngRows<'a, 'out> {
    stream: StreamWriter<'a, &'out mut dyn Write>,
    opaque: bool,
    /// The buffer of converted pixels.
    bytes: Vec<u8>,
}

/// Encodes a PNG file of the given width and height with 8 or 16 bits per channel, as RGB if the
/// picture is opaque, otherwise as RGBA with straight alpha. `draw` writes the pixels.
///
/// The file is tagged as sRGB. Encoding needs memory for only one chunk of compressed data.
///
/// # Errors
/// Fails if the file cannot be written, or if `draw` fails or writes too many or too few pixels.
pub fn encode_png<E: From<io::Error>>(
    out: &mut dyn Write,
    size: [u32; 2],
    opaque: bool,
    bits: u8,
    draw: impl FnOnce(&mut PngRows<'_, '_>) -> Result<(), E>,
) -> Result<(), E> {
    let mut writer = write_header(out, size, opaque, bits)?;
    {
        let stream = writer.stream_writer_with_size(CHUNK_BYTES).map_err(io::Error::from)?;
        let mut rows = PngRows { stream, opaque, bytes: Vec::new() };
        draw(&mut rows)?;
        rows.stream.finish().map_err(io::Error::from)?;
    }
    Ok(writer.finish().map_err(io::Error::from)?)
}

/// Writes the start of a file: its size, format and color space.
fn write_header(
    out: &mut dyn Write,
    size: [u32; 2],
    opaque: bool,
    bits: u8,
) -> io::Result<png::Writer<&mut dyn Write>> {
    let mut encoder = Encoder::new(out, size[0], size[1]);
    encoder.set_color(if opaque { ColorType::Rgb } else { ColorType::Rgba });
    encoder.set_depth(if bits == 16 { BitDepth::Sixteen } else { BitDepth::Eight });
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    // Slower levels gain little for rendered pictures.
    encoder.set_compression(Compression::Fast);
    encoder.write_header().map_err(io::Error::from)
}

impl PngRows<'_, '_> {
    /// Writes the next pixels, in row-major order, without alpha if the picture is opaque.
    ///
    /// # Errors
    /// Fails if writing fails, or if there are more pixels than the picture still needs.
    pub fn write_pixels<C: Channel>(&mut self, pixels: &[[C; 4]]) -> io::Result<()> {
        for pixels in pixels.chunks(PIXELS_PER_WRITE) {
            self.bytes.clear();
            C::append_pixels(pixels, self.opaque, &mut self.bytes);
            self.stream.write_all(&self.bytes)?;
        }
        Ok(())
    }
}

impl std::fmt::Debug for PngRows<'_, '_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PngRows").field("opaque", &self.opaque).finish_non_exhaustive()
    }
}
