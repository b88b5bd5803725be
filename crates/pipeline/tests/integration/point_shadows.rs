//! Shadows of point lights match rays from the lamp, on all six faces and across their seams.

use glam::{DVec3, DVec4};
use homog::{Affine, PixelRect};
use model::{Material, Mesh, Model, ModelInstance, Node, Primitive};
use pipeline::scene::parse_scene;
use pipeline::{Origin, Picture, RenderContext, Renderer, Scene, Textures, render};
use std::sync::Arc;

/// The position of the lamp, slightly off the center of the room.
const LAMP: DVec3 = DVec3::new(0.11, -0.07, 0.05);
/// Half of the room's side.
const ROOM: f64 = 3.0;
/// The directions from the center to the walls.
const DIRECTIONS: [[f64; 3]; 6] = [
    [1.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
];

/// A box given by its minimum and maximum coordinates.
type Box3 = [DVec3; 2];

/// Returns one box in front of each wall, one across the borders of three faces, and one across the
/// border of two.
fn boxes() -> Vec<Box3> {
    let around = |center: DVec3, half: f64| [center - half, center + half];
    let mut boxes: Vec<Box3> =
        DIRECTIONS.map(|direction| around(DVec3::from(direction) * 1.4, 0.3)).into();
    boxes.push(around(DVec3::new(1.0, 1.0, 1.05), 0.2));
    boxes.push(around(DVec3::new(-1.2, -0.1, 1.2), 0.25));
    boxes
}

/// Returns the six sides of a box.
fn box_mesh([low, high]: Box3) -> Primitive {
    let corner = |index: usize| {
        let pick = |axis: usize| if index >> axis & 1 == 0 { low[axis] } else { high[axis] };
        [pick(0) as f32, pick(1) as f32, pick(2) as f32]
    };
    let quads =
        [[0, 2, 6, 4], [1, 5, 7, 3], [0, 4, 5, 1], [2, 3, 7, 6], [0, 1, 3, 2], [4, 6, 7, 5]];
    let positions = quads.concat().into_iter().map(corner).collect();
    let indices = (0..6).flat_map(|quad| [0, 1, 2, 0, 2, 3].map(|k| 4 * quad + k)).collect();
    Primitive { positions, indices, ..Primitive::default() }
}

/// Returns a scene of matte white parts, visible from both sides.
fn white_scene(primitives: Vec<Primitive>, rest: &str) -> Scene {
    let text = format!(r#"Scene(models: [(path: "made")], {rest})"#);
    let file = parse_scene("made.ron", &text).expect("a scene");
    let white = Material {
        base_color: [0.8, 0.8, 0.8, 1.0],
        metallic: 0.0,
        roughness: 1.0,
        double_sided: true,
        ..Material::default()
    };
    let with_material = |primitive| Primitive { material: Some(0), ..primitive };
    let primitives = primitives.into_iter().map(with_material).collect();
    let model = Arc::new(Model {
        nodes: vec![Node { mesh: Some(0), ..Node::default() }],
        roots: vec![0],
        meshes: vec![Mesh { primitives, ..Mesh::default() }],
        materials: vec![white],
        ..Model::default()
    });
    let placed = ModelInstance { model, model_to_world: Affine::IDENTITY };
    let origin = Origin::from_text("made.ron", text, ".".into());
    Scene::from_models(&origin, &file, &[placed]).expect("a valid scene")
}

fn code_at(picture: &Picture, x: u32, y: u32) -> u8 {
    picture.pixels[(y * picture.width + x) as usize][0]
}

/// Returns the parameters at which a ray enters and leaves a box, if it meets the box.
fn meet_box([low, high]: Box3, from: DVec3, along: DVec3) -> Option<[f64; 2]> {
    let (a, b) = ((low - from) / along, (high - from) / along);
    let (enter, leave) = (a.min(b).max_element(), a.max(b).min_element());
    (enter < leave).then_some([enter, leave])
}

/// Whether a position on a wall is lit by the lamp.
fn is_lit(boxes: &[Box3], place: DVec3) -> bool {
    let along = LAMP - place;
    !boxes.iter().any(|&b| {
        meet_box(b, place, along).is_some_and(|[enter, leave]| enter < 1.0 && leave > 0.0)
    })
}

#[test]
fn shadows_in_all_six_directions_match_rays_from_the_lamp() {
    let boxes = boxes();
    let room = [DVec3::splat(-ROOM), DVec3::splat(ROOM)];
    let mut primitives: Vec<Primitive> = boxes.iter().map(|&b| box_mesh(b)).collect();
    primitives.push(box_mesh(room));
    for (wall, direction) in DIRECTIONS.into_iter().enumerate() {
        let towards = DVec3::from(direction);
        let (side, up) =
            (DVec3::from(DIRECTIONS[(wall + 2) % 6]), DVec3::from(DIRECTIONS[(wall + 4) % 6]));
        let eye = -1.0 * towards + 0.75 * side + 0.7 * up;
        let rest = format!(
            "camera: (view: LookTo(eye: ({}, {}, {}), gaze: ({}, {}, {}), up: ({}, {}, {})), projection: Perspective(fov_y_degrees: 80, near: 0.01)),
            lights: [Point(position: ({}, {}, {}), intensity: 30, shadows: On(softness_degrees: 0))], image: (size: (200, 200), samples: 1)",
            eye.x, eye.y, eye.z, towards.x, towards.y, towards.z, up.x, up.y, up.z, LAMP.x, LAMP.y, LAMP.z
        );
        let scene = white_scene(primitives.clone(), &rest);
        let picture = render(&scene, 2).expect("a picture");
        let clip_to_world = scene.view_projection.world_to_clip().raw().inverse();
        let mut counts = [0, 0];
        for (x, y) in (0..200).flat_map(|y| (0..200).map(move |x| (x, y))) {
            let ndc = [(f64::from(x) + 0.5) / 100.0 - 1.0, 1.0 - (f64::from(y) + 0.5) / 100.0];
            let seen = clip_to_world * DVec4::new(ndc[0], ndc[1], 0.0, 1.0);
            let along = (seen.truncate() / seen.w - eye).normalize();
            let Some([_, leave]) = meet_box(room, eye, along) else { panic!("in the room") };
            let place = eye + along * leave;
            // Only positions on this wall with nothing in front of them count.
            let is_hidden = boxes.iter().any(|&b| {
                meet_box([b[0] - 0.02, b[1] + 0.02], eye, along)
                    .is_some_and(|[_, leave]| leave > 0.0)
            });
            let on_wall =
                place.dot(towards) > ROOM - 1e-6 && place.abs().max_element() < ROOM + 1e-6;
            if is_hidden || !on_wall {
                continue;
            }
            // The offset is two texels, where 2048 texels cover the 6 units of a wall, plus half a
            // pixel.
            let border = [side, -side, up, -up].map(|way| is_lit(&boxes, place + 0.008 * way));
            let expected = is_lit(&boxes, place);
            if border.iter().any(|&near| near != expected) {
                continue;
            }
            counts[usize::from(expected)] += 1;
            let code = code_at(&picture, x, y);
            assert_eq!(code > 0, expected, "wall {direction:?}, position {place}: {code}");
        }
        assert!(counts[0] > 500 && counts[1] > 5000, "{direction:?}: {counts:?}");
    }
}

/// Returns a ball around the origin, seen from inside, with smooth normals that point inward.
fn hollow_ball(radius: f32, rows: u32) -> Primitive {
    let columns = 2 * rows;
    let mut primitive = Primitive::default();
    let mut normals = Vec::new();
    let pi = std::f64::consts::PI;
    for (row, column) in (0..=rows).flat_map(|row| (0..=columns).map(move |c| (row, c))) {
        let (a, b) =
            (pi * f64::from(row) / f64::from(rows), pi * f64::from(column) / f64::from(rows));
        let out = [libm::sin(a) * libm::sin(b), libm::cos(a), libm::sin(a) * libm::cos(b)];
        let out = out.map(|c| c as f32);
        normals.push(out.map(|c| -c));
        primitive.positions.push(out.map(|c| radius * c));
        if row < rows && column < columns {
            let at = row * (columns + 1) + column;
            let below = at + columns + 1;
            primitive.indices.extend([at, below + 1, below, at, at + 1, below + 1]);
        }
    }
    Primitive { normals: Some(normals), ..primitive }
}

#[test]
fn balls_around_the_lamp_do_not_shadow_themselves() {
    // A wide filter treats the ball's surface as its tangent plane, although the surface is
    // concave.
    for (position, shadows, tolerance) in [
        ("(0, 0, 0)", "On()", 0),
        ("(0.5, 0.3, -0.8)", "On()", 0),
        ("(0.5, 0.3, -0.8)", "On(softness_degrees: 0)", 0),
        ("(-1.9, 0.2, 1.1)", "On(softness_degrees: 5)", 8),
    ] {
        for gaze in ["(1, 1, 1)", "(-1, -0.9, 0.8)", "(1, -0.6, -1)"] {
            let render_with = |shadows: &str| {
                let rest = format!(
                    "camera: (view: LookTo(eye: (0, 0, 0), gaze: {gaze}), projection: Perspective(fov_y_degrees: 100, near: 0.1)),
                    lights: [Point(position: {position}, intensity: 20)], shadows: {shadows}, image: (size: (240, 200), samples: 1)"
                );
                render(&white_scene(vec![hollow_ball(3.0, 40)], &rest), 2).expect("a picture")
            };
            let (with, without) = (render_with(shadows), render_with("Off"));
            assert!(without.pixels.iter().all(|pixel| pixel[0] > 40), "the scene is lit");
            let pairs = with.pixels.iter().zip(&without.pixels);
            let most = pairs.map(|(a, b)| a[0].abs_diff(b[0])).max();
            assert!(most <= Some(tolerance), "{position} {shadows} {gaze}: {most:?}");
        }
    }
}

/// Returns a floor and three plates between it and a lamp, turned about the vertical axis through
/// the lamp.
fn turned_room(degrees: f64, rest: &str) -> Scene {
    let angle = degrees.to_radians();
    let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
    let turn = |[x, y, z]: [f32; 3]| {
        let (x, z) = (f64::from(x), f64::from(z));
        [(cosine * x + sine * z) as f32, y, (cosine * z - sine * x) as f32]
    };
    let floor = [DVec3::new(-6.0, -1.0, -6.0), DVec3::new(6.0, -0.9, 6.0)];
    let plate =
        |x: f64, z: f64| [DVec3::new(x - 0.2, -0.5, z - 0.2), DVec3::new(x + 0.2, -0.4, z + 0.2)];
    let parts = [floor, plate(0.75, 0.0), plate(0.0, 0.6), plate(-0.8, -0.8)].map(box_mesh);
    let parts = parts.map(|part| {
        let positions = part.positions.into_iter().map(turn).collect();
        Primitive { positions, ..part }
    });
    let eye = turn([0.0, 4.0, 5.0]);
    let rest = format!(
        "camera: (view: LookAt(eye: ({}, {}, {}), target: (0, -0.9, 0))), {rest}",
        eye[0], eye[1], eye[2]
    );
    white_scene(parts.into(), &rest)
}

/// Returns the linear light of a code.
fn linear(code: u8) -> f64 {
    let srgb = f64::from(code) / 255.0;
    if srgb <= 0.04045 { srgb / 12.92 } else { libm::pow((srgb + 0.055) / 1.055, 2.4) }
}

#[test]
fn penumbras_have_no_seams_between_faces() {
    // Turning everything except the light's faces moves the borders of the faces on the floor.
    let rest =
        "lights: [Point(position: (0, 0, 0), intensity: 8, shadows: On(softness_degrees: 6))],
        image: (size: (400, 300))";
    let whole = render(&turned_room(0.0, rest), 2).expect("a picture");
    for degrees in [20.0, 45.0] {
        let turned = render(&turned_room(degrees, rest), 2).expect("a picture");
        let pairs = whole.pixels.iter().zip(&turned.pixels);
        let mut differences: Vec<f64> =
            pairs.map(|(a, b)| (linear(a[0]) - linear(b[0])).abs()).collect();
        differences.sort_unstable_by(f64::total_cmp);
        let (most, last) =
            (differences[differences.len() * 999 / 1000], differences[differences.len() - 1]);
        // The pattern of 48 filter positions differs in the penumbra. If a face ended there, at
        // least half of the light would be missing.
        assert!(most < 0.05 && last < 0.15, "{degrees}: {most} {last}");
    }
}

#[test]
fn regions_in_the_light_of_a_lamp_match_the_whole_picture() {
    let scene = turned_room(
        30.0,
        "lights: [Point(position: (0, 0, 0), intensity: 8, shadows: On(softness_degrees: 6))],
        image: (size: (160, 120))",
    );
    let whole = render(&scene, 1).expect("a picture");
    let (textures, mut renderer) = (Textures::for_scene(&scene), Renderer::default());
    let context = RenderContext::new(&scene, &textures, 3);
    let mut prepared = renderer.prepare(&context).expect("a scene");
    for region in [
        PixelRect { x: 0, y: 0, width: 61, height: 120 },
        PixelRect { x: 61, y: 33, width: 99, height: 40 },
    ] {
        let mut part = Picture::<u8>::default();
        prepared.render_region(region, &mut part).expect("a region");
        for (x, y) in (0..region.height).flat_map(|y| (0..region.width).map(move |x| (x, y))) {
            let expected = whole.pixels[((y + region.y) * 160 + x + region.x) as usize];
            assert_eq!(part.pixels[(y * region.width + x) as usize], expected);
        }
    }
}
