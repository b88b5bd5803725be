//! Renders a thousand scenes of one model from different viewpoints and in different light, and
//! writes each as RON with its picture.
//!
//! Run it with `cargo run --release -p alberti-pipeline --example thousand_scenes -- model.glb folder`.
#![allow(clippy::print_stdout, reason = "an example prints its results")]

use pipeline::scene::file::{CameraFile, LightFile, ModelFile};
use pipeline::{Origin, Scene, SceneFile, render};
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut names = std::env::args().skip(1);
    let (model, folder) =
        names.next().zip(names.next()).ok_or("usage: thousand_scenes MODEL FOLDER")?;
    let (model, folder) = (PathBuf::from(model), PathBuf::from(folder));
    std::fs::create_dir_all(&folder)?;
    let name = model.file_name().ok_or("MODEL must be a file")?.to_string_lossy().into_owned();
    let models = model.parent().unwrap_or("".as_ref()).to_owned();
    for number in 0..1000_u32 {
        // Circle the model while moving up and down.
        let turn = f64::from(number) * 0.1;
        let eye = [4.0 * libm::cos(turn), 2.0 + libm::sin(0.3 * turn), 4.0 * libm::sin(turn)];
        let mut file = SceneFile::new([ModelFile::new(&name)]);
        file.camera = CameraFile::look_at(eye, [0.0; 3]);
        file.lights = Some(vec![LightFile::directional([-1.0, -2.0, eye[0]], 3.0)?]);
        file.image.size = (64, 64);
        let text = file.to_ron()?;
        std::fs::write(folder.join(format!("{number:04}.ron")), &text)?;
        let origin = Origin::from_text("scene.ron", text, models.clone());
        let scene = Scene::resolve(&origin, &file, &Default::default())?;
        render(&scene, 1)?.write_png(&folder.join(format!("{number:04}.png")))?;
    }
    println!("wrote 1000 scenes and their pictures to {}", folder.display());
    Ok(())
}
