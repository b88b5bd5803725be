//! The backdrop: a gradient or an image behind the models, defined over the whole picture.
//!
//! ```text
//!   0 ─────────────► 1     A position is (x, y) in fractions of the picture's width and height,
//!   │   the whole          from the upper left corner. The color depends only on this, so that
//!   ▼   picture            separately rendered tiles fit together.
//!   1
//! ```

mod gradient;
mod image;

pub use gradient::Gradient;
pub use image::{BackdropImage, ImageFit};

use crate::color::SrgbEncoder;
use picture::Picture;

/// A background behind the models.
#[derive(Clone, PartialEq, Debug)]
pub enum Backdrop {
    /// A linear gradient.
    Gradient(Gradient),
    /// An image.
    Image(BackdropImage),
}

impl Backdrop {
    /// Returns the linear premultiplied color at a position in fractions of the picture.
    #[must_use]
    pub fn color_at(&self, position: [f32; 2]) -> [f32; 4] {
        match self {
            Self::Gradient(gradient) => gradient.color_at(position),
            Self::Image(image) => image.color_at(position),
        }
    }

    /// Returns whether the backdrop is opaque everywhere.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        match self {
            Self::Gradient(_) => true,
            Self::Image(image) => image.is_opaque(),
        }
    }

    /// Renders the whole backdrop to a picture of this size, with one sample at the center of each
    /// pixel.
    #[must_use]
    pub fn to_picture(&self, width: u32, height: u32) -> Picture {
        let encoder = SrgbEncoder::shared();
        let center = |pixel: u32, count: u32| (pixel as f32 + 0.5) / count as f32;
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let encode =
            |(x, y)| encoder.encode_pixel(self.color_at([center(x, width), center(y, height)]));
        Picture { width, height, pixels: pixels.map(encode).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::Image;

    fn codes(backdrop: &Backdrop, x: f32, y: f32) -> [u8; 4] {
        SrgbEncoder::shared().encode_pixel(backdrop.color_at([x, y]))
    }

    fn gradient(angle_degrees: f64, size: [u32; 2]) -> Backdrop {
        let colors = [[0, 0, 0], [200, 100, 0], [255, 255, 255]];
        Backdrop::Gradient(Gradient::new(&colors, angle_degrees.to_radians(), size))
    }

    #[test]
    fn gradients_interpolate_between_srgb_codes() {
        let down = gradient(0.0, [300, 100]);
        for x in [0.0, 0.3, 1.0] {
            assert_eq!(codes(&down, x, 0.0), [0, 0, 0, 255]);
            assert_eq!(codes(&down, x, 0.25), [100, 50, 0, 255]);
            assert_eq!(codes(&down, x, 0.5), [200, 100, 0, 255]);
            assert_eq!(codes(&down, x, 1.0), [255, 255, 255, 255]);
        }
        let right = gradient(90.0, [300, 100]);
        assert_eq!(codes(&right, 0.25, 0.9), [100, 50, 0, 255]);
        let up = gradient(180.0, [300, 100]);
        assert_eq!(codes(&up, 0.1, 0.75), [100, 50, 0, 255]);
    }

    #[test]
    fn slanted_gradients_touch_the_corners() {
        let slanted = gradient(45.0, [300, 100]);
        assert_eq!(codes(&slanted, 0.0, 0.0), [0, 0, 0, 255]);
        assert_eq!(codes(&slanted, 1.0, 1.0), [255, 255, 255, 255]);
        // In pixels, lines of equal color are perpendicular to the gradient line: 100 pixels to the
        // right have the same effect as 100 down.
        assert_eq!(codes(&slanted, 1.0 / 3.0, 0.0), codes(&slanted, 0.0, 1.0));
    }

    /// Returns four texels: red, green, blue and half-transparent white.
    fn image() -> Image {
        let rgba = vec![[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255, 255, 255, 128]];
        Image { width: 2, height: 2, rgba }
    }

    fn backdrop_image(fit: ImageFit, picture: [u32; 2]) -> Backdrop {
        Backdrop::Image(BackdropImage::new(&image(), fit, picture, [0.0, 0.0, 0.0, 0.0]))
    }

    #[test]
    fn images_are_stretched_cropped_or_letterboxed() {
        let stretched = backdrop_image(ImageFit::Stretch, [400, 200]);
        assert_eq!(codes(&stretched, 0.0, 0.0), [255, 0, 0, 255]);
        assert_eq!(codes(&stretched, 0.25, 0.75), [0, 0, 255, 255]);
        assert_eq!(codes(&stretched, 1.0, 1.0), [255, 255, 255, 128]);
        // In a picture twice as wide as high, the upper and lower quarters of a square are cropped.
        let cropped = backdrop_image(ImageFit::Cover, [400, 200]);
        assert_eq!(cropped.color_at([0.0, 0.5]), stretched.color_at([0.0, 0.5]));
        assert_eq!(cropped.color_at([0.0, 0.0]), stretched.color_at([0.0, 0.25]));
        let letterboxed = backdrop_image(ImageFit::Contain, [400, 200]);
        assert_eq!(letterboxed.color_at([0.2, 0.5]), [0.0; 4]);
        assert_eq!(letterboxed.color_at([0.5, 0.0]), stretched.color_at([0.5, 0.0]));
        assert!(!letterboxed.is_opaque() && !cropped.is_opaque());
    }

    #[test]
    fn large_images_are_averaged_in_linear_light() {
        let small = backdrop_image(ImageFit::Stretch, [1, 1]).color_at([0.5, 0.5]);
        let alpha = 128.0 / 255.0;
        let expected = [(1.0 + alpha) / 4.0; 3];
        assert!((0..3).all(|k| (small[k] - expected[k]).abs() < 1e-4), "{small:?}");
        assert!((small[3] - (3.0 + alpha) / 4.0).abs() < 1e-4);
    }
}
