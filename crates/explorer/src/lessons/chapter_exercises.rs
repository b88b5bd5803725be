//! Drawings for the chapter's exercises.

use super::HOUSE;
use crate::facts::Facts;
use crate::lesson::{Choice, Lesson, Source, Values, choice, number};
use crate::lesson_scene::{LessonScene, house_scene, model_scene};
use crate::number_text::{decimals, scene_number};
use crate::words::{Sentence, sentence, words};
use explain::ApiConventions;
use scene_file::file::{CameraFile, LabelSize, OverlayFile, ProjectionFile, ViewFile};

/// The endpoints of the segment in exercise 11, along the ridge of the house.
const RIDGE_ENDS: [[f64; 3]; 2] = [[0.0, 4.38, 3.15], [0.0, 4.38, -3.15]];

/// Exercises 2, 7, 10 and 11.
pub(super) static EXERCISES: Lesson = Lesson {
    id: "exercises",
    source: Source::Chapter,
    items: &["C39", "C44", "C46", "C47"],
    title: words("Exercises", "习题"),
    statement: words(
        "Figures for the chapter's exercises. 2: M_vp M_orth maps a window to pixels. 7: M_per takes the corner (r, t, n) to (1, 1, 1). 10: the camera at (0, 1, 0) looks down. 11: f(t) locates the image of a point on a segment.",
        "本章习题的图：2，M_vp M_orth 把窗口映射到像素；7，M_per 把角点 (r, t, n) 映为 (1, 1, 1)；10，位于 (0, 1, 0) 向下看的相机；11，线段上比例 t 处的点的像在哪里。",
    ),
    models: &[HOUSE, CRATE],
    parameters: &[
        choice(
            "exercise",
            words("exercise", "习题"),
            &[
                Choice {
                    value: "7", label: words("7: the corner (r, t, n)", "7：角点 (r, t, n)")
                },
                Choice { value: "2", label: words("2: window to pixels", "2：窗口到像素") },
                Choice {
                    value: "10",
                    label: words("10: a camera looking down", "10：向下看的相机"),
                },
                Choice {
                    value: "11", label: words("11: f(t) along a segment", "11：线段的 f(t)")
                },
            ],
        ),
        number("t", words("t, for exercise 11", "t，用于习题 11"), "", [0.0, 1.0], [0.01, 0.5]),
    ],
    // The corner (r, t, n) of exercise 7 in the world, with the eye at (0, 2, 12) and a window with
    // r = 2 and t = 1.25 on n = −4.
    pin: [2.0, 3.25, 8.0],
    conventions: ApiConventions::Chapter,
    describe: |values| match values.choice("exercise") {
        "2" => straight_ahead(ProjectionFile::orthographic([-4.0, 4.0, -2.5, 2.5], [4.0, 18.0])?),
        "10" => {
            let (eye, gaze, up) = ([0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]);
            let view = ViewFile::LookTo { eye: eye.into(), gaze: gaze.into(), up: up.into() };
            let projection = ProjectionFile::orthographic([-1.6, 1.6, -1.0, 1.0], [-0.5, 2.0])?;
            let camera = CameraFile { view, ..CameraFile::default() };
            model_scene(CRATE, camera.with_projection(projection))
        }
        "11" => {
            let [t] = values.scene_numbers(["t"]);
            let [a, b] = RIDGE_ENDS;
            let mut scene = house_scene(ProjectionFile::perspective(40.0, [4.0, 18.0])?)?;
            let point = segment_point(values.number("t")).map(scene_number);
            scene.overlays = vec![label(a, "a"), label(b, "b"), label(point, &format!("t = {t}"))];
            Ok(scene)
        }
        _ => straight_ahead(ProjectionFile::frustum([-2.0, 2.0, -1.25, 1.25], [4.0, 18.0])?),
    },
    consequences: exercise_consequences,
    point: |values| match values.choice("exercise") {
        "10" => Some([0.5, 1.0, 0.5]),
        "11" => Some(segment_point(values.number("t"))),
        _ => None,
    },
    ..Lesson::USUAL
};

/// The model in exercise 10: a cube whose top is at y = 1.
const CRATE: &str = "models/crate.glb";

fn straight_ahead(projection: ProjectionFile) -> LessonScene {
    let camera = CameraFile::look_to([0.0, 2.0, 12.0], [0.0, 0.0, -1.0]);
    model_scene(HOUSE, camera.with_projection(projection))
}

/// Returns text at the end of a leader line.
fn label(at: [f64; 3], text: &str) -> OverlayFile {
    OverlayFile::Label {
        at: at.into(),
        text: text.to_owned(),
        offset: None,
        color: None,
        size: LabelSize::DEFAULT,
        leader: true,
    }
}

fn segment_point(t: f64) -> [f64; 3] {
    let [a, b] = RIDGE_ENDS;
    [0, 1, 2].map(|axis| a[axis] + t * (b[axis] - a[axis]))
}

fn exercise_consequences(values: &Values<'_>, facts: &Facts) -> Vec<Sentence> {
    let [width, height] = facts.size.map(f64::from);
    match values.choice("exercise") {
        "2" => {
            // nx / (r − l) and −1/2 − l nx / (r − l)
            let [scale, offset] = [width / 8.0, 4.0 * width / 8.0 - 0.5].map(|n| decimals(n, 3));
            vec![sentence(
                format!(
                    "x_s = {scale} x + {offset}: x from −4 to 4 maps to x_s from −½ to {}.",
                    decimals(width - 0.5, 1)
                ),
                format!(
                    "x_s = {scale} x + {offset}：从 −4 到 4 的窗口变成 −½ … {}。",
                    decimals(width - 0.5, 1)
                ),
            )]
        }
        "10" => vec![sentence(
            "w = (0, 1, 0), u = t × w = (0, 0, 1), v = w × u = (1, 0, 0): in the picture, the x axis of the world points up and the z axis points to the right.",
            "w = (0, 1, 0)，u = t × w = (0, 0, 1)，v = w × u = (1, 0, 0)：世界的 x 轴在图像中向上，z 轴向右。",
        )],
        "11" => {
            let world_to_clip = facts.view_projection.world_to_clip();
            let [start, end] =
                RIDGE_ENDS.map(|point| world_to_clip.transform_point(point.into()).w());
            let t = values.number("t");
            // f(t) = w_R t / (w_r + t (w_R − w_r)), with r at t = 0 and R at t = 1 (IN-1)
            let image = decimals(end * t / (start + t * (end - start)), 4);
            let (start, end) = (decimals(start, 2), decimals(end, 2));
            vec![sentence(
                format!(
                    "w is {start} at a and {end} at b. The image of the point at t = {t} is a fraction f(t) = {image} of the way along the segment's image."
                ),
                format!(
                    "a 处 w 为 {start}，b 处 w 为 {end}：线段上 {t} 处的点，其像位于线段的像的 f(t) = {image} 处。"
                ),
            )]
        }
        _ => vec![sentence(
            format!(
                "The corner (r, t, n) of the window maps to (1, 1, 1) and thus to the upper right corner of the picture, ({}, {}).",
                decimals(width - 0.5, 1),
                decimals(height - 0.5, 1)
            ),
            format!(
                "窗口的角点 (r, t, n) 映为 (1, 1, 1)，也就是图像的右上角：({}, {})。",
                decimals(width - 0.5, 1),
                decimals(height - 0.5, 1)
            ),
        )],
    }
}
