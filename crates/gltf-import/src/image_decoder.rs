//! Image decoding to 8-bit RGBA: PNG, JPEG and, with the features `webp` and `basisu`, WebP and
//! KTX2.
//!
//! The format is detected from the first bytes; the file name and the glTF `mimeType` are ignored.
//! Sizes are read from the header and checked before any decoder allocates, and a panic in a
//! decoder is treated as a decoding error.

mod jpeg;
#[cfg(feature = "basisu")]
mod ktx2;
#[cfg(feature = "webp")]
mod webp;

use jpeg::check_chroma_sampling;
use model::Image;
use png::{BitDepth, ColorType, Transformations};
use std::borrow::Cow;
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// An image that has been read from a file but not decoded.
///
/// The size has been checked against the limits.
pub(crate) struct EncodedImage<'a> {
    /// Index of the image in the file.
    pub(crate) index: usize,
    /// The encoded bytes.
    pub(crate) bytes: Cow<'a, [u8]>,
    /// Width and height in texels.
    pub(crate) size: (u32, u32),
}

/// Returns whether images of a media type that glTF allows can be decoded; for KTX2 and WebP this
/// depends on the features.
#[must_use]
pub fn is_decoded(media_type: &str) -> bool {
    match media_type {
        "image/ktx2" => cfg!(feature = "basisu"),
        "image/webp" => cfg!(feature = "webp"),
        _ => true,
    }
}

/// Reads the width and height from the header, without decoding.
///
/// Rejects decompression bombs: images that declare more texels than their bytes can encode.
///
/// # Errors
/// Returns a message if the format is unknown, the header is broken, or the size is implausible.
///
/// Whether a size is plausible depends on the compression ratio that the format can achieve.
pub fn image_size(bytes: &[u8]) -> Result<(u32, u32), String> {
    catch_decoder_panic(|| match ImageFormat::from_magic(bytes)? {
        ImageFormat::Png => {
            let mut decoder = png::Decoder::new(Cursor::new(bytes));
            let header = decoder.read_header_info().map_err(|error| png_problem(&error))?;
            Ok((header.width, header.height))
        }
        ImageFormat::Jpeg => {
            let mut decoder = jpeg_decoder(bytes);
            decoder.decode_headers().map_err(|error| jpeg_problem(&error))?;
            let info = decoder.info().ok_or("the JPEG has no header")?;
            Ok((u32::from(info.width), u32::from(info.height)))
        }
        #[cfg(feature = "webp")]
        ImageFormat::WebP => webp::size(bytes),
        #[cfg(feature = "basisu")]
        ImageFormat::Ktx2 => ktx2::size(bytes),
    })
    .and_then(|(width, height)| {
        let (texels, most) = (
            u64::from(width) * u64::from(height),
            ImageFormat::from_magic(bytes)?.max_plausible_texels(bytes.len()),
        );
        if texels <= most {
            Ok((width, height))
        } else {
            Err(decompression_bomb(width, height, bytes.len()))
        }
    })
}

/// Returns the name of the format (`png`, `jpeg`, `webp` or `ktx2`), or an empty string if it is
/// unknown.
pub(crate) fn format_name(bytes: &[u8]) -> &'static str {
    match ImageFormat::from_magic(bytes) {
        Ok(ImageFormat::Png) => "png",
        Ok(ImageFormat::Jpeg) => "jpeg",
        #[cfg(feature = "webp")]
        Ok(ImageFormat::WebP) => "webp",
        #[cfg(feature = "basisu")]
        Ok(ImageFormat::Ktx2) => "ktx2",
        Err(_) => "",
    }
}

/// Decodes an image of at most `max_texels` texels, checking the header before allocating.
///
/// ```
/// let message = import::decode_image(b"GIF89a", 1 << 20).unwrap_err();
/// assert!(message.starts_with("this is a GIF image; only PNG, JPEG, WebP"));
/// ```
///
/// # Errors
/// Returns a message if the format is unknown, the data is broken, or the image is too large.
pub fn decode_bounded(bytes: &[u8], max_texels: u64) -> Result<Image, String> {
    let (width, height) = image_size(bytes)?;
    if u64::from(width) * u64::from(height) > max_texels {
        return Err(format!("the image has {width} x {height} texels; the limit is {max_texels}"));
    }
    decode_rgba(bytes)
}

/// Decodes the whole image into 4 bytes per texel. Callers must check [`image_size`] first.
pub(crate) fn decode_rgba(bytes: &[u8]) -> Result<Image, String> {
    catch_decoder_panic(|| match ImageFormat::from_magic(bytes)? {
        ImageFormat::Png => decode_png(bytes),
        ImageFormat::Jpeg => decode_jpeg(bytes),
        #[cfg(feature = "webp")]
        ImageFormat::WebP => webp::decode(bytes),
        #[cfg(feature = "basisu")]
        ImageFormat::Ktx2 => ktx2::decode(bytes),
    })
}

/// Runs a decoder. A panic is treated as a broken image.
///
/// A decoder may panic on a malformed file, and one broken texture must not abort the program.
fn catch_decoder_panic<T>(work: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work))
        .unwrap_or_else(|_| Err("the image decoder failed".to_owned()))
}

/// Returns the message for a header that declares more texels than the bytes can encode.
fn decompression_bomb(width: u32, height: u32, bytes: usize) -> String {
    format!("the image declares {width} x {height} texels, too many for {bytes} bytes")
}

/// Number of texels allowed for an image of only a few bytes, in formats that can store a flat
/// color that compactly.
#[cfg(any(feature = "webp", feature = "basisu"))]
const BOMB_ALLOWANCE_TEXELS: u64 = 8 << 20;

/// The supported image formats, for messages.
const READ_FORMATS: &str = match (cfg!(feature = "webp"), cfg!(feature = "basisu")) {
    (true, true) => "PNG, JPEG, WebP and KTX2",
    (true, false) => "PNG, JPEG and WebP",
    (false, true) => "PNG, JPEG and KTX2",
    (false, false) => "PNG and JPEG",
};

/// A supported image format.
enum ImageFormat {
    /// PNG (ISO/IEC 15948).
    Png,
    /// JPEG: baseline or progressive (ITU-T T.81).
    Jpeg,
    /// WebP: lossy or lossless (RFC 9649).
    #[cfg(feature = "webp")]
    WebP,
    /// KTX2: ETC1S and UASTC from Basis Universal, or 8-bit texels (KTX 2.0).
    #[cfg(feature = "basisu")]
    Ktx2,
}

impl ImageFormat {
    /// Returns an upper bound on the number of texels that an image of this many bytes can encode.
    ///
    /// - PNG: deflate expands one byte to at most 1,032 bytes, and a byte holds eight 1-bit texels.
    /// - JPEG: each block of 64 texels takes at least one bit.
    /// - WebP and KTX2: a flat image takes almost no bytes, so the number of texels itself is
    ///   limited. Decoding [`BOMB_ALLOWANCE_TEXELS`] texels takes 70 MB.
    fn max_plausible_texels(&self, bytes: usize) -> u64 {
        let bytes = bytes as u64;
        match self {
            Self::Png => bytes.saturating_mul(8 * 1032),
            Self::Jpeg => bytes.saturating_mul(8 * 64),
            #[cfg(feature = "webp")]
            Self::WebP => bytes.saturating_mul(1024).saturating_add(BOMB_ALLOWANCE_TEXELS),
            #[cfg(feature = "basisu")]
            Self::Ktx2 => bytes.saturating_mul(1024).saturating_add(BOMB_ALLOWANCE_TEXELS),
        }
    }

    /// Detects the format from its magic number. The error names formats that are known but
    /// unsupported.
    fn from_magic(bytes: &[u8]) -> Result<Self, String> {
        let other = match bytes {
            [0x89, b'P', b'N', b'G', ..] => return Ok(Self::Png),
            [0xFF, 0xD8, 0xFF, ..] => return Ok(Self::Jpeg),
            #[cfg(feature = "webp")]
            [..] if is_webp(bytes) => return Ok(Self::WebP),
            #[cfg(feature = "basisu")]
            [..] if bytes.starts_with(&ktx2::MAGIC) => return Ok(Self::Ktx2),
            [] => return Err("the image is empty".to_owned()),
            [..] if is_webp(bytes) => "a WebP image",
            [0xAB, b'K', b'T', b'X', ..] => "a KTX image",
            [b'D', b'D', b'S', b' ', ..] => "a DDS image",
            [b'G', b'I', b'F', b'8', ..] => "a GIF image",
            [b'B', b'M', ..] => "a BMP image",
            [b'<', ..] => "an SVG image or a web page",
            _ => "an unknown format",
        };
        Err(format!("this is {other}; only {READ_FORMATS} are supported"))
    }
}

/// Returns whether a file starts with the header of a WebP file: a RIFF container of type `WEBP`.
fn is_webp(bytes: &[u8]) -> bool {
    matches!(bytes, [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..])
}

/// Returns the message for a PNG that cannot be decoded.
fn png_problem(error: &png::DecodingError) -> String {
    format!("the PNG is broken: {error}")
}

/// Decodes a PNG to 8-bit RGBA, converting palettes, gray and 16-bit channels.
///
/// Color profiles and text chunks are skipped; glTF requires that profiles be ignored (§3.8.3). The
/// decoder's memory is limited to 1 GiB.
fn decode_png(bytes: &[u8]) -> Result<Image, String> {
    let message = |error: png::DecodingError| png_problem(&error);
    let mut decoder =
        png::Decoder::new_with_limits(Cursor::new(bytes), png::Limits { bytes: 1 << 30 });
    decoder.set_transformations(Transformations::normalize_to_color8() | Transformations::ALPHA);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let mut reader = decoder.read_info().map_err(message)?;
    let (width, height) = reader.info().size();
    match reader.output_color_type() {
        (ColorType::Rgba, BitDepth::Eight) => {
            let mut rgba = blank_texels(width, height);
            reader.next_frame(rgba.as_flattened_mut()).map_err(message)?;
            Ok(Image { width, height, rgba })
        }
        // The transformation adds alpha to every format, so gray has two channels.
        (ColorType::GrayscaleAlpha, BitDepth::Eight) => {
            let mut grey = vec![0; reader.output_buffer_size().ok_or("the PNG is too large")?];
            reader.next_frame(&mut grey).map_err(message)?;
            let pairs = grey.as_chunks().0.iter();
            checked_image(width, height, pairs.map(|&[y, alpha]| [y, y, y, alpha]).collect())
        }
        (color, depth) => Err(format!(
            "the PNG decodes to {color:?} with bit depth {depth:?}, which is not supported"
        )),
    }
}

/// Allocates texels for a decoder to fill, initialized to transparent black.
fn blank_texels(width: u32, height: u32) -> Vec<[u8; 4]> {
    vec![[0; 4]; width as usize * height as usize]
}

/// Returns a JPEG decoder with RGBA output and the maximum size of the format, 65535 in each
/// direction.
fn jpeg_decoder(bytes: &[u8]) -> JpegDecoder<ZCursor<&[u8]>> {
    let options = DecoderOptions::default()
        .jpeg_set_out_colorspace(ColorSpace::RGBA)
        .set_max_width(usize::from(u16::MAX))
        .set_max_height(usize::from(u16::MAX));
    JpegDecoder::new_with_options(ZCursor::new(bytes), options)
}

/// Returns the message for a JPEG that cannot be decoded.
fn jpeg_problem(error: &zune_jpeg::errors::DecodeErrors) -> String {
    format!("the JPEG is broken: {error}")
}

/// Decodes a baseline or progressive JPEG; CMYK is rejected because it needs a color profile.
fn decode_jpeg(bytes: &[u8]) -> Result<Image, String> {
    check_chroma_sampling(bytes)?;
    let mut decoder = jpeg_decoder(bytes);
    decoder.decode_headers().map_err(|error| jpeg_problem(&error))?;
    if let Some(space @ (ColorSpace::CMYK | ColorSpace::YCCK)) = decoder.input_colorspace() {
        return Err(format!(
            "the JPEG is in {space:?}, a print color space; only RGB and gray are supported"
        ));
    }
    let info = decoder.info().ok_or("the JPEG has no header")?;
    let (width, height) = (u32::from(info.width), u32::from(info.height));
    let mut rgba = blank_texels(width, height);
    decoder.decode_into(rgba.as_flattened_mut()).map_err(|error| jpeg_problem(&error))?;
    Ok(Image { width, height, rgba })
}

/// Returns the image if the number of texels matches its size.
fn checked_image(width: u32, height: u32, rgba: Vec<[u8; 4]>) -> Result<Image, String> {
    if rgba.len() as u64 == u64::from(width) * u64::from(height) {
        Ok(Image { width, height, rgba })
    } else {
        Err("the image is incomplete".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a PNG of 2 x 1 texels with these bytes as its only row.
    fn png(color: ColorType, depth: BitDepth, row: &[u8], palette: Option<&[u8]>) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if let Some(palette) = palette {
            encoder.set_palette(palette);
            encoder.set_trns(&[255, 64][..]);
        }
        encoder.write_header().unwrap().write_image_data(row).unwrap();
        bytes
    }

    /// Returns a baseline JPEG of 8 x 8 middle gray texels. Every coefficient is 0, and each of the
    /// two Huffman tables has the single code `0`, meaning "no difference" and "end of block".
    fn jpeg(components: u8) -> Vec<u8> {
        let numbers = || 1..=components;
        let mut bytes = vec![0xFF, 0xD8, 0xFF, 0xDB, 0, 67, 0];
        bytes.extend([1; 64]);
        bytes.extend([0xFF, 0xC0, 0, 8 + 3 * components, 8, 0, 8, 0, 8, components]);
        numbers().for_each(|number| bytes.extend([number, 0x11, 0]));
        for table in [0x00, 0x10] {
            bytes.extend([0xFF, 0xC4, 0, 20, table, 1]);
            bytes.extend([0; 16]);
        }
        bytes.extend([0xFF, 0xDA, 0, 6 + 2 * components, components]);
        numbers().for_each(|number| bytes.extend([number, 0]));
        bytes.extend([0, 63, 0, 0x00, 0xFF, 0xD9]);
        bytes
    }

    #[test]
    fn every_png_color_type_becomes_8_bit_rgba() {
        use ColorType::{Grayscale, GrayscaleAlpha, Indexed, Rgb, Rgba};
        let palette: &[u8] = &[1, 2, 3, 4, 5, 6];
        type Row<'a> = (ColorType, BitDepth, &'a [u8], Option<&'a [u8]>, [[u8; 4]; 2]);
        let table: [Row<'_>; 9] = [
            (Rgba, BitDepth::Eight, &[1, 2, 3, 4, 5, 6, 7, 8], None, [[1, 2, 3, 4], [5, 6, 7, 8]]),
            (Rgb, BitDepth::Eight, &[1, 2, 3, 5, 6, 7], None, [[1, 2, 3, 255], [5, 6, 7, 255]]),
            (GrayscaleAlpha, BitDepth::Eight, &[9, 4, 7, 8], None, [[9, 9, 9, 4], [7, 7, 7, 8]]),
            (Grayscale, BitDepth::Eight, &[9, 7], None, [[9, 9, 9, 255], [7, 7, 7, 255]]),
            (Grayscale, BitDepth::One, &[0b0100_0000], None, [[0, 0, 0, 255], [255; 4]]),
            (Grayscale, BitDepth::Four, &[0x2F], None, [[34, 34, 34, 255], [255; 4]]),
            (Grayscale, BitDepth::Sixteen, &[9, 99, 7, 0], None, [[9, 9, 9, 255], [7, 7, 7, 255]]),
            (Indexed, BitDepth::Eight, &[1, 0], Some(palette), [[4, 5, 6, 64], [1, 2, 3, 255]]),
            (
                Indexed,
                BitDepth::One,
                &[0b1000_0000],
                Some(palette),
                [[4, 5, 6, 64], [1, 2, 3, 255]],
            ),
        ];
        for (color, depth, row, palette, rgba) in table {
            let file = png(color, depth, row, palette);
            assert_eq!(image_size(&file), Ok((2, 1)));
            assert_eq!(
                decode_rgba(&file).unwrap().rgba,
                rgba,
                "{color:?} with bit depth {depth:?}"
            );
        }
    }

    #[test]
    fn gray_and_rgb_jpegs_are_read_and_cmyk_jpegs_rejected() {
        for components in [1, 3] {
            let image = decode_rgba(&jpeg(components)).unwrap();
            assert_eq!((image.width, image.height), (8, 8));
            assert_eq!(image.rgba, [[128, 128, 128, 255]; 64], "{components} components");
        }
        let message = decode_rgba(&jpeg(4)).unwrap_err();
        assert_eq!(
            message,
            "the JPEG is in CMYK, a print color space; only RGB and gray are supported"
        );
    }
}
