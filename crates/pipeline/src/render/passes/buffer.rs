//! Pass buffers: the values of one pass for every pixel of a region.
//!
//! Floating-point passes contain f32 values, and integer passes contain u32 values. They are saved
//! losslessly as NumPy arrays or OpenEXR images, or as 16-bit PNG files quantized to the range of
//! the values.

use super::geometry::{SceneGeometry, Visibility, VisibleRow};
use crate::render::image_tiles::TileRegion;
use homog::PixelRect;
use scene_file::{Pass, PassEncoding};
use std::sync::atomic::{AtomicBool, Ordering};

/// The values of a pass: rows from the top, channels interleaved.
#[derive(Clone, PartialEq, Debug)]
pub enum PassValues {
    /// [`Pass::channels`] floating-point values per pixel.
    Floats(Vec<f32>),
    /// One integer per pixel.
    Integers(Vec<u32>),
}

/// A rendered pass of a whole picture or of a region.
#[derive(Clone, PartialEq, Debug)]
pub struct PassBuffer {
    /// The meaning of the values.
    pub pass: Pass,
    /// The width in pixels.
    pub width: u32,
    /// The height in pixels.
    pub height: u32,
    /// The values.
    pub values: PassValues,
}

impl PassBuffer {
    /// Creates a pass in which nothing is visible.
    pub(super) fn new_empty(pass: Pass, region: PixelRect) -> Self {
        let count = region.area() * pass.channels();
        let values = if pass.is_integer() {
            PassValues::Integers(vec![0; count])
        } else {
            PassValues::Floats(vec![pass.empty_value(); count])
        };
        Self { pass, width: region.width, height: region.height, values }
    }

    /// Returns the values of a pixel, or `None` outside the region and for integer passes.
    #[must_use]
    pub fn float_values(&self, x: u32, y: u32) -> Option<&[f32]> {
        let (at, count) = (self.pixel_index(x, y)?, self.pass.channels());
        match &self.values {
            PassValues::Floats(values) => values.get(at * count..(at + 1) * count),
            PassValues::Integers(_) => None,
        }
    }

    /// Returns the integer of a pixel, or `None` outside the region and for floating-point passes.
    #[must_use]
    pub fn integer_value(&self, x: u32, y: u32) -> Option<u32> {
        match &self.values {
            PassValues::Integers(values) => values.get(self.pixel_index(x, y)?).copied(),
            PassValues::Floats(_) => None,
        }
    }

    /// Returns the index of a pixel in row order, or `None` outside the region.
    fn pixel_index(&self, x: u32, y: u32) -> Option<usize> {
        let inside = x < self.width && y < self.height;
        inside.then(|| y as usize * self.width as usize + x as usize)
    }

    /// Encodes the pass as a file.
    #[must_use]
    pub fn encode_file(&self, encoding: PassEncoding) -> Vec<u8> {
        match encoding {
            PassEncoding::Png => self.to_png(),
            PassEncoding::Npy => self.to_npy(),
            PassEncoding::Exr => self.to_exr(),
        }
    }

    /// Computes the values of each pixel from the nearest primitive there. Rows are processed in
    /// parallel.
    ///
    /// Returns whether all pixels have a value. If not, weights of the rasterizer are missing.
    pub(super) fn fill_pixels(
        &mut self,
        geometry: &SceneGeometry<'_>,
        visible: &Visibility,
        part: TileRegion,
        threads: usize,
    ) -> bool {
        let (pass, width) = (self.pass, self.width as usize);
        let [left, top] = part.offset_in_tile();
        let is_incomplete = AtomicBool::new(false);
        match &mut self.values {
            PassValues::Floats(values) => {
                let rows = values.chunks_mut(width * pass.channels()).enumerate();
                raster::for_each_parallel(threads, rows, |(row, values)| {
                    let row = VisibleRow {
                        ids: &visible.ids[row * width..(row + 1) * width],
                        weights: visible.row_weights(row, width),
                        first_pixel: [left, top + row as u32],
                    };
                    if !geometry.write_row(pass, &row, values) {
                        is_incomplete.store(true, Ordering::Relaxed);
                    }
                });
            }
            PassValues::Integers(values) => {
                let rows = values.chunks_mut(width).zip(visible.ids.chunks(width));
                raster::for_each_parallel(threads, rows, |(values, ids)| {
                    geometry.write_ids(pass, ids, values);
                });
            }
        }
        !is_incomplete.into_inner()
    }

    /// Copies the pass of one image tile into the pass of a region.
    pub(super) fn copy_tile(&mut self, patch: &Self, part: TileRegion, region: PixelRect) {
        match (&mut self.values, &patch.values) {
            (PassValues::Integers(all), PassValues::Integers(patch)) => {
                part.copy_into_region(patch, region, all);
            }
            (PassValues::Floats(all), PassValues::Floats(patch)) => match self.pass.channels() {
                3 => part.copy_into_region(
                    patch.as_chunks::<3>().0,
                    region,
                    all.as_chunks_mut::<3>().0,
                ),
                2 => part.copy_into_region(
                    patch.as_chunks::<2>().0,
                    region,
                    all.as_chunks_mut::<2>().0,
                ),
                _ => part.copy_into_region(patch, region, all),
            },
            _ => debug_assert!(false, "all tiles of a pass have the same value type"),
        }
    }
}
