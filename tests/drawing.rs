//! Compares line drawings with z-buffer images: they may disagree on at most 0.2 percent of the
//! visible length.
//!
//! Uses the scene models and, if it exists, the listed models in `$ASSETS` or in `shared/assets`
//! next to the repository. Each is drawn from six directions in perspective, isometric and cavalier
//! projection. Random scenes over all projections follow (`random.rs`). Arguments that are not
//! flags select models whose paths contain them; a path below the folder's `models` selects a model
//! that is not listed.

mod bits;
mod random;
mod random_projection;
mod views;

use alberti_tests::harness::{Tally, data_folder, map_parallel, run_program, sample_cases};
use alberti_tests::project_root;
use hidden_line::{Agreement, DrawOptions, HiddenEdges, LineDrawing, draw, verify_with_z_buffer};
use import::{ImportOptions, load};
use model::Model;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use views::{DIRECTIONS, ViewKind, build_scene};

/// The fraction of the visible length on which a drawing and its z-buffer image may disagree.
const MAX_DISAGREEMENT: f64 = 0.002;

/// Models whose drawings may disagree more, with the reason.
const EXCEPTIONS: &[(&str, f64, &str)] = &[(
    "ship-light-draco/model.gltf",
    0.005,
    "lines where quantized planks cross are visible through cracks a twentieth of a pixel wide, which contain no samples",
)];

/// Scene models that consist only of lines.
const WITHOUT_FACES: &[&str] = &["house_edges.glb", "mexican_hat_lines.glb"];

/// Models in the folder `models` of the assets.
const MODELS: &[&str] = &[
    "alien/alien.glb",
    "armor/armor.gltf",
    "boolean/boolean.glb",
    "box-meshopt/BoxMeshopt.glb",
    "cesium-man/CesiumMan.gltf",
    "cesium-milk-truck/CesiumMilkTruck.gltf",
    "chr-knight/chr_knight.glb",
    "cornell-box/CornellBox.glb",
    "dense-sphere-draco-quantized/DenseSphere.glb",
    "egyptian-cat-webp/cat.glb",
    "glass-table/glass-table.glb",
    "house/house.glb",
    "low-poly-tree/low-poly-tree.glb",
    "many-cubes/many-cubes.gltf",
    "morph-primitives-test/MorphPrimitivesTest.gltf",
    "nested/nested.glb",
    "no-indices-3-story-building/no_indices_3storybuilding.glb",
    "palm-tree/PalmTree.gltf",
    "pirate-meshopt/pirate.glb",
    "playcanvas-cube/playcanvas-cube.glb",
    "retroufo/retroufo.glb",
    "shape-collection/ShapeCollection.glb",
    "ship-light-draco/model.gltf",
    "skater-female-draco/model.gltf",
    "simple-instancing/simple-instancing.glb",
    "terrain-low-poly/terrain.glb",
    "testplate/testplate.glb",
    "torus/torus.gltf",
    "tower-draco/model.gltf",
    "van-draco/model.gltf",
    "vr-gallery/vr-gallery.glb",
];

pub fn run() -> ExitCode {
    run_program("drawing", |arguments| {
        let scenes = project_root().join("scenes/models");
        let mut models = glb_files(&scenes)?;
        if let Some(assets) = data_folder("ASSETS", "assets")? {
            let folder = assets.join("models");
            let listed = MODELS.iter().map(|name| (*name).to_owned());
            // Any other model in the folder can be selected by its path.
            let others = arguments.filters().iter().filter(|name| folder.join(name).is_file());
            models.extend(listed.chain(others.cloned()).map(|name| (folder.join(&name), name)));
        }
        models.retain(|(_, name)| arguments.select(name));
        models.dedup();
        let mut tally = check_models(&models);
        if arguments.select("random") {
            let numbers = sample_cases("random scenes", (0..random::COUNT).collect());
            tally += random::check_random_scenes(numbers, &scenes)?;
        }
        Ok(tally)
    })
}

/// Returns the path and name of each scene model that has faces.
fn glb_files(folder: &Path) -> Result<Vec<(PathBuf, String)>, String> {
    let entries = std::fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut names: Vec<String> =
        names.filter(|name| name.ends_with(".glb") && !WITHOUT_FACES.contains(&&**name)).collect();
    names.sort();
    Ok(names.into_iter().map(|name| (folder.join(&name), format!("scenes/{name}"))).collect())
}

/// Checks models, two at a time, and prints a line for each.
fn check_models(models: &[(PathBuf, String)]) -> Tally {
    let results = map_parallel(models, |_, (path, name)| {
        let exception = EXCEPTIONS.iter().find(|(other, ..)| other == name);
        let allowed = exception.map_or(MAX_DISAGREEMENT, |(_, allowed, _)| *allowed);
        let result = check_model(path, allowed);
        if let Ok(summary) = &result {
            println!("{name:60} {summary}");
        }
        result.map(|_| ())
    });
    let mut tally = Tally::default();
    for ((_, name), result) in models.iter().zip(results) {
        tally.record(name, result);
    }
    tally
}

/// Draws a model from all directions; returns the worst disagreement of each kind of view.
fn check_model(path: &Path, allowed: f64) -> Result<String, String> {
    let model = load(path, &ImportOptions::default()).map_err(|error| error.to_string())?;
    let model = Arc::new(model);
    let mut summary = String::new();
    for kind in ViewKind::ALL {
        let mut worst = 0.0_f64;
        for direction in 0..DIRECTIONS {
            let (agreement, drawing) = measure_agreement(&model, kind, direction)?;
            worst = worst.max(agreement.disagreement_ratio());
            if agreement.disagreement_ratio() > allowed {
                return Err(describe_disagreement(kind, direction, &agreement, &drawing));
            }
        }
        summary += &format!(" {kind:?} {:.4} %", worst * 100.0);
    }
    Ok(summary)
}

/// Returns the fraction that the z-buffer contradicts, and the lines that contribute most to it.
fn describe_disagreement(
    kind: ViewKind,
    direction: usize,
    agreement: &Agreement,
    drawing: &LineDrawing,
) -> String {
    let percent = agreement.disagreement_ratio() * 100.0;
    let mut message =
        format!("{kind:?} {direction}: the z-buffer hides {percent:.4}% of the visible length");
    let mut segments = agreement.denied_segments.clone();
    segments.sort_by(|a, b| b.1.total_cmp(&a.1));
    for (segment, length) in segments.into_iter().take(5) {
        message += &format!("\n  {length:.2} px of {:?}", drawing.segments[segment]);
    }
    message
}

/// Draws a model without its hidden edges and compares the drawing with the z-buffer.
fn measure_agreement(
    model: &Arc<Model>,
    kind: ViewKind,
    direction: usize,
) -> Result<(Agreement, LineDrawing), String> {
    let scene = build_scene(model, kind, direction)?;
    let agreement = |options: &DrawOptions| {
        let drawing =
            draw(&scene.drawing_subject(), options, 1).map_err(|error| error.to_string())?;
        let agreement = verify_with_z_buffer(&scene.drawing_subject(), &drawing.segments)
            .map_err(|error| error.to_string())?;
        Ok::<_, String>((agreement, drawing))
    };
    let (removed, drawing) = agreement(&DrawOptions::hidden_edges_removed())?;
    // The comparison must be able to fail: it must reject hidden edges that are drawn as visible.
    if kind == ViewKind::Perspective && direction == 0 {
        let (all, _) = agreement(&DrawOptions {
            hidden_edges: HiddenEdges::Ignored,
            ..DrawOptions::default()
        })?;
        if removed.visible_length < 0.5 * all.visible_length
            && all.disagreement_ratio() < 10.0 * MAX_DISAGREEMENT
        {
            let ratio = all.disagreement_ratio();
            return Err(format!("the z-buffer contradicts only a fraction {ratio} of all edges"));
        }
    }
    Ok((removed, drawing))
}
