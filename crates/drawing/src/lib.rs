//! Drawings for pages: line styles, face fills, overlays, charts, and layers of polylines from
//! hidden-line removal.
//!
//! ```text
//!   models ─► hidden_line: visible and hidden segments ─► Drawing ─► layers of polylines ─► page
//!                                                         draw       layout
//! ```
//!
//! | module | technique |
//! | --- | --- |
//! | `draw`, `drawing` | the lines of a subject and the fill under them |
//! | `face_fill`, `gray_fill`, `color_areas` | fills of visible faces, and areas traced from them |
//! | `line_style` | the selection of edges, and pens and widths as in ISO 128 |
//! | `layout`, `overlap_removal`, `polyline_chain` | turning segments into layers of polylines |
//! | `line_density`, `hand_drawn` | thinning of dense lines; hand-drawn strokes |
//! | `region_outline` | outlines of the area covered by faces: winding numbers, snap rounding |
//! | `line_clip` | drawings clipped to parts of a view |
//! | `overlay`, `chart`, `panels` | teaching material: axes, labels, vanishing points, curves |
//!
//! A drawing matches a picture of the same scene exactly. Results do not depend on the number of
//! threads.

mod chart;
mod color_areas;
mod draw;
mod drawing;
mod face_fill;
mod gray_fill;
mod hand_drawn;
mod layout;
mod line_clip;
mod line_density;
mod line_style;
mod overlap_removal;
mod overlay;
mod panels;
mod polyline_chain;
mod region_outline;
mod speckles;
mod warning;

pub use chart::{Axis, AxisMark, Chart, Curve, Spacing};
pub use draw::{draw, draw_surface};
pub use drawing::Drawing;
pub use face_fill::FillOptions;
pub use layout::Placement;
pub use line_clip::{ClipArea, ClipSide, circle_points, point_at};
pub use line_style::{EdgeSelection, FaceFill, HiddenLines, LineStyle, LineWidths};
pub use overlay::{
    AXES, LabelFault, Overlay, PointLabel, label_rectangles, label_warnings, missing_glyph_warning,
    overlay_layers, with_label_halos,
};
pub use panels::{Panel, Panels};
pub use warning::Warning;

/// A page together with the warnings from its drawings.
pub type Page = page::Page<Warning>;

/// The README example, compiled as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
