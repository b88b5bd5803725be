//! The code behind the fuzz targets. The targets only pass on their bytes.
//!
//! ```text
//!  model ───────────────────────► a whole .glb or .gltf ─┐
//!  meshopt, draco, image ─wrap──► a model around them ───┴─► load ─► promises ─► pose ─► draw ─► PNG
//!  scene, include ──────────────► the text of a scene ─────► parse ─► resolve ──────────► draw
//!  background, environment ─────► an image of a scene ─────► decode ─► resolve ─────────► draw
//!  camera ──────────────────────► K, R, t ─────────────────► matrices, and a scene ─────► draw
//!  job_list ────────────────────► a list of jobs ──────────► every picture's name, flags, verdict
//!  explorer ────────────────────► a query ─────────────────► the answer, or an error
//!  maths ───────────────────────► numbers for the calls of `tests/soak`
//!  raster ──────────────────────► triangles, lines and points, drawn whole, in parts, at every SIMD level
//! ```
//!
//! A case fails if it panics, breaks a promise, or uses more than a second or 200 MB; see [`case`].

pub mod camera;
pub mod case;
pub mod explorer;
pub mod glb;
pub mod job_list;
pub mod model;
pub mod mutate;
pub mod numbers;
#[path = "../../hostile/promises.rs"]
mod promises;
pub mod raster;
pub mod scene;
pub mod scene_files;
pub mod streams;
