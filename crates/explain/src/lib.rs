//! Explains the steps of the viewing pipeline for a point, segment, triangle, node, pixel or
//! matrix.
//!
//! ```text
//!  subject ─► steps, each with its formula ─► items: matrices, coordinates ─► text, JSON, HTML
//! ```
//! Every number comes from the code that also renders pictures, so explanations match pictures.
//!
//! | subject | file |
//! | --- | --- |
//! | the parts of an explanation | `explanation.rs` |
//! | the transform chain and its steps, shared by all | `transform_chain.rs` |
//! | conventions of OpenGL, Vulkan, Direct3D, WebGPU | `conventions.rs` |
//! | the matrices as printed in the textbook | `chapter_matrices.rs` |
//! | points and vertices, segments, triangles | `point.rs`, `segment.rs`, `triangle.rs` |
//! | homogeneous points and directions, f(t) | `homogeneous_point.rs`, `foreshortening.rs` |
//! | points under a single matrix, without a scene | `bare_map.rs` |
//! | both eyes of a stereo pair | `stereo.rs` |
//! | why a node is invisible; why a pixel has its color | `node.rs`, `pixel.rs` |
//! | the meaning of an arbitrary matrix, and known misprints | `matrix.rs` |
//! | factors of a projection | `projection_factors.rs` |
//! | formulas by id | [`formulas`] |
//! | output | `introduction.rs`, `plain_text.rs`, `json.rs`, `html.rs`, `diagrams.rs` |

mod bare_map;
mod chapter_matrices;
mod conventions;
mod diagrams;
mod explanation;
mod foreshortening;
pub mod formulas;
mod homogeneous_point;
mod html;
mod introduction;
mod json;
mod matrix;
mod node;
mod pixel;
mod plain_text;
mod point;
mod projection_factors;
mod segment;
mod stereo;
mod transform_chain;
mod triangle;

pub use bare_map::BareMap;
pub use conventions::ApiConventions;
pub use explanation::{Explanation, ExplanationEntry, ItemValue, Step};
pub use homogeneous_point::explain_homogeneous_point;
pub use json::{SCHEMA_NAME, SCHEMA_VERSION};
pub use matrix::{explain_matrix, explain_planar_matrix, without_rounding};
pub use node::explain_node;
pub use pixel::explain_pixel;
pub use point::{VertexRef, explain_point, explain_transforms, explain_vertex};
pub use projection_factors::formula_ids;
pub use segment::explain_segment;
pub use transform_chain::TransformChain;
pub use triangle::explain_triangle;

/// The examples of the README, compiled as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
