//! The edges of the models: which there are, and why each would be drawn.
//!
//! ```text
//!  primitives ─gather─► points, faces ─weld─► shared points ─sides─► edges with their faces ─classify─► edges to draw
//! ```

mod caps;
mod classify;
mod crossings;
mod gather;
mod seams;
mod section;
mod sides;
mod surface;
mod weld;

pub(super) use surface::{Candidate, Surface};
