//! The lessons, in the order of the page.

mod chapter;
mod learn_webgl;

use crate::lesson::Lesson;

/// All lessons.
pub(crate) static LESSONS: [&Lesson; 3] =
    [&learn_webgl::PERSPECTIVE, &learn_webgl::FRUSTUM, &chapter::ORTHOGRAPHIC_VOLUME];

/// The model of most lessons: 5 m high, its front at z = 3.4.
pub(crate) const HOUSE: &str = "models/house.glb";

/// The panes of a lesson of one perspective.
pub(crate) const ALL_PANES: &[&str] = &["picture", "world", "volume", "matrix", "journey", "depth"];
/// The panes of a lesson without a perspective divide.
pub(crate) const PARALLEL_PANES: &[&str] = &["picture", "world", "volume", "matrix", "journey"];
