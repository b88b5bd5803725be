//! The cost of each shading feature, measured on the flight helmet at 1080p in studio light, with
//! one feature added or removed.
//!
//! There is one scene per feature. They are rendered in turn in this process, with one thread. The
//! base is the program's default picture: four samples, every material map, an environment, no
//! shadows.

use crate::measure::{Contestant, Series, rounds};
use model::{Anisotropy, Clearcoat, Iridescence, MaterialExtensions, Sheen, Transmission, Volume};
use pipeline::{Origin, Picture, RenderContext, Renderer, Textures};
use scene::{ResolveOptions, Scene};
use scene_file::parse_scene;
use std::path::Path;
use std::sync::Arc;

/// The name of the base that the others are compared with.
pub const BASE: &str = "default picture";

/// Each feature with its changes to the base: scene fields such as lights, image fields, and
/// materials.
const FEATURES: [(&str, &str, &str, Change); 19] = [
    (BASE, "", "", AS_IT_IS),
    ("flat style", "style: Flat", "", AS_IT_IS),
    ("one sun, no environment", "environment: Dark", "", AS_IT_IS),
    ("sky", "environment: Sky()", "", AS_IT_IS),
    (
        "sun and studio",
        "lights: [Directional(intensity: 2, direction: (-1, -2, -1))]",
        "",
        AS_IT_IS,
    ),
    ("… casting shadows", SUN_WITH_SHADOWS, "", AS_IT_IS),
    ("… on the ground", SUN_ON_THE_GROUND, "", AS_IT_IS),
    ("spot casting shadows", SPOT_WITH_SHADOWS, "", AS_IT_IS),
    ("ambient occlusion", "ambient_occlusion: AmbientOcclusion()", "", AS_IT_IS),
    ("tone curve AgX", "", "tone_mapping: AgX", AS_IT_IS),
    ("1 sample", "", "samples: 1", AS_IT_IS),
    ("16 samples", "", "samples: 16", AS_IT_IS),
    ("anisotropic textures off", "", "max_anisotropy: 1", AS_IT_IS),
    ("clearcoat", "", "", |of| {
        of.clearcoat = Some(Box::new(Clearcoat { factor: 1.0, ..Default::default() }))
    }),
    ("sheen", "", "", |of| {
        of.sheen = Some(Box::new(Sheen { color: [0.5; 3], roughness: 0.5, ..Default::default() }))
    }),
    ("iridescence", "", "", |of| {
        of.iridescence = Some(Box::new(Iridescence { factor: 1.0, ..Default::default() }))
    }),
    ("anisotropy", "", "", |of| {
        of.anisotropy = Some(Box::new(Anisotropy { strength: 0.7, ..Default::default() }))
    }),
    ("gray glass", "", "", |of| of.transmission = Some(Box::new(GLASS))),
    ("colored glass", "", "", |of| {
        of.transmission = Some(Box::new(GLASS));
        of.volume = Some(Box::new(TINT));
    }),
];

/// The changes to every material.
type Change = fn(&mut MaterialExtensions);

const AS_IT_IS: Change = |_| {};
const SUN_WITH_SHADOWS: &str =
    "lights: [Directional(intensity: 2, direction: (-1, -2, -1), shadows: On())]";
const SUN_ON_THE_GROUND: &str =
    "lights: [Directional(intensity: 2, direction: (-1, -2, -1), shadows: On())], ground: Shadow()";
const SPOT_WITH_SHADOWS: &str =
    "lights: [Spot(position: (1, 1.5, 1), direction: (-1, -1.2, -1), intensity: 6, shadows: On())]";
const GLASS: Transmission = Transmission { factor: 0.6, texture: None };
const TINT: Volume = Volume {
    thickness: 0.01,
    thickness_texture: None,
    attenuation_distance: 0.01,
    attenuation_color: [0.3, 0.8, 0.6],
};

/// Draws every feature in each round, and returns the times, starting with the base.
pub fn features(models: &Path, count: usize) -> Result<Vec<Series>, String> {
    eprintln!("features: FlightHelmet");
    let folder = models.join("flight-helmet");
    let mut contestants = Vec::new();
    for (name, fields, image, change) in FEATURES {
        let mut scene = scene(fields, image, &folder)?;
        for placed in &mut scene.models {
            let model = Arc::make_mut(&mut placed.model);
            model.materials.iter_mut().for_each(|material| change(&mut material.extensions));
        }
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
    let file = parse_scene("feature.ron", &text).map_err(|error| error.to_string())?;
    let origin = Origin::from_text("feature.ron", text, folder.to_owned());
    Scene::resolve(&origin, &file, &ResolveOptions::default()).map_err(|error| error.to_string())
}

/// Renders the scene repeatedly, reusing the memory of the first rendering.
fn frames(scene: Scene) -> Result<Box<dyn FnMut()>, String> {
    // Each scene is leaked. That is acceptable, because there are few.
    let scene: &'static Scene = Box::leak(Box::new(scene));
    let textures = Textures::for_models(&scene.models);
    let mut renderer = Renderer::default();
    let mut picture: Picture = Picture::default();
    let context = RenderContext::new(scene, &textures, 1);
    renderer.render(&context, &mut picture).map_err(|e| e.to_string())?;
    Ok(Box::new(move || {
        // The scene has just been rendered, so this cannot fail.
        let context = RenderContext::new(scene, &textures, 1);
        let _ = renderer.render(&context, &mut picture);
    }))
}
