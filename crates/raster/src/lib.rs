//! Exact, deterministic rasterization of triangles, lines and points with multisampling, a
//! visibility buffer and deferred shading.
//!
//! ```text
//!   ScreenVertex ─► Frame ─► tile bins ─► tile: coverage, depth ─► fragments ─► Surface ─► pixels
//!   1/256 pixel     assembly 64 × 64      visibility, layers       weights      colors
//! ```
//!
//! | stage | file |
//! | --- | --- |
//! | perspective divide, viewport, snapping | `vertex_projection.rs`, `screen_vertex.rs` |
//! | cluster culling: back faces by normal cones | `clusters.rs` |
//! | primitive assembly, back-face culling | `frame.rs` |
//! | tile binning | `tile_bins.rs` |
//! | triangle setup: depth plane | `triangle_setup.rs`, `triangle_batch.rs` |
//! | edge functions, top-left rule | `edge_function.rs` |
//! | coverage of triangles a few pixels wide | `micro_triangles.rs` |
//! | coverage, depth test, hierarchical z | `rasterize.rs`, `rasterize/triangle_lanes.rs`, `sample_plane.rs` |
//! | hidden-surface removal per tile, alpha test, layers | `tile_visibility.rs` |
//! | deferred shading | `tile_resolve.rs`, `fragment.rs`, `fragment_lanes.rs` |
//! | multisample resolve, blending | `edge_pixels.rs`, `layer_blending.rs` |
//! | SIMD dispatch, threads | `simd_level.rs`, `parallel.rs`, `tile_loop.rs` |
//!
//! Vertices are snapped to 1/256 pixel once; from there on, coverage uses only integers. A sample
//! on an edge shared by two triangles belongs to exactly one of them (the top-left rule, RA-1).
//! Visibility comes first: every sample stores its nearest triangle. Then each visible triangle is
//! shaded once per pixel, so hidden surfaces cost no shading. The crate knows nothing about
//! materials: a [`Surface`] receives perspective-correct vertex weights (IN-2) and returns colors.
//!
//! # Conventions
//!
//! Pixel (i, j) covers [i, i+1) × [j, j+1), with its center at +½ and y down. Depth is 1 at the
//! near plane and 0 at the far plane; the larger depth wins. At equal depth, the primitive
//! submitted first wins. The picture is bit-identical for any number of threads, any SIMD level and
//! any division into regions.
//!
//! # Example
//!
//! ```
//! use homog::Point;
//! use raster::{Frame, Opacity, Samples, ScreenVertex};
//!
//! let mut frame = Frame::new(16, 8, Samples::One)?;
//! let vertices = [(1.0, 7.0), (15.0, 7.0), (8.0, 0.0)];
//! let vertices = vertices.map(|(x, y)| ScreenVertex::snap(Point::new(x, y, 0.5), 1.0).unwrap());
//! frame.add_triangle(vertices, 7, Opacity::Opaque);
//!
//! let buffer = frame.visibility_buffer();
//! let rows: Vec<String> = buffer.ids.chunks(16)
//!     .map(|row| row.iter().map(|id| if *id == Some(7) { '#' } else { '.' }).collect())
//!     .collect();
//! // Samples on the left border are inside; samples on the right and bottom borders are not.
//! assert_eq!(rows, [
//!     ".......#........",
//!     "......###.......",
//!     ".....#####......",
//!     "....#######.....",
//!     "...#########....",
//!     "..###########...",
//!     ".#############..",
//!     "................",
//! ]);
//! # Ok::<(), raster::RasterError>(())
//! ```

mod attributes;
mod buffer_pool;
#[cfg(feature = "clip")]
mod clipped_mesh;
mod clusters;
mod depth_buffer;
mod depth_compare;
mod edge_function;
mod edge_pixels;
mod error;
mod fragment;
mod fragment_lanes;
mod frame;
mod front_fragments;
mod layer_blending;
mod micro_triangles;
mod monitor;
mod parallel;
mod primitive;
mod rasterize;
mod sample_plane;
mod samples;
mod screen_vertex;
mod simd_level;
mod surface;
mod surface_depth;
mod tile_bins;
mod tile_grid;
mod tile_loop;
mod tile_resolve;
mod tile_visibility;
mod triangle_batch;
mod triangle_buffer;
mod triangle_setup;
mod vertex_projection;
mod visibility_buffer;

pub use attributes::VertexAttribute;
#[cfg(feature = "clip")]
pub use clipped_mesh::{ScreenProjection, SourceMesh};
pub use clusters::{Cluster, Clusters, MeshSelection};
pub use depth_buffer::DepthBuffer;
pub use depth_compare::DepthCompare;
pub use edge_function::signed_area;
pub use error::RasterError;
pub use fragment::Fragment;
pub use fragment_lanes::{F32x8, Fragments, LANES, WeightLanes};
pub use frame::{Frame, MAX_SIDE, MeshTriangles};
/// Point, map and space types, re-exported so that callers need no second dependency.
pub use homog;
pub use monitor::{Monitor, Workers};
pub use parallel::for_each_parallel;
pub use primitive::{CullMode, Opacity, SourceWeights};
pub use samples::Samples;
pub use screen_vertex::{GUARD_BAND, MAX_DEPTH, SUBPIXEL_BITS, SUBPIXELS, ScreenVertex};
pub use simd_level::{Kernel, SimdLevel};
pub use surface::{Encode, Surface, SurfaceFn, TranslucentColors, shade_each, surface_fn};
pub use surface_depth::SurfaceDepth;
pub use vertex_projection::VertexProjection;
pub use visibility_buffer::VisibilityBuffer;

/// Runs the README examples as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
