//! Section cuts through boxes, tubes and open surfaces, and the hatching of their caps.

use super::stage::*;
use glam::DVec2;
use hidden_line::EdgeClass::{Hatching, Section};
use hidden_line::{
    DrawOptions, FaceHatching, LineDrawing, Warning, draw, draw_hatched, verify_with_z_buffer,
};
use homog::{Normal, Plane, Point, World};
use model::{Model, Primitive};
use std::collections::BTreeMap;

/// Returns the section plane at a given x, which retains the side with lower x.
fn plane_x(at: f64) -> Plane<World> {
    Plane::through(Point::new(at, 0.0, 0.0), Normal::new(-1.0, 0.0, 0.0))
}

fn cut_scene(model: Model, planes: &[Plane<World>]) -> TestScene {
    TestScene { sections: planes.to_vec(), ..drawing_scene(model, oblique_view()) }
}

/// Returns a box with its faces turned inward.
fn box_with_hole(min: [f32; 3], max: [f32; 3]) -> Primitive {
    let mut primitive = cuboid_mesh(min, max);
    primitive.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|face| face.swap(1, 2));
    primitive
}

/// Merges two boxes into one object.
fn merge_primitives(mut one: Primitive, other: &Primitive) -> Primitive {
    let first = one.positions.len() as u32;
    one.positions.extend(&other.positions);
    one.indices.extend(other.indices.iter().map(|index| index + first));
    one
}

/// Returns the point (z, y) in the plane x = 0 that has this oblique image.
fn project_to_plane([x, y]: [f64; 2]) -> [f64; 2] {
    [-2.0 * x, y - x]
}

fn segment_length([a, b]: Segment) -> f64 {
    DVec2::from(a).distance(b.into())
}

#[test]
fn a_cube_cut_in_half_shows_its_cap() {
    let cube = cuboid_mesh([-1.0; 3], [1.0; 3]);
    let drawing = draw_scene_lines(&cut_scene(build_model(vec![cube]), &[plane_x(0.0)]));
    let cap = [
        [[-0.5, -1.5], [0.5, -0.5]],
        [[0.5, -0.5], [0.5, 1.5]],
        [[0.5, 1.5], [-0.5, 0.5]],
        [[-0.5, 0.5], [-0.5, -1.5]],
    ];
    assert_segments_cover(&segments_where(&drawing, is_visible_class(Section)), &cap);
    assert_eq!(segments_where(&drawing, |line| line.class == Section && !line.visible).len(), 0);
    // Three edges of the remaining half are behind the cap.
    let hidden =
        [[[-0.5, -0.5], [-0.5, 1.5]], [[-0.5, -0.5], [0.5, -0.5]], [[-0.5, -0.5], [-1.5, -1.5]]];
    assert_segments_cover(&segments_where(&drawing, |line| !line.visible), &hidden);
    assert!(drawing.warnings.is_empty());
}

/// Hatch lines cover only the cut material; they are equally spaced and at 45°. They are dense
/// enough to measure the area of the cut.
#[test]
fn hatching_fills_caps_but_not_holes() {
    let tube = merge_primitives(
        cuboid_mesh([-1.0; 3], [1.0; 3]),
        &box_with_hole([-0.9, -0.6, -0.5], [0.9, 0.6, 0.7]),
    );
    let scene = cut_scene(build_model(vec![tube]), &[plane_x(0.0)]);
    let options = DrawOptions { hatch_spacing: 2.0, ..DrawOptions::hidden_edges_retained() };
    let drawing = draw(&scene.drawing_subject(), &options, 2).unwrap();
    let hatching = segments_where(&drawing, is_visible_class(Hatching));
    assert!(hatching.len() > 100);
    let mut area = 0.0;
    for line in hatching {
        let [a, b] = line.map(DVec2::from);
        assert!(((b - a).x - (b - a).y).abs() < 1e-9, "{line:?} is not at 45°");
        let number = (800.0 + (a.x - a.y) * 100.0) * std::f64::consts::FRAC_1_SQRT_2 / 2.0;
        assert!((number - number.round()).abs() < 1e-6, "{line:?} is not equally spaced: {number}");
        for t in [1e-6, 0.25, 0.5, 0.75, 1.0 - 1e-6] {
            let [z, y] = project_to_plane((a + (b - a) * t).into());
            let within = |z0: f64, z1: f64, y0: f64, y1: f64, by: f64| {
                z > z0 - by && z < z1 + by && y > y0 - by && y < y1 + by
            };
            assert!(within(-1.0, 1.0, -1.0, 1.0, 1e-9), "{line:?} leaves the cap");
            assert!(!within(-0.5, 0.7, -0.6, 0.6, -1e-9), "{line:?} is in the hole");
        }
        area += segment_length(line) * 0.02;
    }
    // The picture halves depths, so the area is half of 4 − 1.44 square units.
    assert!((area - 1.28).abs() < 0.01, "{area}");
}

#[test]
fn a_cap_hides_everything_behind_it() {
    let solids =
        vec![cuboid_mesh([-1.0; 3], [1.0; 3]), cuboid_mesh([-0.9, -0.3, -0.3], [-0.1, 0.3, 0.3])];
    let drawing = draw_scene_lines(&cut_scene(build_model(solids), &[plane_x(0.0)]));
    let inner = |line: &hidden_line::EdgeSegment| line.object == 1;
    assert!(drawing.segments.iter().filter(|line| inner(line)).count() >= 12);
    assert_eq!(segments_where(&drawing, |line| inner(line) && line.visible).len(), 0);
}

#[test]
fn two_section_planes_cut_a_corner_out() {
    let cube = cuboid_mesh([-1.0; 3], [1.0; 3]);
    let front = Plane::through(Point::ORIGIN, Normal::new(0.0, 0.0, -1.0));
    let scene = cut_scene(build_model(vec![cube]), &[plane_x(0.0), front]);
    let drawing = draw_scene_lines(&scene);
    let edge = |a: [f64; 3], b: [f64; 3]| [a, b].map(|[x, y, z]| [x - z / 2.0, y - z / 2.0]);
    let sections = [
        edge([0.0, -1.0, 0.0], [0.0, 1.0, 0.0]),
        edge([0.0, 1.0, 0.0], [0.0, 1.0, -1.0]),
        edge([0.0, 1.0, -1.0], [0.0, -1.0, -1.0]),
        edge([0.0, -1.0, -1.0], [0.0, -1.0, 0.0]),
        edge([-1.0, 1.0, 0.0], [0.0, 1.0, 0.0]),
        edge([-1.0, -1.0, 0.0], [0.0, -1.0, 0.0]),
        edge([-1.0, 1.0, 0.0], [-1.0, -1.0, 0.0]),
    ];
    assert_segments_cover(&segments_where(&drawing, is_visible_class(Section)), &sections);
    // Both caps are hatched, and none of the hatching is hidden.
    let options = DrawOptions { hatch_spacing: 5.0, ..DrawOptions::hidden_edges_retained() };
    let drawing = draw(&scene.drawing_subject(), &options, 1).unwrap();
    let area: f64 = segments_where(&drawing, is_visible_class(Hatching))
        .into_iter()
        .map(segment_length)
        .sum::<f64>()
        * 0.05;
    assert!((area - (1.0 + 2.0)).abs() < 0.05, "{area}");
}

#[test]
fn an_open_section_adds_a_warning() {
    // Five sides of a box: the left one is missing.
    let mut open = cuboid_mesh([-1.0; 3], [1.0; 3]);
    open.indices.drain(24..30);
    let whole = cut_scene(build_model(vec![open.clone()]), &[plane_x(0.0)]);
    assert!(draw_scene_lines(&whole).warnings.is_empty(), "the cut must be closed");
    let lengthwise = Plane::through(Point::ORIGIN, Normal::new(0.0, 0.0, -1.0));
    let mut named = build_model(vec![cuboid_mesh([-3.0, -1.0, -1.0], [-2.0, 1.0, 1.0]), open]);
    named.nodes[1].name = Some("tray".to_owned());
    let drawing = draw_scene_lines(&cut_scene(named, &[lengthwise]));
    assert_eq!(drawing.warnings, [Warning::SectionOpen { object: "tray".to_owned() }]);
    assert!(drawing.warnings[0].to_string().contains("`tray`"));
    let of = |object: u32, class| {
        drawing.segments.iter().filter(|line| line.object == object && line.class == class).count()
    };
    assert!(of(1, Section) > 0 && of(0, Section) > 0 && of(0, Hatching) > 0);
    assert_eq!(of(1, Hatching), 0);
}

#[test]
fn several_objects_of_one_body_are_capped_together() {
    let body = cuboid_mesh([-1.0; 3], [1.0; 3]);
    let (mut one, mut other) = (body.clone(), body);
    one.indices.truncate(18);
    other.indices.drain(..18);
    let drawing = draw_scene_lines(&cut_scene(build_model(vec![one, other]), &[plane_x(0.0)]));
    assert!(drawing.warnings.is_empty());
    assert!(drawing.segments.iter().any(|line| line.class == Hatching));
}

#[test]
fn adjacent_parts_have_different_hatching() {
    let boxes = (0..4_u8).map(|n| {
        let y = f32::from(n) * 0.5 - 1.0;
        cuboid_mesh([-1.0, y, -1.0], [1.0, y + 0.5, 1.0])
    });
    let drawing = draw_scene_lines(&cut_scene(build_model(boxes.collect()), &[plane_x(0.0)]));
    // For each object, the direction and the offset of each hatch line.
    let mut hatch_lines: BTreeMap<u32, Vec<(bool, f64)>> = BTreeMap::new();
    for line in drawing.segments.iter().filter(|line| line.class == Hatching) {
        let [a, b] = line.ends;
        let rises = (b - a).x * (b - a).y < 0.0;
        let at = if rises { a.x + a.y } else { a.y - a.x };
        hatch_lines.entry(line.object).or_default().push((rises, at));
    }
    let hatch_of = |object: u32| {
        let of = &hatch_lines[&object];
        let mut at: Vec<f64> = of.iter().map(|(_, at)| *at).collect();
        at.sort_by(f64::total_cmp);
        let steps = at.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > 1e-6);
        (of[0].0, (steps.fold(f64::INFINITY, f64::min) * 1e3).round())
    };
    for object in 1..4 {
        assert_ne!(hatch_of(object - 1), hatch_of(object), "{object}");
    }
}

/// In any view, visible and hidden parts add up to whole edges, and the z-buffer agrees.
#[test]
fn cut_drawings_agree_with_their_z_buffer_images() {
    let frustum = projection::Frustum::new(-0.5, 0.5, -0.5, 0.5, 1.0, 20.0).unwrap();
    let view_to_clip = frustum.view_to_clip(projection::Convention::CHAPTER);
    for eye in [[4.0, 3.0, 5.0], [-4.0, 2.0, 5.0], [3.0, -5.0, 4.0], [0.5, 0.2, 6.0]] {
        let solids = vec![
            merge_primitives(cuboid_mesh([-1.0; 3], [1.0; 3]), &box_with_hole([-0.9; 3], [0.9; 3])),
            cuboid_mesh([-0.5, -0.5, -0.5], [0.4, 0.3, 0.6]),
            cuboid_mesh([-1.5, -1.2, -1.0], [1.3, -1.0, 1.4]),
        ];
        let tilted = Plane::through(Point::new(0.1, 0.0, 0.1), Normal::new(-0.6, 0.1, -1.0));
        let mut scene = cut_scene(build_model(solids), &[tilted]);
        let camera = camera::Camera::look_at(eye.into(), Point::ORIGIN, homog::Vector::Y).unwrap();
        scene.view_projection = camera::ViewProjection { camera, view_to_clip };
        let gray = |_, _| 0.5;
        for hatching in [FaceHatching::None, FaceHatching::ByLuma(&gray), FaceHatching::Parts] {
            let options =
                DrawOptions { hatch_spacing: 8.0, ..DrawOptions::hidden_edges_retained() };
            let (drawing, _) =
                draw_hatched(&scene.drawing_subject(), &options, hatching, 1).unwrap();
            assert_closed_outlines(&drawing);
            assert!(drawing.segments.iter().any(|line| line.class == Hatching && line.visible));
            let agreement =
                verify_with_z_buffer(&scene.drawing_subject(), &drawing.segments).unwrap();
            assert!(agreement.visible_length > 1000.0);
            assert!(
                agreement.disagreement_ratio() < 0.002,
                "{eye:?}: {}",
                agreement.disagreement_ratio()
            );
        }
    }
}

/// Asserts that the pieces of each edge, except hatch lines, follow each other without gaps or
/// overlaps.
fn assert_closed_outlines(drawing: &LineDrawing) {
    let lines: Vec<_> = drawing.segments.iter().filter(|line| line.class != Hatching).collect();
    for pieces in lines.chunk_by(|a, b| a.edge == b.edge) {
        let sum: f64 = pieces.iter().map(|line| line.ends[0].distance(line.ends[1])).sum();
        let whole = pieces[0].ends[0].distance(pieces[pieces.len() - 1].ends[1]);
        assert!((sum - whole).abs() < 1e-6, "the pieces add up to {sum}, not {whole}");
    }
}

/// Vertices may be on the plane except for rounding errors, for example in a section of a sphere.
#[test]
fn a_section_through_vertices_nearly_on_the_plane_closes() {
    for nudge in [0.0_f32, 1e-7, -1e-7, 3e-8] {
        let mut cube = cuboid_mesh([-1.0; 3], [1.0; 3]);
        // The middles of the top and the bottom are vertices, slightly off the plane.
        let first = cube.positions.len() as u32;
        let rim = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        cube.indices.drain(12..24);
        for y in [-1.0_f32, 1.0] {
            cube.positions.extend(rim.map(|[x, z]| [x, y, z]));
            cube.positions.push([nudge, y, nudge * 0.5]);
            let at = first + if y > 0.0 { 5 } else { 0 };
            for k in 0..4 {
                let (a, b) = (at + k, at + (k + 1) % 4);
                cube.indices.extend(if y > 0.0 { [b, a, at + 4] } else { [a, b, at + 4] });
            }
        }
        let drawing = draw_scene_lines(&cut_scene(build_model(vec![cube]), &[plane_x(0.0)]));
        assert!(drawing.warnings.is_empty(), "{nudge}: {:?}", drawing.warnings);
        let perimeter: f64 = segments_where(&drawing, is_visible_class(Section))
            .into_iter()
            .map(segment_length)
            .sum();
        let expected = 4.0 + 2.0 * std::f64::consts::SQRT_2;
        assert!((perimeter - expected).abs() < 1e-4, "{nudge}: {perimeter}");
        let hatched: Vec<_> = segments_where(&drawing, is_visible_class(Hatching));
        assert!(hatched.len() > 10, "{nudge}");
    }
}
