//! KTX2 images of Basis Universal (KHR_texture_basisu): ETC1S, UASTC and ASTC blocks to 8-bit RGBA.
//!
//! The crate `basisu` transcodes them; of layers, faces and mip levels only the first is read. The
//! feature `basisu` is off by default: the crate is young, and its tables are large.

/// The identifier at the beginning of a KTX2 file (KTX 2.0 §3.1).
pub(super) const MAGIC: [u8; 12] = *b"\xABKTX 20\xBB\r\n\x1A\n";

/// Width and height of the first mip level, from the header alone (KTX 2.0 §3).
pub(super) fn size(bytes: &[u8]) -> Result<(u32, u32), String> {
    let number = |at: usize| {
        let word = bytes.get(at..).and_then(|rest| rest.first_chunk());
        word.map(|word| u32::from_le_bytes(*word)).ok_or("the KTX2 image is cut off")
    };
    // One-dimensional textures have a height of 0.
    Ok((number(20)?, number(24)?.max(1)))
}

/// Decodes the first mip level of the first layer and face.
pub(super) fn decode(bytes: &[u8]) -> Result<crate::Image, String> {
    use basisu::{DecodeFlags, TargetFormat, Transcoder};
    let message = |error: basisu::Error| format!("the KTX2 image is not read: {error:?}");
    let transcoder = Transcoder::new(bytes).map_err(message)?;
    let (width, height) = transcoder.base_dimensions();
    if (width, height) != size(bytes)? {
        return Err("the KTX2 image has two sizes".to_owned());
    }
    let target = TargetFormat::Rgba32;
    if !transcoder.supports(target) {
        return Err("the KTX2 image has no colours of eight bits".to_owned());
    }
    let texels = transcoder.transcode(0, target, DecodeFlags::NONE).map_err(message)?;
    let rgba = texels.as_chunks().0.to_vec();
    if rgba.len() as u64 != u64::from(width) * u64::from(height) {
        return Err("the KTX2 image is incomplete".to_owned());
    }
    Ok(crate::Image { width, height, rgba })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An image of 4 x 4 texels in one ASTC block of one color (a void-extent block: Khronos data
    /// format specification, §23.23), with the smallest header that KTX 2.0 allows.
    fn one_color([r, g, b, a]: [u16; 4]) -> Vec<u8> {
        const ASTC_4X4_SRGB: u32 = 158;
        const HEADER: u32 = 80 + 24;
        const DESCRIPTOR: u32 = 44;
        let mut bytes = MAGIC.to_vec();
        let mut words = |all: &[u32]| all.iter().for_each(|word| bytes.extend(word.to_le_bytes()));
        // Format, type size, width, height, depth, layers, faces, levels, supercompression.
        words(&[ASTC_4X4_SRGB, 1, 4, 4, 0, 0, 1, 1, 0]);
        // Data format descriptor, key/value data, supercompression data: offset and length.
        words(&[HEADER, DESCRIPTOR, 0, 0, 0, 0, 0, 0]);
        // The level: offset, length, length before compression, 64 bits each.
        let offset = (HEADER + DESCRIPTOR).next_multiple_of(16);
        words(&[offset, 0, 16, 0, 16, 0]);
        // One block of descriptor: ASTC, BT.709, sRGB, straight alpha, 4 x 4 texels in 16 bytes,
        // one sample.
        words(&[DESCRIPTOR, 0, 2 | 40 << 16, 162 | 1 << 8 | 2 << 16, 3 | 3 << 8, 16, 0]);
        words(&[127 << 16, 0, 0, u32::MAX]);
        bytes.resize(offset as usize, 0);
        bytes.extend([0xFC, 0xFD, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF]);
        [r, g, b, a].iter().for_each(|channel| bytes.extend(channel.to_le_bytes()));
        bytes
    }

    #[test]
    fn a_block_of_one_colour() {
        let bytes = one_color([0xFFFF, 0x8080, 0, 0x4040]);
        assert_eq!(size(&bytes), Ok((4, 4)));
        let image = decode(&bytes).unwrap();
        assert_eq!((image.width, image.height), (4, 4));
        assert_eq!(image.rgba, [[255, 128, 0, 64]; 16]);
    }

    #[test]
    fn every_truncation_is_an_error_and_no_panic() {
        let bytes = one_color([0; 4]);
        for end in 0..bytes.len() {
            let message = decode(&bytes[..end]).unwrap_err();
            assert!(message.starts_with("the KTX2 image is "), "cut at {end}: {message}");
        }
    }
}
