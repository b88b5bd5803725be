//! The rasterisers that are compared, behind one interface.

mod euc;
mod llvmpipe;
mod raster;
mod render;

pub use self::euc::Euc;
pub use self::llvmpipe::Llvmpipe;
pub use self::raster::Raster;
pub use self::render::Render;

use crate::scene::SIZE;

/// A rasteriser with a scene in its buffers.
pub trait Peer {
    /// The name in reports.
    fn name(&self) -> String;

    /// Whether its picture is to be compared with ours: same colours, one sample for each pixel.
    fn is_comparable(&self) -> bool;

    /// Draws one frame from the buffers, clearing included, reading back excluded. This is what is measured.
    fn draw(&mut self);

    /// The frame drawn last, rows from the top; alpha is 0 where nothing was drawn.
    fn pixels(&mut self) -> Vec<[u8; 4]>;
}

/// Pixels of the picture.
pub const AREA: usize = (SIZE.0 * SIZE.1) as usize;

/// A colour, each channel from 0 to 1, as the peers' shaders write it: 8 bits for each channel, no sRGB curve.
#[inline(always)]
fn quantized(color: [f32; 4]) -> [u8; 4] {
    // At 2²³ floats are whole numbers: the sum rounds, and its last bits are the result.
    color.map(|channel| (channel * 255.0 + 8_388_608.0).to_bits() as u8)
}
