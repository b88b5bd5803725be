//! `cargo xtask models`: the models of the scenes, made by code.
//!
//! The `.glb` files are committed so that a fresh clone has its pictures at once; `--check` says
//! whether they are still what the code makes. The same code gives the same bytes on every machine:
//! `+ − × ÷ √` and `libm` only.

mod bearing;
mod bezier;
mod boxes;
mod document;
mod finishes;
mod floor;
mod house;
mod lamp;
mod mesh;
mod mexican_hat;
mod palette;
mod primitives;
mod room;
mod spheres;
mod teapot;
mod teapot_patches;
mod tower;
mod vase;
mod wood;

use crate::Outcome;
use crate::workspace::{create_folder, list_files, project_root, relative_path};
use std::fs;
use std::path::PathBuf;

/// No model is larger: a clone should stay small.
const MAX_BYTES: usize = 300_000;

/// Every model's file name and its bytes.
fn all_models() -> Result<Vec<(&'static str, Vec<u8>)>, String> {
    let documents = [
        ("bearing.glb", bearing::bearing()),
        ("crate.glb", boxes::wooden_crate()?),
        ("floor.glb", floor::floor()),
        ("house.glb", house::solid_house()),
        ("house_edges.glb", house::house_edges()),
        ("lamp.glb", lamp::lamp()),
        ("mexican_hat.glb", mexican_hat::hat_surface()),
        ("mexican_hat_lines.glb", mexican_hat::hat_lines()),
        ("panes.glb", boxes::panes()?),
        ("primitives.glb", primitives::primitives()),
        ("room.glb", room::room()),
        ("finishes.glb", finishes::finishes()),
        ("spheres.glb", spheres::spheres()),
        ("table.glb", teapot::table_document()),
        ("teapot.glb", teapot::teapot()),
        ("tower.glb", tower::tower()),
        ("vase.glb", vase::vase()),
    ];
    Ok(documents.into_iter().map(|(name, document)| (name, document.into_glb())).collect())
}

fn models_folder() -> PathBuf {
    project_root().join("scenes/models")
}

pub fn run_models(arguments: &[String]) -> Outcome {
    match arguments {
        [] => write_models(),
        [flag] if flag == "--check" => check_models(),
        _ => Err("say `models` or `models --check`".into()),
    }
}

fn write_models() -> Outcome {
    create_folder(&models_folder())?;
    for (name, bytes) in all_models()? {
        let path = models_folder().join(name);
        if fs::read(&path).is_ok_and(|found| found == bytes) {
            continue;
        }
        fs::write(&path, &bytes).map_err(|error| format!("{}: {error}", path.display()))?;
        println!("{} {} bytes", relative_path(&path), bytes.len());
    }
    Ok(())
}

fn check_models() -> Outcome {
    let mut faults = Vec::new();
    let models = all_models()?;
    for (name, bytes) in &models {
        if fs::read(models_folder().join(name)).ok().as_ref() != Some(bytes) {
            faults.push(format!("scenes/models/{name} is not what the code makes"));
        }
        if bytes.len() > MAX_BYTES {
            faults.push(format!(
                "scenes/models/{name} has {} bytes, more than {MAX_BYTES}",
                bytes.len()
            ));
        }
    }
    for path in list_files(&models_folder(), "glb")? {
        if !models.iter().any(|(name, _)| path.ends_with(name)) {
            faults.push(format!("{} is made by no code", relative_path(&path)));
        }
    }
    if faults.is_empty() {
        println!("{} models are what the code makes", models.len());
        return Ok(());
    }
    faults.push("`cargo xtask models` writes them anew".into());
    Err(faults.join("\n  "))
}

#[cfg(test)]
mod tests;
