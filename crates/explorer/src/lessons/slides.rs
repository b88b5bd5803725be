//! Lessons from the slides on normalization, window and viewport, and height fields.

use super::learn_webgl_screen::{AROUND_VIEWPORTS, around_viewports, framed_viewport};
use super::{ALL_PANES, HOUSE};
use crate::lesson::{Choice, Lesson, PLANES, Source, Values, VolumeStage, WINDOW, choice, number};
use crate::lesson_scene::{framed, model_scene};
use crate::number_text::{decimals, scene_number};
use crate::words::{sentence, words};
use scene_file::SceneFile;
use scene_file::file::{
    BackgroundFile, CameraFile, Color, ProjectionFile, StyleFile, ViewportFile,
};

/// The settings that these lessons share.
const USUAL: Lesson = Lesson { source: Source::Slides, ..Lesson::USUAL };

/// VV-2: shear, scale, depth.
pub(super) static NORMALIZATION: Lesson = Lesson {
    id: "normalization",
    items: &["C87", "C88", "C89"],
    title: words("Normalization", "投影规范化"),
    statement: words(
        "Any frustum becomes the canonical view volume in three steps: a shear moves the center line to −z, a scale changes the sides to x = ±z and y = ±z, and the perspective matrix turns the pyramid into a cube. A single clipper then serves every projection.",
        "任何视锥体都可以分三步变成规范视见体：错切把中心线移到 −z 上，缩放使侧面成为 x = ±z、y = ±z，透视矩阵再把它变成立方体。这样一个裁剪程序就能用于所有投影。",
    ),
    parameters: &[
        choice(
            "step",
            words("completed steps", "完成的步骤"),
            &[
                Choice {
                    value: "3",
                    label: words("shear, scale, depth and divide", "错切、缩放、深度与透视除法"),
                },
                Choice { value: "2", label: words("shear and scale", "错切与缩放") },
                Choice { value: "1", label: words("shear", "错切") },
                Choice { value: "0", label: words("none: view space", "无：观察坐标系") },
            ],
        ),
        number("left", words("left", "左"), "", [-4.0, 0.0], [0.1, -1.2]),
        number("right", words("right", "右"), "", [0.2, 4.0], [0.1, 2.8]),
        number("bottom", words("bottom", "下"), "", [-4.0, 0.0], [0.05, -1.25]),
        number("top", words("top", "上"), "", [0.2, 4.0], [0.05, 1.25]),
        number("near", words("near plane", "近平面"), "", [1.0, 11.0], [0.1, 4.0]),
        number("far", words("far plane", "远平面"), "", [11.5, 60.0], [0.5, 18.0]),
    ],
    describe: |values| {
        let (window, planes) = (values.scene_numbers(WINDOW), values.scene_numbers(PLANES));
        let camera = CameraFile::look_at([1.0, 3.0, 11.0], [-1.0, 2.2, 0.0]);
        model_scene(HOUSE, camera.with_projection(ProjectionFile::frustum(window, planes)?))
    },
    consequences: |values, _| {
        let [left, right, bottom, top, near] =
            ["left", "right", "bottom", "top", "near"].map(|key| values.number(key));
        // x' = x + z (l + r) / 2N, then 2N / (r − l)
        let shear = [left + right, bottom + top].map(|sum| decimals(sum / (2.0 * near), 4));
        let scale = [right - left, top - bottom].map(|side| decimals(2.0 * near / side, 4));
        vec![sentence(
            format!(
                "Shear: x + {} z, y + {} z. Scale: {} x, {} y.",
                shear[0], shear[1], scale[0], scale[1]
            ),
            format!(
                "错切：x + {} z，y + {} z。缩放：{} x，{} y。",
                shear[0], shear[1], scale[0], scale[1]
            ),
        )]
    },
    volume: |values| match values.choice("step") {
        "0" => VolumeStage::Factors(0),
        "1" => VolumeStage::Factors(1),
        "2" => VolumeStage::Factors(2),
        _ => VolumeStage::Divided,
    },
    ..USUAL
};

/// WV-1, WV-2: a window stretched to the viewport, or shown at a single scale between bars.
pub(super) static WINDOW_VIEWPORT: Lesson = Lesson {
    id: "window-viewport",
    items: &["C95", "C96"],
    title: words("Window to viewport", "窗口到视口的变换"),
    statement: words(
        "The window in the world is moved to the origin, scaled by sx and sy, and moved to the viewport: T · S · T. With sx = sy, shapes are preserved, but a viewport with a different aspect ratio has bars (letterbox).",
        "世界窗口先平移到原点，再按 sx、sy 缩放，然后平移到视口：T · S · T。sx = sy 时形状不变；视口形状不同时会留边（letterbox）。",
    ),
    parameters: &[
        choice(
            "fit",
            words("fit", "适配方式"),
            &[
                Choice {
                    value: "letterbox",
                    label: words("letterbox: one scale", "留边：同一比例"),
                },
                Choice {
                    value: "stretch", label: words("stretch: two scales", "拉伸：两个比例")
                },
            ],
        ),
        number("window_width", words("window width", "窗口宽"), "", [4.0, 16.0], [0.1, 10.0]),
        number("window_height", words("window height", "窗口高"), "", [4.0, 12.0], [0.1, 6.0]),
        number("width", words("viewport width", "视口宽"), "%", [20.0, 100.0], [1.0, 50.0]),
        number("height", words("viewport height", "视口高"), "%", [20.0, 100.0], [1.0, 90.0]),
    ],
    describe: |values| {
        let [width, height] = ["window_width", "window_height"].map(|key| 0.5 * values.number(key));
        let [w, h] = [width, height].map(scene_number);
        let projection = ProjectionFile::orthographic([-w, w, -h, h], [2.0, 20.0])?;
        let size = values.size.map(f64::from);
        let at = |[width, height]: [f64; 2]| {
            let [width, height] = [width / size[0], height / size[1]];
            [0.5 - 0.5 * width, 0.5 - 0.5 * height, width, height].map(scene_number)
        };
        let background = Some(BackgroundFile::Color(Color([0x1a, 0x1f, 0x26])));
        let bars = ViewportFile { background, ..ViewportFile::at(at(viewport(values)))? };
        around_viewports(vec![bars, framed_viewport(at(shown_pixels(values)), projection)?])
    },
    remark: AROUND_VIEWPORTS,
    first_view: 1,
    consequences: |values, _| {
        let pixels = shown_pixels(values);
        let [sx, sy] = [(pixels[0], "window_width"), (pixels[1], "window_height")]
            .map(|(pixels, key)| decimals(pixels / values.number(key), 2));
        vec![match sx == sy {
            true => sentence(
                format!("sx = sy = {sx} pixels per unit: shapes are preserved."),
                format!("sx = sy = {sx} 像素/单位：形状不变。"),
            ),
            false => sentence(
                format!("sx = {sx} and sy = {sy} pixels per unit: shapes are distorted."),
                format!("sx = {sx}，sy = {sy} 像素/单位：形状改变。"),
            ),
        }]
    },
    ..USUAL
};

/// Returns the width and height of the viewport in pixels.
fn viewport(values: &Values<'_>) -> [f64; 2] {
    let [width, height] = values.size.map(f64::from);
    [0.01 * values.number("width") * width, 0.01 * values.number("height") * height]
}

/// Returns the width and height in pixels of the window's image: the viewport, or the largest
/// rectangle in it with the window's shape.
fn shown_pixels(values: &Values<'_>) -> [f64; 2] {
    let viewport = viewport(values);
    if values.choice("fit") == "stretch" {
        return viewport;
    }
    let window = ["window_width", "window_height"].map(|key| values.number(key));
    let scale = (viewport[0] / window[0]).min(viewport[1] / window[1]);
    window.map(|side| scale * side)
}

/// C98: a height field from grid indices.
pub(super) static MEXICAN_HAT: Lesson = Lesson {
    id: "mexican-hat",
    items: &["C98"],
    title: words("Mexican hat", "墨西哥帽"),
    statement: words(
        "The indices of a grid are also a window: i from 0 to n − 1 maps to x = 2 i/(n − 1) − 1, which runs from −1 to 1. The grid points, raised to their heights, form a mesh.",
        "网格的下标也构成一个窗口：i 从 0 到 n − 1 映为 x = 2 i/(n − 1) − 1，从 −1 到 1；每个点上的高度构成网格曲面。",
    ),
    models: &[HAT, HAT_LINES],
    parameters: &[
        choice(
            "mesh",
            words("mesh", "网格"),
            &[
                Choice { value: "surface", label: words("surface", "曲面") },
                Choice {
                    value: "wireframe",
                    label: words("edges of all triangles", "所有三角形的边"),
                },
                Choice { value: "polylines", label: words("polylines", "折线") },
            ],
        ),
        number("azimuth", words("azimuth", "方位角"), "°", [-180.0, 180.0], [1.0, 30.0]),
        number("elevation", words("elevation", "仰角"), "°", [0.0, 85.0], [1.0, 35.0]),
        number(
            "fov",
            words("vertical field of view", "垂直视场角"),
            "°",
            [10.0, 90.0],
            [1.0, 28.0],
        ),
    ],
    panes: ALL_PANES,
    pin: [0.0, 0.9, 0.0],
    describe: |values| {
        let [fov] = values.scene_numbers(["fov"]);
        let (model, style) = match values.choice("mesh") {
            "polylines" => (HAT_LINES, StyleFile::Shaded),
            "wireframe" => (HAT, StyleFile::Wireframe),
            _ => (HAT, StyleFile::Shaded),
        };
        let from = ["azimuth", "elevation"].map(|key| values.number(key));
        let camera = framed(ProjectionFile::perspective(fov, None)?, 6.0, Some(from))?;
        Ok(SceneFile { style, ..model_scene(model, camera)? })
    },
    consequences: |_, _| {
        vec![sentence(
            "The grid has 49 × 49 points: i = 0, 24 and 48 map to x = −1, 0 and 1. Each of the 48 × 48 squares is split into two triangles, 4608 in total.",
            "网格有 49 × 49 个点：i = 0、24、48 映为 x = −1、0、1；48 × 48 个方格各分成两个三角形，共 4608 个。",
        )]
    },
    ..USUAL
};

const HAT: &str = "models/mexican_hat.glb";
const HAT_LINES: &str = "models/mexican_hat_lines.glb";
