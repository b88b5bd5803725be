//! Lessons from *Learn WebGL* on projections: perspective, frustum and ortho.

use super::effects::{distortion, planes_only_clip};
use super::{HOUSE, PARALLEL_PANES};
use crate::facts::Facts;
use crate::lesson::{Choice, Lesson, PLANES, Values, WINDOW, choice, number};
use crate::lesson_scene::{house_scene, model_scene};
use crate::number_text::{decimals, scene_number};
use crate::words::{Sentence, sentence, words};
use scene_file::file::{CameraFile, InvalidNumber, ProjectionFile};

/// C62: a small field of view magnifies, a wrong aspect ratio distorts, and near and far only clip.
pub(super) static PERSPECTIVE: Lesson = Lesson {
    id: "perspective",
    items: &["C61", "C62", "C70", "C92", "C94"],
    title: words("Perspective", "透视投影"),
    statement: words(
        "A smaller field of view enlarges the objects. If the aspect ratio differs from the picture's, the objects are distorted. The near and far planes only clip and do not move anything.",
        "视场角越小，物体越大。宽高比与图像不一致时，物体会变形。近平面和远平面只裁剪，不移动任何物体。",
    ),
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
    describe: |values| house_scene(perspective(values)?),
    consequences: |values, facts| {
        let fov = values.number("fov");
        let factor = libm::tan(20_f64.to_radians()) / libm::tan((0.5 * fov).to_radians());
        let factor = decimals(factor, 2);
        let mut all = vec![match fov == 40.0 {
            true => sentence(
                "field of view 40°: sizes at other angles are compared with the sizes at this angle.",
                "视场角 40°：其他角度下的大小都与此时的大小相比较。",
            ),
            false => sentence(
                format!("field of view {fov}°: everything is {factor} times as large as at 40°."),
                format!("视场角 {fov}°：所有物体的大小是 40° 时的 {factor} 倍。"),
            ),
        }];
        all.extend(distortion(facts));
        all.extend(planes_only_clip(facts));
        all
    },
    ..Lesson::USUAL
};

/// Returns the perspective projection with a field of view, or a frustum if its aspect ratio
/// differs from the picture's.
fn perspective(values: &Values<'_>) -> Result<ProjectionFile, InvalidNumber> {
    let [fov, aspect, near] = ["fov", "aspect", "near"].map(|key| values.number(key));
    let planes = values.scene_numbers(PLANES);
    if (aspect - values.aspect()).abs() < 1e-9 {
        return ProjectionFile::perspective(scene_number(fov), planes);
    }
    // right = aspect · top (GL-2)
    let top = near * libm::tan((0.5 * fov).to_radians());
    let [r, t] = [aspect * top, top].map(scene_number);
    ProjectionFile::frustum([-r, r, -t, t], planes)
}

/// C63, C64: with a fixed window, near changes the angle; createFrustum moves the apex (M12).
pub(super) static FRUSTUM: Lesson = Lesson {
    id: "frustum",
    items: &["C63", "C64", "C66", "M12"],
    title: words("Frustum", "视锥体（frustum）"),
    statement: words(
        "The window on the near plane keeps its size, so the distance of the near plane changes the field of view, while the far plane only clips. Left, right, bottom and top move the window. The lesson's createFrustum moves the apex behind the window's center instead of shearing the volume, so the picture differs unless the window is centered.",
        "近平面上的窗口大小不变，所以近平面的距离会改变视场角；远平面只裁剪。左、右、下、上移动窗口。教程中的 createFrustum 把顶点移到窗口中心的正后方，而不是对视锥体作错切：除非窗口居中，否则图像不同。",
    ),
    parameters: &[
        number("left", words("left", "左"), "", [-4.0, 0.0], [0.1, -2.4]),
        number("right", words("right", "右"), "", [0.2, 4.0], [0.1, 2.4]),
        number("bottom", words("bottom", "下"), "", [-4.0, 0.0], [0.05, -1.5]),
        number("top", words("top", "上"), "", [0.2, 4.0], [0.05, 1.5]),
        number("near", words("near plane", "近平面"), "", [1.0, 11.0], [0.1, 4.0]),
        number("far", words("far plane", "远平面"), "", [11.5, 60.0], [0.5, 18.0]),
        choice(
            "apex",
            words("apex", "视锥体顶点"),
            &[
                Choice {
                    value: "eye",
                    label: words("at the eye (glFrustum)", "在视点（glFrustum）"),
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
    describe: |values| {
        let (window, planes) = (values.scene_numbers(WINDOW), values.scene_numbers(PLANES));
        let projection = match ProjectionFile::frustum(window, planes)? {
            ProjectionFile::Frustum { left, right, bottom, top, near, far }
                if values.choice("apex") == "moved" =>
            {
                ProjectionFile::ApexMovedFrustum { left, right, bottom, top, near, far }
            }
            frustum => frustum,
        };
        let camera = CameraFile::look_at([3.0, 3.0, 10.5], [0.0, 2.2, 0.0]);
        model_scene(HOUSE, camera.with_projection(projection))
    },
    consequences: frustum_consequences,
    ..Lesson::USUAL
};

fn frustum_consequences(values: &Values<'_>, facts: &Facts) -> Vec<Sentence> {
    let mut all = Vec::new();
    let near = scene_number(values.number("near"));
    if let Some([_, vertical]) = facts.opening_angles() {
        let angle = decimals(vertical, 1);
        all.push(sentence(
            format!("near {near}: with this window, the vertical field of view is {angle}°."),
            format!("近平面 {near}：窗口大小不变，所以垂直视场角为 {angle}°。"),
        ));
    }
    let center = [("left", "right"), ("bottom", "top")]
        .map(|(low, high)| 0.5 * (values.number(low) + values.number(high)));
    let is_centered = center == [0.0; 2];
    let [x, y] = center.map(scene_number);
    all.push(match (values.choice("apex"), is_centered) {
        (_, true) => sentence(
            "The window is centered on the line of sight, so both kinds of frustum are the same.",
            "窗口以视线为中心：两种视锥体完全相同。",
        ),
        ("moved", false) => sentence(
            format!("The apex has moved to ({x}, {y}), directly behind the window's center. The eye is no longer at the camera, and the picture matches glFrustum only on the near plane."),
            format!("顶点移到了窗口中心正后方的 ({x}, {y})：视点不在相机处，图像只在近平面上与 glFrustum 一致。"),
        ),
        _ => sentence(
            format!("The window's center is at ({x}, {y}), off the line of sight, so the volume is sheared and the apex stays at the eye."),
            format!("窗口中心在 ({x}, {y})，偏离视线：视锥体经过错切，顶点仍在视点。"),
        ),
    });
    all.extend(distortion(facts));
    all.extend(planes_only_clip(facts));
    all
}

/// C94: the box of createOrthographic.
pub(super) static ORTHO: Lesson = Lesson {
    id: "ortho",
    items: &["C90", "C94"],
    title: words("Orthographic projection", "正交投影"),
    statement: words(
        "A box in the world is shown without foreshortening: an object twice as far away has the same size. A smaller window enlarges the objects. Near and far only clip, and near may even be behind the camera.",
        "长方体视见体中的物体没有近大远小：远一倍的物体同样大。窗口越小，物体越大；近平面和远平面只裁剪，近平面甚至可以在相机后面。",
    ),
    parameters: &[
        number("left", words("left", "左"), "", [-8.0, 0.0], [0.1, -4.8]),
        number("right", words("right", "右"), "", [0.2, 8.0], [0.1, 4.8]),
        number("bottom", words("bottom", "下"), "", [-6.0, 0.0], [0.1, -3.0]),
        number("top", words("top", "上"), "", [0.2, 6.0], [0.1, 3.0]),
        number("near", words("near plane", "近平面"), "", [-6.0, 11.0], [0.1, 5.0]),
        number("far", words("far plane", "远平面"), "", [11.5, 40.0], [0.5, 17.0]),
    ],
    panes: PARALLEL_PANES,
    orbit: [72.0, 22.0],
    describe: |values| {
        let (window, planes) = (values.scene_numbers(WINDOW), values.scene_numbers(PLANES));
        house_scene(ProjectionFile::orthographic(window, planes)?)
    },
    consequences: |values, facts| {
        let width = values.number("right") - values.number("left");
        let (width, pixels) = (decimals(width, 2), decimals(f64::from(facts.size[0]) / width, 1));
        let mut all = vec![sentence(
            format!(
                "The window is {width} wide, so one unit is {pixels} pixels wide at every distance."
            ),
            format!("窗口宽 {width}，所以一个单位在任何距离上都是 {pixels} 像素宽。"),
        )];
        all.extend(distortion(facts));
        all.extend(planes_only_clip(facts));
        all
    },
    ..Lesson::USUAL
};
