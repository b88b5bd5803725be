//! Line styles: edges between materials, outlines, and the removal of speckles.

use super::stage::*;
use drawing::{Drawing, LineStyle, Warning, draw};
use hidden_line::EdgeClass;
use model::{Material, Model, Primitive};
use std::f64::consts::TAU;

/// Returns a drawing of the front view through the window.
fn draw_front(model: Model, style: &LineStyle) -> Drawing {
    let scene = drawing_scene(model, view_projection(window_projection()));
    let (options, fill) = (style.to_draw_options(), style.to_fill_options());
    draw(&scene.drawing_subject(), &options, &fill, 1).unwrap()
}

/// Returns a ball with a rough surface and shared vertex normals. It is open at its poles, where
/// triangles would be needles.
fn rough_ball(rings: u32, roughness: f64) -> Primitive {
    let sectors = 2 * rings;
    let mut seed = 1_u32;
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / f64::from(1 << 24) - 0.5
    };
    let mut positions = Vec::new();
    for ring in 0..=rings {
        for sector in 0..sectors {
            let (sine, cosine) =
                libm::sincos(TAU / 2.0 * (0.2 + 0.6 * f64::from(ring) / f64::from(rings)));
            let (u, v) = libm::sincos(TAU * f64::from(sector) / f64::from(sectors));
            let radius = 3.0 * (1.0 + roughness * noise());
            positions.push(glam::DVec3::new(sine * v, cosine, sine * u) * radius);
        }
    }
    let mut indices = Vec::new();
    for ring in 0..rings {
        for sector in 0..sectors {
            let next = (sector + 1) % sectors;
            let corner = |ring: u32, sector: u32| ring * sectors + sector;
            let [a, b, c, d] =
                [(0, sector), (0, next), (1, next), (1, sector)].map(|(k, s)| corner(ring + k, s));
            indices.extend([a, b, c, a, c, d]);
        }
    }
    let mut normals = vec![glam::DVec3::ZERO; positions.len()];
    for triangle in indices.as_chunks::<3>().0 {
        let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
        let normal = (b - a).cross(c - a);
        triangle.iter().for_each(|vertex| normals[*vertex as usize] += normal);
    }
    let single = |v: &glam::DVec3| v.as_vec3().to_array();
    let positions: Vec<[f32; 3]> = positions.iter().map(single).collect();
    let normals = normals.iter().map(|normal| single(&normal.normalize_or_zero())).collect();
    Primitive { normals: Some(normals), ..triangle_mesh(&positions, &indices) }
}

#[test]
fn scanned_surfaces_have_no_speckles() {
    for style in [LineStyle::HIDDEN_REMOVED, LineStyle::HIDDEN_DASHED, LineStyle::TECHNICAL] {
        let model = build_model(vec![rough_ball(60, 0.012)]);
        let drawing = draw_front(model, &style);
        assert!(drawing.segments.iter().all(|segment| segment.class != EdgeClass::Crease));
        let page = drawing.to_page(&style, "", None);
        let [width, _] = style.line_widths.wide_and_narrow();
        for layer in &page.layers {
            for line in layer.groups.iter().flat_map(|group| &group.strokes) {
                // A line must either be long enough by itself or be connected to other lines.
                let ends = [line.points[0], line.points[line.points.len() - 1]];
                let meets = |other: &page::Polyline| {
                    other != line && ends.iter().any(|end| other.points.contains(end))
                };
                let mut groups = page.layers.iter().flat_map(|layer| &layer.groups);
                let is_connected = groups.any(|group| group.strokes.iter().any(meets));
                assert!(line.length() >= width || is_connected, "{}: {line:?}", layer.id);
            }
        }
    }
}

/// Returns two squares in one plane, with different materials.
fn two_materials() -> Model {
    let square = |x: f32| {
        quad_mesh([[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x + 1.0, 1.0, 0.0], [x, 1.0, 0.0]])
    };
    let of = |x: f32, material| Primitive { material: Some(material), ..square(x) };
    let mut model = build_model(vec![of(-1.0, 0), of(0.0, 1)]);
    model.materials = vec![Material::default(), Material::default()];
    model
}

#[test]
fn edges_between_materials_are_drawn_in_all_feature_styles() {
    for style in [LineStyle::HIDDEN_REMOVED, LineStyle::HIDDEN_DASHED, LineStyle::TECHNICAL] {
        let drawing = draw_front(two_materials(), &style);
        let page = drawing.to_page(&style, "", None);
        let between = page.layers.iter().filter(|layer| layer.id == "visible-tangent");
        let lines: Vec<f64> = between
            .flat_map(|layer| &layer.groups)
            .flat_map(|group| &group.strokes)
            .map(page::Polyline::length)
            .collect();
        // 100 pixels at 96 pixels per inch.
        assert_eq!(lines.len(), 1);
        assert!((lines[0] - 100.0 * page::MILLIMETERS_PER_PIXEL).abs() < 2e-3, "{lines:?}");
    }
}

#[test]
fn the_silhouette_style_draws_only_the_outline() {
    // A large box, a small box in front of it, and a third that juts out to the right.
    let boxes = || {
        vec![
            cuboid_mesh([-2.0, -2.0, -1.0], [2.0, 2.0, 0.0]),
            cuboid_mesh([-1.0, -1.0, 1.0], [0.0, 0.0, 2.0]),
            cuboid_mesh([1.0, -1.0, 3.0], [3.0, 1.0, 4.0]),
        ]
    };
    let length_in = |style: LineStyle| -> f64 {
        let drawing = draw_front(build_model(boxes()), &style);
        let page = drawing.to_page(&style, "", None);
        let strokes = page.layers.iter().flat_map(|layer| &layer.groups).flat_map(|g| &g.strokes);
        strokes.map(page::Polyline::length).sum()
    };
    let length = length_in(LineStyle::SILHOUETTE);
    // The perimeter of the 4 × 4 square. The third box covers 2 of it on the right and adds 1 + 2 +
    // 1.
    let expected = (16.0 - 2.0 + 4.0) * 100.0 * page::MILLIMETERS_PER_PIXEL;
    assert!((length - expected).abs() < 0.01, "{length} {expected}");
    // Contours also include the small box and the sides of the third box in front of the large one.
    let within = length_in(LineStyle::CONTOURS) - expected;
    assert!((within - 8.0 * 100.0 * page::MILLIMETERS_PER_PIXEL).abs() < 0.01, "{within}");
}

#[test]
fn ink_that_cannot_be_seen_is_replaced_with_a_warning() {
    let (white, blue, black) = ([255; 3], [22, 58, 110], [0; 3]);
    let drawing =
        draw_front(build_model(vec![cuboid_mesh([-1.0; 3], [1.0; 3])]), &LineStyle::BLUEPRINT);
    for (style, paper, is_replaced) in [
        (LineStyle::BLUEPRINT, Some(white), true),
        (LineStyle::BLUEPRINT, Some([240; 3]), true),
        (LineStyle::BLUEPRINT, Some(blue), false),
        (LineStyle::BLUEPRINT, None, false),
        (LineStyle::PATENT, Some(black), true),
        (LineStyle::PATENT, Some(white), false),
        (LineStyle::TECHNICAL, Some(white), false),
    ] {
        let page = drawing.to_page(&style, "", paper);
        let is_reported =
            page.warnings.iter().any(|warning| matches!(warning, Warning::InkReplaced { .. }));
        assert_eq!(is_reported, is_replaced, "{paper:?}");
        for layer in &page.layers {
            let darkest = layer.pen.ink.iter().zip(paper.unwrap_or(blue));
            let contrast = darkest.map(|(ink, paper)| ink.abs_diff(paper)).max();
            assert!(contrast > Some(100), "{:?} on {paper:?}", layer.pen.ink);
        }
    }
}
