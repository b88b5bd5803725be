//! Drawing a frame with the surfaces of this crate.

use crate::{Shading, StyledShading};
use raster::{Encode, Frame};

/// The shading of a frame: by materials, or in a style that overrides them.
///
/// [`Channel::draw_frame`](crate::Channel::draw_frame) draws with it.
#[derive(Clone, Copy, Debug)]
pub enum FrameShading<'a> {
    /// Physically based shading of the materials.
    Materials(&'a Shading<'a>),
    /// A style: clay, toon, normals …
    Style(&'a StyledShading<'a>),
}

impl FrameShading<'_> {
    /// As [`Frame::draw`], with whichever surface it is.
    pub(crate) fn draw<P: Copy + Send>(
        self,
        frame: &Frame,
        background: [f32; 4],
        threads: usize,
        target: &mut [P],
        encode: impl Encode<P>,
    ) {
        match self {
            Self::Materials(surface) => frame.draw(surface, background, threads, target, encode),
            Self::Style(surface) => frame.draw(surface, background, threads, target, encode),
        }
    }
}
