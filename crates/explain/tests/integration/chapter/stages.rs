//! Checks the pipeline stages one by one, and pixel rays against a rendered picture.

use super::{pixel_position, render_scene, resolve_text};
use explain::{
    ApiConventions, Explanation, ItemValue, TransformChain, VertexRef, explain_segment,
    explain_vertex,
};
use homog::{ClipRange, Point, World};
use scene::Scene;
use viewport::Viewport;

/// Returns the transform chain of a scene's camera in these conventions.
pub(super) fn chain_of(scene: &Scene, conventions: ApiConventions) -> TransformChain {
    let size = (scene.image.width, scene.image.height);
    TransformChain::new(&scene.view_projection, size, conventions).expect("a viewport")
}

/// Returns the numbers in the item with this id.
pub(super) fn numbers(explanation: &Explanation, id: &str) -> Vec<f64> {
    let mut items = explanation.steps.iter().flat_map(|step| &step.items);
    match &items.find(|item| item.id == id).expect(id).value {
        ItemValue::Matrix(rows) => rows.as_flattened().to_vec(),
        ItemValue::Numbers(list) => list.clone(),
        ItemValue::Number(number) => vec![*number],
        ItemValue::PlanarMatrix(_) | ItemValue::Text(_) => Vec::new(),
    }
}

/// Whether numbers agree to within 1e-12 of the largest.
pub(super) fn close(a: &[f64], b: &[f64]) -> bool {
    let size = b.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12 * size)
}

/// Whether the ray hits the crate, enlarged by `margin` on all sides. It does if its intervals
/// between opposite sides overlap.
fn meets_crate(origin: [f64; 3], direction: [f64; 3], margin: f64) -> bool {
    let [low, high] = [[-0.5, 0.0, -0.5], [0.5, 1.0, 0.5]];
    let (mut enters, mut leaves) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        let at = |side: f64| (side - origin[axis]) / direction[axis];
        let (a, b) = (at(low[axis] - margin), at(high[axis] + margin));
        (enters, leaves) = (enters.max(a.min(b)), leaves.min(a.max(b)));
    }
    enters <= leaves
}

/// Rasterization and ray casting agree: a pixel is covered if and only if its ray hits the box.
#[test]
fn c1_pixel_rays_hit_what_the_forward_map_draws() {
    for projection in
        ["Perspective(fov_y_degrees: 40)", "Orthographic()", "Cabinet()", "TwoPoint()"]
    {
        let scene = resolve_text(&format!(
            "Scene(models: [(path: \"crate.glb\")], style: Flat,
             camera: (view: Frame(from: Direction((3.1, 2.3, 5.2))), projection: {projection}),
             image: (size: (90, 60), samples: 1))"
        ));
        let picture = render_scene(&scene);
        let viewport = Viewport::image_for(90, 60, ClipRange::CHAPTER).expect("a viewport");
        let to_world = scene.view_projection.world_to_clip().inverse().expect("an invertible map");
        let unprojector = viewport.unprojector(to_world);
        let mut covered = 0;
        for (x, y) in (0..60).flat_map(|y| (0..90).map(move |x| (x, y))) {
            let center = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let ray = unprojector.pick_ray(center).expect("a ray").ray;
            let place = ray.at(0.7);
            let [back_x, back_y] = pixel_position(&scene, place);
            let gap = (back_x - center[0]).abs().max((back_y - center[1]).abs());
            assert!(
                gap < 1e-9,
                "{projection}: a point on the ray projects {gap} pixels from the pixel center"
            );
            let (origin, direction): ([f64; 3], [f64; 3]) = (
                [ray.origin.x(), ray.origin.y(), ray.origin.z()],
                [ray.direction.x(), ray.direction.y(), ray.direction.z()],
            );
            let is_covered = picture.pixel(x, y).expect("a pixel")[3] > 0;
            covered += usize::from(is_covered);
            // Corners are snapped to 1/256 pixel, so coverage may differ near the border.
            if meets_crate(origin, direction, -0.004) {
                assert!(is_covered, "{projection}: ({x}, {y}) is empty");
            }
            if !meets_crate(origin, direction, 0.004) {
                assert!(!is_covered, "{projection}: ({x}, {y}) is drawn");
            }
        }
        assert!(covered > 500, "{projection}: {covered} pixels");
    }
}

#[test]
fn c54_clipping_comes_between_the_two_steps_of_projection() {
    let scene = resolve_text(
        "Scene(models: [(path: \"crate.glb\", translation: (0, 0, -4))],
         camera: (view: LookTo(eye: (0, 0, 0), gaze: (0, 0, -1)),
                  projection: Frustum(left: -1, right: 3, bottom: -1, top: 2, near: 2, far: 6)),
         image: (size: (400, 300)))",
    );
    let chain = chain_of(&scene, ApiConventions::OpenGl);
    let explained =
        explain_segment(&chain, [Point::new(1.0, 0.5, -4.0), Point::new(2.0, 1.0, 4.0)]);
    let ids: Vec<&str> = explained.steps.iter().map(|step| step.id).collect();
    let at = |id: &str| ids.iter().position(|known| *known == id).expect(id);
    assert!(
        at("projection") < at("clip") && at("clip") < at("divide") && at("divide") < at("viewport")
    );
    // The segment goes from z = −4 to 4 and passes z = −2 after a quarter of its length.
    assert!(close(&numbers(&explained, "t"), &[0.0, 0.25]));
    // Before the divide, w = −z, which is negative for b.
    assert!(close(&numbers(&explained, "clip_a")[3..], &[4.0]));
    assert!(close(&numbers(&explained, "clip_b")[3..], &[-4.0]));
    // (1.25, 0.625, −2) is at these fractions of the window [−1, 3] × [−1, 2], and at depth −1.
    let (x, y) = (2.0 * 2.25 / 4.0 - 1.0, 2.0 * 1.625 / 3.0 - 1.0);
    assert!(close(&numbers(&explained, "ndc_end"), &[x, y, -1.0]));
    // If b were divided without clipping, it would be reflected, as if it were ahead: −N x/z is −1
    // and −N y/z is −1/2, in the window [−1, 3] × [−1, 2].
    let behind = chain.world_to_clip().transform_point(Point::new(2.0, 1.0, 4.0));
    let wrapped = behind.divide().expect("w is not 0");
    assert!(close(&[wrapped.x(), wrapped.y()], &[-1.0, -2.0 / 3.0]), "{wrapped:?}");
}

/// Also C84: a vertex passes through model, camera, projection, outcodes, divide and viewport.
#[test]
fn c103_each_stage_starts_from_the_result_of_the_previous_stage() {
    let scene = resolve_text(
        "Scene(models: [(path: \"crate.glb\", translation: (1, 2, 3), rotation_degrees: (0, 90, 0), scale: 2)],
         camera: (view: LookTo(eye: (1, 3, 11), gaze: (0, 0, -1)),
                  projection: Perspective(fov_y_degrees: 90, near: 1, far: 21)),
         image: (size: (300, 200)))",
    );
    let chain = chain_of(&scene, ApiConventions::OpenGl);
    let vertex = VertexRef { node: 0, primitive: 0, index: 0 };
    let explained = explain_vertex(&chain, &scene.models[0], vertex).expect("a vertex");
    let ids: Vec<&str> = explained.steps.iter().map(|step| step.id).collect();
    assert_eq!(ids, ["model", "camera", "projection", "outcodes", "divide", "viewport"]);
    let file = scene.models[0].model.meshes[0].primitives[0].positions[0].map(f64::from);
    let [x, y, z] = <[f64; 3]>::try_from(&numbers(&explained, "mesh")[..]).expect("a point");
    assert_eq!([x, y, z], file, "the vertex should be as in the file");
    // Scaled by 2, rotated by 90° about y (x to −z, z to x), and translated by (1, 2, 3).
    let world = [2.0 * z + 1.0, 2.0 * y + 2.0, -2.0 * x + 3.0];
    assert!(close(&numbers(&explained, "world"), &world));
    // The eye at (1, 3, 11) looks along −z, with x to the right.
    let view = [world[0] - 1.0, world[1] - 3.0, world[2] - 11.0];
    assert!(close(&numbers(&explained, "view"), &view));
    // For fovy = 90°, aspect 3 : 2, N = 1 and F = 21, w = D and z = (F+N)/(F−N) D − 2FN/(F−N).
    let distance = -view[2];
    let clip = [view[0] / 1.5, view[1], 22.0 / 20.0 * distance - 42.0 / 20.0, distance];
    assert!(close(&numbers(&explained, "clip"), &clip));
    let ndc = [clip[0] / distance, clip[1] / distance, clip[2] / distance];
    assert!(close(&numbers(&explained, "ndc"), &ndc));
    // OpenGL counts rows from the bottom and stores depth from 0 to 1.
    let screen = [(ndc[0] + 1.0) * 150.0, (ndc[1] + 1.0) * 100.0, f64::midpoint(1.0, ndc[2])];
    assert!(close(&numbers(&explained, "screen"), &screen));
}

#[test]
fn c14_twice_the_distance_halves_the_size_in_pixels() {
    // The front of the crate, one unit high, at these distances from the eye.
    let focal = 100.0 / libm::tan(20_f64.to_radians());
    for distance in [2.0, 4.0, 8.0] {
        let scene = resolve_text(&format!(
            "Scene(models: [(path: \"crate.glb\")], style: Flat,
             camera: (view: LookTo(eye: (0, 0.5, {}), gaze: (0, 0, -1)),
                      projection: Perspective(fov_y_degrees: 40)),
             image: (size: (200, 200), samples: 1))",
            distance + 0.5
        ));
        let height = |x: f64| -> f64 {
            let ends: [[f64; 2]; 2] = [Point::<World>::new(x, 0.0, 0.5), Point::new(x, 1.0, 0.5)]
                .map(|end| pixel_position(&scene, end));
            ends[0][1] - ends[1][1]
        };
        assert!((height(0.3) - focal / distance).abs() < 1e-9, "at {distance}");
        let picture = render_scene(&scene);
        let drawn = (0..200).filter(|&y| picture.pixel(100, y).is_some_and(|p| p[3] > 0)).count();
        assert!((drawn as f64 - focal / distance).abs() <= 1.0, "{drawn} rows at {distance}");
    }
}
