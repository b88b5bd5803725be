//! Textures: an image with its mip chain, and how it is read at a fragment.
//!
//! A mip chain (Williams 1983) holds the image at full size, at half, at a quarter and so on. Where a pixel of the
//! picture covers many texels, a level is read in which it covers about one, so that the texture neither shimmers nor
//! costs more than a few fetches.

use crate::color::linear_table;
use crate::model::{Filter, Image, Mipmap, Sampler, Wrap};
use std::borrow::Cow;

/// An image at all its sizes, with the way to read it.
#[derive(Clone, Debug)]
pub struct MipChain<'a> {
    levels: Vec<Level<'a>>,
    sampler: Sampler,
}

/// One size of an image: sRGB texels with straight alpha, rows from the top.
#[derive(Clone, Debug)]
struct Level<'a> {
    width: i32,
    height: i32,
    texels: Cow<'a, [[u8; 4]]>,
}

impl<'a> MipChain<'a> {
    /// Builds the chain; only the full image if the sampler asks for no others.
    #[must_use]
    pub fn new(image: &'a Image, sampler: Sampler) -> Self {
        let full = Level {
            width: image.width as i32,
            height: image.height as i32,
            texels: Cow::Borrowed(&image.rgba),
        };
        let mut levels = vec![full];
        if sampler.mipmap != Mipmap::None {
            while let Some(half) = levels.last().and_then(Level::half) {
                levels.push(half);
            }
        }
        Self { levels, sampler }
    }

    /// The texture's colour, linear with straight alpha, at `uvs[0]`; `uvs[1]` and `uvs[2]` are the derivatives by the
    /// pixel's column and row, which say how many texels a pixel covers.
    pub(super) fn sample(&self, uvs: [[f32; 2]; 3], to_linear: &[f32; 256]) -> [f32; 4] {
        let read = |level: usize, filter: Filter| {
            self.levels[level].read(uvs[0], filter, self.sampler, to_linear)
        };
        let lod = self.level_of_detail(uvs);
        if lod <= 0.0 {
            return read(0, self.sampler.magnify);
        }
        let last = self.levels.len() - 1;
        match self.sampler.mipmap {
            Mipmap::None => read(0, self.sampler.minify),
            Mipmap::Nearest => read(((lod + 0.5) as usize).min(last), self.sampler.minify),
            Mipmap::Linear => {
                let lower = (lod as usize).min(last);
                let share = if lower == last { 0.0 } else { lod - lower as f32 };
                let near = read(lower, self.sampler.minify);
                if share == 0.0 {
                    return near;
                }
                let far = read(lower + 1, self.sampler.minify);
                [0, 1, 2, 3].map(|k| near[k] + (far[k] - near[k]) * share)
            }
        }
    }

    /// The base-2 logarithm of the texels that a pixel covers along its longer side.
    fn level_of_detail(&self, [_, right, below]: [[f32; 2]; 3]) -> f32 {
        let full = &self.levels[0];
        let texels = |[u, v]: [f32; 2]| {
            let du = u * full.width as f32;
            let dv = v * full.height as f32;
            du * du + dv * dv
        };
        let squared = texels(right).max(texels(below));
        if squared > 1.0 && squared.is_finite() { 0.5 * libm::log2f(squared) } else { 0.0 }
    }
}

impl Level<'_> {
    /// This level at half size: each texel the mean of four, in linear light; `None` if it is a single texel.
    fn half<'b>(&self) -> Option<Level<'b>> {
        if self.width == 1 && self.height == 1 {
            return None;
        }
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let codes = MeanTables::shared();
        let mut texels = Vec::with_capacity((width * height) as usize);
        for y in 0..height {
            let rows = [2 * y, (2 * y + 1).min(self.height - 1)];
            for x in 0..width {
                let columns = [2 * x, (2 * x + 1).min(self.width - 1)];
                let four = [
                    self.texel(columns[0], rows[0]),
                    self.texel(columns[1], rows[0]),
                    self.texel(columns[0], rows[1]),
                    self.texel(columns[1], rows[1]),
                ];
                texels.push(codes.mean(four));
            }
        }
        Some(Level { width, height, texels: Cow::Owned(texels) })
    }

    fn texel(&self, x: i32, y: i32) -> [u8; 4] {
        self.texels[(y * self.width + x) as usize]
    }

    fn read(
        &self,
        [u, v]: [f32; 2],
        filter: Filter,
        sampler: Sampler,
        to_linear: &[f32; 256],
    ) -> [f32; 4] {
        let (x, y) = (u * self.width as f32, v * self.height as f32);
        let linear = |x: i32, y: i32| {
            let x = wrap(x, self.width, sampler.wrap_u);
            let y = wrap(y, self.height, sampler.wrap_v);
            let [r, g, b, a] = self.texel(x, y);
            let channel = |code: u8| to_linear[usize::from(code)];
            [channel(r), channel(g), channel(b), f32::from(a) / 255.0]
        };
        match filter {
            Filter::Nearest => linear(floor(x), floor(y)),
            Filter::Linear => {
                let (left, top) = (floor(x - 0.5), floor(y - 0.5));
                let (s, t) = (x - 0.5 - left as f32, y - 0.5 - top as f32);
                let upper = mix(linear(left, top), linear(left + 1, top), s);
                let lower = mix(linear(left, top + 1), linear(left + 1, top + 1), s);
                mix(upper, lower, t)
            }
        }
    }
}

/// The largest whole number not above `x`; coordinates beyond a texture's reach stay in range.
fn floor(x: f32) -> i32 {
    let cut = x.clamp(-1e9, 1e9) as i32;
    cut - i32::from((cut as f32) > x)
}

fn mix(a: [f32; 4], b: [f32; 4], share: f32) -> [f32; 4] {
    [0, 1, 2, 3].map(|k| a[k] + (b[k] - a[k]) * share)
}

/// The texel that is shown in place of number `at` of a row of `size`.
fn wrap(at: i32, size: i32, mode: Wrap) -> i32 {
    if (0..size).contains(&at) {
        return at;
    }
    match mode {
        Wrap::Repeat => at.rem_euclid(size),
        Wrap::Clamp => at.clamp(0, size - 1),
        Wrap::Mirror => {
            let place = at.rem_euclid(2 * size);
            if place < size { place } else { 2 * size - 1 - place }
        }
    }
}

/// Tables for means of sRGB texels: 16-bit linear light of each value, and back.
#[derive(Debug)]
struct MeanTables {
    linear: [u32; 256],
    codes: Vec<u8>,
}

impl MeanTables {
    fn shared() -> &'static Self {
        static TABLES: std::sync::OnceLock<MeanTables> = std::sync::OnceLock::new();
        TABLES.get_or_init(|| {
            let linear = linear_table().map(|light| (light * 65535.0 + 0.5) as u32);
            let encoder = crate::color::SrgbEncoder::shared();
            let codes = (0..=65535_u16).map(|l| encoder.encode(f32::from(l) / 65535.0)).collect();
            Self { linear, codes }
        })
    }

    fn mean(&self, four: [[u8; 4]; 4]) -> [u8; 4] {
        let color = |k: usize| {
            let sum: u32 = four.iter().map(|texel| self.linear[usize::from(texel[k])]).sum();
            self.codes[((sum + 2) / 4) as usize]
        };
        let alpha: u32 = four.iter().map(|texel| u32::from(texel[3])).sum();
        [color(0), color(1), color(2), ((alpha + 2) / 4) as u8]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checker(size: u32) -> Image {
        let texel = |n: u32| {
            if (n % size + n / size).is_multiple_of(2) { [255; 4] } else { [0, 0, 0, 255] }
        };
        Image { width: size, height: size, rgba: (0..size * size).map(texel).collect() }
    }

    #[test]
    fn coordinates_outside_the_image_are_wrapped() {
        let row = |mode| (-5..6).map(|at| wrap(at, 3, mode)).collect::<Vec<_>>();
        assert_eq!(row(Wrap::Repeat), [1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2]);
        assert_eq!(row(Wrap::Clamp), [0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2]);
        assert_eq!(row(Wrap::Mirror), [1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0]);
    }

    #[test]
    fn a_checker_from_afar_is_grey_in_linear_light() {
        let image = checker(16);
        let chain = MipChain::new(&image, Sampler::default());
        let uvs = [[0.4, 0.4], [1.0, 0.0], [0.0, 1.0]];
        let [r, g, b, a] = chain.sample(uvs, linear_table());
        assert!((r - 0.5).abs() < 0.003 && r == g && g == b && a == 1.0, "{r}");
    }

    #[test]
    fn linear_filtering_passes_through_texel_centres_and_halves_between() {
        let image = Image { width: 2, height: 1, rgba: vec![[0, 0, 0, 0], [255; 4]] };
        let sampler = Sampler { wrap_u: Wrap::Clamp, ..Sampler::default() };
        let chain = MipChain::new(&image, sampler);
        let at = |u: f32| chain.sample([[u, 0.5], [0.0; 2], [0.0; 2]], linear_table())[0];
        assert_eq!([at(0.25), at(0.5), at(0.75), at(1.5)], [0.0, 0.5, 1.0, 1.0]);
    }

    #[test]
    fn coordinates_that_are_no_numbers_read_some_texel() {
        let image = checker(4);
        let chain = MipChain::new(&image, Sampler::default());
        for u in [f32::NAN, f32::INFINITY, f32::MAX] {
            assert!(
                chain
                    .sample([[u, 0.5]; 3], linear_table())
                    .iter()
                    .all(|c| c.is_nan() || c.is_finite())
            );
        }
    }
}
