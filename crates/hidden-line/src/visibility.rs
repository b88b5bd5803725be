//! Hidden-line removal: cuts each edge into visible and hidden parts (HL-1).
//!
//! The algorithm works in object space, edge against face, as introduced by Roberts (1963) and
//! Appel (*The Notion of Quantitative Invisibility and the Machine Rendering of Solids*, 1967).
//! Nothing is sampled: every cut is the solution of a linear equation in f64.
//!
//! ```text
//!  edge a─b in the world
//!    │  clip to the view volume, project      projected_edge   screen segment + map s ↔ u
//!    ▼
//!  for each box of the BVH that the edge passes behind          bvh, screen_bvh
//!    │
//!    ▼
//!  for each occluder (a clipped face) in it                     occluder
//!    │    s where the edge is inside the screen triangle   ∩    s where it is behind the plane
//!    ▼
//!  union of the intervals                                       occlusion_intervals
//!    ▼
//!  [0, 1] = visible │ hidden │ visible …                        MeshOccluders::hidden_intervals
//! ```
//!
//! Appel counts, at each point of an edge, the faces in front of it: the *quantitative
//! invisibility*. Most line drawings need only to know whether that count is zero, so the union of
//! the intervals hidden by single faces is enough. `covering_faces` counts the faces, for drawings
//! that dash only the lines behind one wall. Two rules make the union match intuition on meshes:
//!
//! - Touching does not hide. An edge in a face, or on its border, belongs to the face and stays
//!   visible; [`Tolerance`] defines the distances below which an edge touches a face.
//! - Two faces that share a side together hide a line exactly behind the side, although each face
//!   by itself would only touch it. Such intervals are collected separately for faces on the left
//!   and on the right of the edge, and their intersection is hidden. In the same way, two objects
//!   hide a line that runs along a crack between them if the crack is narrower than a pen.

mod bounds;
mod bvh;
mod covering_faces;
mod crack_intervals;
mod depth_cover;
mod depth_level;
mod occluder;
mod occluders;
mod occlusion_intervals;
mod projected_edge;
mod screen_bvh;

pub use bvh::Aabb;
pub(crate) use bvh::Bvh;
pub(crate) use depth_cover::{DepthCover, ScreenBox};
pub use occluders::{EdgeParts, Occluders, Tolerance};
pub(crate) use occluders::{MeshOccluders, OcclusionScratch, mesh_bvh};
pub(crate) use occlusion_intervals::OcclusionIntervals;
pub(crate) use projected_edge::ProjectedEdge;
pub(crate) use screen_bvh::TriangleMesh;
