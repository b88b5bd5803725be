//! Work limits of hidden-line removal, and crowds of faces.

use super::stage::*;
use hidden_line::{DrawOptions, LineDrawing, Warning, draw};
use homog::Affine;
use model::{Model, ModelInstance};
use std::sync::Arc;

/// Returns sheets one behind another, each a little larger than the previous one. All borders are
/// visible, and each border passes behind the boxes of all nearer sheets.
fn stack_of_sheets(count: u16) -> Model {
    let sheet = |at: u16| {
        let (size, z) = (2.0 + f32::from(at) / f32::from(count), -f32::from(at) / 1024.0);
        quad_mesh([[-size, 0.0, z], [0.0, -size, z], [size, 0.0, z], [0.0, size, z]])
    };
    build_model((0..count).map(sheet).collect())
}

fn draw_stack(count: u16, max_comparisons: u64, threads: usize) -> LineDrawing {
    // The stack is a crowd, but this test is about the limit on exact comparisons.
    let options =
        DrawOptions { max_comparisons, is_unlimited: true, ..DrawOptions::hidden_edges_removed() };
    draw_model(stack_of_sheets(count), &options, threads)
}

fn draw_model(model: Model, options: &DrawOptions, threads: usize) -> LineDrawing {
    let model = Arc::new(model);
    let instance = ModelInstance { model, model_to_world: Affine::scale(1.0, 1.0, 1.0) };
    let models = vec![instance];
    let scene = TestScene {
        models,
        view_projection: view_projection(window_projection()),
        sections: Vec::new(),
        uncut: Vec::new(),
    };
    draw(&scene.drawing_subject(), options, threads).unwrap()
}

/// Returns triangles of random sizes at random positions, the same on each call.
fn soup(count: usize) -> Model {
    let mut state = 1_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / 16_777_216.0
    };
    let mut triangle = || {
        let center = [0; 3].map(|_| 3.0 * random() - 1.5);
        let corner = |random: &mut dyn FnMut() -> f32| center.map(|c| c + 3.2 * random() - 1.6);
        let [a, b, c] = [0; 3].map(|_| corner(&mut random));
        quad_mesh([a, b, c, c])
    };
    build_model((0..count).map(|_| triangle()).collect())
}

/// Returns the total lengths of the visible and hidden segments in pixels.
fn lengths(drawing: &LineDrawing) -> [f64; 2] {
    [true, false].map(|visible| {
        let segments = drawing.segments.iter().filter(|segment| segment.visible == visible);
        segments.map(|segment| segment.ends[0].distance(segment.ends[1])).sum()
    })
}

#[test]
fn a_crowd_is_drawn_nearly_the_same_as_without_limits() {
    let options = DrawOptions::hidden_edges_retained();
    let exact = draw_model(soup(2000), &DrawOptions { is_unlimited: true, ..options }, 2);
    assert_eq!(exact.warnings, []);
    let crowd = draw_model(soup(2000), &options, 1);
    assert!(crowd.warnings.contains(&Warning::CrowdApproximated), "{:?}", crowd.warnings);
    assert_eq!(crowd, draw_model(soup(2000), &options, 3));
    let ([seen, _], [all, _]) = (lengths(&crowd), lengths(&exact));
    assert!(seen > 0.95 * all && seen < 1.001 * all, "{seen} of {all} pixels are visible");
    // A tenth of the faces does not form a crowd.
    let few = draw_model(soup(200), &options, 1);
    assert!(!few.warnings.contains(&Warning::CrowdApproximated));
}

#[test]
fn the_effect_of_the_work_limit_is_reported_and_does_not_depend_on_threads() {
    let complete = draw_stack(3000, DrawOptions::default().max_comparisons, 2);
    assert_eq!(complete.warnings, []);
    let cut_off = draw_stack(3000, 0, 1);
    assert_eq!(cut_off.warnings, [Warning::VisibilityIncomplete]);
    assert_eq!(cut_off, draw_stack(3000, 0, 3));
    // A few faces always stay within the minimum allowance.
    assert_eq!(draw_stack(50, 0, 1).warnings, []);
}
