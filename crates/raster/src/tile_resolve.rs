//! Deferred shading of a filled tile: shades each visible triangle once per pixel, eight fragments
//! at a time.
//!
//! | pixels of a row | shaded | by |
//! | --- | --- | --- |
//! | eight neighbors with one triangle each | in place | this module |
//! | with several triangles (edges) | first samples in place, others gathered | [`EdgePixels`] |
//! | under translucent layers | gathered, blended sample by sample | [`LayeredPixels`] |
//!
//! Most pixels are of the first kind, which needs no gathering and no sums.
//!
//! Resolving takes the mean of the samples of a pixel in linear light, before the target's
//! encoding: a mean of encoded values would darken edges. Each triangle is shaded at most once per
//! pixel, and its color is weighted by the number of samples that show it (multisampling, not
//! supersampling). Neighboring triangles of one smooth surface share one color per pixel (fragment
//! merging: Fatahalian and others, *Reducing shading on GPUs using quad-fragment merging*, 2010).
//! If a mesh is as fine as the pixels, most of its triangles are merged.

use crate::edge_pixels::EdgePixels;
use crate::fragment_lanes::{F32x8, LANES};
use crate::layer_blending::LayeredPixels;
use crate::primitive::{ScreenTriangle, WeightSource};
use crate::sample_plane::{NO_TRIANGLE, pixel_index};
use crate::tile_grid::{TILE, TileRect};
use crate::tile_visibility::{TileVisibility, TranslucentLayer};
use crate::{Encode, Fragments, Frame, Surface};
use homog::PixelRect;

/// A filled tile with everything needed to shade it.
///
/// Shading does not modify the tile. Rows are written in order, from the top.
pub(crate) struct TileResolve<'a, S> {
    pub(crate) frame: &'a Frame,
    pub(crate) surface: &'a S,
    pub(crate) background: [f32; 4],
    pub(crate) tile: &'a TileVisibility,
    pub(crate) rect: TileRect,
}

/// The contribution of a triangle to a pixel: the samples at which it is visible.
///
/// The masks of a pixel's opaque contributions are disjoint and together contain all of its
/// samples.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contribution {
    /// The column of the pixel within the tile.
    pub(crate) x: u32,
    /// The triangle, or [`NO_TRIANGLE`] for the background.
    pub(crate) triangle: u32,
    /// The samples, one bit each.
    pub(crate) mask: u16,
    /// Whether the triangle is translucent.
    pub(crate) translucent: bool,
}

/// The pixels of a row that cannot be written immediately. The buffers are reused between rows.
#[derive(Debug, Default)]
pub(crate) struct RowScratch {
    /// Pixels that several opaque triangles share.
    edges: EdgePixels,
    /// Pixels with translucent layers.
    layered: LayeredPixels,
}

/// Adjacent pixels of a row, all in one block, with the layers over them.
pub(crate) struct PixelRun<'a> {
    /// The row within the tile.
    pub(crate) y: u32,
    /// The columns within the tile.
    pub(crate) lanes: std::ops::Range<u32>,
    /// The translucent layers over these pixels, sorted by pixel and back to front.
    pub(crate) layers: &'a [TranslucentLayer],
}

impl PixelRun<'_> {
    /// Returns the first column of the block.
    pub(crate) fn block_start(&self) -> u32 {
        self.lanes.start / LANES as u32 * LANES as u32
    }
}

/// A row of a tile's pixels in the target, and the encoded background.
struct TargetRow<'a, P> {
    /// The row within the tile.
    y: u32,
    /// The visible pixels of the row, in the target.
    pixels: &'a mut [P],
    /// The encoded background, computed once for the tile.
    empty: P,
}

impl<S: Surface> TileResolve<'_, S> {
    /// Writes the tile into its band, the rows of the frame that its row of tiles covers. The band
    /// must already be filled with the background.
    ///
    /// Layers are sorted by pixel, row by row, so each row takes its layers from the front of the
    /// list.
    #[inline(always)]
    pub(crate) fn write_tile<P: Copy>(
        &self,
        band: &mut [P],
        scratch: &mut RowScratch,
        encode: &impl Encode<P>,
    ) {
        let TileRect { x, left, top, right, bottom, .. } = self.rect;
        let PixelRect { x: from, width, .. } = self.frame.region;
        let empty = encode.encode_pixel(self.background);
        let mut layers = self.tile.layers.as_slice();
        for y in top..bottom {
            // The row within the band; a target that is too short ends the tile early.
            let start = (y - top) as usize * width as usize + (x + left - from) as usize;
            let Some(row) = band.get_mut(start..start + (right - left) as usize) else { return };
            let over;
            (over, layers) = split_before(layers, ((y + 1) * TILE) as usize);
            self.write_row(TargetRow { y, pixels: row, empty }, over, encode, scratch);
            self.write_edge_pixels(y, row, encode, &mut scratch.edges);
            self.write_layered_pixels(y, row, encode, &mut scratch.layered);
        }
    }

    /// Writes the pixels of a row that show one triangle each, and gathers the others.
    ///
    /// A block of eight pixels is handled as a whole: one pixel with a layer or an edge sends all
    /// eight down the slower path, which is correct for any pixel.
    #[inline(always)]
    fn write_row<P: Copy>(
        &self,
        TargetRow { y, pixels, empty }: TargetRow<'_, P>,
        mut layers: &[TranslucentLayer],
        encode: &impl Encode<P>,
        scratch: &mut RowScratch,
    ) {
        let TileRect { left, right, .. } = self.rect;
        let RowScratch { edges, layered } = scratch;
        layered.contributions.clear();
        edges.clear();
        let mut rest = pixels;
        let width = LANES as u32;
        for block in left / width..right.div_ceil(width) {
            // The visible columns of the block: fewer than eight at the borders of the region.
            let lanes = left.max(block * width)..right.min((block + 1) * width);
            let targets;
            (targets, rest) = rest.split_at_mut(lanes.len());
            let over;
            (over, layers) = split_before(layers, (y * TILE + lanes.end) as usize);
            let run = PixelRun { y, lanes, layers: over };
            // Translucent layers are gathered now and blended sample by sample after the row.
            if !run.layers.is_empty() {
                self.gather_contributions(&run, &mut layered.contributions);
                continue;
            }
            // If each pixel has one triangle, shade and write immediately. If not, an edge crosses
            // the run.
            match self.single_triangles(&run) {
                Some(triangles) => self.write_uniform(&run, triangles, targets, empty, encode),
                None => self.begin_edge_pixels(&run, edges),
            }
        }
    }

    /// Returns the triangles of a run's pixels if each pixel has the same triangle at all samples.
    ///
    /// The test combines whole vectors with exclusive or and accumulates the result over the
    /// samples, so the loop has no branch.
    #[inline(always)]
    fn single_triangles(&self, run: &PixelRun<'_>) -> Option<[u32; LANES]> {
        let at = pixel_index(run.block_start() as usize, run.y as usize);
        let first = self.tile.row_triangles(0, at);
        let mut differs = 0;
        // Compare every sample plane with the first.
        for sample in 1..self.frame.samples.count() {
            let triangles = self.tile.row_triangles(sample, at);
            for lane in 0..LANES {
                differs |= triangles[lane] ^ first[lane];
            }
        }
        (differs == 0).then_some(first)
    }

    /// Returns the triangles of a run's pixels, sample by sample.
    ///
    /// `planes` provides the memory for the result: a frame has at most 16 planes.
    #[inline(always)]
    pub(crate) fn sample_triangles<'p>(
        &self,
        run: &PixelRun<'_>,
        planes: &'p mut [[u32; LANES]; 16],
    ) -> &'p [[u32; LANES]] {
        let at = pixel_index(run.block_start() as usize, run.y as usize);
        let planes = &mut planes[..self.frame.samples.count()];
        for (sample, triangles) in planes.iter_mut().enumerate() {
            *triangles = self.tile.row_triangles(sample, at);
        }
        planes
    }

    /// Shades and writes adjacent pixels with one triangle each.
    ///
    /// Background pixels are left unchanged: the band is already filled with the background.
    #[inline(always)]
    fn write_uniform<P: Copy>(
        &self,
        run: &PixelRun<'_>,
        triangles: [u32; LANES],
        targets: &mut [P],
        empty: P,
        encode: &impl Encode<P>,
    ) {
        let differs = any_differ(triangles);
        // Background only.
        if !differs && triangles[0] == NO_TRIANGLE {
            return;
        }
        let mut pixels = encode.encode_eight(&self.shade_neighbors(run, triangles, differs));
        // Background lanes were shaded with a neighbor's fragment; restore the background.
        if differs {
            for (pixel, triangle) in pixels.iter_mut().zip(triangles) {
                *pixel = if triangle == NO_TRIANGLE { empty } else { *pixel };
            }
        }
        // A whole block takes one store; at the borders of the region, fewer pixels are visible.
        if let Ok(targets) = <&mut [P; LANES]>::try_from(&mut *targets) {
            *targets = pixels;
        } else {
            let first = (run.lanes.start - run.block_start()) as usize;
            targets.copy_from_slice(&pixels[first..first + targets.len()]);
        }
    }

    /// Returns the colors of a run with one triangle per pixel; `differs` is true unless all
    /// triangles are the same. The colors of background pixels are arbitrary.
    ///
    /// One triangle in eight adjacent pixels is the common case: vertex attributes are fetched
    /// once, and no gathering is needed.
    #[inline(always)]
    fn shade_neighbors(
        &self,
        run: &PixelRun<'_>,
        triangles: [u32; LANES],
        differs: bool,
    ) -> [F32x8; 4] {
        let (x, y) = (self.rect.x + run.block_start(), self.rect.y + run.y);
        if differs {
            return self.shade_several(triangles, x, y);
        }
        let triangle = self.triangle(triangles[0]);
        let source_weights = &self.frame.source_weights;
        self.surface.shade_eight(&Fragments::from_one_triangle(triangle, source_weights, x, y))
    }

    /// Shades eight pixels, from (x, y) to the right, that show different triangles. The colors of
    /// background pixels are arbitrary.
    #[inline(always)]
    fn shade_several(&self, triangles: [u32; LANES], x: u32, y: u32) -> [F32x8; 4] {
        // The background has the largest index, so the minimum is a triangle. Background lanes
        // repeat that triangle's fragment, so no surface is shaded where it is not visible.
        let (mut any, mut any_lane) = (NO_TRIANGLE, 0);
        for (lane, &triangle) in triangles.iter().enumerate() {
            if triangle < any {
                (any, any_lane) = (triangle, lane as u32);
            }
        }
        let mut visible = [self.triangle(any); LANES];
        let mut columns = [x + any_lane; LANES];
        for lane in 0..LANES {
            if triangles[lane] != NO_TRIANGLE {
                columns[lane] = x + lane as u32;
                visible[lane] = self.triangle(triangles[lane]);
            }
        }
        let fragments = Fragments::from_triangles(visible, &self.frame.source_weights, columns, y);
        self.surface.shade_eight(&fragments)
    }

    /// Returns the triangle of the frame with this index, which must not be [`NO_TRIANGLE`].
    #[inline(always)]
    fn triangle(&self, index: u32) -> &ScreenTriangle {
        self.frame.triangles.triangle(index)
    }

    /// Shades the first samples of a run with edges, and gathers the triangles of the other
    /// samples.
    ///
    /// Most pixels of a run with edges still show the first sample's triangle at most of their
    /// samples, so this one vector of eight does most of the work.
    #[inline(always)]
    fn begin_edge_pixels(&self, run: &PixelRun<'_>, edges: &mut EdgePixels) {
        let mut planes = [[NO_TRIANGLE; LANES]; 16];
        let planes = self.sample_triangles(run, &mut planes);
        let first = planes[0];
        let differs = any_differ(first);
        let mut colors = [[0.0; LANES]; 4];
        if differs || first[0] != NO_TRIANGLE {
            colors = self.shade_neighbors(run, first, differs);
        }
        // Set the background color where the first sample shows it.
        for (color, background) in colors.iter_mut().zip(self.background) {
            for lane in 0..LANES {
                color[lane] = if first[lane] == NO_TRIANGLE { background } else { color[lane] };
            }
        }
        let lanes = run.lanes.start - run.block_start()..run.lanes.end - run.block_start();
        let lanes = lanes.start as usize..lanes.end as usize;
        let continues = |first, other| self.is_one_surface(first, other);
        let block = run.block_start() as usize / LANES;
        edges.add_first_samples(block, lanes, planes, &colors, continues);
    }

    /// Returns whether two triangles of one pixel are parts of one smooth surface that needs only
    /// one color. The background is not part of any surface.
    ///
    /// Both must show the same side to the viewer; parts of clipped triangles are never merged.
    #[inline(always)]
    fn is_one_surface(&self, first: u32, other: u32) -> bool {
        if first == NO_TRIANGLE || other == NO_TRIANGLE {
            return false;
        }
        let (first, other) = (self.triangle(first), self.triangle(other));
        let is_clipped = matches!(first.source, WeightSource::Clipped(_));
        !is_clipped
            && first.source == other.source
            && self.surface.is_continuous(first.id, other.id)
    }

    /// Shades the gathered contributions to a row's edge pixels, resolves the samples and writes
    /// the pixels.
    #[inline(always)]
    fn write_edge_pixels<P: Copy>(
        &self,
        y: u32,
        row: &mut [P],
        encode: &impl Encode<P>,
        edges: &mut EdgePixels,
    ) {
        // Shade the triangles of the other samples, eight contributions at a time, along the whole
        // row.
        for from in (0..edges.contributions().len()).step_by(LANES) {
            let end = edges.contributions().len().min(from + LANES);
            let eight = &edges.contributions()[from..end];
            let mut colors = [[0.0; LANES]; 4];
            if let Some(fragments) = self.gather_fragments(y, eight) {
                colors = self.surface.shade_eight(&fragments);
            }
            self.fix_background_colors(eight, &mut colors);
            edges.add_contributions(from..end, &colors);
        }
        let (left, right) = (self.rect.left as usize, self.rect.right as usize);
        // Multisample resolve: take the mean in linear light, then encode it.
        for (block, means) in edges.mean_colors(self.frame.samples) {
            let pixels = encode.encode_eight(&means);
            let (first, end) = ((block * LANES).max(left), ((block + 1) * LANES).min(right));
            row[first - left..end - left]
                .copy_from_slice(&pixels[first - block * LANES..end - block * LANES]);
        }
    }

    /// Returns the fragments of up to eight contributions to a row, or `None` if all are
    /// background.
    ///
    /// Background lanes repeat another fragment.
    ///
    /// The contributions are in one row, so a fragment needs only its column.
    #[inline(always)]
    pub(crate) fn gather_fragments(
        &self,
        y: u32,
        contributions: &[Contribution],
    ) -> Option<Fragments<'_>> {
        let any = contributions.iter().find(|next| next.triangle != NO_TRIANGLE)?;
        let mut visible = [self.triangle(any.triangle); LANES];
        let mut columns = [self.rect.x + any.x; LANES];
        let numbered = contributions.iter().enumerate();
        for (lane, next) in numbered.filter(|(_, next)| next.triangle != NO_TRIANGLE) {
            visible[lane] = self.triangle(next.triangle);
            columns[lane] = self.rect.x + next.x;
        }
        let source_weights = &self.frame.source_weights;
        Some(Fragments::from_triangles(visible, source_weights, columns, self.rect.y + y))
    }

    /// Sets the colors of contributions that are not shaded: contributions without a triangle get
    /// the background color.
    #[inline(always)]
    pub(crate) fn fix_background_colors(
        &self,
        contributions: &[Contribution],
        colors: &mut [F32x8; 4],
    ) {
        for (lane, contribution) in contributions.iter().enumerate() {
            if contribution.triangle == NO_TRIANGLE {
                for (color, background) in colors.iter_mut().zip(self.background) {
                    color[lane] = background;
                }
            }
        }
    }
}

/// Returns whether the triangles of eight pixels are not all the same.
///
/// Uses exclusive or instead of comparisons: eight lanes form one vector, and there is only one
/// branch.
#[inline(always)]
fn any_differ(triangles: [u32; LANES]) -> bool {
    let mut differs = 0;
    for triangle in triangles {
        differs |= triangle ^ triangles[0];
    }
    differs != 0
}

/// Splits layers, which are sorted by pixel, into layers of pixels before `end` and the rest.
///
/// The time is linear in the number of layers taken, so every layer of a tile is visited once.
#[inline]
pub(crate) fn split_before(
    layers: &[TranslucentLayer],
    end: usize,
) -> (&[TranslucentLayer], &[TranslucentLayer]) {
    let count = layers.iter().take_while(|layer| usize::from(layer.pixel) < end).count();
    layers.split_at(count)
}
