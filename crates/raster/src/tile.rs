//! Visibility in one tile: for each sample, how near the nearest solid surface is and which it is.

use crate::coverage::{Filler, TileRect};
use crate::fragment::Weigher;
use crate::{Cover, Frame, Surface};

/// No piece: the background.
pub(crate) const NOTHING: u32 = u32::MAX;

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

/// Depth and piece numbers of a tile, sample plane by sample plane, and the translucent layers over them.
#[derive(Debug, Default)]
pub(crate) struct Tile {
    pub(crate) depth: Vec<f32>,
    pub(crate) piece: Vec<u32>,
    pub(crate) layers: Vec<Layer>,
}

impl Tile {
    /// Finds what is visible in `rect` of the pieces `bin`.
    pub(crate) fn fill(
        &mut self,
        frame: &Frame,
        rect: TileRect,
        bin: &[u32],
        surface: &impl Surface,
    ) {
        let size = rect.width() * rect.height() * frame.samples.count();
        self.depth.clear();
        self.depth.resize(size, f32::NEG_INFINITY);
        self.piece.clear();
        self.piece.resize(size, NOTHING);
        self.layers.clear();
        for &index in bin {
            match frame.pieces[index as usize].cover {
                Cover::Solid => self.solid(frame, rect, index),
                Cover::Masked => self.masked(frame, rect, index, surface),
                Cover::Translucent => {}
            }
        }
        for &index in bin {
            if frame.pieces[index as usize].cover == Cover::Translucent {
                self.translucent(frame, rect, index);
            }
        }
        self.sort_layers();
    }

    fn solid(&mut self, frame: &Frame, rect: TileRect, index: u32) {
        let filler = Filler::new(&frame.pieces[index as usize]);
        self.nearer_samples(frame, rect, &filler, |tile, at, _, _, depth| {
            tile.depth[at] = depth;
            tile.piece[at] = index;
        });
    }

    fn masked(&mut self, frame: &Frame, rect: TileRect, index: u32, surface: &impl Surface) {
        let piece = &frame.pieces[index as usize];
        let (filler, weigher) = (Filler::new(piece), Weigher::new(piece, &frame.source_weights));
        self.nearer_samples(frame, rect, &filler, |tile, at, x, y, depth| {
            let fragment = weigher.fragment(rect.x0 + x as u32, rect.y0 + y as u32);
            if surface.keeps(&fragment) {
                tile.depth[at] = depth;
                tile.piece[at] = index;
            }
        });
    }

    /// Calls `take(tile, sample, x, y, depth)` for each sample the triangle covers and is nearer at than what is there.
    fn nearer_samples(
        &mut self,
        frame: &Frame,
        rect: TileRect,
        filler: &Filler,
        take: impl Fn(&mut Self, usize, usize, usize, f32),
    ) {
        let plane = rect.width() * rect.height();
        for (sample, offset) in frame.samples.offsets().enumerate() {
            filler.runs(rect, offset, |y, columns, first_depth, step| {
                let row = sample * plane + y * rect.width();
                for (n, x) in columns.enumerate() {
                    let depth = (first_depth + step * n as f64) as f32;
                    if depth > self.depth[row + x] {
                        take(self, row + x, x, y, depth);
                    }
                }
            });
        }
    }

    /// Notes a layer for each pixel in which a sample of the triangle is not behind something solid.
    fn translucent(&mut self, frame: &Frame, rect: TileRect, index: u32) {
        let filler = Filler::new(&frame.pieces[index as usize]);
        let plane = rect.width() * rect.height();
        let first = self.layers.len();
        for (sample, offset) in frame.samples.offsets().enumerate() {
            filler.runs(rect, offset, |y, columns, first_depth, step| {
                for (n, x) in columns.enumerate() {
                    let depth = (first_depth + step * n as f64) as f32;
                    let pixel = y * rect.width() + x;
                    if depth >= self.depth[sample * plane + pixel] {
                        let (pixel, mask) = (pixel as u16, 1 << sample);
                        self.layers.push(Layer { pixel, mask, piece: index, depth });
                    }
                }
            });
        }
        merge_samples(&mut self.layers, first);
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
    layers[first..].sort_by_key(|layer| layer.pixel);
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
