//! Pages: lines, text, hatching and pictures in whole micrometers, and writers for four formats.
//!
//! ```text
//!   Page ─┬─ PlacedImage …                                  ┌─► SVG
//!         └─ Layer (pen) ─── Group (object) ─── Polyline …  ├─► PDF, several pages
//!                                                           ├─► DXF: layers, arcs, circles, text
//!                                                           └─► a picture, drawn by tiny-skia
//! ```
//!
//! | module | contents |
//! | --- | --- |
//! | `page` | the page, its layers, pens and polylines |
//! | `svg`, `pdf`, `dxf`, `canvas` | the four formats |
//! | `line_type`, `dash_pattern` | line types and widths of ISO 128, and dashes fitted to a line |
//! | `label`, `stroke_font` | text as pen strokes: Latin, Greek and some Chinese |
//! | `page_clip` | removes strokes inside a rectangle or beyond the page border |
//! | [`palette`] | ink colors |
//!
//! This crate does not depend on models or views. Identical pages give identical bytes.

mod canvas;
mod dash_pattern;
mod dxf;
mod fixed_decimal;
mod label;
mod line_type;
mod markup;
mod page;
mod page_clip;
pub mod palette;
mod pdf;
mod stroke_font;
mod svg;

pub use canvas::{draw_layers_over, picture_to_pixmap, pixmap_to_picture};
pub use dxf::{DxfOptions, DxfUnit};
pub use label::{Label, TextAlign};
pub use line_type::{IsoLineGroup, LineType};
pub use markup::escape_markup;
pub use page::{
    Cap, Group, GroupContent, HatchArea, Ink, Join, Layer, MILLIMETERS_PER_PIXEL, Page, PagePoint,
    Pen, PlacedImage, Polyline, TextLine, to_micrometers, to_millimeters,
};
pub use pdf::to_pdf;
pub use stroke_font::missing_glyphs;

/// The library that defines the pixmaps that [`picture_to_pixmap`] returns.
pub use tiny_skia;

/// The README example, compiled as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
