//! The KTX2 container: header, data format descriptor, key/value data, and the first level.
//!
//! ```text
//!  identifier │ header │ level index │ descriptor │ key/value data │ global data │ levels
//!       12        68       24 each         offsets and lengths in the header and the index
//! ```
//! Source: Khronos KTX File Format Specification 2.0, §3. glTF allows only 2D images with one layer
//! and one face (KHR_texture_basisu).

use super::zstandard;
use std::borrow::Cow;

/// The identifier at the beginning of a KTX2 file (KTX 2.0 §3.1).
pub(in super::super) const MAGIC: [u8; 12] = *b"\xABKTX 20\xBB\r\n\x1A\n";

/// Maximum number of texels in an image, because `basisu` counts their bytes in 32 bits.
const MAX_TEXELS: u64 = 1 << 28;

/// Maximum number of mip levels, for an image of 2^31 texels per side.
const MAX_LEVELS: u32 = 32;

/// Reads the width and height of the first mip level from the header (KTX 2.0 §3).
///
/// # Errors
/// Returns a message if the header is truncated, or there are no texels or too many.
pub(in super::super) fn size(bytes: &[u8]) -> Result<(u32, u32), String> {
    // One-dimensional textures have a height of 0.
    let (width, height) = (word(bytes, 20)?, word(bytes, 24)?.max(1));
    match u64::from(width) * u64::from(height) {
        0 => Err("the KTX2 image has no texels".to_owned()),
        1..=MAX_TEXELS => Ok((width, height)),
        _ => Err(format!(
            "the KTX2 image has {width} x {height} texels; \
             at most 16384 x 16384 are supported"
        )),
    }
}

/// The encoding of the texels.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum TexelEncoding {
    /// Basis Universal ETC1S: codebooks and indices.
    Etc1s,
    /// Basis Universal UASTC: blocks of 16 bytes.
    Uastc,
    /// Three bytes per texel.
    Rgb8,
    /// Four bytes per texel.
    Rgba8,
}

/// A KTX2 file, with all parts verified to be inside it.
pub(super) struct Ktx2File<'a> {
    /// Width in texels.
    pub(super) width: u32,
    /// Height in texels.
    pub(super) height: u32,
    /// The encoding of the texels.
    pub(super) encoding: TexelEncoding,
    /// Whether there is a second slice of ETC1S data, for alpha or green.
    has_second_slice: bool,
    /// Whether only red and green are stored, as gray and alpha.
    pub(super) has_red_and_green_only: bool,
    /// Whether rows run from right to left, and whether the bottom row is first.
    pub(super) orientation: [bool; 2],
    /// Whether the level is compressed with Zstandard.
    is_zstandard: bool,
    /// Number of mip levels that the file declares.
    level_count: u32,
    /// The bytes of the first (largest) level.
    level: &'a [u8],
    /// The supercompression global data.
    global_data: &'a [u8],
}

/// The slices of an ETC1S image, with the data needed to decode them.
pub(super) struct Etc1sImage<'a> {
    /// The codebooks shared by all images in the file.
    pub(super) codebooks: Codebooks<'a>,
    /// The indices of the color blocks.
    pub(super) color: &'a [u8],
    /// The indices of the blocks in the other slice.
    pub(super) alpha: Option<&'a [u8]>,
}

/// The ETC1S codebooks, still compressed.
pub(super) struct Codebooks<'a> {
    /// Counts and data of the endpoints and selectors.
    pub(super) palettes: [(u32, &'a [u8]); 2],
    /// Huffman tables for the slices.
    pub(super) tables: &'a [u8],
}

impl<'a> Ktx2File<'a> {
    /// Reads the header and finds the parts.
    ///
    /// # Errors
    /// Returns a message if a part is outside the file, or of a kind that glTF does not allow.
    pub(super) fn read(bytes: &'a [u8]) -> Result<Self, String> {
        let (width, height) = size(bytes)?;
        check_shape(bytes)?;
        let level_count = word(bytes, 40)?.max(1);
        if level_count > MAX_LEVELS {
            return Err(format!(
                "the KTX2 image has {level_count} mip levels; at most {MAX_LEVELS} are allowed"
            ));
        }
        let descriptor = part(bytes, u64::from(word(bytes, 48)?), u64::from(word(bytes, 52)?))?;
        let (encoding, channels) = read_encoding(word(bytes, 12)?, descriptor)?;
        let scheme = word(bytes, 44)?;
        let is_zstandard = match (scheme, encoding) {
            (1, TexelEncoding::Etc1s)
            | (0, TexelEncoding::Uastc | TexelEncoding::Rgb8 | TexelEncoding::Rgba8) => false,
            (2, TexelEncoding::Uastc | TexelEncoding::Rgb8 | TexelEncoding::Rgba8) => true,
            _ => {
                return Err(format!(
                    "the KTX2 image uses {encoding:?} with supercompression scheme {scheme}, which \
                     is not supported"
                ));
            }
        };
        let keys = part(bytes, u64::from(word(bytes, 56)?), u64::from(word(bytes, 60)?))?;
        Ok(Self {
            width,
            height,
            encoding,
            has_second_slice: channels.len() > 1,
            has_red_and_green_only: match encoding {
                TexelEncoding::Etc1s => channels.get(1) == Some(&CHANNEL_ETC1S_GREEN),
                TexelEncoding::Uastc => channels.first() == Some(&CHANNEL_UASTC_RED_GREEN),
                TexelEncoding::Rgb8 | TexelEncoding::Rgba8 => false,
            },
            orientation: read_orientation(keys),
            is_zstandard,
            level_count,
            level: part(bytes, long(bytes, 80)?, long(bytes, 88)?)?,
            global_data: part(bytes, long(bytes, 64)?, long(bytes, 72)?)?,
        })
    }

    /// Returns the number of 4 x 4 texel blocks across and down.
    pub(super) const fn block_counts(&self) -> [u32; 2] {
        [self.width.div_ceil(4), self.height.div_ceil(4)]
    }

    /// Returns the decompressed data of the level: `unit` bytes per UASTC block or texel.
    ///
    /// # Errors
    /// Returns a message if the data is broken or has the wrong length.
    pub(super) fn level_data(&self, unit: usize) -> Result<Cow<'a, [u8]>, String> {
        let [columns, rows] = match self.encoding {
            TexelEncoding::Etc1s | TexelEncoding::Uastc => self.block_counts(),
            TexelEncoding::Rgb8 | TexelEncoding::Rgba8 => [self.width, self.height],
        };
        let length = columns as usize * rows as usize * unit;
        if self.is_zstandard {
            return zstandard::decompress(self.level, length).map(Cow::Owned);
        }
        if self.level.len() == length {
            return Ok(Cow::Borrowed(self.level));
        }
        let found = self.level.len();
        Err(format!("the first level of the KTX2 image has {found} bytes instead of {length}"))
    }

    /// Returns the parts of an ETC1S image (KTX 2.0 §5.1: BasisLZ global data).
    ///
    /// ```text
    ///  counts of endpoints, selectors │ lengths │ descriptions │ endpoints │ selectors │ tables
    ///             2 + 2                  4 × 4    20 for a level
    /// ```
    ///
    /// # Errors
    /// Returns a message if a part is outside the data, or the image is a frame of a video.
    pub(super) fn etc1s_image(&self) -> Result<Etc1sImage<'a>, String> {
        const IS_P_FRAME: u32 = 2;
        let data = self.global_data;
        let counts = word(data, 0)?;
        let mut at = 20 + 20 * u64::from(self.level_count);
        let mut next_part = |field: usize| {
            let length = u64::from(word(data, field)?);
            // The sum cannot overflow: each length has 32 bits.
            at += length;
            part(data, at - length, length)
        };
        let [endpoints, selectors] = [next_part(4)?, next_part(8)?];
        let tables = next_part(12)?;
        if word(data, 20)? & IS_P_FRAME != 0 {
            return Err("the KTX2 image is a video frame that depends on other frames".to_owned());
        }
        let slice = |offset: usize| {
            part(self.level, u64::from(word(data, offset)?), u64::from(word(data, offset + 4)?))
        };
        Ok(Etc1sImage {
            codebooks: Codebooks {
                palettes: [(counts & 0xFFFF, endpoints), (counts >> 16, selectors)],
                tables,
            },
            color: slice(24)?,
            alpha: self.has_second_slice.then(|| slice(32)).transpose()?,
        })
    }
}

/// Channel id of an ETC1S slice for green (Khronos data format specification §5.6).
const CHANNEL_ETC1S_GREEN: u8 = 4;
/// Channel id of UASTC blocks for red and green.
const CHANNEL_UASTC_RED_GREEN: u8 = 5;

/// Rejects volumes, arrays and cube maps, which glTF textures cannot be.
fn check_shape(bytes: &[u8]) -> Result<(), String> {
    let [depth, layers, faces] = [word(bytes, 28)?, word(bytes, 32)?, word(bytes, 36)?];
    let (count, what) = match (depth, layers, faces) {
        (2.., ..) => (depth, "slices"),
        (_, 2.., _) => (layers, "layers"),
        (_, _, 1) => return Ok(()),
        _ => (faces, "faces"),
    };
    Err(format!("the KTX2 image has {count} {what}; a glTF texture has one"))
}

/// Reads the encoding and, for Basis Universal, the channel of each sample.
///
/// `format` is a Vulkan format number; if it is 0, the color model of the data format descriptor
/// applies.
///
/// # Errors
/// Returns a message with the number of the unsupported format or color model.
fn read_encoding(format: u32, descriptor: &[u8]) -> Result<(TexelEncoding, Vec<u8>), String> {
    const HEADER_BYTES: usize = 28;
    let samples = descriptor.get(HEADER_BYTES..).unwrap_or_default().as_chunks::<16>().0;
    let channels: Vec<u8> = samples.iter().take(4).map(|sample| sample[3] & 15).collect();
    let encoding = match (format, word(descriptor, 12)? & 0xFF) {
        (0, 163) => TexelEncoding::Etc1s,
        (0, 166) => TexelEncoding::Uastc,
        (0, model) => {
            return Err(format!(
                "the KTX2 image has color model {model}; only Basis Universal (ETC1S, UASTC) and \
                 8-bit RGB and RGBA are supported"
            ));
        }
        (23 | 29, _) => TexelEncoding::Rgb8,
        (37 | 43, _) => TexelEncoding::Rgba8,
        (format, _) => {
            return Err(format!(
                "the KTX2 image has Vulkan format {format}; only Basis Universal (ETC1S, UASTC) \
                 and 8-bit RGB and RGBA are supported"
            ));
        }
    };
    Ok((encoding, channels))
}

/// Returns whether rows run from right to left, and whether the bottom row is first. This is
/// `KTXorientation` in the key/value data, which is usually `rd` or missing. An invalid value is
/// treated as missing.
fn read_orientation(mut entries: &[u8]) -> [bool; 2] {
    const KEY: &[u8] = b"KTXorientation\0";
    while let Some((length, rest)) = entries.split_first_chunk() {
        let length = u32::from_le_bytes(*length) as usize;
        let Some(entry) = rest.get(..length) else { break };
        if let Some([x, y, ..]) = entry.strip_prefix(KEY) {
            return [*x == b'l', *y == b'u'];
        }
        entries = rest.get(length.next_multiple_of(4)..).unwrap_or_default();
    }
    [false; 2]
}

/// Reads a little-endian 32-bit number.
fn word(bytes: &[u8], at: usize) -> Result<u32, String> {
    let word = bytes.get(at..).and_then(<[u8]>::first_chunk);
    word.map(|word| u32::from_le_bytes(*word))
        .ok_or_else(|| "the KTX2 image is truncated".to_owned())
}

/// Reads a little-endian 64-bit number.
fn long(bytes: &[u8], at: usize) -> Result<u64, String> {
    Ok(u64::from(word(bytes, at)?) | u64::from(word(bytes, at + 4)?) << 32)
}

/// Returns a part of the bytes.
fn part(bytes: &[u8], offset: u64, length: u64) -> Result<&[u8], String> {
    let part = || {
        let start = usize::try_from(offset).ok()?;
        bytes.get(start..start.checked_add(usize::try_from(length).ok()?)?)
    };
    let name = || {
        format!(
            "the KTX2 image is truncated: it has {} bytes, but {length} are needed at offset {offset}",
            bytes.len()
        )
    };
    part().ok_or_else(name)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Header fields; the defaults describe a plain texture.
    #[derive(Clone)]
    pub(in super::super) struct HeaderFields {
        pub(in super::super) format: u32,
        pub(in super::super) size: [u32; 2],
        pub(in super::super) orientation: &'static str,
        /// Depth, layers and faces.
        pub(in super::super) shape: [u32; 3],
        pub(in super::super) levels: u32,
        pub(in super::super) scheme: u32,
        pub(in super::super) color_model: u32,
    }

    impl Default for HeaderFields {
        fn default() -> Self {
            let (format, size, orientation, shape) = (0, [4, 4], "rd", [0, 0, 1]);
            Self { format, size, orientation, shape, levels: 1, scheme: 0, color_model: 1 }
        }
    }

    /// Returns a file with one level and only the parts of the descriptor that are read.
    pub(in super::super) fn file_of(fields: &HeaderFields, level: &[u8]) -> Vec<u8> {
        let entry = [b"KTXorientation\0", fields.orientation.as_bytes(), b"\0"].concat();
        let keys = 4 + entry.len().next_multiple_of(4) as u32;
        let mut bytes = MAGIC.to_vec();
        let mut push = |all: &[u32]| all.iter().for_each(|word| bytes.extend(word.to_le_bytes()));
        push(&[fields.format, 1]);
        push(&fields.size);
        push(&fields.shape);
        push(&[fields.levels, fields.scheme, 104, 28, 132, keys, 0, 0, 0, 0]);
        push(&[132 + keys, 0, level.len() as u32, 0, level.len() as u32, 0]);
        push(&[28, 0, 2, fields.color_model, 0, 0, 0, entry.len() as u32]);
        bytes.extend(entry);
        bytes.resize((132 + keys) as usize, 0);
        bytes.extend(level);
        bytes
    }

    #[test]
    fn errors_report_the_invalid_header_values() {
        let usual = HeaderFields { color_model: 166, ..HeaderFields::default() };
        let refused = |fields: &HeaderFields, words: &str| {
            let message = Ktx2File::read(&file_of(fields, &[0; 16])).err().unwrap_or_default();
            assert!(message.contains(words), "expected {words}, found {message}");
        };
        assert!(Ktx2File::read(&file_of(&usual, &[0; 16])).is_ok());
        for (shape, words) in
            [([3, 0, 1], "3 slices"), ([0, 6, 1], "6 layers"), ([0, 0, 6], "6 faces")]
        {
            refused(&HeaderFields { shape, ..usual.clone() }, words);
        }
        refused(&HeaderFields { levels: 33, ..usual.clone() }, "33 mip levels");
        refused(&HeaderFields { scheme: 1, ..usual.clone() }, "supercompression scheme 1");
        refused(&HeaderFields { scheme: 3, ..usual.clone() }, "supercompression scheme 3");
        refused(&HeaderFields { color_model: 167, ..usual.clone() }, "color model 167");
        refused(&HeaderFields { format: 145, ..usual.clone() }, "Vulkan format 145");
        refused(&HeaderFields { size: [0, 4], ..usual.clone() }, "no texels");
        refused(&HeaderFields { size: [1 << 20, 1 << 20], ..usual }, "1048576 x 1048576 texels");
    }

    #[test]
    fn level_length_must_match_the_number_of_blocks() {
        let fields = HeaderFields { color_model: 166, size: [5, 3], ..HeaderFields::default() };
        let length = |level: &[u8]| {
            let file = file_of(&fields, level);
            Ktx2File::read(&file).and_then(|read| Ok(read.level_data(16)?.len()))
        };
        assert_eq!(length(&[0; 32]), Ok(32));
        assert!(length(&[0; 16]).is_err());
        assert!(length(&[0; 48]).is_err());
    }
}
