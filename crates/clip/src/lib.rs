//! Clipping in homogeneous space, before the divide.
//!
//! Clipping makes of a shape the part of it that a volume contains. It comes before the divide, for the divide is where
//! things go wrong: points behind the eye (w < 0) would come out in front of it, and a segment with one end there would be
//! drawn as the *outside* part of its line.
//!
//! ```text
//!      w ▲     w = x          In clip space the volume is the wedge |x| ≤ w (one axis drawn). The divide
//!        │    ╱               pulls every point along its ray through the origin onto the line w = 1.
//!   ─────┼───●───── w = 1     p and q straddle the wedge's border; the part p–c is kept.
//!        │ p╱  ╲              q' = q/w is *left* of p: dividing first and drawing from p to q'
//!        │ ╱    ╲ c           would cover exactly what is not visible.
//! ───────┼───────╲────► x
//!       ╱│        ╲ q
//! ```
#![no_std]

extern crate alloc;
#[cfg(test)]
extern crate std;

mod bulk;
mod cap;
mod fate;
mod outcode;
mod outline;
mod point;
mod polygon;
mod polyline;
mod section;
mod segment;
mod triangle;
mod volume;
mod walk;

pub use bulk::Extent;
pub use fate::{Fate, Fates};
pub use outcode::{MAX_PLANES, Outcode, PlaneIndex};
pub use outline::Outline;
pub use point::clip_point;
pub use polygon::{ClippedConvex, clip_convex};
pub use polyline::{PolylinePoint, clip_polyline};
pub use section::{CutTriangle, SectionVertex, cut_triangle};
pub use segment::{ClippedSegment, clip_segment, segment_fates};
pub use triangle::{ClipVertex, ClippedPolygon, clip_triangle};
pub use volume::{Volume, VolumeError};
