//! Checks that the meshes in a folder of STL, OBJ, PLY and 3MF files have the triangles and bounds
//! in its manifest.
//!
//! The folder is `$ASSETS` or `shared/assets` next to the repository, or `meshes` inside it. Its
//! `MANIFEST.tsv` begins with a comment (`#`) and lists the results of another reader for each
//! file: path, origin, triangles (after triangulation), bounds in file coordinates, and the
//! outcome. The table in [`expected`] lists the files that differ, with the reason. Arguments that
//! are not flags select files whose paths contain them.

mod expected;

use alberti_tests::harness::{Tally, data_folder, run_program};
use expected::MeshFacts;
use import::{ImportOptions, load};
use model::{Model, Topology, UpAxis};
use std::path::Path;
use std::process::ExitCode;

pub fn run() -> ExitCode {
    run_program("meshes", |arguments| {
        let mut tally = Tally::default();
        let assets = data_folder("ASSETS", "assets")?;
        let folders = assets.map(|assets| [assets.join("meshes"), assets]);
        let Some(folder) = folders.into_iter().flatten().find(|folder| has_meshes(folder)) else {
            tally.skip("meshes", "the folder shared/assets/meshes is missing; set ASSETS");
            return Ok(tally);
        };
        let known = std::env::var_os("ASSETS").is_none();
        for row in read_manifest(&folder)?.iter().filter(|row| arguments.select(&row.path)) {
            tally.record(&row.path, check_file(&folder, row, known));
        }
        Ok(tally)
    })
}

/// Returns whether a folder has a mesh manifest; manifests of other corpora begin with a heading.
fn has_meshes(folder: &Path) -> bool {
    let manifest = std::fs::read_to_string(folder.join("MANIFEST.tsv"));
    manifest.is_ok_and(|text| text.starts_with('#'))
}

/// A file in the folder, with its manifest entry.
struct Row {
    /// The path below the folder.
    path: String,
    /// The result of the other reader, or `None` if it rejected the file.
    facts: Option<MeshFacts>,
}

/// Reads the manifest, whose columns are separated by tabs. Its only heading is a comment.
fn read_manifest(folder: &Path) -> Result<Vec<Row>, String> {
    let path = folder.join("MANIFEST.tsv");
    let text = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let rows = text.lines().filter(|line| !line.starts_with('#') && !line.trim().is_empty());
    let parse = |line: &str| {
        let cells: Vec<&str> = line.split('\t').collect();
        let cell = |at: usize| cells.get(at).copied().unwrap_or("");
        let wrong = || format!("{}: invalid row: {line}", path.display());
        let facts = match cell(2) {
            "-" => None,
            count => Some(MeshFacts {
                triangles: count.parse().map_err(|_| wrong())?,
                bounds: parse_bounds(cell(3)).ok_or_else(wrong)?,
            }),
        };
        Ok(Row { path: cell(0).to_owned(), facts })
    };
    rows.map(parse).collect()
}

/// Parses six numbers, the minimum corner first, or `-` for a file without vertices.
#[allow(clippy::option_option, reason = "invalid text, absent bounds or bounds")]
fn parse_bounds(text: &str) -> Option<Option<[f64; 6]>> {
    if text == "-" {
        return Some(None);
    }
    let numbers: Result<Vec<f64>, _> = text.split(' ').map(str::parse).collect();
    Some(Some(numbers.ok()?.try_into().ok()?))
}

/// Loads a file and compares it with the manifest or with the table of known differences.
fn check_file(folder: &Path, row: &Row, known: bool) -> Result<(), String> {
    // The bounds are in file coordinates, for any up axis.
    let options = ImportOptions { up: Some(UpAxis::Y), ..ImportOptions::default() };
    let found = match load(&folder.join(&row.path), &options) {
        Ok(model) => Ok(mesh_facts(&model)),
        Err(error) => Err(error.diagnostic.sentence()),
    };
    let difference = expected::DIFFERENCES.iter().find(|(path, ..)| known && *path == row.path);
    match (difference, &row.facts, found) {
        (Some((_, wanted, reason)), _, Ok(found)) => {
            wanted.compare(&found).map_err(|error| format!("{error} ({reason})"))
        }
        (None, Some(wanted), Ok(found)) => wanted.compare(&found),
        (Some(_), _, Err(error)) | (None, Some(_), Err(error)) => {
            Err(format!("it is rejected: {error}"))
        }
        (None, None, found) => {
            println!("{}: rejected by the other reader; here: {found:?}", row.path);
            Ok(())
        }
    }
}

/// Returns the triangles and bounds of the visible parts of a model.
fn mesh_facts(model: &Model) -> MeshFacts {
    let shown = model.scene_primitives().map(|(_, primitive)| primitive);
    let triangles = shown.filter(|primitive| primitive.topology == Topology::Triangles);
    let bounds = model.bounds().map(|bounds| {
        let ([a, b, c], [d, e, f]): ([f64; 3], [f64; 3]) =
            (bounds.min().into(), bounds.max().into());
        [a, b, c, d, e, f]
    });
    MeshFacts { triangles: triangles.map(model::Primitive::item_count).sum(), bounds }
}
