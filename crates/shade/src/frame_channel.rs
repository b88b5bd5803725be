//! Draws rasterizer frames into 8-bit or 16-bit pixels.

use crate::color::{Srgb16Encoder, SrgbEncoder};
use picture::Channel;
use raster::{Frame, Surface};

/// A pixel channel type: `u8` or `u16`.
pub trait FrameChannel: Channel {
    /// Draws a frame over `background` (linear, premultiplied by alpha) into pixels.
    ///
    /// This is like [`Frame::draw`], but compiled here once for each bit depth, so that callers
    /// that are generic over channels and surfaces do not each contain a copy.
    fn draw_frame(
        frame: &Frame,
        surface: &dyn Surface,
        background: [f32; 4],
        threads: usize,
        pixels: &mut [[Self; 4]],
    );
}

impl FrameChannel for u8 {
    fn draw_frame(
        frame: &Frame,
        surface: &dyn Surface,
        background: [f32; 4],
        threads: usize,
        pixels: &mut [[Self; 4]],
    ) {
        frame.draw(&surface, background, threads, pixels, SrgbEncoder::shared());
    }
}

impl FrameChannel for u16 {
    fn draw_frame(
        frame: &Frame,
        surface: &dyn Surface,
        background: [f32; 4],
        threads: usize,
        pixels: &mut [[Self; 4]],
    ) {
        frame.draw(&surface, background, threads, pixels, Srgb16Encoder::shared());
    }
}
