//! Renders a depth map of a model: for each pixel, the distance from the eye to the surface along
//! the view axis, in model units.
//!
//! Run it with `cargo run -p alberti-pipeline --example depth_map -- model.glb depth.npy`.
#![allow(clippy::print_stdout, reason = "an example prints its results")]

use pipeline::render::passes::{Pass, render_passes};
use pipeline::{Origin, Scene, Timings};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut names = std::env::args().skip(1);
    let (model, output) = names.next().zip(names.next()).ok_or("usage: depth_map MODEL FILE")?;
    let (origin, file) = Origin::from_model_path(model.as_ref());
    let scene = Scene::resolve(&origin, &file, &Default::default())?;
    let whole = scene.image.pixel_rect();
    let depths = render_passes(&scene, whole, &[Pass::Depth], 2, &Timings::default())?;
    let [depth] = depths.as_slice() else { return Err("expected one pass".into()) };
    println!("depth at the center: {:?}", depth.float_values(depth.width / 2, depth.height / 2));
    Ok(pipeline::write_file(output.as_ref(), &depth.to_npy())?)
}
