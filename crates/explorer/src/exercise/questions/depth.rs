//! Exercises on depth: 16 and 17.

use crate::exercise::answer_text::AnswerShape;
use crate::exercise::entries::{Entries, Multiples};
use crate::exercise::mistake::{Wrong, mistake};
use crate::exercise::{Exercise, NUMBERS};
use crate::words::words;
use projection::{Convention, DepthCurve};

pub(super) static DEPTH_ZERO: Exercise = Exercise {
    number: 16,
    title: words("Where depth is 0", "深度为 0 处"),
    question: words(
        "A perspective projection in OpenGL has its near plane at distance N = 2 and its far plane at distance F = 40. The depths z_ndc of these planes are −1 and +1. At what distance D from the eye is z_ndc = 0?",
        "OpenGL 的透视投影，近平面距离 N = 2，远平面距离 F = 40；它们的深度 z_ndc 为 −1 和 +1。到视点的距离 D 为多少时 z_ndc = 0？",
    ),
    hints: &[
        words(
            "z_ndc = a + b/D: find a and b from the two planes.",
            "z_ndc = a + b/D：由两个平面求 a 和 b。",
        ),
        words(
            "z_ndc = (F + N)/(F − N) − 2FN/((F − N) D).",
            "z_ndc = (F + N)/(F − N) − 2FN/((F − N) D)。",
        ),
    ],
    letters: &[],
    mistakes: &[
        mistake(
            "sign-of-z",
            Wrong::Negated,
            "this has the sign of a z-coordinate, but a distance is positive",
            "这是 z 坐标的符号：距离应为正",
        ),
        mistake(
            "printed-rounding",
            Wrong::Answer("3.8"),
            "this is the lesson's rounded value: at 3.8 the depth is −1/361",
            "这是教程中舍入的值：在 3.8 处深度是 −1/361",
        ),
        mistake(
            "printed-rounding",
            Wrong::Answer("-3.8"),
            "this is the lesson's rounded z-coordinate: the distance must be positive, and at 3.8 the depth is −1/361",
            "这是教程中舍入的 z 坐标：在 3.8 处深度是 −1/361，而距离应为正",
        ),
        mistake(
            "middle",
            Wrong::Answer("(2+40)/2"),
            "this is the midpoint between the planes, but depth is not linear in the distance",
            "这是两平面之间的中点：深度与距离不成线性关系",
        ),
        mistake(
            "factor-two-lost",
            Wrong::Answer("40*2/(40+2)"),
            "the factor 2 is missing: D = 2FN/(F + N)",
            "丢了因子 2：D = 2FN/(F + N)",
        ),
        mistake(
            "geometric-mean",
            Wrong::Answer("sqrt(80)"),
            "this is the geometric mean, but depth 0 is at the harmonic mean of the distances",
            "这是几何平均；深度 0 在两平面距离的调和平均处",
        ),
    ],
    shape: AnswerShape::Parts(&[&["D"]]),
    multiples: Multiples::None,
    samples: NUMBERS,
    answer: |_| {
        let curve = DepthCurve::perspective(2.0, 40.0, Convention::OPENGL).ok()?;
        Some(vec![vec![curve.distance(0.0)?]])
    },
};

/// Returns the depth at distance 5/2 between planes at 1 and 5.
fn depth(convention: Convention, is_perspective: bool) -> Option<Entries> {
    let curve = if is_perspective { DepthCurve::perspective } else { DepthCurve::parallel };
    Some(vec![vec![curve(1.0, 5.0, convention).ok()?.depth(2.5)?]])
}

pub(super) static REVERSED_DEPTH: Exercise = Exercise {
    number: 17,
    title: words("Reversed depth", "反向深度"),
    question: words(
        "A perspective projection with reversed depth has depth 1 at its near plane, N = 1, and depth 0 at its far plane, F = 5. What is the depth at distance 5/2?",
        "采用反向深度的透视投影，在近平面 N = 1 处深度为 1，在远平面 F = 5 处深度为 0。距离 5/2 处的深度是多少？",
    ),
    hints: &[
        words(
            "Depth is a + b/D after the divide: find a and b from the two planes.",
            "除法之后深度为 a + b/D：由两个平面求 a 和 b。",
        ),
        words("d = N (F − D)/(D (F − N)).", "d = N (F − D)/(D (F − N))。"),
    ],
    letters: &[],
    mistakes: &[
        mistake(
            "not-reversed",
            Wrong::Computed(|_| depth(Convention::WEBGPU, true)),
            "near and far are swapped: this depth runs from 0 at the near plane to 1 at the far plane",
            "近平面与远平面互换了：这是近平面为 0、远平面为 1 的深度",
        ),
        mistake(
            "linear",
            Wrong::Computed(|_| depth(Convention::WEBGPU.reversed(), false)),
            "this is linear in the distance, as in a parallel projection, but a perspective projection divides by D",
            "这与距离成线性关系，如同平行投影：透视投影要除以 D",
        ),
        mistake(
            "linear-and-not-reversed",
            Wrong::Computed(|_| depth(Convention::WEBGPU, false)),
            "this depth is linear and starts at 0, but a perspective projection divides by D, and reversed depth starts at 1",
            "这是线性的，而且近平面为 0：透视投影要除以 D，反向深度在近平面为 1",
        ),
        mistake(
            "infinite-far-plane",
            Wrong::Answer("1/(5/2)"),
            "this is N/D, the depth with an infinite far plane: at F = 5 the depth must be 0",
            "这是 N/D，即远平面在无穷远时的深度：F = 5 处深度应为 0",
        ),
        mistake(
            "opengl-range",
            Wrong::Computed(|_| depth(Convention::OPENGL, true)),
            "this is OpenGL depth, from −1 to 1: here it runs from 1 to 0",
            "这是 OpenGL 的深度，范围 −1 到 1",
        ),
    ],
    shape: AnswerShape::Parts(&[&["d"]]),
    multiples: Multiples::None,
    samples: NUMBERS,
    answer: |_| depth(Convention::WEBGPU.reversed(), true),
};
