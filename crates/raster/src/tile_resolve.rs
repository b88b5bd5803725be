//! From a filled tile to colours: each visible piece is shaded once per pixel, eight fragments at a time.
//!
//! Most rows of eight neighbouring pixels show one piece in each pixel: they are shaded as they lie. Of pixels on edges only the
//! pieces that others than the first sample see are left over ([`EdgePixels`]). What lies under layers is gathered fragment by
//! fragment, shaded eight at a time and put together sample by sample.

use crate::edge_pixels::EdgePixels;
use crate::fragment_lanes::{F32x8, LANES};
use crate::layer_blending::LayeredPixels;
use crate::primitive::ScreenTriangle;
use crate::sample_plane::{NO_TRIANGLE, pixel_index};
use crate::tile_grid::{FrameRegion, TILE, TileRect};
use crate::tile_visibility::{TileVisibility, TranslucentLayer};
use crate::{Encode, Fragments, Frame, Surface};

/// A filled tile on its way to colours.
pub(crate) struct TileResolve<'a, S> {
    pub(crate) frame: &'a Frame,
    pub(crate) surface: &'a S,
    pub(crate) background: [f32; 4],
    pub(crate) tile: &'a TileVisibility,
    pub(crate) rect: TileRect,
}

/// What a piece adds to a pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contribution {
    /// The pixel's column within the tile.
    pub(crate) x: u32,
    pub(crate) triangle: u32,
    /// The samples it is seen by, bit by bit.
    pub(crate) mask: u16,
    /// Whether it lets through what is behind it.
    pub(crate) translucent: bool,
}

/// What a row of the tile shows that cannot be written at once; kept so that its memory is used again.
#[derive(Debug, Default)]
pub(crate) struct RowScratch {
    edges: EdgePixels,
    layered: LayeredPixels,
}

/// Neighbouring pixels of a row, all in one block, with the layers over them.
pub(crate) struct PixelRun<'a> {
    pub(crate) y: u32,
    /// The columns within the tile.
    pub(crate) lanes: std::ops::Range<u32>,
    pub(crate) layers: &'a [TranslucentLayer],
}

impl PixelRun<'_> {
    /// The first column of the block.
    pub(crate) fn block_start(&self) -> u32 {
        self.lanes.start / LANES as u32 * LANES as u32
    }
}

impl<S: Surface> TileResolve<'_, S> {
    /// Writes what the tile shows into its band: the rows of the frame that the tile's row shows, filled with the background.
    #[inline(always)]
    pub(crate) fn write_tile<P: Copy>(
        &self,
        band: &mut [P],
        scratch: &mut RowScratch,
        encode: &impl Encode<P>,
    ) {
        let TileRect { x, left, top, right, bottom, .. } = self.rect;
        let FrameRegion { x: from, width, .. } = self.frame.region;
        let empty = encode.encode_pixel(self.background);
        let mut layers = self.tile.layers.as_slice();
        for y in top..bottom {
            let start = (y - top) as usize * width as usize + (x + left - from) as usize;
            let Some(row) = band.get_mut(start..start + (right - left) as usize) else { return };
            let over;
            (over, layers) = split_before(layers, ((y + 1) * TILE) as usize);
            self.write_row(y, over, row, empty, encode, scratch);
            self.write_edge_pixels(y, row, encode, &mut scratch.edges);
            self.write_layered_pixels(y, row, encode, &mut scratch.layered);
        }
    }

    /// Writes those pixels of a row that show one piece each, and gathers what the others show.
    #[inline(always)]
    fn write_row<P: Copy>(
        &self,
        y: u32,
        mut layers: &[TranslucentLayer],
        row: &mut [P],
        empty: P,
        encode: &impl Encode<P>,
        scratch: &mut RowScratch,
    ) {
        let TileRect { left, right, .. } = self.rect;
        let RowScratch { edges, layered } = scratch;
        layered.contributions.clear();
        edges.clear();
        let mut rest = row;
        let wide = LANES as u32;
        for block in left / wide..right.div_ceil(wide) {
            let lanes = left.max(block * wide)..right.min((block + 1) * wide);
            let targets;
            (targets, rest) = rest.split_at_mut(lanes.len());
            let over;
            (over, layers) = split_before(layers, (y * TILE + lanes.end) as usize);
            let run = PixelRun { y, lanes, layers: over };
            if !run.layers.is_empty() {
                self.gather_contributions(&run, &mut layered.contributions);
                continue;
            }
            match self.single_triangles(&run) {
                Some(pieces) => self.write_uniform(&run, pieces, targets, empty, encode),
                None => self.begin_edge_pixels(&run, edges),
            }
        }
    }

    /// The pieces that the pixels of a run see, if each pixel sees just one.
    #[inline(always)]
    fn single_triangles(&self, run: &PixelRun<'_>) -> Option<[u32; LANES]> {
        let at = pixel_index(run.block_start() as usize, run.y as usize);
        let first = self.tile.row_triangles(0, at);
        let mut differs = 0;
        for sample in 1..self.frame.samples.count() {
            let pieces = self.tile.row_triangles(sample, at);
            for lane in 0..LANES {
                differs |= pieces[lane] ^ first[lane];
            }
        }
        (differs == 0).then_some(first)
    }

    /// The pieces that the samples of a run see.
    #[inline(always)]
    pub(crate) fn sample_triangles<'p>(
        &self,
        run: &PixelRun<'_>,
        planes: &'p mut [[u32; LANES]; 16],
    ) -> &'p [[u32; LANES]] {
        let at = pixel_index(run.block_start() as usize, run.y as usize);
        let planes = &mut planes[..self.frame.samples.count()];
        for (sample, pieces) in planes.iter_mut().enumerate() {
            *pieces = self.tile.row_triangles(sample, at);
        }
        planes
    }

    /// Writes neighbouring pixels with one piece each.
    #[inline(always)]
    fn write_uniform<P: Copy>(
        &self,
        run: &PixelRun<'_>,
        pieces: [u32; LANES],
        targets: &mut [P],
        empty: P,
        encode: &impl Encode<P>,
    ) {
        let differs = any_differ(pieces);
        if !differs && pieces[0] == NO_TRIANGLE {
            return;
        }
        let [r, g, b] = self.shade_neighbors(run, pieces, differs);
        let mut pixels = encode.encode_eight(&[r, g, b, [1.0; LANES]]);
        if differs {
            for (pixel, piece) in pixels.iter_mut().zip(pieces) {
                *pixel = if piece == NO_TRIANGLE { empty } else { *pixel };
            }
        }
        if let Ok(targets) = <&mut [P; LANES]>::try_from(&mut *targets) {
            *targets = pixels;
        } else {
            let first = (run.lanes.start - run.block_start()) as usize;
            targets.copy_from_slice(&pixels[first..first + targets.len()]);
        }
    }

    /// The colours of a run with one piece for each pixel, and whether they differ. Pixels that show nothing get any colour.
    #[inline(always)]
    fn shade_neighbors(
        &self,
        run: &PixelRun<'_>,
        pieces: [u32; LANES],
        differs: bool,
    ) -> [F32x8; 3] {
        let (x, y) = (self.rect.x + run.block_start(), self.rect.y + run.y);
        let [r, g, b, _] = if differs {
            self.shade_several(pieces, x, y)
        } else {
            let piece = self.triangle(pieces[0]);
            self.surface.shade_eight(&Fragments::from_one_triangle(
                piece,
                &self.frame.source_weights,
                x,
                y,
            ))
        };
        [r, g, b]
    }

    /// Shades eight pixels from (x, y) to the right, not all of which show the same; those that show nothing get any colour.
    #[inline(always)]
    fn shade_several(&self, pieces: [u32; LANES], x: u32, y: u32) -> [F32x8; 4] {
        // Nothing is the largest number: the least is a piece. Pixels that show nothing repeat the one that shows it, so that no
        // surface is asked for a place where it is not.
        let (mut any, mut place) = (NO_TRIANGLE, 0);
        for (lane, &piece) in pieces.iter().enumerate() {
            if piece < any {
                (any, place) = (piece, lane as u32);
            }
        }
        let mut seen = [self.triangle(any); LANES];
        let mut columns = [x + place; LANES];
        for lane in 0..LANES {
            if pieces[lane] != NO_TRIANGLE {
                columns[lane] = x + lane as u32;
                seen[lane] = self.triangle(pieces[lane]);
            }
        }
        let fragments = Fragments::from_triangles(seen, &self.frame.source_weights, columns, y);
        self.surface.shade_eight(&fragments)
    }

    #[inline(always)]
    fn triangle(&self, number: u32) -> &ScreenTriangle {
        self.frame.triangles.triangle(number)
    }

    /// Shades what the first samples of a run see, and takes note of what the others see.
    #[inline(always)]
    fn begin_edge_pixels(&self, run: &PixelRun<'_>, edges: &mut EdgePixels) {
        let mut planes = [[NO_TRIANGLE; LANES]; 16];
        let planes = self.sample_triangles(run, &mut planes);
        let first = planes[0];
        let differs = any_differ(first);
        let [r, g, b] = if differs || first[0] != NO_TRIANGLE {
            self.shade_neighbors(run, first, differs)
        } else {
            [[0.0; LANES]; 3]
        };
        let mut colors = [r, g, b, [1.0; LANES]];
        for (color, background) in colors.iter_mut().zip(self.background) {
            for lane in 0..LANES {
                color[lane] = if first[lane] == NO_TRIANGLE { background } else { color[lane] };
            }
        }
        let lanes = run.lanes.start - run.block_start()..run.lanes.end - run.block_start();
        let lanes = lanes.start as usize..lanes.end as usize;
        edges.add_first_samples(run.block_start() as usize / LANES, lanes, planes, &colors);
    }

    /// Adds what is left of the pixels on the edges of a row, and writes them.
    #[inline(always)]
    fn write_edge_pixels<P: Copy>(
        &self,
        y: u32,
        row: &mut [P],
        encode: &impl Encode<P>,
        edges: &mut EdgePixels,
    ) {
        for from in (0..edges.contributions().len()).step_by(LANES) {
            let end = edges.contributions().len().min(from + LANES);
            let others = &edges.contributions()[from..end];
            let colors =
                self.shade_contributions(others, self.gather_fragments(y, others).as_ref());
            edges.add_contributions(from..end, &colors);
        }
        let (left, right) = (self.rect.left as usize, self.rect.right as usize);
        for (block, means) in edges.mean_colors(self.frame.samples) {
            let pixels = encode.encode_eight(&means);
            let (first, end) = ((block * LANES).max(left), ((block + 1) * LANES).min(right));
            row[first - left..end - left]
                .copy_from_slice(&pixels[first - block * LANES..end - block * LANES]);
        }
    }

    /// The fragments of up to eight shares of a row, not all of nothing; those of nothing repeat another.
    #[inline(always)]
    pub(crate) fn gather_fragments(
        &self,
        y: u32,
        shares: &[Contribution],
    ) -> Option<Fragments<'_>> {
        let any = shares.iter().find(|share| share.triangle != NO_TRIANGLE)?;
        let mut seen = [self.triangle(any.triangle); LANES];
        let mut columns = [self.rect.x + any.x; LANES];
        for (lane, share) in
            shares.iter().enumerate().filter(|(_, share)| share.triangle != NO_TRIANGLE)
        {
            seen[lane] = self.triangle(share.triangle);
            columns[lane] = self.rect.x + share.x;
        }
        Some(Fragments::from_triangles(seen, &self.frame.source_weights, columns, self.rect.y + y))
    }

    /// The colours of up to eight shares of a row, by their [fragments](Self::gather_fragments); those of nothing have the background's.
    #[inline(always)]
    pub(crate) fn shade_contributions(
        &self,
        shares: &[Contribution],
        fragments: Option<&Fragments<'_>>,
    ) -> [F32x8; 4] {
        let mut colors = [[0.0; LANES]; 4];
        if let Some(fragments) = fragments {
            colors = self.surface.shade_eight(fragments);
        }
        for (lane, share) in shares.iter().enumerate() {
            if share.triangle == NO_TRIANGLE {
                for (color, background) in colors.iter_mut().zip(self.background) {
                    color[lane] = background;
                }
            } else if !share.translucent {
                colors[3][lane] = 1.0;
            }
        }
        colors
    }
}

/// Whether not all are the same.
#[inline(always)]
fn any_differ(pieces: [u32; LANES]) -> bool {
    let mut differs = 0;
    for piece in pieces {
        differs |= piece ^ pieces[0];
    }
    differs != 0
}

/// Splits layers, which are sorted by pixel, into those of pixels before `end` and the rest.
#[inline]
pub(crate) fn split_before(
    layers: &[TranslucentLayer],
    end: usize,
) -> (&[TranslucentLayer], &[TranslucentLayer]) {
    let count = layers.iter().take_while(|layer| usize::from(layer.pixel) < end).count();
    layers.split_at(count)
}
