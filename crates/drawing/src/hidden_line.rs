//! Which parts of edges are hidden by faces (HL-1), exactly: by intersecting half-lines, not by sampling.

mod bvh;
mod occluder;
mod occluders;
mod occlusion_intervals;
mod projected_edge;

pub(super) use bvh::{Aabb, Bvh};
pub(super) use occluders::OcclusionScratch;
pub use occluders::{EdgeParts, Occluders, Tolerance};
pub(super) use projected_edge::ProjectedEdge;
