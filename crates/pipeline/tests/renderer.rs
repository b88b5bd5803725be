//! Pictures that are rendered one after the other are those that are rendered alone, and take no memory anew.

use pipeline::{Cancel, Origin, Picture, RenderError, Renderer, Scene, Textures, Timings, render};
use std::path::Path;

/// A scene of the project, small.
fn scene(name: &str, size: (u32, u32)) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name);
    let (origin, mut file) = Origin::read(&path).expect("a scene of the project");
    file.image.size = size;
    Scene::resolve(&origin, &file, &Default::default()).expect("a scene that makes sense")
}

fn next(renderer: &mut Renderer, scene: &Scene, textures: &Textures<'_>, picture: &mut Picture) {
    let silent = Timings::default();
    renderer.render(scene, textures, 1, &silent, picture).expect("a picture");
}

#[test]
fn a_second_picture_allocates_but_short_lists() {
    for name in ["crates.ron", "panes.ron", "product.ron", "room.ron", "shadows.ron", "teapot.ron"]
    {
        let scene = scene(name, (160, 120));
        let models = scene.models.clone();
        let textures = Textures::of(&models);
        let (mut renderer, mut picture) = (Renderer::default(), Picture::default());
        let mut draw = || next(&mut renderer, &scene, &textures, &mut picture);
        let first = allocation_counter::measure(&mut draw);
        let second = allocation_counter::measure(&mut draw);
        assert!(first.bytes_total > 100_000, "{name}: {first:?}");
        // Lists of nodes and of each draw's textures: nothing that grows with vertices or pixels.
        // Each shadow map walks the nodes anew.
        let maps = scene.lights.iter().filter(|light| light.shadow().is_some()).count() as u64;
        assert!(second.bytes_total < 20_000 + 4000 * maps, "{name}: {second:?}");
    }
}

#[test]
fn pictures_do_not_depend_on_those_before() {
    let (mut renderer, mut picture) = (Renderer::default(), Picture::default());
    for (name, size) in [
        ("crates.ron", (160, 120)),
        ("panes.ron", (75, 200)),
        ("primitives.ron", (160, 120)),
        ("teapot.ron", (33, 21)),
    ] {
        let scene = scene(name, size);
        let textures = Textures::of(&scene.models);
        next(&mut renderer, &scene, &textures, &mut picture);
        assert!(picture == render(&scene, 2).expect("a picture"), "{name}");
    }
}

#[test]
fn a_cancelled_picture_ends_with_an_error_and_the_renderer_is_told_nothing_else() {
    let scene = scene("crates.ron", (160, 120));
    let textures = Textures::of(&scene.models);
    let cancel = Cancel::default();
    let mut renderer = Renderer::default().cancelled_by(cancel.clone());
    let mut picture = Picture::default();
    let mut draw = |renderer: &mut Renderer| {
        renderer.render(&scene, &textures, 2, &Timings::default(), &mut picture)
    };
    assert!(draw(&mut renderer).is_ok(), "nobody has cancelled it yet");
    cancel.cancel();
    assert!(matches!(draw(&mut renderer), Err(RenderError::Cancelled)));
    let mut again = renderer.cancelled_by(Cancel::default());
    assert!(draw(&mut again).is_ok());
    assert!(picture == render(&scene, 1).expect("a picture"));
}
