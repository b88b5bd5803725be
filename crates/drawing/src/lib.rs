//! Line drawings: the edges of the models, divided exactly into what is seen and what is hidden.
//!
//! ```text
//!  meshes ─► edges with their classes ─► visible and hidden pieces ─► chains ─► SVG, PDF, PNG
//! ```
//! Everything is computed in f64 from the same stages as the pictures (HL-1); nothing is sampled.

mod canvas;
mod chart;
mod dash_pattern;
mod draw;
mod edges;
mod error;
mod face_fill;
mod fixed_decimal;
mod hatching;
mod hidden_line;
mod label;
mod layout;
mod line_drawing;
mod line_style;
mod line_type;
mod options;
mod overlap_removal;
mod overlay;
mod page;
mod panels;
mod parallel;
mod pdf;
mod polyline_chain;
mod projector;
mod sheet;
mod stroke_font;
mod subject;
mod svg;
mod warning;
mod z_buffer_check;

pub use canvas::draw_layers_over;
pub use chart::{Axis, AxisMark, Chart, Curve, Spacing};
pub use draw::draw;
pub use error::DrawError;
pub use hidden_line::{EdgeParts, Occluders, Tolerance};
pub use label::{Label, TextAlign};
pub use layout::Placement;
pub use line_drawing::{EdgeClass, EdgeSegment, LineDrawing};
pub use line_style::{EdgeSelection, FaceFill, HiddenLines, LineStyle, LineWidths};
pub use line_type::{IsoLineGroup, LineType};
pub use options::{DrawOptions, EdgeClasses, HiddenEdges};
pub use overlay::{Overlay, overlay_layers};
pub use page::{
    Cap, Group, Ink, Join, Layer, MILLIMETERS_PER_PIXEL, Page, PagePoint, Pen, PlacedImage,
    Polyline, to_micrometers, to_millimeters,
};
pub use panels::{Panel, Panels};
pub use pdf::to_pdf;
pub use projector::Projector;
pub use sheet::{Sheet, SheetError, TitleBlockText};
pub use subject::Subject;
pub use warning::Warning;
pub use z_buffer_check::{Agreement, verify_with_z_buffer};
