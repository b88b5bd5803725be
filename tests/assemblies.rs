//! Checks assembly sheets: parts are counted, pages are legible, and exploded parts do not overlap.
//!
//! Uses the models in `$ASSETS`, or in `shared/assets` next to the repository, that have several
//! nodes with meshes. Arguments that are not flags select models whose paths contain them.

#[path = "../crates/sheet/tests/integration/balloons.rs"]
mod balloons;
#[path = "../crates/sheet/tests/integration/lint.rs"]
mod lint;
#[path = "../crates/sheet/tests/integration/separation.rs"]
mod separation;

use alberti_tests::harness::{
    Tally, data_folder, is_thorough, map_parallel, run_program, sample_cases,
};
use alberti_tests::manifest::read_manifest;
use homog::{Affine, Bounds};
use import::{ImportOptions, load};
use model::{ModelInstance, world_points};
use sheet::{AssemblyPages, ExplosionAxis, ExplosionSettings, PartsList, Sheet, explode_models};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use viewport::Paper;

/// Models with more triangles are skipped; the benchmarks draw them.
const MAX_TRIANGLES: usize = 60_000;

/// Models with more parts are excluded from the sample and drawn only on the smaller paper. A model
/// with 1,900 parts takes seven minutes, as long as all other models together.
const MANY_PARTS: usize = 500;

/// The diagonal to which every model is scaled, in millimeters. Original sizes differ by up to a
/// factor of a million.
const DIAGONAL: f64 = 700.0;

pub fn run() -> ExitCode {
    run_program("assemblies", |arguments| {
        let mut tally = Tally::default();
        let Some(folder) = data_folder("ASSETS", "assets")? else {
            tally.skip("assemblies", "the folder shared/assets is missing; set ASSETS");
            return Ok(tally);
        };
        let mut models = listed_models(&folder)?;
        models.retain(|(_, name)| arguments.select(name));
        let is_sample = arguments.filters().is_empty() && !is_thorough();
        if is_sample {
            models = sample_cases("models", models);
        }
        let results = map_parallel(&models, |_, (path, name)| {
            let result = check_model(path, if is_sample { MANY_PARTS } else { usize::MAX });
            if let Ok(Some(summary)) = &result {
                println!("{name:60} {summary}");
            }
            result
        });
        let mut count = 0;
        for ((_, name), result) in models.iter().zip(results) {
            count += usize::from(!matches!(result, Ok(None)));
            tally.record(name, result.map(drop));
        }
        println!("{count} assemblies");
        Ok(tally)
    })
}

/// Returns the path and name of each listed model that is not too large.
fn listed_models(folder: &Path) -> Result<Vec<(PathBuf, String)>, String> {
    let rows = read_manifest(folder)?.into_iter();
    let wanted = rows.filter(|row| {
        row.group() == "models" && row.scene_triangles.is_some_and(|count| count <= MAX_TRIANGLES)
    });
    Ok(wanted.map(|row| (folder.join(&row.path), row.path)).collect())
}

/// Draws the pages of a model with several parts, and counts its balloons, pages and leader
/// crossings. Returns `None` for models with one part or more than `most`.
fn check_model(path: &Path, most: usize) -> Result<Option<String>, String> {
    // The `corpus` suite checks models that are rejected.
    let Ok(model) = load(path, &ImportOptions::default()) else { return Ok(None) };
    let nodes = model.mesh_instances().count();
    let models = [ModelInstance { model: Arc::new(model), model_to_world: Affine::IDENTITY }];
    let list = PartsList::new(&models, &[], 1.0);
    let parts: usize = list.items.iter().map(|item| item.quantity).sum();
    if parts < 2 {
        return Ok(None);
    }
    if parts > most {
        let name = path.file_name().unwrap_or_default().display();
        println!("{name} has {parts} parts; only the step assemblies-all draws it");
        return Ok(None);
    }
    if parts > nodes {
        return Err(format!("{parts} parts from only {nodes} nodes"));
    }
    let diagonal = Bounds::from_points(world_points(&models)).map_or(1.0, Bounds::diagonal);
    let mut summary = format!("{parts:5} parts {:5} items", list.items.len());
    let papers = [(Paper::A4, "A4"), (Paper::A3.rotated(), "A3")];
    let papers = papers.into_iter().take(if parts > MANY_PARTS { 1 } else { 2 });
    for (paper, name) in papers {
        for explosion in [None, Some(ExplosionSettings::default())] {
            let is_exploded = explosion.is_some();
            let pages = AssemblyPages {
                parts_list: true,
                balloons: true,
                explosion,
                ..AssemblyPages::default()
            };
            let sheet = Sheet {
                assembly: pages,
                millimeters_per_unit: DIAGONAL / diagonal.max(1e-9),
                ..Sheet::for_paper(paper, name)
            };
            let pages = sheet.draw_pages(&models, &[], 1).map_err(|error| error.to_string())?;
            for (page, number) in pages.iter().zip(1..) {
                let mut faults = lint::faults(page);
                faults.extend(balloons::balloon_faults(page));
                if let Some(fault) = faults.first() {
                    let count = faults.len();
                    return Err(format!("{name} {is_exploded} page {number}: {count}: {fault}"));
                }
            }
            let numbers = pages.iter().map(|page| balloons::texts(page, "balloon-numbers").len());
            let crossing = pages.iter().map(|page| balloons::crossing_leaders(page).len());
            let (numbers, crossing): (usize, usize) = (numbers.sum(), crossing.sum());
            summary += &format!("  {name} {numbers}/{} ({crossing})", pages.len());
        }
    }
    let axes = [ExplosionAxis::Auto, ExplosionAxis::X, ExplosionAxis::All];
    for axis in axes {
        let settings = ExplosionSettings { axis, distance: None };
        check_apart(&explode_models(&models, &settings)).map_err(|e| format!("{axis:?}: {e}"))?;
    }
    Ok(Some(summary))
}

/// Checks that no triangles of different objects intersect.
fn check_apart(models: &[ModelInstance]) -> Result<(), String> {
    match separation::intersecting_parts(&separation::part_triangles(models)).first() {
        Some([part, other]) => Err(format!("parts {part} and {other} intersect")),
        None => Ok(()),
    }
}
