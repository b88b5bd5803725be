//! Arc recognition: runs of points on a circle become arcs, and the rest stays straight.
//!
//! ```text
//!    ●──●                      ●──●
//!   ╱    ╲      16 points     ╱    ╲ ◄─ one arc, bulge = tan(angle / 4)
//!  ●      ●──────────●       ●      ●──────────●
//! ```
//!
//! Circles in a mesh are polygons, but cutting machines need circles. Real polygons must stay
//! straight, though, so a run of points becomes an arc only if
//!
//! - it has at least eight points,
//! - all of them are on one circle within the tolerance,
//! - its steps are equal, except for the first and last step, which visibility may have shortened,
//!   and for steps so short that chord and arc differ by less than the tolerance, and
//! - each step turns by less than 29.5°, which is about the angle at which a bend becomes a crease.
//!
//! A regular polygon with up to twelve corners therefore stays a polygon.
//!
//! | item | contents |
//! | --- | --- |
//! | [`recognize_arcs`] | the curve of a polyline |
//! | [`LineShape`] | a circle, an arc, or a path of straight sides and arcs |
//! | [`ArcVertex`] | a vertex of such a path, with its DXF bulge |
//!
//! Points have integer coordinates: micrometers on a page, or steps of a custom grid.

mod recognition;

pub use recognition::{ArcVertex, Circle, LineShape, recognize_arcs};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
