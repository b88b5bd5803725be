//! Visibility in one tile: for each sample, how near the nearest solid surface is and which it is.

use crate::batch::{self, Batch, Starts};
use crate::fill::{Lanes, fill};
use crate::fragments::WIDE;
use crate::grid::{TILE, TileRect};
use crate::plane::{LANES, NOTHING, Plane};
use crate::setup::Setup;
use crate::{Cover, Fragments, Frame, Surface};
use fearless_simd::{Simd, dispatch};

/// One pixel's share of a translucent piece.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Layer {
    /// The pixel within the tile, row by row.
    pub(crate) pixel: u16,
    /// The samples covered, bit by bit.
    pub(crate) mask: u16,
    pub(crate) piece: u32,
    pub(crate) depth: f32,
}

/// What is visible in a tile: a plane for each sample, and the translucent layers over them.
#[derive(Debug, Default)]
pub(crate) struct Tile {
    planes: Vec<Plane>,
    pub(crate) layers: Vec<Layer>,
    /// A depth that no sample of any plane is farther than: what lies behind it is hidden.
    hidden: f32,
    /// Where the functions of eight triangles start, for each plane.
    starts: Vec<Starts>,
}

impl Tile {
    /// The piece seen by a sample of a pixel ([`index_of`](crate::plane::index_of) says where it is); [`NOTHING`](crate::plane::NOTHING) for the background.
    pub(crate) fn piece(&self, sample: usize, at: usize) -> u32 {
        self.planes[sample].piece[at]
    }

    /// The pieces that one sample of each of eight neighbouring pixels sees, from the one at `at`, which begins a row of a block.
    #[inline(always)]
    pub(crate) fn pieces(&self, sample: usize, at: usize) -> [u32; LANES] {
        let mut row = [NOTHING; LANES];
        row.copy_from_slice(&self.planes[sample].piece[at..at + LANES]);
        row
    }

    /// The depth of the nearest piece at a sample of a pixel, −∞ for the background.
    pub(crate) fn depth(&self, sample: usize, at: usize) -> f32 {
        self.planes[sample].depth[at]
    }

    /// Finds what is visible in `rect` of the pieces `bin`.
    pub(crate) fn fill(
        &mut self,
        frame: &Frame,
        rect: TileRect,
        bin: &[u32],
        surface: &dyn Surface,
    ) {
        self.planes.resize_with(frame.samples.count(), Plane::new);
        self.planes.iter_mut().for_each(|plane| plane.clear(rect));
        self.hidden = f32::NEG_INFINITY;
        self.layers.clear();
        dispatch!(frame.instructions.level(), simd => self.fill_pieces(simd, frame, rect, bin, surface));
        self.sort_layers();
    }

    #[inline(always)]
    fn fill_pieces<S: Simd>(
        &mut self,
        simd: S,
        frame: &Frame,
        rect: TileRect,
        bin: &[u32],
        surface: &dyn Surface,
    ) {
        let mut translucent = false;
        let mut rest = bin.iter();
        let mut indices = [0; batch::COUNT];
        loop {
            let some = self.next_seen(frame, &mut rest, &mut indices, &mut translucent);
            let [first, ..] = some else { break };
            let mut pieces = [frame.pieces.at(*first); batch::COUNT];
            for (piece, &index) in pieces.iter_mut().zip(some) {
                *piece = frame.pieces.at(index);
            }
            let batch = Batch::new(pieces, rect, frame.samples.reach());
            self.starts.clear();
            self.starts.extend(frame.samples.offsets().map(|offset| batch.starts(offset)));
            for (lane, &index) in some.iter().enumerate() {
                match pieces[lane].cover {
                    Cover::Solid if batch.has(lane) => self.small(simd, &batch, lane, index),
                    Cover::Solid => self.solid(simd, frame, rect, index),
                    _ => self.masked(simd, frame, rect, index, surface),
                }
            }
        }
        if translucent {
            for &index in bin {
                if frame.pieces.at(index).cover == Cover::Translucent {
                    self.translucent(simd, frame, rect, index);
                }
            }
        }
    }

    /// The next few pieces of a list that may hide something: translucent ones are only taken note of, and what lies behind
    /// everything in the tile is left out before any work is done on it.
    #[inline(always)]
    fn next_seen<'a>(
        &self,
        frame: &Frame,
        list: &mut core::slice::Iter<'_, u32>,
        indices: &'a mut [u32; batch::COUNT],
        translucent: &mut bool,
    ) -> &'a [u32] {
        let nothing_is_hidden = self.hidden == f32::NEG_INFINITY;
        let mut count = 0;
        for &index in list {
            let piece = frame.pieces.at(index);
            if piece.cover == Cover::Translucent {
                *translucent = true;
            } else if nothing_is_hidden || piece.nearest() > self.hidden {
                indices[count] = index;
                count += 1;
                if count == batch::COUNT {
                    break;
                }
            }
        }
        &indices[..count]
    }

    /// One of eight small triangles that were prepared at once.
    #[inline(always)]
    fn small<S: Simd>(&mut self, simd: S, batch: &Batch, lane: usize, index: u32) {
        let functions = batch.functions(lane);
        if batch.is_outside(lane) || functions.greatest <= self.hidden {
            return;
        }
        let lanes = Lanes::new(simd, &functions);
        fill(simd, &mut self.planes, &lanes, |plane| self.starts[plane].of(lane), index);
    }

    #[inline(always)]
    fn solid<S: Simd>(&mut self, simd: S, frame: &Frame, rect: TileRect, index: u32) {
        let piece = frame.pieces.at(index);
        if piece.nearest() <= self.hidden {
            return;
        }
        let Some(setup) = Setup::new(piece, rect, frame.samples.reach()) else { return };
        let lanes = Lanes::new(simd, &setup.functions);
        let mut hidden = f32::INFINITY;
        fill(
            simd,
            &mut self.planes,
            &lanes,
            |plane| setup.start(frame.samples.offset(plane)),
            index,
        );
        for plane in &self.planes {
            hidden = hidden.min(plane.farthest_of_all());
        }
        self.hidden = hidden;
    }

    #[inline(always)]
    fn masked<S: Simd>(
        &mut self,
        simd: S,
        frame: &Frame,
        rect: TileRect,
        index: u32,
        surface: &dyn Surface,
    ) {
        let piece = frame.pieces.at(index);
        let Some(setup) = Setup::new(piece, rect, frame.samples.reach()) else { return };
        let lanes = Lanes::new(simd, &setup.functions);
        // Whether the piece is there is a matter of the pixel, not of its samples: it is asked once, for eight pixels of a block's
        // row together.
        let (mut asked, mut kept) = ([0_u64; TILE as usize], [0_u64; TILE as usize]);
        for (plane, offset) in self.planes.iter_mut().zip(frame.samples.offsets()) {
            plane.visit(simd, &lanes, &setup.start(offset), false, |plane, at, x, y, depth| {
                let pixel = 1 << x;
                if asked[y] & pixel == 0 {
                    let first = x / WIDE * WIDE;
                    asked[y] |= 0xff << first;
                    let (px, py) = (rect.x + first as u32, rect.y + y as u32);
                    let eight = Fragments::of_one(piece, &frame.source_weights, px, py);
                    for (lane, keeps) in surface.keeps_eight(&eight).into_iter().enumerate() {
                        kept[y] |= u64::from(keeps) << (first + lane);
                    }
                }
                if kept[y] & pixel != 0 {
                    plane.put(at, depth, index);
                }
            });
        }
    }

    /// Notes a layer for each pixel in which a sample of the triangle is not behind something solid.
    #[inline(always)]
    fn translucent<S: Simd>(&mut self, simd: S, frame: &Frame, rect: TileRect, index: u32) {
        let piece = frame.pieces.at(index);
        let Some(setup) = Setup::new(piece, rect, frame.samples.reach()) else { return };
        let lanes = Lanes::new(simd, &setup.functions);
        let first = self.layers.len();
        let Self { planes, layers, .. } = self;
        let samples = planes.iter_mut().zip(frame.samples.offsets()).enumerate();
        for (sample, (plane, offset)) in samples {
            plane.visit(simd, &lanes, &setup.start(offset), true, |_, _, x, y, depth| {
                if rect.shows(x, y) {
                    let pixel = (y * TILE as usize + x) as u16;
                    layers.push(Layer { pixel, mask: 1 << sample, piece: index, depth });
                }
            });
        }
        merge_samples(layers, first);
    }

    /// Pixel by pixel, the farthest layer first; of layers at the same depth, the one given first.
    fn sort_layers(&mut self) {
        self.layers.sort_unstable_by(|a, b| {
            let by_depth = a.depth.total_cmp(&b.depth);
            a.pixel.cmp(&b.pixel).then(by_depth).then(a.piece.cmp(&b.piece))
        });
    }
}

/// Joins the layers of one piece, from `first` on, that are samples of the same pixel. The pixel's depth is that of its
/// first sample.
fn merge_samples(layers: &mut Vec<Layer>, first: usize) {
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
