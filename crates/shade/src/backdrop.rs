//! What is painted behind the models: gradients and pictures, as functions of the place in the whole picture.
//!
//! ```text
//!   0 ─────────────► 1     A place is (x, y) in parts of the picture's width and height, from its upper left corner. What is
//!   │   the whole          seen there depends on nothing else, so that parts of a picture unite.
//!   ▼   picture
//!   1
//! ```

use crate::Picture;
use crate::color::{SrgbEncoder, srgb_to_linear, srgb_to_linear_table};
use model::Image;

/// What is painted behind the models.
#[derive(Clone, PartialEq, Debug)]
pub enum Backdrop {
    /// Colours that run into each other.
    Gradient(Gradient),
    /// A picture.
    Image(BackdropImage),
}

impl Backdrop {
    /// What is seen at a place: linear, multiplied by alpha.
    #[must_use]
    pub fn color_at(&self, place: [f32; 2]) -> [f32; 4] {
        match self {
            Self::Gradient(gradient) => gradient.color_at(place),
            Self::Image(photo) => photo.color_at(place),
        }
    }

    /// Whether nothing is seen through it anywhere.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        match self {
            Self::Gradient(_) => true,
            Self::Image(photo) => photo.is_opaque(),
        }
    }

    /// All of it with so many pixels.
    #[must_use]
    pub fn to_picture(&self, width: u32, height: u32) -> Picture {
        let encoder = SrgbEncoder::shared();
        let part = |at: u32, of: u32| (at as f32 + 0.5) / of as f32;
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let color = |(x, y)| encoder.encode_pixel(self.color_at([part(x, width), part(y, height)]));
        Picture { width, height, pixels: places.map(color).collect() }
    }
}

/// Steps of a gradient: finer than 16 bits can tell between colours beside each other, as they are joined by straight lines.
const TABLE_STEPS: usize = 1024;

/// Colours that run into each other, mixed in sRGB as web pages mix them (CSS Images 3, §3.1).
#[derive(Clone, PartialEq, Debug)]
pub struct Gradient {
    /// Linear colours at equal distances.
    table: Vec<[f32; 3]>,
    /// How far along the gradient a step across all of the picture leads.
    axis: [f32; 2],
}

impl Gradient {
    /// The gradient through at least one colour, sRGB from 0 to 255, in a picture of this size; it runs down at an angle of 0 (radians), to the
    /// right at a quarter of a turn.
    #[must_use]
    pub fn new(colors: &[[u8; 3]], angle: f64, [width, height]: [u32; 2]) -> Self {
        let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
        let (across, down) = (f64::from(width) * sine, f64::from(height) * cosine);
        // The gradient begins and ends where its lines touch the corners.
        let length = across.abs() + down.abs();
        let axis = [across / length, down / length].map(|part| part as f32);
        let last = colors.len().saturating_sub(1);
        let mixed = |step: usize| {
            let place = step as f64 / TABLE_STEPS as f64 * last as f64;
            let first = (place as usize).min(last.saturating_sub(1));
            let (from, to) = (colors[first], colors[(first + 1).min(last)]);
            let part = place - first as f64;
            [0, 1, 2].map(|k| {
                let [a, b] = [from[k], to[k]].map(|code: u8| f64::from(code) / 255.0);
                srgb_to_linear(a + (b - a) * part) as f32
            })
        };
        Self { table: (0..=TABLE_STEPS).map(mixed).collect(), axis }
    }

    fn color_at(&self, [x, y]: [f32; 2]) -> [f32; 4] {
        let [across, down] = self.axis;
        let part = (0.5 + (x - 0.5) * across + (y - 0.5) * down).clamp(0.0, 1.0);
        let place = part * TABLE_STEPS as f32;
        let first = (place as usize).min(TABLE_STEPS - 1);
        let part = place - first as f32;
        let (from, to) = (self.table[first], self.table[first + 1]);
        let [r, g, b] = [0, 1, 2].map(|k| from[k] + (to[k] - from[k]) * part);
        [r, g, b, 1.0]
    }

    /// The colour in its middle: linear, opaque.
    #[must_use]
    pub fn center_color(&self) -> [f32; 4] {
        self.color_at([0.5, 0.5])
    }
}

/// How a picture fills another.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ImageFit {
    /// Stretched.
    Stretch,
    /// All of the other is covered.
    Cover,
    /// All of it is seen.
    Contain,
}

/// A picture behind the models.
#[derive(Clone, PartialEq)]
pub struct BackdropImage {
    size: [usize; 2],
    /// Linear, multiplied by alpha; all of it is 65,535.
    texels: Vec<[u16; 4]>,
    /// Its upper left corner, and how large it is, in parts of the whole picture.
    upper_left: [f32; 2],
    extent: [f32; 2],
    /// What is beside and behind it.
    background: [f32; 4],
}

impl std::fmt::Debug for BackdropImage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Photo({} x {})", self.size[0], self.size[1])
    }
}

impl BackdropImage {
    /// An image over a colour (linear, multiplied by alpha) in a picture of this size. An image much larger than what is seen of it is made
    /// smaller first, so that none of its texels is passed over.
    #[must_use]
    pub fn new(image: &Image, fit: ImageFit, picture: [u32; 2], background: [f32; 4]) -> Self {
        let own = [image.width, image.height].map(f64::from);
        let whole = picture.map(f64::from);
        let factors = [whole[0] / own[0], whole[1] / own[1]];
        let (least, most) = (factors[0].min(factors[1]), factors[0].max(factors[1]));
        let scale = match fit {
            ImageFit::Stretch => factors,
            ImageFit::Cover => [most; 2],
            ImageFit::Contain => [least; 2],
        };
        let extent = [0, 1].map(|k| (own[k] * scale[k] / whole[k]) as f32);
        let upper_left = extent.map(|side| 0.5 * (1.0 - side));
        let shrink = scale.map(|scale| (1.0 / scale).clamp(1.0, f64::from(u32::MAX)) as usize);
        let (size, texels) = box_downsample(image, shrink);
        Self { size, texels, upper_left, extent, background }
    }

    fn is_opaque(&self) -> bool {
        let covers = [0, 1].iter().all(|&k| self.upper_left[k] <= 0.0);
        self.background[3] >= 1.0
            || (covers && self.texels.iter().all(|texel| texel[3] == u16::MAX))
    }

    fn color_at(&self, place: [f32; 2]) -> [f32; 4] {
        let own = [0, 1].map(|k| (place[k] - self.upper_left[k]) / self.extent[k]);
        if !own.iter().all(|part| (0.0..=1.0).contains(part)) {
            return self.background;
        }
        let over = self.sample_bilinear(own);
        [0, 1, 2, 3].map(|k| over[k] + self.background[k] * (1.0 - over[3]))
    }

    /// Between the four texels around a place of the image.
    fn sample_bilinear(&self, own: [f32; 2]) -> [f32; 4] {
        let [column, row] = [0, 1].map(|k| {
            let last = self.size[k] - 1;
            let at = (own[k] * self.size[k] as f32 - 0.5).clamp(0.0, last as f32);
            let first = (at as usize).min(last);
            (first, (first + 1).min(last), at - first as f32)
        });
        let texel = |x: usize, y: usize| {
            self.texels[y * self.size[0] + x].map(|c| f32::from(c) / f32::from(u16::MAX))
        };
        let mix =
            |a: [f32; 4], b: [f32; 4], part: f32| [0, 1, 2, 3].map(|k| a[k] + (b[k] - a[k]) * part);
        let line = |y: usize| mix(texel(column.0, y), texel(column.1, y), column.2);
        mix(line(row.0), line(row.1), row.2)
    }
}

/// Means of blocks of texels, each so many columns and rows: their number, and they themselves.
fn box_downsample(image: &Image, [columns, rows]: [usize; 2]) -> ([usize; 2], Vec<[u16; 4]>) {
    let (width, height) = (image.width as usize, image.height as usize);
    let linear = srgb_to_linear_table();
    let sides = [width.div_ceil(columns), height.div_ceil(rows)];
    let mean = |x: usize, y: usize| {
        let (mut sum, mut count) = ([0.0_f64; 4], 0.0);
        for row in y * rows..(y * rows + rows).min(height) {
            for column in x * columns..(x * columns + columns).min(width) {
                let texel = image.rgba[row * width + column];
                let alpha = f64::from(texel[3]) / 255.0;
                for k in 0..3 {
                    sum[k] += f64::from(linear[usize::from(texel[k])]) * alpha;
                }
                sum[3] += alpha;
                count += 1.0;
            }
        }
        sum.map(|sum| (sum / count * f64::from(u16::MAX) + 0.5) as u16)
    };
    let places = (0..sides[1]).flat_map(|y| (0..sides[0]).map(move |x| (x, y)));
    (sides, places.map(|(x, y)| mean(x, y)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn codes(painting: &Backdrop, x: f32, y: f32) -> [u8; 4] {
        SrgbEncoder::shared().encode_pixel(painting.color_at([x, y]))
    }

    fn gradient(angle_degrees: f64, size: [u32; 2]) -> Backdrop {
        let colors = [[0, 0, 0], [200, 100, 0], [255, 255, 255]];
        Backdrop::Gradient(Gradient::new(&colors, angle_degrees.to_radians(), size))
    }

    #[test]
    fn gradients_run_through_their_colours_and_half_way_mix_their_codes() {
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
        // Lines of one colour are at right angles to it in pixels: 100 to the right are as far as 100 down.
        assert_eq!(codes(&slanted, 1.0 / 3.0, 0.0), codes(&slanted, 0.0, 1.0));
    }

    /// Four texels: red, green, blue, and half of white.
    fn image() -> Image {
        let rgba = vec![[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255, 255, 255, 128]];
        Image { width: 2, height: 2, rgba }
    }

    fn photo(fit: ImageFit, picture: [u32; 2]) -> Backdrop {
        Backdrop::Image(BackdropImage::new(&image(), fit, picture, [0.0, 0.0, 0.0, 0.0]))
    }

    #[test]
    fn pictures_are_stretched_cut_or_framed() {
        let stretched = photo(ImageFit::Stretch, [400, 200]);
        assert_eq!(codes(&stretched, 0.0, 0.0), [255, 0, 0, 255]);
        assert_eq!(codes(&stretched, 0.25, 0.75), [0, 0, 255, 255]);
        assert_eq!(codes(&stretched, 1.0, 1.0), [255, 255, 255, 128]);
        // Of a square in a picture twice as wide, the upper and the lower fourth are cut off.
        let cut = photo(ImageFit::Cover, [400, 200]);
        assert_eq!(cut.color_at([0.0, 0.5]), stretched.color_at([0.0, 0.5]));
        assert_eq!(cut.color_at([0.0, 0.0]), stretched.color_at([0.0, 0.25]));
        let framed = photo(ImageFit::Contain, [400, 200]);
        assert_eq!(framed.color_at([0.2, 0.5]), [0.0; 4]);
        assert_eq!(framed.color_at([0.5, 0.0]), stretched.color_at([0.5, 0.0]));
        assert!(!framed.is_opaque() && !cut.is_opaque());
    }

    #[test]
    fn large_pictures_are_averaged_in_linear_light() {
        let small = photo(ImageFit::Stretch, [1, 1]).color_at([0.5, 0.5]);
        let alpha = 128.0 / 255.0;
        let expected = [(1.0 + alpha) / 4.0; 3];
        assert!((0..3).all(|k| (small[k] - expected[k]).abs() < 1e-4), "{small:?}");
        assert!((small[3] - (3.0 + alpha) / 4.0).abs() < 1e-4);
    }
}
