//! Tests of files written by hand and by programs, read through the public interface.

mod materials;
mod shapes;

use crate::load_bytes;
use gltf_import::{ImportError, ImportOptions};
use model::{Model, Primitive, Topology};

/// Reads an OBJ file in memory.
fn read(text: impl AsRef<[u8]>) -> Result<Model, ImportError> {
    load_bytes("test.obj", text.as_ref(), &ImportOptions::default())
}

/// Reads an OBJ file in memory leniently.
fn read_leniently(text: &str) -> Model {
    let options = ImportOptions { lenient: true, ..ImportOptions::default() };
    load_bytes("test.obj", text.as_bytes(), &options).unwrap()
}

/// Returns the primitives of a model in order.
fn primitives(model: &Model) -> Vec<&Primitive> {
    model.meshes.iter().flat_map(|mesh| &mesh.primitives).collect()
}

/// Returns the number of triangles.
fn triangle_count(model: &Model) -> usize {
    let is_surface = |primitive: &&&Primitive| primitive.topology == Topology::Triangles;
    primitives(model).iter().filter(is_surface).map(|primitive| primitive.item_count()).sum()
}

/// Returns the warnings as text, one per line.
fn warnings(model: &Model) -> String {
    model.warnings.iter().map(|warning| format!("{}\n", warning.sentence())).collect()
}

/// The corners of a unit square in the plane z = 0.
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
