//! Viewports: from the canonical volume to pixels, and back.
#![no_std]

#[cfg(test)]
extern crate std;

mod convention;
mod depth;
mod error;
mod rectangle;
mod view;

pub use convention::{PixelCentres, PixelConvention, YAxis};
pub use depth::DepthRange;
pub use error::ViewportError;
pub use rectangle::Rectangle;
pub use view::Viewport;
