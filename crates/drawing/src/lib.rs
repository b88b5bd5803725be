//! Line drawings: the edges of the models, divided exactly into what is seen and what is hidden.
//!
//! ```text
//!  meshes ─► edges with their classes ─► visible and hidden pieces ─► chains ─► SVG, PDF, PNG
//! ```
//! Everything is computed in f64 from the same stages as the pictures (HL-1); nothing is sampled.

mod canvas;
mod chain;
mod chart;
mod dashes;
mod draw;
mod edges;
mod error;
mod fixed;
mod font;
mod hatch;
mod in_order;
mod label;
mod layout;
mod line;
mod linetype;
mod look;
mod options;
mod overlap;
mod overlay;
mod page;
mod panels;
mod pdf;
mod sheet;
mod sight;
mod subject;
mod svg;
mod tone;
mod verify;
mod visibility;
mod warning;

pub use canvas::draw_over;
pub use chart::{Axis, Chart, Curve, Mark, Spacing};
pub use draw::draw;
pub use error::DrawError;
pub use label::{Align, Label};
pub use layout::Placement;
pub use line::{EdgeClass, Line, LineDrawing};
pub use linetype::{IsoGroup, LineType};
pub use look::{HiddenLines, LineLook, Shown, Tone, Widths};
pub use options::{EdgeClasses, Hidden, Options};
pub use overlay::{Overlay, overlays};
pub use page::{
    Cap, Group, Ink, Join, Layer, MILLIMETRES_PER_PIXEL, Page, Pasted, Pen, Place, Polyline,
    micrometres, millimetres,
};
pub use panels::{Panel, Panels};
pub use pdf::to_pdf;
pub use sheet::{Sheet, SheetError, Titles};
pub use sight::Sight;
pub use subject::Subject;
pub use verify::{Agreement, verify};
pub use visibility::{Obstacles, Parts, Tolerance};
pub use warning::Warning;
