//! Exercises on segments and their images: 11, 23 and 24.

use crate::exercise::answer_text::AnswerShape;
use crate::exercise::entries::Multiples;
use crate::exercise::mistake::{Wrong, mistake};
use crate::exercise::{Exercise, NUMBERS};
use crate::words::words;
use homog::Foreshortening;

pub(super) static IMAGE_PARAMETER: Exercise = Exercise {
    number: 11,
    title: words("f(t)", "f(t)"),
    question: words(
        "M_per maps the ends of a segment to the homogeneous points r and R, whose w-coordinates w_r and w_R have the same sign. After the divide, the point r + t (R − r) is a fraction f(t) of the way along the image of the segment. Find f(t).",
        "经过 M_per 后，线段两端是齐次点 r（w 为 w_r）和 R（w 为 w_R），两个 w 同号。点 r + t (R − r) 的像位于线段的像的比例 f(t) 处。求 f(t)。",
    ),
    hints: &[
        words(
            "The image is (r + t (R − r))/(w_r + t (w_R − w_r)); compare it with (1 − s) r/w_r + s R/w_R, where s = f(t).",
            "像是 (r + t (R − r))/(w_r + t (w_R − w_r))；把它与 (1 − s) r/w_r + s R/w_R 比较。",
        ),
        words(
            "Compare only the coefficients of R: one of them is s/w_R.",
            "只比较 R 的系数：一边是 s/w_R。",
        ),
    ],
    letters: &["wr", "wR", "t"],
    mistakes: &[
        mistake(
            "linear",
            Wrong::Answer("t"),
            "this is correct only if w is the same at both ends: perspective moves the midpoint",
            "只有两端 w 相同时才对：透视会移动中点",
        ),
        mistake(
            "inverse",
            Wrong::Answer("wr*t/(wR+t*(wr-wR))"),
            "this is the inverse, from the image to the segment: swap w_r and w_R",
            "这是从像回到线段的反函数：两端互换了",
        ),
        mistake(
            "other-weight",
            Wrong::Answer("wr*t/(wr+t*(wR-wr))"),
            "the numerator has w_r instead of w_R: f(1) must be 1",
            "分子上应为 w_R 而不是 w_r：f(1) 应等于 1",
        ),
        mistake(
            "weight-alone",
            Wrong::Answer("wr+t*(wR-wr)"),
            "this is w at t, which is only the divisor",
            "这是 t 处的 w：它只是分母",
        ),
        mistake(
            "weight-forgotten",
            Wrong::Answer("t/(wr+t*(wR-wr))"),
            "the factor w_R is missing: f(1) must be 1",
            "忘了因子 w_R：f(1) 应等于 1",
        ),
        mistake(
            "from-the-other-end",
            Wrong::Answer("wr*(1-t)/(wr+t*(wR-wr))"),
            "this is 1 − f(t), the fraction measured from R",
            "这是 1 − f(t)，即从 R 算起的比例",
        ),
        mistake(
            "divisor-from-the-other-end",
            Wrong::Answer("wR*t/(wR+t*(wr-wR))"),
            "the divisor is counted from R: w at t is w_r + t (w_R − w_r)",
            "分母是从 R 算起的 w：在 t 处应为 w_r + t (w_R − w_r)",
        ),
        mistake(
            "difference-of-weights",
            Wrong::Answer("t*(wR-wr)/(wr+t*(wR-wr))"),
            "the numerator has w_R − w_r instead of a single w: f(1) must be 1",
            "分子上写成了 w_R − w_r，应只是一端的 w：f(1) 应等于 1",
        ),
    ],
    shape: AnswerShape::Parts(&[&["f"]]),
    multiples: Multiples::None,
    samples: &[&[1.0, 3.0, 0.4], &[2.7, 0.4, 0.3], &[-1.5, -2.5, 0.8]],
    answer: |letters| {
        let [start, end, t] = letters.try_into().ok()?;
        Some(vec![vec![Foreshortening::new(start, end).ok()?.image_parameter(t)?]])
    },
};

pub(super) static ATTRIBUTE: Exercise = Exercise {
    number: 23,
    title: words("A perspective-correct attribute", "透视校正的属性"),
    question: words(
        "An edge has the attribute a = 2 at its first end, where w = 1, and a = 10 at its second end, where w = 4. In the image of the edge, what is the attribute one quarter of the way from the first end to the second?",
        "一条边的一端属性 a = 2、w = 1，另一端 a = 10、w = 4。从第一端算起，在边的像的四分之一处，属性是多少？",
    ),
    hints: &[
        words(
            "a/w and 1/w are linear on the screen; a is not.",
            "a/w 和 1/w 在屏幕上是线性的；a 不是。",
        ),
        words(
            "Interpolate a/w and 1/w at s = 1/4, then divide the first by the second.",
            "在 s = 1/4 处对 a/w 和 1/w 插值，再用前者除以后者。",
        ),
    ],
    letters: &[],
    mistakes: &[
        mistake(
            "linear",
            Wrong::Answer("3/4*2+1/4*10"),
            "a was interpolated on the screen, but it is linear only in space",
            "直接在屏幕上对 a 作线性插值了：它在空间中是线性的，在屏幕上不是",
        ),
        mistake(
            "weights-by-w",
            Wrong::Answer("(3/4*2*1+1/4*10*4)/(3/4*1+1/4*4)"),
            "the ends are weighted by w instead of 1/w: the far end must have less weight, not more",
            "权重用了 w 而不是 1/w：远端的权重应更小，而不是更大",
        ),
        mistake(
            "not-divided",
            Wrong::Answer("3/4*2/1+1/4*10/4"),
            "this is a/w: divide it by the interpolated 1/w",
            "这是 a/w：还要除以插值得到的 1/w",
        ),
        mistake(
            "from-the-other-end",
            Wrong::Answer("(1/4*2/1+3/4*10/4)/(1/4/1+3/4/4)"),
            "this is measured from the other end: the weight of the first end is 3/4",
            "从另一端算起了：第一端的权重是 3/4",
        ),
    ],
    shape: AnswerShape::Parts(&[&["a"]]),
    multiples: Multiples::None,
    samples: NUMBERS,
    answer: |_| {
        let edge = Foreshortening::new(1.0, 4.0).ok()?;
        Some(vec![vec![edge.interpolate_attribute(0.25, 2.0, 10.0)?]])
    },
};

pub(super) static MIDDLE_OF_THE_IMAGE: Exercise = Exercise {
    number: 24,
    title: words("The middle of the image", "像的中点"),
    question: words(
        "A segment has w = 1 at its first end and w = 4 at its second end. At what fraction t of the way from the first end is the point that appears in the middle of the segment's image?",
        "线段第一端 w = 1，第二端 w = 4。它的哪一点（用从第一端算起的比例 t 表示）出现在像的中点？",
    ),
    hints: &[
        words(
            "f(t) = w_R t/(w_r + t (w_R − w_r)) maps the segment to its image. Here f(t) = 1/2.",
            "f(t) = w_R t/(w_r + t (w_R − w_r)) 从线段到像。这里已知 f(t) = 1/2。",
        ),
        words(
            "The near half of the segment fills more than half of the image, so t is less than 1/2.",
            "线段近的一半在像上占一半以上：t 小于 1/2。",
        ),
    ],
    letters: &[],
    mistakes: &[
        mistake(
            "linear",
            Wrong::Answer("1/2"),
            "the midpoint of the segment does not appear in the middle, because the near half looks larger",
            "线段的中点并不出现在像的中点：近的一半看起来更大",
        ),
        mistake(
            "forwards",
            Wrong::Answer("4/5"),
            "this is f(1/2), where the midpoint of the segment appears, but the question asks for the inverse",
            "这是 f(1/2)，即线段中点的像的位置；题目问的正好相反",
        ),
        mistake(
            "ratio-of-weights",
            Wrong::Answer("1/4"),
            "this is w_r/w_R: solve f(t) = 1/2, which gives w_r/(w_r + w_R)",
            "这是 w_r/w_R：解 f(t) = 1/2，得 w_r/(w_r + w_R)",
        ),
    ],
    shape: AnswerShape::Parts(&[&["t"]]),
    multiples: Multiples::None,
    samples: NUMBERS,
    answer: |_| Some(vec![vec![Foreshortening::new(1.0, 4.0).ok()?.source_parameter(0.5)?]]),
};
