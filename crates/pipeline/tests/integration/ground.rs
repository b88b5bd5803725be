//! Shadow-catching ground in framed pictures.

use camera::{NamedView, Slopes, frame_perspective};
use homog::PixelRect;
use pipeline::scene::file::{EnvironmentFile, GroundFile, ShadowsFile};
use pipeline::scene::parse_scene;
use pipeline::{Origin, Picture, RenderContext, Renderer, Scene, Textures, render};
use std::path::PathBuf;

/// The alpha above which the picture's border visibly cuts something off: 3%.
const MAX_BORDER_ALPHA: u8 = 8;

fn model_path(name: &str) -> PathBuf {
    PathBuf::from(format!("{}/../../scenes/models/{name}.glb", env!("CARGO_MANIFEST_DIR")))
}

/// Returns the scene of a bare model as the program draws it, at this size, with or without
/// shadow-catching ground.
fn bare_model(name: &str, size: (u32, u32), ground: Option<GroundFile>) -> Scene {
    let (origin, mut file) = Origin::from_model_path(&model_path(name));
    (file.ground, file.image.size) = (ground, size);
    Scene::resolve(&origin, &file, &Default::default()).expect("a scene")
}

#[test]
fn shadows_of_bare_models_are_inside_the_picture() {
    for name in ["teapot", "crate", "vase", "table", "house"] {
        for size in [(320, 200), (160, 240)] {
            let scene = bare_model(name, size, Some(GroundFile::DEFAULT));
            let picture = render(&scene, 2).expect("a picture");
            let (width, height) = size;
            let alpha = |x: u32, y: u32| picture.pixels[(y * width + x) as usize][3];
            let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
            let is_border = |x: u32, y: u32| x == 0 || y == 0 || x + 1 == width || y + 1 == height;
            let on_border = all.clone().filter(|&(x, y)| is_border(x, y));
            let most = on_border.map(|(x, y)| alpha(x, y)).max();
            // The key light's shadow does not reach the border, but faint ambient occlusion may.
            assert!(most < Some(MAX_BORDER_ALPHA), "{name} {size:?}: {most:?}");
            let shadow = |&(x, y): &(u32, u32)| {
                let [r, g, b, a] = picture.pixels[(y * width + x) as usize];
                [r, g, b] == [0; 3] && a > 40
            };
            let count = all.filter(shadow).count();
            assert!(count > 30, "{name} {size:?}: {count}");
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
        // The same applies if shadows may extend beyond the picture, but the parts inside it are
        // visible.
        let cropped = GroundFile::Shadow { height: None, framed: false };
        let cropped = bare_model(name, size, Some(cropped));
        assert_eq!(cropped.view_projection.camera, framing.camera, "{name}");
        let with = render(&cropped, 1).expect("a picture");
        assert_ne!(with.pixels, render(&scene, 1).expect("a picture").pixels, "{name}");
    }
}

#[test]
fn light_from_low_angles_moves_the_camera_back_only_moderately() {
    let distance = |direction: &str| {
        let text = format!(
            r#"Scene(models: [(path: "crate.glb")], ground: Shadow(),
            lights: [Directional(direction: {direction}, intensity: 3)])"#
        );
        let file = parse_scene("low.ron", &text).expect("a scene");
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

/// Returns the scene of a bare model that is lit only by light from all directions.
fn model_in_uniform_light(name: &str, size: (u32, u32), shadows: Option<ShadowsFile>) -> Scene {
    let (origin, mut file) = Origin::from_model_path(&model_path(name));
    (file.ground, file.image.size) = (Some(GroundFile::DEFAULT), size);
    (file.lights, file.environment, file.shadows) =
        (Some(Vec::new()), Some(EnvironmentFile::STUDIO), shadows);
    Scene::resolve(&origin, &file, &Default::default()).expect("a scene")
}

#[test]
fn models_in_uniform_light_have_contact_shadows() {
    for name in ["teapot", "crate"] {
        let size = (240, 180);
        let scene = model_in_uniform_light(name, size, None);
        let picture = render(&scene, 2).expect("a picture");
        assert!(picture == render(&scene, 1).expect("a picture"), "{name}: with one thread");
        let alphas: Vec<u8> =
            picture.pixels.iter().filter(|p| p[..3] == [0; 3]).map(|p| p[3]).collect();
        // The shadow is dark at the foot of the model.
        let dark = alphas.iter().filter(|&&alpha| alpha > 90).count();
        assert!(dark > 20, "{name}: {dark}");
        let off = model_in_uniform_light(name, size, Some(ShadowsFile::Off));
        let bare = render(&off, 2).expect("a picture");
        assert!(bare.pixels.iter().all(|p| p[3] == 0 || p[..3] != [0; 3]), "{name}: no shadows");
    }
}

#[test]
fn regions_with_contact_shadows_match_the_whole_picture() {
    let scene = model_in_uniform_light("teapot", (160, 120), None);
    let whole = render(&scene, 1).expect("a picture");
    let (textures, mut renderer) = (Textures::for_scene(&scene), Renderer::default());
    let context = RenderContext::new(&scene, &textures, 3);
    let mut prepared = renderer.prepare(&context).expect("a scene");
    let region = PixelRect { x: 31, y: 50, width: 99, height: 60 };
    let mut part = Picture::<u8>::default();
    prepared.render_region(region, &mut part).expect("a region");
    for (x, y) in (0..region.height).flat_map(|y| (0..region.width).map(move |x| (x, y))) {
        let expected = whole.pixels[((y + region.y) * 160 + x + region.x) as usize];
        assert_eq!(part.pixels[(y * region.width + x) as usize], expected);
    }
}

/// Renders a lamp in directional light on shadow-catching ground, with additional scene fields.
fn lamp_picture(fields: &str) -> Picture {
    let text = format!(
        r#"Scene(models: [(path: "lamp.glb")], ground: Shadow(), shadows: On(),
        lights: [Directional(direction: (-1, -2, -1), intensity: 2.5)], {fields})"#
    );
    let file = parse_scene("lamp.ron", &text).expect("a scene");
    let folder = model_path("lamp").parent().expect("a folder").to_path_buf();
    let origin = Origin::from_text("lamp.ron", text, folder);
    let scene = Scene::resolve(&origin, &file, &Default::default()).expect("a scene");
    render(&scene, 2).expect("a picture")
}

/// The shadow extends behind the models, beyond the far plane that encloses the models.
#[test]
fn shadows_behind_models_darken_every_background() {
    let camera = |projection: &str| {
        let size = "size: (160, 120), samples: 1";
        format!("camera: (projection: {projection}), image: ({size}, background: BACKGROUND)")
    };
    for projection in ["Perspective()", "Orthographic()"] {
        let fields = camera(projection);
        let plain = lamp_picture(&fields.replace("BACKGROUND", "Color(\"white\")"));
        let gradient = r##"Gradient(colors: ["#fff", "#fff"])"##;
        let gradient = lamp_picture(&fields.replace("BACKGROUND", gradient));
        let differing = count_differing(&plain, &gradient);
        assert_eq!(differing, 0, "{projection}");
    }
    let around = |projection: &str| {
        let fields = camera(projection).replace("BACKGROUND", "Environment()");
        lamp_picture(&format!("environment: Uniform(), {fields}"))
    };
    for (tight, wide) in
        [("Perspective()", "Perspective(far: 1000)"), ("Orthographic()", "Orthographic(far: 1000)")]
    {
        let differing = count_differing(&around(tight), &around(wide));
        // Depths round differently where surfaces meet.
        assert!(differing < 20, "{tight}: {differing}");
    }
}

/// Counts the pixels that differ by more than a rounding error.
fn count_differing(one: &Picture, other: &Picture) -> usize {
    let differs = |(a, b): &(&[u8; 4], &[u8; 4])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 2);
    one.pixels.iter().zip(&other.pixels).filter(differs).count()
}
