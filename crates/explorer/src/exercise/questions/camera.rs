//! Exercises on the camera: 10 and 13.

use crate::exercise::answer_text::AnswerShape;
use crate::exercise::entries::{Multiples, rows_of};
use crate::exercise::mistake::{TRANSPOSED, Wrong, mistake};
use crate::exercise::{Exercise, NUMBERS};
use crate::words::words;
use camera::Camera;
use homog::{Point, Vector};

fn camera_above() -> Option<Camera> {
    let (eye, gaze) = (Point::new(0.0, 1.0, 0.0), Vector::new(0.0, -1.0, 0.0));
    Camera::look_to(eye, gaze, Vector::new(1.0, 1.0, 0.0)).ok()
}

pub(super) static CAMERA_ABOVE: Exercise = Exercise {
    number: 10,
    title: words("A camera above", "俯视的相机"),
    question: words(
        "The eye is at e = (0, 1, 0), the gaze is g = (0, −1, 0), and the view-up vector is t = (1, 1, 0). With w = −g/‖g‖, u = (t × w)/‖t × w‖ and v = w × u, write the matrix M_cam from world to camera coordinates.",
        "视点 e = (0, 1, 0)，视线方向 g = (0, −1, 0)，观察向上向量 t = (1, 1, 0)。取 w = −g/‖g‖，u = (t × w)/‖t × w‖，v = w × u，写出从世界坐标到观察坐标的矩阵 M_cam。",
    ),
    hints: &[
        words(
            "Find w, then t × w, and divide it by its length to obtain the unit vector u.",
            "先求 w，再求 t × w；它在除以长度之前不必是单位向量。",
        ),
        words(
            "The first three rows of M_cam begin with u, v and w, and end with −u·e, −v·e and −w·e.",
            "M_cam 的前三行以 u、v、w 开头，以 −u·e、−v·e、−w·e 结尾。",
        ),
    ],
    letters: &[],
    mistakes: &[
        mistake(
            "gaze-for-w",
            Wrong::Answer("0 0 -1 0; 1 0 0 0; 0 -1 0 1; 0 0 0 1"),
            "w points along the gaze, but the camera looks along −w",
            "w 取成了视线方向：相机沿 −w 方向看",
        ),
        mistake(
            "u-turned",
            Wrong::Places(&[(0, 2, "-1")]),
            "u points to the left: it is t × w, not w × t",
            "u 指向了左边：应为 t × w，而不是 w × t",
        ),
        mistake(
            "u-and-v-exchanged",
            Wrong::Answer("1 0 0 0; 0 0 1 0; 0 1 0 -1; 0 0 0 1"),
            "u and v are swapped: u = t × w points to the right and is the first row",
            "u 与 v 互换了：u = t × w 指向右方，是第一行",
        ),
        mistake(
            "up-for-v",
            Wrong::Answer("0 0 1 0; 1/√2 1/√2 0 -1/√2; 0 1 0 -1; 0 0 0 1"),
            "the view-up vector was used as v, but it does not have to be perpendicular to the gaze: v = w × u",
            "把观察向上向量当成了 v：它不必与视线垂直，v = w × u",
        ),
        mistake(
            "eye-forgotten",
            Wrong::Computed(|_| Some(rows_of(camera_above()?.rotation().raw()))),
            "the eye is missing: this is only the rotation",
            "忘了视点：这只是旋转部分",
        ),
        mistake(
            "eye-added",
            Wrong::Places(&[(2, 3, "1")]),
            "the eye was added: M_cam moves it to the origin, so subtract it",
            "加上了视点：M_cam 应把视点映为原点，所以要减去它",
        ),
        mistake(
            "order-exchanged",
            Wrong::Computed(|_| {
                let camera = camera_above()?;
                Some(rows_of(camera.translation().raw() * camera.rotation().raw()))
            }),
            "translation and rotation are swapped: the eye is moved to the origin first, so the translation is on the right",
            "平移与旋转的次序反了：先把视点移到原点，所以平移写在右边",
        ),
        mistake(
            "inverse",
            Wrong::Computed(|_| Some(rows_of(camera_above()?.view_to_world().raw()))),
            "this is the inverse, from camera coordinates to the world",
            "这是从观察坐标回到世界坐标的矩阵，方向反了",
        ),
        mistake(
            "m11-third-row-flat",
            Wrong::Computed(|_| {
                let camera = camera_above()?;
                let mut printed = camera.translation().raw();
                printed.z_axis.z = 0.0;
                Some(rows_of(camera.rotation().raw() * printed))
            }),
            "the third row of the translation lacks its 1, as in the printed notes, so the world's z has no effect",
            "平移矩阵第三行的 1 丢了，与笔记印错的一样：世界坐标的 z 不再起作用",
        ),
        mistake(
            "inverse-rotation",
            Wrong::Computed(|_| Some(rows_of(camera_above()?.rotation().raw().transpose()))),
            "this is the rotation from the camera to the world, without the eye: u, v and w are the rows of M_cam",
            "这是从相机到世界的旋转，而且忘了视点：u、v、w 是 M_cam 的行",
        ),
        mistake(
            "u-and-v-turned",
            Wrong::Places(&[(0, 2, "-1"), (1, 0, "-1")]),
            "u and v are both reversed: u is t × w, not w × t, which also reverses v = w × u",
            "u 和 v 都反了：u 应为 t × w，而不是 w × t，v = w × u 也随之反向",
        ),
        mistake(
            "axes-only",
            Wrong::Answer("0 0 1; 1 0 0; 0 1 0"),
            "these are u, v and w, but the question asks for M_cam, a 4 × 4 matrix whose rows begin with them",
            "这是 u、v、w：题目要的是 M_cam，即各行以它们开头的 4 × 4 矩阵",
        ),
        TRANSPOSED,
    ],
    shape: AnswerShape::Matrix(4, 4),
    multiples: Multiples::None,
    samples: NUMBERS,
    answer: |_| Some(rows_of(camera_above()?.world_to_view().raw())),
};

pub(super) static CAMERA_COORDINATES: Exercise = Exercise {
    number: 13,
    title: words("Camera coordinates", "观察坐标"),
    question: words(
        "The eye is at (2, 0, 0), the gaze is (−1, 0, 0), and the view-up vector is (0, 1, 0). The camera looks along −z in its coordinates, with x to the right and y up. What are the camera coordinates of the world-space point (−1, 2, −4)?",
        "视点在 (2, 0, 0)，视线方向为 (−1, 0, 0)，观察向上向量为 (0, 1, 0)；相机沿自身坐标系的 −z 方向看，x 向右，y 向上。世界坐标系的点 (−1, 2, −4) 的观察坐标是什么？",
    ),
    hints: &[
        words(
            "w = −g = (1, 0, 0), u = t × w, v = w × u.",
            "w = −g = (1, 0, 0)，u = t × w，v = w × u。",
        ),
        words(
            "Subtract the eye first; the coordinates are the dot products with u, v and w.",
            "先减去视点；坐标就是与 u、v、w 的点积。",
        ),
    ],
    letters: &[],
    mistakes: &[
        mistake(
            "sign-of-z",
            Wrong::Places(&[(0, 2, "3")]),
            "the sign of z is wrong: the camera looks along −z, so points in front of it have negative z",
            "z 的符号不对：相机沿 −z 方向看，前方的点 z 为负",
        ),
        mistake(
            "left-handed",
            Wrong::Places(&[(0, 0, "-4")]),
            "x points to the left: u is t × w, not w × t",
            "x 指向了左边：u 是 t × w，而不是 w × t",
        ),
        mistake(
            "eye-forgotten",
            Wrong::Places(&[(0, 2, "-1")]),
            "the eye is missing: subtract it before taking the dot products",
            "忘了视点：求点积之前要先减去它",
        ),
        mistake(
            "eye-added",
            Wrong::Places(&[(0, 2, "1")]),
            "the eye was added instead of subtracted",
            "应减去视点，却加上了它",
        ),
        mistake(
            "not-rotated",
            Wrong::Answer("-3, 2, -4"),
            "this is the point minus the eye in world axes: take the dot products with u, v and w",
            "这只是点减去视点，仍沿世界坐标轴：还要用 u、v、w 旋转",
        ),
        mistake(
            "axes-of-the-world",
            Wrong::Answer("3, 2, -4"),
            "3 is the distance in front of the camera, which belongs in z: x is the dot product with u, and z is the dot product with w",
            "3 是前方的距离，应属于 z：x 是与 u 的点积，z 是与 w 的点积",
        ),
    ],
    shape: AnswerShape::Parts(&[&["x", "y", "z"]]),
    multiples: Multiples::None,
    samples: NUMBERS,
    answer: |_| {
        let (eye, gaze) = (Point::new(2.0, 0.0, 0.0), Vector::new(-1.0, 0.0, 0.0));
        let camera = Camera::look_to(eye, gaze, Vector::new(0.0, 1.0, 0.0)).ok()?;
        let image = camera.world_to_view().transform_point(Point::new(-1.0, 2.0, -4.0));
        Some(vec![vec![image.x(), image.y(), image.z()]])
    },
};
