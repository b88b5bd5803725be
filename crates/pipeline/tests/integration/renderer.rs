//! A renderer's second picture is bit-identical to a separate rendering and needs no new large
//! allocations.

use pipeline::{
    CancelToken, Monitor, Origin, Picture, RenderContext, RenderError, Renderer, Scene, Textures,
    render,
};
use std::path::Path;
use std::sync::Arc;

/// Loads a scene from the repository at a small size.
fn load_scene(name: &str, size: (u32, u32)) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name);
    let (origin, mut file) = Origin::read_scene(&path).expect("a scene in the repository");
    file.image.size = size;
    Scene::resolve(&origin, &file, &Default::default()).expect("a valid scene")
}

fn render_next(
    renderer: &mut Renderer,
    scene: &Scene,
    textures: &Textures<'_>,
    picture: &mut Picture,
) {
    renderer.render(&RenderContext::new(scene, textures, 1), picture).expect("a picture");
}

#[test]
fn a_second_picture_allocates_only_short_lists() {
    for name in ["crates.ron", "panes.ron", "product.ron", "room.ron", "shadows.ron", "teapot.ron"]
    {
        let scene = load_scene(name, (160, 120));
        let models = scene.models.clone();
        let textures = Textures::for_models(&models);
        let (mut renderer, mut picture) = (Renderer::default(), Picture::default());
        let mut draw = || render_next(&mut renderer, &scene, &textures, &mut picture);
        let first = allocation_counter::measure(&mut draw);
        let second = allocation_counter::measure(&mut draw);
        assert!(first.bytes_total > 100_000, "{name}: {first:?}");
        // Only lists of nodes and of each draw's textures are allocated, and nothing that grows
        // with vertices or pixels. Each shadow map traverses the nodes again.
        let maps = scene.lights.iter().filter(|light| light.shadow().is_some()).count() as u64;
        // Ground occlusion allocates a grid of at most 192 × 192 cells for every picture.
        let has_grid = scene.ground.is_some_and(|ground| ground.occlusion.is_some());
        let grid = if has_grid { 192 * 192 * 24 } else { 0 };
        assert!(second.bytes_total < 20_000 + 4000 * maps + grid, "{name}: {second:?}");
    }
}

#[test]
fn pictures_do_not_depend_on_earlier_pictures() {
    let (mut renderer, mut picture) = (Renderer::default(), Picture::default());
    for (name, size) in [
        ("crates.ron", (160, 120)),
        ("panes.ron", (75, 200)),
        ("primitives.ron", (160, 120)),
        ("teapot.ron", (33, 21)),
        // Insets, line drawings and overlays after surfaces.
        ("viewports.ron", (160, 120)),
        ("technical.ron", (160, 120)),
        ("view_volume.ron", (160, 120)),
        ("crates.ron", (160, 120)),
    ] {
        let scene = load_scene(name, size);
        let textures = Textures::for_models(&scene.models);
        render_next(&mut renderer, &scene, &textures, &mut picture);
        assert!(picture == render(&scene, 2).expect("a picture"), "{name}");
    }
}

#[test]
fn canceling_is_an_error_and_the_renderer_can_be_reused() {
    let scene = load_scene("crates.ron", (160, 120));
    let textures = Textures::for_models(&scene.models);
    let (cancel, mut renderer) = (CancelToken::default(), Renderer::default());
    let mut picture = Picture::default();
    let context = RenderContext::new(&scene, &textures, 2);
    let monitor: Arc<dyn Monitor> = Arc::new(cancel.clone());
    let cancellable = context.with_monitor(&monitor);
    assert!(renderer.render(&cancellable, &mut picture).is_ok(), "not canceled yet");
    cancel.cancel();
    let result = renderer.render(&cancellable, &mut picture);
    assert!(matches!(result, Err(RenderError::Canceled)));
    assert!(renderer.render(&context, &mut picture).is_ok());
    assert!(picture == render(&scene, 1).expect("a picture"));
}
