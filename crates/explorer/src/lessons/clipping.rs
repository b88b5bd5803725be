//! The lesson on the order of clipping and dividing.

use crate::facts::Facts;
use crate::lesson::{Choice, Lesson, Source, Values, VolumeStage, choice, number};
use crate::lesson_scene::model_scene;
use crate::words::{Sentence, sentence, words};
use scene_file::file::{CameraFile, ProjectionFile};

/// A floor that extends under the eye.
const FLOOR: &str = "models/floor.glb";

/// C36: the tearing that results if the divide by w precedes clipping.
pub(super) static TEAR: Lesson = Lesson {
    id: "tear",
    source: Source::Chapter,
    items: &["C36", "C54"],
    title: words("Clip before the divide", "先裁剪，后做透视除法"),
    statement: words(
        "Behind the eye, w is negative. After the divide by this w, objects appear upside down in front of the eye, and triangles with corners on both sides of the eye are torn through infinity. So clip first, while w is still a coordinate.",
        "视点之后 w 为负。除以它，点会上下颠倒，出现在前方；两侧都有顶点的三角形会被撕裂到无穷远。所以先裁剪，这时 w 还是一个坐标。",
    ),
    models: &[FLOOR],
    parameters: &[
        choice(
            "order",
            words("order", "次序"),
            &[
                Choice { value: "clip", label: words("clip first", "先裁剪") },
                Choice {
                    value: "divide",
                    label: words("divide first (wrong)", "先做透视除法（错误）"),
                },
            ],
        ),
        number(
            "z",
            words("eye position along the floor", "视点沿地面的位置"),
            "",
            [-20.0, 23.0],
            [0.5, 0.0],
        ),
        number("near", words("near plane", "近平面"), "", [0.05, 5.0], [0.05, 0.5]),
    ],
    pin: [0.5, 0.0, -6.0],
    orbit: [62.0, 22.0],
    describe: |values| {
        let [z, near] = values.scene_numbers(["z", "near"]);
        let camera = CameraFile::look_to([0.5, 0.8, z], [-0.05, -0.02, -1.0]);
        let projection = ProjectionFile::perspective(62.0, [near, 40.0])?;
        model_scene(FLOOR, camera.with_projection(projection))
    },
    consequences: tear_consequences,
    volume: |values| match values.choice("order") {
        "divide" => VolumeStage::Torn,
        _ => VolumeStage::Divided,
    },
    ..Lesson::USUAL
};

fn tear_consequences(values: &Values<'_>, facts: &Facts) -> Vec<Sentence> {
    let (behind, all) = (facts.survey.behind_eye, facts.triangles[1]);
    let mut sentences = vec![sentence(
        format!("Triangles with a corner where w ≤ 0: {behind} of {all}."),
        format!("{all} 个三角形中有 {behind} 个带有 w ≤ 0 的顶点。"),
    )];
    sentences.push(match values.choice("order") {
        "divide" => sentence(
            "If divided first, these triangles wrongly appear upside down above the horizon or are torn across the picture. The program always clips first, so this picture cannot be copied as a scene or command.",
            "先做透视除法，它们会上下颠倒地出现在视平线之上，或撕裂整幅图像：这幅图像是错误的。场景文件总是先裁剪，所以这幅图像不能复制为场景或命令。",
        ),
        _ => sentence(
            "After clipping, every remaining corner has w > 0.",
            "先裁剪，剩下的每个顶点都有 w > 0。",
        ),
    });
    sentences
}
