//! Lessons from *Learn WebGL* on stereo, viewports, picking and depth.

use super::effects::{distortion, planes_only_clip};
use super::{ALL_PANES, HOUSE};
use crate::facts::Facts;
use crate::lesson::{Choice, Lesson, PLANES, Values, choice, number};
use crate::lesson_scene::{LessonScene, house_scene, model_scene};
use crate::line_of_sight::LineOfSight;
use crate::number_text::{decimals, scene_number};
use crate::words::{Sentence, sentence, words};
use scene_file::SceneFile;
use scene_file::file::{
    BackgroundFile, BorderFile, CameraFile, Color, InvalidNumber, ProjectionFile, StereoFile,
    ViewportFile,
};

/// C65: two eyes, each with an off-axis window.
pub(super) static STEREO: Lesson = Lesson {
    id: "stereo",
    items: &["C65"],
    title: words("Stereo pair", "立体像对"),
    statement: words(
        "Two eyes look in the same direction through off-axis windows that coincide at the convergence distance. A point at that distance has no parallax; a nearer point appears in front of the picture. Turning the eyes toward each other would cause vertical parallax, and moving the apex would change the picture.",
        "两只眼睛朝同一方向，透过在会聚距离上重合的离轴窗口观看。会聚距离处没有视差；更近的物体凸出画面。眼睛不向内转动，也不移动顶点：那样会产生垂直视差或不同的图像。",
    ),
    parameters: &[
        number("eyes", words("eye separation", "两眼间距"), "", [0.02, 1.5], [0.02, 0.6]),
        number(
            "convergence",
            words("convergence distance", "会聚距离"),
            "",
            [4.0, 30.0],
            [0.1, 9.0],
        ),
        choice(
            "mode",
            words("pictures", "图像"),
            &[
                Choice { value: "side", label: words("side by side", "左右并列") },
                Choice { value: "anaglyph", label: words("red and cyan", "红青立体") },
            ],
        ),
    ],
    describe: |values| {
        let [eyes, convergence] = values.scene_numbers(["eyes", "convergence"]);
        let (eye_distance, convergence) = (Some(eyes.try_into()?), Some(convergence.try_into()?));
        let mut scene = house_scene(ProjectionFile::perspective(52.0, [4.0, 18.0])?)?;
        scene.stereo = Some(match values.choice("mode") {
            "side" => StereoFile::SideBySide { eye_distance, convergence },
            _ => StereoFile::Anaglyph { eye_distance, convergence },
        });
        Ok(scene)
    },
    consequences: stereo_consequences,
    ..Lesson::USUAL
};

fn stereo_consequences(values: &Values<'_>, facts: &Facts) -> Vec<Sentence> {
    let Some([nearest, farthest]) = facts.model_range else { return Vec::new() };
    let [eyes, convergence] = ["eyes", "convergence"].map(|key| values.number(key));
    // On the plane of convergence, the right eye's image of a point at distance D is e (1 − c / D)
    // to the right of the left eye's image.
    let parallax = |distance: f64| eyes * (1.0 - convergence / distance);
    let sentence_for = |distance: f64, what: [&str; 2]| {
        let (shift, text) = (parallax(distance), decimals(distance, 2));
        let amount = decimals(shift.abs(), 3);
        match shift < 0.0 {
            true => sentence(
                format!(
                    "{} (distance {text}): crossed parallax {amount}, so it appears in front of the picture.",
                    what[0]
                ),
                format!("{}（距离 {text}）：交叉视差 {amount}，凸出画面。", what[1]),
            ),
            false => sentence(
                format!(
                    "{} (distance {text}): parallax {amount}, so it appears behind the picture.",
                    what[0]
                ),
                format!("{}（距离 {text}）：视差 {amount}，位于画面之后。", what[1]),
            ),
        }
    };
    vec![
        sentence_for(nearest, ["The nearest corner", "最近的角"]),
        sentence_for(farthest, ["The farthest corner", "最远的角"]),
    ]
}

/// C59, C99: a rectangle of the picture.
pub(super) static VIEWPORT: Lesson = Lesson {
    id: "viewport",
    items: &["C59", "C99"],
    title: words("Viewport", "视口"),
    statement: words(
        "The viewport transform maps x and y from −1 … 1 to a rectangle of the picture, like glViewport(x, y, width, height), where y is counted from the bottom. A rectangle whose shape differs from the window's distorts the picture.",
        "视口变换把 −1 … 1 的 x、y 映射到图像中的一个矩形，如 glViewport(x, y, width, height)；y 自下而上数。矩形与窗口的宽高比不同时，物体会变形。",
    ),
    parameters: &[
        number("x", words("x, left", "x，左"), "%", [0.0, 80.0], [1.0, 10.0]),
        number("y", words("y, bottom", "y，下"), "%", [0.0, 80.0], [1.0, 10.0]),
        number("width", words("width", "宽"), "%", [20.0, 100.0], [1.0, 60.0]),
        number("height", words("height", "高"), "%", [20.0, 100.0], [1.0, 80.0]),
    ],
    describe: |values| {
        let [x, y, width, height] = viewport_rectangle(values);
        let projection = ProjectionFile::frustum([-2.0, 2.0, -1.25, 1.25], [4.0, 18.0])?;
        around_viewports(vec![framed_viewport([x, 1.0 - y - height, width, height], projection)?])
    },
    remark: AROUND_VIEWPORTS,
    consequences: |values, facts| {
        let [x, y, width, height] = viewport_rectangle(values);
        let [picture_width, picture_height] = values.size.map(f64::from);
        let pixels =
            [x * picture_width, y * picture_height, width * picture_width, height * picture_height];
        let [x, y, w, h] = pixels.map(|length| decimals(length, 1));
        let mut all = vec![sentence(
            format!(
                "glViewport({x}, {y}, {w}, {h}): x_s = {x} + (x + 1) · {w} / 2, y_s = {y} + (y + 1) · {h} / 2 from the bottom."
            ),
            format!(
                "glViewport({x}, {y}, {w}, {h})：x_s = {x} + (x + 1) · {w} / 2，y_s = {y} + (y + 1) · {h} / 2（自下而上）。"
            ),
        )];
        all.extend(distortion(facts));
        all
    },
    ..Lesson::USUAL
};

/// Returns the rectangle in fractions of the picture, from the lower left corner, clamped to the
/// picture.
fn viewport_rectangle(values: &Values<'_>) -> [f64; 4] {
    let [x, y, width, height] = ["x", "y", "width", "height"].map(|key| values.number(key) / 100.0);
    [x, y, width.min(1.0 - x), height.min(1.0 - y)]
}

/// Returns a viewport with a border.
pub(super) fn framed_viewport(
    at: [f64; 4],
    projection: ProjectionFile,
) -> Result<ViewportFile, InvalidNumber> {
    let camera = CameraFile::look_at([4.4, 3.2, 11.0], [0.0, 2.2, 0.0]);
    Ok(ViewportFile {
        camera: Some(camera.with_projection(projection)),
        background: Some(BackgroundFile::Color(Color::WHITE)),
        border: Some(BorderFile { color: Color([0x1a, 0x56, 0x80]), ..BorderFile::default() }),
        ..ViewportFile::at(at.map(scene_number))?
    })
}

/// The remark for a scene that shows models only in its viewports.
pub(super) const AROUND_VIEWPORTS: &str =
    ": the main camera looks away, so that only the viewport shows the model";

/// Returns a scene that shows models only in its viewports.
pub(super) fn around_viewports(viewports: Vec<ViewportFile>) -> LessonScene {
    let camera = CameraFile::look_to([0.0, 0.0, 100.0], [0.0, 0.0, 1.0]);
    let projection = ProjectionFile::perspective(35.0, [1.0, 2.0])?;
    Ok(SceneFile { viewports, ..model_scene(HOUSE, camera.with_projection(projection))? })
}

/// The mouse: from a pixel back to the world.
pub(super) static PICKING: Lesson = Lesson {
    id: "picking",
    items: &["C26", "C97"],
    title: words("Picking", "拾取"),
    statement: words(
        "A pixel is mapped back to −1 … 1, and then by the inverse matrix and a divide by w to a point on the near plane and a point on the far plane. The line through both points is the line of sight, and the first triangle on it is picked.",
        "像素沿观察流水线返回：先映射到 −1 … 1，再用逆矩阵求出近平面和远平面上的点，并除以 w。过这两点的直线就是拾取射线；射线上的第一个三角形就是被拾取的物体。",
    ),
    parameters: &[
        number("x", words("mouse x", "鼠标 x"), "%", [0.0, 100.0], [0.5, 50.0]),
        number(
            "y",
            words("mouse y, from the top", "鼠标 y（自上而下）"),
            "%",
            [0.0, 100.0],
            [0.5, 60.0],
        ),
    ],
    describe: |_| house_scene(ProjectionFile::perspective(40.0, [4.0, 18.0])?),
    consequences: |values, facts| {
        let Some(pointer) = (values.lesson.pointer)(values) else { return Vec::new() };
        let Some(line) = LineOfSight::through_picture(&facts.view_projection, pointer) else {
            return Vec::new();
        };
        let text = |point: [f64; 3]| {
            let numbers = point.map(|c| decimals(c, 2));
            format!("({})", numbers.join(", "))
        };
        let [x, y] = [decimals(2.0 * pointer[0] - 1.0, 3), decimals(1.0 - 2.0 * pointer[1], 3)];
        let [near, far] = line.ends.map(|end| text(end.into()));
        let mut all = vec![sentence(
            format!(
                "NDC ({x}, {y}): the line of sight runs from {near} on the near plane to {far} on the far plane."
            ),
            format!("NDC ({x}, {y})：拾取射线从近平面上的 {near} 到远平面上的 {far}。"),
        )];
        all.push(match line.first_hit(&facts.loaded.models.triangles.counted) {
            Some(hit) => {
                let hit = text(hit.into());
                sentence(
                    format!("It first hits the model at {hit}."),
                    format!("它首先在 {hit} 处与模型相交。"),
                )
            }
            None => sentence("It misses the model.", "它与模型不相交。"),
        });
        all
    },
    pointer: |values| Some(["x", "y"].map(|key| values.number(key) / 100.0)),
    ..Lesson::USUAL
};

/// C67, C68: depth as a function of distance.
pub(super) static DEPTH_TABLE: Lesson = Lesson {
    id: "depth-table",
    items: &["C67", "C68"],
    title: words("Depth after the divide", "透视除法之后的深度"),
    statement: words(
        "Depth is not linear in distance: z = c₁/D + c₂ with c₁ = 2FN/(N − F) and c₂ = (F + N)/(F − N). Half of the depth range is used for distances from N to 2FN/(F + N). Moving the near plane out helps; moving the far plane in hardly makes a difference.",
        "深度与距离不是线性关系：z = c₁/D + c₂，c₁ = 2FN/(N − F)，c₂ = (F + N)/(F − N)。一半的深度范围用在 N 到 2FN/(F + N) 的距离上。把近平面移远有用；把远平面移近几乎无用。",
    ),
    parameters: &[
        number("near", words("near plane", "近平面"), "", [0.1, 11.0], [0.1, 2.0]),
        number("far", words("far plane", "远平面"), "", [11.5, 1000.0], [0.5, 40.0]),
    ],
    panes: ALL_PANES,
    describe: |values| {
        house_scene(ProjectionFile::perspective(40.0, values.scene_numbers(PLANES))?)
    },
    consequences: |values, facts| {
        let [near, far] = ["near", "far"].map(|key| values.number(key));
        let half = decimals(2.0 * far * near / (far + near), 4);
        let mut all = vec![sentence(
            format!(
                "Depth 0, the middle of the range, is at distance {half}; the far plane is at {far}."
            ),
            format!("深度 0（一半的范围）在距离 {half} 处；远平面在 {far} 处。"),
        )];
        all.extend(used_depths(facts));
        all.extend(planes_only_clip(facts));
        all
    },
    ..Lesson::USUAL
};

/// Describes the part of the depth range that the model occupies.
fn used_depths(facts: &Facts) -> Option<Sentence> {
    let [near, far] = facts.model_range?;
    let [low, high] = [facts.depth_at(near)?, facts.depth_at(far)?];
    let percent = decimals(50.0 * (low.min(1.0) - high.max(-1.0)), 1);
    Some(sentence(
        format!("The model occupies {percent}% of the depth range."),
        format!("模型占用了 {percent} % 的深度范围。"),
    ))
}
