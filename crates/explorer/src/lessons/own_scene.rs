//! The lesson for the user's own scene file.

use crate::lesson::{Lesson, Source};
use crate::lessons::own_model;
use crate::words::words;

/// The user's own scene file, unchanged.
pub(super) static SCENE: Lesson = Lesson {
    id: "scene",
    source: Source::Own,
    title: words("Your own scene", "自己的场景"),
    statement: words(
        "Open any scene file, with its own camera, lights and style, to see what its view volume contains and how its points pass through the pipeline.",
        "任何场景文件，连同它自己的相机、光源和样式：它的视见体包含什么，其中的点经过哪些变换。",
    ),
    models: &[],
    pin: [0.0, 0.0, 0.0],
    consequences: |_, facts| own_model::describe_model(facts),
    ..Lesson::USUAL
};
