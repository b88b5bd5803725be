//! The ground that shows shadows: what a framed picture shows of it.

use camera::{NamedView, Slopes, frame_perspective};
use pipeline::scene::file::GroundFile;
use pipeline::{Origin, Scene, render};
use std::path::PathBuf;

fn model_path(name: &str) -> PathBuf {
    PathBuf::from(format!("{}/../../scenes/models/{name}.glb", env!("CARGO_MANIFEST_DIR")))
}

/// A bare model as the program draws it, at this size, on ground that shows shadows or without.
fn bare_model(name: &str, size: (u32, u32), ground: Option<GroundFile>) -> Scene {
    let (origin, mut file) = Origin::from_model_path(&model_path(name));
    (file.ground, file.image.size) = (ground, size);
    Scene::resolve(&origin, &file, &Default::default()).expect("a scene")
}

#[test]
fn shadows_of_bare_models_are_inside_of_the_picture() {
    for name in ["teapot", "crate", "vase", "table", "tower", "house"] {
        for size in [(320, 200), (160, 240)] {
            let scene = bare_model(name, size, Some(GroundFile::DEFAULT));
            let picture = render(&scene, 2).expect("a picture");
            let (width, height) = size;
            let alpha = |x: u32, y: u32| picture.pixels[(y * width + x) as usize][3];
            let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
            let is_border = |x: u32, y: u32| x == 0 || y == 0 || x + 1 == width || y + 1 == height;
            let on_border = all.clone().filter(|&(x, y)| is_border(x, y));
            let most = on_border.map(|(x, y)| alpha(x, y)).max();
            assert_eq!(most, Some(0), "{name} {size:?}");
            let shadow = |&(x, y): &(u32, u32)| {
                let [r, g, b, a] = picture.pixels[(y * width + x) as usize];
                [r, g, b] == [0; 3] && a > 40
            };
            let count = all.filter(shadow).count();
            assert!(count > 150, "{name} {size:?}: {count}");
        }
    }
}

#[test]
fn without_ground_only_the_model_is_framed() {
    let size = (320, 200);
    for name in ["teapot", "table"] {
        let scene = bare_model(name, size, None);
        let slopes = Slopes::vertical_angle(35_f64.to_radians(), 1.6).expect("a frame");
        let basis = NamedView::ThreeQuarter.basis();
        let framing = frame_perspective(scene.world_points(), basis, slopes, 0.05).expect("a view");
        assert_eq!(scene.view_projection.camera, framing.camera, "{name}");
        let on_ground = bare_model(name, size, Some(GroundFile::DEFAULT));
        assert_ne!(on_ground.view_projection.camera, framing.camera, "{name}");
    }
}

#[test]
fn shadows_of_low_light_do_not_push_the_model_away() {
    let distance = |direction: &str| {
        let text = format!(
            r#"Scene(models: [(path: "crate.glb")], ground: Shadow(),
            lights: [Directional(direction: {direction}, intensity: 3)])"#
        );
        let file = pipeline::scene::parse_scene("low.ron", &text).expect("a scene");
        let folder = model_path("crate").parent().expect("a folder").to_path_buf();
        let origin = Origin::from_text("low.ron", text, folder);
        let scene = Scene::resolve(&origin, &file, &Default::default()).expect("a scene");
        scene.view_projection.camera.eye().raw().length()
    };
    let (high, low, level) =
        (distance("(1, -3, -0.5)"), distance("(1, -0.2, -0.5)"), distance("(1, -0.0001, -0.5)"));
    assert!(high < low && low <= level && level < 2.2 * high, "{high} {low} {level}");
    // Light from below casts no shadow on the ground.
    assert!(distance("(1, 0.2, -0.5)") < high);
}
