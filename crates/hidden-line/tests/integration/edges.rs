//! Edge classification: silhouettes, boundaries, creases, T-junctions and marked edges.

use super::stage::*;
use hidden_line::{DrawOptions, EdgeClass, EdgeClasses, HiddenEdges, draw};
use model::{EdgeList, EdgeVisibility, Primitive, PrimitiveEdges};

/// Returns the classes of all edges, including facets, in order.
fn edge_classes(primitives: Vec<Primitive>) -> Vec<EdgeClass> {
    let options = DrawOptions {
        classes: EdgeClasses::ALL,
        hidden_edges: HiddenEdges::Ignored,
        ..DrawOptions::default()
    };
    let drawing = draw(
        &drawing_scene(build_model(primitives), view_projection(window_projection()))
            .drawing_subject(),
        &options,
        1,
    )
    .unwrap();
    let mut classes: Vec<EdgeClass> = drawing.segments.iter().map(|line| line.class).collect();
    classes.sort_unstable();
    classes
}

fn count_class(classes: &[EdgeClass], class: EdgeClass) -> usize {
    classes.iter().filter(|other| **other == class).count()
}

/// Returns two squares side by side. The second starts `gap` to the right of the first and is bent
/// back by `fall`.
fn two_squares(gap: f32, fall: f32) -> Primitive {
    let (x, right) = (gap, 1.0 + gap);
    triangle_mesh(
        &[
            [-1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [-1.0, 1.0, 0.0],
            [x, 0.0, 0.0],
            [right, 0.0, -fall],
            [right, 1.0, -fall],
            [x, 1.0, 0.0],
        ],
        &[0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7],
    )
}

#[test]
fn edges_between_the_tangent_angle_and_the_crease_angle_are_tangent() {
    // A strip of three squares, bent by 10 and by 20 degrees. The crease angle is 15 degrees.
    let mut corners = vec![[-1.0, 0.0, 0.0], [-1.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for degrees in [10.0_f64, 30.0] {
        let [x, _, z] = corners[corners.len() - 1];
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let next = [x + cos as f32, 0.0, z - sin as f32];
        corners.extend([next, [next[0], 1.0, next[2]]]);
    }
    let quads: Vec<u32> = (0..3).flat_map(|k| [0, 2, 3, 0, 3, 1].map(|n| 2 * k + n)).collect();
    let strip = || build_model(vec![triangle_mesh(&corners, &quads)]);
    let classes = |tangent_degrees: Option<f64>| {
        let options = DrawOptions {
            classes: EdgeClasses::FEATURES.without(EdgeClass::Boundary),
            crease_angle: 15.0_f64.to_radians(),
            tangent_angle: tangent_degrees.map(f64::to_radians),
            ..DrawOptions::default()
        };
        let scene = drawing_scene(strip(), view_projection(window_projection()));
        let drawing = draw(&scene.drawing_subject(), &options, 1).unwrap();
        let mut classes: Vec<EdgeClass> = drawing.segments.iter().map(|line| line.class).collect();
        classes.sort_unstable();
        classes
    };
    assert_eq!(classes(None), [EdgeClass::Crease]);
    assert_eq!(classes(Some(5.0)), [EdgeClass::Crease, EdgeClass::Tangent]);
    assert_eq!(classes(Some(12.0)), [EdgeClass::Crease]);
}

#[test]
fn split_vertices_do_not_create_a_boundary() {
    // First at identical positions, then as far apart as 12-bit quantization can move them.
    for gap in [0.0, 2e-4] {
        let found = edge_classes(vec![two_squares(gap, 0.0)]);
        assert_eq!(count_class(&found, EdgeClass::Boundary), 6, "{found:?}");
        assert_eq!(count_class(&found, EdgeClass::Facet), 3);
    }
    assert_eq!(count_class(&edge_classes(vec![two_squares(0.01, 0.0)]), EdgeClass::Boundary), 8);
}

#[test]
fn a_dihedral_angle_above_the_limit_is_a_crease() {
    // The second square is bent back by 0.5 per unit, or 26.6 degrees, and then by 0.6, or 31
    // degrees.
    assert_eq!(count_class(&edge_classes(vec![two_squares(0.0, 0.5)]), EdgeClass::Crease), 0);
    assert_eq!(count_class(&edge_classes(vec![two_squares(0.0, 0.6)]), EdgeClass::Crease), 1);
}

#[test]
fn a_fold_is_a_silhouette() {
    // The second triangle is folded back behind the first.
    let fold = triangle_mesh(
        &[[-1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, -1.0]],
        &[0, 1, 2, 1, 3, 2],
    );
    let found = edge_classes(vec![fold]);
    assert_eq!(count_class(&found, EdgeClass::Silhouette), 1, "{found:?}");
    assert_eq!(count_class(&found, EdgeClass::Boundary), 4);
}

/// One square is on the left, and two rectangles of half its height are on the right.
///
/// ```text
///  3───2───8
///  │ ╱ │ ╱ │
///  │╱  5───7
///  │   │ ╱ │
///  0───1───6
/// ```
#[test]
fn a_t_junction_does_not_create_a_boundary() {
    let tee = triangle_mesh(
        &[
            [-1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [-1.0, 1.0, 0.0],
            [0.0, 0.0, 0.0],
            [0.0, 0.5, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 0.5, 0.0],
            [1.0, 1.0, 0.0],
        ],
        &[0, 1, 2, 0, 2, 3, 4, 6, 7, 4, 7, 5, 5, 7, 8, 5, 8, 2],
    );
    let found = edge_classes(vec![tee]);
    // The rim has three sides around the left square and four around the right rectangles.
    assert_eq!(count_class(&found, EdgeClass::Boundary), 7, "{found:?}");
    // These are three diagonals, the line between the right rectangles, and the two halves of the
    // middle edge.
    assert_eq!(count_class(&found, EdgeClass::Facet), 6);
}

#[test]
fn a_face_and_its_back_count_as_one_face() {
    let mut both = quad_mesh([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    both.indices.extend([2, 1, 0, 3, 2, 0]);
    assert_eq!(
        edge_classes(vec![both]),
        [[EdgeClass::Boundary; 4].as_slice(), &[EdgeClass::Facet]].concat()
    );
}

#[test]
fn different_materials_meet_at_tangent_edges() {
    let left = quad_mesh([[-1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 1.0, 0.0]]);
    let mut right = quad_mesh([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(
        count_class(&edge_classes(vec![left.clone(), right.clone()]), EdgeClass::Tangent),
        0
    );
    right.material = Some(0);
    assert_eq!(count_class(&edge_classes(vec![left, right]), EdgeClass::Tangent), 1);
}

#[test]
fn marked_edges_override_the_geometry() {
    use EdgeVisibility::{Hard, Hidden, Silhouette};
    let mut square =
        quad_mesh([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    let visibility = Some(vec![[Hard, Hidden, Silhouette], [Silhouette, Hard, Hidden]]);
    square.edges = Some(Box::new(PrimitiveEdges { visibility, ..PrimitiveEdges::default() }));
    assert_eq!(
        edge_classes(vec![square.clone()]),
        [[EdgeClass::Marked; 2].as_slice(), &[EdgeClass::Facet; 3]].concat()
    );
    let lines = vec![EdgeList { vertex_pairs: vec![[0, 2]], material: None }];
    square.edges = Some(Box::new(PrimitiveEdges { lines, ..PrimitiveEdges::default() }));
    assert_eq!(count_class(&edge_classes(vec![square]), EdgeClass::Marked), 1);
}

#[test]
fn touching_faces_do_not_intersect() {
    let floor = quad_mesh([[-2.0, 0.0, 2.0], [2.0, 0.0, 2.0], [2.0, 0.0, -2.0], [-2.0, 0.0, -2.0]]);
    let standing = cuboid_mesh([-1.0, 0.0, -1.0], [1.0, 1.0, 1.0]);
    let found = edge_classes(vec![floor.clone(), standing]);
    assert_eq!(count_class(&found, EdgeClass::Intersection), 0);
    let sunk = cuboid_mesh([-1.0, -0.5, -1.0], [1.0, 1.0, 1.0]);
    assert!(count_class(&edge_classes(vec![floor, sunk]), EdgeClass::Intersection) >= 4);
}
