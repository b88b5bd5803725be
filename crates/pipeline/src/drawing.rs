//! Line drawings: the edges of the models, divided exactly into what is seen and what is hidden.
//!
//! ```text
//!  meshes ─► edges with their classes ─► visible and hidden pieces ─► chains ─► SVG, PDF, PNG
//! ```
//! Everything is computed in f64 from the same stages as the pictures (HL-1); nothing is sampled.

mod draw;
mod edges;
mod in_order;
mod line;
mod options;
mod sight;
mod verify;
mod visibility;

pub use draw::draw;
pub use line::{EdgeClass, Line, LineDrawing};
pub use options::{EdgeClasses, Hidden, Options};
pub use sight::Sight;
pub use verify::{Agreement, verify};
pub use visibility::{Obstacles, Parts, Tolerance};
