//! The compared rasterizers, behind one interface.

mod euc;
mod llvmpipe;
mod look;
mod raster;
mod render;

pub use self::euc::Euc;
pub use self::llvmpipe::Llvmpipe;
pub use self::raster::Raster;
pub use self::render::Render;

use crate::scene::SIZE;
use ::raster::{F32x8, LANES};

/// A rasterizer with a scene in its buffers.
pub trait Peer {
    /// Returns the name in reports.
    fn name(&self) -> String;

    /// Returns whether its picture can be compared with ours. The comparison requires the same
    /// colors and one sample per pixel.
    fn is_comparable(&self) -> bool;

    /// Draws one frame from the buffers, including the clear but not the readback. This is the
    /// measured work.
    fn draw(&mut self);

    /// Returns the last frame, in rows from the top. Alpha is 0 where nothing was drawn.
    fn pixels(&mut self) -> Vec<[u8; 4]>;
}

/// The number of pixels in the picture.
pub const AREA: usize = (SIZE.0 * SIZE.1) as usize;

/// Converts colors with channels from 0 to 1 to the format that the peers' shaders write: 8 bits
/// per channel, without the sRGB curve.
pub struct Quantized;

impl ::raster::Encode<[u8; 4]> for Quantized {
    #[inline(always)]
    fn encode_pixel(&self, color: [f32; 4]) -> [u8; 4] {
        color.map(|channel| quantized(channel) as u8)
    }

    #[inline(always)]
    fn encode_eight(&self, [r, g, b, alpha]: &[F32x8; 4]) -> [[u8; 4]; LANES] {
        let mut pixels = [0; LANES];
        for lane in 0..LANES {
            pixels[lane] = quantized(r[lane])
                | quantized(g[lane]) << 8
                | quantized(b[lane]) << 16
                | quantized(alpha[lane]) << 24;
        }
        pixels.map(u32::to_le_bytes)
    }
}

/// Converts a channel to 8 bits. From 2²³ up, floats are integers, so the sum is rounded and its
/// last bits are the result.
#[inline(always)]
fn quantized(channel: f32) -> u32 {
    (channel * 255.0 + 8_388_608.0).to_bits() & 255
}
