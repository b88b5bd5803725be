//! The lessons of the chapter on viewing: the orthographic volume.

use super::{HOUSE, PARALLEL_PANES};
use crate::facts::Facts;
use crate::lesson::{Lesson, Source, Values, number};
use crate::number_text::scene_number;
use crate::scene_description::{SceneDescription, look_at};
use crate::words::{Sentence, sentence, words};
use pipeline::explain::ApiConventions;

/// C7, OR-1: the orthographic view volume, in the chapter's own signs.
pub(crate) static ORTHOGRAPHIC_VOLUME: Lesson = Lesson {
    id: "orthographic-volume",
    source: Source::Chapter,
    items: &["C7", "C8"],
    title: words("Orthographic view volume", "正交视见体"),
    statement: words(
        "The box [l, r] × [b, t] × [f, n] of camera space becomes the canonical view volume [−1, 1]³ by a scale and a translation. The camera looks along −z, so 0 > n > f. w stays 1: nothing shrinks with distance.",
        "相机空间中的长方体 [l, r] × [b, t] × [f, n] 经缩放和平移变成规范视见体 [−1, 1]³。相机看向 −z，所以 0 > n > f。w 始终为 1：物体不随距离变小。",
    ),
    models: &[HOUSE],
    parameters: &[
        number("l", words("l, left", "l，左"), "", [-8.0, -0.5], [0.1, -5.6]),
        number("r", words("r, right", "r，右"), "", [0.5, 8.0], [0.1, 5.6]),
        number("b", words("b, bottom", "b，下"), "", [-6.0, -0.5], [0.1, -3.5]),
        number("t", words("t, top", "t，上"), "", [0.5, 6.0], [0.1, 3.5]),
        number(
            "n",
            words("n, near (a coordinate)", "n，近（坐标）"),
            "",
            [-11.0, -0.5],
            [0.1, -5.0],
        ),
        number(
            "f",
            words("f, far (a coordinate)", "f，远（坐标）"),
            "",
            [-40.0, -11.5],
            [0.5, -17.0],
        ),
    ],
    panes: PARALLEL_PANES,
    pin: [0.0, 4.75, 0.0],
    orbit: [72.0, 22.0],
    conventions: ApiConventions::Chapter,
    describe: |values| {
        let [l, r, b, t] = ["l", "r", "b", "t"].map(|key| scene_number(values.number(key)));
        let [n, f] = ["n", "f"].map(|key| scene_number(-values.number(key)));
        let projection = format!(
            "Orthographic(left: {l}, right: {r}, bottom: {b}, top: {t}, near: {n}, far: {f})"
        );
        SceneDescription::new(HOUSE, look_at([4.0, 3.0, 10.0], [0.0, 2.2, 0.0]), projection)
    },
    consequences: box_consequences,
};

fn box_consequences(values: &Values<'_>, facts: &Facts) -> Vec<Sentence> {
    let [l, r, b, t] = ["l", "r", "b", "t"].map(|key| values.number(key));
    let pixels = scene_number(libm::round(f64::from(facts.size[0]) / (r - l) * 10.0) / 10.0);
    let vertical = scene_number(libm::round(f64::from(facts.size[1]) / (t - b) * 10.0) / 10.0);
    vec![match pixels == vertical {
        true => sentence(
            format!("One unit is {pixels} pixels wide and high, at every distance."),
            format!("一个单位在任何距离上都是 {pixels} 像素宽和高。"),
        ),
        false => sentence(
            format!(
                "One unit is {pixels} pixels wide and {vertical} high: the window does not have the picture's shape, so everything is distorted."
            ),
            format!(
                "一个单位宽 {pixels} 像素、高 {vertical} 像素：窗口与画面的宽高比不同，所以图像变形。"
            ),
        ),
    }]
}
