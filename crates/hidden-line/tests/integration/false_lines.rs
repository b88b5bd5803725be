//! Lines that should not be there: the z-buffer image of a flat face shows no edge.

use super::stage::*;
use glam::DVec2;
use hidden_line::EdgeClass::{Crease, Section, Silhouette};
use hidden_line::{Agreement, DrawOptions, EdgeSegment, LineDrawing, draw, verify_with_z_buffer};
use homog::{Normal, Plane, Point};

/// Returns a hollow box with its front cut off, and its drawing without hidden lines.
fn cut_box() -> (TestScene, LineDrawing) {
    let mut box_mesh = cuboid_mesh([-1.0; 3], [1.0; 3]);
    let hole = cuboid_mesh([-0.6, -0.5, -0.5], [0.7, 0.4, 2.0]);
    let first = box_mesh.positions.len() as u32;
    box_mesh.positions.extend(&hole.positions);
    let (faces, _) = hole.indices.as_chunks::<3>();
    box_mesh.indices.extend(faces.iter().flat_map(|[a, b, c]| [a, c, b].map(|at| at + first)));
    let mut scene = drawing_scene(build_model(vec![box_mesh]), oblique_view());
    scene.sections = vec![Plane::through(Point::new(0.0, 0.0, 0.5), Normal::new(0.0, 0.0, -1.0))];
    let options = DrawOptions::default();
    let drawing = draw(&scene.drawing_subject(), &options, 1).unwrap();
    (scene, drawing)
}

fn verify(scene: &TestScene, segments: &[EdgeSegment]) -> Agreement {
    verify_with_z_buffer(&scene.drawing_subject(), segments).unwrap()
}

/// Returns the point of the picture that shows a point of the model, with its depth.
fn on_screen(at: [f64; 3]) -> (DVec2, f64) {
    let [x, y, z] = at;
    // The window from −8 to 8 has depths from 0 to 1, which increase toward the viewer.
    (DVec2::new(400.0 + 100.0 * (x - z / 2.0), 400.0 - 100.0 * (y - z / 2.0)), 0.5 + z / 16.0)
}

#[test]
fn correct_drawings_have_a_reason_for_every_line() {
    let (scene, drawing) = cut_box();
    assert!(drawing.segments.iter().any(|line| line.class == Section && line.visible));
    let agreement = verify(&scene, &drawing.segments);
    assert_eq!(agreement.groundless_segments, []);
    assert_eq!(agreement.denied_segments, []);
}

#[test]
fn lines_across_flat_faces_are_false() {
    let (scene, drawing) = cut_box();
    // On the cap, on the right wall and on the bottom of the hole.
    for (class, ends) in [
        (Section, [[-0.9, -0.9, 0.5], [-0.7, 0.9, 0.5]]),
        (Silhouette, [[1.0, -0.8, -0.8], [1.0, 0.8, 0.2]]),
        (Crease, [[-0.5, -0.45, -0.5], [0.1, -0.2, -0.5]]),
    ] {
        let [(a, near), (b, far)] = ends.map(on_screen);
        let mut segments = drawing.segments.clone();
        let added = EdgeSegment { ends: [a, b], depths: [near, far], class, ..segments[0] };
        segments.push(EdgeSegment { visible: true, ..added });
        let agreement = verify(&scene, &segments);
        assert_eq!(agreement.denied_length, 0.0, "{class:?} is in front");
        let [(index, length)] = agreement.groundless_segments[..] else {
            panic!("{class:?}: {:?}", agreement.groundless_segments)
        };
        assert_eq!(index, segments.len() - 1);
        assert!((length - a.distance(b)).abs() < 8.0, "{class:?}: {length}");
    }
}
