//! Shadows: tight contacts, no self-shadowing and no light leaks through walls.

use homog::Affine;
use homog::PixelRect;
use model::ModelInstance;
use model::{AlphaMode, Material, Mesh, Model, Node, Primitive};
use pipeline::scene::parse_scene;
use pipeline::{Origin, Picture, RenderContext, Renderer, Scene, Textures, render};
use std::sync::Arc;

type Position = [f32; 3];

/// Builds a model from parts with materials.
fn build_model(parts: Vec<(Primitive, Material)>) -> Model {
    let (primitives, materials): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
    let primitives = primitives.into_iter().enumerate();
    let primitives =
        primitives.map(|(n, primitive)| Primitive { material: Some(n), ..primitive }).collect();
    Model {
        nodes: vec![Node { mesh: Some(0), ..Node::default() }],
        roots: vec![0],
        meshes: vec![Mesh { primitives, ..Mesh::default() }],
        materials,
        ..Model::default()
    }
}

fn matte_material(red: f32, green: f32, blue: f32) -> Material {
    let base_color = [red, green, blue, 1.0];
    Material { base_color, metallic: 0.0, roughness: 1.0, ..Material::default() }
}

/// Returns a material that is black in any light except for its emission.
fn emissive_material(emissive: [f32; 3]) -> Material {
    Material { emissive, double_sided: true, ..matte_material(0.0, 0.0, 0.0) }
}

fn quad_mesh(quads: &[[Position; 4]]) -> Primitive {
    let positions: Vec<Position> = quads.concat();
    let indices = (0..quads.len() as u32).flat_map(|n| [0, 1, 2, 0, 2, 3].map(|k| 4 * n + k));
    Primitive { indices: indices.collect(), positions, ..Primitive::default() }
}

/// Returns the square floor at y = 0 from −side to side.
fn floor_quad(side: f32) -> Primitive {
    quad_mesh(&[[[-side, 0.0, -side], [-side, 0.0, side], [side, 0.0, side], [side, 0.0, -side]]])
}

/// Returns the sides of a box, and its top if `top` is set.
fn box_sides([x0, y0, z0]: Position, [x1, y1, z1]: Position, top: bool) -> Primitive {
    let mut faces = vec![
        [[x0, y0, z1], [x1, y0, z1], [x1, y1, z1], [x0, y1, z1]],
        [[x1, y0, z0], [x0, y0, z0], [x0, y1, z0], [x1, y1, z0]],
        [[x0, y0, z0], [x0, y0, z1], [x0, y1, z1], [x0, y1, z0]],
        [[x1, y0, z1], [x1, y0, z0], [x1, y1, z0], [x1, y1, z1]],
    ];
    if top {
        faces.push([[x0, y1, z1], [x1, y1, z1], [x1, y1, z0], [x0, y1, z0]]);
    }
    quad_mesh(&faces)
}

/// Returns a coarse ball with smooth normals.
fn ball_mesh(center: Position, radius: f32, rows: u32) -> Primitive {
    let columns = 2 * rows;
    let mut primitive = Primitive::default();
    let mut normals = Vec::new();
    for (row, column) in (0..=rows).flat_map(|row| (0..=columns).map(move |c| (row, c))) {
        let pi = std::f64::consts::PI;
        let (a, b) =
            (pi * f64::from(row) / f64::from(rows), pi * f64::from(column) / f64::from(rows));
        let normal = [libm::sin(a) * libm::sin(b), libm::cos(a), libm::sin(a) * libm::cos(b)];
        let normal = normal.map(|c| c as f32);
        normals.push(normal);
        primitive.positions.push([0, 1, 2].map(|k: usize| center[k] + radius * normal[k]));
        if row < rows && column < columns {
            let at = row * (columns + 1) + column;
            let below = at + columns + 1;
            primitive.indices.extend([at, below, below + 1, at, below + 1, at + 1]);
        }
    }
    Primitive { normals: Some(normals), ..primitive }
}

fn shadow_scene(parts: Vec<(Primitive, Material)>, rest: &str) -> Scene {
    let text = format!(r#"Scene(models: [(path: "made")], {rest})"#);
    let file = parse_scene("made.ron", &text).expect("a scene");
    let placed =
        ModelInstance { model: Arc::new(build_model(parts)), model_to_world: Affine::IDENTITY };
    let origin = Origin::from_text("made.ron", text, ".".into());
    Scene::from_models(&origin, &file, &[placed]).expect("a valid scene")
}

fn render_parts(parts: Vec<(Primitive, Material)>, rest: &str) -> Picture {
    render(&shadow_scene(parts, rest), 2).expect("a picture")
}

fn pixel_at(picture: &Picture, x: u32, y: u32) -> [u8; 4] {
    picture.pixels[(y * picture.width + x) as usize]
}

/// Renders a box on a floor at 1080 lines, seen from one side.
fn render_box_on_floor(eye: &str, lights: &str) -> Picture {
    let parts = vec![
        (floor_quad(4.0), matte_material(0.8, 0.8, 0.8)),
        (box_sides([-0.5, 0.0, -0.5], [0.5, 1.0, 0.5], true), emissive_material([0.0, 0.0, 1.0])),
    ];
    let camera = format!(
        "camera: (view: LookAt(eye: {eye}, target: (0, 0.3, 0)), projection: Perspective(fov_y_degrees: 40))"
    );
    render_parts(
        parts,
        &format!("{camera}, lights: [{lights}], image: (size: (1920, 1080), samples: 1)"),
    )
}

/// Returns the codes of the floor below the box for each pixel column through the box's middle,
/// starting at the first pixel outside the box.
fn pixels_below_box(picture: &Picture) -> Vec<Vec<u8>> {
    let is_box =
        |x: u32, y: u32| pixel_at(picture, x, y)[2] > 250 && pixel_at(picture, x, y)[0] < 250;
    let middle = 860..1060;
    let column = |x: u32| {
        let last = (0..1080).rev().find(|&y| is_box(x, y)).expect("the box");
        (last + 1..1080).map(|y| pixel_at(picture, x, y)[0]).collect()
    };
    middle.map(column).collect()
}

#[test]
fn boxes_touch_their_shadows_and_lit_sides_stay_lit() {
    for lights in [
        "Directional(direction: (1, -1, 0.1), intensity: 3, shadows: On())",
        "Directional(direction: (1, -1, 0.1), intensity: 3, shadows: On(softness_degrees: 0))",
        "Directional(direction: (1, -0.8, 0.1), intensity: 3, shadows: On(softness_degrees: 4))",
        "Spot(position: (-4, 4, -0.4), direction: (1, -1, 0.1), intensity: 90, shadows: On())",
        "Point(position: (-4, 4, -0.4), intensity: 90, shadows: On())",
        "Point(position: (-4, 4, -0.4), intensity: 90, shadows: On(softness_degrees: 3))",
    ] {
        for column in pixels_below_box(&render_box_on_floor("(5, 3, 0)", lights)) {
            // Black from the second pixel on and lit again where the shadow ends.
            assert!(column[1..40].iter().all(|&code| code == 0), "{lights}: {:?}", &column[..40]);
            assert!(column.iter().any(|&code| code > 100), "{lights}");
        }
        for column in pixels_below_box(&render_box_on_floor("(-5, 3, 0)", lights)) {
            let expected = column[6];
            let near = |code: u8| code.abs_diff(expected) <= 4;
            assert!(
                expected > 100 && column[1..8].iter().all(|&c| near(c)),
                "{lights}: {:?}",
                &column[..8]
            );
        }
    }
}

/// Returns the maximum difference in codes between the scene with and without shadows.
fn greatest_difference(parts: &[(Primitive, Material)], rest: &str, shadows: &str) -> u8 {
    let without = render_parts(parts.to_vec(), &format!("{rest}, shadows: Off"));
    let with = render_parts(parts.to_vec(), &format!("{rest}, shadows: {shadows}"));
    assert!(without.pixels.iter().any(|pixel| pixel[0] > 60), "the scene is lit");
    let pairs = with.pixels.iter().zip(&without.pixels);
    pairs.map(|(a, b)| a[0].abs_diff(b[0])).max().expect("a pixel")
}

#[test]
fn balls_do_not_shadow_themselves_in_grazing_light() {
    // A row of balls perpendicular to the light, from coarse to fine. No ball is in the shadow of
    // another.
    let balls: Vec<_> = [(-4.0, 12), (-2.0, 24), (0.0, 48), (2.0, 96), (4.0, 192)]
        .map(|(x, rows)| (ball_mesh([x, 0.0, 0.0], 0.9, rows), matte_material(0.8, 0.8, 0.8)))
        .into();
    let camera = "camera: (view: LookAt(eye: (0, 0, 10), target: (0, 0, 0)), projection: Orthographic(height: 3))";
    for direction in ["(0, -1, -0.02)", "(0, -1, -0.3)", "(0, -0.2, -1)", "(0, -1, 0.4)"] {
        let rest = format!(
            "{camera}, lights: [Directional(direction: {direction}, intensity: 3)], image: (size: (1000, 300))"
        );
        for shadows in ["On()", "On(softness_degrees: 0)", "On(size: 512)"] {
            let difference = greatest_difference(&balls, &rest, shadows);
            assert!(difference <= 5, "{direction} {shadows}: {difference}");
        }
    }
}

#[test]
fn a_floor_and_a_bowl_do_not_shadow_themselves() {
    let camera = "camera: (view: LookAt(eye: (0, 4, 8), target: (0, 0, 0)))";
    for direction in ["(1, -0.03, 0.2)", "(1, -0.2, 0.2)", "(0.1, -1, 0)"] {
        let rest = format!(
            "{camera}, lights: [Directional(direction: {direction}, intensity: 60)], image: (size: (480, 270))"
        );
        let difference = greatest_difference(
            &[(floor_quad(30.0), matte_material(0.8, 0.8, 0.8))],
            &rest,
            "On()",
        );
        assert_eq!(difference, 0, "{direction}");
    }
    // The inside of a complete ball, lit by a spot light inside it.
    let mut bowl = ball_mesh([0.0; 3], 5.0, 40);
    bowl.indices =
        bowl.indices.as_chunks::<3>().0.iter().flat_map(|&[a, b, c]| [a, c, b]).collect();
    bowl.normals = bowl.normals.map(|list| list.iter().map(|n| n.map(|c| -c)).collect());
    let rest = "camera: (view: LookAt(eye: (0, 0, 4), target: (0, 0, 0))),
        lights: [Spot(position: (1, 1, 1), direction: (-1, -1, -2), intensity: 40)], image: (size: (480, 270))";
    let difference = greatest_difference(&[(bowl, matte_material(0.8, 0.8, 0.8))], rest, "On()");
    assert!(difference <= 1, "{difference}");
}

#[test]
fn walls_without_thickness_do_not_leak_light() {
    let wall = Material { double_sided: true, ..matte_material(0.8, 0.8, 0.8) };
    for (light, shadows) in [
        ("Directional(direction: (1, -1, 0.3), intensity: 3)", "On()"),
        ("Directional(direction: (1, -0.2, 0.3), intensity: 3)", "On(softness_degrees: 0)"),
        ("Directional(direction: (0.3, -1, -1), intensity: 3)", "On(softness_degrees: 2)"),
        ("Point(position: (-2.7, 2.5, -1), intensity: 40)", "On()"),
        ("Point(position: (0.3, 3, 0.2), intensity: 40)", "On(softness_degrees: 0)"),
    ] {
        let room = vec![
            (floor_quad(3.0), matte_material(0.8, 0.8, 0.8)),
            (box_sides([-2.0, 0.0, -2.0], [2.0, 2.0, 2.0], true), wall.clone()),
        ];
        let rest = format!(
            "camera: (view: LookAt(eye: (1.5, 1.5, 1.7), target: (-1, 0, -1)), projection: Perspective(fov_y_degrees: 90, near: 0.01)),
            lights: [{light}], shadows: {shadows}, image: (size: (960, 540), samples: 1)"
        );
        let picture = render_parts(room, &rest);
        // Light and shadow meet where two walls without thickness meet, so single pixels on the
        // edges may be lit.
        let lit = |x: u32, y: u32| u32::from(pixel_at(&picture, x, y)[0] > 0);
        let all = (0..540).flat_map(|y| (0..960).map(move |x| (x, y)));
        let (mut count, mut clump) = (0, 0);
        for (x, y) in all {
            count += lit(x, y);
            let block =
                (y..(y + 3).min(540)).flat_map(|y| (x..(x + 3).min(960)).map(move |x| (x, y)));
            clump = clump.max(block.map(|(x, y)| lit(x, y)).sum());
        }
        assert!(count < 600 && clump <= 6, "{light}: {count} {clump}");
    }
}

#[test]
fn masked_parts_cast_shadows_where_alpha_passes_and_blended_parts_cast_none() {
    let roof =
        || quad_mesh(&[[[-1.0, 1.0, -1.0], [-1.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 1.0, -1.0]]]);
    let shade_of = |alpha: f32, alpha_mode: AlphaMode| {
        let base_color = [0.5, 0.5, 0.5, alpha];
        let material =
            Material { base_color, alpha_mode, double_sided: true, ..Material::default() };
        let parts = vec![(floor_quad(3.0), matte_material(0.8, 0.8, 0.8)), (roof(), material)];
        let picture = render_parts(
            parts,
            "camera: (view: LookAt(eye: (0, 0.5, 5), target: (0, 0, 0))),
            lights: [Directional(direction: (0, -1, 0), intensity: 3)], shadows: On(), image: (size: (100, 100), samples: 1)",
        );
        pixel_at(&picture, 50, 50)[0]
    };
    let masked = |alpha| shade_of(alpha, AlphaMode::Mask { cutoff: 0.5 });
    assert_eq!((masked(0.6), shade_of(1.0, AlphaMode::Opaque)), (0, 0));
    let lit = masked(0.4);
    assert!(lit > 100);
    assert_eq!(shade_of(0.9, AlphaMode::Blend), lit);
}

#[test]
fn shadows_are_the_same_for_any_number_of_threads() {
    let parts = vec![
        (floor_quad(3.0), matte_material(0.8, 0.8, 0.8)),
        (ball_mesh([0.0, 1.0, 0.0], 0.7, 60), matte_material(0.8, 0.8, 0.8)),
    ];
    let scene = shadow_scene(
        parts,
        "lights: [Directional(direction: (1, -1, 0.3), intensity: 2, shadows: On(softness_degrees: 3)),
            Spot(position: (2, 3, 2), direction: (-2, -3, -2), intensity: 20, shadows: On()),
            Point(position: (-0.8, 1.9, 0.6), intensity: 5, shadows: On(softness_degrees: 2))],
        image: (size: (320, 200))",
    );
    let one = render(&scene, 1).expect("a picture");
    assert!(one == render(&scene, 3).expect("a picture"));
}

/// Renders a ball above a shadow-catching ground, with the sun directly overhead.
fn render_over_ground(background: &str, rest: &str) -> Picture {
    let ball = (ball_mesh([0.0, 1.0, 0.0], 0.5, 60), matte_material(0.8, 0.8, 0.8));
    render_parts(
        vec![ball],
        &format!(
            "camera: (view: LookAt(eye: (0, 4, 6), target: (0, 0.5, 0))), ground: Shadow(height: 0),
            image: (size: (300, 200), samples: 1, background: {background}), {rest}"
        ),
    )
}

/// Returns the pixel of a ground position in the picture of [`render_over_ground`].
fn pixel_of_ground_point(x: f64, z: f64) -> (u32, u32) {
    let scene = shadow_scene(
        vec![(ball_mesh([0.0, 1.0, 0.0], 0.5, 60), matte_material(0.8, 0.8, 0.8))],
        "camera: (view: LookAt(eye: (0, 4, 6), target: (0, 0.5, 0))), image: (size: (300, 200))",
    );
    let seen = scene
        .view_projection
        .world_to_clip()
        .transform_point(homog::Point::new(x, 0.0, z))
        .divide()
        .expect("a place");
    ((150.0 * (1.0 + seen.x())) as u32, (100.0 * (1.0 - seen.y())) as u32)
}

#[test]
fn ground_alpha_is_the_fraction_of_light_that_shadows_remove() {
    // 3 lux from the sun and 1 lux from all directions. Where the sun is hidden, three quarters of
    // the light are missing. The ball also blocks part of the remaining quarter: its solid angle
    // weighted by the cosine.
    let lights =
        "lights: [Directional(direction: (0, -1, 0), intensity: 3), Ambient(intensity: 1)]";
    let clear = render_over_ground("Transparent", lights);
    let at = |picture: &Picture, x, z| {
        let (x, y) = pixel_of_ground_point(x, z);
        pixel_at(picture, x, y)
    };
    let hidden = |distance: f64| 0.25 / libm::pow(1.0 + distance * distance, 1.5);
    for (x, z) in [(0.0, 0.3), (0.1, 0.35), (-0.3, -0.1)] {
        let expected = 255.0 * (1.0 - 0.25 * (1.0 - hidden(libm::hypot(x, z))));
        let [r, g, b, alpha] = at(&clear, x, z);
        assert!(
            [r, g, b] == [0; 3] && (f64::from(alpha) - expected).abs() < 3.0,
            "{x} {z} {alpha} {expected}"
        );
    }
    // Almost all light arrives next to the ball, and all light arrives far away.
    for (x, z, most) in [(0.0, 0.8, 8), (-0.8, 0.0, 8), (-1.3, 1.0, 0)] {
        assert!(at(&clear, x, z)[3] <= most, "{x} {z}");
    }
    // Over white, less than a quarter of the linear light is left.
    let white = render_over_ground("Color(\"#ffffff\")", lights);
    let [gray, _, _, alpha] = at(&white, 0.0, 0.3);
    assert!((118..130).contains(&gray) && alpha == 255, "{gray}");
    let none = render_over_ground("Transparent", &format!("{lights}, shadows: Off"));
    assert_eq!(at(&none, 0.0, 0.3), [0; 4]);
}

#[test]
fn occlusion_darkens_corners_but_not_open_surfaces() {
    let draw_both = |parts: Vec<(Primitive, Material)>, lights: &str| {
        let rest = format!(
            "camera: (view: LookAt(eye: (0, 3, 3), target: (0, 0, 0))), lights: [{lights}], image: (size: (300, 200), samples: 1)"
        );
        let without = render_parts(parts.clone(), &rest);
        (without, render_parts(parts, &format!("{rest}, ambient_occlusion: (radius: 1)")))
    };
    let floor = || (floor_quad(6.0), matte_material(0.8, 0.8, 0.8));
    let (without, with) = draw_both(vec![floor()], "Ambient(intensity: 3)");
    assert!(without == with, "a plane must not be occluded");
    let (without, with) = draw_both(
        vec![(ball_mesh([0.0; 3], 1.0, 60), matte_material(0.8, 0.8, 0.8))],
        "Ambient(intensity: 3)",
    );
    let pairs = with.pixels.iter().zip(&without.pixels);
    assert!(
        pairs.map(|(a, b)| a[0].abs_diff(b[0])).max() <= Some(8),
        "a ball must not be occluded except along its facets"
    );
    // A dark wall on a dark floor: half of the light is missing at the foot of the wall, and none
    // far away.
    let wall_on_floor = |albedo: f32| {
        let material = matte_material(albedo, albedo, albedo);
        let wall = box_sides([-6.0, 0.0, -4.0], [6.0, 4.0, -0.5], false);
        vec![(floor_quad(6.0), material.clone()), (wall, material)]
    };
    let parts = wall_on_floor(0.02);
    let (without, with) = draw_both(parts.clone(), "Ambient(intensity: 120)");
    let linear = |code: u8| {
        let srgb = f64::from(code) / 255.0;
        if srgb <= 0.04045 { srgb / 12.92 } else { libm::pow((srgb + 0.055) / 1.055, 2.4) }
    };
    let foot = (0..200)
        .find(|&y| pixel_at(&with, 150, y)[0] != pixel_at(&without, 150, y)[0])
        .expect("a corner");
    let least = (foot..200)
        .map(|y| linear(pixel_at(&with, 150, y)[0]) / linear(pixel_at(&without, 150, y)[0]));
    let least = least.fold(1.0, f64::min);
    assert!((0.35..0.62).contains(&least), "{least}");
    assert_eq!(pixel_at(&with, 150, 199), pixel_at(&without, 150, 199));
    // Sunlight is unaffected.
    let sun = "Directional(direction: (0, -1, -1), intensity: 3)";
    let (without, with) = draw_both(wall_on_floor(0.8), sun);
    assert!(without == with);
}

#[test]
fn occlusion_has_no_stripes_next_to_sharp_edges() {
    // A box at 1080 lines, with an occlusion radius that covers a large part of the screen. The
    // test looks at the ground to the left of the box.
    let parts = vec![
        (floor_quad(6.0), matte_material(0.05, 0.05, 0.05)),
        (box_sides([-0.5, 0.0, -0.5], [0.5, 1.0, 0.5], true), matte_material(0.05, 0.05, 0.05)),
    ];
    let scene = shadow_scene(
        parts,
        "camera: (view: LookAt(eye: (2.2, 2.6, 3.6), target: (0, 0.3, 0)), projection: Perspective(fov_y_degrees: 32)),
        lights: [Ambient(intensity: 50)], ambient_occlusion: (radius: 1), image: (size: (1920, 1080), samples: 1)",
    );
    let (textures, mut renderer) = (Textures::for_scene(&scene), Renderer::default());
    let context = RenderContext::new(&scene, &textures, 2);
    let mut prepared = renderer.prepare(&context).expect("a scene");
    let region = PixelRect { x: 545, y: 570, width: 110, height: 60 };
    let mut picture = Picture::<u16>::default();
    prepared.render_region(region, &mut picture).expect("a region");
    let code =
        |x: u32, y: u32| f64::from(picture.pixels[(y * region.width + x) as usize][0]) / 257.0;
    let (mut step, mut back) = (0.0_f64, 0.0_f64);
    for (x, y) in (0..region.height).flat_map(|y| (1..region.width - 1).map(move |x| (x, y))) {
        // The difference between a pixel and the mean of its neighbors, and the increase from a
        // pixel to the next one toward the box.
        step = step.max((code(x, y) - 0.5 * (code(x - 1, y) + code(x + 1, y))).abs());
        back = back.max(code(x + 1, y) - code(x, y));
    }
    let fall = code(0, 30) - code(100, 30);
    assert!(fall > 8.0, "the ground must be darker next to the box: {fall}");
    assert!(step < 0.5 && back < 0.25, "step {step}, back {back}");
}
