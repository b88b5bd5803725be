//! Pictures with a closed form: compares each pixel with the formula for the scene.

mod glass;
mod refraction;

use base64::Engine;
use import::{ImportOptions, load_bytes};
use model::ModelInstance;
use pipeline::scene::file::{
    DEFAULT_PADDING, EnvironmentFile, FromFile, SceneFile, ShadowsFile, StyleFile, Triple, ViewFile,
};
use pipeline::scene::{ResolveOptions, parse_scene};
use pipeline::{Origin, Picture, RenderContext, Renderer, Scene, Textures, render};
use std::f64::consts::PI;
use std::sync::Arc;

/// Builds a glTF file with one mesh of triangles with normals, with a separate material for each
/// part.
fn build_glb(parts: &[TestPart]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let (mut views, mut accessors, mut primitives, mut materials) =
        (vec![], vec![], vec![], vec![]);
    for (n, part) in parts.iter().enumerate() {
        for list in [&part.positions, &part.normals] {
            let size = list.len() * 12;
            views.push(format!(
                r#"{{"buffer":0,"byteOffset":{},"byteLength":{size}}}"#,
                bytes.len()
            ));
            let bound = |fold: fn(f32, f32) -> f32| {
                let of = |k: usize| list.iter().map(|p| p[k]).reduce(fold).expect("a vertex");
                format!("[{},{},{}]", of(0), of(1), of(2))
            };
            accessors.push(format!(
                r#"{{"bufferView":{},"componentType":5126,"count":{},"type":"VEC3","min":{},"max":{}}}"#,
                views.len() - 1,
                list.len(),
                bound(f32::min),
                bound(f32::max)
            ));
            bytes.extend(list.iter().flatten().flat_map(|c| c.to_le_bytes()));
        }
        let at = accessors.len();
        let attributes = format!(r#""POSITION":{},"NORMAL":{}"#, at - 2, at - 1);
        primitives.push(format!(r#"{{"attributes":{{{attributes}}},"material":{n}}}"#));
        materials.push(part.material.clone());
    }
    let data = base64::engine::general_purpose::STANDARD.encode(&bytes);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{}]}}],"materials":[{}],"accessors":[{}],"bufferViews":[{}],
        "buffers":[{{"byteLength":{},"uri":"data:application/octet-stream;base64,{data}"}}]}}"#,
        primitives.join(","),
        materials.join(","),
        accessors.join(","),
        views.join(","),
        bytes.len()
    )
    .into_bytes()
}

/// Triangles with one material.
#[derive(Clone)]
struct TestPart {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    material: String,
}

/// Returns the square from −1 to 1 in x and y at this `z`, facing +z.
fn square_part(z: f32, material: &str) -> TestPart {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let positions = [0, 1, 2, 0, 2, 3].map(|n: usize| [corners[n][0], corners[n][1], z]);
    TestPart {
        positions: positions.to_vec(),
        normals: vec![[0.0, 0.0, 1.0]; 6],
        material: material.to_owned(),
    }
}

/// Returns a sphere of radius 1, fine enough that its normals are accurate to four digits.
fn sphere_part(material: &str) -> TestPart {
    let (rows, columns) = (96, 192);
    let point = |row: usize, column: usize| {
        let (a, b) = (PI * row as f64 / rows as f64, 2.0 * PI * column as f64 / columns as f64);
        [libm::sin(a) * libm::sin(b), libm::cos(a), libm::sin(a) * libm::cos(b)].map(|c| c as f32)
    };
    let mut positions = Vec::new();
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        let [a, b] = [point(row, column), point(row + 1, column)];
        let [c, d] = [point(row + 1, column + 1), point(row, column + 1)];
        positions.extend([a, b, c, a, c, d]);
    }
    TestPart { normals: positions.clone(), positions, material: material.to_owned() }
}

/// Renders parts with the scene fields `rest`, seen from (0, 0, 5), with a picture height of 2.2
/// units.
fn render_parts(parts: &[TestPart], rest: &str) -> Picture {
    render_parts_larger(parts, 1.0, rest)
}

/// Like [`render_parts`], but scales the parts by `size`.
fn render_parts_larger(parts: &[TestPart], size: f64, rest: &str) -> Picture {
    render(&test_scene(parts, size, rest), 2).expect("a picture")
}

fn test_scene(parts: &[TestPart], size: f64, rest: &str) -> Scene {
    let text = format!(
        r#"Scene(models: [(path: "made")],
        camera: (view: LookTo(eye: (0, 0, 5), gaze: (0, 0, -1)), projection: Orthographic(height: 2.2)),
        {rest})"#
    );
    let file = parse_scene("made.ron", &text).expect("a scene");
    let loaded =
        load_bytes("made.gltf", &build_glb(parts), &ImportOptions::default()).expect("a model");
    let model_to_world = homog::Affine::scale(size, size, size);
    let placed = ModelInstance { model: Arc::new(loaded), model_to_world };
    let origin = Origin::from_text("made.ron", text, ".".into());
    Scene::from_models(&origin, &file, &[placed]).expect("a valid scene")
}

/// Returns the scene of a bare model, with the program's defaults for a model without a scene file.
fn bare_scene(parts: &[TestPart], change: impl FnOnce(&mut SceneFile)) -> Scene {
    let (origin, mut file) = Origin::from_model_bytes("made.gltf", build_glb(parts));
    file.image.size = (120, 120);
    change(&mut file);
    Scene::resolve(&origin, &file, &ResolveOptions::default()).expect("a valid scene")
}

/// Returns a view that frames everything from a direction.
fn framed_from(from: FromFile) -> ViewFile {
    ViewFile::Frame { from: Some(from), padding_percent: DEFAULT_PADDING }
}

/// Returns the codes of the fully covered pixels.
fn covered_codes(picture: &Picture) -> impl Iterator<Item = [u8; 3]> {
    let covered = picture.pixels.iter().filter(|pixel| pixel[3] == 255);
    covered.map(|&[r, g, b, _]| [r, g, b])
}

const WHITE: &str = r#"{"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1],"metallicFactor":0,"roughnessFactor":1}}"#;

#[test]
fn matte_white_does_not_clip_in_default_light_with_or_without_shadows() {
    let most_allowed = encode_srgb(0.95).round() as u8;
    let mut brightest = 0;
    // From above and all around, because the key light moves with the view.
    let around = (0..12).map(|twelfth| {
        let angle = f64::from(twelfth) * PI / 6.0;
        let [x, z] = [libm::sin(angle), libm::cos(angle)];
        FromFile::Direction(Triple([x, 0.6, z]))
    });
    for view in around.chain([FromFile::Front, FromFile::Top]) {
        for shadows in [None, Some(ShadowsFile::DEFAULT)] {
            let scene = bare_scene(&[sphere_part(WHITE)], |file| {
                file.shadows = shadows;
                file.camera.view = framed_from(view.clone());
            });
            let picture = render(&scene, 2).expect("a picture");
            let most = covered_codes(&picture).flatten().max().expect("a pixel");
            assert!(most <= most_allowed, "{view:?} {shadows:?}: {most}");
            assert!(most >= 200, "{view:?} {shadows:?}: {most} is too dark");
            brightest = brightest.max(most);
        }
    }
    // The FAQ states the brightness of matte white in the studio.
    let faq = include_str!("../../../../docs/faq.md");
    let stated =
        faq.split_once("matte white reaches at most ").expect("the sentence about the studio").1;
    let stated: f64 = stated.split_once(' ').expect("a word").0.parse().expect("a number");
    assert_eq!(brightest, encode_srgb(stated).round() as u8, "the FAQ says {stated}");
}

#[test]
fn lit_spheres_are_bright_toward_the_key_light_and_dark_below() {
    for style in [StyleFile::Shaded, StyleFile::Clay, StyleFile::Gouraud, StyleFile::Toon] {
        for environment in [None, Some(EnvironmentFile::SKY), Some(EnvironmentFile::Dark)] {
            let scene = bare_scene(&[sphere_part(WHITE)], |file| {
                file.style = style.clone();
                file.environment = environment.clone();
                file.camera.view = framed_from(FromFile::Front);
            });
            let picture = render(&scene, 2).expect("a picture");
            let at = |x, y| u32::from(picture.pixel(x, y).expect("a pixel")[1]);
            let (towards, below) = (at(45, 30), at(70, 100));
            assert!(towards > below + 25, "{style:?} {environment:?}: {towards}, {below}");
            // Even without an environment, ambient light keeps the lower side from being black.
            assert!(below > 30, "{style:?} {environment:?}: {below}");
        }
    }
}

fn encode_srgb(light: f64) -> f64 {
    let light = light.clamp(0.0, 1.0);
    let code = if light <= 0.003_130_8 {
        light * 12.92
    } else {
        1.055 * libm::pow(light, 1.0 / 2.4) - 0.055
    };
    code * 255.0
}

fn assert_near(actual: [u8; 4], expected: [f64; 3], where_: &str) {
    for k in 0..3 {
        let (found, due) = (f64::from(actual[k]), encode_srgb(expected[k]).round());
        assert!(
            (found - due).abs() <= 1.0,
            "{where_}, channel {k}: found {found}, expected {due:.2}"
        );
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn normalize(v: [f64; 3]) -> [f64; 3] {
    v.map(|c| c / dot(v, v).sqrt())
}

/// Returns the light that a dielectric of this color and roughness reflects toward +z, per lux,
/// according to Appendix B of the specification. The single-bounce loss of highlights is ignored,
/// because it is less than one code.
fn expected_reflection(base: [f64; 3], roughness: f64, n: [f64; 3], l: [f64; 3]) -> [f64; 3] {
    let v = [0.0, 0.0, 1.0];
    let h = normalize([0, 1, 2].map(|k: usize| l[k] + v[k]));
    let (nl, nv, nh, vh) = (dot(n, l).max(0.0), dot(n, v).max(0.0), dot(n, h), dot(v, h));
    let a2 = libm::pow(roughness, 4.0);
    let below = nh * nh * (a2 - 1.0) + 1.0;
    let root = |c: f64| (a2 + (1.0 - a2) * c * c).sqrt();
    let both = (nl * root(nv) + nv * root(nl)).max(1e-9);
    let lobe = a2 / (PI * below * below) * 0.5 / both;
    let fresnel = 0.04 + 0.96 * libm::pow(1.0 - vh, 5.0);
    base.map(|c| ((1.0 - fresnel) * c / PI + fresnel * lobe) * nl)
}

const MATTE: &str = r#"{"pbrMetallicRoughness":{"baseColorFactor":[0.8,0.4,0.1,1],"metallicFactor":0,"roughnessFactor":0.6}}"#;

#[test]
fn lit_planes_match_the_formula() {
    let picture = render_parts(
        &[square_part(0.0, MATTE)],
        r#"lights: [Directional(direction: (-1, -1, -2), intensity: 2)], image: (size: (80, 80), samples: 1)"#,
    );
    let l = normalize([1.0, 1.0, 2.0]);
    let expected = expected_reflection([0.8, 0.4, 0.1], 0.6, [0.0, 0.0, 1.0], l).map(|c| c * 2.0);
    for (x, y) in (6..74).flat_map(|y| (6..74).map(move |x| (x, y))) {
        assert_near(picture.pixel(x, y).unwrap(), expected, &format!("pixel ({x}, {y})"));
    }
}

#[test]
fn planes_under_a_point_light_match_the_formula() {
    let picture = render_parts(
        &[square_part(0.0, MATTE)],
        r#"lights: [Point(position: (0.5, 0.3, 0.8), intensity: 1.5)], image: (size: (88, 88), samples: 1)"#,
    );
    for (x, y) in (6..82).flat_map(|y| (6..82).map(move |x| (x, y))) {
        let place = [f64::from(x) + 0.5, 87.5 - f64::from(y)].map(|c| (c / 88.0 - 0.5) * 2.2);
        let way = [0.5 - place[0], 0.3 - place[1], 0.8];
        let lux = 1.5 / dot(way, way);
        let expected = expected_reflection([0.8, 0.4, 0.1], 0.6, [0.0, 0.0, 1.0], normalize(way))
            .map(|c| c * lux);
        assert_near(picture.pixel(x, y).unwrap(), expected, &format!("pixel ({x}, {y})"));
    }
}

#[test]
fn lit_spheres_match_the_formula() {
    let size = 440;
    let rest = format!(
        "lights: [Directional(direction: (-1, -2, -2), intensity: 2.5)], image: (size: ({size}, {size}), samples: 1)"
    );
    let picture = render_parts(&[sphere_part(MATTE)], &rest);
    let l = normalize([1.0, 2.0, 2.0]);
    let mut seen = 0;
    for (x, y) in (0..size).flat_map(|y| (0..size).map(move |x| (x, y))).step_by(7) {
        let side = f64::from(size);
        let at = [f64::from(x) + 0.5, side - 0.5 - f64::from(y)].map(|c| (c / side - 0.5) * 2.2);
        let square = at[0] * at[0] + at[1] * at[1];
        if square > 0.9 {
            continue;
        }
        let n = [at[0], at[1], (1.0 - square).sqrt()];
        // Normals vary within a pixel as much as between neighboring pixels, which widens
        // highlights.
        let turn = 2.2 / side / n[2];
        let expected = expected_reflection([0.8, 0.4, 0.1], 0.6 + turn, n, l).map(|c| c * 2.5);
        assert_near(picture.pixel(x, y).unwrap(), expected, &format!("pixel ({x}, {y})"));
        seen += 1;
    }
    assert!(seen > 10_000);
}

fn pane_material(color: [f64; 4]) -> String {
    format!(
        r#"{{"alphaMode":"BLEND","extensions":{{"KHR_materials_unlit":{{}}}},"pbrMetallicRoughness":{{"baseColorFactor":{color:?}}}}}"#
    )
}

const PANES: [[f64; 4]; 3] = [[0.9, 0.2, 0.1, 0.5], [0.1, 0.7, 0.2, 0.25], [0.2, 0.3, 0.9, 0.75]];

#[test]
fn translucent_squares_blend_by_depth_in_any_file_order() {
    let mut expected = [1.0; 3];
    for [r, g, b, alpha] in PANES {
        expected = [0, 1, 2].map(|k: usize| [r, g, b][k] * alpha + expected[k] * (1.0 - alpha));
    }
    for order in [[0, 1, 2], [2, 0, 1], [1, 2, 0], [2, 1, 0]] {
        let parts = order.map(|n: usize| square_part(n as f32 * 0.3, &pane_material(PANES[n])));
        let rest = r##"image: (size: (40, 40), background: Color("#fff"), samples: 4)"##;
        let picture = render_parts(&parts, rest);
        for (x, y) in (4..36).flat_map(|y| (4..36).map(move |x| (x, y))) {
            assert_near(picture.pixel(x, y).unwrap(), expected, &format!("{order:?} ({x}, {y})"));
        }
    }
}

#[test]
fn transparent_pictures_over_a_color_match_opaque_pictures() {
    let parts = || {
        [
            sphere_part(MATTE),
            square_part(1.2, &pane_material(PANES[0])),
            square_part(-1.5, &pane_material(PANES[2])),
        ]
    };
    let rest = |background: &str| {
        let lights = "lights: [Directional(direction: (-1, -2, -2), intensity: 2.5), Ambient(intensity: 0.5)]";
        format!("{lights}, image: (size: (60, 60), background: {background}, samples: 4)")
    };
    // 16 bits are needed because half a code of 8-bit alpha is more than one code of color where
    // sRGB is steep.
    let clear = test_scene(&parts(), 1.0, &rest("Transparent"));
    let textures = Textures::for_scene(&clear);
    let context = RenderContext::new(&clear, &textures, 2);
    let mut picture = Picture::<u16>::default();
    Renderer::default().render(&context, &mut picture).expect("a picture");
    let clear = picture;
    for (text, color) in [("#fff", [1.0; 3]), ("#000", [0.0; 3]), ("#ff0000", [1.0, 0.0, 0.0])] {
        let solid = render_parts(&parts(), &rest(&format!("Color(\"{text}\")")));
        for (clear, solid) in clear.pixels.iter().zip(&solid.pixels) {
            let clear = clear.map(|code| f64::from(code) / 65535.0);
            let alpha = clear[3];
            let expected = [0, 1, 2].map(|k: usize| {
                let light = if clear[k] <= 0.04045 {
                    clear[k] / 12.92
                } else {
                    libm::pow((clear[k] + 0.055) / 1.055, 2.4)
                };
                light * alpha + color[k] * (1.0 - alpha)
            });
            assert_near(*solid, expected, &format!("{clear:?} over {text}"));
        }
    }
}

/// A sphere in uniform surroundings must not create light and may lose only a little.
#[test]
fn surfaces_in_white_surroundings_create_no_light() {
    let material = |metallic: f64, roughness: f64| {
        format!(
            r#"{{"pbrMetallicRoughness":{{"metallicFactor":{metallic},"roughnessFactor":{roughness}}}}}"#
        )
    };
    for (metallic, roughness) in
        [(0.0, 1.0), (0.0, 0.3), (1.0, 1.0), (1.0, 0.5), (1.0, 0.0), (0.5, 0.7)]
    {
        let rest = "environment: Uniform(strength: 0.5), lights: [], image: (size: (100, 100), samples: 1)";
        let picture = render_parts(&[sphere_part(&material(metallic, roughness))], rest);
        let inside = picture.pixels.iter().filter(|pixel| pixel[3] == 255);
        let codes: Vec<u8> = inside.map(|pixel| pixel[1]).collect();
        // Linear 0.5 is code 188 in sRGB. White scatters everything that it does not mirror, and
        // metal mirrors everything, so only rounding may lose light. A half-and-half material has a
        // reflectance of one half, so it loses the rest at each bounce except the first.
        let (least, most) = (codes.iter().min().unwrap(), codes.iter().max().unwrap());
        let lost = if metallic == 0.5 { 8 } else { 1 };
        let holds = codes.len() > 5000 && *least >= 188 - lost && *most <= 188;
        assert!(holds, "{metallic} {roughness}: {least} {most}");
    }
}
