//! Tests scenes with several views, a shared scale and captions. The extents of a 2 × 1 × 3 box
//! must match the formulas of the projections.

use glam::DVec2;
use homog::Point;
use import::{ImportOptions, load};
use model::{Model, ModelInstance};
use scene::{Origin, ResolveError, Scene};
use scene_file::parse_scene;
use std::path::Path;
use std::sync::Arc;

/// The extents of the box along x, y and z.
const BOX: [f64; 3] = [2.0, 1.0, 3.0];

fn crate_model() -> Arc<Model> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/models/crate.glb");
    Arc::new(load(&path, &ImportOptions::default()).expect("a model"))
}

/// Returns a scene with the box; its model is a cube with sides of length 1.
fn resolve(fields: &str) -> Result<Scene, ResolveError> {
    let text =
        format!("Scene(models: [(path: \"crate.glb\")], image: (size: (800, 600)), {fields})");
    let file = parse_scene("views.ron", &text).expect("a scene");
    let origin = Origin::from_text("views.ron", text, Path::new("").to_owned());
    let model_to_world = homog::Affine::scale(BOX[0], BOX[1], BOX[2]);
    let instance = ModelInstance { model: crate_model(), model_to_world };
    Scene::from_models(&origin, &file, &[instance])
}

fn scene(fields: &str) -> Scene {
    resolve(fields).expect("a scene")
}

fn mistake(fields: &str) -> String {
    resolve(fields).map(drop).expect_err(fields).to_string()
}

/// Returns viewports with these cameras for the four quarters of the picture.
fn quarters(cameras: [&str; 4]) -> String {
    let corners = ["0, 0", "0.5, 0", "0, 0.5", "0.5, 0.5"];
    let views = corners.iter().zip(cameras).map(|(corner, camera)| {
        format!("(at: ({corner}, 0.5, 0.5), camera: ({camera}), caption: \"{corner}\")")
    });
    format!("viewports: [{}]", views.collect::<Vec<_>>().join(", "))
}

/// Returns the smallest and largest pixel coordinates of the box in a view.
fn image_bounds(scene: &Scene) -> [DVec2; 2] {
    let size = DVec2::new(scene.image.width.into(), scene.image.height.into());
    let nothing = DVec2::splat(f64::INFINITY);
    let points = scene.world_points().into_iter().map(|point| project(scene, point, size));
    points.fold([nothing, -nothing], |[low, high], point| [low.min(point), high.max(point)])
}

fn project(scene: &Scene, point: Point<homog::World>, size: DVec2) -> DVec2 {
    let image = scene.view_projection.world_to_clip().transform_point(point);
    let image = image.divide().expect("a point in front of the eye");
    (DVec2::new(image.x(), -image.y()) * 0.5 + 0.5) * size
}

const FRONT: &str = "projection: Multiview(Front)";
const TOP: &str = "view: Frame(from: Top), projection: Orthographic()";
const LEFT: &str = "view: Frame(from: Left, padding_percent: 20), projection: Orthographic()";

#[test]
fn equal_lengths_appear_equal_in_all_parallel_views() {
    let [x, y, z] = BOX;
    let (cos30, r23) = (0.75_f64.sqrt(), (2.0_f64 / 3.0).sqrt());
    let r12 = 0.5_f64.sqrt();
    // The extents of the box's image per unit on the picture plane (MV-1, AX-1, OB-1).
    let cases = [
        ("projection: Isometric", [(x + z) * cos30 * r23, (x + z) * 0.5 * r23 + y * r23]),
        (
            "view: Frame(from: Isometric), projection: Orthographic()",
            [(x + z) * cos30 * r23, (x + z) * 0.5 * r23 + y * r23],
        ),
        ("projection: Cavalier()", [x + z * r12, y + z * r12]),
        ("projection: Cabinet()", [x + z * r12 * 0.5, y + z * r12 * 0.5]),
        ("projection: Military()", [(x + z) * r12, (x + z) * r12 + y]),
    ];
    for (fourth, extent) in cases {
        let views = quarters([FRONT, TOP, LEFT, fourth]);
        let scene = scene(&format!("viewports_scale: Shared, {views}"));
        let expected = [[x, y], [x, z], [z, y], extent].map(DVec2::from);
        let scale = scene.insets[0].scene.pixels_per_unit().expect("a scale");
        for (inset, expected) in scene.insets.iter().zip(expected) {
            let [low, high] = image_bounds(&inset.scene);
            let difference = (high - low) / scale - expected;
            assert!(difference.abs().max_element() < 1e-9, "{fourth}: {low} {high} {expected}");
            // The whole box is in the view and centered, above the 28-pixel caption.
            let view = DVec2::new(400.0, 300.0 - 28.0);
            assert!(low.min_element() >= 0.0 && (view - high).min_element() >= 0.0);
            assert!(((low + high) * 0.5 - view * 0.5).abs().max_element() < 1e-6);
        }
        // The shared scale is as large as possible: without sharing, some view has that scale.
        let free = self::scene(&views);
        let scales = free.insets.iter().map(|inset| inset.scene.pixels_per_unit().expect("one"));
        let least = scales.fold(f64::INFINITY, f64::min);
        assert!((least / scale - 1.0).abs() < 1e-12, "{fourth}: {least} {scale}");
    }
}

#[test]
fn a_shared_scale_does_not_change_perspective_views() {
    let views = quarters([FRONT, TOP, LEFT, "view: Frame(from: ThreeQuarter)"]);
    let shared = scene(&format!("viewports_scale: Shared, {views}"));
    let free = scene(&views);
    let [shared, free] = [&shared, &free].map(|scene| scene.insets[3].scene.view_projection);
    assert_eq!(shared.world_to_clip().raw(), free.world_to_clip().raw());
}

#[test]
fn impossible_shared_scales_are_mistakes() {
    let perspective = "view: Frame(from: Front)";
    let views = quarters([FRONT, perspective, perspective, perspective]);
    let message = mistake(&format!("viewports_scale: Shared, {views}"));
    assert!(message.contains("there is one"), "{message}");
    let own = "view: Frame(from: Top), projection: Orthographic(height: 9)";
    let message =
        mistake(&format!("viewports_scale: Shared, {}", quarters([FRONT, own, LEFT, TOP])));
    assert!(message.contains("its own scale"), "{message}");
    assert!(mistake("viewports_scale: Shared").contains("there are none"));
}

/// The part above the caption equals a picture of that size without a caption.
#[test]
fn a_view_above_a_caption_matches_a_shorter_picture() {
    for camera in [
        FRONT,
        "view: LookAt(eye: (5, 4, 7), target: (0, 0, 0))",
        "projection: TwoPoint()",
        "view: LookAt(eye: (5, 4, 7), target: (0, 0, 0)), projection: Orthographic(height: 6)",
    ] {
        let with = scene(&format!("caption: \"A box\", camera: ({camera})"));
        let text = format!("camera: ({camera})");
        let mut without = scene(&text);
        assert_eq!((with.image.caption_height, without.image.caption_height), (28, 0));
        // The same scene in 800 × 572 pixels.
        without = {
            let text = format!(
                "Scene(models: [(path: \"crate.glb\")], image: (size: (800, 572)), {text})"
            );
            let file = parse_scene("views.ron", &text).expect("a scene");
            let origin = Origin::from_text("views.ron", text, Path::new("").to_owned());
            Scene::from_models(&origin, &file, &without.models).expect("a scene")
        };
        for point in with.world_points() {
            let a = project(&with, point, DVec2::new(800.0, 600.0));
            let b = project(&without, point, DVec2::new(800.0, 572.0));
            assert!((a - b).length() < 1e-9, "{camera}: {a} {b}");
        }
    }
}

#[test]
fn captions_and_labels_need_text() {
    assert!(mistake("caption: \" \"").contains("the caption has no text"));
    assert!(
        mistake("overlays: [Label(at: (0, 0, 0), text: \"\")]").contains("the label has no text")
    );
}
