//! Images that declare a wrong size, are truncated, or have an unsupported format.

use crate::hostile::case::{Case, Expected};
use alberti_tests::gltf::{Document, encode_png};
use serde_json::json;

/// Returns a PNG with an arbitrary header and a correct checksum.
fn png_with_false_size(width: u32, height: u32, depth: u8, color: u8) -> Vec<u8> {
    let mut bytes = encode_png(2, 2);
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    (bytes[24], bytes[25]) = (depth, color);
    let checksum = crc32(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&checksum.to_be_bytes());
    bytes
}

/// Computes the PNG checksum (ISO 3309), bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| if crc & 1 == 1 { (crc >> 1) ^ 0xEDB8_8320 } else { crc >> 1 };
    !bytes.iter().fold(u32::MAX, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), step))
}

/// Returns only the header of a JPEG, with these component sampling factors.
fn jpeg_header(width: u16, height: u16, samplings: &[u8]) -> Vec<u8> {
    let components = samplings.len() as u8;
    let mut bytes = vec![0xFF, 0xD8, 0xFF, 0xC0, 0, 8 + 3 * components, 8];
    bytes.extend(height.to_be_bytes());
    bytes.extend(width.to_be_bytes());
    bytes.push(components);
    (1..).zip(samplings).for_each(|(number, &sampling)| bytes.extend([number, sampling, 0]));
    bytes.extend([0xFF, 0xDA, 0, 6 + 2 * components, components]);
    (1..=components).for_each(|number| bytes.extend([number, 0]));
    bytes.extend([0, 63, 0, 0xFF, 0xD9]);
    bytes
}

/// Returns a textured triangle with this image.
pub fn textured_case(name: &str, image: &[u8], expected: Expected) -> Case {
    let mut document = Document::with_all_members();
    let view = document.add_buffer_view(image);
    Case::from_document(
        format!("image: {name}"),
        &document.with_value("/images/0/bufferView", json!(view)),
        expected,
    )
}

fn warning_containing(problem: &str) -> Expected {
    Expected::Warns(format!("/images/0 {problem}; the surface is shown without it"))
}

/// Returns cases with only the header of a JPEG, some of an unsupported kind.
fn jpeg_cases() -> [Case; 4] {
    [
        textured_case("JPEG for printing", &jpeg_header(8, 8, &[0x11; 4]), Expected::Loads),
        textured_case(
            "JPEG, 65,500 squared",
            &jpeg_header(65_500, 65_500, &[0x11; 3]),
            Expected::Loads,
        ),
        textured_case(
            "JPEG with more samples for color than for brightness",
            &jpeg_header(64, 64, &[0x11, 0x11, 0x22]),
            warning_containing(
                "the JPEG has more samples for color than for brightness; save it with a common \
                 subsampling (4:4:4, 4:2:2 or 4:2:0)",
            ),
        ),
        textured_case("JPEG without data", &jpeg_header(64, 64, &[0x11; 3]), Expected::Loads),
    ]
}

/// Returns cases with WebP files that have wrong sizes.
fn webp_cases() -> [Case; 2] {
    [
        textured_case(
            "WebP with a frame far larger than the image",
            b"RIFF\x28\0\0\0WEBPVP8X\x0A\0\0\0\0\0\0\0\xFF\0\0\x7F\0\0\
              VP8 \x0A\0\0\0\x90\x0B\0\x9D\x01\x2A\xFF\x3F\xFF\x3F",
            warning_containing(
                "the WebP has a frame of 16383 x 16383 texels in an image of 256 x 128",
            ),
        ),
        textured_case(
            "WebP header",
            b"RIFF\xFF\xFF\xFF\xFFWEBPVP8 \xFF\xFF\xFF\xFF",
            Expected::Loads,
        ),
    ]
}

/// Returns all image cases.
pub fn image_cases() -> Vec<Case> {
    let mut cases = vec![
        textured_case(
            "100,000 squared",
            &png_with_false_size(100_000, 100_000, 8, 6),
            warning_containing("the image declares 100000 x 100000 texels, too many for 74 bytes"),
        ),
        textured_case(
            "16,384 x 16,384 without data",
            &png_with_false_size(16_384, 16_384, 8, 6),
            Expected::Loads,
        ),
        textured_case(
            "2^31 wide",
            &png_with_false_size(i32::MAX as u32, 1, 8, 6),
            warning_containing("the image declares 2147483647 x 1 texels, too many for 74 bytes"),
        ),
        textured_case(
            "20,000 wide",
            &png_with_false_size(20_000, 1, 8, 6),
            warning_containing("the image has 20000 x 1 texels, more than the limit of 16384"),
        ),
        textured_case("zero width", &png_with_false_size(0, 7, 8, 6), Expected::Loads),
        textured_case("empty", &[], warning_containing("the image is empty")),
        textured_case(
            "text",
            b"hello",
            warning_containing(
                "this is an unknown format; only PNG, JPEG, WebP and KTX2 are supported",
            ),
        ),
        textured_case(
            "GIF",
            b"GIF89a",
            warning_containing("this is a GIF image; only PNG, JPEG, WebP and KTX2 are supported"),
        ),
        textured_case(
            "KTX",
            b"\xABKTX 11\xBB\r\n\x1A\n",
            warning_containing("this is a KTX image; only PNG, JPEG, WebP and KTX2 are supported"),
        ),
        textured_case(
            "KTX2",
            b"\xABKTX 20\xBB\r\n\x1A\n",
            warning_containing("the KTX2 image is truncated"),
        ),
    ];
    cases.extend(jpeg_cases());
    cases.extend(webp_cases());
    cases.extend(mutated_cases());
    cases
}

/// Returns cases with every bit depth and color type, and with files truncated or changed at every
/// byte.
fn mutated_cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for depth in [0, 1, 2, 3, 4, 8, 16, 32] {
        for color in 0..8 {
            let name = format!("PNG of {depth} bits, color type {color}");
            cases.push(textured_case(
                &name,
                &png_with_false_size(2, 2, depth, color),
                Expected::Loads,
            ));
        }
    }
    let whole = encode_png(9, 5);
    for end in 0..whole.len() {
        cases.push(textured_case(
            &format!("PNG truncated at {end}"),
            &whole[..end],
            Expected::Loads,
        ));
        let mut changed = whole.clone();
        changed[end] ^= 0xFF;
        cases.push(textured_case(&format!("PNG byte {end} changed"), &changed, Expected::Loads));
    }
    let header = jpeg_header(64, 64, &[0x11; 3]);
    for end in 0..header.len() {
        cases.push(textured_case(
            &format!("JPEG truncated at {end}"),
            &header[..end],
            Expected::Loads,
        ));
    }
    cases
}
