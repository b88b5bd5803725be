//! Pictures: what a render returns and a file holds.

/// A picture of 8-bit sRGB pixels with straight alpha, rows from the top.
#[derive(Clone, PartialEq, Eq, Default)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// `width` × `height` pixels: red, green, blue, alpha.
    pub pixels: Vec<[u8; 4]>,
}

impl Picture {
    /// The pixel in column `x` and row `y`, from the upper left corner; `None` outside.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        let inside = x < self.width && y < self.height;
        inside.then(|| self.pixels[y as usize * self.width as usize + x as usize])
    }

    /// Gives it another size; the pixels are any.
    pub(crate) fn resize(&mut self, width: u32, height: u32) {
        (self.width, self.height) = (width, height);
        let area = width as usize * height as usize;
        if self.pixels.capacity() < area {
            // Fresh memory is zero already.
            self.pixels = vec![[0; 4]; area];
        } else {
            self.pixels.resize(area, [0; 4]);
        }
    }

    /// Whether every pixel is opaque.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        self.pixels.iter().all(|pixel| pixel[3] == 255)
    }
}

impl std::fmt::Debug for Picture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Picture({} x {})", self.width, self.height)
    }
}
