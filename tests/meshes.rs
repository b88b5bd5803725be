//! Every mesh of a folder of STL, OBJ, PLY and 3MF files has the triangles and bounds of its
//! manifest.
//!
//! The folder is `$ASSETS` or `shared/assets` next to the repository, or `meshes` in it. Its
//! `MANIFEST.tsv` begins with a comment (`#`) and lists the findings of another reader for each
//! file: path, origin, triangles (polygons cut), bounds in file coordinates, and the outcome. Files
//! that differ are in the table of [`expected`], with the reason. Arguments that are not flags
//! select files by part of their path.

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
            tally.skip("meshes", "there is no folder shared/assets/meshes; name one by ASSETS");
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
    /// The findings of the other reader; `None` if it refused the file.
    facts: Option<MeshFacts>,
}

/// Reads the manifest: columns separated by tabs, without a heading other than a comment.
fn read_manifest(folder: &Path) -> Result<Vec<Row>, String> {
    let path = folder.join("MANIFEST.tsv");
    let text = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let rows = text.lines().filter(|line| !line.starts_with('#') && !line.trim().is_empty());
    let parse = |line: &str| {
        let cells: Vec<&str> = line.split('\t').collect();
        let cell = |at: usize| cells.get(at).copied().unwrap_or("");
        let wrong = || format!("{}: this is not a row: {line}", path.display());
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

/// Six numbers, the minimum corner first; `-` for a file without vertices.
#[allow(clippy::option_option, reason = "no numbers, or no bounds")]
fn parse_bounds(text: &str) -> Option<Option<[f64; 6]>> {
    if text == "-" {
        return Some(None);
    }
    let numbers: Result<Vec<f64>, _> = text.split(' ').map(str::parse).collect();
    Some(Some(numbers.ok()?.try_into().ok()?))
}

/// Loads a file and compares it with the manifest or with the table of known differences.
fn check_file(folder: &Path, row: &Row, known: bool) -> Result<(), String> {
    // In the coordinates of the file, for any up axis.
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
            Err(format!("it is refused: {error}"))
        }
        (None, None, found) => {
            println!("{}: refused by the other reader; here: {found:?}", row.path);
            Ok(())
        }
    }
}

/// Triangles and bounds of the visible parts of a model.
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
