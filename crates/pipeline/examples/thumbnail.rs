//! Renders a thumbnail of a model, framed and lit automatically, to memory and to a PNG.
//!
//! Run it with `cargo run -p alberti-pipeline --example thumbnail -- model.glb thumb.png`.
#![allow(clippy::print_stdout, reason = "an example prints its results")]

use pipeline::{Origin, Scene, render};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut names = std::env::args().skip(1);
    let (model, output) = names.next().zip(names.next()).ok_or("usage: thumbnail MODEL PICTURE")?;
    let (origin, mut file) = Origin::from_model_path(model.as_ref());
    file.image.size = (256, 256);
    let scene = Scene::resolve(&origin, &file, &Default::default())?;
    let picture = render(&scene, 2)?; // with two threads, which do not change the picture
    println!("{} pixels; the center pixel is {:?}", picture.pixels.len(), picture.pixel(128, 128));
    Ok(picture.write_png(output.as_ref())?)
}
