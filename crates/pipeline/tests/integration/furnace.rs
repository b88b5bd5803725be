//! White furnace test: a white metal in uniform light reflects all the light it receives, at any
//! anisotropy.

use homog::Affine;
use model::{
    Anisotropy, Material, MaterialExtensions, Mesh, Model, ModelInstance, Node, Primitive,
};
use pipeline::scene::parse_scene;
use pipeline::{Origin, Picture, RenderContext, Renderer, Scene, Textures};
use std::sync::Arc;

/// The side of the picture, which the ball fills.
const SIDE: u32 = 161;

/// Returns a ball of radius 1 with tangents along its circles of latitude.
fn ball_mesh(rows: u32) -> Primitive {
    let mut primitive = Primitive { material: Some(0), ..Primitive::default() };
    let (mut normals, mut tangents) = (Vec::new(), Vec::new());
    let columns = 2 * rows;
    let pi = std::f64::consts::PI;
    for (row, column) in (0..=rows).flat_map(|row| (0..=columns).map(move |c| (row, c))) {
        let (a, b) =
            (pi * f64::from(row) / f64::from(rows), pi * f64::from(column) / f64::from(rows));
        let normal = [libm::sin(a) * libm::sin(b), libm::cos(a), libm::sin(a) * libm::cos(b)];
        primitive.positions.push(normal.map(|c| c as f32));
        normals.push(normal.map(|c| c as f32));
        tangents.push([libm::cos(b) as f32, 0.0, -libm::sin(b) as f32, 1.0]);
        if row < rows && column < columns {
            let at = row * (columns + 1) + column;
            let below = at + columns + 1;
            primitive.indices.extend([at, below, below + 1, at, below + 1, at + 1]);
        }
    }
    Primitive { normals: Some(normals), tangents: Some(tangents), ..primitive }
}

/// Renders a white metal ball in uniform light of strength 0.5, in parallel projection.
fn furnace_picture(strength: f32, roughness: f32) -> Picture<u16> {
    let anisotropy =
        (strength > 0.0).then(|| Box::new(Anisotropy { strength, ..Anisotropy::default() }));
    let extensions = MaterialExtensions { anisotropy, ..MaterialExtensions::default() };
    let base_color = [1.0; 4];
    let metal =
        Material { base_color, metallic: 1.0, roughness, extensions, ..Material::default() };
    let model = Model {
        nodes: vec![Node { mesh: Some(0), ..Node::default() }],
        roots: vec![0],
        meshes: vec![Mesh { primitives: vec![ball_mesh(64)], ..Mesh::default() }],
        materials: vec![metal],
        ..Model::default()
    };
    let text = format!(
        r#"Scene(models: [(path: "made")], lights: [], environment: Uniform(strength: 0.5),
        camera: (view: LookAt(eye: (0.6, 0.5, 3), target: (0, 0, 0)), projection: Orthographic(height: 2)),
        image: (size: ({SIDE}, {SIDE}), samples: 1))"#
    );
    let file = parse_scene("made.ron", &text).expect("a scene");
    let origin = Origin::from_text("made.ron", text, ".".into());
    let placed = ModelInstance { model: Arc::new(model), model_to_world: Affine::IDENTITY };
    let scene = Scene::from_models(&origin, &file, &[placed]).expect("a scene");
    let textures = Textures::for_scene(&scene);
    let mut picture = Picture::default();
    let context = RenderContext::new(&scene, &textures, 2);
    Renderer::default().render(&context, &mut picture).expect("a picture");
    picture
}

/// Returns the linear light of a 16-bit code.
fn linear(code: u16) -> f64 {
    let srgb = f64::from(code) / 65535.0;
    if srgb <= 0.04045 { srgb / 12.92 } else { libm::pow((srgb + 0.055) / 1.055, 2.4) }
}

#[test]
fn anisotropic_metal_reflects_as_much_as_isotropic_metal() {
    for roughness in [0.2, 0.5, 0.8] {
        let isotropic = furnace_picture(0.0, roughness);
        for strength in [0.5, 1.0] {
            let picture = furnace_picture(strength, roughness);
            for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
                // Only pixels with a viewing angle of at most 80° are compared.
                let from_center = |at: u32| (2.0 * f64::from(at) + 1.0) / f64::from(SIDE) - 1.0;
                let sine = libm::hypot(from_center(x), from_center(y));
                if sine > libm::sin(80_f64.to_radians()) {
                    continue;
                }
                let at = (y * SIDE + x) as usize;
                for channel in 0..3 {
                    let expected = linear(isotropic.pixels[at][channel]);
                    let actual = linear(picture.pixels[at][channel]);
                    assert!((expected / 0.5 - 1.0).abs() < 0.02, "a furnace: {expected}");
                    let ratio = actual / expected;
                    assert!((ratio - 1.0).abs() < 0.02, "{roughness} {strength}, {x} {y}: {ratio}");
                }
            }
        }
    }
}
