//! Exact rasterisation: which pixels a triangle covers, which triangle is nearest, and what it looks like there.
//!
//! ```text
//!   ScreenVertex ──► Frame ──► bins ──► tile: depth + piece ──► fragments ──► your Surface ──► pixels
//!   1/256 pixel      pieces    64 × 64  exact coverage          weights       colours
//! ```
//!
//! Vertices are snapped to 1/256 pixel once; from there on coverage is a matter of integers, and a sample on an edge that
//! two triangles share belongs to exactly one of them (the top-left rule, RA-1). First every sample learns which piece is
//! nearest, then each visible piece is shaded once per pixel, so hidden surfaces cost no shading. The crate knows
//! nothing of materials: it hands out perspective-correct weights of the corners (IN-2).
//!
//! Pixel (i, j) covers [i, i+1) × [j, j+1), its centre is at +½, y runs down. Depth is 1 at the near plane and 0 at the
//! far plane, and the larger wins.
//!
//! ```
//! use homog::Point;
//! use raster::{Cover, Frame, Samples, ScreenVertex};
//!
//! let mut frame = Frame::new(16, 8, Samples::One)?;
//! let corners = [(1.0, 7.0), (15.0, 7.0), (8.0, 0.0)];
//! let corners = corners.map(|(x, y)| ScreenVertex::snap(Point::new(x, y, 0.5), 1.0).unwrap());
//! frame.triangle(corners, 7, Cover::Solid);
//!
//! let seen = frame.visibility();
//! let rows: Vec<String> = seen.ids.chunks(16)
//!     .map(|row| row.iter().map(|id| if *id == Some(7) { '#' } else { '.' }).collect())
//!     .collect();
//! // Samples on the left border are in, those on the right border and on the bottom are out.
//! assert_eq!(rows, [
//!     ".......#........",
//!     "......###.......",
//!     ".....#####......",
//!     "....#######.....",
//!     "...#########....",
//!     "..###########...",
//!     ".#############..",
//!     "................",
//! ]);
//! # Ok::<(), raster::RasterError>(())
//! ```

mod batch;
mod bins;
mod clusters;
mod draw;
mod edge;
mod edges;
mod error;
mod fill;
mod fragment;
mod fragments;
mod frame;
mod front;
mod grid;
mod instructions;
mod layered;
mod memory;
mod nearest;
mod pieces;
mod plane;
mod primitive;
mod resolve;
mod samples;
mod setup;
mod snap;
mod threads;
mod tile;
mod vertex;
mod visibility;
mod walk;

pub use clusters::{Cluster, Clusters, Selection};
pub use draw::{Encode, Surface};
pub use edge::signed_area;
pub use error::RasterError;
pub use fragment::Fragment;
pub use fragments::{Eight, Fragments, WIDE, Weights};
pub use frame::{Frame, MAX_SIDE};
pub use instructions::{Instructions, Work};
pub use nearest::Nearest;
pub use primitive::{Cover, Cull, SourceWeights};
pub use samples::Samples;
pub use threads::share;
pub use vertex::{GUARD_BAND, SUBPIXEL_BITS, SUBPIXELS, ScreenVertex};
pub use visibility::Visibility;
