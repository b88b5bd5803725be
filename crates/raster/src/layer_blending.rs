//! Pixels under translucent layers: fragment by fragment, the farthest first, put together sample by sample.

use crate::fragment_lanes::LANES;
use crate::sample_plane::NO_TRIANGLE;
use crate::tile_grid::TILE;
use crate::tile_resolve::{Contribution, PixelRun, TileResolve, split_before};
use crate::tile_visibility::TranslucentLayer;
use crate::{Encode, Surface};

/// The fragments of a row of pixels under layers, and their colours.
#[derive(Debug, Default)]
pub(crate) struct LayeredPixels {
    pub(crate) contributions: Vec<Contribution>,
    colors: Vec<[f32; 4]>,
    /// The shares of what is behind that they let through; without meaning where they are solid.
    transmittances: Vec<[f32; 3]>,
}

impl<S: Surface> TileResolve<'_, S> {
    /// Lists what is seen in each pixel of a run with layers: each solid piece once, then the layers, the farthest first. A
    /// pixel where nothing is seen gets a share of nothing, so that it is written.
    #[inline(always)]
    pub(crate) fn gather_contributions(&self, run: &PixelRun<'_>, shares: &mut Vec<Contribution>) {
        let mut planes = [[NO_TRIANGLE; LANES]; 16];
        let planes = self.sample_triangles(run, &mut planes);
        let mut layers = run.layers;
        for x in run.lanes.clone() {
            let lane = (x - run.block_start()) as usize;
            let mut left = self.full_sample_mask();
            while left != 0 {
                let piece = planes[left.trailing_zeros() as usize][lane];
                let mut mask = 0;
                for (sample, pieces) in planes.iter().enumerate() {
                    mask |= u16::from(pieces[lane] == piece) << sample;
                }
                left &= !mask;
                shares.push(Contribution { x, triangle: piece, mask, translucent: false });
            }
            let over;
            (over, layers) = split_before(layers, (run.y * TILE + x + 1) as usize);
            shares.extend(over.iter().map(|layer| {
                let TranslucentLayer { triangle: piece, mask, .. } = *layer;
                Contribution { x, triangle: piece, mask, translucent: true }
            }));
        }
    }

    fn full_sample_mask(&self) -> u16 {
        (u32::MAX >> (32 - self.frame.samples.count())) as u16
    }

    /// Writes the pixels of a row whose shares were gathered.
    #[inline(always)]
    pub(crate) fn write_layered_pixels<P: Copy>(
        &self,
        y: u32,
        row: &mut [P],
        encode: &impl Encode<P>,
        layered: &mut LayeredPixels,
    ) {
        let LayeredPixels { contributions: shares, colors, transmittances: through } = layered;
        colors.clear();
        through.clear();
        for eight in shares.chunks(LANES) {
            let fragments = self.gather_fragments(y, eight);
            let [r, g, b, alpha] = self.shade_contributions(eight, fragments.as_ref());
            colors.extend((0..eight.len()).map(|k| [r[k], g[k], b[k], alpha[k]]));
            let [r, g, b] = match fragments {
                Some(fragments) => self.surface.transmittance_eight(&fragments, &alpha),
                None => [[0.0; LANES]; 3],
            };
            through.extend((0..eight.len()).map(|k| [r[k], g[k], b[k]]));
        }
        let mut from = 0;
        while let Some(first) = shares.get(from) {
            let same = shares[from..].iter().take_while(|share| share.x == first.x).count();
            let range = from..from + same;
            let (shares, colors) = (&shares[range.clone()], &colors[range.clone()]);
            let color = self.blend_pixel(shares, colors, &through[range]);
            row[(first.x - self.rect.left) as usize] = encode.encode_pixel(color);
            from += same;
        }
    }

    /// The colour of a pixel, which is the mean of its samples.
    #[inline(always)]
    fn blend_pixel(
        &self,
        shares: &[Contribution],
        colors: &[[f32; 4]],
        through: &[[f32; 3]],
    ) -> [f32; 4] {
        if shares[shares.len() - 1].translucent {
            return self.blend_layers(shares, colors, through);
        }
        let mut sum = [0.0; 4];
        for (share, color) in shares.iter().zip(colors) {
            let samples = share.mask.count_ones() as f32;
            for (sum, channel) in sum.iter_mut().zip(color) {
                *sum += channel * samples;
            }
        }
        self.mean_color(sum)
    }

    /// With something translucent over it, a pixel is put together sample by sample.
    fn blend_layers(
        &self,
        shares: &[Contribution],
        colors: &[[f32; 4]],
        through: &[[f32; 3]],
    ) -> [f32; 4] {
        let mut samples = [[0.0; 4]; 16];
        for ((share, color), [r, g, b]) in shares.iter().zip(colors).zip(through) {
            let mut behind = [0.0; 4];
            if share.translucent {
                behind = [*r, *g, *b, 1.0 - color[3]];
            }
            for (number, sample) in samples.iter_mut().enumerate() {
                if share.mask & (1 << number) != 0 {
                    *sample = [0, 1, 2, 3].map(|k| color[k] + sample[k] * behind[k]);
                }
            }
        }
        let mut sum = [0.0; 4];
        for sample in &samples[..self.frame.samples.count()] {
            sum = [0, 1, 2, 3].map(|k| sum[k] + sample[k]);
        }
        self.mean_color(sum)
    }

    #[inline(always)]
    fn mean_color(&self, sum: [f32; 4]) -> [f32; 4] {
        let count = self.frame.samples.count() as f32;
        sum.map(|channel| channel / count)
    }
}
