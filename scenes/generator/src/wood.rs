//! Procedural textures as PNG: the planks of the crate and the perforated screen.

use crate::palette::{BARK, Color, SAGE, WOOD, mix_colors};

/// Width and height in texels.
const TEXTURE_SIZE: u32 = 128;

/// Returns the side of a crate as an RGB image: five planks in a frame with a diagonal brace, and
/// nails at the corners of the frame.
pub(crate) fn crate_side_png() -> Result<Vec<u8>, String> {
    let mut texels = Vec::new();
    for y in 0..TEXTURE_SIZE {
        for x in 0..TEXTURE_SIZE {
            texels.extend(
                plank_color(x, y).map(|channel| libm::round(channel.clamp(0.0, 255.0)) as u8),
            );
        }
    }
    encode_png(&texels, png::ColorType::Rgb)
}

/// Returns the color of the crate's side at a texel.
fn plank_color(x: u32, y: u32) -> [f64; 3] {
    let (light, dark) = (WOOD.srgb(), BARK.srgb());
    if is_nail(x, y) {
        return Color(0x3a, 0x35, 0x32).srgb();
    }
    let border = x.min(y).min(TEXTURE_SIZE - 1 - x).min(TEXTURE_SIZE - 1 - y);
    let diagonal = x.abs_diff(y);
    if border < 16 {
        let lengthwise = y.min(TEXTURE_SIZE - 1 - y) < 16;
        let (along, across) = if lengthwise { (x, y) } else { (y, x) };
        let edge = if border == 15 || border == 0 { 0.75 } else { 0.12 };
        return grain_color(light, dark, along, across + 7, edge);
    }
    if diagonal < 12 {
        let edge = if diagonal == 11 { 0.7 } else { 0.2 };
        return grain_color(light, dark, x + y, diagonal + 40, edge);
    }
    // The shadow next to the frame, and the gaps between the planks.
    let edge = if border < 19 || x % 19 == 15 { 0.85 } else { 0.38 };
    grain_color(light, dark, y, x + x / 19 * 31, edge)
}

fn is_nail(x: u32, y: u32) -> bool {
    let near = |t: u32| (6..10).contains(&t) || (TEXTURE_SIZE - 10..TEXTURE_SIZE - 6).contains(&t);
    near(x) && near(y)
}

/// Returns wood grain: streaks between `light` and `dark` that differ from line to line; `shade` is
/// their mean.
fn grain_color(light: [f64; 3], dark: [f64; 3], along: u32, across: u32, shade: f64) -> [f64; 3] {
    let streak = value_noise(across, along / 24) * 0.6 + value_noise(across, along / 7 + 99) * 0.4;
    mix_colors(light, dark, shade + (streak - 0.5) * 0.3)
}

/// Returns value noise from 0 to 1, computed with an integer hash of the position.
fn value_noise(x: u32, y: u32) -> f64 {
    let mut hash = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77);
    hash = (hash ^ (hash >> 15)).wrapping_mul(0x2c1b_3c6d);
    hash = (hash ^ (hash >> 12)).wrapping_mul(0x297a_2d39);
    f64::from((hash ^ (hash >> 15)) & 0xffff) / 65535.0
}

/// Returns round holes in a square lattice, as an RGBA image with alpha 0 in the holes.
pub(crate) fn lattice_png() -> Result<Vec<u8>, String> {
    let Color(r, g, b) = SAGE;
    let mut texels = Vec::new();
    for y in 0..TEXTURE_SIZE {
        for x in 0..TEXTURE_SIZE {
            // Four holes across; distances in texels from each hole's center.
            let [dx, dy] = [x, y].map(|t| f64::from(t % 32) - 15.5);
            let beyond = libm::sqrt(dx * dx + dy * dy) - 11.5;
            let alpha = (128.0 + beyond * 64.0).clamp(0.0, 255.0);
            texels.extend([r, g, b, alpha as u8]);
        }
    }
    encode_png(&texels, png::ColorType::Rgba)
}

fn encode_png(texels: &[u8], color: png::ColorType) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, TEXTURE_SIZE, TEXTURE_SIZE);
    encoder.set_color(color);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header().map_err(|error| error.to_string())?;
    writer.write_image_data(texels).map_err(|error| error.to_string())?;
    writer.finish().map_err(|error| error.to_string())?;
    Ok(bytes)
}
