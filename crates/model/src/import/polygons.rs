//! Polygons of formats without finished vertices: normals for triangles that have none.

mod crease_normals;

pub(super) use crease_normals::{CreaseNormals, Smoothing};
