//! The number of triangles the importer finds, against the manifest's.

use crate::expected;
use crate::manifest::Row;
use model::import::{ImportOptions, load};
use model::{Model, Primitive, Topology};
use std::path::Path;

/// Counts the triangles of all models that load; gives the number of files that agree with the manifest.
pub fn check_triangle_counts(
    folder: &Path,
    rows: &[Row],
    known: bool,
    failures: &mut Vec<String>,
) -> usize {
    let mut agreed = 0;
    for row in rows.iter().filter(|row| row.group() == "models") {
        let Some(expected) = expected::expected_triangles(row) else { continue };
        let Ok(model) = load(&folder.join(&row.path), &ImportOptions::default()) else { continue };
        let actual = count_triangles(&model);
        if actual == expected || known && expected::expected_refusal(row).is_some() {
            agreed += 1;
        } else {
            let path = &row.path;
            failures.push(format!("{path}: {actual} triangles, {expected} in the manifest"));
        }
    }
    agreed
}

fn count_triangles(model: &Model) -> usize {
    let meshes = model.mesh_instances().filter_map(|at| model.nodes[at.node].mesh);
    let primitives = meshes.flat_map(|mesh| &model.meshes[mesh].primitives);
    primitives.filter(|p| p.topology == Topology::Triangles).map(Primitive::item_count).sum()
}
