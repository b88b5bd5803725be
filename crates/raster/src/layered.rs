//! Pixels under translucent layers: fragment by fragment, the farthest first, put together sample by sample.

use crate::fragments::WIDE;
use crate::grid::TILE;
use crate::plane::NOTHING;
use crate::resolve::{Resolve, Run, Share, split_before};
use crate::tile::Layer;
use crate::{Encode, Surface};

/// The fragments of a row of pixels under layers, and their colours.
#[derive(Debug, Default)]
pub(crate) struct Layered {
    pub(crate) shares: Vec<Share>,
    colors: Vec<[f32; 4]>,
    /// The shares of what is behind that they let through; without meaning where they are solid.
    through: Vec<[f32; 3]>,
}

impl<S: Surface> Resolve<'_, S> {
    /// Lists what is seen in each pixel of a run with layers: each solid piece once, then the layers, the farthest first. A
    /// pixel where nothing is seen gets a share of nothing, so that it is written.
    #[inline(always)]
    pub(crate) fn gather(&self, run: &Run<'_>, shares: &mut Vec<Share>) {
        let mut planes = [[NOTHING; WIDE]; 16];
        let planes = self.planes(run, &mut planes);
        let mut layers = run.over;
        for x in run.lanes.clone() {
            let lane = (x - run.block()) as usize;
            let mut left = self.all_samples();
            while left != 0 {
                let piece = planes[left.trailing_zeros() as usize][lane];
                let mut mask = 0;
                for (sample, pieces) in planes.iter().enumerate() {
                    mask |= u16::from(pieces[lane] == piece) << sample;
                }
                left &= !mask;
                shares.push(Share { x, piece, mask, translucent: false });
            }
            let over;
            (over, layers) = split_before(layers, (run.y * TILE + x + 1) as usize);
            shares.extend(over.iter().map(|layer| {
                let Layer { piece, mask, .. } = *layer;
                Share { x, piece, mask, translucent: true }
            }));
        }
    }

    fn all_samples(&self) -> u16 {
        (u32::MAX >> (32 - self.frame.samples.count())) as u16
    }

    /// Writes the pixels of a row whose shares were gathered.
    #[inline(always)]
    pub(crate) fn write_layered<P: Copy>(
        &self,
        y: u32,
        row: &mut [P],
        encode: &impl Encode<P>,
        layered: &mut Layered,
    ) {
        let Layered { shares, colors, through } = layered;
        colors.clear();
        through.clear();
        for eight in shares.chunks(WIDE) {
            let fragments = self.fragments(y, eight);
            let [r, g, b, alpha] = self.shade_shares(eight, fragments.as_ref());
            colors.extend((0..eight.len()).map(|k| [r[k], g[k], b[k], alpha[k]]));
            let [r, g, b] = match fragments {
                Some(fragments) => self.surface.through_eight(&fragments, &alpha),
                None => [[0.0; WIDE]; 3],
            };
            through.extend((0..eight.len()).map(|k| [r[k], g[k], b[k]]));
        }
        let mut from = 0;
        while let Some(first) = shares.get(from) {
            let same = shares[from..].iter().take_while(|share| share.x == first.x).count();
            let range = from..from + same;
            let (shares, colors) = (&shares[range.clone()], &colors[range.clone()]);
            let color = self.put_together(shares, colors, &through[range]);
            row[(first.x - self.rect.left) as usize] = encode.pixel(color);
            from += same;
        }
    }

    /// The colour of a pixel, which is the mean of its samples.
    #[inline(always)]
    fn put_together(
        &self,
        shares: &[Share],
        colors: &[[f32; 4]],
        through: &[[f32; 3]],
    ) -> [f32; 4] {
        if shares[shares.len() - 1].translucent {
            return self.put_together_layers(shares, colors, through);
        }
        let mut sum = [0.0; 4];
        for (share, color) in shares.iter().zip(colors) {
            let samples = share.mask.count_ones() as f32;
            for (sum, channel) in sum.iter_mut().zip(color) {
                *sum += channel * samples;
            }
        }
        self.mean(sum)
    }

    /// With something translucent over it, a pixel is put together sample by sample.
    fn put_together_layers(
        &self,
        shares: &[Share],
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
        self.mean(sum)
    }

    #[inline(always)]
    fn mean(&self, sum: [f32; 4]) -> [f32; 4] {
        let count = self.frame.samples.count() as f32;
        sum.map(|channel| channel / count)
    }
}
