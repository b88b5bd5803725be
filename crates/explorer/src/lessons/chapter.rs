//! Lessons on the viewing chapter: its two view volumes, and depth between the near and far planes.

use super::PARALLEL_PANES;
use super::effects::{distortion, planes_only_clip};
use crate::facts::Facts;
use crate::lesson::{Lesson, Parameter, Source, Values, number};
use crate::lesson_scene::house_scene;
use crate::number_text::decimals;
use crate::words::{Sentence, sentence, words};
use explain::ApiConventions;
use scene_file::file::ProjectionFile;

/// The settings shared by the chapter's lessons.
const USUAL: Lesson =
    Lesson { source: Source::Chapter, conventions: ApiConventions::Chapter, ..Lesson::USUAL };

const fn plane_n(default: f64) -> Parameter {
    let label = words("n, near (a z-coordinate)", "n，近平面（z 坐标）");
    number("n", label, "", [-11.0, -1.0], [0.1, default])
}

const fn plane_f(default: f64) -> Parameter {
    let label = words("f, far (a z-coordinate)", "f，远平面（z 坐标）");
    number("f", label, "", [-60.0, -11.5], [0.5, default])
}

/// The chapter's names for the sides of the window.
const WINDOW: [&str; 4] = ["l", "r", "b", "t"];

/// Returns the distances of the planes, which scene files use instead of the coordinates n and f.
fn planes(values: &Values<'_>) -> [f64; 2] {
    values.scene_numbers(["n", "f"]).map(|z| -z)
}

/// OR-1: the orthographic view volume, with the chapter's signs.
pub(super) static ORTHOGRAPHIC_VOLUME: Lesson = Lesson {
    id: "orthographic-volume",
    items: &["C7", "C8", "C34"],
    title: words("Orthographic view volume", "正交视见体"),
    statement: words(
        "A scaling and a translation map the box [l, r] × [b, t] × [f, n] in camera space to the canonical view volume [−1, 1]³. The camera looks along −z, so 0 > n > f. Because w stays 1, nothing shrinks with distance.",
        "观察坐标系中的长方体 [l, r] × [b, t] × [f, n] 经缩放和平移变成规范视见体 [−1, 1]³。相机看向 −z，所以 0 > n > f。w 始终为 1：物体不随距离变小。",
    ),
    parameters: &[
        number("l", words("l, left", "l，左"), "", [-8.0, -0.5], [0.1, -4.8]),
        number("r", words("r, right", "r，右"), "", [0.5, 8.0], [0.1, 4.8]),
        number("b", words("b, bottom", "b，下"), "", [-6.0, -0.5], [0.1, -3.0]),
        number("t", words("t, top", "t，上"), "", [0.5, 6.0], [0.1, 3.0]),
        plane_n(-5.0),
        plane_f(-17.0),
    ],
    panes: PARALLEL_PANES,
    orbit: [72.0, 22.0],
    describe: |values| {
        let window = values.scene_numbers(WINDOW);
        house_scene(ProjectionFile::orthographic(window, planes(values))?)
    },
    consequences: |values, facts| {
        let size = values.number("r") - values.number("l");
        let pixels = decimals(f64::from(facts.size[0]) / size, 1);
        let mut all = vec![sentence(
            format!("One unit is {pixels} pixels wide at every distance."),
            format!("一个单位在任何距离上都是 {pixels} 像素宽。"),
        )];
        all.extend(distortion(facts));
        all.extend(planes_only_clip(facts));
        all
    },
    ..USUAL
};

/// PE-2: the perspective view volume, M_per = M_orth P.
pub(super) static PERSPECTIVE_VOLUME: Lesson = Lesson {
    id: "perspective-volume",
    items: &["C22", "C23", "C27", "C29"],
    title: words("Perspective view volume", "透视视见体"),
    statement: words(
        "P leaves the plane z = n unchanged and shrinks the planes behind it, so that the truncated pyramid becomes the box of the orthographic view. M_orth does the rest: M_per = M_orth P. The window [l, r] × [b, t] is on z = n.",
        "P 保持 z = n 平面不变，并压缩它后面的平面，使视锥体变成正交视见体的长方体；其余由 M_orth 完成：M_per = M_orth P。窗口 [l, r] × [b, t] 位于 z = n 上。",
    ),
    parameters: &[
        number("l", words("l, left", "l，左"), "", [-4.0, -0.2], [0.05, -2.4]),
        number("r", words("r, right", "r，右"), "", [0.2, 4.0], [0.05, 2.4]),
        number("b", words("b, bottom", "b，下"), "", [-4.0, -0.2], [0.05, -1.5]),
        number("t", words("t, top", "t，上"), "", [0.2, 4.0], [0.05, 1.5]),
        plane_n(-4.0),
        plane_f(-18.0),
    ],
    describe: |values| {
        house_scene(ProjectionFile::frustum(values.scene_numbers(WINDOW), planes(values))?)
    },
    consequences: |values, facts| {
        let [n, f] = ["n", "f"].map(|key| values.number(key));
        let shrink = decimals(n / f, 3);
        let mut all = vec![sentence(
            format!("P leaves z = {n} unchanged; on z = {f} it scales x and y by n/f = {shrink}."),
            format!("P 保持 z = {n} 不变；在 z = {f} 上把 x、y 缩小为 n/f = {shrink} 倍。"),
        )];
        all.extend(opening_angle(facts));
        all.extend(distortion(facts));
        all.extend(planes_only_clip(facts));
        all
    },
    ..USUAL
};

fn opening_angle(facts: &Facts) -> Option<Sentence> {
    let [_, vertical] = facts.opening_angles()?;
    let angle = decimals(vertical, 1);
    Some(sentence(
        format!("The vertical field of view is {angle}°."),
        format!("垂直视场角为 {angle}°。"),
    ))
}

/// The midpoint of the depths and its image under P.
pub(super) static MIDPOINT_DEPTH: Lesson = Lesson {
    id: "midpoint-depth",
    items: &["C41", "C48"],
    title: words("Depth of the midpoint", "中点的深度"),
    statement: words(
        "P preserves the order of depths but not their ratios: the midpoint z = (n + f)/2 maps to (n² + f²)/(n + f), which is closer to f. The farther apart n and f are, the more of the depth range is used near the eye.",
        "P 保持深度的次序，但不保持比例：中点 z = (n + f)/2 映为 (n² + f²)/(n + f)，更靠近 f。n 与 f 相差越大，深度范围就越多地用在近处。",
    ),
    parameters: &[plane_n(-4.0), plane_f(-40.0)],
    describe: |values| house_scene(ProjectionFile::perspective(40.0, planes(values))?),
    consequences: |values, facts| {
        let [n, f] = ["n", "f"].map(|key| values.number(key));
        let (middle, image) = (0.5 * (n + f), (n * n + f * f) / (n + f));
        let depth = facts.depth_at(-middle).map_or(String::new(), |depth| decimals(depth, 3));
        let [middle, image] = [middle, image].map(|z| decimals(z, 3));
        vec![sentence(
            format!(
                "The midpoint z = {middle} maps to {image}. In the canonical view volume, where near is 1 and far is −1, its depth is {depth}, not 0."
            ),
            format!(
                "中点 z = {middle} 映为 {image}；在近平面为 1、远平面为 −1 的规范视见体中，深度是 {depth}，而不是 0。"
            ),
        )]
    },
    ..USUAL
};
