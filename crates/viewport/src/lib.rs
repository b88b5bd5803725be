//! Viewports: from the canonical volume to pixels in an image or millimeters on paper, and back.
//!
//! ```text
//!    canonical square                          image: 6 by 4 pixels, y down, centers at halves
//!
//!  (−1, 1) ┌────────────┐ (1, 1)               0   1   2   3   4   5   6 ► x
//!          │            │                    0 ┌───┬───┬───┬───┬───┬───┐
//!          │      ●     │     ndc_to_screen    │ · │ · │ · │ · │ · │ · │
//!          │   (0, 0)   │    ─────────────►  1 ├───┼───┼───┼───┼───┼───┤
//!          │            │                      │ · │ · │ · │ · │ · │ · │
//! (−1, −1) └────────────┘ (1, −1)            2 ├───┼───┼───●───┼───┼───┤
//!                                              │ · │ · │ · │ · │ · │ · │
//!     depth: near +1 … far −1      near 1    3 ├───┼───┼───┼───┼───┼───┤
//!                                  far  0      │ · │ · │ · │ · │ · │ · │
//!                                         y ▼  └───┴───┴───┴───┴───┴───┘
//! ```
//!
//! This crate makes explicit what often remains implicit: whether y points up or down and where
//! pixel centers are ([`PixelConvention`](homog::PixelConvention)), the extent of clip space
//! ([`ClipRange`](homog::ClipRange)), and the depth range ([`DepthRange`]). [`Viewport::image_for`]
//! follows the convention of image files, and [`Viewport::chapter`] follows the textbook (Shirley
//! and Marschner, ch. 8). Use [`Viewport::new`] for any other combination.
//!
//! | task | item |
//! | --- | --- |
//! | the map M_vp (VP-1 to VP-3) | [`Viewport::ndc_to_screen`] |
//! | its inverse (WV-3) | [`Viewport::screen_to_ndc`] |
//! | another pixel convention (VP-4) | `homog::PixelConvention::convert_to` |
//! | map a window to a viewport in the plane, in two ways | [`WindowToViewport`] (WV-1, WV-2) |
//! | fit a picture into a rectangle with a different aspect ratio | [`FitPolicy`] |
//! | several viewports on a page | [`Rectangle::split_grid`], [`Rectangle::inset_rectangle`] |
//! | millimeters, dots per inch, scale 1:n | [`Paper`], [`Resolution`], [`DrawingScale`] |
//! | large images in tiles | [`tiles`], [`Viewport::for_tile`] |
//! | picking (UN-1, UN-2) | [`Viewport::unprojector`], [`Unprojector::pick_ray`] |
//! | enlarge part of the view to fill the picture | [`Viewport::pick_matrix`] |
//! | the points of a height field | [`PointGrid`] (WV-4) |
//!
//! # Example
//! A corner of the view in two conventions, and the inverse:
//! ```
//! use homog::{ClipRange, PixelConvention, Point};
//! use viewport::Viewport;
//! let corner = Point::new(-1.0, 1.0, -1.0); // upper left, far
//!
//! let image = Viewport::image_for(640, 480, ClipRange::CHAPTER)?;
//! assert_eq!(image.ndc_to_screen().transform_point(corner), Point::new(0.0, 0.0, 0.0));
//!
//! let chapter = Viewport::chapter(640, 480)?;
//! let seen = chapter.ndc_to_screen().transform_point(corner);
//! assert_eq!(seen, Point::new(-0.5, 479.5, -1.0));
//! assert!((chapter.screen_to_ndc().transform_point(seen) - corner).length() < 1e-15);
//!
//! let convert = PixelConvention::CHAPTER.convert_to(PixelConvention::IMAGE, 480.0)?;
//! assert_eq!(convert.transform_point(seen).y(), 0.0);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! Functions return a [`ViewportError`] that names an invalid parameter. Nothing in this crate
//! panics, and finite input never produces infinity or NaN.
#![no_std]

#[cfg(test)]
extern crate std;

mod depth_range;
mod error;
mod fit;
mod page_layout;
mod paper;
mod point_grid;
mod rectangle;
mod tile;
mod unproject;
mod viewport;
mod window_to_viewport;

pub use depth_range::DepthRange;
pub use error::ViewportError;
pub use fit::FitPolicy;
/// The types of points, maps and spaces, re-exported so that you do not need a second dependency.
pub use homog;
pub use paper::{DrawingScale, MILLIMETERS_PER_INCH, Paper, Resolution};
pub use point_grid::PointGrid;
pub use rectangle::Rectangle;
pub use tile::tiles;
pub use unproject::{PickRay, Unprojector};
pub use viewport::Viewport;
pub use window_to_viewport::{Limits, WindowToViewport};

/// The README example, compiled as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
