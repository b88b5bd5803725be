//! Lessons from the slides on parallel projections: multiview, axonometric and oblique.

use super::PARALLEL_PANES;
use crate::lesson::{Choice, Lesson, Source, Values, choice, number};
use crate::lesson_scene::{LessonScene, framed, line_drawing};
use crate::number_text::decimals;
use crate::words::{Sentence, sentence, words};
use projection::PrincipalView;
use scene_file::SceneFile;
use scene_file::file::{CameraFile, OverlayFile, ProjectionFile, ViewportFile, ViewportsScale};

/// The settings that these lessons share.
const USUAL: Lesson = Lesson { source: Source::Slides, panes: PARALLEL_PANES, ..Lesson::USUAL };

/// MV-1 to MV-3: projections onto the principal planes.
pub(super) static MULTIVIEW: Lesson = Lesson {
    id: "multiview",
    items: &["C75"],
    title: words("Multiview projection", "三视图"),
    statement: words(
        "Each view projects orthographically onto a principal plane: the front view drops z (XOY), the side view drops x (YOZ), and the top view drops y (ZOX). Faces parallel to a view's plane keep their true shape in it, but no single view shows everything.",
        "每个视图都正交投影到一个坐标平面：主视图投影到 XOY 面，去掉 z；侧视图投影到 YOZ 面，去掉 x；俯视图投影到 ZOX 面，去掉 y。平行于投影平面的面保持真实形状；单个视图不能表示整个物体。",
    ),
    parameters: &[choice(
        "view",
        words("view", "视图"),
        &[
            Choice {
                value: "all",
                label: words("front, top, side, isometric", "主、俯、侧视图与正等测图"),
            },
            Choice { value: "front", label: words("front, onto XOY", "主视图（XOY 面）") },
            Choice {
                value: "side", label: words("right side, onto YOZ", "右视图（YOZ 面）")
            },
            Choice { value: "top", label: words("top, onto ZOX", "俯视图（ZOX 面）") },
        ],
    )],
    describe: |values| match values.choice("view") {
        "front" => line_drawing(ProjectionFile::Multiview(PrincipalView::Front), 12.0),
        "side" => line_drawing(ProjectionFile::Multiview(PrincipalView::Right), 12.0),
        "top" => line_drawing(ProjectionFile::Multiview(PrincipalView::Top), 12.0),
        _ => four_views(),
    },
    consequences: |values, _| {
        let lost = match values.choice("view") {
            "front" => [("x", "y", "z")],
            "side" => [("z", "y", "x")],
            "top" => [("x", "z", "y")],
            _ => {
                return vec![sentence(
                    "The views have the same scale: widths match between front and top, and heights match between front and side.",
                    "各视图比例相同：主、俯视图长对正，主、侧视图高平齐。",
                )];
            }
        };
        let [(a, b, lost)] = lost;
        vec![sentence(
            format!(
                "Lengths along {a} and {b} are true; every point loses its {lost}, so the matrix is singular."
            ),
            format!("{a} 和 {b} 为真实长度；每个点都失去了 {lost}，所以矩阵是奇异的。"),
        )]
    },
    ..USUAL
};

/// Returns front, top, side and isometric views at the same scale.
fn four_views() -> LessonScene {
    let view = |[left, top]: [f64; 2], projection: ProjectionFile, caption: &str| {
        Ok(ViewportFile {
            camera: Some(CameraFile::default().with_projection(projection)),
            caption: Some(caption.to_owned()),
            ..ViewportFile::at([left, top, 0.5, 0.5])?
        })
    };
    Ok(SceneFile {
        viewports_scale: ViewportsScale::Shared,
        viewports: vec![
            view([0.0, 0.5], ProjectionFile::Multiview(PrincipalView::Front), "front: x, y")?,
            view([0.5, 0.5], ProjectionFile::Multiview(PrincipalView::Right), "right side: z, y")?,
            view([0.0, 0.0], ProjectionFile::Multiview(PrincipalView::Top), "top: x, z")?,
            view([0.5, 0.0], ProjectionFile::Isometric, "isometric")?,
        ],
        ..line_drawing(ProjectionFile::Multiview(PrincipalView::Front), 5.0)?
    })
}

/// AX-1: the object is rotated by α, tilted by β, and then projected onto XOY.
pub(super) static AXONOMETRIC: Lesson = Lesson {
    id: "axonometric",
    items: &["C76"],
    title: words("Axonometric projection", "轴测投影"),
    statement: words(
        "The object is rotated by α about y and tilted by β about x, and then projected orthographically, so all three axes are visible. If all three axes have equal foreshortening, the projection is isometric; if only two do, it is dimetric; otherwise it is trimetric. The squares of the three factors always sum to 2.",
        "物体先绕 y 轴旋转 α，再绕 x 轴旋转 β，然后正交投影：三个轴都可见。三个轴向伸缩系数相等为正等测，两个相等为正二测，都不等为正三测；系数的平方和恒为 2。",
    ),
    parameters: &[
        number("alpha", words("α, about y", "α，绕 y 轴"), "°", [-90.0, 90.0], [0.5, 45.0]),
        number("beta", words("β, about x", "β，绕 x 轴"), "°", [0.0, 90.0], [0.01, 35.26]),
    ],
    describe: |values| {
        let [alpha, beta] = ["alpha", "beta"].map(|key| values.number(key));
        // From directly above, the viewing direction does not determine which way is up in the
        // picture.
        let from = Some([alpha, beta.min(89.9)]);
        let camera = framed(ProjectionFile::ORTHOGRAPHIC, 10.0, from)?;
        Ok(SceneFile { camera, ..with_axes(ProjectionFile::ORTHOGRAPHIC)? })
    },
    consequences: |values, _| vec![foreshortening(values)],
    ..USUAL
};

/// Returns the house as a line drawing with the world axes.
fn with_axes(projection: ProjectionFile) -> LessonScene {
    let axes = OverlayFile::Axes { length: Some(5.0.try_into()?) };
    Ok(SceneFile { overlays: vec![axes], ..line_drawing(projection, 10.0)? })
}

fn foreshortening(values: &Values<'_>) -> Sentence {
    let [(sa, ca), (sb, cb)] =
        ["alpha", "beta"].map(|key| libm::sincos(values.number(key).to_radians()));
    // x √(cos²α + sin²α sin²β), y |cos β|, z √(sin²α + cos²α sin²β)
    let factors = [
        libm::sqrt(ca * ca + sa * sa * sb * sb),
        cb.abs(),
        libm::sqrt(sa * sa + ca * ca * sb * sb),
    ];
    let [x, y, z] = factors;
    let equal = [(x, y), (y, z), (z, x)].iter().filter(|(a, b)| (a - b).abs() < 2e-3).count();
    let (kind, kind_zh) = match equal {
        3 => ("isometric", "正等测"),
        0 => ("trimetric", "正三测"),
        _ => ("dimetric", "正二测"),
    };
    let [x, y, z] = factors.map(|factor| decimals(factor, 3));
    sentence(
        format!("Foreshortening: x {x}, y {y}, z {z} ({kind})."),
        format!("轴向伸缩系数：x {x}，y {y}，z {z}：{kind_zh}。"),
    )
}

/// OB-1: projectors that are not perpendicular to the picture.
pub(super) static OBLIQUE: Lesson = Lesson {
    id: "oblique",
    items: &["C77", "C78"],
    title: words("Oblique projection", "斜投影"),
    statement: words(
        "The projectors are parallel and meet the picture at an angle α other than 90°. The front keeps its true shape, and a unit of depth is drawn at angle φ with length L₁ = cot α. L₁ is 1 in a cavalier projection, ½ in a cabinet projection, and 0 in an orthographic projection.",
        "投影线互相平行但不垂直于投影平面：正面保持真实形状，深度沿角 φ 方向以长度 L₁ = cot α 画出。斜等测 L₁ = 1，斜二测 L₁ = ½；L₁ = 0 就是正交投影。",
    ),
    parameters: &[
        number(
            "length",
            words("L₁, drawn length per unit of depth", "L₁，单位深度画出的长度"),
            "",
            [0.0, 1.5],
            [0.01, 1.0],
        ),
        number("phi", words("φ, direction of depth", "φ，深度方向"), "°", [0.0, 90.0], [1.0, 45.0]),
    ],
    describe: |values| {
        let [length, phi] = values.scene_numbers(["length", "phi"]);
        let (length, angle_degrees) = (length.try_into()?, phi.try_into()?);
        with_axes(ProjectionFile::Oblique { length, angle_degrees })
    },
    consequences: |values, _| {
        let length = values.number("length");
        let alpha = decimals(libm::atan2(1.0, length).to_degrees(), 1);
        let (name, name_zh) = match length {
            0.0 => ("orthographic", "正交投影"),
            0.5 => ("cabinet", "斜二测"),
            1.0 => ("cavalier", "斜等测"),
            _ => ("oblique", "斜投影"),
        };
        let (sin, cos) = libm::sincos(values.number("phi").to_radians());
        let [x, y] = [length * cos, length * sin].map(|factor| decimals(factor, 3));
        vec![sentence(
            format!(
                "The projectors meet the picture at α = {alpha}°: {name}. x_p = x + z L₁ cos φ = x + {x} z, y_p = y + z L₁ sin φ = y + {y} z."
            ),
            format!(
                "投影线与投影平面的夹角 α = {alpha}°：{name_zh}。x_p = x + z L₁ cos φ = x + {x} z，y_p = y + z L₁ sin φ = y + {y} z。"
            ),
        )]
    },
    ..USUAL
};
