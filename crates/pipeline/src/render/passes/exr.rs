//! Passes as OpenEXR files, for compositing programs.
//!
//! The format (*OpenEXR file layout*, Academy Software Foundation) consists of a magic number, a
//! version, header attributes, a table of row offsets, and the rows. Each row stores its channels
//! one after another in alphabetical order. Nothing is compressed, so the values are exact and the
//! bytes are the same everywhere. The `exr` package is not used because it would add a second
//! deflate implementation.

use super::buffer::{PassBuffer, PassValues};
use scene_file::Pass;

/// The magic number, and version 2 without flags, for one image stored in scan lines.
const MAGIC_AND_VERSION: [u8; 8] = [0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0];
/// The channel type of u32 values.
const UINT: i32 = 0;
/// The channel type of f32 values.
const FLOAT: i32 = 2;

impl PassBuffer {
    /// Encodes the pass as an OpenEXR file of f32 or u32 values.
    ///
    /// Channels are `Z` for depth, `X`, `Y` and `Z` for vectors, `U` and `V` for texture
    /// coordinates, and the name of the pass for other values.
    #[must_use]
    pub fn to_exr(&self) -> Vec<u8> {
        let names = channel_names(self.pass);
        let mut bytes = MAGIC_AND_VERSION.to_vec();
        self.write_header(&names, &mut bytes);
        let (width, height) = (self.width as usize, self.height as usize);
        let row_bytes = 4 * width * names.len();
        // Without compression every row is a block. A table of row offsets follows the header.
        let first_row = bytes.len() + 8 * height;
        let offsets = (0..height).map(|row| (first_row + row * (8 + row_bytes)) as u64);
        bytes.extend(offsets.flat_map(u64::to_le_bytes));
        for row in 0..height {
            bytes.extend((row as u32).to_le_bytes());
            bytes.extend((row_bytes as u32).to_le_bytes());
            // OpenEXR stores the channels of a row one after another, not interleaved.
            for channel in 0..names.len() {
                let places =
                    (0..width).map(|column| (row * width + column) * names.len() + channel);
                match &self.values {
                    PassValues::Floats(values) => {
                        bytes.extend(places.flat_map(|at| values[at].to_le_bytes()));
                    }
                    PassValues::Integers(values) => {
                        bytes.extend(places.flat_map(|at| values[at].to_le_bytes()));
                    }
                }
            }
        }
        bytes
    }

    /// Writes the header attributes.
    fn write_header(&self, names: &[&str], bytes: &mut Vec<u8>) {
        let mut attribute = |name: &str, kind: &str, value: &[u8]| {
            for text in [name, kind] {
                bytes.extend(text.as_bytes());
                bytes.push(0);
            }
            bytes.extend((value.len() as u32).to_le_bytes());
            bytes.extend(value);
        };
        let kind = if self.pass.is_integer() { UINT } else { FLOAT };
        let mut channels = Vec::new();
        for name in names {
            channels.extend(name.as_bytes());
            channels.push(0);
            // Type, linear flag and three reserved bytes. The sampling rate is 1: every column and
            // row has a value.
            channels.extend([kind, 0, 1, 1].into_iter().flat_map(i32::to_le_bytes));
        }
        channels.push(0);
        attribute("channels", "chlist", &channels);
        attribute("compression", "compression", &[0]);
        // The bounds of a box are inclusive.
        let [right, bottom] = [self.width, self.height].map(|side| side.saturating_sub(1));
        let window: Vec<u8> =
            [0, 0, right, bottom].into_iter().flat_map(u32::to_le_bytes).collect();
        attribute("dataWindow", "box2i", &window);
        attribute("displayWindow", "box2i", &window);
        attribute("lineOrder", "lineOrder", &[0]);
        attribute("pixelAspectRatio", "float", &1.0_f32.to_le_bytes());
        attribute("screenWindowCenter", "v2f", &[0; 8]);
        attribute("screenWindowWidth", "float", &1.0_f32.to_le_bytes());
        bytes.push(0);
    }
}

/// Returns a pass's channel names in the order of its values, which is alphabetical.
fn channel_names(pass: Pass) -> Vec<&'static str> {
    match (pass, pass.channels()) {
        (Pass::Depth, _) => vec!["Z"],
        (_, 3) => vec!["X", "Y", "Z"],
        (_, 2) => vec!["U", "V"],
        _ => vec![pass.name()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_follow_the_header_and_the_offset_table() {
        let values = PassValues::Floats((0..12).map(|n| n as f32).collect());
        let bytes = PassBuffer { pass: Pass::Normal, width: 2, height: 2, values }.to_exr();
        assert!(bytes.starts_with(&MAGIC_AND_VERSION));
        let text = String::from_utf8_lossy(&bytes);
        for word in
            ["channels\0chlist\0", "X\0", "dataWindow\0box2i\0", "compression\0compression\0"]
        {
            assert!(text.contains(word), "{word}");
        }
        let word = |at: usize| {
            u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
        };
        // Two rows of two pixels with three channels, each row preceded by its number and length.
        let rows = bytes.len() - 2 * (8 + 24);
        let table = rows - 16;
        assert_eq!([word(table), word(table + 8)], [rows as u32, rows as u32 + 32]);
        assert_eq!([word(rows), word(rows + 4)], [0, 24]);
        let floats: Vec<f32> = (0..6).map(|k| f32::from_bits(word(rows + 40 + 4 * k))).collect();
        assert_eq!(floats, [6.0, 9.0, 7.0, 10.0, 8.0, 11.0], "X X Y Y Z Z of the second row");
    }

    #[test]
    fn channels_are_sorted_by_name() {
        for pass in Pass::ALL {
            let names = channel_names(pass);
            assert!(names.is_sorted() && names.len() == pass.channels(), "{names:?}");
        }
    }
}
