//! Pictures as text for terminals: half blocks, ASCII art, and kitty's graphics protocol.

use crate::Picture;
use base64::Engine as _;
use std::fmt::Write as _;

/// The maximum width of a picture sent with kitty's protocol, in pixels.
///
/// The terminal would scale down a larger picture anyway, and megabytes of base64 are slow to send
/// over a remote connection.
const MAX_KITTY_WIDTH: u32 = 1280;
/// The maximum payload of one command of kitty's protocol, in bytes of base64.
///
/// The protocol allows no more in one command.
const KITTY_CHUNK_LENGTH: usize = 4096;
/// ASCII characters from dark to light.
///
/// The order suits a dark terminal, where denser characters are brighter.
const ASCII_RAMP: &[u8; 10] = b" .:-=+*#%@";

/// Downsamples a picture over black to `columns` × `rows` with a box filter.
///
/// Squared codes approximate linear light: a gamma of 2 is close enough to sRGB here.
///
/// Pixels darken in proportion to their transparency. A cell smaller than a pixel shows the nearest
/// pixel.
fn downsample(picture: &Picture, columns: u32, rows: u32) -> Vec<[u8; 3]> {
    let range = |at: u32, of: u32, side: u32| {
        let bound = |at: u32| (u64::from(at) * u64::from(side) / u64::from(of)) as u32;
        bound(at)..bound(at + 1).max(bound(at) + 1).min(side.max(1))
    };
    let mut shrunk = Vec::with_capacity((columns * rows) as usize);
    for row in 0..rows {
        for column in 0..columns {
            let (mut sums, mut count) = ([0_u64; 3], 0_u64);
            for y in range(row, rows, picture.height) {
                for x in range(column, columns, picture.width) {
                    let Some([r, g, b, alpha]) = picture.pixel(x, y) else { continue };
                    for (sum, code) in sums.iter_mut().zip([r, g, b]) {
                        *sum += u64::from(code) * u64::from(code) * u64::from(alpha) / 255;
                    }
                    count += 1;
                }
            }
            shrunk.push(sums.map(|sum| (sum / count.max(1)).isqrt() as u8));
        }
    }
    shrunk
}

/// Returns how many columns and rows fit; `cells` is a cell's aspect ratio (0.5 for characters).
///
/// Both are at most 400, and there are no more columns than the picture has.
fn fit_columns(picture: &Picture, columns: u32, cells: f64) -> (u32, u32) {
    let columns = columns.clamp(1, 400).min(picture.width.max(1));
    let ratio = f64::from(picture.height) / f64::from(picture.width.max(1));
    (columns, ((f64::from(columns) * ratio * cells + 0.5) as u32).clamp(1, 400))
}

/// Returns the picture as upper half blocks, each in the colors of the two pixels in its cell.
///
/// A terminal cell is about twice as high as it is wide, so the pixels are square.
///
/// Each cell sets both colors (`38;2` foreground, `48;2` background); each line ends with a reset,
/// so that the background does not extend to the edge of the terminal.
#[must_use]
pub fn half_blocks(picture: &Picture, columns: u32) -> String {
    let (columns, rows) = fit_columns(picture, columns, 1.0);
    let rows = rows.next_multiple_of(2);
    let pixels = downsample(picture, columns, rows);
    let mut text = String::new();
    for pair in pixels.chunks_exact(2 * columns as usize) {
        let (upper, lower) = pair.split_at(columns as usize);
        for ([r, g, b], [s, h, c]) in upper.iter().zip(lower) {
            // Writing to a `String` cannot fail.
            let _ = write!(text, "\x1b[38;2;{r};{g};{b};48;2;{s};{h};{c}m▀");
        }
        text.push_str("\x1b[0m\n");
    }
    text
}

/// Returns the picture as ASCII characters that are denser where it is brighter.
///
/// The weights are from Rec. 709: 0.2126 red, 0.7152 green, 0.0722 blue. They are applied to the
/// encoded values, and the result (luma) is close to perceived lightness.
#[must_use]
pub fn ascii_art(picture: &Picture, columns: u32) -> String {
    let (columns, rows) = fit_columns(picture, columns, 0.5);
    let mut text = String::new();
    for row in downsample(picture, columns, rows).chunks_exact(columns as usize) {
        text.extend(row.iter().map(|[r, g, b]| {
            // Luma of Rec. 709 in 16-bit fixed point.
            let luma =
                (13_933 * u32::from(*r) + 46_871 * u32::from(*g) + 4732 * u32::from(*b)) >> 16;
            char::from(ASCII_RAMP[(luma as usize * ASCII_RAMP.len() / 256).min(9)])
        }));
        text.push('\n');
    }
    text
}

/// Returns the commands of kitty's graphics protocol that transmit and display a PNG, in chunks.
///
/// `a=T` transmits and displays, `f=100` is PNG, and `c` scales the picture to that many columns.
/// `m=1` announces another chunk; only the first chunk has the other keys.
#[must_use]
pub fn kitty_graphics(picture: &Picture, columns: u32) -> String {
    let (cells, _) = fit_columns(picture, columns, 0.5);
    let small;
    let picture = if picture.width > MAX_KITTY_WIDTH {
        let (width, height) = fit_columns(picture, 400, 1.0);
        let pixels = downsample(picture, width, height);
        let pixels = pixels.into_iter().map(|[r, g, b]| [r, g, b, 255]).collect();
        small = Picture { width, height, pixels };
        &small
    } else {
        picture
    };
    let data = base64::engine::general_purpose::STANDARD.encode(picture.to_png());
    let mut text = String::new();
    let chunks = data.as_bytes().chunks(KITTY_CHUNK_LENGTH);
    let last = chunks.len().saturating_sub(1);
    for (number, chunk) in chunks.enumerate() {
        let head = if number == 0 { format!("a=T,f=100,c={cells},") } else { String::new() };
        let more = u8::from(number != last);
        let chunk = String::from_utf8_lossy(chunk);
        // Writing to a `String` cannot fail.
        let _ = write!(text, "\x1b_G{head}m={more};{chunk}\x1b\\");
    }
    text.push('\n');
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a picture with a white upper half and a black lower half.
    fn two_tone_picture() -> Picture {
        let pixels = (0..64).map(|at| [if at < 32 { 255 } else { 0 }; 3]);
        let pixels = pixels.map(|[r, g, b]| [r, g, b, 255]).collect();
        Picture { width: 8, height: 8, pixels }
    }

    #[test]
    fn half_blocks_have_the_colors_of_their_pixels() {
        let text = half_blocks(&two_tone_picture(), 2);
        let cell = "\x1b[38;2;255;255;255;48;2;0;0;0m▀";
        assert_eq!(text, format!("{cell}{cell}\x1b[0m\n"));
        assert_eq!(ascii_art(&two_tone_picture(), 4), "@@@@\n    \n");
    }

    #[test]
    fn kitty_graphics_are_a_png_in_chunks_of_4096_bytes() {
        let text = kitty_graphics(&two_tone_picture(), 80);
        let data: String = text
            .split("\x1b_G")
            .skip(1)
            .map(|command| {
                command.split(';').nth(1).unwrap_or_default().trim_end().trim_end_matches("\x1b\\")
            })
            .collect();
        let bytes = base64::engine::general_purpose::STANDARD.decode(data).expect("base64");
        assert_eq!(bytes, two_tone_picture().to_png());
        assert!(text.starts_with("\x1b_Ga=T,f=100,c=8,m=0;"));
    }
}
