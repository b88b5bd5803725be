//! What each feature of the shading costs: the flight helmet at 1080p, lit by the studio, and the same with one thing more or less.
//!
//! One scene a feature, all rendered in this process by one thread, by turns; the base is the program's usual picture: four samples,
//! every map of the materials, an environment, no shadows.

use crate::measure::{Contestant, Series, rounds};
use pipeline::scene::{ResolveOptions, Scene, parse};
use pipeline::{Origin, Picture, Renderer, Textures, Timings};
use std::path::Path;

/// The name of the base, which the others are compared with.
pub const BASE: &str = "usual picture";

/// Each feature with what of the scene is other than in the base: lights and the like, and fields of the image.
const FEATURES: [(&str, &str, &str); 12] = [
    (BASE, "", ""),
    ("flat style", "style: Flat", ""),
    ("one sun, no environment", "environment: Dark", ""),
    ("sky", "environment: Sky()", ""),
    ("sun beside the studio", "lights: [Sun(lux: 2, direction: (-1, -2, -1))]", ""),
    ("… casting shadows", "lights: [Sun(lux: 2, direction: (-1, -2, -1), shadows: On())]", ""),
    (
        "… on the ground",
        "lights: [Sun(lux: 2, direction: (-1, -2, -1), shadows: On())], ground: Shadow()",
        "",
    ),
    ("ambient occlusion", "ambient_occlusion: AmbientOcclusion()", ""),
    ("tone curve AgX", "", "tone_mapping: AgX"),
    ("1 sample", "", "samples: 1"),
    ("16 samples", "", "samples: 16"),
    ("anisotropy 1", "", "anisotropy: 1"),
];

/// Draws every feature in each round; the times, the base's first.
pub fn features(models: &Path, count: usize) -> Result<Vec<Series>, String> {
    eprintln!("features: FlightHelmet");
    let folder = models.join("flight-helmet");
    let mut contestants = Vec::new();
    for (name, fields, image) in FEATURES {
        let scene = scene(fields, image, &folder)?;
        contestants.push(Contestant { name: name.into(), work: frames(scene)? });
    }
    Ok(rounds(&mut contestants, count))
}

fn scene(fields: &str, image: &str, folder: &Path) -> Result<Scene, String> {
    let environment = if fields.contains("environment") { "" } else { "environment: Studio(), " };
    let text = format!(
        "Scene(models: [(path: \"FlightHelmet.gltf\")], {environment}{fields}{} image: (size: (1920, 1080), {image}))",
        if fields.is_empty() { "" } else { "," }
    );
    let file = parse("feature.ron", &text).map_err(|error| error.to_string())?;
    let origin = Origin::of_text("feature.ron", text, folder.to_owned());
    Scene::resolve(&origin, &file, &ResolveOptions::default()).map_err(|error| error.to_string())
}

/// Renders the scene again and again, in the memory of the first time.
fn frames(scene: Scene) -> Result<Box<dyn FnMut()>, String> {
    // As long as the process: there are few.
    let scene: &'static Scene = Box::leak(Box::new(scene));
    let textures = Textures::of(&scene.models);
    let mut renderer = Renderer::default();
    let mut picture: Picture = Picture::default();
    let silent = Timings::default();
    renderer.render(scene, &textures, 1, &silent, &mut picture).map_err(|e| e.to_string())?;
    Ok(Box::new(move || {
        // It could be rendered just before.
        let _ = renderer.render(scene, &textures, 1, &silent, &mut picture);
    }))
}
