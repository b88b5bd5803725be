//! Explains the color of a pixel: its triangles, the nearest surface point, and every stage.
//!
//! Run it with `cargo run -p alberti-explain --example explain_pixel -- model.glb 480 360`.
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use explain::{ApiConventions, TransformChain, explain_pixel};
use scene::{Origin, Scene};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let names: Vec<String> = std::env::args().skip(1).collect();
    let [model, column, row] = names.as_slice() else {
        return Err("specify a model, a column and a row".into());
    };
    let (origin, file) = Origin::from_model_path(model.as_ref());
    let scene = Scene::resolve(&origin, &file, &Default::default())?;
    let chain =
        TransformChain::new(&scene.view_projection, file.image.size, ApiConventions::Alberti)?;
    let explanation = explain_pixel(&chain, &scene, column.parse()?, row.parse()?)?;
    println!("{explanation}\nas JSON it has {} bytes", explanation.to_json().to_string().len());
    Ok(())
}
