//! Polygon processing for mesh formats: triangulation, vertex welding and missing normals.

mod crease_normals;
mod orientation;
mod triangulation;
mod vertex_welder;

pub(super) use crease_normals::{CreaseNormals, Smoothing};
pub(super) use triangulation::{PolygonKind, Triangulator};
pub(super) use vertex_welder::VertexWelder;
