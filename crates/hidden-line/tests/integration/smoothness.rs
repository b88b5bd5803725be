//! Edges whose class depends on vertex normals.

use super::stage::*;
use hidden_line::{DrawOptions, EdgeClass, LineDrawing, SilhouetteMethod, draw};
use model::{Model, Primitive};
use std::f64::consts::TAU;

/// Draws a model from the front, through the window.
fn draw_front(model: Model, options: &DrawOptions) -> LineDrawing {
    let scene = drawing_scene(model, view_projection(window_projection()));
    draw(&scene.drawing_subject(), options, 1).unwrap()
}

fn count(drawing: &LineDrawing, class: EdgeClass) -> usize {
    drawing.segments.iter().filter(|segment| segment.class == class).count()
}

/// Returns the lateral surface of a vertical column with eight sides around the y axis. If
/// `is_smooth` is true, it has the normals of a cylinder, otherwise the normals of its faces.
fn column(is_smooth: bool) -> Primitive {
    let (mut positions, mut normals, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    for side in 0..8 {
        let [from, to] = [side, side + 1].map(|k| libm::sincos(TAU * (f64::from(k) + 0.25) / 8.0));
        let middle = ((from.0 + to.0) / 2.0, (from.1 + to.1) / 2.0);
        let first = positions.len() as u32;
        for ((sine, cosine), y) in [(from, -1.0), (to, -1.0), (to, 1.0), (from, 1.0)] {
            positions.push([cosine as f32, y, sine as f32]);
            let (sine, cosine) = if is_smooth { (sine, cosine) } else { middle };
            let length = libm::hypot(sine, cosine);
            normals.push([(cosine / length) as f32, 0.0, (sine / length) as f32]);
        }
        indices.extend([0, 1, 2, 0, 2, 3].map(|k| first + k));
    }
    Primitive { normals: Some(normals), ..triangle_mesh(&positions, &indices) }
}

#[test]
fn matching_normals_make_an_edge_smooth() {
    let creases = |is_smooth: bool, asks_normals: bool| {
        let options = DrawOptions { asks_normals, ..DrawOptions::hidden_edges_removed() };
        count(&draw_front(build_model(vec![column(is_smooth)]), &options), EdgeClass::Crease)
    };
    // The faces of the column meet at 45°, and three edges are visible inside the outline.
    assert_eq!(creases(false, true), 3);
    assert_eq!(creases(true, true), 0);
    assert_eq!(creases(true, false), 3);
}

/// Returns a ball of radius 2 with tilted poles and shared vertices.
fn ball(rings: u32) -> Primitive {
    let sectors = 2 * rings;
    let (mut positions, mut indices) = (Vec::new(), Vec::new());
    for ring in 0..=rings {
        for sector in 0..sectors {
            let (sine, cosine) = libm::sincos(TAU * f64::from(sector) / f64::from(sectors));
            let (radius, height) = libm::sincos(TAU / 2.0 * f64::from(ring) / f64::from(rings));
            let at = glam::DVec3::new(radius * cosine, height, radius * sine) * 2.0;
            let turn = glam::DQuat::from_axis_angle(glam::DVec3::new(0.6, 0.0, 0.8), 0.7);
            positions.push((turn * at).as_vec3().to_array());
            if ring < rings {
                let next = (sector + 1) % sectors;
                let corners = [sector, next].map(|k| [ring, ring + 1].map(|r| r * sectors + k));
                let [[a, b], [d, c]] = corners;
                indices.extend([a, c, b, a, d, c]);
            }
        }
    }
    triangle_mesh(&positions, &indices)
}

#[test]
fn the_interpolated_contour_of_a_ball_is_a_circle() {
    let silhouettes = SilhouetteMethod::Interpolated;
    let options = DrawOptions { silhouettes, ..DrawOptions::hidden_edges_removed() };
    let smooth = draw_front(build_model(vec![ball(24)]), &options);
    let lines = segments_where(&smooth, |line| line.class == EdgeClass::Silhouette);
    let radius = |[x, y]: [f64; 2]| libm::hypot(x, y);
    assert!(lines.as_flattened().iter().all(|&end| (radius(end) - 2.0).abs() < 0.012));
    let length: f64 = lines.iter().map(|[a, b]| radius([b[0] - a[0], b[1] - a[1]])).sum();
    assert!((length / (2.0 * TAU) - 1.0).abs() < 0.01, "length {length}: gaps or duplicates");
    assert_eq!(smooth.segments.len(), lines.len(), "something else is drawn");
}

#[test]
fn creases_have_no_interpolated_contours() {
    let draw_box = |silhouettes: SilhouetteMethod| {
        let options = DrawOptions { silhouettes, ..DrawOptions::hidden_edges_retained() };
        let model = build_model(vec![cuboid_mesh([-1.0; 3], [1.0; 3])]);
        let scene = drawing_scene(model, oblique_view());
        draw(&scene.drawing_subject(), &options, 1).unwrap()
    };
    assert_eq!(draw_box(SilhouetteMethod::Interpolated), draw_box(SilhouetteMethod::Facets));
}
