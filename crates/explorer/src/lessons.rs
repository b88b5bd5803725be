//! The lessons, in page order.

mod chapter;
mod chapter_exercises;
mod clipping;
mod effects;
mod learn_webgl;
mod learn_webgl_screen;
mod own_model;
mod own_scene;
mod slides;
mod slides_parallel;
mod slides_perspective;

use crate::lesson::Lesson;

/// All lessons.
pub(crate) static LESSONS: [&Lesson; 23] = [
    &learn_webgl::PERSPECTIVE,
    &learn_webgl::FRUSTUM,
    &learn_webgl::ORTHO,
    &learn_webgl_screen::STEREO,
    &learn_webgl_screen::VIEWPORT,
    &learn_webgl_screen::PICKING,
    &learn_webgl_screen::DEPTH_TABLE,
    &chapter::ORTHOGRAPHIC_VOLUME,
    &chapter::PERSPECTIVE_VOLUME,
    &chapter::MIDPOINT_DEPTH,
    &chapter_exercises::EXERCISES,
    &slides_parallel::MULTIVIEW,
    &slides_parallel::AXONOMETRIC,
    &slides_parallel::OBLIQUE,
    &slides_perspective::ONE_POINT,
    &slides_perspective::TWO_POINT,
    &slides_perspective::THREE_POINT,
    &slides::NORMALIZATION,
    &slides::WINDOW_VIEWPORT,
    &slides::MEXICAN_HAT,
    &clipping::TEAR,
    &own_model::MODEL,
    &own_scene::SCENE,
];

/// The model that most lessons show. It is 4.75 m high, and its front is at z = 2.8.
pub(crate) const HOUSE: &str = "models/house.glb";

/// The panes of a lesson with a perspective divide.
pub(crate) const ALL_PANES: &[&str] = &["picture", "world", "volume", "matrix", "journey", "depth"];
/// The panes of a lesson without a perspective divide.
pub(crate) const PARALLEL_PANES: &[&str] = &["picture", "world", "volume", "matrix", "journey"];
