//! Draws a model as an isometric line drawing with dashed hidden lines, and writes it as SVG.
//!
//! Run it with `cargo run -p alberti-pipeline --example isometric -- model.glb drawing.svg`.

use pipeline::scene::file::{ProjectionFile, StyleFile};
use pipeline::{Origin, Scene, Timings, draw_lines, write_file};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut names = std::env::args().skip(1);
    let (model, output) = names.next().zip(names.next()).ok_or("usage: isometric MODEL DRAWING")?;
    let (origin, mut file) = Origin::from_model_path(model.as_ref());
    file.camera.projection = Some(ProjectionFile::Isometric);
    file.style = StyleFile::lines_hidden_dashed();
    let scene = Scene::resolve(&origin, &file, &Default::default())?;
    let page = draw_lines(&scene, 2, &Timings::default())?;
    Ok(write_file(output.as_ref(), page.to_svg().as_bytes())?)
}
