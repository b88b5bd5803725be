//! Visibility in one tile: for each sample, how near the nearest solid surface is and which it is.

use crate::fragment_lanes::LANES;
use crate::rasterize::{TriangleLanes, rasterize_triangle};
use crate::sample_plane::{BLOCK_SIDE, NO_TRIANGLE, SamplePlane};
use crate::tile_grid::{TILE, TileRect};
use crate::triangle_batch::{self, BatchStarts, TriangleBatch};
use crate::triangle_setup::TriangleSetup;
use crate::{Fragments, Frame, Opacity, Surface};
use fearless_simd::{Simd, dispatch};

/// One pixel's share of a translucent piece.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct TranslucentLayer {
    /// The pixel within the tile, row by row.
    pub(crate) pixel: u16,
    /// The samples covered, bit by bit.
    pub(crate) mask: u16,
    pub(crate) triangle: u32,
    pub(crate) depth: f32,
}

/// What is visible in a tile: a plane for each sample, and the translucent layers over them.
#[derive(Debug, Default)]
pub(crate) struct TileVisibility {
    planes: Vec<SamplePlane>,
    pub(crate) layers: Vec<TranslucentLayer>,
    /// A depth that no sample of any plane is farther than: what lies behind it is hidden.
    farthest_depth: f32,
    /// Where the functions of eight triangles start, for each plane.
    batch_starts: Vec<BatchStarts>,
}

impl TileVisibility {
    /// The piece seen by a sample of a pixel ([`pixel_index`](crate::sample_plane::pixel_index) says where it is); [`NO_TRIANGLE`] for the background.
    pub(crate) fn triangle(&self, sample: usize, at: usize) -> u32 {
        self.planes[sample].triangle[at]
    }

    /// The pieces that one sample of each of eight neighbouring pixels sees, from the one at `at`, which begins a row of a block.
    #[inline(always)]
    pub(crate) fn row_triangles(&self, sample: usize, at: usize) -> [u32; BLOCK_SIDE] {
        let mut row = [NO_TRIANGLE; BLOCK_SIDE];
        row.copy_from_slice(&self.planes[sample].triangle[at..at + BLOCK_SIDE]);
        row
    }

    /// The depth of the nearest piece at a sample of a pixel, −∞ for the background.
    pub(crate) fn sample_depth(&self, sample: usize, at: usize) -> f32 {
        self.planes[sample].depth[at]
    }

    /// Finds what is visible in `rect` of the pieces `bin`.
    pub(crate) fn rasterize_bin(
        &mut self,
        frame: &Frame,
        rect: TileRect,
        bin: &[u32],
        surface: &dyn Surface,
    ) {
        self.planes.resize_with(frame.samples.count(), SamplePlane::new);
        self.planes.iter_mut().for_each(|plane| plane.clear(rect));
        self.farthest_depth = f32::NEG_INFINITY;
        self.layers.clear();
        dispatch!(frame.simd_level.level(), simd => self.rasterize_batches(simd, frame, rect, bin, surface));
        self.sort_layers();
    }

    #[inline(always)]
    fn rasterize_batches<S: Simd>(
        &mut self,
        simd: S,
        frame: &Frame,
        rect: TileRect,
        bin: &[u32],
        surface: &dyn Surface,
    ) {
        let mut translucent = false;
        let mut rest = bin.iter();
        let mut indices = [0; triangle_batch::BATCH_SIZE];
        loop {
            let some = self.next_unoccluded(frame, &mut rest, &mut indices, &mut translucent);
            let [first, ..] = some else { break };
            let mut pieces = [frame.triangles.triangle(*first); triangle_batch::BATCH_SIZE];
            for (piece, &index) in pieces.iter_mut().zip(some) {
                *piece = frame.triangles.triangle(index);
            }
            let batch = TriangleBatch::new(pieces, rect, frame.samples.offset_range());
            self.batch_starts.clear();
            self.batch_starts
                .extend(frame.samples.sample_offsets().map(|offset| batch.sample_starts(offset)));
            for (lane, &index) in some.iter().enumerate() {
                match pieces[lane].opacity {
                    Opacity::Opaque if batch.is_prepared(lane) => {
                        self.rasterize_small(simd, &batch, lane, index)
                    }
                    Opacity::Opaque => self.rasterize_opaque(simd, frame, rect, index),
                    _ => self.rasterize_masked(simd, frame, rect, index, surface),
                }
            }
        }
        if translucent {
            for &index in bin {
                if frame.triangles.triangle(index).opacity == Opacity::Translucent {
                    self.collect_translucent(simd, frame, rect, index);
                }
            }
        }
    }

    /// The next few pieces of a list that may hide something: translucent ones are only taken note of, and what lies behind
    /// everything in the tile is left out before any work is done on it.
    #[inline(always)]
    fn next_unoccluded<'a>(
        &self,
        frame: &Frame,
        list: &mut core::slice::Iter<'_, u32>,
        indices: &'a mut [u32; triangle_batch::BATCH_SIZE],
        translucent: &mut bool,
    ) -> &'a [u32] {
        let nothing_is_hidden = self.farthest_depth == f32::NEG_INFINITY;
        let mut count = 0;
        for &index in list {
            let piece = frame.triangles.triangle(index);
            if piece.opacity == Opacity::Translucent {
                *translucent = true;
            } else if nothing_is_hidden || piece.nearest_depth() > self.farthest_depth {
                indices[count] = index;
                count += 1;
                if count == triangle_batch::BATCH_SIZE {
                    break;
                }
            }
        }
        &indices[..count]
    }

    /// One of eight small triangles that were prepared at once.
    #[inline(always)]
    fn rasterize_small<S: Simd>(
        &mut self,
        simd: S,
        batch: &TriangleBatch,
        lane: usize,
        index: u32,
    ) {
        let functions = batch.lane_functions(lane);
        if batch.is_outside(lane) || functions.max_depth <= self.farthest_depth {
            return;
        }
        let lanes = TriangleLanes::new(simd, &functions);
        rasterize_triangle(
            simd,
            &mut self.planes,
            &lanes,
            |plane| self.batch_starts[plane].lane_start(lane),
            index,
        );
    }

    #[inline(always)]
    fn rasterize_opaque<S: Simd>(&mut self, simd: S, frame: &Frame, rect: TileRect, index: u32) {
        let piece = frame.triangles.triangle(index);
        if piece.nearest_depth() <= self.farthest_depth {
            return;
        }
        let Some(setup) = TriangleSetup::new(piece, rect, frame.samples.offset_range()) else {
            return;
        };
        let lanes = TriangleLanes::new(simd, &setup.functions);
        let mut hidden = f32::INFINITY;
        rasterize_triangle(
            simd,
            &mut self.planes,
            &lanes,
            |plane| setup.sample_start(frame.samples.sample_offset(plane)),
            index,
        );
        for plane in &self.planes {
            hidden = hidden.min(plane.tile_farthest());
        }
        self.farthest_depth = hidden;
    }

    #[inline(always)]
    fn rasterize_masked<S: Simd>(
        &mut self,
        simd: S,
        frame: &Frame,
        rect: TileRect,
        index: u32,
        surface: &dyn Surface,
    ) {
        let piece = frame.triangles.triangle(index);
        let Some(setup) = TriangleSetup::new(piece, rect, frame.samples.offset_range()) else {
            return;
        };
        let lanes = TriangleLanes::new(simd, &setup.functions);
        // Whether the piece is there is a matter of the pixel, not of its samples: it is asked once, for eight pixels of a block's
        // row together.
        let (mut asked, mut kept) = ([0_u64; TILE as usize], [0_u64; TILE as usize]);
        for (plane, offset) in self.planes.iter_mut().zip(frame.samples.sample_offsets()) {
            plane.visit_visible_samples(
                simd,
                &lanes,
                &setup.sample_start(offset),
                false,
                |plane, at, x, y, depth| {
                    let pixel = 1 << x;
                    if asked[y] & pixel == 0 {
                        let first = x / LANES * LANES;
                        asked[y] |= 0xff << first;
                        let (px, py) = (rect.x + first as u32, rect.y + y as u32);
                        let eight =
                            Fragments::from_one_triangle(piece, &frame.source_weights, px, py);
                        for (lane, keeps) in
                            surface.alpha_test_eight(&eight).into_iter().enumerate()
                        {
                            kept[y] |= u64::from(keeps) << (first + lane);
                        }
                    }
                    if kept[y] & pixel != 0 {
                        plane.write_sample(at, depth, index);
                    }
                },
            );
        }
    }

    /// Notes a layer for each pixel in which a sample of the triangle is not behind something solid.
    #[inline(always)]
    fn collect_translucent<S: Simd>(&mut self, simd: S, frame: &Frame, rect: TileRect, index: u32) {
        let piece = frame.triangles.triangle(index);
        let Some(setup) = TriangleSetup::new(piece, rect, frame.samples.offset_range()) else {
            return;
        };
        let lanes = TriangleLanes::new(simd, &setup.functions);
        let first = self.layers.len();
        let Self { planes, layers, .. } = self;
        let samples = planes.iter_mut().zip(frame.samples.sample_offsets()).enumerate();
        for (sample, (plane, offset)) in samples {
            plane.visit_visible_samples(
                simd,
                &lanes,
                &setup.sample_start(offset),
                true,
                |_, _, x, y, depth| {
                    if rect.is_visible(x, y) {
                        let pixel = (y * TILE as usize + x) as u16;
                        layers.push(TranslucentLayer {
                            pixel,
                            mask: 1 << sample,
                            triangle: index,
                            depth,
                        });
                    }
                },
            );
        }
        merge_layer_samples(layers, first);
    }

    /// Pixel by pixel, the farthest layer first; of layers at the same depth, the one given first.
    fn sort_layers(&mut self) {
        self.layers.sort_unstable_by(|a, b| {
            let by_depth = a.depth.total_cmp(&b.depth);
            a.pixel.cmp(&b.pixel).then(by_depth).then(a.triangle.cmp(&b.triangle))
        });
    }
}

/// Joins the layers of one piece, from `first` on, that are samples of the same pixel. The pixel's depth is that of its
/// first sample.
fn merge_layer_samples(layers: &mut Vec<TranslucentLayer>, first: usize) {
    layers[first..].sort_unstable_by_key(|layer| (layer.pixel, layer.mask));
    let mut kept = first;
    for next in first..layers.len() {
        let layer = layers[next];
        if kept > first && layers[kept - 1].pixel == layer.pixel {
            layers[kept - 1].mask |= layer.mask;
        } else {
            layers[kept] = layer;
            kept += 1;
        }
    }
    layers.truncate(kept);
}
