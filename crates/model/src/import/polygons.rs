//! Polygons of formats without finished vertices: welding, and normals for triangles that have none.

mod crease_normals;
mod vertex_welder;

pub(super) use crease_normals::{CreaseNormals, Smoothing};
pub(super) use vertex_welder::VertexWelder;
