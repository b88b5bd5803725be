//! Face fills: material grays, shade hatching and part hatching.

use super::stage::*;
use drawing::{Drawing, FaceFill, FillOptions, LineStyle, Page, draw};
use hidden_line::DrawOptions;
use hidden_line::EdgeClass::Hatching;
use homog::{Normal, Plane, Point};
use model::{Material, Model, Primitive};
use page::{MILLIMETERS_PER_PIXEL, Polyline, to_millimeters};
use std::collections::BTreeMap;

/// Returns a model in which each primitive has its own material with the paired color.
fn colored_model(parts: Vec<(Primitive, [f32; 3])>) -> Model {
    let material = |(_, [r, g, b]): &(Primitive, [f32; 3])| Material {
        base_color: [*r, *g, *b, 1.0],
        ..Material::default()
    };
    let materials = parts.iter().map(material).collect();
    let numbered = parts.into_iter().enumerate();
    let primitives =
        numbered.map(|(index, (part, _))| Primitive { material: Some(index), ..part }).collect();
    Model { materials, ..build_model(primitives) }
}

fn filled(scene: &TestScene, face_fill: FaceFill) -> Drawing {
    let style = LineStyle { face_fill, hatch_spacing: 1.5, ..LineStyle::HIDDEN_REMOVED };
    draw(&scene.drawing_subject(), &style.to_draw_options(), &style.to_fill_options(), 1).unwrap()
}

fn page(scene: &TestScene, face_fill: FaceFill) -> Page {
    let style = LineStyle { face_fill, ..LineStyle::HIDDEN_REMOVED };
    filled(scene, face_fill).to_page(&style, "", Some([255; 3]))
}

/// Returns the total area of fills in picture units.
fn area(fills: &[Polyline]) -> f64 {
    let unit = 100.0 * MILLIMETERS_PER_PIXEL;
    let doubled = |line: &Polyline| -> f64 {
        let points: Vec<_> = line.points.iter().map(|p| to_millimeters(*p) / unit).collect();
        points.iter().zip(points.iter().cycle().skip(1)).map(|(a, b)| a.perp_dot(*b)).sum()
    };
    fills.iter().map(doubled).sum::<f64>() * 0.5
}

#[test]
fn grays_fill_the_visible_part_of_each_material() {
    let cube = cuboid_mesh([-1.0; 3], [1.0; 3]);
    // Its image covers a quarter of a square unit at the lower left of the cube's front.
    let plate = quad_mesh([[-0.5, -0.5, 3.0], [0.5, -0.5, 3.0], [0.5, 0.5, 3.0], [-0.5, 0.5, 3.0]]);
    let model = colored_model(vec![(cube, [0.8; 3]), (plate, [0.0, 0.0, 0.1])]);
    let page = page(&drawing_scene(model, oblique_view()), FaceFill::Gray);
    assert_eq!(page.images, []);
    let grays: Vec<_> =
        page.layers.iter().take_while(|layer| layer.id.starts_with("gray-")).collect();
    let [dark, bright] = grays.as_slice() else { panic!("{} grays", grays.len()) };
    assert!(dark.pen.ink[0] + 60 < bright.pen.ink[0], "{:?} {:?}", dark.pen, bright.pen);
    for (layer, expected) in [(dark, 1.0), (bright, 7.75)] {
        let actual = area(&layer.groups[0].fills);
        assert!((actual - expected).abs() < 0.01 * expected, "{}: {actual}", layer.id);
    }
    // The layers above the fills contain the lines.
    assert!(page.layers[2..].iter().all(|layer| layer.id.starts_with("visible-")));
    assert!(page.layers.len() > 2);
}

#[test]
fn cuts_stay_blank_in_gray_fills() {
    let model = colored_model(vec![(cuboid_mesh([-1.0; 3], [1.0; 3]), [0.5; 3])]);
    let cut = Plane::through(Point::new(0.0, 0.0, 0.0), Normal::new(0.0, 0.0, -1.0));
    let scene = TestScene { sections: vec![cut], ..drawing_scene(model, oblique_view()) };
    let page = page(&scene, FaceFill::Gray);
    let gray = page.layers.iter().find(|layer| layer.id.starts_with("gray-")).unwrap();
    // The fills cover the right and upper sides of the remaining half, but not the cut.
    let actual = area(&gray.groups[0].fills);
    assert!((actual - 2.0).abs() < 0.02, "{actual}");
}

#[test]
fn shade_hatching_ignores_the_color() {
    let hatched = |color: [f32; 3], fill: FaceFill| {
        let model = colored_model(vec![(cuboid_mesh([-1.0; 3], [1.0; 3]), color)]);
        let drawing = filled(&drawing_scene(model, oblique_view()), fill);
        drawing.segments.iter().filter(|line| is_visible_class(Hatching)(line)).count()
    };
    let [white, black] = [[1.0; 3], [0.0; 3]].map(|color| hatched(color, FaceFill::ShadeHatching));
    assert!(white > 10 && white == black, "{white} {black}");
    assert!(hatched([0.0; 3], FaceFill::Hatching) > white);
}

/// Returns the direction of each object's hatch lines, in degrees, and their number.
fn hatch_lines(drawing: &Drawing) -> BTreeMap<u32, (i64, usize)> {
    let mut lines = BTreeMap::new();
    for line in drawing.segments.iter().filter(|line| line.class == Hatching) {
        let step = line.ends[1] - line.ends[0];
        let angle = libm::round(libm::atan(-step.y / step.x).to_degrees()) as i64;
        let (known, count) = lines.entry(line.object).or_insert((angle, 0));
        assert_eq!(*known, angle, "each object must have a single hatch direction");
        *count += 1;
    }
    lines
}

#[test]
fn neighbors_are_hatched_differently() {
    let boxes = [-3.0, -1.0, 1.0].map(|x| cuboid_mesh([x, -1.0, -1.0], [x + 2.0, 1.0, 1.0]));
    let mut scene = drawing_scene(build_model(boxes.to_vec()), oblique_view());
    let lines = hatch_lines(&filled(&scene, FaceFill::PartHatching));
    let angles: Vec<i64> = lines.values().map(|(angle, _)| *angle).collect();
    // The outer boxes do not touch.
    assert_eq!(angles, [45, -45, 45]);
    // Only the last box has a visible side.
    assert!(lines[&2].1 > lines[&0].1, "{lines:?}");
    // With sections, only the cuts are hatched.
    scene.sections = vec![Plane::through(Point::new(0.0, 0.0, 0.0), Normal::new(0.0, 0.0, -1.0))];
    let options = DrawOptions::default();
    let of = |fill| {
        draw(&scene.drawing_subject(), &options, &FillOptions::new(fill), 1).unwrap().segments
    };
    assert_eq!(of(FaceFill::PartHatching), of(FaceFill::None));
}
