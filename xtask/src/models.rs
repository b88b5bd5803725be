//! `cargo xtask models`: writes `scenes/models` from the code in `scenes/generator`, or checks that
//! they match.

use crate::Outcome;
use crate::workspace::{create_folder, list_files, project_root, relative_path};
use scene_models::{MAX_BYTES, all_models};
use std::fs;
use std::path::PathBuf;

fn models_folder() -> PathBuf {
    project_root().join("scenes/models")
}

/// Writes the models or, if `--check` is given, compares them with the committed ones.
pub fn run_models(arguments: &[String]) -> Outcome {
    match arguments {
        [] => write_models(),
        [flag] if flag == "--check" => check_models(),
        _ => Err("use `models` or `models --check`".into()),
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
            faults.push(format!("scenes/models/{name} differs from what the code generates"));
        }
        if bytes.len() > MAX_BYTES {
            faults.push(format!(
                "scenes/models/{name} has {} bytes; at most {MAX_BYTES} are allowed",
                bytes.len()
            ));
        }
    }
    for path in list_files(&models_folder(), "glb")? {
        if !models.iter().any(|(name, _)| path.ends_with(name)) {
            faults.push(format!("no code generates {}", relative_path(&path)));
        }
    }
    if faults.is_empty() {
        println!("{} models match the code", models.len());
        return Ok(());
    }
    faults.push("run `cargo xtask models` to write them again".into());
    Err(faults.join("\n  "))
}
