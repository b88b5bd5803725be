//! Smooth thin glass, and the tint of any glass: products of transmittances, Beer's law and alpha.

use super::*;

/// Returns glass without specular reflection, with additional members in its volume extension.
fn glass_material(color: [f64; 3], volume: &str) -> String {
    let [r, g, b] = color;
    format!(
        r#"{{"extensions":{{"KHR_materials_transmission":{{"transmissionFactor":1}},
            "KHR_materials_specular":{{"specularFactor":0}},"KHR_materials_volume":{{{volume}}}}},
            "pbrMetallicRoughness":{{"metallicFactor":0,"roughnessFactor":0,
            "baseColorFactor":[{r},{g},{b},1]}}}}"#
    )
}

#[test]
fn glass_tints_its_background_per_channel() {
    // Over white, the result is the product of all transmittances in any order. Over a color, the
    // product is multiplied by that color.
    let colors = [[0.9, 0.3, 0.2], [0.5, 0.8, 1.0], [0.7, 0.7, 0.7]];
    let mut expected = [1.0; 3];
    for color in colors {
        expected = [0, 1, 2].map(|k: usize| expected[k] * color[k]);
    }
    let behind = [0.2, 0.9, 0.6];
    let opaque = pane_material([0.2, 0.9, 0.6, 1.0]);
    let rest = r##"lights: [], image: (size: (40, 40), background: Color("#fff"), samples: 4)"##;
    for order in [[0, 1, 2], [2, 0, 1], [2, 1, 0]] {
        let mut parts: Vec<TestPart> = order
            .map(|n: usize| square_part(n as f32 * 0.3, &glass_material(colors[n], "")))
            .into();
        let middle = render_parts(&parts, rest).pixel(20, 20).unwrap();
        assert_near(middle, expected, &format!("{order:?} over white"));
        parts.push(square_part(-0.5, &opaque));
        let middle = render_parts(&parts, rest).pixel(20, 20).unwrap();
        let expected = [0, 1, 2].map(|k: usize| expected[k] * behind[k]);
        assert_near(middle, expected, &format!("{order:?} over a color"));
    }
}

#[test]
fn glass_volumes_tint_by_their_world_space_thickness() {
    // Beer's law: the attenuation color raised to the power thickness / distance, times the base
    // color.
    let volume =
        r#""thicknessFactor":0.5,"attenuationDistance":0.8,"attenuationColor":[0.9,0.5,0.1]"#;
    let base = [1.0, 0.8, 0.9];
    for size in [0.5, 1.0, 3.0] {
        let rest = r##"lights: [], image: (size: (40, 40), background: Color("#fff"))"##;
        let picture =
            render_parts_larger(&[square_part(0.0, &glass_material(base, volume))], size, rest);
        let kept = |color: f64| libm::pow(color, 0.5 * size / 0.8);
        let expected = [base[0] * kept(0.9), base[1] * kept(0.5), base[2] * kept(0.1)];
        assert_near(picture.pixel(20, 20).unwrap(), expected, &format!("size {size}"));
    }
}

#[test]
fn partly_covering_glass_tints_only_the_covered_part() {
    // In KHR_materials_transmission alpha is coverage, and the uncovered part shows the background
    // unchanged.
    let material = glass_material([0.9, 0.3, 0.2], "")
        .replace(r#"{"extensions""#, r#"{"alphaMode":"BLEND","extensions""#);
    let material = material.replace(",1]", ",0.6]");
    let rest = r##"lights: [], image: (size: (40, 40), background: Color("#fff"))"##;
    let found = render_parts(&[square_part(0.0, &material)], rest).pixel(20, 20).unwrap();
    assert_near(found, [0.9, 0.3, 0.2].map(|c| 0.4 + 0.6 * c), "coverage 0.6");
    // Over a transparent background, the tint becomes black with an alpha of 1 − its luminance.
    let rest = "lights: [], image: (size: (40, 40))";
    let found = render_parts(&[square_part(0.0, &glass_material([0.9, 0.3, 0.2], ""))], rest)
        .pixel(20, 20)
        .unwrap();
    let grey = 0.2126 * 0.9 + 0.7152 * 0.3 + 0.0722 * 0.2;
    assert_eq!(found, [0, 0, 0, (255.0 * (1.0 - grey) + 0.5) as u8]);
}
