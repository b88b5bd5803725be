//! Line drawings: the edges of the models, divided exactly into what is seen and what is hidden.
//!
//! ```text
//!  meshes ─► edges with their classes ─► visible and hidden pieces ─► chains ─► SVG, PDF, PNG
//! ```
//! Everything is computed in f64 from the same stages as the pictures (HL-1); nothing is sampled.

mod chain;
mod fixed;
mod font;
mod label;
mod layout;
mod line;
mod linetype;
mod look;
mod overlap;
mod page;
mod pdf;
mod svg;

pub use label::{Align, Label};
pub use layout::Placement;
pub use line::{EdgeClass, Line, LineDrawing};
pub use linetype::{IsoGroup, LineType};
pub use look::{HiddenLines, LineLook, Shown, Widths};
pub use page::{
    Cap, Group, Ink, Join, Layer, MILLIMETRES_PER_PIXEL, Page, Pen, Place, Polyline, micrometres,
    millimetres,
};
pub use pdf::to_pdf;
