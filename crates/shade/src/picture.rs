//! Pictures: what a render returns and a file holds.

mod channel;

pub use channel::Channel;

/// A picture of sRGB pixels with straight alpha, rows from the top: of 8 bits for each channel (`u8`) or of 16 (`u16`).
#[derive(Clone, PartialEq, Eq, Default)]
pub struct Picture<C = u8> {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// `width` × `height` pixels: red, green, blue, alpha.
    pub pixels: Vec<[C; 4]>,
}

impl<C: Channel> Picture<C> {
    /// The pixel in column `x` and row `y`, from the upper left corner; `None` outside.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<[C; 4]> {
        let inside = x < self.width && y < self.height;
        inside.then(|| self.pixels[y as usize * self.width as usize + x as usize])
    }

    /// Gives it another size; the pixels are any.
    pub fn resize(&mut self, width: u32, height: u32) {
        (self.width, self.height) = (width, height);
        let area = width as usize * height as usize;
        if self.pixels.capacity() < area {
            // Fresh memory is zero already.
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
}

impl<C> std::fmt::Debug for Picture<C> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Picture({} x {})", self.width, self.height)
    }
}
