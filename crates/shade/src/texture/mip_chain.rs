//! Mip chains: an image at full size, half size, quarter size and so on (Williams 1983).
//!
//! ```text
//!   level 0        level 1     2    …
//!  ┌────────────┐  ┌──────┐  ┌───┐ ┌─┐
//!  │            │  │      │  └───┘ └─┘     each texel is the mean of 2 × 2 in the previous level
//!  │            │  └──────┘
//!  └────────────┘
//! ```

use super::addressing::TexelAddressing;
use crate::color::srgb_to_linear_table;
use model::{Image, MipmapMode, Sampler};
use std::borrow::Cow;
use std::sync::OnceLock;

/// A texture: an image with its mip levels, and the sampler used to read it.
#[derive(Clone, Debug)]
pub struct MipChain<'a> {
    pub(super) levels: Vec<MipLevel<'a>>,
    pub(super) addressing: TexelAddressing,
    /// The linear light of each code, for textures in sRGB.
    pub(super) srgb_table: Option<&'static [f32; 256]>,
}

/// The encoding of texels.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TexelEncoding {
    /// Red, green and blue are sRGB; alpha is linear.
    Srgb,
    /// All four channels are linear, from 0 to 1.
    Linear,
}

/// A mip level: texels with straight alpha, in rows from the top. The full image is borrowed.
#[derive(Clone, Debug)]
pub(super) struct MipLevel<'a> {
    width: i32,
    height: i32,
    pub(super) texels: Cow<'a, [[u8; 4]]>,
}

impl<'a> MipChain<'a> {
    /// Builds the mip levels of an image, or only the full image if the sampler does not use
    /// mipmaps.
    ///
    /// The full image is borrowed, so several chains with different samplers can share it.
    ///
    /// Colors are averaged in linear light. The smaller levels add a third of the image's memory.
    #[must_use]
    pub fn new(image: &'a Image, sampler: Sampler, encoding: TexelEncoding) -> Self {
        let full = MipLevel {
            width: image.width as i32,
            height: image.height as i32,
            texels: Cow::Borrowed(&image.rgba),
        };
        let (width, height) = (full.width, full.height);
        let mut levels = vec![full];
        if sampler.mipmap_mode != MipmapMode::None {
            let next = |level: &MipLevel<'a>| match encoding {
                TexelEncoding::Srgb => {
                    level.downsample(|four| SrgbAverager::shared().average(four))
                }
                TexelEncoding::Linear => level.downsample(average_texels),
            };
            while let Some(level) = levels.last().and_then(next) {
                levels.push(level);
            }
        }
        let last_level = levels.len() as i32 - 1;
        let srgb_table = (encoding == TexelEncoding::Srgb).then(srgb_to_linear_table);
        Self {
            levels,
            addressing: TexelAddressing { width, height, last_level, sampler },
            srgb_table,
        }
    }

    /// Copies the full image into the chain, which is then independent of the image's lifetime.
    #[must_use]
    pub fn into_owned(self) -> MipChain<'static> {
        let own = |level: MipLevel<'_>| {
            let texels = Cow::Owned(level.texels.into_owned());
            MipLevel { width: level.width, height: level.height, texels }
        };
        let levels = self.levels.into_iter().map(own).collect();
        MipChain { levels, addressing: self.addressing, srgb_table: self.srgb_table }
    }

    /// Returns the properties that determine which texels are read.
    #[inline(always)]
    pub(crate) const fn addressing(&self) -> &TexelAddressing {
        &self.addressing
    }
}

impl MipLevel<'_> {
    /// Computes the next level, of half the size, with a box filter over 2 × 2 texels. Returns
    /// `None` after a single texel. If the number of rows or columns is odd, the last row or column
    /// is skipped.
    fn downsample<'b>(&self, average: impl Fn([[u8; 4]; 4]) -> [u8; 4]) -> Option<MipLevel<'b>> {
        if self.width == 1 && self.height == 1 {
            return None;
        }
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let mut texels = Vec::with_capacity(width as usize * height as usize);
        let row = |y: i32| {
            let start = y.min(self.height - 1) as usize * self.width as usize;
            &self.texels[start..start + self.width as usize]
        };
        for y in 0..height {
            let (upper, lower) = (row(2 * y), row(2 * y + 1));
            // If a level is one texel wide, only its height is halved.
            if let ([a], [b]) = (upper, lower) {
                texels.push(average([*a, *a, *b, *b]));
                continue;
            }
            // Pairs of texels, without an unpaired last texel.
            let pairs = upper.as_chunks::<2>().0.iter().zip(lower.as_chunks::<2>().0);
            texels.extend(pairs.map(|(&[a, b], &[c, d])| average([a, b, c, d])));
        }
        Some(MipLevel { width, height, texels: Cow::Owned(texels) })
    }
}

/// Computes the mean of four linear texels, rounded to nearest.
///
/// Two channels are added at once, in the halves of a 32-bit number.
fn average_texels(four: [[u8; 4]; 4]) -> [u8; 4] {
    const CHANNELS: u32 = 0x00ff_00ff;
    let texels = four.map(u32::from_le_bytes);
    let mean = |shift: u32| {
        let sum: u32 = texels.iter().map(|texel| texel >> shift & CHANNELS).sum();
        (sum + 0x0002_0002) >> 2 & CHANNELS
    };
    (mean(0) | mean(8) << 8).to_le_bytes()
}

/// Tables for averaging sRGB colors in linear light.
#[derive(Debug)]
struct SrgbAverager {
    /// The 16-bit linear light of each code.
    linear: [u32; 256],
    /// The nearest code for each 16-bit linear light.
    codes: Vec<u8>,
}

impl SrgbAverager {
    /// Returns the tables, which are computed once.
    fn shared() -> &'static Self {
        static TABLES: OnceLock<SrgbAverager> = OnceLock::new();
        TABLES.get_or_init(|| {
            let linear = srgb_to_linear_table().map(|light| (light * 65535.0 + 0.5) as u32);
            let encoder = crate::color::SrgbEncoder::shared();
            let code = |light: u16| encoder.encode(f32::from(light) / 65535.0);
            Self { linear, codes: (0..=65535).map(code).collect() }
        })
    }

    /// Computes the mean of four colors in linear light. Alpha is already linear.
    fn average(&self, four: [[u8; 4]; 4]) -> [u8; 4] {
        let color = |k: usize| {
            // The mean in linear light with 16 bits, then back to the nearest sRGB code.
            let sum: u32 = four.iter().map(|texel| self.linear[usize::from(texel[k])]).sum();
            self.codes[((sum + 2) / 4) as usize]
        };
        let alphas: u32 = four.iter().map(|texel| u32::from(texel[3])).sum();
        [color(0), color(1), color(2), ((alphas + 2) / 4) as u8]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_channels_are_averaged_separately_and_rounded_to_nearest() {
        let code = |n: u32| (n.wrapping_mul(2_654_435_761) >> 24) as u8;
        let texels = |n: u32| [0, 1, 2, 3].map(|k| [0, 1, 2, 3].map(|c| code(16 * n + 4 * k + c)));
        let extremes = [[[255; 4]; 4], [[0; 4]; 4], [[255, 0, 255, 0]; 4]];
        for four in extremes.into_iter().chain((0..10_000).map(texels)) {
            let average = average_texels(four);
            for channel in 0..4 {
                let sum: f32 = four.iter().map(|texel| f32::from(texel[channel])).sum();
                assert_eq!(f32::from(average[channel]), (sum / 4.0 + 0.5).floor(), "{four:?}");
            }
        }
    }
}
