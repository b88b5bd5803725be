//! The edges of the models: which there are, and why each would be drawn.
//!
//! ```text
//!  primitives ─gather─► points, faces ─weld─► shared points ─sides─► edges with their faces ─classify─► edges to draw
//! ```

mod classify;
mod half_edges;
mod intersections;
mod seams;
mod section_caps;
mod section_cut;
mod weld;
mod welded_surface;
mod world_mesh;

pub(super) use welded_surface::{CandidateEdge, WeldedSurface};
