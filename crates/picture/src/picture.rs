//! Pictures: sRGB pixels with straight alpha, as returned by renderers and stored in PNG files.

use crate::{Channel, encode_png};
use files::{OutputError, write_file};
use std::path::Path;

/// A picture of sRGB pixels with straight alpha and 8 (`u8`) or 16 (`u16`) bits per channel. Rows
/// are ordered from the top.
#[derive(Clone, PartialEq, Eq, Default)]
pub struct Picture<C = u8> {
    /// The width in pixels.
    pub width: u32,
    /// The height in pixels.
    pub height: u32,
    /// The `width` × `height` pixels, each as red, green, blue and alpha.
    pub pixels: Vec<[C; 4]>,
}

impl<C: Channel> Picture<C> {
    /// Returns the pixel in column `x` and row `y`, counted from the upper left corner, or `None`
    /// if the picture has no such pixel.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<[C; 4]> {
        let is_inside = x < self.width && y < self.height;
        is_inside.then(|| self.pixels[y as usize * self.width as usize + x as usize])
    }

    /// Resizes the picture for new content. Its pixels are then unspecified. Its memory is reused
    /// if it suffices.
    pub fn resize(&mut self, width: u32, height: u32) {
        (self.width, self.height) = (width, height);
        let area = width as usize * height as usize;
        if self.pixels.capacity() < area {
            // Getting zeroed pages from the system is cheaper than writing zeros.
            self.pixels = vec![[C::default(); 4]; area];
        } else {
            self.pixels.resize(area, [C::default(); 4]);
        }
    }

    /// Whether every pixel is opaque.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        self.pixels.iter().all(|pixel| pixel[3] == C::FULL)
    }

    /// Encodes the picture as a PNG file with the same bit depth, as RGB if it is opaque, otherwise
    /// as RGBA with straight alpha.
    #[must_use]
    pub fn to_png(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.pixels.len());
        let (size, opaque) = ([self.width, self.height], self.is_opaque());
        let written =
            encode_png(&mut bytes, size, opaque, C::BITS, |rows| rows.write_pixels(&self.pixels));
        debug_assert!(written.is_ok(), "a picture always has width x height pixels: {written:?}");
        bytes
    }

    /// Writes the picture to a PNG file atomically.
    ///
    /// # Errors
    /// Fails if the file cannot be written. An existing file then stays unchanged.
    pub fn write_png(&self, path: &Path) -> Result<(), OutputError> {
        write_file(path, &self.to_png())
    }
}

impl<C> std::fmt::Debug for Picture<C> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Picture({} x {})", self.width, self.height)
    }
}
