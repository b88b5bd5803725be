//! Viewports: from the canonical volume to pixels, and back.
#![no_std]

#[cfg(test)]
extern crate std;

mod convention;
mod depth;
mod error;
mod fit;
mod grid;
mod page;
mod paper;
mod pick;
mod rectangle;
mod tile;
mod view;
mod window;

pub use convention::{PixelCentres, PixelConvention, YAxis};
pub use depth::DepthRange;
pub use error::ViewportError;
pub use fit::Fit;
pub use grid::Grid;
pub use paper::{DrawingScale, MILLIMETRES_PER_INCH, Paper, Resolution};
pub use pick::{Ray, Unprojector};
pub use rectangle::Rectangle;
pub use tile::{Tile, tiles};
pub use view::Viewport;
pub use window::{Limits, WindowToViewport};
