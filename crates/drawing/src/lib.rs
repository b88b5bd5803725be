//! Hidden-line drawings of meshes: feature edges, exact visibility, sections; SVG, PDF, DXF and PNG.
//!
//! ```text
//!   models ─► edges ─► visible and hidden segments ─► polylines by pen ─► SVG, PDF, DXF, PNG
//!             edges       hidden_line                 layout            svg, pdf, dxf, canvas
//! ```
//!
//!  module | technique |
//!  --- | --- |
//!  `edges` | vertex welding, T-junctions, silhouettes and creases, section cuts with caps |
//!  `hidden_line` | hidden-line removal by interval arithmetic over a BVH (Roberts, Appel 1967) |
//!  `hatching` | ISO 128-50 hatching of caps and of parts, hatching by luma of faces |
//!  `face_fill`, `gray_fill`, `color_areas` | fills of visible faces by a z-buffer; areas traced from it |
//!  `layout`, `overlap_removal`, `polyline_chain` | from segments to layers of polylines |
//!  `line_style`, `line_type`, `dash_pattern` | pens, line widths and dashes of ISO 128 |
//!  `region`, `region_outline` | outlines of what faces cover, by winding numbers and snap rounding |
//!  `feature_picker`, `circles` | vertices, edges, faces and circles by their place
//!  `page`, `svg`, `pdf`, `dxf`, `canvas` | pages in micrometers, and their four formats |
//!  `page_clip`, `line_clip` | lines clipped to the rectangles of views, drawings to parts of views |
//!  `overlay`, `chart`, `panels` | teaching material: axes, labels, vanishing points, curves |
//!  `z_buffer_check` | a drawing checked against the z-buffer image of its scene |
//!
//! All geometry is f64 and runs through the stages of the pictures (`camera`, `projection`, `clip`,
//! `viewport`), so a line drawing lies exactly over a picture of the same scene. Results do not
//! depend on the number of threads.

mod chart;
mod circles;
mod color_areas;
mod draw;
mod edges;
mod error;
mod face_fill;
mod face_raster;
mod feature_picker;
mod gray_fill;
mod hand_drawn;
mod hatching;
mod hidden_line;
mod layout;
mod line_clip;
mod line_density;
mod line_drawing;
mod line_style;
mod mirror_symmetry;
mod options;
mod overlap_removal;
mod overlay;
mod panels;
mod parallel;
mod polyline_chain;
mod projector;
mod region;
mod region_outline;
mod retained_points;
mod speckles;
mod subject;
mod view_cover;
mod warning;
mod z_buffer_check;

pub use chart::{Axis, AxisMark, Chart, Curve, Spacing};
pub use circles::WorldCircle;
pub use draw::{draw, draw_surface};
pub use edges::WeldedSurface;
pub use error::DrawError;
pub use feature_picker::{FeaturePicker, PickedFeature};
pub use hidden_line::{Aabb, EdgeParts, Occluders, Tolerance};
pub use layout::Placement;
pub use line_clip::{ClipArea, ClipSide, circle_points, point_at};
pub use line_drawing::{EdgeClass, EdgeSegment, LineDrawing};
pub use line_style::{EdgeSelection, FaceFill, HiddenLines, LineStyle, LineWidths};
pub use mirror_symmetry::MirrorSymmetry;
pub use options::{DrawOptions, EdgeClasses, HiddenEdges, SilhouetteMethod};
pub use overlay::{
    AXES, LabelFault, Overlay, PointLabel, SheetLabelFault, label_rectangles, label_warnings,
    missing_glyph_warning, overlay_layers, with_label_halos,
};
pub use panels::{Panel, Panels};
pub use projector::Projector;
pub use region::{Region, RegionEdge, RegionHatching, region_edges};
pub use retained_points::{idle_section_warning, retained_points};
pub use subject::Subject;
/// A page with the warnings of its drawings.
pub type Page = page::Page<Warning>;

pub use warning::{AssemblyWarning, DimensionFault, Warning, visible_text};
pub use z_buffer_check::{Agreement, verify_with_z_buffer};

/// The example of the README, compiled as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
