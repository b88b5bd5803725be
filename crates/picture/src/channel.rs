//! The bit depths of channels: 8 and 16 bits.
//!
//! A picture is generic over its channel type, so one implementation encodes, composites and writes
//! pixels of both depths.

/// A channel of a pixel, `u8` or `u16`. The trait is sealed: other crates cannot implement it.
pub trait Channel: sealed::Sealed + Copy + Default + Eq + Send + Sync + 'static {
    /// The code for 1.0: 255 or 65,535.
    const FULL: Self;
    /// The number of bits per channel, 8 or 16.
    const BITS: u8;
    /// Converts an 8-bit code: 0 stays 0, and 255 becomes `FULL`.
    fn from_byte(byte: u8) -> Self;
    /// Converts to the nearest 8-bit code.
    fn to_byte(self) -> u8;
    /// Appends pixels as stored in PNG: big-endian, and without alpha if the picture is opaque.
    fn append_pixels(pixels: &[[Self; 4]], opaque: bool, bytes: &mut Vec<u8>);
    /// Composites a pixel under `over`, a pixel of a vector drawing in 8-bit premultiplied sRGB.
    ///
    /// This is Porter–Duff *over* on sRGB codes, as in HTML canvases.
    fn composite_under(pixel: [Self; 4], over: [u8; 4]) -> [Self; 4];
}

mod sealed {
    /// Seals [`Channel`](super::Channel).
    pub trait Sealed {}
    impl Sealed for u8 {}
    impl Sealed for u16 {}
}

impl Channel for u8 {
    const FULL: Self = Self::MAX;
    const BITS: u8 = 8;

    fn from_byte(byte: u8) -> Self {
        byte
    }

    fn to_byte(self) -> u8 {
        self
    }

    fn append_pixels(pixels: &[[Self; 4]], opaque: bool, bytes: &mut Vec<u8>) {
        if opaque {
            pixels.iter().for_each(|[color @ .., _]| bytes.extend_from_slice(color));
        } else {
            bytes.extend_from_slice(pixels.as_flattened());
        }
    }

    fn composite_under(pixel: [Self; 4], over: [u8; 4]) -> [Self; 4] {
        u16::composite_under(pixel.map(u16::from_byte), over).map(u16::to_byte)
    }
}

impl Channel for u16 {
    const FULL: Self = Self::MAX;
    const BITS: u8 = 16;

    fn from_byte(byte: u8) -> Self {
        Self::from(byte) * 257
    }

    fn to_byte(self) -> u8 {
        ((u32::from(self) + 128) / 257) as u8
    }

    fn append_pixels(pixels: &[[Self; 4]], opaque: bool, bytes: &mut Vec<u8>) {
        for &[r, g, b, alpha] in pixels {
            bytes.extend_from_slice([r, g, b].map(Self::to_be_bytes).as_flattened());
            if !opaque {
                bytes.extend_from_slice(&alpha.to_be_bytes());
            }
        }
    }

    fn composite_under(pixel: [Self; 4], over: [u8; 4]) -> [Self; 4] {
        // Where nothing is drawn, the pixel must not change. The arithmetic below would round it.
        if over[3] == 0 {
            return pixel;
        }
        let full = f64::from(Self::FULL);
        let [.., alpha] = over.map(|channel| f64::from(channel) / 255.0);
        // Porter–Duff *over*: the part of the pixel that shows through the drawing.
        let through = f64::from(pixel[3]) / full * (1.0 - alpha);
        let sum = alpha + through;
        let mut mixed = [0, 1, 2, 3].map(|k| {
            let color = f64::from(over[k]) / 255.0 + f64::from(pixel[k]) / full * through;
            (color / sum * full + 0.5).clamp(0.0, full) as Self
        });
        mixed[3] = (sum * full + 0.5).clamp(0.0, full) as Self;
        mixed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drawings_are_composited_over_pixels_by_alpha() {
        let under = [65_535, 0, 32_768, 65_535];
        assert_eq!(u16::composite_under(under, [0; 4]), under);
        assert_eq!(u16::composite_under(under, [10, 20, 30, 255]), [2570, 5140, 7710, 65_535]);
        // A black drawing with alpha 51/255.
        let [r, g, b, a] = u16::composite_under(under, [0, 0, 0, 51]);
        assert_eq!([r, g, a], [52_428, 0, 65_535]);
        assert!(b.abs_diff(26_214) <= 1);
        assert_eq!(u16::composite_under([0; 4], [25, 0, 0, 51]), [32_125, 0, 0, 13_107]);
    }

    #[test]
    fn bytes_survive_conversion_to_sixteen_bits() {
        for byte in 0..=255_u8 {
            assert_eq!(u16::from_byte(byte).to_byte(), byte);
        }
        assert_eq!(u16::FULL.to_byte(), 255);
    }
}
