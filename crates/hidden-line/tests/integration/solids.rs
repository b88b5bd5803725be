//! Hidden-line removal on solids in front of, inside and through each other.

use super::stage::*;
use hidden_line::EdgeClass::{Boundary, Crease, Intersection, Line, Silhouette};
use hidden_line::{DrawOptions, HiddenEdges, draw};

/// The outline of the cube [−1, 1]³ in the oblique picture; the inner edges follow.
const OUTLINE: [Segment; 6] = [
    [[-1.5, -1.5], [0.5, -1.5]],
    [[0.5, -1.5], [1.5, -0.5]],
    [[1.5, -0.5], [1.5, 1.5]],
    [[1.5, 1.5], [-0.5, 1.5]],
    [[-0.5, 1.5], [-1.5, 0.5]],
    [[-1.5, 0.5], [-1.5, -1.5]],
];
const INNER: [Segment; 3] =
    [[[0.5, 0.5], [0.5, -1.5]], [[0.5, 0.5], [1.5, 1.5]], [[0.5, 0.5], [-1.5, 0.5]]];
const HIDDEN: [Segment; 3] =
    [[[-0.5, -0.5], [-0.5, 1.5]], [[-0.5, -0.5], [1.5, -0.5]], [[-0.5, -0.5], [-1.5, -1.5]]];

#[test]
fn a_cube_shows_nine_edges() {
    let cube = cuboid_mesh([-1.0; 3], [1.0; 3]);
    let drawing = draw_scene_lines(&drawing_scene(build_model(vec![cube]), oblique_view()));
    assert_eq!(drawing.segments.len(), 12);
    assert_segments_cover(&segments_where(&drawing, is_visible_class(Silhouette)), &OUTLINE);
    assert_segments_cover(&segments_where(&drawing, is_visible_class(Crease)), &INNER);
    assert_segments_cover(&segments_where(&drawing, |line| !line.visible), &HIDDEN);
}

#[test]
fn a_cube_inside_a_cube_is_hidden() {
    let cubes = vec![cuboid_mesh([-1.0; 3], [1.0; 3]), cuboid_mesh([-0.5; 3], [0.5; 3])];
    let drawing = draw_scene_lines(&drawing_scene(build_model(cubes), oblique_view()));
    assert_eq!(drawing.segments.len(), 24);
    assert_segments_cover(
        &segments_where(&drawing, |line| line.visible && line.object == 0),
        &[OUTLINE.as_slice(), &INNER].concat(),
    );
    let inner = [OUTLINE.as_slice(), &INNER, &HIDDEN].concat();
    let inner: Vec<Segment> = inner.iter().map(|s| s.map(|end| end.map(|x| x / 2.0))).collect();
    assert_segments_cover(
        &segments_where(&drawing, |line| !line.visible && line.object == 1),
        &inner,
    );
}

#[test]
fn the_first_layer_has_only_lines_behind_one_wall() {
    let wall = cuboid_mesh([-2.0, -1.0, 3.0], [2.0, 1.0, 3.5]);
    let second = cuboid_mesh([0.25, -1.0, 2.0], [2.0, 1.0, 2.5]);
    let wire = line_mesh(&[[-3.0, 0.25, 1.0], [3.0, 0.25, 1.0]]);
    let scene =
        drawing_scene(build_model(vec![wall, second, wire]), view_projection(window_projection()));
    let options = DrawOptions { hidden_edges: HiddenEdges::FirstLayer, ..DrawOptions::default() };
    let drawing = draw(&scene.drawing_subject(), &options, 1).unwrap();
    assert_segments_cover(
        &segments_where(&drawing, |line| line.class == Line && line.visible),
        &[[[-3.0, 0.25], [-2.0, 0.25]], [[2.0, 0.25], [3.0, 0.25]]],
    );
    assert_segments_cover(
        &segments_where(&drawing, |line| line.class == Line && !line.visible),
        &[[[-2.0, 0.25], [0.25, 0.25]]],
    );
    // The second wall's front edges are behind the two faces of the first wall, and its rear edges
    // behind three faces.
    let of_second = segments_where(&drawing, |line| line.object == 1 && !line.visible);
    assert!(!of_second.is_empty());
}

/// A bar protrudes from the cube's right side.
///
/// ```text
///          ╱╲
///        ╱   ╲──────╮
///       │     │ ╲____╲
///        ╲    │ │    │
/// ```
///
/// The intersection is a square with two visible sides. The bar hides parts of the cube's lower
/// right edge and of its rear right edge.
#[test]
fn a_bar_through_the_side_of_a_cube() {
    let solids =
        vec![cuboid_mesh([-1.0; 3], [1.0; 3]), cuboid_mesh([0.0, -0.5, -0.5], [2.0, 0.5, 0.5])];
    let drawing = draw_scene_lines(&drawing_scene(build_model(solids), oblique_view()));
    let crossing = [[[0.75, 0.25], [1.25, 0.75]], [[0.75, 0.25], [0.75, -0.75]]];
    assert_segments_cover(&segments_where(&drawing, is_visible_class(Intersection)), &crossing);
    let hidden_crossing = [[[1.25, -0.25], [1.25, 0.75]], [[1.25, -0.25], [0.75, -0.75]]];
    let hidden = segments_where(&drawing, |line| !line.visible && line.class == Intersection);
    assert_segments_cover(&hidden, &hidden_crossing);
    let mut outline = OUTLINE;
    outline[1] = [[0.5, -1.5], [1.25, -0.75]];
    outline[2] = [[1.5, 0.75], [1.5, 1.5]];
    let cube = [outline.as_slice(), &INNER].concat();
    assert_segments_cover(
        &segments_where(&drawing, |line| {
            line.visible && line.object == 0 && line.class != Intersection
        }),
        &cube,
    );
    let bar = [
        [[0.75, 0.25], [1.75, 0.25]],
        [[0.75, -0.75], [1.75, -0.75]],
        [[1.25, 0.75], [2.25, 0.75]],
        [[1.75, 0.25], [1.75, -0.75]],
        [[1.75, 0.25], [2.25, 0.75]],
        [[1.75, -0.75], [2.25, -0.25]],
        [[2.25, 0.75], [2.25, -0.25]],
    ];
    assert_segments_cover(&segments_where(&drawing, |line| line.visible && line.object == 1), &bar);
}

/// A column is in front of the left side of the cube. The column's outline passes through the
/// corners with the smallest and the largest x − z/2.
#[test]
fn a_cylinder_in_front_of_a_box() {
    let sides = 48;
    let corner = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / f64::from(sides);
        [libm::cos(angle) as f32, libm::sin(angle) as f32 + 4.0]
    };
    let positions: Vec<[f32; 3]> =
        (0..sides as usize).map(corner).flat_map(|[x, z]| [[x, -3.0, z], [x, 3.0, z]]).collect();
    let side = |k: u32| {
        let [a, b] = [2 * k, 2 * ((k + 1) % sides as u32)];
        [a, a + 1, b, b, a + 1, b + 1]
    };
    let indices: Vec<u32> = (0..sides as u32).flat_map(side).collect();
    let column = triangle_mesh(&positions, &indices);
    let drawing = draw_scene_lines(&drawing_scene(
        build_model(vec![cuboid_mesh([-1.0; 3], [1.0; 3]), column]),
        oblique_view(),
    ));
    let right = positions.iter().map(|[x, _, z]| f64::from(*x) - 0.5 * f64::from(*z));
    let right = right.fold(f64::NEG_INFINITY, f64::max);
    assert!(right > -1.0 && right < -0.8, "{right}");
    // The column hides the left part of the cube below the column's top, which is at Y = 3 − z/2
    // for z from 3 to 5.
    let at_bottom = segments_where(&drawing, |line| {
        line.visible && line.object == 0 && line.ends.iter().all(|end| end.y == 550.0)
    });
    assert_segments_cover(&at_bottom, &[[[right, -1.5], [0.5, -1.5]]]);
    let hidden = segments_where(&drawing, |line| {
        !line.visible && line.object == 0 && line.ends.iter().all(|end| end.y == 550.0)
    });
    assert_segments_cover(&hidden, &[[[-1.5, -1.5], [right, -1.5]]]);
    let vertical = segments_where(&drawing, |line| {
        line.visible && line.class == Silhouette && line.object == 1
    });
    let left = positions.iter().map(|[x, _, z]| f64::from(*x) - 0.5 * f64::from(*z));
    let left = left.fold(f64::INFINITY, f64::min);
    assert_eq!(vertical.len(), 2, "{vertical:?}");
    for [a, b] in vertical {
        let at = if a[0] > -2.0 { right } else { left };
        assert!((a[0] - at).abs() < 1e-9 && (b[0] - at).abs() < 1e-9, "{a:?} {b:?}");
    }
}

/// Three strips each overlap the next, so no painting order gives the correct picture.
#[test]
fn a_cycle_of_three() {
    let strip = |corners: [[f32; 2]; 4], z: fn([f32; 2]) -> f32| {
        quad_mesh(corners.map(|[x, y]| [x, y, z([x, y])]))
    };
    let strips = vec![
        // Along the x axis, rising to the right.
        strip([[-2.0, -0.25], [3.0, -0.25], [3.0, 0.25], [-2.0, 0.25]], |[x, _]| (x - 1.0) / 2.0),
        // Along x + y = 2, rising to the upper left.
        strip([[3.5, -2.0], [4.0, -1.5], [-1.5, 4.0], [-2.0, 3.5]], |[_, y]| (y - 1.0) / 2.0),
        // Along the y axis, falling as y increases.
        strip([[-0.25, -2.0], [0.25, -2.0], [0.25, 3.0], [-0.25, 3.0]], |[_, y]| (1.0 - y) / 2.0),
    ];
    let drawing =
        draw_scene_lines(&drawing_scene(build_model(strips), view_projection(window_projection())));
    let of = |object| segments_where(&drawing, move |line| line.visible && line.object == object);
    let ends = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [[a, b], [c, d]];
    assert_segments_cover(
        &of(0),
        &[
            ends([-2.0, -0.25], [-0.25, -0.25]),
            ends([0.25, -0.25], [3.0, -0.25]),
            ends([3.0, -0.25], [3.0, 0.25]),
            ends([3.0, 0.25], [0.25, 0.25]),
            ends([-0.25, 0.25], [-2.0, 0.25]),
            ends([-2.0, 0.25], [-2.0, -0.25]),
        ],
    );
    assert_segments_cover(
        &of(1),
        &[
            ends([3.5, -2.0], [4.0, -1.5]),
            ends([4.0, -1.5], [2.75, -0.25]),
            ends([2.25, 0.25], [-1.5, 4.0]),
            ends([-1.5, 4.0], [-2.0, 3.5]),
            ends([-2.0, 3.5], [1.25, 0.25]),
            ends([1.75, -0.25], [3.5, -2.0]),
        ],
    );
    assert_segments_cover(
        &of(2),
        &[
            ends([-0.25, -2.0], [0.25, -2.0]),
            ends([0.25, -2.0], [0.25, 1.25]),
            ends([0.25, 2.25], [0.25, 3.0]),
            ends([0.25, 3.0], [-0.25, 3.0]),
            ends([-0.25, 3.0], [-0.25, 2.75]),
            ends([-0.25, 1.75], [-0.25, -2.0]),
        ],
    );
}

/// A floor at height −1 begins behind the eye, and a line runs below it at height −2. The line is
/// visible where the near plane cuts the floor away.
#[test]
fn a_floor_cut_by_the_near_plane() {
    let floor =
        quad_mesh([[-1.0, -1.0, 5.0], [1.0, -1.0, 5.0], [1.0, -1.0, -10.0], [-1.0, -1.0, -10.0]]);
    let line = line_mesh(&[[0.0, -2.0, -1.5], [0.0, -2.0, -15.0]]);
    // Half the picture is 4 units wide and shows 2 world units at distance 1, so X = 2 x/−z.
    let lens = projection::Frustum::new(-2.0, 2.0, -2.0, 2.0, 1.0, 100.0).unwrap();
    let lens = lens.view_to_clip(projection::Convention::CHAPTER);
    let drawing =
        draw_scene_lines(&drawing_scene(build_model(vec![floor, line]), view_projection(lens)));
    assert_segments_cover(
        &segments_where(&drawing, is_visible_class(Boundary)),
        &[[[-2.0, -2.0], [-0.2, -0.2]], [[2.0, -2.0], [0.2, -0.2]], [[-0.2, -0.2], [0.2, -0.2]]],
    );
    // The ray to the line at (−2, z) crosses the floor's height at z/2, so the floor, which the
    // near plane cuts at −1, hides the line from z = −2 on.
    assert_segments_cover(
        &segments_where(&drawing, is_visible_class(Line)),
        &[[[0.0, -8.0 / 3.0], [0.0, -2.0]]],
    );
    let hidden = segments_where(&drawing, |line| !line.visible);
    assert_segments_cover(&hidden, &[[[0.0, -2.0], [0.0, -4.0 / 15.0]]]);
}

/// A line that runs exactly behind the common edge of two faces is hidden by both faces together.
/// Exactly behind the border of a single face, it only touches the face and stays visible.
#[test]
fn a_line_exactly_behind_a_shared_edge_is_hidden() {
    let roof = triangle_mesh(
        &[
            [-1.0, -1.0, 0.0],
            [0.0, -1.0, 0.5],
            [0.0, 1.0, 0.5],
            [-1.0, 1.0, 0.0],
            [1.0, -1.0, 0.0],
            [1.0, 1.0, 0.0],
        ],
        &[0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2],
    );
    let lines = line_mesh(&[
        [0.0, -2.0, -1.0],
        [0.0, 2.0, -1.0], // behind the ridge
        [1.0, -2.0, -1.0],
        [1.0, 2.0, -1.0], // behind the right border
        [-1.0, -1.0, -1.0],
        [1.0, 1.0, -1.0], // across the diagonals
    ]);
    let drawing = draw_scene_lines(&drawing_scene(
        build_model(vec![roof, lines]),
        view_projection(window_projection()),
    ));
    assert_segments_cover(
        &segments_where(&drawing, is_visible_class(Line)),
        &[[[0.0, -2.0], [0.0, -1.0]], [[0.0, 1.0], [0.0, 2.0]], [[1.0, -2.0], [1.0, 2.0]]],
    );
}
