//! Tests for circles in models and their center lines.

use super::boxes::{instance_of, sheet};
use super::formats::read_svg;
use super::lint::{faults, layer_extent};
use glam::{DVec2, DVec3};
use hidden_line::FeaturePicker;
use homog::{Affine, Point, World};
use import::{ImportOptions, load};
use model::{ModelInstance, Primitive};
use projection::SheetAngle;
use sheet::Sheet;
use std::path::Path;
use std::sync::Arc;
use viewport::Paper;

/// Returns a cylinder around an axis through a point, between two heights, with flat ends.
pub fn cylinder(
    base: DVec3,
    axis: DVec3,
    (radius, height, sides): (f64, f64, u32),
) -> ModelInstance {
    let first = axis.any_orthonormal_vector();
    let second = axis.cross(first);
    let mut positions: Vec<[f32; 3]> = Vec::new();
    for level in [0.0, height] {
        for side in 0..sides {
            let angle = std::f64::consts::TAU * f64::from(side) / f64::from(sides);
            let arm = first * libm::cos(angle) + second * libm::sin(angle);
            positions.push((base + axis * level + arm * radius).to_array().map(|c| c as f32));
        }
    }
    let mut indices = Vec::new();
    for side in 0..sides {
        let next = (side + 1) % sides;
        indices.extend([side, next, sides + next, side, sides + next, sides + side]);
        if side + 2 < sides {
            indices.extend([0, side + 2, side + 1]);
            indices.extend([sides, sides + side + 1, sides + side + 2]);
        }
    }
    instance_of(Primitive { positions, indices, ..Primitive::default() })
}

/// Returns the bearing model from the scenes folder.
fn bearing() -> ModelInstance {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/models/bearing.glb");
    let model = Arc::new(load(&path, &ImportOptions::default()).unwrap());
    ModelInstance { model, model_to_world: Affine::scale(1.0, 1.0, 1.0) }
}

#[test]
fn rims_are_recognized_as_circles() {
    let base = DVec3::new(10.0, -4.0, 7.0);
    for axis in [DVec3::Y, DVec3::Z, DVec3::new(1.0, 2.0, 2.0) / 3.0] {
        for sides in [16, 24, 37, 180] {
            let models = [cylinder(base, axis, (12.5, 40.0, sides))];
            let picker = FeaturePicker::new(&models, 0.5);
            assert_eq!(picker.circles(None).count(), 2, "{axis} {sides}");
            for at in [base, base + axis * 40.0] {
                let circle = picker.nearest_circle(Point::<World>::from_raw(at), None).unwrap();
                assert!(circle.center.raw().distance(at) < 1e-4, "{circle:?}");
                assert!((circle.radius - 12.5).abs() < 1e-4, "{circle:?}");
                assert!(circle.axis.raw().cross(axis).length() < 1e-5, "{circle:?}");
            }
        }
    }
    // An eight-sided prism is not a cylinder.
    let models = [cylinder(base, DVec3::Y, (12.5, 40.0, 8))];
    assert_eq!(FeaturePicker::new(&models, 0.5).circles(None).count(), 0);
}

#[test]
fn edges_faces_and_vertices_are_picked_by_position() {
    let models = [cylinder(DVec3::ZERO, DVec3::Y, (5.0, 40.0, 4))];
    let picker = FeaturePicker::new(&models, 0.5);
    let near = |x: f64, y: f64, z: f64| Point::<World>::new(x, y, z);
    let top = picker.nearest_face(near(0.5, 41.0, 0.25), None).unwrap();
    assert_eq!(top.point.raw(), DVec3::new(0.5, 40.0, 0.25));
    assert!(top.direction.raw().cross(DVec3::Y).length() < 1e-9);
    let vertex = picker.nearest_vertex(near(6.0, 39.0, 0.1), None).unwrap();
    assert_eq!(vertex.raw().y, 40.0);
    let vertical = picker.nearest_edge(Point::from_raw(vertex.raw() * 1.2 - DVec3::Y * 20.0), None);
    let vertical = vertical.unwrap();
    assert!(vertical.direction.raw().cross(DVec3::Y).length() < 1e-9, "{vertical:?}");
    assert!(picker.nearest_edge(near(0.0, 0.0, 0.0), Some(&[7])).is_none());
}

#[test]
fn the_cross_and_axis_of_a_cylinder_extend_beyond_it() {
    let base = DVec3::new(3.0, 0.0, 5.0);
    let model = [cylinder(base, DVec3::Y, (10.0, 30.0, 36))];
    let mut sheet = sheet((Paper::A4.rotated(), "A4"), SheetAngle::First);
    sheet.center_lines = true;
    sheet.scale = viewport::DrawingScale::new(1, 1).ok();
    let page = sheet.draw(&model, &[], 1).unwrap();
    assert_eq!(faults(&page), [""; 0]);
    let lines = read_svg(&page, "center-lines").lines;
    // The front and side views show the axis, and the top view shows a cross.
    assert_eq!(lines.len(), 4);
    let spans: Vec<DVec2> = lines.iter().map(|line| (line[1] - line[0]).abs()).collect();
    assert_eq!(
        spans.iter().filter(|span| span.x < 1e-9 && (span.y - 35.0).abs() < 0.002).count(),
        2
    );
    assert_eq!(spans.iter().filter(|span| (span.max_element() - 25.0).abs() < 0.002).count(), 2);
    let [low, high] = layer_extent(&page, |id| id.starts_with("top-visible")).unwrap();
    let cross = lines.iter().find(|line| (line[0].y - line[1].y).abs() < 1e-9).unwrap();
    assert!((cross[0].x - low.x + 2.5).abs() < 0.05 && (cross[1].x - high.x - 2.5).abs() < 0.05);
}

#[test]
fn the_bearing_is_legible_with_center_lines_on_every_paper() {
    let model = [bearing()];
    for (paper, name) in super::boxes::PAPERS {
        for angle in [SheetAngle::First, SheetAngle::Third] {
            let sheet = Sheet { center_lines: true, ..sheet((paper, name), angle) };
            let page = sheet.draw(&model, &[], 1).unwrap();
            assert_eq!(faults(&page), [""; 0], "{name} {angle:?}");
            assert!(page.layers.iter().any(|layer| layer.id == "center-lines"), "{name}");
        }
    }
}
