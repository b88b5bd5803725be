//! Resolves a scene file and describes the result, including its lints.
//!
//! Run it with `cargo run -p alberti-scene --example describe_scene -- scene.ron`.
#![allow(clippy::print_stdout, reason = "examples print their results")]

use scene::{Origin, ResolveOptions, Scene, lint_scene};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).ok_or("pass the path of a scene file")?;
    let options = ResolveOptions::default();
    let (origin, file) = Origin::read_scene(path.as_ref())?;
    let scene = Scene::resolve(&origin, &file, &options)?;
    println!(
        "{}: {} lights, {} insets",
        scene.model_names(),
        scene.lights.len(),
        scene.insets.len()
    );
    for lint in lint_scene(&origin, &file, &scene, &options) {
        println!("{}: {}", lint.code, lint.error);
    }
    Ok(())
}
