//! Clipping in homogeneous space, before the divide.
//!
//! Clipping reduces a shape to the part inside a volume. Here it happens before the divide by w,
//! because dividing first moves points behind the eye to positions in front of it. In clip space
//! the volume is a wedge, |x| ≤ w and likewise for y and z, and the picture is the line w = 1. The
//! divide moves every point along its line through the origin to w = 1, including points with w <
//! 0:
//!
//! ```text
//!                 w
//!    q/w     ╲    │p   ╱           p is visible, q is behind the eye. The visible part of
//!   ──●───────╲───┼─·─╱─── w = 1   the segment runs from p to c, where the segment leaves
//!              ╲  │  c             the wedge. In the picture, it runs from just right of
//!               ╲ │ ╱ ·            the middle to the right border.
//!                ╲│╱   ·
//!       ──────────┼─────·─── x     Divided first, q ends up at q/w, on the left. A line from
//!                ╱│╲     ·         p to that point runs the wrong way: it shows exactly the
//!               ╱ │ ╲     ·        part of the segment that is *not* visible.
//!                 │        q
//! ```
//!
//! The part of a shape inside the wedge has w > 0 and is safe to divide.
//!
//! | shape | function | result |
//! | --- | --- | --- |
//! | a point | [`clip_point`], [`Volume::outcode`] | inside or outside; the planes it is outside of |
//! | many points | [`Volume::project_positions`] | outcodes; whether all are inside or all outside |
//! | a segment | [`clip_segment`] | its endpoints with their fractions, and the clipping planes |
//! | a polyline | [`clip_polyline`] | unbroken runs |
//! | a triangle | [`clip_triangle`] | a convex polygon with weights, without allocation |
//! | a convex polygon | [`clip_convex`] | the same, for any number of corners |
//! | a solid | [`cut_triangle`], [`Outline`] | the part behind a plane, with outline and cap |
//! | anything, in any space | [`ConvexVolume`] | polygons with attributes, segments, frustum culling |
//!
//! A [`Volume`] is a table of planes: the canonical volume of any convention, with or without a far
//! plane, with a guard band, or with user planes. Fractions and weights carry attributes along; no
//! perspective correction is needed at this stage. Neighbors are cut at bit-identical points along
//! a shared edge. Nothing here panics, and no result is infinite or NaN.
//!
//! # Example
//! A floor tile under the camera has one corner in front of it and the others beside and behind it.
//! ```
//! use clip::{PlaneOutcome, PlaneIndex, Volume, clip_triangle};
//! use homog::{Clip, Point, Projective, View};
//!
//! // The textbook's perspective projection, w > 0 ahead (PE-3): window [−1, 1]², n = −1, f = −9.
//! let view_to_clip = Projective::<View, Clip>::from_rows([
//!     [1.0, 0.0, 0.0, 0.0],
//!     [0.0, 1.0, 0.0, 0.0],
//!     [0.0, 0.0, 1.25, 2.25],
//!     [0.0, 0.0, -1.0, 0.0],
//! ]);
//!
//! let tile = [(0.0, -6.0), (-4.0, 2.0), (4.0, 2.0)].map(|(x, z)| Point::new(x, -1.5, z));
//! let tile = tile.map(|corner| view_to_clip.transform_point(corner));
//! let left = clip_triangle(tile, &Volume::CHAPTER);
//!
//! // The far corner stays. The floor leaves the picture through its lower border.
//! assert_eq!(left.vertices().len(), 5);
//! assert_eq!(left.vertices()[0].weights, [1.0, 0.0, 0.0]);
//! let lowest = left.vertices()[2].point.divide().expect("visible");
//! assert!((lowest.y() + 1.0).abs() < 1e-15);
//!
//! // The effect of each plane.
//! assert_eq!(left.outcomes.outcome_of(PlaneIndex::BOTTOM), PlaneOutcome::Clipped);
//! assert_eq!(left.outcomes.outcome_of(PlaneIndex::FAR), PlaneOutcome::Accepted);
//! ```
//!
//! Sources: Cohen and Sutherland (about 1967), Sutherland and Hodgman (1974), Blinn and Newell
//! (1978), Liang and Barsky (1984); CL-1 to CL-4.
#![no_std]

extern crate alloc;
#[cfg(test)]
extern crate std;

mod bulk_outcodes;
mod cap;
mod convex_volume;
mod outcode;
mod outline;
mod plane_outcome;
mod point;
mod polygon;
mod polyline;
mod section_plane;
mod segment;
mod sutherland_hodgman;
mod triangle;
mod triangle_section;
mod volume;

pub use bulk_outcodes::OutcodeSummary;
pub use convex_volume::ConvexVolume;
/// Point, map and space types, re-exported so that callers need no second dependency.
pub use homog;
pub use outcode::{MAX_PLANES, Outcode, PlaneIndex};
pub use outline::Outline;
pub use plane_outcome::{PlaneOutcome, PlaneOutcomes};
pub use point::clip_point;
pub use polygon::{ClippedConvex, clip_convex};
pub use polyline::{PolylinePoint, clip_polyline};
pub use section_plane::SectionPlane;
pub use segment::{ClippedSegment, clip_segment, segment_outcomes};
pub use triangle::{ClipVertex, ClippedPolygon, clip_triangle};
pub use triangle_section::{CutTriangle, SectionVertex, cut_triangle};
pub use volume::{Volume, VolumeError};

/// Runs the README examples as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
