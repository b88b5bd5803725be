//! Reads KTX2 images (KHR_texture_basisu): decodes Basis Universal ETC1S and UASTC blocks to 8-bit
//! RGBA, and copies 8-bit RGB and RGBA.
//!
//! ```text
//!  header ─► container ─┬─ BasisLZ ────────────► ETC1S blocks ─┐
//!                       ├─ Zstandard or plain ─► UASTC blocks ─┼─► the first level
//!                       └─ Zstandard or plain ─► RGB or RGBA ──┘
//! ```
//! The container is read here, so that every size is checked before anything is allocated for it;
//! the `basisu` crate decodes the blocks. Only that crate's two RGBA decoders are called. Its
//! `Transcoder` has a dozen more targets, which would all be linked, and reads more kinds of input
//! than glTF allows.

mod container;
mod zstandard;

use basisu::basislz::etc1s::Etc1sTranscoder;
use basisu::uastc::unpack::unpack_uastc;
use container::{Etc1sImage, Ktx2File, TexelEncoding};

pub(super) use container::{MAGIC, size};

/// Decodes the first mip level.
///
/// # Errors
/// Returns a message if the container is broken or of an unsupported kind, or its data is broken.
pub(super) fn decode(bytes: &[u8]) -> Result<model::Image, String> {
    let container = Ktx2File::read(bytes)?;
    let rgba = match container.encoding {
        TexelEncoding::Etc1s => decode_etc1s(&container)?,
        TexelEncoding::Uastc => decode_uastc(&container)?,
        TexelEncoding::Rgb8 => {
            let level = container.level_data(3)?;
            level.as_chunks().0.iter().map(|&[r, g, b]| [r, g, b, 255]).collect()
        }
        TexelEncoding::Rgba8 => container.level_data(4)?.as_chunks().0.to_vec(),
    };
    let (width, height) = (container.width, container.height);
    let mut image = model::Image { width, height, rgba };
    if container.has_red_and_green_only {
        // The second channel is stored as alpha.
        image.rgba.iter_mut().for_each(|texel| *texel = [texel[0], texel[3], 0, 255]);
    }
    orient(&mut image, container.orientation);
    Ok(image)
}

/// Decodes ETC1S blocks: entropy-coded indices into two codebooks that all blocks share (BasisLZ;
/// KTX 2.0 §5).
fn decode_etc1s(container: &Ktx2File<'_>) -> Result<Vec<[u8; 4]>, String> {
    let Etc1sImage { codebooks, color, alpha } = container.etc1s_image()?;
    let mut decoder = Etc1sTranscoder::new();
    let [(endpoints, endpoint_bytes), (selectors, selector_bytes)] = codebooks.palettes;
    if !decoder.decode_palettes(endpoints, endpoint_bytes, selectors, selector_bytes)
        || !decoder.decode_tables(codebooks.tables)
    {
        return Err("the KTX2 image has broken codebooks".to_owned());
    }
    let (width, height) = (container.width, container.height);
    let [across, down] = container.block_counts();
    let mut rgba = vec![[0; 4]; width as usize * height as usize];
    let out = rgba.as_flattened_mut();
    match alpha {
        Some(alpha) => {
            decoder.transcode_image_rgba32(color, alpha, across, down, width, height, None, out)
        }
        None => decoder.transcode_slice_rgba32(color, across, down, width, height, None, out),
    }
    .ok_or("the KTX2 image has broken ETC1S data")?;
    Ok(rgba)
}

/// Decodes UASTC blocks: 16 bytes per 4 x 4 texels, row by row (Khronos data format specification
/// §25).
fn decode_uastc(container: &Ktx2File<'_>) -> Result<Vec<[u8; 4]>, String> {
    let data = container.level_data(16)?;
    let (width, height) = (container.width as usize, container.height as usize);
    let [across, _] = container.block_counts().map(|count| count as usize);
    let mut rgba = vec![[0; 4]; width * height];
    for (number, block) in data.as_chunks().0.iter().enumerate() {
        let texels = unpack_uastc(block, false)
            .ok_or_else(|| format!("UASTC block {number} of the KTX2 image is invalid"))?;
        let (left, top) = (number % across * 4, number / across * 4);
        for (row, texels) in (top..height).zip(texels.as_chunks::<4>().0) {
            for (column, texel) in (left..width).zip(texels) {
                rgba[row * width + column] = [texel.r(), texel.g(), texel.b(), texel.a()];
            }
        }
    }
    Ok(rgba)
}

/// Flips an image that is stored from right to left or from the bottom up, so that it begins at the
/// upper left, as in glTF.
fn orient(image: &mut model::Image, [from_the_right, from_below]: [bool; 2]) {
    let width = (image.width as usize).max(1);
    if from_the_right {
        image.rgba.chunks_mut(width).for_each(<[_]>::reverse);
    }
    if from_below {
        let height = image.rgba.len() / width;
        for row in 0..height / 2 {
            let (above, below) = image.rgba.split_at_mut((height - 1 - row) * width);
            above[row * width..][..width].swap_with_slice(&mut below[..width]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use container::tests::{HeaderFields, file_of};

    /// VK_FORMAT_R8G8B8_UNORM and VK_FORMAT_R8G8B8A8_SRGB.
    const RGB: u32 = 23;
    const RGBA: u32 = 43;

    #[test]
    fn uncompressed_rgb_and_rgba_texels_are_read() {
        let rgb = file_of(
            &HeaderFields { format: RGB, size: [2, 1], ..HeaderFields::default() },
            &[1, 2, 3, 4, 5, 6],
        );
        assert_eq!(size(&rgb), Ok((2, 1)));
        assert_eq!(decode(&rgb).unwrap().rgba, [[1, 2, 3, 255], [4, 5, 6, 255]]);
        let rgba = HeaderFields { format: RGBA, size: [1, 2], ..HeaderFields::default() };
        let rgba = file_of(&rgba, &[1, 2, 3, 4, 5, 6, 7, 8]);
        assert_eq!(decode(&rgba).unwrap().rgba, [[1, 2, 3, 4], [5, 6, 7, 8]]);
    }

    #[test]
    fn images_are_flipped_to_start_at_the_upper_left() {
        let texels: Vec<u8> = (0..24).collect();
        let [a, b, c, d, e, f] = [0, 4, 8, 12, 16, 20].map(|n| [n, n + 1, n + 2, n + 3]);
        for (orientation, expected) in [
            ("rd", [a, b, c, d, e, f]),
            ("ru", [e, f, c, d, a, b]),
            ("ld", [b, a, d, c, f, e]),
            ("lu", [f, e, d, c, b, a]),
        ] {
            let fields =
                HeaderFields { format: RGBA, size: [2, 3], orientation, ..HeaderFields::default() };
            assert_eq!(decode(&file_of(&fields, &texels)).unwrap().rgba, expected, "{orientation}");
        }
    }

    #[test]
    fn every_truncation_is_an_error_without_a_panic() {
        let fields = HeaderFields { format: RGBA, size: [2, 2], ..HeaderFields::default() };
        let bytes = file_of(&fields, &[7; 16]);
        assert!(decode(&bytes).is_ok());
        for end in 0..bytes.len() {
            let message = decode(&bytes[..end]).unwrap_err();
            assert!(message.contains("the KTX2 image"), "truncated at {end}: {message}");
        }
    }
}
