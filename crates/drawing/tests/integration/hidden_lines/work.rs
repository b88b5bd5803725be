//! The bound on the work of hidden-line removal.

use super::stage::*;
use drawing::{DrawOptions, LineDrawing, Warning, draw};
use homog::Affine;
use model::{Model, ModelInstance};
use std::sync::Arc;

/// Sheets behind each other, each a little larger than the one before it: all borders are visible,
/// and each of them passes over the boxes of all sheets nearer than its own.
fn stack_of_sheets(count: u16) -> Model {
    let sheet = |at: u16| {
        let (size, z) = (2.0 + f32::from(at) / f32::from(count), -f32::from(at) / 1024.0);
        quad_mesh([[-size, 0.0, z], [0.0, -size, z], [size, 0.0, z], [0.0, size, z]])
    };
    build_model((0..count).map(sheet).collect())
}

fn draw_stack(count: u16, max_comparisons: u64, threads: usize) -> LineDrawing {
    let model = Arc::new(stack_of_sheets(count));
    let instance = ModelInstance { model, model_to_world: Affine::scale(1.0, 1.0, 1.0) };
    let models = vec![instance];
    let scene = TestScene {
        models,
        view_projection: view_projection(window_projection()),
        sections: Vec::new(),
        uncut: Vec::new(),
    };
    let options = DrawOptions { max_comparisons, ..DrawOptions::hidden_edges_removed() };
    draw(&scene.drawing_subject(), &options, threads).unwrap()
}

#[test]
fn too_much_work_is_reported_and_the_same_from_any_number_of_threads() {
    let complete = draw_stack(3000, DrawOptions::default().max_comparisons, 2);
    assert_eq!(complete.warnings, []);
    let cut_off = draw_stack(3000, 0, 1);
    assert_eq!(cut_off.warnings, [Warning::VisibilityIncomplete]);
    assert_eq!(cut_off, draw_stack(3000, 0, 3));
    // Few faces stay below the least work whatever the bound.
    assert_eq!(draw_stack(50, 0, 1).warnings, []);
}
