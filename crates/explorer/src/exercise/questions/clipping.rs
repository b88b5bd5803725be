//! Exercises on clipping: 18 and 19.

use crate::exercise::answer_text::AnswerShape;
use crate::exercise::entries::Multiples;
use crate::exercise::mistake::{Wrong, mistake};
use crate::exercise::{Exercise, NUMBERS};
use crate::words::words;
use clip::{Volume, clip_segment};
use homog::HPoint;

pub(super) static CLIPPED_SEGMENT: Exercise = Exercise {
    number: 18,
    title: words("Clipping a segment", "裁剪线段"),
    question: words(
        "In clip space, a segment goes from a = (−3, 0, 0, 1) to b = (5, 1, 0, 3); its points are a + t (b − a). The volume is −w ≤ x, y, z ≤ w. Find the values t0 and t1 between which the segment is inside the volume.",
        "裁剪空间中的线段从 a = (−3, 0, 0, 1) 到 b = (5, 1, 0, 3)，写成 a + t (b − a)。视见体为 −w ≤ x, y, z ≤ w。线段从哪个 t0 到哪个 t1 在其内部？",
    ),
    hints: &[
        words(
            "Only two planes clip the segment: w + x = 0 on the left and w − x = 0 on the right.",
            "只有两个平面切到它：左侧 w + x ≥ 0，右侧 w − x ≥ 0。",
        ),
        words(
            "w + x is −2 at a and 8 at b; it is 0 at t = 2/(2 + 8).",
            "w + x 在 a 处为 −2，在 b 处为 8；在 t = 2/(2 + 8) 处为 0。",
        ),
    ],
    letters: &[],
    mistakes: &[
        mistake(
            "m28-cube",
            Wrong::Answer("1/4, 1/2"),
            "the segment was clipped against x = ±1: in clip space, the volume is −w ≤ x ≤ w",
            "按 x = ±1 裁剪了：裁剪空间中视见体是 −w ≤ x ≤ w",
        ),
        mistake(
            "divided-too-early",
            Wrong::Answer("3/7, 6/7"),
            "the points were divided too early: these are fractions of the image on the screen, not of the segment in clip space",
            "过早做了除法：这是屏幕上像的比例，不是裁剪空间中线段的比例",
        ),
        mistake(
            "ends-exchanged",
            Wrong::Answer("2/3, 1/5"),
            "t0 and t1 are swapped: t0 is where the segment enters the volume",
            "t0 与 t1 互换了：线段先进入",
        ),
        mistake(
            "from-the-other-end",
            Wrong::Answer("1/3, 4/5"),
            "t was counted from b, but it is 0 at a",
            "从 b 算起了：a 处 t 为 0",
        ),
        mistake(
            "one-end-divided-too-early",
            Wrong::AnyOf(&["3/5, 6/7", "1/5, 6/7"]),
            "t1 was computed after the divide: 6/7 is a fraction of the image on the screen, not of the segment in clip space",
            "t1 过早做了除法：6/7 是屏幕上像的比例，不是裁剪空间中线段的比例",
        ),
        mistake(
            "left-plane-forgotten",
            Wrong::Answer("0, 2/3"),
            "the left plane is ignored: w + x is negative at a",
            "忘了左平面：w + x 在 a 处为负",
        ),
        mistake(
            "not-clipped",
            Wrong::Answer("0, 1"),
            "this is the whole segment: a is outside on the left and b on the right",
            "这是整条线段：a 在左侧之外，b 在右侧之外",
        ),
    ],
    shape: AnswerShape::Parts(&[&["t0", "t1"]]),
    multiples: Multiples::None,
    samples: NUMBERS,
    answer: |_| {
        let ends = [HPoint::new(-3.0, 0.0, 0.0, 1.0), HPoint::new(5.0, 1.0, 0.0, 3.0)];
        let inside = clip_segment(ends[0], ends[1], &Volume::OPENGL)?;
        Some(vec![vec![inside.t0, inside.t1]])
    },
};

pub(super) static OUTCODE: Exercise = Exercise {
    number: 19,
    title: words("An outcode", "区域码"),
    question: words(
        "An outcode has one bit per plane, which is set if the point is outside that plane: left 1, right 2, bottom 4, top 8, near 16 and far 32. The volume is −w ≤ x, y, z ≤ w with the near plane at z = −w. What is the outcode of the clip-space point (3, −3/2, −4, 2), as a number?",
        "点每越出一个平面，区域码中就有一位置位：左 1、右 2、下 4、上 8、近 16、远 32；视见体为 −w ≤ x, y, z ≤ w，近平面在 z = −w。裁剪空间的点 (3, −3/2, −4, 2) 的区域码是哪个数？",
    ),
    hints: &[
        words(
            "Compare x, y and z with −w = −2 and w = 2.",
            "把 x、y、z 与 −w = −2 和 w = 2 比较。",
        ),
        words(
            "Add the bits of all planes that the point is outside of.",
            "把它越出的所有平面的位相加。",
        ),
    ],
    letters: &[],
    mistakes: &[
        mistake(
            "m28-cube",
            Wrong::Answer("2+4+16"),
            "the point was compared with ±1: in clip space, the limits are −w and w, and y = −3/2 is greater than −2",
            "与 ±1 比较了：裁剪空间的边界是 −w 和 w，y = −3/2 大于 −2",
        ),
        mistake(
            "sides-exchanged",
            Wrong::Answer("1+32"),
            "left and right are swapped, and so are near and far: x = 3 is beyond w = 2, on the right",
            "左右、远近互换了：x = 3 超过 w = 2，在右侧之外",
        ),
        mistake(
            "inside-bits",
            Wrong::Answer("1+4+8+32"),
            "these are the planes that the point is inside of, but a set bit means outside",
            "这些是点在其内侧的平面：区域码的位表示外侧",
        ),
        mistake(
            "one-plane-only",
            Wrong::Answer("2"),
            "it is also outside a second plane: z = −4 is in front of the near plane",
            "它还越出了第二个平面：z = −4 在近平面之前",
        ),
        mistake(
            "one-plane-only",
            Wrong::Answer("16"),
            "it is also outside a second plane: x = 3 is beyond the right plane",
            "它还越出了第二个平面：x = 3 在右平面之外",
        ),
        mistake(
            "binary-digits",
            Wrong::Answer("10010"),
            "the bits are correct but written in binary: enter their sum",
            "各位正确，但写成了二进制：请给出它们的和",
        ),
        mistake(
            "bits-from-one",
            Wrong::Answer("36"),
            "the bits are shifted by one position: left is 1, which is 2 to the power of 0",
            "各位错开了一位：左是 1，即 2 的零次幂",
        ),
        mistake(
            "near-and-far-exchanged",
            Wrong::Answer("2+32"),
            "near and far are swapped, as in the textbook, where the near plane is at z = w: here it is at z = −w",
            "近平面与远平面互换了，如教科书那样近平面在 z = w：这里近平面在 z = −w",
        ),
        mistake(
            "inside",
            Wrong::Answer("0"),
            "0 means that the point is inside: compare 3 and −4 with w = 2",
            "0 表示点在内部：请把 3 和 −4 与 w = 2 比较",
        ),
    ],
    shape: AnswerShape::Parts(&[&["outcode"]]),
    multiples: Multiples::None,
    samples: NUMBERS,
    answer: |_| {
        let outcode = Volume::OPENGL.outcode(HPoint::new(3.0, -1.5, -4.0, 2.0));
        Some(vec![vec![outcode.bits().into()]])
    },
};
