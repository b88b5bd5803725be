//! Polygons of formats without ready-made vertices: triangulation, welding, and missing normals.

mod crease_normals;
mod orientation;
mod triangulation;
mod vertex_welder;

pub(super) use crease_normals::{CreaseNormals, Smoothing};
pub(super) use triangulation::{PolygonKind, Triangulator};
pub(super) use vertex_welder::VertexWelder;
