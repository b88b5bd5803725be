//! Exact hidden-line removal of meshes: feature edges, visibility, sections with caps, hatching.
//!
//! ```text
//!   models ─► edges ─► visible and hidden segments, by class and object
//!             edges    visibility
//! ```
//!
//! | module | technique |
//! | --- | --- |
//! | `draw` | the drawing itself: candidate edges, divided into visible and hidden segments |
//! | `edges` | vertex welding, T-junctions, silhouettes and creases, section cuts with caps |
//! | `visibility` | hidden-line removal by unions of intervals, with a BVH (Roberts, Appel 1967) |
//! | `view_cover` | occlusion by a crowd of faces as a whole |
//! | `hatching` | ISO 128-50 hatching of caps and parts, hatching of faces by luma |
//! | `region` | areas covered by faces on the screen, by winding numbers |
//! | `feature_picker`, `circles` | picking of vertices, edges, faces and circles by position |
//! | `mirror_symmetry` | planes of symmetry |
//! | `retained_points` | points of the parts that section planes retain, for framing |
//! | `face_raster`, `z_buffer_check` | z-buffer of faces; verification of a drawing against it |
//!
//! [`draw`](draw()) takes a [`Subject`], which consists of models and a camera, and returns a
//! [`LineDrawing`], which consists of segments in pixels. A line drawing has no pens or pages; the
//! crate `drawing` lays it out on pages.
//!
//! All geometry is in f64 and passes through the same stages as a rendered picture (`camera`,
//! `projection`, `clip`, `viewport`), so a line drawing exactly matches a rendering of the same
//! scene. Results do not depend on the number of threads.

mod circles;
mod draw;
mod edges;
mod error;
mod face_raster;
mod feature_picker;
mod hatching;
mod line_drawing;
mod mirror_symmetry;
mod options;
mod parallel;
mod projector;
mod region;
mod retained_points;
mod subject;
mod view_cover;
mod visibility;
mod warning;
mod z_buffer_check;

pub use circles::WorldCircle;
pub use draw::{DrawnFaces, draw, draw_hatched, draw_surface};
pub use edges::WeldedSurface;
pub use error::DrawError;
pub use face_raster::rasterize_faces;
pub use feature_picker::{FeaturePicker, PickedFeature};
pub use hatching::FaceHatching;
pub use line_drawing::{EdgeClass, EdgeSegment, LineDrawing};
pub use mirror_symmetry::MirrorSymmetry;
pub use options::{DrawOptions, EdgeClasses, HiddenEdges, SilhouetteMethod};
pub use projector::Projector;
pub use raster::{Monitor, Workers};
pub use region::{Region, RegionEdge, RegionHatching, region_edges};
pub use retained_points::{idle_section_warning, retained_points};
pub use subject::Subject;
pub use visibility::{Aabb, EdgeParts, Occluders, Tolerance};
pub use warning::Warning;
pub use z_buffer_check::{Agreement, verify_with_z_buffer};

/// The README example, compiled as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
