//! The numbers of a pass.

use super::geometry::{Geometry, Hit};
use super::kind::{Pass, PassEncoding};
use crate::render::region::PartOfSheet;
use homog::PixelRect;

/// The numbers of a pass, rows from the top, those of a pixel side by side.
#[derive(Clone, PartialEq, Debug)]
pub enum Values {
    /// Measures: [`Pass::channels`] for each pixel.
    Floats(Vec<f32>),
    /// Whole numbers, one for each pixel.
    Numbers(Vec<u32>),
}

/// A pass of a picture or of a region of it.
#[derive(Clone, PartialEq, Debug)]
pub struct PassBuffer {
    /// What the numbers tell.
    pub pass: Pass,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// The numbers.
    pub values: Values,
}

impl PassBuffer {
    /// A pass that shows nothing.
    pub(super) fn empty(pass: Pass, region: PixelRect) -> Self {
        let count = region.area() * pass.channels();
        let values = if pass.is_whole() {
            Values::Numbers(vec![0; count])
        } else {
            Values::Floats(vec![pass.nothing(); count])
        };
        Self { pass, width: region.width, height: region.height, values }
    }

    /// The measures of a pixel; `None` outside and for passes of whole numbers.
    #[must_use]
    pub fn floats(&self, x: u32, y: u32) -> Option<&[f32]> {
        let (at, count) = (self.place(x, y)?, self.pass.channels());
        match &self.values {
            Values::Floats(values) => values.get(at * count..(at + 1) * count),
            Values::Numbers(_) => None,
        }
    }

    /// The whole number of a pixel; `None` outside and for passes of measures.
    #[must_use]
    pub fn number(&self, x: u32, y: u32) -> Option<u32> {
        match &self.values {
            Values::Numbers(values) => values.get(self.place(x, y)?).copied(),
            Values::Floats(_) => None,
        }
    }

    fn place(&self, x: u32, y: u32) -> Option<usize> {
        let inside = x < self.width && y < self.height;
        inside.then(|| y as usize * self.width as usize + x as usize)
    }

    /// The pass as a file.
    #[must_use]
    pub fn to_bytes(&self, encoding: PassEncoding) -> Vec<u8> {
        match encoding {
            PassEncoding::Png => self.to_png(),
            PassEncoding::Npy => self.to_npy(),
        }
    }

    /// Asks the geometry for the numbers of each pixel.
    pub(super) fn fill(
        &mut self,
        geometry: &Geometry<'_>,
        hits: &[Hit],
        part: PartOfSheet,
        threads: usize,
    ) {
        let (pass, width) = (self.pass, self.width as usize);
        let [left, top] = part.corner();
        let place = |row: usize, column: usize| [left + column as u32, top + row as u32];
        match &mut self.values {
            Values::Floats(values) => {
                let count = pass.channels();
                let rows = values.chunks_mut(width * count).zip(hits.chunks(width)).enumerate();
                raster::share(threads, rows, |(row, (values, hits))| {
                    let pixels = values.chunks_exact_mut(count).zip(hits).enumerate();
                    for (column, (values, hit)) in pixels {
                        geometry.measure(pass, hit, place(row, column), values);
                    }
                });
            }
            Values::Numbers(values) => {
                let rows = values.chunks_mut(width).zip(hits.chunks(width));
                raster::share(threads, rows, |(values, hits)| {
                    for (value, hit) in values.iter_mut().zip(hits) {
                        *value = geometry.number(pass, hit);
                    }
                });
            }
        }
    }

    /// Copies a part to its place in the pass of a region.
    pub(super) fn put(&mut self, patch: &Self, part: PartOfSheet, region: PixelRect) {
        match (&mut self.values, &patch.values) {
            (Values::Numbers(all), Values::Numbers(patch)) => part.put(patch, region, all),
            (Values::Floats(all), Values::Floats(patch)) => match self.pass.channels() {
                3 => part.put(patch.as_chunks::<3>().0, region, all.as_chunks_mut::<3>().0),
                2 => part.put(patch.as_chunks::<2>().0, region, all.as_chunks_mut::<2>().0),
                _ => part.put(patch, region, all),
            },
            _ => debug_assert!(false, "the numbers of a pass are of one kind"),
        }
    }
}
