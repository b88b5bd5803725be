//! The lessons of *Learn WebGL*: perspective, frustum.

use super::{ALL_PANES, HOUSE};
use crate::facts::Facts;
use crate::lesson::{Choice, Lesson, Source, Values, choice, number};
use crate::number_text::{decimals, scene_number};
use crate::scene_description::{SceneDescription, look_at};
use crate::words::{Sentence, sentence, words};
use pipeline::explain::ApiConventions;

/// C62: the field of view enlarges, a wrong aspect distorts, near and far only clip.
pub(crate) static PERSPECTIVE: Lesson = Lesson {
    id: "perspective",
    source: Source::LearnWebGl,
    items: &["C61", "C62"],
    title: words("Perspective", "透视投影"),
    statement: words(
        "A smaller field of view enlarges. An aspect ratio that is not the picture's distorts. The near and far planes only clip: they move nothing.",
        "视场角越小，物体越大。宽高比与画面不一致时图像会变形。近平面和远平面只裁剪，不移动任何东西。",
    ),
    models: &[HOUSE],
    parameters: &[
        number(
            "fov",
            words("vertical field of view", "垂直视场角"),
            "°",
            [10.0, 120.0],
            [1.0, 40.0],
        ),
        number("aspect", words("aspect ratio", "宽高比"), "", [0.4, 4.0], [0.1, 1.6]),
        number("near", words("near plane", "近平面"), "", [0.5, 11.0], [0.1, 4.0]),
        number("far", words("far plane", "远平面"), "", [11.5, 60.0], [0.5, 18.0]),
    ],
    panes: ALL_PANES,
    pin: [0.0, 4.75, 0.0],
    orbit: [78.0, 20.0],
    conventions: ApiConventions::OpenGl,
    describe: |values| {
        let projection = perspective(values);
        SceneDescription::new(HOUSE, look_at([4.0, 3.0, 10.0], [0.0, 2.2, 0.0]), projection)
    },
    consequences: |values, facts| {
        let fov = values.number("fov");
        let factor = libm::tan(20_f64.to_radians()) / libm::tan((0.5 * fov).to_radians());
        let factor = decimals(factor, 2);
        let mut all = vec![sentence(
            format!("field of view {fov}°: everything is {factor} times as large as at 40°."),
            format!("视场角 {fov}°：所有物体的大小是 40° 时的 {factor} 倍。"),
        )];
        all.extend(distortion(facts));
        all.extend(planes_only_clip(values, facts));
        all
    },
};

/// A perspective by its angle; through a window of another shape if the aspect ratio is not that of
/// the picture.
fn perspective(values: &Values<'_>) -> String {
    let [fov, aspect, near, far] = ["fov", "aspect", "near", "far"].map(|key| values.number(key));
    let [n, f] = [near, far].map(scene_number);
    if (aspect - values.aspect()).abs() < 1e-9 {
        return format!("Perspective(fov_y_degrees: {}, near: {n}, far: {f})", scene_number(fov));
    }
    // right = aspect · top (GL-2)
    let top = near * libm::tan((0.5 * fov).to_radians());
    let [r, t] = [aspect * top, top].map(scene_number);
    format!("Frustum(left: -{r}, right: {r}, bottom: -{t}, top: {t}, near: {n}, far: {f})")
}

/// How the window's shape distorts, if it is not that of the picture.
fn distortion(facts: &Facts) -> Option<Sentence> {
    let wide = facts.picture_aspect() / facts.window_aspect()?;
    if (wide - 1.0).abs() < 1e-3 {
        return Some(sentence(
            "The window has the shape of the picture: nothing is distorted.",
            "窗口与画面的宽高比相同：没有变形。",
        ));
    }
    let (window, picture) =
        (decimals(facts.window_aspect()?, 2), decimals(facts.picture_aspect(), 2));
    let stretch = decimals(wide, 2);
    Some(sentence(
        format!(
            "The window is {window} : 1 and the picture {picture} : 1: everything is {stretch} times as wide as it should be."
        ),
        format!(
            "窗口为 {window} : 1，画面为 {picture} : 1：所有物体的宽度是应有宽度的 {stretch} 倍。"
        ),
    ))
}

/// What near and far cut off of the model.
fn planes_only_clip(values: &Values<'_>, facts: &Facts) -> Vec<Sentence> {
    let (Some([nearest, farthest]), [Some(near), Some(far)]) = (facts.model_range, facts.planes)
    else {
        return Vec::new();
    };
    let (near_text, far_text) =
        (scene_number(values.number("near")), scene_number(values.number("far")));
    let mut all = Vec::new();
    if near > farthest {
        all.push(sentence(
            format!("near {near_text}: the whole house is before the near plane and cut off."),
            format!("近平面 {near_text}：整座房子都在近平面之前，全部被裁掉。"),
        ));
    } else if near > nearest {
        let depth = decimals(nearest, 2);
        all.push(sentence(
            format!("near {near_text}: the front corner, at distance {depth}, is cut off."),
            format!("近平面 {near_text}：距离 {depth} 处的前角被裁掉。"),
        ));
    }
    if far < farthest {
        let depth = decimals(farthest, 2);
        all.push(sentence(
            format!("far {far_text}: the back, as far as {depth}, is cut off."),
            format!("远平面 {far_text}：最远到 {depth} 的后部被裁掉。"),
        ));
    }
    all
}

/// C63, C64: the window stays, so near changes the angle; the apex that moves (M12).
pub(crate) static FRUSTUM: Lesson = Lesson {
    id: "frustum",
    source: Source::LearnWebGl,
    items: &["C63", "C64", "C66", "M12"],
    title: words("Frustum", "视锥体（frustum）"),
    statement: words(
        "The window on the near plane keeps its size, so the distance of the near plane changes the lens angle; the far plane only clips. Left, right, bottom and top move the window. The lesson's createFrustum moves the apex behind the window's center instead of shearing the volume: another picture unless the window is centered.",
        "近平面上的窗口大小不变，所以近平面的距离会改变视角；远平面只裁剪。左、右、下、上移动窗口。教程中的 createFrustum 把顶点移到窗口中心的正后方，而不是剪切视锥体：除非窗口居中，否则画面不同。",
    ),
    models: &[HOUSE],
    parameters: &[
        number("left", words("left", "左"), "", [-4.0, 0.0], [0.1, -2.0]),
        number("right", words("right", "右"), "", [0.2, 4.0], [0.1, 2.0]),
        number("bottom", words("bottom", "下"), "", [-4.0, 0.0], [0.05, -1.25]),
        number("top", words("top", "上"), "", [0.2, 4.0], [0.05, 1.25]),
        number("near", words("near plane", "近平面"), "", [1.0, 11.0], [0.1, 4.0]),
        number("far", words("far plane", "远平面"), "", [11.5, 60.0], [0.5, 18.0]),
        choice(
            "apex",
            words("apex", "视锥体顶点"),
            &[
                Choice {
                    value: "eye",
                    label: words("in the eye (glFrustum)", "在视点（glFrustum）"),
                },
                Choice {
                    value: "moved",
                    label: words(
                        "behind the window's center (createFrustum)",
                        "在窗口中心正后方（createFrustum）",
                    ),
                },
            ],
        ),
    ],
    panes: ALL_PANES,
    pin: [0.0, 4.75, 0.0],
    orbit: [78.0, 20.0],
    conventions: ApiConventions::OpenGl,
    describe: |values| {
        let name = if values.choice("apex") == "moved" { "ApexMovedFrustum" } else { "Frustum" };
        let fields = ["left", "right", "bottom", "top", "near", "far"]
            .map(|key| format!("{key}: {}", scene_number(values.number(key))));
        let projection = format!("{name}({})", fields.join(", "));
        SceneDescription::new(HOUSE, look_at([3.0, 3.0, 10.5], [0.0, 2.2, 0.0]), projection)
    },
    consequences: frustum_consequences,
};

fn frustum_consequences(values: &Values<'_>, facts: &Facts) -> Vec<Sentence> {
    let mut all = Vec::new();
    let near = scene_number(values.number("near"));
    if let Some([_, vertical]) = facts.opening_angles() {
        let angle = decimals(vertical, 1);
        all.push(sentence(
            format!("near {near}: the window keeps its size, so the vertical angle is {angle}°."),
            format!("近平面 {near}：窗口大小不变，所以垂直视角为 {angle}°。"),
        ));
    }
    let center = [("left", "right"), ("bottom", "top")]
        .map(|(low, high)| 0.5 * (values.number(low) + values.number(high)));
    let is_centered = center == [0.0; 2];
    let [x, y] = center.map(scene_number);
    all.push(match (values.choice("apex"), is_centered) {
        (_, true) => sentence(
            "The window is centered on the line of sight: both kinds of frustum are the same.",
            "窗口以视线为中心：两种视锥体完全相同。",
        ),
        ("moved", false) => sentence(
            format!("The apex has moved to ({x}, {y}), right behind the window's center: the eye is not where the camera is, and the picture agrees with glFrustum's only on the near plane."),
            format!("顶点移到了窗口中心正后方的 ({x}, {y})：视点不在相机处，画面只在近平面上与 glFrustum 一致。"),
        ),
        _ => sentence(
            format!("The window's center is at ({x}, {y}), beside the line of sight: the volume is sheared, and the apex stays in the eye."),
            format!("窗口中心在 ({x}, {y})，偏离视线：视锥体被剪切，顶点仍在视点。"),
        ),
    });
    all.extend(distortion(facts));
    all.extend(planes_only_clip(values, facts));
    all
}
