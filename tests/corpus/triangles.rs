//! Compares the triangle counts of imported models with the manifest.

use crate::corpus::expected;
use alberti_tests::harness::Tally;
use alberti_tests::manifest::Row;
use import::{ImportOptions, load};
use model::{Model, Primitive, Topology};
use std::path::Path;

/// Compares the triangle counts of all models that load.
pub fn check_triangle_counts(folder: &Path, rows: &[Row], known: bool, tally: &mut Tally) {
    let mut agreed = 0;
    for row in rows.iter().filter(|row| row.group() == "models") {
        let Some(expected) = expected::expected_triangles(row) else { continue };
        let Ok(model) = load(&folder.join(&row.path), &ImportOptions::default()) else { continue };
        let actual = count_triangles(&model);
        if actual == expected || known && expected::expected_refusal(row).is_some() {
            agreed += 1;
        } else {
            tally.fail(&row.path, &format!("{actual} triangles, {expected} in the manifest"));
        }
    }
    tally.pass(agreed);
    println!("triangles: {agreed} files agree with the manifest");
}

/// Returns the number of triangles of all mesh instances in the default scene.
fn count_triangles(model: &Model) -> usize {
    let meshes = model.mesh_instances().filter_map(|at| model.nodes[at.node].mesh);
    let primitives = meshes.flat_map(|mesh| &model.meshes[mesh].primitives);
    primitives.filter(|p| p.topology == Topology::Triangles).map(Primitive::item_count).sum()
}
