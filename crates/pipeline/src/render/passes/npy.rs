//! Passes as NumPy arrays: `numpy.load("picture.depth.npy")`.
//!
//! The format is NPY 1.0 (`numpy.lib.format`):
//! - a magic string;
//! - the header length;
//! - a Python literal that describes the array, padded so that the data begins at a multiple of 64
//!   bytes;
//! - the values in little-endian order.

use super::buffer::{PassBuffer, PassValues};
use std::fmt::Write;

impl PassBuffer {
    /// Encodes the pass as an NPY file: an f32 or u32 array of rows × columns, or rows × columns ×
    /// channels.
    #[must_use]
    pub fn to_npy(&self) -> Vec<u8> {
        let type_code = if self.pass.is_integer() { "<u4" } else { "<f4" };
        let mut shape = format!("{}, {}", self.height, self.width);
        if self.pass.channels() > 1 {
            // Writing to a String cannot fail.
            let _ = write!(shape, ", {}", self.pass.channels());
        }
        let mut header =
            format!("{{'descr': '{type_code}', 'fortran_order': False, 'shape': ({shape}), }}");
        // The magic string, version and length take ten bytes, and a line break ends the header.
        let padding = (64 - (10 + header.len() + 1) % 64) % 64;
        header.extend(std::iter::repeat_n(' ', padding));
        header.push('\n');
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        match &self.values {
            PassValues::Floats(values) => bytes.extend(values.iter().flat_map(|v| v.to_le_bytes())),
            PassValues::Integers(values) => {
                bytes.extend(values.iter().flat_map(|v| v.to_le_bytes()));
            }
        }
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene_file::Pass;

    /// Separates the header from the data as `numpy.lib.format` does for version 1.0.
    fn parse_npy(bytes: &[u8]) -> (&str, &[u8]) {
        assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
        let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        let header = std::str::from_utf8(&bytes[10..10 + length]).expect("ASCII");
        assert!((10 + length).is_multiple_of(64) && header.ends_with('\n'));
        (header.trim_end(), &bytes[10 + length..])
    }

    #[test]
    fn headers_match_the_npy_format() {
        let values = PassValues::Floats((0..30).map(|n| n as f32 * 0.5).collect());
        let normal = PassBuffer { pass: Pass::Normal, width: 5, height: 2, values };
        let bytes = normal.to_npy();
        let (header, data) = parse_npy(&bytes);
        assert_eq!(header, "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 5, 3), }");
        assert_eq!(data.len(), 120);
        assert_eq!(data[4..8], 0.5_f32.to_le_bytes());
        let values = PassValues::Integers(vec![1, 70_000]);
        let bytes = PassBuffer { pass: Pass::Id, width: 2, height: 1, values }.to_npy();
        let (header, data) = parse_npy(&bytes);
        assert_eq!(header, "{'descr': '<u4', 'fortran_order': False, 'shape': (1, 2), }");
        assert_eq!(data[4..], 70_000_u32.to_le_bytes());
    }
}
