//! Lessons from the slides on vanishing points: one-, two- and three-point perspective.

use crate::lesson::{Lesson, Source, Values, number};
use crate::lesson_scene::{LessonScene, line_drawing};
use crate::number_text::scene_number;
use crate::words::{Sentence, sentence, words};
use scene_file::SceneFile;
use scene_file::file::{Finite, InvalidNumber, OverlayFile, ProjectionFile};

/// The settings that these lessons share.
const USUAL: Lesson = Lesson { source: Source::Slides, ..Lesson::USUAL };

/// Returns a construction: the house as a line drawing with the horizon and vanishing points.
fn construction(projection: ProjectionFile) -> LessonScene {
    let overlays = vec![OverlayFile::Horizon, OverlayFile::VanishingPoints];
    Ok(SceneFile { overlays, ..line_drawing(projection, 16.0)? })
}

/// Describes the bottom row of the matrix in the terms of the slides.
fn bottom_row(row: &str, which: [&str; 2]) -> Vec<Sentence> {
    vec![sentence(
        format!("The bottom row of the matrix is {row}: {}.", which[0]),
        format!("矩阵的最后一行是 {row}：{}。", which[1]),
    )]
}

fn point(values: &Values<'_>, keys: [&str; 2]) -> Result<(Finite, Finite), InvalidNumber> {
    let [x, y] = values.scene_numbers(keys);
    Ok((x.try_into()?, y.try_into()?))
}

/// ONE-1: the front is parallel to the picture.
pub(super) static ONE_POINT: Lesson = Lesson {
    id: "one-point",
    items: &["C80", "C82"],
    title: words("One-point perspective", "一点透视"),
    statement: words(
        "The front is parallel to the picture plane, so it keeps its shape, and all receding lines meet at one vanishing point. Moving the eye closer exaggerates depth.",
        "正面平行于画面：形状不变，所有深度方向的直线交于一个灭点。视点越近，透视越强烈。",
    ),
    parameters: &[
        number("x", words("vanishing point, x", "灭点 x"), "", [-0.9, 0.9], [0.01, 0.5]),
        number("y", words("vanishing point, y", "灭点 y"), "", [-0.9, 0.9], [0.01, 0.45]),
        number("distance", words("eye distance", "视距"), "", [1.2, 8.0], [0.1, 2.2]),
    ],
    describe: |values| {
        let [distance] = values.scene_numbers(["distance"]);
        let (at, distance) = (point(values, ["x", "y"])?, distance.try_into()?);
        construction(ProjectionFile::OnePoint { at, distance })
    },
    consequences: |values, _| {
        let distance = scene_number(values.number("distance"));
        bottom_row(
            "(0, 0, r, 1)",
            [
                &format!(
                    "only lines along z meet, at ({}, {}) half heights from the center; the eye is {distance} half heights in front of the picture",
                    scene_number(values.number("x")),
                    scene_number(values.number("y"))
                ),
                &format!(
                    "只有 z 方向的直线相交，灭点距图像中心 ({}, {}) 个半高；视点在画面前 {distance} 个半高处",
                    scene_number(values.number("x")),
                    scene_number(values.number("y"))
                ),
            ],
        )
    },
    ..USUAL
};

/// TWO-1: verticals stay vertical.
pub(super) static TWO_POINT: Lesson = Lesson {
    id: "two-point",
    items: &["C80", "C83"],
    title: words("Two-point perspective", "两点透视"),
    statement: words(
        "Vertical lines are parallel to the picture and stay vertical, while lines along x and along z meet at two vanishing points on the horizon. If the points are close together, the picture looks like a wide-angle shot.",
        "竖直线平行于画面，保持竖直；x 方向和 z 方向的直线分别交于视平线上的两个灭点。两灭点靠得越近，越像广角镜头。",
    ),
    parameters: &[
        number("x", words("vanishing point along x", "x 方向灭点"), "", [-6.0, -1.2], [0.05, -2.4]),
        number("z", words("vanishing point along z", "z 方向灭点"), "", [1.2, 6.0], [0.05, 1.8]),
        number("horizon", words("horizon height", "视平线高度"), "", [-0.9, 0.9], [0.01, 0.4]),
        number(
            "fraction",
            words("eye position between the points", "视点在两灭点之间的位置"),
            "",
            [0.3, 0.7],
            [0.01, 0.5],
        ),
    ],
    describe: |values| {
        let (x, z) = (point(values, ["x", "horizon"])?, point(values, ["z", "horizon"])?);
        let [fraction] = values.scene_numbers(["fraction"]);
        construction(ProjectionFile::TwoPoint { x, z, fraction: fraction.try_into()? })
    },
    consequences: |values, _| {
        let apart = scene_number(values.number("z") - values.number("x"));
        bottom_row(
            "(p, 0, r, 1)",
            [
                &format!(
                    "lines along x and z meet, and vertical lines do not; the vanishing points are {apart} half heights apart"
                ),
                &format!("x 和 z 方向的直线相交，竖直线不相交；两灭点相距 {apart} 个半高"),
            ],
        )
    },
    ..USUAL
};

/// THREE-1: no axis is parallel to the picture.
pub(super) static THREE_POINT: Lesson = Lesson {
    id: "three-point",
    items: &["C80", "C83"],
    title: words("Three-point perspective", "三点透视"),
    statement: words(
        "No axis is parallel to the picture, so vertical lines also meet, far below if you look down. The eye is over the orthocenter of the triangle of the three vanishing points.",
        "没有坐标轴平行于画面：竖直线也相交，俯视时灭点在下方远处。视点位于三个灭点所成三角形垂心的正前方。",
    ),
    parameters: &[
        number("x", words("vanishing point along x", "x 方向灭点"), "", [-5.0, -2.4], [0.05, -3.2]),
        number("z", words("vanishing point along z", "z 方向灭点"), "", [1.8, 4.0], [0.05, 2.4]),
        number("horizon", words("horizon height", "视平线高度"), "", [0.6, 1.8], [0.02, 1.2]),
        number(
            "y",
            words("vanishing point of vertical lines", "竖直方向灭点"),
            "",
            [-9.0, -3.5],
            [0.1, -5.0],
        ),
    ],
    describe: |values| {
        let (x, z) = (point(values, ["x", "horizon"])?, point(values, ["z", "horizon"])?);
        let [y] = values.scene_numbers(["y"]);
        let y = (0.1.try_into()?, y.try_into()?);
        construction(ProjectionFile::ThreePoint { x, y, z })
    },
    consequences: |values, _| {
        let y = scene_number(values.number("y"));
        bottom_row(
            "(p, q, r, 1)",
            [
                &format!(
                    "all three axes have a vanishing point; vertical lines meet at height {y}"
                ),
                &format!("三个坐标轴都有灭点；竖直线交于高度 {y} 处"),
            ],
        )
    },
    ..USUAL
};
