//! Refracting and rough glass: Snell's law, dispersion, blur, energy, order and alpha.

use super::*;
use homog::PixelRect;

/// Returns glass of this roughness without specular reflection, with additional extensions.
fn bending_glass(roughness: f64, color: [f64; 3], extensions: &str) -> String {
    let [r, g, b] = color;
    format!(
        r#"{{"extensions":{{"KHR_materials_transmission":{{"transmissionFactor":1}},
            "KHR_materials_specular":{{"specularFactor":0}}{extensions}}},
            "pbrMetallicRoughness":{{"metallicFactor":0,"roughnessFactor":{roughness},
            "baseColorFactor":[{r},{g},{b},1]}}}}"#
    )
}

fn thick_glass(ior: f64, thickness: f64, dispersion: f64) -> String {
    let extensions = format!(
        r#","KHR_materials_ior":{{"ior":{ior}}},
            "KHR_materials_volume":{{"thicknessFactor":{thickness}}},
            "KHR_materials_dispersion":{{"dispersion":{dispersion}}}"#
    );
    bending_glass(0.0, [1.0; 3], &extensions)
}

/// Returns an opaque material whose color is shown unchanged.
fn opaque_material([r, g, b]: [f64; 3]) -> String {
    format!(
        r#"{{"extensions":{{"KHR_materials_unlit":{{}}}},
            "pbrMetallicRoughness":{{"baseColorFactor":[{r},{g},{b},1]}}}}"#
    )
}

/// Returns a white rectangle far behind the glass, from x = 0 to the right.
fn white_half() -> TestPart {
    let mut part = square_part(-2.0, &opaque_material([1.0; 3]));
    for [x, y, _] in &mut part.positions {
        (*x, *y) = (if *x < 0.0 { 0.0 } else { 4.0 }, *y * 4.0);
    }
    part
}

/// Returns the square tilted by 45 degrees about y, with its normal leaning to the left.
fn tilted_square(material: &str) -> TestPart {
    let mut part = square_part(0.0, material);
    for [x, _, z] in &mut part.positions {
        *z = *x;
    }
    let leaning = std::f32::consts::FRAC_1_SQRT_2;
    part.normals.fill([-leaning, 0.0, leaning]);
    part
}

/// Renders a background that is black on the left and white on the right, seen through a part.
/// `side` pixels correspond to 2.2 units.
fn render_edge(part: TestPart, side: u32) -> Picture {
    let image = format!(r##"size: ({side}, {side}), background: Color("#000"), samples: 4"##);
    render_parts(&[part, white_half()], &format!("lights: [], image: ({image})"))
}

/// Returns the column, in pixels from the left, at which a channel of the middle row exceeds a
/// threshold.
fn rising_column(picture: &Picture, channel: usize, threshold: f64) -> f64 {
    let light = |x: u32| {
        let pixel = picture.pixel(x, picture.height / 2).expect("a pixel");
        shade::color::srgb_to_linear(f64::from(pixel[channel]) / 255.0)
    };
    // The glass covers the middle 2 of 2.2 units.
    let first = picture.width / 16;
    let x = (first..picture.width).find(|x| light(*x) >= threshold).expect("an edge");
    let (before, after) = (light(x - 1), light(x));
    f64::from(x) - 0.5 + (threshold - before) / (after - before)
}

/// Returns the number of columns by which Snell's law shifts the background seen through the tilted
/// square.
fn expected_shift(ior: f64, thickness: f64, side: u32) -> f64 {
    let incident = PI / 4.0;
    let refracted = libm::asin(libm::sin(incident) / ior);
    thickness * libm::sin(incident - refracted) * f64::from(side) / 2.2
}

#[test]
fn thick_glass_shifts_an_edge_by_snells_law() {
    for (ior, thickness) in [(1.33, 0.6), (1.5, 0.3), (1.5, 0.6), (2.4, 0.6)] {
        let picture = render_edge(tilted_square(&thick_glass(ior, thickness, 0.0)), 200);
        let shift = 100.0 - rising_column(&picture, 1, 0.5);
        let expected = expected_shift(ior, thickness, 200);
        assert!(
            (shift - expected).abs() < 1.0,
            "{ior} {thickness}: shift {shift}, expected {expected}"
        );
    }
}

#[test]
fn dispersion_refracts_blue_most_and_red_least() {
    let picture = render_edge(tilted_square(&thick_glass(1.5, 0.6, 10.0)), 200);
    let shifts = [0, 1, 2].map(|channel| 100.0 - rising_column(&picture, channel, 0.5));
    assert!(shifts[0] + 1.0 < shifts[1] && shifts[1] + 1.0 < shifts[2], "{shifts:?}");
    // Half of the spread is (n − 1) / 40 per unit of dispersion.
    for (shift, ior) in shifts.into_iter().zip([1.375, 1.5, 1.625]) {
        let expected = expected_shift(ior, 0.6, 200);
        assert!((shift - expected).abs() < 1.0, "{ior}: shift {shift}, expected {expected}");
    }
}

/// Returns the number of columns over which an edge behind glass of this roughness rises from one
/// quarter to three quarters.
fn edge_width(roughness: f64, side: u32) -> f64 {
    let glass = bending_glass(roughness, [1.0; 3], "");
    let picture = render_edge(square_part(0.0, &glass), side);
    rising_column(&picture, 1, 0.75) - rising_column(&picture, 1, 0.25)
}

#[test]
fn rougher_glass_blurs_an_edge_more() {
    let mut last = edge_width(0.0, 200);
    for roughness in [0.1, 0.2, 0.35, 0.5, 0.6] {
        let width = edge_width(roughness, 200);
        assert!(width > 1.1 * last, "{roughness}: {width} after {last}");
        last = width;
    }
    // The blur is the same fraction of the picture at every size.
    let (small, large) = (edge_width(0.5, 150), edge_width(0.5, 600));
    assert!((large / small / 4.0 - 1.0).abs() < 0.2, "{small} {large}");
}

#[test]
fn rough_and_thick_glass_in_white_surroundings_conserves_light() {
    let volume = r#""KHR_materials_volume":{"thicknessFactor":0.7},"#;
    for (roughness, volume, background) in [
        (0.2, "", "Environment()"),
        (0.5, "", "Environment()"),
        (0.8, "", "Environment()"),
        (0.0, volume, "Environment()"),
        (0.5, volume, "Environment()"),
        (0.2, "", "Color(\"#bcbcbc\")"),
        (0.8, volume, "Color(\"#bcbcbc\")"),
        (0.5, volume, "Gradient(colors: [\"#bcbcbc\", \"#bcbcbc\"])"),
    ] {
        let material = format!(
            r#"{{"extensions":{{{volume}"KHR_materials_transmission":{{"transmissionFactor":1}}}},
            "pbrMetallicRoughness":{{"metallicFactor":0,"roughnessFactor":{roughness}}}}}"#
        );
        let rest = format!(
            "environment: Uniform(strength: 0.5), lights: [],
            image: (size: (100, 100), samples: 4, background: {background})"
        );
        let picture = render_parts(&[sphere_part(&material)], &rest);
        for pixel in &picture.pixels {
            let light = shade::color::srgb_to_linear(f64::from(pixel[1]) / 255.0);
            let holds = (light / 0.5 - 1.0).abs() < 0.02 && pixel[3] == 255;
            assert!(holds, "{roughness} {volume} {background}: {pixel:?}");
        }
    }
}

#[test]
fn panes_are_blended_in_front_of_rough_glass_and_omitted_behind_it() {
    let (green, tint) = ([0.2, 0.9, 0.4], [0.9, 0.5, 0.7]);
    let glass = bending_glass(0.4, tint, "");
    let pane = |z: f32| square_part(z, &pane_material(PANES[0]));
    let mut wall = square_part(-1.0, &opaque_material(green));
    wall.positions.iter_mut().for_each(|[x, y, _]| (*x, *y) = (*x * 4.0, *y * 4.0));
    let rest = "lights: [], image: (size: (40, 40), samples: 4)";
    let seen = [0, 1, 2].map(|k: usize| green[k] * tint[k]);
    let [r, g, b, alpha] = PANES[0];
    let over = [0, 1, 2].map(|k: usize| [r, g, b][k] * alpha + seen[k] * (1.0 - alpha));
    for (z, expected) in [(0.5, over), (-0.5, seen)] {
        let parts = [square_part(0.0, &glass), pane(z), wall.clone()];
        let picture = render_parts(&parts, rest);
        assert_near(picture.pixel(20, 20).unwrap(), expected, &format!("a pane at {z}"));
    }
}

#[test]
fn transparent_backgrounds_stay_transparent_behind_rough_glass() {
    let tint = [0.9, 0.3, 0.2];
    let parts = || [square_part(0.0, &bending_glass(0.5, tint, ""))];
    let found = render_parts(&parts(), "lights: [], image: (size: (40, 40))");
    let gray = 0.2126 * tint[0] + 0.7152 * tint[1] + 0.0722 * tint[2];
    assert_eq!(found.pixel(20, 20), Some([0, 0, 0, (255.0 * (1.0 - gray) + 0.5) as u8]));
    // In front of a color or a gradient, the glass shows its tint even with tone mapping.
    for background in ["Color(\"#fff\")", "Gradient(colors: [\"#fff\", \"#fff\"])"] {
        let image = format!("size: (40, 40), background: {background}, tone_mapping: Aces");
        let found = render_parts(&parts(), &format!("lights: [], image: ({image})"));
        assert_near(found.pixel(20, 20).unwrap(), tint, background);
    }
}

#[test]
fn regions_with_rough_and_thick_glass_match_for_any_thread_count() {
    let volume = r#","KHR_materials_volume":{"thicknessFactor":1},
        "KHR_materials_dispersion":{"dispersion":4}"#;
    let parts = [
        sphere_part(&bending_glass(0.3, [0.9, 0.8, 1.0], volume)),
        square_part(1.2, &bending_glass(0.6, [0.5, 1.0, 0.9], "")),
        white_half(),
    ];
    // In the second size, the longer side exceeds the maximum framebuffer size.
    for (width, height) in [(150, 90), (5000, 30)] {
        let rest = format!(
            "environment: Sky(), ambient_occlusion: (radius: 0.5), ground: Shadow(),
            lights: [Directional(direction: (-1, -2, -1), intensity: 1, shadows: On(size: 256))],
            image: (size: ({width}, {height}), samples: 4)"
        );
        let scene = test_scene(&parts, 1.0, &rest);
        let whole = render(&scene, 2).expect("a picture");
        assert!(render(&scene, 1).expect("a picture") == whole, "with one thread");
        let textures = Textures::for_scene(&scene);
        let mut renderer = Renderer::default();
        let mut prepared =
            renderer.prepare(&RenderContext::new(&scene, &textures, 2)).expect("a scene");
        for x in [0, width / 2 - 13] {
            let region = PixelRect { x, y: 11, width: 40, height: 17 };
            let mut part = Picture::default();
            prepared.render_region(region, &mut part).expect("a region");
            for (x, y) in (0..40).flat_map(|x| (0..17).map(move |y| (x, y))) {
                let expected = whole.pixel(region.x + x, region.y + y);
                assert_eq!(part.pixel(x, y), expected, "({x}, {y}) of {region:?}");
            }
        }
    }
}
