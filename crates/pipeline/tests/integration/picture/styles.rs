//! Styles: the passes and each style's formula predict the pixels.

use super::load_scene;
use model::Colormap;
use pipeline::render::{Pass, PassBuffer, render_passes};
use pipeline::scene::Style;
use pipeline::{Picture, Scene, Timings, render};
use shade::Light;
use std::f64::consts::PI;

const IMAGE_SIZE: (u32, u32) = (160, 120);

fn styled_scene(name: &str, style: Style) -> Scene {
    let mut scene = load_scene(name, |file| {
        file.image.size = IMAGE_SIZE;
        file.image.samples = 1;
    });
    scene.style = style;
    scene
}

fn render_scene(scene: &Scene) -> Picture {
    render(scene, 2).expect("a picture")
}

fn render_wanted_passes(scene: &Scene, wanted: &[Pass]) -> Vec<PassBuffer> {
    render_passes(scene, scene.image.pixel_rect(), wanted, 2, &Timings::default()).expect("passes")
}

/// Calls `each` with the position of each pixel that shows a surface, and returns their number.
fn for_each_covered_pixel(ids: &PassBuffer, mut each: impl FnMut(u32, u32)) -> usize {
    let mut seen = 0;
    for (x, y) in (0..IMAGE_SIZE.1).flat_map(|y| (0..IMAGE_SIZE.0).map(move |x| (x, y))) {
        if ids.integer_value(x, y) != Some(0) {
            each(x, y);
            seen += 1;
        }
    }
    seen
}

fn float_values<const N: usize>(pass: &PassBuffer, x: u32, y: u32) -> [f64; N] {
    let values = pass.float_values(x, y).expect("a pixel");
    std::array::from_fn(|k| f64::from(values[k]))
}

fn encode_srgb(light: f64) -> f64 {
    let light = light.clamp(0.0, 1.0);
    255.0
        * if light <= 0.003_130_8 {
            light * 12.92
        } else {
            1.055 * libm::pow(light, 1.0 / 2.4) - 0.055
        }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[test]
fn normal_style_matches_the_normal_pass() {
    let scene = styled_scene("teapot", Style::Normals);
    let (picture, told) =
        (render_scene(&scene), render_wanted_passes(&scene, &[Pass::Id, Pass::Normal]));
    let mut far = 0;
    let seen = for_each_covered_pixel(&told[0], |x, y| {
        let normal: [f64; 3] = float_values(&told[1], x, y);
        let pixel = picture.pixel(x, y).expect("a pixel");
        for k in 0..3 {
            let expected = 255.0 * (0.5 * normal[k] + 0.5);
            // Shading uses corners snapped to 1/256 pixel, which matters for small triangles.
            let off = (f64::from(pixel[k]) - expected).abs();
            assert!(off < 6.0, "({x}, {y}) {pixel:?} {normal:?}");
            far += usize::from(off > 1.0);
        }
    });
    assert!(seen > 3000 && far * 50 < seen, "{far} of {seen}");
}

#[test]
fn depth_is_linear_from_the_nearest_to_the_farthest_vertex() {
    let scene = styled_scene("teapot", Style::Depth(None));
    let (picture, told) =
        (render_scene(&scene), render_wanted_passes(&scene, &[Pass::Id, Pass::Depth]));
    let world_to_view = scene.view_projection.camera.world_to_view();
    let depths = scene.world_points();
    let depths = depths.iter().map(|point| -world_to_view.transform_point(*point).z());
    let (near, far) = depths.fold((f64::INFINITY, 0.0_f64), |(a, b), d| (a.min(d), b.max(d)));
    for_each_covered_pixel(&told[0], |x, y| {
        let [depth] = float_values(&told[1], x, y);
        let expected = 255.0 * (0.1 + 0.9 * (far - depth) / (far - near));
        let [r, g, b, a] = picture.pixel(x, y).expect("a pixel");
        assert!(r == g && g == b && a == 255);
        assert!((f64::from(r) - expected).abs() < 0.8, "({x}, {y}): {r} {expected}");
    });
}

#[test]
fn colormapped_depth_has_the_last_color_at_the_nearest_vertex() {
    let colormap = Colormap::Turbo;
    let scene = styled_scene("teapot", Style::Depth(Some(colormap)));
    let (picture, told) =
        (render_scene(&scene), render_wanted_passes(&scene, &[Pass::Id, Pass::Depth]));
    let world_to_view = scene.view_projection.camera.world_to_view();
    let depths = scene.world_points();
    let depths = depths.iter().map(|point| -world_to_view.transform_point(*point).z());
    let (near, far) = depths.fold((f64::INFINITY, 0.0_f64), |(a, b), d| (a.min(d), b.max(d)));
    let seen = for_each_covered_pixel(&told[0], |x, y| {
        let [depth] = float_values(&told[1], x, y);
        let expected = colormap.srgb_at(((far - depth) / (far - near)) as f32);
        let pixel = picture.pixel(x, y).expect("a pixel");
        for (code, fraction) in pixel.iter().zip(expected) {
            let off = (f64::from(*code) - 255.0 * f64::from(fraction)).abs();
            assert!(off < 1.5, "({x}, {y}): {pixel:?} {expected:?}");
        }
    });
    assert!(seen > 3000, "{seen}");
}

/// Returns the light that a white Lambertian surface reflects from suns and ambient light.
fn expected_light(scene: &Scene, normal: [f64; 3]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for light in &scene.lights {
        let (cosine, lux) = match light {
            Light::Sun { to_light: towards, lux, .. } => {
                (dot(normal, towards.map(f64::from)).max(0.0), *lux)
            }
            Light::Ambient { lux } => (1.0, *lux),
            _ => panic!("the scene has only sun and ambient lights"),
        };
        for k in 0..3 {
            sum[k] += f64::from(lux[k]) * cosine / PI;
        }
    }
    sum
}

#[test]
fn clay_is_matte_in_the_light_of_the_scene() {
    let mut scene = styled_scene("teapot", Style::Clay);
    scene.environment = None;
    let (picture, told) =
        (render_scene(&scene), render_wanted_passes(&scene, &[Pass::Id, Pass::Normal]));
    for_each_covered_pixel(&told[0], |x, y| {
        let light = expected_light(&scene, float_values(&told[1], x, y));
        let pixel = picture.pixel(x, y).expect("a pixel");
        for (k, clay) in [0.58, 0.52, 0.46].into_iter().enumerate() {
            let expected = encode_srgb(clay * light[k]);
            assert!(
                (f64::from(pixel[k]) - expected).abs() < 1.6,
                "({x}, {y}) {pixel:?} {expected}"
            );
        }
    });
}

#[test]
fn clay_is_even_on_flat_faces_and_differs_from_gouraud() {
    // All normals of a crate's face are equal, so clay in sunlight has the same color everywhere on
    // it.
    let (gouraud, clay) =
        (styled_scene("crates", Style::Gouraud), styled_scene("crates", Style::Clay));
    let told = render_wanted_passes(&gouraud, &[Pass::Id, Pass::Normal, Pass::Material]);
    let (gouraud, clay) = (render_scene(&gouraud), render_scene(&clay));
    let mut faces: Vec<([i32; 3], [u8; 4])> = Vec::new();
    let seen = for_each_covered_pixel(&told[0], |x, y| {
        let normal: [f64; 3] = float_values(&told[1], x, y);
        let normal = normal.map(|c| libm::round(c * 1000.0) as i32);
        let even = clay.pixel(x, y).expect("a pixel");
        match faces.iter().find(|(known, _)| *known == normal) {
            Some((_, known)) => assert!((0..3).all(|k| known[k].abs_diff(even[k]) <= 1)),
            None => faces.push((normal, even)),
        }
    });
    assert!(seen > 2000 && faces.len() >= 3, "{seen} {}", faces.len());
    assert_ne!(gouraud, clay, "wood must differ from clay");
}

#[test]
fn ids_give_each_node_a_distinct_color() {
    let scene = styled_scene("teapot", Style::Ids);
    let picture = render_scene(&scene);
    let told = render_wanted_passes(&scene, &[Pass::Id, Pass::Node]);
    let mut colors: Vec<(u32, [u8; 4])> = Vec::new();
    for_each_covered_pixel(&told[0], |x, y| {
        let node = told[1].integer_value(x, y).expect("a pixel");
        let color = picture.pixel(x, y).expect("a pixel");
        match colors.iter().find(|(known, _)| *known == node) {
            Some((_, known)) => assert_eq!(color, *known, "({x}, {y})"),
            None => colors.push((node, color)),
        }
    });
    let mut different: Vec<_> = colors.iter().map(|(_, color)| *color).collect();
    different.sort_unstable();
    different.dedup();
    assert!(colors.len() >= 3 && different.len() == colors.len(), "{colors:?}");
}

#[test]
fn checkers_change_at_every_eighth_of_the_texture_coordinates() {
    let scene = styled_scene("crates", Style::UvChecker);
    let picture = render_scene(&scene);
    let told = render_wanted_passes(&scene, &[Pass::Id, Pass::Uv, Pass::Normal]);
    let mut sums = [[0.0; 2]; 2];
    for_each_covered_pixel(&told[0], |x, y| {
        let [u, v]: [f64; 2] = float_values(&told[1], x, y);
        let place = [u, v].map(|c| c * 8.0);
        // Skips the borders of squares.
        if place.iter().any(|c| (c - libm::round(*c)).abs() < 0.1) {
            return;
        }
        let odd = (libm::floor(place[0]) + libm::floor(place[1])).rem_euclid(2.0) as usize;
        let [r, _, b, _] = picture.pixel(x, y).expect("a pixel");
        // Blue does not depend on the position; the ratio of red to blue increases with u.
        let share = f64::from(r) / f64::from(b) * 0.55;
        let expected = 0.35 + 0.65 * (u - libm::floor(u));
        assert!((share - expected).abs() < 0.02, "({x}, {y}): {share} {expected}");
        sums[odd][0] += f64::from(b);
        sums[odd][1] += 1.0;
    });
    let [even, odd] = sums.map(|[sum, count]| sum / count);
    assert!(odd < 0.85 * even, "odd squares must be darker: {odd} {even}");
}

#[test]
fn unlit_style_shows_base_colors() {
    let mut scene = styled_scene("spheres", Style::Unlit);
    scene.tone_mapper.exposure = 4.0;
    let picture = render_scene(&scene);
    let passes = render_wanted_passes(&scene, &[Pass::Id, Pass::Material]);
    let seen = for_each_covered_pixel(&passes[0], |x, y| {
        let id = passes[1].integer_value(x, y).expect("a pixel") as usize;
        let materials: Vec<_> =
            scene.models.iter().flat_map(|placed| &placed.model.materials).collect();
        let base = id.checked_sub(1).map_or([1.0; 4], |index| materials[index].base_color);
        let color = picture.pixel(x, y).expect("a pixel");
        for (code, light) in color.into_iter().zip(base).take(3) {
            let expected = encode_srgb(light.into());
            assert!((f64::from(code) - expected).abs() < 0.6, "({x}, {y}): {code} {expected}");
        }
    });
    assert!(seen > 1000, "{seen}");
}

#[test]
fn toon_style_has_few_tones_and_dark_outlines() {
    let scene = styled_scene("spheres", Style::Toon);
    let picture = render_scene(&scene);
    let told = render_wanted_passes(&scene, &[Pass::Id, Pass::Material]);
    let mut tones: Vec<(u32, Vec<[u8; 4]>)> = Vec::new();
    let (mut dark, mut inner) = (0, 0);
    for_each_covered_pixel(&told[0], |x, y| {
        let color = picture.pixel(x, y).expect("a pixel");
        let around = [(x.wrapping_sub(2), y), (x + 2, y), (x, y.wrapping_sub(2)), (x, y + 2)];
        let ids = around.map(|(x, y)| told[1].integer_value(x, y));
        if ids.iter().any(|id| *id != told[1].integer_value(x, y)) {
            dark += usize::from(color[..3].iter().all(|c| *c < 60));
            return;
        }
        inner += 1;
        let material = ids[0].expect("a pixel");
        match tones.iter_mut().find(|(known, _)| *known == material) {
            Some((_, tones)) if tones.contains(&color) => {}
            Some((_, tones)) => tones.push(color),
            None => tones.push((material, vec![color])),
        }
    });
    assert!(inner > 500 && dark > 50, "{inner} {dark}");
    for (material, tones) in tones {
        assert!(tones.len() <= 3 + 12, "material {material} has {} tones", tones.len());
    }
}

#[test]
fn x_ray_shows_hidden_surfaces_and_back_faces() {
    let mut glass = styled_scene("spheres", Style::XRay);
    glass.image.background = [0.0; 4];
    let picture = render_scene(&glass);
    let told = render_wanted_passes(&glass, &[Pass::Id, Pass::ViewNormal, Pass::Distance]);
    let seen = for_each_covered_pixel(&told[0], |x, y| {
        let [.., alpha] = picture.pixel(x, y).expect("a pixel");
        // At least two layers, front and back, with an opacity of 7% to 80%.
        assert!(alpha > 30 && alpha < 255, "({x}, {y}): {alpha}");
    });
    assert!(seen > 500);
}

#[test]
fn matcaps_depend_only_on_view_space_normals() {
    let scene = styled_scene("spheres", Style::Matcap);
    let mut dark = scene.clone();
    (dark.lights, dark.environment) = (Vec::new(), None);
    assert_eq!(
        render_scene(&scene),
        render_scene(&dark),
        "the lights of the scene must not matter"
    );
}
