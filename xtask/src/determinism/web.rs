//! Compares the explorer's pictures from WebAssembly, run in Node, with the program's: a different
//! instruction set must produce the same bytes.

use crate::Outcome;
use crate::program::Program;
use crate::skip::report_skip;
use crate::web::{self, Answers, Request};
use crate::workspace::{create_folder, list_files, project_root, target_folder};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// States in addition to the default of each lesson: models with textures, glass, lights and
/// shadows, and several styles.
const STATES: &[&str] = &[
    "lesson=model&model=models/teapot.glb",
    "lesson=model&model=models/finishes.glb",
    "lesson=model&model=models/panes.glb",
    "lesson=model&model=models/lamp.glb",
    "lesson=model&model=models/crate.glb",
    "lesson=model&model=models/spheres.glb",
    "lesson=model&model=models/mexican_hat.glb",
    "lesson=model&model=models/bearing.glb",
    "lesson=model&model=models/tower.glb&style=Clay",
    "lesson=model&model=models/teapot.glb&style=Toon",
    "lesson=model&model=models/vase.glb&style=XRay",
    "lesson=model&model=models/room.glb&style=Lines",
];

/// The minimum number of pictures to compare.
const MIN_PICTURES: usize = 20;

/// Renders the explorer's pictures with WebAssembly and with the program, and compares the bytes.
/// The comparison is reported as skipped if WebAssembly cannot be built.
pub fn compare_web(program: &Program) -> Outcome {
    if let Some(missing) = web::missing_tools() {
        report_skip("WebAssembly pictures", &missing);
        return Ok(());
    }
    let site = web::site_folder();
    web::build_site(&site)?;
    let models = scene_models()?;
    let states = all_states(&site)?;
    let requests: Vec<Request> = states.iter().enumerate().flat_map(requests_of).collect();
    let answers = Answers::ask(&site, &models, &requests)?;
    let folder = target_folder().join("determinism/web");
    create_folder(&folder)?;
    let mut differences = Vec::new();
    for (number, state) in states.iter().enumerate() {
        let json: Value = serde_json::from_slice(answers.bytes(&format!("{number}.json"))?)
            .map_err(|error| format!("{state}: {error}"))?;
        let scene = json["scene"].as_str().ok_or_else(|| format!("{state}: no scene"))?;
        let picture = folder.join(format!("{number}.png"));
        program.render_text(scene, &project_root().join("scenes"), &picture)?;
        let drawn =
            fs::read(&picture).map_err(|error| format!("{}: {error}", picture.display()))?;
        if drawn != answers.bytes(&format!("{number}.png"))? {
            differences.push(format!("{state}: {}", picture.display()));
        }
    }
    if !differences.is_empty() {
        let list = differences.join("\n  ");
        return Err(format!("WebAssembly and the program render different pictures\n  {list}"));
    }
    println!("{} explorer pictures have the same bytes in WebAssembly", states.len());
    Ok(())
}

/// Returns the default state of each lesson, followed by `STATES`.
fn all_states(site: &Path) -> Result<Vec<String>, String> {
    let lessons = web::list_lessons(site)?;
    // The lesson `model` has no picture before a model is chosen.
    let ids = lessons.iter().filter(|lesson| lesson["models"][0].is_string());
    let ids = ids.filter_map(|lesson| lesson["id"].as_str());
    let mut states: Vec<String> = ids.map(|id| format!("lesson={id}")).collect();
    states.extend(STATES.iter().map(|&state| state.to_owned()));
    if states.len() < MIN_PICTURES {
        return Err(format!("only {} states: at least {MIN_PICTURES} are required", states.len()));
    }
    Ok(states)
}

/// Returns two requests: for the scene of a state and for its picture.
fn requests_of((number, state): (usize, &String)) -> [Request; 2] {
    [("json", "state"), ("png", "picture&format=png")].map(|(ending, what)| Request {
        name: format!("{number}.{ending}"),
        query: format!("v=1&{state}&what={what}"),
    })
}

/// Returns the scene models with their names in scene files.
fn scene_models() -> Result<Vec<(String, PathBuf)>, String> {
    let paths = list_files(&project_root().join("scenes/models"), "glb")?;
    let name = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        format!("models/{name}")
    };
    Ok(paths.into_iter().map(|path| (name(&path), path)).collect())
}
