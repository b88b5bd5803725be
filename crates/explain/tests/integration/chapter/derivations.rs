//! Checks scene matrices against their derivations, and projection classes by their effects.

use super::resolve_text;
use super::stages::{chain_of, close, numbers};
use explain::{ApiConventions, BareMap, explain_transforms};
use glam::{DMat4, DVec2};
use homog::{HPoint, Point, Vector, View};
use projection::ProjectionClass;

fn scene_with(projection: &str) -> scene::Scene {
    resolve_text(&format!(
        "Scene(models: [(path: \"crate.glb\", translation: (0, 0, -4))],
         camera: (view: LookTo(eye: (0, 0, 0), gaze: (0, 0, -1)), projection: {projection}),
         image: (size: (400, 300)))"
    ))
}

#[test]
fn c23_p_shrinks_x_and_y_keeps_lines_and_makes_rays_from_the_eye_parallel() {
    let (n, f) = (-2.0, -6.0);
    let p = BareMap::from_planes(n, f).expect("two planes ahead");
    let image = |x: f64, y: f64, z: f64| -> [f64; 3] {
        let explained = p.explain_points(&[HPoint::<View>::new(x, y, z, 1.0)]).expect("a point");
        numbers(&explained, "divided").try_into().expect("three numbers")
    };
    // x and y are scaled by n/z, and z becomes n + f − f n/z, so planes move closer together.
    for z in [-2.0, -3.0, -4.5, -6.0] {
        assert!(close(&image(3.0, -1.0, z), &[3.0 * n / z, -n / z, n + f - f * n / z]), "{z}");
    }
    // Along a ray from the eye, x and y stay constant, and z keeps decreasing.
    let along: Vec<[f64; 3]> =
        [2.0, 3.0, 5.0].map(|s| image(0.4 * s, -0.7 * s, -s)).into_iter().collect();
    assert!(along.iter().all(|place| close(&place[..2], &[0.8, -1.4])), "{along:?}");
    assert!(along.windows(2).all(|pair| pair[1][2] < pair[0][2]), "{along:?}");
    // Any three points on a line stay on a line.
    let [a, b, c] = [0.0, 0.3, 1.0].map(|t| image(1.0 + 2.0 * t, 3.0 - t, -2.5 - 3.0 * t));
    let [ab, ac] =
        [b, c].map(|end| Vector::<View>::new(end[0] - a[0], end[1] - a[1], end[2] - a[2]));
    assert!(ab.cross(ac).length() < 1e-12 && ab.length() > 0.1);
}

#[test]
fn c57_the_trace_of_a_frustum_has_the_steps_of_its_derivation() {
    let (l, r, b, t, near, far) = (-1.0, 3.0, -1.0, 2.0, 2.0, 6.0);
    let scene = scene_with("Frustum(left: -1, right: 3, bottom: -1, top: 2, near: 2, far: 6)");
    let explained = explain_transforms(&chain_of(&scene, ApiConventions::OpenGl));
    let matrix = |id: &str| {
        let rows: [f64; 16] = numbers(&explained, id).try_into().expect("a matrix");
        DMat4::from_cols_array(&rows).transpose()
    };
    let [shear, scale, depth] = ["shear", "scale", "depth"].map(matrix);
    let (x, y, z) = (1.3, 0.4, -3.7);
    // The shear moves the frustum's center line to the axis; the scale moves its sides to 45°.
    let sheared = shear * Point::<View>::new(x, y, z).raw().extend(1.0);
    assert!(close(&[sheared.x], &[x + z * (l + r) / (2.0 * near)]));
    assert!(close(&[sheared.y], &[y + z * (b + t) / (2.0 * near)]));
    let square = scale * sheared;
    // −N x/z on the near plane, remapped from [l, r] to [−1, 1], times the distance.
    let remapped = |on_near: f64, low: f64, high: f64| -1.0 + 2.0 * (on_near - low) / (high - low);
    let [u, v] = [remapped(-near * x / z, l, r), remapped(-near * y / z, b, t)];
    assert!(close(&[square.x, square.y], &[-z * u, -z * v]));
    // (a z + b)/−z is −1 at the near plane and +1 at the far plane.
    let [a, offset] = [-(far + near) / (far - near), -2.0 * far * near / (far - near)];
    assert!(close(&depth.transpose().z_axis.to_array(), &[0.0, 0.0, a, offset]));
    assert!(close(&depth.transpose().w_axis.to_array(), &[0.0, 0.0, -1.0, 0.0]));
    // The product of the three is glFrustum (GL-1), written out.
    let gl = [
        [2.0 * near / (r - l), 0.0, (r + l) / (r - l), 0.0],
        [0.0, 2.0 * near / (t - b), (t + b) / (t - b), 0.0],
        [0.0, 0.0, a, offset],
        [0.0, 0.0, -1.0, 0.0],
    ];
    assert!(close(&numbers(&explained, "view_to_clip"), gl.as_flattened()));
    let product = (depth * scale * shear).transpose().to_cols_array();
    assert!(close(&product, gl.as_flattened()));
}

#[test]
fn c66_the_lessons_frustum_is_the_product_of_its_five_steps() {
    let (l, r, b, t, near, far) = (-1.0, 3.0, -1.0, 2.0, 2.0, 6.0);
    let scene =
        scene_with("ApexMovedFrustum(left: -1, right: 3, bottom: -1, top: 2, near: 2, far: 6)");
    let explained = explain_transforms(&chain_of(&scene, ApiConventions::OpenGl));
    // Equation 9 of the lesson (LW-1).
    let (c1, c2) = (2.0 * far * near / (near - far), (far + near) / (far - near));
    let eq9 = [
        [2.0 * near / (r - l), 0.0, 0.0, -near * (r + l) / (r - l)],
        [0.0, 2.0 * near / (t - b), 0.0, -near * (t + b) / (t - b)],
        [0.0, 0.0, -c2, c1],
        [0.0, 0.0, -1.0, 0.0],
    ];
    assert!(close(&numbers(&explained, "view_to_clip"), eq9.as_flattened()));
    let chain = chain_of(&scene, ApiConventions::OpenGl);
    for (x, y, z) in [(1.3, 0.4, -3.7), (-1.0, -1.0, -2.0), (4.0, 5.0, -6.0)] {
        // Step 1 moves the apex to the origin, step 2 divides by the distance, and step 3 maps to
        // [−1, 1].
        let (x1, y1) = (x - f64::midpoint(l, r), y - f64::midpoint(b, t));
        let (x2, y2) = (near * x1 / -z, near * y1 / -z);
        let (x3, y3) = (2.0 * x2 / (r - l), 2.0 * y2 / (t - b));
        // Steps 4 and 5 compute depth as c1/D + c2, where D = −z.
        let depth = c1 / -z + c2;
        let clip = chain.world_to_clip().transform_point(Point::new(x, y, z));
        let ndc = clip.divide().expect("ahead");
        assert!(close(&[ndc.x(), ndc.y(), ndc.z()], &[x3, y3, depth]), "({x}, {y}, {z})");
    }
}

/// The leaves of the classification tree, with their names in scene files.
const LEAVES: [(ProjectionClass, &str); 11] = [
    (ProjectionClass::Multiview, "Multiview(Front)"),
    (ProjectionClass::Isometric, "Isometric"),
    (ProjectionClass::Dimetric, "Dimetric"),
    (ProjectionClass::Trimetric, "Trimetric"),
    (ProjectionClass::Cavalier, "Cavalier()"),
    (ProjectionClass::Cabinet, "Cabinet()"),
    (ProjectionClass::Military, "Military()"),
    (ProjectionClass::GeneralOblique, "Oblique(length: 0.7)"),
    (ProjectionClass::OnePoint, "OnePoint()"),
    (ProjectionClass::TwoPoint, "TwoPoint()"),
    (ProjectionClass::ThreePoint, "ThreePoint()"),
];

/// Returns the homogeneous images of the three axis directions.
fn axis_images(projection: &str) -> [HPoint<homog::Clip>; 3] {
    let scene = resolve_text(&format!(
        "Scene(models: [(path: \"crate.glb\")], camera: (projection: {projection}),
         image: (size: (200, 200)))"
    ));
    let map = scene.view_projection.world_to_clip();
    [Vector::X, Vector::Y, Vector::Z].map(|axis| map.transform_direction(axis))
}

/// Returns the drawn length of a unit on each axis, and Gauss's sum of the squares of the axis
/// images as complex numbers. The sum is 0 only for an orthographic projection.
fn drawn_lengths(images: [HPoint<homog::Clip>; 3]) -> ([f64; 3], f64) {
    let drawn = images.map(|image| DVec2::new(image.x(), image.y()));
    let square = |c: DVec2| DVec2::new(c.x * c.x - c.y * c.y, 2.0 * c.x * c.y);
    let sum = drawn.map(square).into_iter().sum::<DVec2>().length();
    let longest = drawn.iter().fold(0.0_f64, |longest, c| longest.max(c.length()));
    (drawn.map(|c| c.length() / longest), sum / (longest * longest))
}

#[test]
fn c73_every_leaf_of_the_tree_is_a_scenes_projection_and_has_the_properties_of_its_branch() {
    let leaves = ProjectionClass::ALL.into_iter().filter(|class| class.is_leaf());
    assert!(leaves.eq(LEAVES.map(|(class, _)| class)), "each leaf once, in the tree's order");
    for (class, projection) in LEAVES {
        let images = axis_images(projection);
        let meeting = images.iter().filter(|image| image.w().abs() > 1e-9).count();
        let is_below = |branch| class.ancestors().any(|ancestor| ancestor == branch);
        assert_eq!(meeting == 0, is_below(ProjectionClass::Parallel), "{class:?}");
        assert_eq!(meeting > 0, is_below(ProjectionClass::Perspective), "{class:?}");
        let (lengths, gauss) = drawn_lengths(images);
        if is_below(ProjectionClass::Parallel) {
            let is_orthographic = is_below(ProjectionClass::Orthographic);
            assert_eq!(gauss < 1e-9, is_orthographic, "{class:?}: {gauss}");
        }
        let is =
            |expected: [f64; 3]| lengths.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9);
        let [x, y, z] = lengths;
        let holds = match class {
            ProjectionClass::Multiview => is([1.0, 1.0, 0.0]),
            ProjectionClass::Isometric | ProjectionClass::Cavalier | ProjectionClass::Military => {
                is([1.0, 1.0, 1.0])
            }
            ProjectionClass::Dimetric | ProjectionClass::Cabinet => is([1.0, 1.0, 0.5]),
            ProjectionClass::GeneralOblique => is([1.0, 1.0, 0.7]),
            ProjectionClass::Trimetric => {
                (x - y).abs().min((y - z).abs()).min((z - x).abs()) > 0.01
            }
            ProjectionClass::OnePoint => meeting == 1,
            ProjectionClass::TwoPoint => meeting == 2,
            ProjectionClass::ThreePoint => meeting == 3,
            _ => false,
        };
        assert!(holds, "{class:?}: {lengths:?}, {meeting}");
    }
}
