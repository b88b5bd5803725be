//! Background images: an image stretched, cropped or letterboxed to a picture, sampled bilinearly.

use crate::color::srgb_to_linear_table;
use model::Image;

/// How an image is fitted to a picture with a different aspect ratio.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ImageFit {
    /// Stretched to the picture's width and height.
    Stretch,
    /// Large enough to cover the whole picture; two sides are cropped.
    Cover,
    /// As large as possible while completely visible; the background fills the rest.
    Contain,
}

/// An image behind the models, over a background color.
#[derive(Clone, PartialEq)]
pub struct BackdropImage {
    /// The texel columns and rows.
    size: [usize; 2],
    /// Linear premultiplied texels, in rows from the top; 65,535 represents 1.
    texels: Vec<[u16; 4]>,
    /// The upper left corner, in fractions of the picture's width and height.
    upper_left: [f32; 2],
    /// The width and height, in the same fractions.
    extent: [f32; 2],
    /// The linear premultiplied color around and behind the image.
    background: [f32; 4],
}

impl std::fmt::Debug for BackdropImage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "BackdropImage({} x {})", self.size[0], self.size[1])
    }
}

impl BackdropImage {
    /// Creates an image over a linear premultiplied background color in a picture of this size.
    ///
    /// An image that is much larger than its displayed size is downsampled first, so that no texel
    /// is skipped.
    #[must_use]
    pub fn new(image: &Image, fit: ImageFit, picture: [u32; 2], background: [f32; 4]) -> Self {
        let image_size = [image.width, image.height].map(f64::from);
        let picture_size = picture.map(f64::from);
        let factors = [picture_size[0] / image_size[0], picture_size[1] / image_size[1]];
        let (least, most) = (factors[0].min(factors[1]), factors[0].max(factors[1]));
        // The scale from image pixels to picture pixels, by axis.
        let scale = match fit {
            ImageFit::Stretch => factors,
            ImageFit::Cover => [most; 2],
            ImageFit::Contain => [least; 2],
        };
        let extent = [0, 1].map(|k| (image_size[k] * scale[k] / picture_size[k]) as f32);
        // The image is centered.
        let upper_left = extent.map(|side| 0.5 * (1.0 - side));
        let shrink = scale.map(|scale| (1.0 / scale).clamp(1.0, f64::from(u32::MAX)) as usize);
        let (size, texels) = box_downsample(image, shrink);
        Self { size, texels, upper_left, extent, background }
    }

    /// Returns whether the backdrop is opaque everywhere.
    pub(super) fn is_opaque(&self) -> bool {
        let covers = [0, 1].iter().all(|&k| self.upper_left[k] <= 0.0);
        self.background[3] >= 1.0
            || (covers && self.texels.iter().all(|texel| texel[3] == u16::MAX))
    }

    /// Returns the linear premultiplied color at a position in fractions of the picture.
    pub(super) fn color_at(&self, position: [f32; 2]) -> [f32; 4] {
        let image_position = [0, 1].map(|k| (position[k] - self.upper_left[k]) / self.extent[k]);
        if !image_position.iter().all(|coordinate| (0.0..=1.0).contains(coordinate)) {
            return self.background;
        }
        // Porter-Duff over, with premultiplied alpha.
        let over = self.sample_bilinear(image_position);
        [0, 1, 2, 3].map(|k| over[k] + self.background[k] * (1.0 - over[3]))
    }

    /// Interpolates bilinearly at a position in fractions of the image, clamped at the borders.
    fn sample_bilinear(&self, image_position: [f32; 2]) -> [f32; 4] {
        let [column, row] = [0, 1].map(|k| {
            let last = self.size[k] - 1;
            let texel = image_position[k] * self.size[k] as f32 - 0.5;
            let texel = texel.clamp(0.0, last as f32);
            let first = (texel as usize).min(last);
            (first, (first + 1).min(last), texel - first as f32)
        });
        let texel = |x: usize, y: usize| {
            self.texels[y * self.size[0] + x].map(|c| f32::from(c) / f32::from(u16::MAX))
        };
        let lerp =
            |a: [f32; 4], b: [f32; 4], t: f32| [0, 1, 2, 3].map(|k| a[k] + (b[k] - a[k]) * t);
        let in_row = |y: usize| lerp(texel(column.0, y), texel(column.1, y), column.2);
        lerp(in_row(row.0), in_row(row.1), row.2)
    }
}

/// Downsamples an image in linear light with premultiplied alpha, with a box filter over blocks of
/// this many columns and rows. Returns the size and the texels.
fn box_downsample(image: &Image, [columns, rows]: [usize; 2]) -> ([usize; 2], Vec<[u16; 4]>) {
    let (width, height) = (image.width as usize, image.height as usize);
    let linear = srgb_to_linear_table();
    let size = [width.div_ceil(columns), height.div_ceil(rows)];
    let block_mean = |x: usize, y: usize| {
        let (mut sum, mut count) = ([0.0_f64; 4], 0.0);
        for row in y * rows..(y * rows + rows).min(height) {
            for column in x * columns..(x * columns + columns).min(width) {
                let texel = image.rgba[row * width + column];
                let alpha = f64::from(texel[3]) / 255.0;
                for (sum, code) in sum.iter_mut().zip(&texel[..3]) {
                    *sum += f64::from(linear[usize::from(*code)]) * alpha;
                }
                sum[3] += alpha;
                count += 1.0;
            }
        }
        sum.map(|sum| (sum / count * f64::from(u16::MAX) + 0.5) as u16)
    };
    let blocks = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
    (size, blocks.map(|(x, y)| block_mean(x, y)).collect())
}
