//! The exercise on oblique projection: 14.

use crate::exercise::answer_text::AnswerShape;
use crate::exercise::entries::{Entries, Multiples};
use crate::exercise::mistake::{Wrong, mistake};
use crate::exercise::{Exercise, NUMBERS};
use crate::words::words;
use homog::Point;
use projection::Oblique;

/// Returns the image of (1, 1, z), of which only x and y are used.
fn image(oblique: Oblique, z: f64) -> Entries {
    let image = oblique.onto_plane().transform_point(Point::new(1.0, 1.0, z));
    vec![vec![image.x(), image.y()]]
}

pub(super) static CABINET: Exercise = Exercise {
    number: 14,
    title: words("Cabinet projection", "斜二测投影"),
    question: words(
        "An oblique projection onto z = 0 takes (x, y, z) to (x + z L cos φ, y + z L sin φ). For a cabinet projection with φ = 30°, find the image (x, y) of (1, 1, 4).",
        "向 z = 0 的斜投影把 (x, y, z) 映为 (x + z L cos φ, y + z L sin φ)。对 φ = 30° 的斜二测投影，求 (1, 1, 4) 的像 (x, y)。",
    ),
    hints: &[
        words(
            "In a cabinet projection, depths are drawn at half their length.",
            "斜二测投影中，深度方向按一半长度画出。",
        ),
        words(
            "L = 1/2, cos 30° = √3/2, sin 30° = 1/2. Enter angles as `30°` or in radians.",
            "L = 1/2，cos 30° = √3/2，sin 30° = 1/2。角度写成 `30°`，或用弧度。",
        ),
    ],
    letters: &[],
    mistakes: &[
        mistake(
            "cavalier",
            Wrong::Computed(|_| Some(image(Oblique::cavalier(30_f64.to_radians()).ok()?, 4.0))),
            "this is the cavalier projection, with L = 1, but a cabinet projection has L = 1/2",
            "这是斜等测投影，L = 1：斜二测按一半长度画深度",
        ),
        mistake(
            "tangent-for-factor",
            Wrong::Answer("1+4*2*cos(30°), 1+4*2*sin(30°)"),
            "L is 1/2, not 2: the projectors meet the plane at an angle α with tan α = 2, and L = cot α",
            "L 是 1/2 而不是 2：投影线与平面的夹角 α 满足 tan α = 2，而 L = cot α",
        ),
        mistake(
            "sign-of-z",
            Wrong::Computed(|_| Some(image(Oblique::cabinet(30_f64.to_radians()).ok()?, -4.0))),
            "the sign of z is wrong: z = 4 moves the image to the right and up",
            "z 的符号不对：z = 4 使像向右上方移动",
        ),
        mistake(
            "sine-and-cosine-exchanged",
            Wrong::Answer("1+4*sin(30°)/2, 1+4*cos(30°)/2"),
            "sine and cosine are swapped: x needs the cosine, and y the sine",
            "正弦与余弦互换了：x 用余弦",
        ),
        mistake(
            "degrees-as-radians",
            Wrong::Computed(|_| Some(image(Oblique::cabinet(30.0).ok()?, 4.0))),
            "degrees were used as radians: write `30°` or `pi/6`",
            "把角度当成了弧度：请写 `30°` 或 pi/6",
        ),
        mistake(
            "depth-dropped",
            Wrong::Answer("1, 1"),
            "z was ignored: this is the orthographic image, not the oblique image",
            "z 被丢掉了：这是正交投影的像，即斜投影的垂足",
        ),
        mistake(
            "foot-forgotten",
            Wrong::Answer("sqrt(3), 1"),
            "the x and y of the point are missing: add (1, 1)",
            "忘了点自身的 x 和 y：要加上 (1, 1)",
        ),
    ],
    shape: AnswerShape::Parts(&[&["x", "y"]]),
    multiples: Multiples::None,
    samples: NUMBERS,
    answer: |_| Some(image(Oblique::cabinet(30_f64.to_radians()).ok()?, 4.0)),
};
