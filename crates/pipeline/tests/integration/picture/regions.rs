//! Regions, bands and image tiles: parts match the whole picture bit for bit, and 16-bit values
//! round to the 8-bit values.

use super::load_scene;
use homog::PixelRect;
use pipeline::render::{BitDepth, rows_per_band};
use pipeline::scene::file::OverlayFile;
use pipeline::scene::{ResolveOptions, parse_scene};
use pipeline::{FrameChannel, Origin, Picture, RenderContext, Renderer, Scene, Textures, render};
use std::path::Path;

/// Scenes with thin lines, translucent layers, a background environment, overlays, text and line
/// drawings.
const SCENES: [&str; 7] =
    ["floor", "panes", "primitives", "finishes", "two_point", "technical", "view_volume"];

fn render_region<C: FrameChannel>(scene: &Scene, region: PixelRect) -> Picture<C> {
    let textures = Textures::for_scene(scene);
    let (mut renderer, mut picture) = (Renderer::default(), Picture::default());
    let mut prepared = renderer.prepare(&RenderContext::new(scene, &textures, 2)).expect("a scene");
    prepared.render_region(region, &mut picture).expect("a region");
    picture
}

fn assert_same_as_part<C: FrameChannel + std::fmt::Debug>(
    whole: &Picture<C>,
    part: &Picture<C>,
    at: PixelRect,
    name: &str,
) {
    for (x, y) in (0..at.height).flat_map(|y| (0..at.width).map(move |x| (x, y))) {
        assert_eq!(
            part.pixel(x, y),
            whole.pixel(at.x + x, at.y + y),
            "{name}: ({x}, {y}) of {at:?}"
        );
    }
}

#[test]
fn regions_and_bands_match_the_whole_picture() {
    for name in SCENES {
        let scene = load_scene(name, |file| {
            file.image.size = (330, 210);
            file.overlays.push(OverlayFile::Axes { length: None });
        });
        let all = scene.image.pixel_rect();
        let whole: Picture = render_region(&scene, all);
        let crop = PixelRect { x: 101, y: 59, width: 150, height: 80 };
        assert_same_as_part(&whole, &render_region(&scene, crop), crop, name);
        let (textures, mut renderer) = (Textures::for_scene(&scene), Renderer::default());
        let context = RenderContext::new(&scene, &textures, 1);
        let mut prepared = renderer.prepare(&context).expect("a scene");
        let (mut file, mut copy) = (Vec::new(), Picture::default());
        prepared.write_png(&mut file, all, 50, BitDepth::Eight, Some(&mut copy)).expect("a file");
        assert!(copy == whole, "{name} in bands");
        assert!(file == whole.to_png(), "{name} as a file");
        let deep: Picture<u16> = render_region(&scene, all);
        assert_same_as_part(&deep, &render_region(&scene, crop), crop, name);
        assert_sixteen_bits_agree(&whole, &deep, name);
    }
}

/// Checks that the 16-bit picture rounds to the 8-bit picture, except where lines are drawn over
/// it.
fn assert_sixteen_bits_agree(whole: &Picture, deep: &Picture<u16>, name: &str) {
    let mut drawn = 0;
    for (flat, deep) in whole.pixels.iter().zip(&deep.pixels) {
        let far = (0..4).any(|k| (f64::from(deep[k]) / 257.0 - f64::from(flat[k])).abs() > 0.503);
        // The color of a nearly transparent pixel cannot be recovered from 8 bits.
        drawn += usize::from(far && flat[3] > 8);
        let near = (0..4).all(|k| (f64::from(deep[k]) / 257.0 - f64::from(flat[k])).abs() <= 4.01);
        assert!(near || flat[3] < 160, "{name}: {flat:?} {deep:?}");
    }
    assert!(
        drawn * 20 < whole.pixels.len(),
        "{name}: {drawn} pixels are not rounded to the nearest code"
    );
}

#[test]
fn sixteen_bit_pictures_without_lines_round_to_eight_bits() {
    for name in ["floor", "panes", "crates", "finishes"] {
        let scene = load_scene(name, |file| file.image.size = (200, 130));
        let all = scene.image.pixel_rect();
        let (flat, deep): (Picture, Picture<u16>) =
            (render_region(&scene, all), render_region(&scene, all));
        for (flat, deep) in flat.pixels.iter().zip(&deep.pixels) {
            for k in 0..4 {
                let fine = f64::from(deep[k]) / 257.0;
                assert!((fine - f64::from(flat[k])).abs() <= 0.503, "{name}: {flat:?} {deep:?}");
            }
        }
    }
}

#[test]
fn files_do_not_depend_on_the_band_height() {
    // The backgrounds: opaque, transparent, and transparent but fully covered.
    for (background, covered) in [(1.0, false), (0.0, false), (0.0, true)] {
        let mut scene = load_scene("spheres", |file| file.image.size = (333, 210));
        scene.image.background = [background; 4];
        let all = if covered {
            PixelRect { x: 160, y: 90, width: 9, height: 14 }
        } else {
            scene.image.pixel_rect()
        };
        let (textures, mut renderer) = (Textures::for_scene(&scene), Renderer::default());
        let context = RenderContext::new(&scene, &textures, 1);
        let mut prepared = renderer.prepare(&context).expect("a scene");
        let mut whole = Picture::<u8>::default();
        prepared.render_region(all, &mut whole).expect("a picture");
        assert_eq!(whole.is_opaque(), covered || background == 1.0);
        for rows in [1, 64, 100] {
            let mut bytes = Vec::new();
            prepared.write_png(&mut bytes, all, rows, BitDepth::Eight, None).expect("a file");
            assert!(bytes == whole.to_png(), "{rows} rows at a time");
        }
    }
}

#[test]
fn regions_of_a_giant_picture_match_across_image_tiles() {
    for name in ["floor", "finishes", "two_point"] {
        let scene = load_scene(name, |file| {
            file.image.size = (20_000, 20_000);
            file.image.samples = 4;
        });
        // At the corner shared by four tiles.
        let whole = PixelRect { x: 16_200, y: 16_300, width: 400, height: 200 };
        let picture: Picture = render_region(&scene, whole);
        for (x, y, width, height) in
            [(16_200, 16_300, 184, 84), (16_350, 16_320, 100, 140), (16_384, 16_384, 216, 116)]
        {
            let part = PixelRect { x, y, width, height };
            let found: Picture = render_region(&scene, part);
            let within = PixelRect { x: x - whole.x, y: y - whole.y, ..part };
            assert_same_as_part(&picture, &found, within, name);
        }
    }
}

/// A tall picture with every feature that depends on more than one pixel. It has textures, glass,
/// soft and hard shadows, a ground that catches them, occlusion, an environment, an overlay, and a
/// view with a separate camera.
const EVERYTHING_SCENE: &str = r#"Scene(
    models: [
        (path: "models/table.glb"),
        (path: "models/crate.glb", translation: (-1.2, 0.5, 0), scale: 0.6),
        (path: "models/panes.glb", translation: (1, 1.2, 1), scale: 0.5),
        (path: "models/finishes.glb", translation: (0, 2.6, 0), scale: 0.3),
    ],
    camera: (
        view: LookAt(eye: (2, 7, 9), target: (0, 0.6, 0)),
        projection: Perspective(fov_y_degrees: 50),
    ),
    lights: [
        Directional(direction: (-1, -1.4, -0.4), intensity: 2),
        Spot(position: (3, 5, 4), direction: (-3, -5, -4), intensity: 90),
        Ambient(intensity: 0.4),
    ],
    shadows: On(size: 512, softness_degrees: 4),
    ground: Shadow(),
    environment: Sky(),
    ambient_occlusion: (radius: 0.7),
    overlays: [Axes()],
    viewports: [(
        at: (0.1, 0.91, 0.8, 0.06),
        camera: (view: Frame(from: ThreeQuarter)),
        background: Transparent,
    )],
    image: (size: (90, 2200), samples: 4),
)"#;

#[test]
fn shadows_and_occlusion_match_the_whole_picture_in_every_region() {
    let scene_of = |text: String| {
        let file = parse_scene("made.ron", &text).expect("a scene");
        let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
        let origin = Origin::from_text("made.ron", text, scenes);
        Scene::resolve(&origin, &file, &ResolveOptions::default()).expect("a scene")
    };
    let scene = scene_of(EVERYTHING_SCENE.to_owned());
    let whole = render(&scene, 2).expect("a picture");
    for plain in
        ["shadows: On(size: 512, softness_degrees: 4)", "ambient_occlusion: (radius: 0.7),"]
    {
        let without = if plain.ends_with(')') { "shadows: Off" } else { "" };
        let without = scene_of(EVERYTHING_SCENE.replace(plain, without));
        let without = render(&without, 2).expect("a picture");
        let pairs = whole.pixels.chunks(90).zip(without.pixels.chunks(90));
        let rows = pairs.filter(|(with, without)| with != without).count();
        assert!(rows > 400, "{plain} is visible in only {rows} rows");
    }
    let all = scene.image.pixel_rect();
    let (textures, mut renderer) = (Textures::for_scene(&scene), Renderer::default());
    let context = RenderContext::new(&scene, &textures, 2);
    let mut prepared = renderer.prepare(&context).expect("a scene");
    for rows in [rows_per_band(scene.image.width), 512, 700] {
        let mut file = Vec::new();
        prepared.write_png(&mut file, all, rows, BitDepth::Eight, None).expect("a file");
        assert!(file == whole.to_png(), "in bands of {rows} rows");
    }
    for part in [
        PixelRect { x: 20, y: 1000, width: 40, height: 120 },
        PixelRect { x: 31, y: 2030, width: 47, height: 40 },
        PixelRect { x: 0, y: 1101, width: 1, height: 1 },
    ] {
        assert_same_as_part(&whole, &render_region(&scene, part), part, "alone");
        let mut region = Picture::default();
        prepared.render_region(part, &mut region).expect("a region");
        assert_same_as_part(&whole, &region, part, "after other regions");
    }
}
