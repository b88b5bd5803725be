//! Ambient occlusion compared with a ray-cast reference.

use glam::DVec3;
use homog::PixelRect;
use model::{Material, Model, ModelInstance};
use pipeline::scene::parse_scene;
use pipeline::{Origin, Picture, RenderContext, Renderer, Scene, Textures};
use std::path::Path;
use std::sync::Arc;

/// The number of directions in which the reference searches for occluders.
const DIRECTION_COUNT: usize = 128;

/// Makes all surfaces matte and nearly black, so that occluders reflect almost no light.
fn blacken_materials(scene: &mut Scene) {
    for ModelInstance { model, .. } in &mut scene.models {
        let materials = model.materials.iter().map(|material| Material {
            base_color: [0.01, 0.01, 0.01, 1.0],
            metallic: 0.0,
            roughness: 1.0,
            double_sided: material.double_sided,
            ..Material::default()
        });
        let materials = materials.collect();
        *model = Arc::new(Model { materials, ..(**model).clone() });
    }
}

/// Loads a model from the repository in light from all directions, with or without occlusion.
fn load_scene(model: &str, image: &str, occlusion: &str) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let text = format!(
        r#"Scene(models: [(path: "models/{model}.glb")], lights: [Ambient(intensity: 300)],
        image: ({image}), {occlusion})"#
    );
    let file = parse_scene("made.ron", &text).expect("a scene");
    let origin = Origin::from_text("made.ron", text, folder);
    let mut scene = Scene::resolve(&origin, &file, &Default::default()).expect("a valid scene");
    blacken_materials(&mut scene);
    scene
}

/// Returns the linear red value of each pixel; NaN for background pixels.
fn linear_light(scene: &Scene, threads: usize) -> Vec<f64> {
    let (textures, mut renderer) = (Textures::for_scene(scene), Renderer::default());
    let context = RenderContext::new(scene, &textures, threads);
    let mut prepared = renderer.prepare(&context).expect("a scene");
    let mut picture = Picture::<u16>::default();
    let [width, height] = [scene.image.width, scene.image.height];
    let region = PixelRect { x: 0, y: 0, width, height };
    prepared.render_region(region, &mut picture).expect("a picture");
    let linear = |[red, .., alpha]: &[u16; 4]| {
        let srgb = f64::from(*red) / 65535.0;
        let light =
            if srgb <= 0.04045 { srgb / 12.92 } else { libm::pow((srgb + 0.055) / 1.055, 2.4) };
        if *alpha == u16::MAX { light } else { f64::NAN }
    };
    picture.pixels.iter().map(linear).collect()
}

/// Returns the scene and the fraction of light that occlusion leaves at each pixel; NaN for
/// background pixels.
fn drawn_visibility(model: &str, image: &str, radius: f64) -> (Scene, Vec<f64>) {
    let without = linear_light(&load_scene(model, image, ""), 2);
    let scene = load_scene(model, image, &format!("ambient_occlusion: (radius: {radius})"));
    let with = linear_light(&scene, 2);
    (scene, with.iter().zip(without).map(|(with, without)| with / without).collect())
}

/// Returns the triangles of a scene in world space.
fn world_triangles(scene: &Scene) -> Vec<[DVec3; 3]> {
    let mut triangles = Vec::new();
    for ModelInstance { model, model_to_world } in &scene.models {
        for (instance, primitive) in model.scene_primitives() {
            let skinned = model.skin_primitive(instance, primitive);
            let corner = |index: &u32| {
                let position = skinned.positions[*index as usize].map(f64::from);
                let position = skinned.to_model.transform_point(position.into());
                model_to_world.transform_point(position).raw()
            };
            let corners = primitive.indices.as_chunks::<3>().0;
            triangles.extend(corners.iter().map(|indices| indices.each_ref().map(corner)));
        }
    }
    triangles
}

/// Returns the distance along a ray to the nearest triangle and the index of that triangle (Möller
/// and Trumbore 1997).
fn cast_ray(triangles: &[[DVec3; 3]], origin: DVec3, direction: DVec3) -> Option<(f64, usize)> {
    let mut nearest: Option<(f64, usize)> = None;
    for (index, &[a, b, c]) in triangles.iter().enumerate() {
        let (along_b, along_c) = (b - a, c - a);
        let p = direction.cross(along_c);
        let determinant = along_b.dot(p);
        if determinant.abs() < 1e-14 {
            continue;
        }
        let from_a = origin - a;
        let u = from_a.dot(p) / determinant;
        let q = from_a.cross(along_b);
        let v = direction.dot(q) / determinant;
        let t = along_c.dot(q) / determinant;
        let is_inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        if is_inside && t > 0.0 && nearest.is_none_or(|(known, _)| t < known) {
            nearest = Some((t, index));
        }
    }
    nearest
}

/// Computes the visibility at a pixel's surface by ray casting. Each occluder blocks the light from
/// its direction, by an amount that decreases with distance.
fn reference_visibility(
    triangles: &[[DVec3; 3]],
    scene: &Scene,
    [x, y]: [usize; 2],
    radius: f64,
) -> Option<f64> {
    let clip_to_world = scene.view_projection.world_to_clip().raw().inverse();
    let ndc = [
        2.0 * (x as f64 + 0.5) / f64::from(scene.image.width) - 1.0,
        1.0 - 2.0 * (y as f64 + 0.5) / f64::from(scene.image.height),
    ];
    // The near plane is at z = 1 and the far plane at −1.
    let near = clip_to_world.project_point3(DVec3::new(ndc[0], ndc[1], 1.0));
    let far = clip_to_world.project_point3(DVec3::new(ndc[0], ndc[1], -1.0));
    let view = (far - near).normalize();
    let (distance, index) = cast_ray(triangles, near, view)?;
    let [a, b, c] = triangles[index];
    let normal = (b - a).cross(c - a).normalize();
    let normal = if normal.dot(view) > 0.0 { -normal } else { normal };
    let position = near + view * distance + normal * (radius * 1e-4);
    let tangent = normal.any_orthonormal_vector();
    let bitangent = normal.cross(tangent);
    let mut visible = 0.0;
    for k in 0..DIRECTION_COUNT {
        // Directions with cosine density come from a spiral on the unit disc.
        let squared = (k as f64 + 0.5) / DIRECTION_COUNT as f64;
        let angle = k as f64 * 2.399_963_229_728_653;
        let (r, up) = (squared.sqrt(), (1.0 - squared).sqrt());
        let direction =
            tangent * (r * libm::cos(angle)) + bitangent * (r * libm::sin(angle)) + normal * up;
        let hit = cast_ray(triangles, position, direction);
        let radii = hit.map_or(1.0, |(distance, _)| (distance / radius).min(1.0));
        visible += radii * radii / DIRECTION_COUNT as f64;
    }
    Some(visible)
}

#[test]
fn occlusion_matches_ray_casting() {
    let models = [
        "bearing",
        "finishes",
        "house",
        "lamp",
        "mexican_hat",
        "room",
        "spheres",
        "teapot",
        "vase",
    ];
    let faults: Vec<String> =
        models.into_iter().filter_map(|model| judge_model(model).err()).collect();
    assert!(faults.is_empty(), "{faults:#?}");
}

/// Compares ambient occlusion with ray casting, for a radius of an eighth of the model's size.
fn judge_model(model: &str) -> Result<(), String> {
    let image = "size: (160, 120), samples: 1";
    let points = load_scene(model, image, "").world_points();
    let (low, high) =
        points.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), point| {
            (low.min(point.raw()), high.max(point.raw()))
        });
    let radius = (high - low).length() / 8.0;
    let (scene, drawn) = drawn_visibility(model, image, radius);
    let triangles = world_triangles(&scene);
    let (mut differences, mut occluded, mut count) = (0.0, 0.0, 0);
    for (y, x) in (3..120).step_by(7).flat_map(|y| (3..160).step_by(7).map(move |x| (y, x))) {
        let drawn = drawn[y * 160 + x];
        let expected = reference_visibility(&triangles, &scene, [x, y], radius);
        let (Some(expected), false) = (expected, drawn.is_nan()) else { continue };
        differences += (drawn - expected).abs();
        occluded += 1.0 - expected;
        count += 1;
    }
    let [mean, occluded] = [differences, occluded].map(|sum| sum / f64::from(count));
    if count > 40 && occluded > 0.03 && mean <= 0.04 {
        return Ok(());
    }
    Err(format!("{model}: {count} pixels, {occluded:.4} occluded, mean difference {mean:.4}"))
}
