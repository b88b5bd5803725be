//! A checkered floor that extends to the horizon, rendered at 1080 lines and compared with the mean
//! of 64 positions in each pixel.

use homog::Affine;
use model::ModelInstance;
use model::{
    Image, Material, Mesh, Model, Node, Primitive, Sampler, Texture, TextureInfo, WrapMode,
};
use pipeline::scene::parse_scene;
use pipeline::{Origin, Scene, render};
use std::sync::Arc;

const IMAGE_SIZE: (u32, u32) = (1920, 1080);
/// The number of texels along a side of the texture.
const TEXELS: u32 = 64;
/// The number of texels along a side of a checker square.
const CHECK_TEXELS: u32 = 8;
/// Texture repetitions per unit in the world.
const REPEATS_PER_UNIT: f32 = 0.5;
const FLOOR_SIDE: f32 = 200.0;

/// Returns 1 for a white texel and 0 for a black texel, interpolated between texels.
fn check_texture(u: f64, v: f64) -> f64 {
    let place = |c: f64| {
        let texels = c * f64::from(TEXELS) - 0.5;
        (texels.floor() as i64, texels - texels.floor())
    };
    let ((x, s), (y, t)) = (place(u), place(v));
    let check = |x: i64| x.rem_euclid(i64::from(TEXELS)) / i64::from(CHECK_TEXELS);
    let texel = |x: i64, y: i64| ((check(x) + check(y)) % 2) as f64;
    let row = |y: i64| texel(x, y) * (1.0 - s) + texel(x + 1, y) * s;
    row(y) * (1.0 - t) + row(y + 1) * t
}

fn floor_model() -> Model {
    let texel = |n: u32| {
        let code = if (n % TEXELS / CHECK_TEXELS + n / TEXELS / CHECK_TEXELS).is_multiple_of(2) {
            0
        } else {
            255
        };
        [code, code, code, 255]
    };
    let rgba = (0..TEXELS * TEXELS).map(texel).collect();
    let corners = [
        [-FLOOR_SIDE, -FLOOR_SIDE],
        [-FLOOR_SIDE, FLOOR_SIDE],
        [FLOOR_SIDE, FLOOR_SIDE],
        [FLOOR_SIDE, -FLOOR_SIDE],
    ];
    let primitive = Primitive {
        indices: vec![0, 1, 2, 0, 2, 3],
        positions: corners.map(|[x, z]| [x, 0.0, z]).to_vec(),
        uvs: vec![corners.map(|[x, z]| [x * REPEATS_PER_UNIT, z * REPEATS_PER_UNIT]).to_vec()],
        material: Some(0),
        ..Primitive::default()
    };
    let used = TextureInfo { texture: 0, uv_set: 0, uv_matrix: TextureInfo::IDENTITY_UV };
    let sampler =
        Sampler { wrap_u: WrapMode::Repeat, wrap_v: WrapMode::Repeat, ..Sampler::default() };
    Model {
        nodes: vec![Node { mesh: Some(0), ..Node::default() }],
        roots: vec![0],
        meshes: vec![Mesh { primitives: vec![primitive], ..Mesh::default() }],
        materials: vec![Material {
            base_color_texture: Some(used),
            unlit: true,
            ..Material::default()
        }],
        images: [Some(Image { width: TEXELS, height: TEXELS, rgba })].into(),
        textures: vec![Texture { image: Some(0), sampler }],
        ..Model::default()
    }
}

fn floor_scene(anisotropy: u32) -> Scene {
    let text = format!(
        r##"Scene(models: [(path: "made")],
        camera: (view: LookTo(eye: (0.3, 1, 0), gaze: (0.35, -0.24, -1)), projection: Perspective(fov_y_degrees: 50, near: 0.1, far: 1000)),
        image: (size: {IMAGE_SIZE:?}, background: Color("#808080"), max_anisotropy: {anisotropy}))"##
    );
    let file = parse_scene("floor.ron", &text).expect("a scene");
    let placed = ModelInstance { model: Arc::new(floor_model()), model_to_world: Affine::IDENTITY };
    let origin = Origin::from_text("floor.ron", text, ".".into());
    Scene::from_models(&origin, &file, &[placed]).expect("a valid scene")
}

fn decode_srgb(code: u8) -> f64 {
    let srgb = f64::from(code) / 255.0;
    if srgb <= 0.04045 { srgb / 12.92 } else { libm::pow((srgb + 0.055) / 1.055, 2.4) }
}

/// Returns the mean of the texture at 8 × 8 positions in a pixel, or `None` if any position is
/// outside the floor or close to its edge.
fn exact_floor_value(clip_to_world: glam::DMat4, x: u32, y: u32) -> Option<f64> {
    let mut sum = 0.0;
    for (i, j) in (0..8).flat_map(|i| (0..8).map(move |j| (i, j))) {
        let at = |pixel: u32, step: i32, side: u32| {
            (f64::from(pixel) + (f64::from(step) + 0.5) / 8.0) * 2.0 / f64::from(side) - 1.0
        };
        let (nx, ny) = (at(x, i, IMAGE_SIZE.0), -at(y, j, IMAGE_SIZE.1));
        let place = |depth: f64| {
            let place = clip_to_world * glam::DVec4::new(nx, ny, depth, 1.0);
            place.truncate() / place.w
        };
        let (near, far) = (place(1.0), place(-1.0));
        let t = near.y / (near.y - far.y);
        let hit = near + (far - near) * t;
        let reach = f64::from(FLOOR_SIDE) * 0.9;
        if !(t > 0.0 && t < 1.0 && hit.x.abs() < reach && hit.z.abs() < reach) {
            return None;
        }
        sum +=
            check_texture(hit.x * f64::from(REPEATS_PER_UNIT), hit.z * f64::from(REPEATS_PER_UNIT));
    }
    Some(sum / 64.0)
}

/// Returns the root mean square difference in linear light over the whole floor, and the difference
/// that is exceeded by only a thousandth of the pixels.
fn rms_error(anisotropy: u32) -> (f64, f64) {
    let scene = floor_scene(anisotropy);
    let picture = render(&scene, 2).expect("a picture");
    let clip_to_world = scene.view_projection.world_to_clip().raw().inverse();
    let mut differences = Vec::new();
    for (y, x) in (0..IMAGE_SIZE.1).flat_map(|y| (0..IMAGE_SIZE.0).step_by(7).map(move |x| (y, x)))
    {
        if let Some(due) = exact_floor_value(clip_to_world, x, y) {
            let [code, ..] = picture.pixels[(y * IMAGE_SIZE.0 + x) as usize];
            differences.push((decode_srgb(code) - due).abs());
        }
    }
    assert!(differences.len() > 100_000);
    let squares: f64 = differences.iter().map(|d| d * d).sum();
    let root = (squares / differences.len() as f64).sqrt();
    differences.sort_by(f64::total_cmp);
    (root, differences[differences.len() * 999 / 1000])
}

#[test]
fn checkered_floors_are_close_to_the_mean_of_64_positions() {
    let errors = [1, 2, 4, 8].map(rms_error);
    let roots = errors.map(|(root, _)| root);
    // The limits in linear light, from 0 to 1, for a maximum anisotropy of one, two, four (the
    // default) and eight.
    for ((root, worst), (most, bound)) in
        errors.into_iter().zip([(0.065, 0.46), (0.045, 0.43), (0.034, 0.39), (0.028, 0.34)])
    {
        assert!(root <= most && worst <= bound, "{root} {worst}");
    }
    assert!(roots[3] < roots[2] && roots[2] < roots[1] && roots[1] < roots[0], "{errors:?}");
}
