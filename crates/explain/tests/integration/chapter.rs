//! Checks the chapter's claims about the whole pipeline, in pictures and in numbers.

#[path = "chapter/derivations.rs"]
mod derivations;
#[path = "chapter/stages.rs"]
mod stages;
#[path = "chapter/volumes.rs"]
mod volumes;

use homog::{ClipRange, HPoint, Model, Point, World};
use pipeline::{Picture, render};
use scene::parse_scene;
use scene::{Origin, Scene};
use std::path::Path;

/// Resolves a scene with the committed models.
fn resolve_text(text: &str) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/models");
    let file = parse_scene("test.ron", text).expect("a scene");
    let origin = Origin::from_text("test.ron", text, folder);
    Scene::resolve(&origin, &file, &Default::default()).expect("a valid scene")
}

fn render_scene(scene: &Scene) -> Picture {
    render(scene, 1).expect("a picture")
}

/// Returns the pixel position of a world point.
fn pixel_position(scene: &Scene, place: Point<World>) -> [f64; 2] {
    let viewport =
        viewport::Viewport::image_for(scene.image.width, scene.image.height, ClipRange::CHAPTER);
    let clip = scene.view_projection.world_to_clip().transform_point(place);
    let ndc = clip.divide().expect("a point in front of the eye");
    let screen = viewport.expect("a viewport").ndc_to_screen().transform_point(ndc);
    [screen.x(), screen.y()]
}

#[test]
fn c3_c84_c101_a_point_passes_model_view_projection_divide_and_viewport_in_this_order() {
    let scene = resolve_text(
        "Scene(models: [(path: \"crate.glb\", translation: (1, 2, 3), rotation_degrees: (0, 90, 0), scale: 2)],
         camera: (view: LookAt(eye: (6, 5, 9), target: (1, 2, 3))), image: (size: (320, 200)))",
    );
    // Scaled by 2, rotated from x to −z, and translated.
    let corner =
        scene.models[0].model_to_world.transform_point(Point::<Model>::new(0.5, 1.0, 0.25));
    assert!((corner - Point::new(1.5, 4.0, 2.0)).length() < 1e-14);
    let in_view = scene.view_projection.camera.world_to_view().transform_point(corner);
    let by_factors: HPoint<homog::Clip> =
        scene.view_projection.view_to_clip.transform_point(in_view);
    let by_product = scene.view_projection.world_to_clip().transform_point(corner);
    assert!((by_factors.raw() - by_product.raw()).abs().max_element() < 1e-12);
    let [x, y] = pixel_position(&scene, Point::new(1.0, 2.0, 3.0));
    assert!(
        (x - 160.0).abs() < 1e-9 && (y - 100.0).abs() < 1e-9,
        "the target should be in the center"
    );
}

#[test]
fn c9_viewport_times_m_orth_gives_pixels_and_canonical_depth() {
    let to_canonical =
        projection::chapter::m_orth(-2.0, 4.0, -1.0, 2.0, -1.0, -5.0).expect("a box");
    let viewport = viewport::Viewport::chapter(60, 30).expect("a viewport");
    let to_pixel = |x: f64, y: f64, z: f64| {
        let clip = HPoint::from(to_canonical.transform_point(Point::new(x, y, z)));
        let ndc = clip.divide().expect("w is 1");
        viewport.ndc_to_screen().transform_point(ndc)
    };
    let close = |a: Point<homog::Screen>, b: [f64; 3]| (a - Point::from(b)).length() < 1e-12;
    assert!(close(to_pixel(-2.0, -1.0, -1.0), [-0.5, -0.5, 1.0]), "left, bottom, near");
    assert!(close(to_pixel(4.0, 2.0, -5.0), [59.5, 29.5, -1.0]), "right, top, far");
    assert!(close(to_pixel(1.0, 0.5, -3.0), [29.5, 14.5, 0.0]), "the middle");
}

#[test]
fn c2_c10_c13_c28_every_edge_of_a_box_is_drawn_hidden_or_not_in_parallel_and_in_perspective() {
    for projection in ["Orthographic()", "Perspective(fov_y_degrees: 50)"] {
        let scene = resolve_text(&format!(
            "Scene(models: [(path: \"crate.glb\")], style: Wireframe,
             camera: (view: Frame(from: Direction((3, 2, 5))), projection: {projection}),
             image: (size: (300, 300), background: Color(\"#fff\")))"
        ));
        let picture = render_scene(&scene);
        let corner = |n: usize| {
            let side = |bit: usize| if n & bit == 0 { 0.0 } else { 1.0 };
            Point::new(side(1) - 0.5, side(2), side(4) - 0.5)
        };
        let edges = (0..8).flat_map(|a| [1, 2, 4].map(|bit| (a, a | bit)));
        for (a, b) in edges.filter(|(a, b)| a != b) {
            for t in [0.2, 0.4, 0.6, 0.8] {
                let [x, y] = pixel_position(&scene, corner(a).lerp(corner(b), t));
                let seen = picture.pixel(x as u32, y as u32).expect("inside the picture");
                assert!(seen[0] < 200, "{projection}: edge {a}-{b} at {t}: {seen:?}");
            }
        }
    }
}

#[test]
fn c35_an_off_axis_ball_is_drawn_as_an_ellipse() {
    let scene = resolve_text(
        "Scene(models: [(path: \"spheres.glb\", translation: (0, -0.5, 0))], style: Flat,
         camera: (view: LookTo(eye: (0, 0, 4), gaze: (0, 0, -1)),
                  projection: Perspective(fov_y_degrees: 40)),
         image: (size: (1600, 400), background: Color(\"#fff\"), samples: 16))",
    );
    let picture = render_scene(&scene);
    // The outermost ball: 4.5 to the right and 4 ahead, radius ½. It is seen at the angle θ off the
    // axis, within a cone of half-angle α.
    let (x, ahead): (f64, f64) = (4.5, 4.0);
    let theta = libm::atan2(x, ahead);
    let alpha = libm::asin(0.5 / (x * x + ahead * ahead).sqrt());
    let focal = 200.0 / libm::tan(20_f64.to_radians());
    let (outer, inner) = (libm::tan(theta + alpha), libm::tan(theta - alpha));
    let cosines = libm::cos(theta + alpha) * libm::cos(theta - alpha);
    let width = focal * (outer - inner);
    let height = focal * 2.0 * libm::sin(alpha) / cosines.sqrt();
    assert!(width > 1.4 * height, "clearly not a circle");
    let (left, right) = (800.0 + focal * inner, 800.0 + focal * outer);
    let covered = |x: u32, y: u32| picture.pixel(x, y).is_some_and(|pixel| pixel[2] < 235);
    let columns = (left as u32 - 10..right as u32 + 10).filter(|&x| covered(x, 200)).count() as f64;
    assert!((columns - width).abs() < 4.0, "{columns} columns, not {width}");
    let middle = f64::midpoint(left, right) as u32;
    let rows = (0..400).filter(|&y| covered(middle, y)).count() as f64;
    assert!((rows - height).abs() < 4.0, "{rows} rows, not {height}");
}

#[test]
fn c59_c70_a_window_as_wide_as_the_picture_keeps_squares_square() {
    for size in ["(300, 300)", "(500, 200)", "(150, 400)"] {
        let scene = resolve_text(&format!(
            "Scene(models: [(path: \"crate.glb\")],
             camera: (view: LookAt(eye: (0, 0.5, 4), target: (0, 0.5, 0))), image: (size: {size}))"
        ));
        let [x0, y0] = pixel_position(&scene, Point::new(-0.5, 0.0, 0.5));
        let [x1, y1] = pixel_position(&scene, Point::new(0.5, 1.0, 0.5));
        assert!(((x1 - x0) - (y0 - y1)).abs() < 1e-9, "{size}");
    }
}
