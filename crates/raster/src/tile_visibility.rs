//! Visibility of one tile: hidden-surface removal for its bin of triangles.
//!
//! ```text
//!   bin ─► drop hidden blocks ─► setup, eight at a time ─► rasterize ─► planes: depth, triangle
//!                                                        └► translucent ─► layers, back to front
//! ```
//!
//! The result is a visibility buffer, which stores the index of the nearest opaque triangle for
//! each sample, but no color. Shading comes later, once per pixel, and skips hidden surfaces.

use crate::fragment_lanes::LANES;
use crate::micro_triangles::MicroTriangles;
use crate::rasterize::{TriangleLanes, rasterize_triangle};
use crate::sample_plane::{BLOCK_SIDE, NO_TRIANGLE, SamplePlane};
use crate::simd_level::dispatch;
use crate::tile_grid::{TILE, TileRect};
use crate::triangle_batch::{self, BatchStarts, TriangleBatch};
use crate::triangle_setup::TriangleSetup;
use crate::{DepthCompare, Fragments, Frame, Opacity, Surface};
use fearless_simd::Simd;

/// A translucent triangle in one pixel.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct TranslucentLayer {
    /// The pixel within the tile, row by row.
    pub(crate) pixel: u16,
    /// The covered samples that are not behind an opaque surface, one bit each.
    pub(crate) mask: u16,
    pub(crate) triangle: u32,
    /// The depth of the first covered sample.
    pub(crate) depth: f32,
}

/// The visible surfaces of a tile: one plane per sample, and translucent layers over the planes.
#[derive(Debug, Default)]
pub(crate) struct TileVisibility {
    planes: Vec<SamplePlane>,
    /// The translucent layers, sorted by pixel and, within a pixel, back to front.
    pub(crate) layers: Vec<TranslucentLayer>,
    /// The farthest bound of all planes: no sample is farther, so anything farther is hidden.
    farthest_depth: f32,
    /// The start values of the current batch, for each plane.
    batch_starts: Vec<BatchStarts>,
    /// The micro-triangles of the current batch.
    micro_triangles: MicroTriangles,
}

impl TileVisibility {
    /// Returns the triangle visible at a sample of the pixel with this
    /// [index](crate::sample_plane::pixel_index), or [`NO_TRIANGLE`] for the background.
    pub(crate) fn triangle(&self, sample: usize, pixel: usize) -> u32 {
        self.planes[sample].triangle[pixel]
    }

    /// Returns the triangles visible at one sample of the eight pixels in a row of a block.
    #[inline(always)]
    pub(crate) fn row_triangles(&self, sample: usize, first: usize) -> [u32; BLOCK_SIDE] {
        let mut row = [NO_TRIANGLE; BLOCK_SIDE];
        row.copy_from_slice(&self.planes[sample].triangle[first..first + BLOCK_SIDE]);
        row
    }

    /// Returns the depth at a sample of a pixel, or −∞ for the background.
    pub(crate) fn sample_depth(&self, sample: usize, pixel: usize) -> f32 {
        self.planes[sample].depth[pixel]
    }

    /// Determines the visible surfaces of the tile `rect` from the triangles in its bin.
    pub(crate) fn rasterize_bin(
        &mut self,
        frame: &Frame,
        rect: TileRect,
        bin: &[u32],
        surface: &dyn Surface,
    ) {
        self.planes.resize_with(frame.samples.count(), SamplePlane::new);
        // Clear the depth and visibility buffers to the background.
        self.planes.iter_mut().for_each(|plane| plane.clear(rect));
        self.farthest_depth = f32::NEG_INFINITY;
        if let Some(initial) = &frame.initial_depth {
            for (sample, plane) in self.planes.iter_mut().enumerate() {
                initial.copy_into_plane(frame.compare, sample, rect, plane);
            }
        }
        self.layers.clear();
        let level = frame.simd_level.level();
        if frame.compare.is_strict() {
            dispatch!(level, simd => self.rasterize_batches(simd, frame, rect, bin, surface));
        } else {
            dispatch!(level, simd => self.rasterize_in_order(simd, frame, rect, bin, surface));
        }
        self.sort_layers();
    }

    /// Rasterizes the opaque and masked triangles of a bin in batches of eight, then the
    /// translucent ones.
    ///
    /// Translucent triangles come last, when samples behind opaque surfaces are known and can be
    /// skipped.
    #[inline(always)]
    fn rasterize_batches<S: Simd>(
        &mut self,
        simd: S,
        frame: &Frame,
        rect: TileRect,
        bin: &[u32],
        surface: &dyn Surface,
    ) {
        let mut has_translucent = false;
        let mut rest = bin.iter();
        let mut indices = [0; triangle_batch::BATCH_SIZE];
        loop {
            let some = self.next_unoccluded(frame, &mut rest, &mut indices, &mut has_translucent);
            let [first, ..] = some else { break };
            // Lanes without a triangle repeat the first triangle.
            let mut triangles = [frame.triangles.triangle(*first); triangle_batch::BATCH_SIZE];
            for (triangle, &index) in triangles.iter_mut().zip(some) {
                *triangle = frame.triangles.triangle(index);
            }
            // Triangle setup, once for all sample planes, then the start values of each plane.
            let batch = TriangleBatch::new(triangles, rect, frame.samples.offset_range());
            self.batch_starts.clear();
            let starts = frame.samples.sample_offsets().map(|offset| batch.sample_starts(offset));
            self.batch_starts.extend(starts);
            self.micro_triangles.prepare(simd, &batch, &self.batch_starts);
            // Rasterize in submission order, which breaks ties in depth.
            for (lane, &index) in some.iter().enumerate() {
                match triangles[lane].opacity {
                    Opacity::Opaque if batch.is_prepared(lane) => {
                        self.rasterize_small(simd, &batch, lane, index);
                    }
                    Opacity::Opaque => self.rasterize_opaque(simd, frame, rect, index),
                    _ => self.rasterize_masked(simd, frame, rect, index, surface),
                }
            }
        }
        // Second pass over the bin, only if it has translucent triangles.
        if has_translucent {
            for &index in bin {
                if frame.triangles.triangle(index).opacity == Opacity::Translucent {
                    self.collect_translucent(simd, frame, rect, index);
                }
            }
        }
    }

    /// Rasterizes the triangles of a bin one by one, translucent triangles last. Used for depth
    /// functions that rule out hierarchical z.
    #[inline(always)]
    fn rasterize_in_order<S: Simd>(
        &mut self,
        simd: S,
        frame: &Frame,
        rect: TileRect,
        bin: &[u32],
        surface: &dyn Surface,
    ) {
        let is_translucent =
            |index: &u32| frame.triangles.triangle(*index).opacity == Opacity::Translucent;
        let opaque = bin.iter().filter(|index| !is_translucent(index));
        let mut samples = Vec::new();
        for &index in opaque.chain(bin.iter().filter(|index| is_translucent(index))) {
            let triangle = frame.triangles.triangle(index);
            let range = frame.samples.offset_range();
            let Some(setup) = TriangleSetup::new(triangle, rect, range) else { continue };
            let lanes = TriangleLanes::new(simd, &setup.functions);
            let mut masked = MaskedPixels::default();
            let first = self.layers.len();
            for (plane, offset) in frame.samples.sample_offsets().enumerate() {
                let (start, compare) = (setup.sample_start(offset), frame.compare);
                samples.clear();
                let sample_plane = &mut self.planes[plane];
                sample_plane.visit_visible_samples(
                    simd,
                    &lanes,
                    &start,
                    compare,
                    |_, at, x, y, depth| samples.push((at, [x, y], depth)),
                );
                for &(at, [x, y], depth) in &samples {
                    if triangle.opacity == Opacity::Translucent {
                        self.layers.extend(translucent_layer(rect, [x, y], plane, index, depth));
                    } else if triangle.opacity == Opacity::Opaque
                        || masked.passes(frame, rect, index, [x, y], surface)
                    {
                        self.planes[plane].write_sample(at, depth, index);
                    }
                }
            }
            merge_layer_samples(&mut self.layers, first);
        }
    }

    /// Returns the next few possibly visible triangles of a list.
    ///
    /// This is occlusion culling by the tile's depth bound: triangles behind everything in the tile
    /// are skipped before any setup. Translucent triangles are also skipped, and `has_translucent`
    /// is set.
    #[inline(always)]
    fn next_unoccluded<'a>(
        &self,
        frame: &Frame,
        list: &mut core::slice::Iter<'_, u32>,
        indices: &'a mut [u32; triangle_batch::BATCH_SIZE],
        has_translucent: &mut bool,
    ) -> &'a [u32] {
        let nothing_is_hidden = self.farthest_depth == f32::NEG_INFINITY;
        let mut count = 0;
        for &index in list {
            let triangle = frame.triangles.triangle(index);
            if triangle.opacity == Opacity::Translucent {
                *has_translucent = true;
            } else if nothing_is_hidden || triangle.nearest_depth() > self.farthest_depth {
                indices[count] = index;
                count += 1;
                if count == triangle_batch::BATCH_SIZE {
                    break;
                }
            }
        }
        &indices[..count]
    }

    /// Rasterizes one opaque triangle of a batch.
    #[inline(always)]
    fn rasterize_small<S: Simd>(
        &mut self,
        simd: S,
        batch: &TriangleBatch,
        lane: usize,
        index: u32,
    ) {
        if batch.is_outside(lane) || batch.max_depth[lane] <= self.farthest_depth {
            return;
        }
        if self.micro_triangles.contain(lane) {
            let range = [batch.min_depth[lane], batch.max_depth[lane]];
            return self.micro_triangles.rasterize(&mut self.planes, lane, range, index);
        }
        let functions = batch.lane_functions(lane);
        // The tile's depth bound stays unchanged: only triangles too large for a batch update it.
        let lanes = TriangleLanes::new(simd, &functions);
        let start = |plane: usize| self.batch_starts[plane].lane_start(lane);
        rasterize_triangle(simd, &mut self.planes, &lanes, start, index);
    }

    /// Rasterizes an opaque triangle that is too large for a batch, and updates the tile's depth
    /// bound.
    #[inline(always)]
    fn rasterize_opaque<S: Simd>(&mut self, simd: S, frame: &Frame, rect: TileRect, index: u32) {
        let triangle = frame.triangles.triangle(index);
        if triangle.nearest_depth() <= self.farthest_depth {
            return;
        }
        let range = frame.samples.offset_range();
        let Some(setup) = TriangleSetup::new(triangle, rect, range) else { return };
        let lanes = TriangleLanes::new(simd, &setup.functions);
        let mut farthest = f32::INFINITY;
        let start = |plane: usize| setup.sample_start(frame.samples.sample_offset(plane));
        rasterize_triangle(simd, &mut self.planes, &lanes, start, index);
        // Hierarchical z of the tile: the farthest sample of all planes.
        for plane in &self.planes {
            farthest = farthest.min(plane.tile_farthest());
        }
        self.farthest_depth = farthest;
    }

    /// Rasterizes an alpha-tested triangle: depth test, alpha test, then depth write.
    #[inline(always)]
    fn rasterize_masked<S: Simd>(
        &mut self,
        simd: S,
        frame: &Frame,
        rect: TileRect,
        index: u32,
        surface: &dyn Surface,
    ) {
        let triangle = frame.triangles.triangle(index);
        let range = frame.samples.offset_range();
        let Some(setup) = TriangleSetup::new(triangle, rect, range) else { return };
        let lanes = TriangleLanes::new(simd, &setup.functions);
        let mut masked = MaskedPixels::default();
        for (plane, offset) in self.planes.iter_mut().zip(frame.samples.sample_offsets()) {
            let start = setup.sample_start(offset);
            let compare = DepthCompare::Greater;
            plane.visit_visible_samples(simd, &lanes, &start, compare, |plane, at, x, y, depth| {
                if masked.passes(frame, rect, index, [x, y], surface) {
                    plane.write_sample(at, depth, index);
                }
            });
        }
    }

    /// Adds a layer for each pixel in which a sample of a translucent triangle is not behind an
    /// opaque surface.
    #[inline(always)]
    fn collect_translucent<S: Simd>(&mut self, simd: S, frame: &Frame, rect: TileRect, index: u32) {
        let triangle = frame.triangles.triangle(index);
        let range = frame.samples.offset_range();
        let Some(setup) = TriangleSetup::new(triangle, rect, range) else { return };
        let lanes = TriangleLanes::new(simd, &setup.functions);
        let first = self.layers.len();
        // At equal depth, a decal is drawn over the surface below it.
        let compare = DepthCompare::GreaterEqual;
        let Self { planes, layers, .. } = self;
        let samples = planes.iter_mut().zip(frame.samples.sample_offsets()).enumerate();
        for (sample, (plane, offset)) in samples {
            let start = setup.sample_start(offset);
            plane.visit_visible_samples(simd, &lanes, &start, compare, |_, _, x, y, depth| {
                layers.extend(translucent_layer(rect, [x, y], sample, index, depth));
            });
        }
        merge_layer_samples(layers, first);
    }

    /// Sorts layers by pixel, and within a pixel back to front.
    ///
    /// Of two translucent layers at equal depth, the one submitted later is drawn over the other.
    /// (Among opaque triangles, the one submitted first wins; see `rasterize.rs`.)
    fn sort_layers(&mut self) {
        // Pixel, depth, triangle: a total order, so an unstable sort gives one result.
        self.layers.sort_unstable_by(|a, b| {
            let by_depth = a.depth.total_cmp(&b.depth);
            a.pixel.cmp(&b.pixel).then(by_depth).then(a.triangle.cmp(&b.triangle))
        });
    }
}

/// The pixels of a tile in which the alpha test of one triangle has run.
///
/// Alpha is per pixel, not per sample, so it is tested once, for all eight pixels in a row of a
/// block together. Each pixel has one bit for whether it was tested and one for whether it passed.
struct MaskedPixels {
    tested: [u64; TILE as usize],
    passed: [u64; TILE as usize],
}

impl Default for MaskedPixels {
    fn default() -> Self {
        Self { tested: [0; TILE as usize], passed: [0; TILE as usize] }
    }
}

impl MaskedPixels {
    /// Returns whether a triangle passes the alpha test in a pixel of the tile. The test runs once,
    /// when a sample of the pixel's row of eight first passes the depth test.
    #[inline(always)]
    fn passes(
        &mut self,
        frame: &Frame,
        rect: TileRect,
        index: u32,
        [x, y]: [usize; 2],
        surface: &dyn Surface,
    ) -> bool {
        let pixel = 1 << x;
        if self.tested[y] & pixel == 0 {
            let first = x / LANES * LANES;
            self.tested[y] |= 0xff << first;
            let (px, py) = (rect.x + first as u32, rect.y + y as u32);
            let triangle = frame.triangles.triangle(index);
            let eight = Fragments::from_one_triangle(triangle, &frame.source_weights, px, py);
            for (lane, passes) in surface.alpha_test_eight(&eight).into_iter().enumerate() {
                self.passed[y] |= u64::from(passes) << (first + lane);
            }
        }
        self.passed[y] & pixel != 0
    }
}

/// Returns the layer of one sample of a translucent triangle, or `None` outside the visible region.
#[inline(always)]
fn translucent_layer(
    rect: TileRect,
    [x, y]: [usize; 2],
    sample: usize,
    triangle: u32,
    depth: f32,
) -> Option<TranslucentLayer> {
    let pixel = (y * TILE as usize + x) as u16;
    let layer = TranslucentLayer { pixel, mask: 1 << sample, triangle, depth };
    rect.is_visible(x, y).then_some(layer)
}

/// Merges the layers of one triangle, which start at index `first`, to one layer per pixel with the
/// depth of its first sample.
fn merge_layer_samples(layers: &mut Vec<TranslucentLayer>, first: usize) {
    // Make the samples of each pixel adjacent, starting with the first sample.
    layers[first..].sort_unstable_by_key(|layer| (layer.pixel, layer.mask));
    let mut merged = first;
    for next in first..layers.len() {
        let layer = layers[next];
        if merged > first && layers[merged - 1].pixel == layer.pixel {
            layers[merged - 1].mask |= layer.mask;
        } else {
            layers[merged] = layer;
            merged += 1;
        }
    }
    layers.truncate(merged);
}
