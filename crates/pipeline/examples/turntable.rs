//! Renders a turntable of a model: twelve views of a full turn, two at a time. The model is
//! loaded once.
//!
//! Run it with `cargo run -p alberti-pipeline --example turntable -- model.glb frames`.

use pipeline::sequence::{Motion, Sequence};
use pipeline::{Origin, Scene};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut names = std::env::args().skip(1);
    let (model, folder) = names.next().zip(names.next()).ok_or("usage: turntable MODEL FOLDER")?;
    let (origin, mut file) = Origin::from_model_path(model.as_ref());
    file.image.size = (320, 240);
    let scene = Scene::resolve(&origin, &file, &Default::default())?;
    let motion = Motion::Turntable { angle: std::f64::consts::TAU };
    let sequence = Sequence::new(&origin, &file, scene, motion, 12)?;
    sequence.render_frames(2, |frame, picture| {
        picture.write_png(format!("{folder}/{frame:02}.png").as_ref())
    })?;
    Ok(())
}
