//! Which parts of edges are hidden by faces (HL-1), exactly: by intersecting half-lines, not by sampling.

mod bvh;
mod obstacles;
mod piece;
mod spans;
mod trace;

pub(super) use bvh::{Aabb, Bvh};
pub(super) use obstacles::Scratch;
pub use obstacles::{Obstacles, Parts, Tolerance};
pub(super) use trace::Trace;
