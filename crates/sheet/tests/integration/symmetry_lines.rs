//! Lines of symmetry: only the views that see a symmetry plane edge-on have them.

use super::boxes::{box_model, instance_of, sheet};
use super::center_lines::cylinder;
use super::formats::read_svg;
use super::lint::{faults, layer_extent};
use glam::{DVec2, DVec3};
use homog::Affine;
use model::{ModelInstance, Primitive};
use projection::SheetAngle;
use sheet::Sheet;
use viewport::{DrawingScale, Paper};

/// Returns a full-scale sheet with lines of symmetry.
fn symmetric_sheet() -> Sheet {
    let sheet = sheet((Paper::A3.rotated(), "A3"), SheetAngle::First);
    Sheet { symmetry_lines: true, scale: DrawingScale::new(1, 1).ok(), ..sheet }
}

/// Returns the lines of symmetry on a sheet, and checks that nothing on it overlaps.
fn symmetry_lines(sheet: &Sheet, models: &[ModelInstance]) -> Vec<[DVec2; 2]> {
    let page = sheet.draw(models, &[], 1).unwrap();
    assert_eq!(faults(&page), [""; 0]);
    if layer_extent(&page, |id| id == "symmetry-lines").is_none() {
        return Vec::new();
    }
    let lines = read_svg(&page, "symmetry-lines").lines;
    lines.iter().map(|line| [line[0], line[1]]).collect()
}

/// Returns the lengths of the vertical and of the horizontal lines.
fn lengths(lines: &[[DVec2; 2]]) -> [Vec<f64>; 2] {
    [1, 0].map(|axis| {
        let spans = lines.iter().map(|[a, b]| (*b - *a).abs());
        let along = spans.filter(|span| span[1 - axis] < 1e-9).map(|span| span[axis].round());
        let mut lengths: Vec<f64> = along.collect();
        lengths.sort_by(f64::total_cmp);
        lengths
    })
}

/// Returns a prism over a polygon in the xy plane, from z = 0 to a depth. Its end faces are fans
/// from a corner, so their triangles are not symmetric.
fn prism(outline: &[[f32; 2]], depth: f32) -> ModelInstance {
    let count = outline.len() as u32;
    let level = |z: f32| outline.iter().map(move |[x, y]| [*x, *y, z]);
    let positions: Vec<[f32; 3]> = level(0.0).chain(level(depth)).collect();
    let mut indices = Vec::new();
    for at in 0..count {
        let next = (at + 1) % count;
        indices.extend([at, next, count + next, at, count + next, count + at]);
    }
    for at in 1..count - 1 {
        indices.extend([0, at + 1, at, count, count + at, count + at + 1]);
    }
    instance_of(Primitive { positions, indices, ..Primitive::default() })
}

#[test]
fn the_two_lines_of_a_box_extend_beyond_it_in_each_view() {
    let lines = symmetry_lines(&symmetric_sheet(), &[box_model(DVec3::new(60.0, 40.0, 30.0))]);
    // The front, side and top views are 60 x 40, 30 x 40 and 60 x 30, with 3 mm added at each end.
    assert_eq!(lengths(&lines), [vec![36.0, 46.0, 46.0], vec![36.0, 66.0, 66.0]]);
    let page = symmetric_sheet().draw(&[box_model(DVec3::new(60.0, 40.0, 30.0))], &[], 1).unwrap();
    let [low, high] = layer_extent(&page, |id| id.starts_with("front-")).unwrap();
    let middle = (low + high) * 0.5;
    let crosses_front = |[a, b]: &&[DVec2; 2]| (*a + *b - middle * 2.0).length() < 0.01;
    assert_eq!(lines.iter().filter(crosses_front).count(), 2);
}

#[test]
fn each_plane_of_symmetry_has_lines_in_two_views() {
    // A T is symmetric left to right and front to back.
    let t: [[f32; 2]; 8] = [
        [-10.0, 30.0],
        [-10.0, 0.0],
        [10.0, 0.0],
        [10.0, 30.0],
        [30.0, 32.0],
        [30.0, 50.0],
        [-30.0, 50.0],
        [-30.0, 32.0],
    ];
    let lines = symmetry_lines(&symmetric_sheet(), &[prism(&t, 25.0)]);
    // The front, side and top views have a vertical line, and only the top view has a horizontal
    // line.
    assert_eq!(lengths(&lines), [vec![31.0, 56.0, 56.0], vec![66.0]]);
    // With one corner cut off by 0.1 mm, the part is still symmetric front to back.
    let mut cut = t.to_vec();
    cut[5] = [29.9, 50.0];
    let lines = symmetry_lines(&symmetric_sheet(), &[prism(&cut, 25.0)]);
    assert_eq!(lengths(&lines), [vec![56.0], vec![66.0]]);
}

#[test]
fn flat_parts_seen_edge_on_have_no_line_of_symmetry_along_them() {
    let lines = symmetry_lines(&symmetric_sheet(), &[box_model(DVec3::new(60.0, 40.0, 0.001))]);
    // In the side and top views, only the short lines across the part remain.
    assert_eq!(lengths(&lines), [vec![6.0, 46.0], vec![6.0, 66.0]]);
}

#[test]
fn a_mark_on_a_face_breaks_the_symmetry() {
    let plate = box_model(DVec3::new(60.0, 40.0, 30.0));
    let knob = |x: f64| {
        let model = box_model(DVec3::new(4.0, 4.0, 4.0));
        let model_to_world = Affine::translation(homog::Vector::new(x, 22.0, 0.0));
        ModelInstance { model_to_world, ..model }
    };
    let lines = symmetry_lines(&symmetric_sheet(), &[plate.clone(), knob(0.0)]);
    assert_eq!(lengths(&lines), [vec![36.0, 50.0, 50.0], vec![66.0]]);
    let lines = symmetry_lines(&symmetric_sheet(), &[plate.clone(), knob(10.0)]);
    assert_eq!(lengths(&lines), [vec![50.0], vec![66.0]]);
    let lines = symmetry_lines(&symmetric_sheet(), &[plate, knob(10.0), knob(-10.0)]);
    assert_eq!(lengths(&lines), [vec![36.0, 50.0, 50.0], vec![66.0]]);
}

#[test]
fn lines_of_symmetry_replace_center_lines() {
    let at = |x: f64| cylinder(DVec3::new(x, 0.0, 0.0), DVec3::Y, (10.0, 30.0, 36));
    let pair = [at(-20.0), at(20.0)];
    let sheet = Sheet { center_lines: true, ..symmetric_sheet() };
    // The pair is symmetric about three planes. The remaining lines are the axes in the front view
    // and the vertical arms of the crosses in the top view. In the side view, the axes coincide
    // with the line of symmetry.
    assert_eq!(lengths(&symmetry_lines(&sheet, &pair))[0], [26.0, 36.0, 36.0]);
    let page = sheet.draw(&pair, &[], 1).unwrap();
    let lines = read_svg(&page, "center-lines").lines;
    let lines: Vec<[DVec2; 2]> = lines.iter().map(|line| [line[0], line[1]]).collect();
    assert_eq!(lengths(&lines), [vec![25.0, 25.0, 35.0, 35.0], vec![]]);
}
