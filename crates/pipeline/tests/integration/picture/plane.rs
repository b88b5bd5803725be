//! Passes of a plane, with each pixel compared with the intersection of its ray and the plane.

use base64::Engine;
use homog::PixelRect;
use import::{ImportOptions, load_bytes};
use model::ModelInstance;
use pipeline::render::{Pass, PassBuffer, render_passes};
use pipeline::scene::parse_scene;
use pipeline::{Origin, Scene, Timings};
use std::sync::Arc;

const EYE_POSITION: [f64; 3] = [0.5, 2.0, 6.0];
const GAZE: [f64; 3] = [0.1, -0.35, -1.0];
/// Half of the plane's side.
const PLANE_EXTENT: f32 = 60.0;

/// Builds a square on the ground from two triangles. Its texture coordinates are a hundredth of x
/// and z.
fn plane_glb() -> Vec<u8> {
    let corners = [
        [-PLANE_EXTENT, 0.0, -PLANE_EXTENT],
        [-PLANE_EXTENT, 0.0, PLANE_EXTENT],
        [PLANE_EXTENT, 0.0, PLANE_EXTENT],
        [PLANE_EXTENT, 0.0, -PLANE_EXTENT],
    ];
    let mut bytes: Vec<u8> = corners.iter().flatten().flat_map(|c: &f32| c.to_le_bytes()).collect();
    let uvs = corners.iter().flat_map(|[x, _, z]| [x * 0.01, z * 0.01]);
    bytes.extend(uvs.flat_map(f32::to_le_bytes));
    bytes.extend([0_u8, 1, 2, 0, 2, 3]);
    let data = base64::engine::general_purpose::STANDARD.encode(&bytes);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":2}}]}}],
        "accessors":[
          {{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-{PLANE_EXTENT},0,-{PLANE_EXTENT}],"max":[{PLANE_EXTENT},0,{PLANE_EXTENT}]}},
          {{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"}},
          {{"bufferView":2,"componentType":5121,"count":6,"type":"SCALAR"}}],
        "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":32}},
          {{"buffer":0,"byteOffset":80,"byteLength":6}}],
        "buffers":[{{"byteLength":86,"uri":"data:application/octet-stream;base64,{data}"}}]}}"#
    )
    .into_bytes()
}

fn plane_scene(width: u32, height: u32) -> Scene {
    let [ex, ey, ez] = EYE_POSITION;
    let [gx, gy, gz] = GAZE;
    let text = format!(
        "Scene(models: [(path: \"made\")], image: (size: ({width}, {height})),
        camera: (view: LookTo(eye: ({ex}, {ey}, {ez}), gaze: ({gx}, {gy}, {gz})),
            projection: Perspective(fov_y_degrees: 50, near: 0.1, far: 500)))"
    );
    let file = parse_scene("made.ron", &text).expect("a scene");
    let loaded = load_bytes("made.gltf", &plane_glb(), &ImportOptions::default()).expect("a model");
    let placed = ModelInstance { model: Arc::new(loaded), model_to_world: homog::Affine::IDENTITY };
    let origin = Origin::from_text("made.ron", text, ".".into());
    Scene::from_models(&origin, &file, &[placed]).expect("a valid scene")
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn normalize(v: [f64; 3]) -> [f64; 3] {
    v.map(|c| c / dot(v, v).sqrt())
}

/// Returns the camera's right, up and backward axes.
fn camera_axes() -> [[f64; 3]; 3] {
    let back = normalize(GAZE.map(|c| -c));
    let right = normalize(cross([0.0, 1.0, 0.0], back));
    [right, cross(back, right), back]
}

/// Returns the depth and position of the plane at a pixel, or `None` if the plane is not visible
/// there.
fn intersect_plane(x: u32, y: u32, width: u32, height: u32) -> Option<(f64, [f64; 3])> {
    let [right, up, back] = camera_axes();
    let half = libm::tan(25.0_f64.to_radians());
    let sx = (2.0 * (f64::from(x) + 0.5) / f64::from(width) - 1.0) * half * f64::from(width)
        / f64::from(height);
    let sy = (1.0 - 2.0 * (f64::from(y) + 0.5) / f64::from(height)) * half;
    // One unit forward along the view axis.
    let way: [f64; 3] = std::array::from_fn(|k| right[k] * sx + up[k] * sy - back[k]);
    let depth = -EYE_POSITION[1] / way[1];
    let place: [f64; 3] = std::array::from_fn(|k| EYE_POSITION[k] + way[k] * depth);
    let within = |c: f64| c.abs() < f64::from(PLANE_EXTENT);
    (depth > 0.1 && within(place[0]) && within(place[2])).then_some((depth, place))
}

/// Whether a pixel is near the border of the plane, where pixels are not compared.
fn is_near_border(x: u32, y: u32, width: u32, height: u32) -> bool {
    let around = [(0, 0), (2, 0), (0, 2), (2, 2)];
    let met: Vec<bool> = around
        .iter()
        .map(|(dx, dy)| {
            intersect_plane((x + dx).saturating_sub(1), (y + dy).saturating_sub(1), width, height)
                .is_some()
        })
        .collect();
    met.iter().any(|m| *m != met[0])
}

fn assert_pass_values(buffers: &[PassBuffer], region: PixelRect, size: [u32; 2]) -> usize {
    let [depth, distance, position, normal, view_normal, uv, barycentric, id] = buffers else {
        panic!("expected eight passes");
    };
    let mut seen = 0;
    for (x, y) in (0..region.height).flat_map(|y| (0..region.width).map(move |x| (x, y))) {
        let (px, py) = (region.x + x, region.y + y);
        let expected = intersect_plane(px, py, size[0], size[1]);
        if is_near_border(px, py, size[0], size[1]) {
            continue;
        }
        let at = |pass: &PassBuffer| -> Vec<f64> {
            pass.float_values(x, y).expect("a pixel").iter().map(|v| f64::from(*v)).collect()
        };
        let Some((due_depth, place)) = expected else {
            assert_eq!(at(depth), [f64::INFINITY], "({px}, {py})");
            assert_eq!(id.integer_value(x, y), Some(0));
            continue;
        };
        seen += 1;
        // On the diagonal the snapped triangle may extend 1/256 pixel beyond the exact triangle.
        // The position is then on the diagonal.
        let weights = at(barycentric);
        let inner = weights.iter().all(|w| *w > 0.0);
        let tolerance = if inner { 2e-6 } else { 2e-4 };
        let near = |found: f64, due: f64| (found - due).abs() <= tolerance * due.abs().max(1.0);
        assert!(near(at(depth)[0], due_depth), "({px}, {py}): {} {due_depth}", at(depth)[0]);
        let way: [f64; 3] = std::array::from_fn(|k| place[k] - EYE_POSITION[k]);
        assert!(near(at(distance)[0], dot(way, way).sqrt()));
        for k in [0, 2] {
            assert!(near(at(position)[k], place[k]), "({px}, {py}): {:?} {place:?}", at(position));
        }
        assert_eq!(at(position)[1], 0.0);
        assert_eq!(at(normal), [0.0, 1.0, 0.0]);
        for (found, axis) in at(view_normal).iter().zip(camera_axes()) {
            assert!(near(*found, axis[1]));
        }
        assert!(near(at(uv)[0], place[0] * 0.01) && near(at(uv)[1], place[2] * 0.01));
        assert!(weights.iter().all(|w| *w >= 0.0) && near(weights.iter().sum(), 1.0));
        let reach = f64::from(PLANE_EXTENT);
        let corners = [[-reach, -reach], [-reach, reach], [reach, reach], [reach, -reach]];
        let [a, b, c] = if id.integer_value(x, y) == Some(1) { [0, 1, 2] } else { [0, 2, 3] };
        for axis in 0..2 {
            let sum = weights[0] * corners[a][axis]
                + weights[1] * corners[b][axis]
                + weights[2] * corners[c][axis];
            assert!((sum - place[axis * 2]).abs() < 10.0 * tolerance * reach, "{sum} {place:?}");
        }
    }
    seen
}

const CHECKED_PASSES: [Pass; 8] = [
    Pass::Depth,
    Pass::Distance,
    Pass::Position,
    Pass::Normal,
    Pass::ViewNormal,
    Pass::Uv,
    Pass::Barycentric,
    Pass::Id,
];

#[test]
fn passes_of_a_plane_match_ray_intersections() {
    let scene = plane_scene(320, 200);
    let whole = scene.image.pixel_rect();
    let buffers =
        render_passes(&scene, whole, &CHECKED_PASSES, 2, &Timings::default()).expect("passes");
    assert!(assert_pass_values(&buffers, whole, [320, 200]) > 30_000);
}

#[test]
fn passes_match_ray_intersections_beyond_the_first_image_tile() {
    let size = [40_000, 20_000];
    let scene = plane_scene(size[0], size[1]);
    for [x, y] in [[16_284, 16_300], [20_000, 13_000], [35_000, 19_000]] {
        let region = PixelRect { x, y, width: 200, height: 150 };
        let buffers =
            render_passes(&scene, region, &CHECKED_PASSES, 2, &Timings::default()).expect("passes");
        assert!(assert_pass_values(&buffers, region, size) > 25_000);
    }
}
