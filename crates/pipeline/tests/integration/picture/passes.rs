//! Scene passes compared with unprojection, pixel inspection, the picture's alpha and each other.

use super::load_scene;
use homog::PixelRect;
use homog::{ClipRange, Point, World};
use model::ModelInstance;
use pipeline::render::passes::PassValues;
use pipeline::render::{Pass, inspect_pixel, render_passes};
use pipeline::{Picture, Scene, Timings, render};
use std::sync::Arc;
use viewport::Viewport;

const SCENES: [&str; 5] = ["teapot", "crates", "mexican_hat", "primitives", "isometric"];

fn small_scene(name: &str, samples: u32) -> Scene {
    load_scene(name, |file| {
        file.image.size = (160, 120);
        file.image.samples = samples;
    })
}

#[test]
fn positions_match_unprojected_depths() {
    for name in SCENES {
        let scene = small_scene(name, 4);
        let whole = scene.image.pixel_rect();
        let wanted = [Pass::Position, Pass::Depth, Pass::Distance, Pass::Barycentric];
        let buffers =
            render_passes(&scene, whole, &wanted, 2, &Timings::default()).expect("passes");
        let clip_to_world =
            scene.view_projection.world_to_clip().inverse().expect("an invertible transform");
        let viewport = Viewport::image_for(160, 120, ClipRange::CHAPTER).expect("a viewport");
        let unprojector = viewport.unprojector(clip_to_world);
        let world_to_view = scene.view_projection.camera.world_to_view();
        let mut seen = 0;
        for (x, y) in (0..120).flat_map(|y| (0..160).map(move |x| (x, y))) {
            let at = |n: usize| buffers[n].float_values(x, y).expect("a pixel");
            let &[depth] = at(1) else { panic!("expected one value") };
            // At triangle borders the center may be outside by up to 1/256 pixel, because corners
            // are snapped. Fragments of lines and points extend beyond the primitives.
            if depth.is_infinite() || at(3).iter().any(|weight| *weight <= 1e-6) {
                continue;
            }
            seen += 1;
            let ray = unprojector.pick_ray([f64::from(x) + 0.5, f64::from(y) + 0.5]);
            let ray = ray.expect("a ray").ray;
            let ahead = |p: Point<World>| -world_to_view.transform_point(p).z();
            let per_step = ahead(ray.origin + ray.direction) - ahead(ray.origin);
            let place =
                ray.origin + ray.direction * ((f64::from(depth) - ahead(ray.origin)) / per_step);
            let found = Point::<World>::from([0, 1, 2].map(|k: usize| f64::from(at(0)[k])));
            let distance = f64::from(at(2)[0]);
            assert!(
                (place - found).length() < 3e-6 * distance,
                "{name} ({x}, {y}): {place:?} {found:?}"
            );
            let eye = world_to_view.transform_point(found).raw().length();
            assert!((eye - distance).abs() < 3e-6 * distance);
        }
        assert!(seen > 500, "{name} shows too few pixels: {seen}");
    }
}

#[test]
fn ids_match_pixel_inspection() {
    for name in ["teapot", "crates", "mexican_hat", "primitives", "room"] {
        let scene = small_scene(name, 1);
        let whole = scene.image.pixel_rect();
        let wanted = [Pass::Id, Pass::Model, Pass::Node, Pass::Mesh, Pass::Material];
        let buffers =
            render_passes(&scene, whole, &wanted, 2, &Timings::default()).expect("passes");
        for (x, y) in (0..120).step_by(5).flat_map(|y| (0..160).step_by(5).map(move |x| (x, y))) {
            let told = inspect_pixel(&scene, x, y).expect("a picture").expect("a pixel");
            let owners: Vec<_> = told.fragments.iter().filter_map(|seen| seen.source).collect();
            let found: Vec<u32> =
                buffers.iter().map(|b| b.integer_value(x, y).expect("a pixel")).collect();
            let [owner] = owners[..] else {
                assert!(!owners.is_empty() || found == [0; 5], "{name} ({x}, {y}) {found:?}");
                continue;
            };
            let model = &scene.models[owner.model].model;
            let mesh = model.nodes[owner.node].mesh.expect("a mesh");
            let primitive = &model.meshes[mesh].primitives[owner.primitive];
            // Ids count through all models; copies of a model share its meshes and materials.
            let before = &scene.models[..owner.model];
            let nodes: usize = before.iter().map(|placed| placed.model.nodes.len()).sum();
            let same = |placed: &&ModelInstance| Arc::ptr_eq(&placed.model, model);
            let first_copy = before.iter().find(same).unwrap_or(&scene.models[owner.model]);
            let mut shared = Vec::new();
            for placed in before.iter().take_while(|placed| !std::ptr::eq(*placed, first_copy)) {
                if !shared.iter().any(|known| Arc::ptr_eq(known, &placed.model)) {
                    shared.push(Arc::clone(&placed.model));
                }
            }
            let meshes: usize = shared.iter().map(|model| model.meshes.len()).sum();
            let materials: usize = shared.iter().map(|model| model.materials.len()).sum();
            let material = primitive.material.map_or(0, |material| materials + material + 1);
            let expected = [owner.model + 1, nodes + owner.node + 1, meshes + mesh + 1, material];
            assert_eq!(found[1..], expected.map(|n| n as u32), "{name} ({x}, {y})");
            let shown = scene.models.iter().enumerate().flat_map(|(number, placed)| {
                placed.model.scene_primitives().map(move |(instance, p)| (number, instance, p))
            });
            let before = shown.take_while(|(number, instance, p)| {
                (*number, instance.node) != (owner.model, owner.node)
                    || !std::ptr::eq(*p, primitive)
            });
            let first: usize = before.map(|(_, _, p)| p.item_count()).sum();
            assert_eq!(found[0] as usize, first + owner.element + 1, "{name} ({x}, {y})");
        }
    }
}

#[test]
fn coverage_matches_the_alpha_of_opaque_surfaces() {
    for (name, samples) in [("teapot", 1), ("crates", 4), ("mexican_hat", 16), ("lights", 8)] {
        let mut scene = small_scene(name, samples);
        (scene.image.background, scene.image.environment_blur) = ([0.0; 4], None);
        let picture: Picture = render(&scene, 2).expect("a picture");
        let whole = scene.image.pixel_rect();
        let [coverage] = &render_passes(&scene, whole, &[Pass::Coverage], 1, &Timings::default())
            .expect("passes")[..]
        else {
            panic!("one pass");
        };
        let PassValues::Floats(shares) = &coverage.values else { panic!("measures") };
        for (at, (share, pixel)) in shares.iter().zip(&picture.pixels).enumerate() {
            assert_eq!((share * 255.0 + 0.5) as u8, pixel[3], "{name}, pixel {at}");
            assert!((share * samples as f32).fract() == 0.0);
        }
    }
}

#[test]
fn overdraw_counts_panes_and_ids_show_the_nearest() {
    let scene = small_scene("panes", 1);
    let whole = scene.image.pixel_rect();
    let wanted = [Pass::Overdraw, Pass::Depth, Pass::Id];
    let buffers = render_passes(&scene, whole, &wanted, 2, &Timings::default()).expect("passes");
    let mut most = 0;
    for (x, y) in (0..120).flat_map(|y| (0..160).map(move |x| (x, y))) {
        let told = inspect_pixel(&scene, x, y).expect("a picture").expect("a pixel");
        let shown = told.fragments.iter().filter(|seen| seen.source.is_some()).count() as u32;
        let count = buffers[0].integer_value(x, y).expect("a pixel");
        // Surfaces hidden behind opaque surfaces are also counted.
        assert!(count >= shown, "({x}, {y}): {count} of {shown}");
        assert_eq!(count == 0, buffers[2].integer_value(x, y) == Some(0));
        most = most.max(count);
    }
    assert!(most >= 3, "panes should overlap: {most}");
}

#[test]
fn regions_of_passes_match_the_whole() {
    let scene = small_scene("panes", 4);
    let whole = scene.image.pixel_rect();
    let all = render_passes(&scene, whole, &Pass::ALL, 2, &Timings::default()).expect("passes");
    let region = PixelRect { x: 37, y: 50, width: 90, height: 33 };
    let part = render_passes(&scene, region, &Pass::ALL, 1, &Timings::default()).expect("passes");
    for (all, part) in all.iter().zip(&part) {
        for (x, y) in (0..33).flat_map(|y| (0..90).map(move |x| (x, y))) {
            assert_eq!(
                part.integer_value(x, y),
                all.integer_value(x + 37, y + 50),
                "{:?}",
                all.pass
            );
            assert_eq!(part.float_values(x, y), all.float_values(x + 37, y + 50), "{:?}", all.pass);
        }
    }
}
