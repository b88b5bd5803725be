//! Feature edges of meshes: silhouettes, boundaries, creases, intersections and section outlines.
//!
//! ```text
//!  primitives ─world_mesh─► vertices, faces ─weld─► shared vertices ─seams─► T-junctions closed
//!                                                         │
//!      section_cut (once for each section plane) ◄────────┤
//!                                                         ▼
//!                             half_edges ─classify─► edges to draw ◄─ intersections
//! ```
//!
//! A file seldom specifies the edges that a draftsman would draw. They follow from the faces at
//! each edge, once vertices that were split for texture coordinates or normals are welded. An edge
//! with one face is a boundary. An edge between a front-facing and a back-facing face is a
//! silhouette. An edge whose faces meet at a sharp angle is a crease.

mod classify;
mod feature_edges;
mod half_edges;
mod interpolated_contour;
mod intersections;
mod seams;
mod section_caps;
mod section_cut;
mod shells;
mod vertex_normal;
mod weld;
mod welded_surface;
mod world_mesh;

pub(crate) use feature_edges::{FeatureChain, FeatureEdge};
pub use welded_surface::WeldedSurface;
pub(crate) use welded_surface::{CandidateEdge, SectionCap};
pub(crate) use world_mesh::WorldMesh;
