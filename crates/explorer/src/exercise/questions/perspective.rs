//! Exercises on the matrix P and its effect: 3, 4, 6, 7, 8 and 9.

use crate::exercise::answer_text::AnswerShape;
use crate::exercise::entries::{Multiples, rows_of};
use crate::exercise::mistake::{TRANSPOSED, Wrong, mistake};
use crate::exercise::{Exercise, NUMBERS};
use crate::words::words;
use homog::{HPoint, Point, View};
use projection::chapter::{m_per, p, p_inverse_scaled};

pub(super) static THIRD_ROW_OF_P: Exercise = Exercise {
    number: 3,
    title: words("The third row of P", "P 的第三行"),
    question: words(
        "The third row of P is (0 0 A B), and the bottom row is (0 0 1 0), so w = z. After the divide, points with z = n and points with z = f must keep their z, where 0 > n > f. Find A and B.",
        "P 的最后一行是 (0 0 1 0)，所以 w = z；第三行是 (0 0 A B)。除法之后，z = n 的点和 z = f 的点都应保持各自的 z；0 > n > f。求 A 和 B。",
    ),
    hints: &[
        words(
            "After the divide, z' = (A z + B)/z = A + B/z.",
            "除法之后 z' = (A z + B)/z = A + B/z。",
        ),
        words(
            "Subtract A + B/f = f from A + B/n = n to eliminate A.",
            "A + B/n = n，A + B/f = f：两式相减可消去 A。",
        ),
    ],
    letters: &["n", "f"],
    mistakes: &[
        mistake(
            "sign-of-b",
            Wrong::Places(&[(0, 1, "n*f")]),
            "the sign of B is wrong: A = n + f and A + B/n = n give B/n = −f",
            "B 的符号不对：由 A = n + f 和 A + B/n = n 得 B/n = −f",
        ),
        mistake(
            "sign-of-a",
            Wrong::Places(&[(0, 0, "-(n+f)")]),
            "the sign of A is wrong: substitute z = n into A + B/z",
            "A 的符号不对：把 z = n 代入 A + B/z 验证",
        ),
        mistake(
            "both-signs",
            Wrong::Negated,
            "both signs are reversed: this third row goes with the bottom row (0 0 −1 0)",
            "两个符号都反了：这样的第三行要配最后一行 (0 0 −1 0)",
        ),
        mistake(
            "a-and-b-exchanged",
            Wrong::Answer("-n*f, n+f"),
            "A and B are swapped: A multiplies z, and B is the constant",
            "A 与 B 互换了：A 乘 z，B 乘 w",
        ),
        mistake(
            "difference-for-sum",
            Wrong::Places(&[(0, 0, "n-f")]),
            "A is a sum: A + B/n = n with B = −n f gives A = n + f",
            "A 应是和：由 A + B/n = n 与 B = −n f 得 A = n + f",
        ),
        mistake(
            "not-divided",
            Wrong::Answer("1, 0"),
            "the divide is missing: this row keeps z, but z is then divided by w = z and becomes 1",
            "忘了除法：这一行保持 z，但随后 z 要除以 w = z，结果成为 1",
        ),
        mistake(
            "m-orth",
            Wrong::Answer("2/(n-f), -(n+f)/(n-f)"),
            "this is the third row of M_orth: it takes n and f to +1 and −1, without a divide",
            "这是 M_orth 的第三行：它不经除法就把 n 和 f 映为 +1 和 −1",
        ),
        mistake(
            "m-per",
            Wrong::Answer("(n+f)/(n-f), -2*n*f/(n-f)"),
            "this is the third row of M_per = M_orth P: it takes n and f to +1 and −1, but P keeps them",
            "这是 M_per = M_orth P 的第三行：它把 n 和 f 映为 +1 和 −1，而 P 保持它们不变",
        ),
        mistake(
            "m5-subscript",
            Wrong::Written(&["f_n", "n_f"]),
            "this has a subscript, as misprinted in the textbook: write the product of n and f as `n*f`",
            "f_n 写成了下标，与教科书印错的一样：应是 f 与 n 的乘积 `n*f`",
        ),
        mistake(
            "opengl-row",
            Wrong::AnyOf(&[
                "-(n+f)/(n-f), -2*n*f/(n-f)",
                "-(n+f)/(n-f), 2*n*f/(n-f)",
                "-(n+f)/(f-n), -2*n*f/(f-n)",
            ]),
            "this resembles the third row of OpenGL's perspective matrix, which takes near and far to −1 and +1, but P keeps z = n and z = f",
            "这像 OpenGL 透视矩阵的第三行，它把近平面和远平面映为 −1 和 +1：P 应保持 z = n 和 z = f 不变",
        ),
    ],
    shape: AnswerShape::Parts(&[&["A", "B"]]),
    multiples: Multiples::None,
    samples: &[&[-1.0, -5.0], &[-0.3, -2.2], &[-2.5, -2.9]],
    answer: |letters| {
        let [n, f] = letters.try_into().ok()?;
        let third_row = p(n, f).ok()?.raw().row(2);
        Some(vec![vec![third_row.z, third_row.w]])
    },
};

pub(super) static ORDER_OF_DEPTHS: Exercise = Exercise {
    number: 4,
    title: words("The order of depths", "深度的次序"),
    question: words(
        "P takes z to z' = n + f − f n/z. To show that this preserves the order of depths, write the difference z1' − z2' with (z1 − z2) as a factor.",
        "P 把 z 映为 z' = n + f − f n/z。为说明它保持深度的次序，把差 z1' − z2' 写成含因子 (z1 − z2) 的形式。",
    ),
    hints: &[
        words("n + f cancels in the difference.", "相减时 n + f 消去。"),
        words(
            "1/z2 − 1/z1 = (z1 − z2)/(z1 z2). What is the sign of the other factor if all four numbers are negative?",
            "1/z2 − 1/z1 = (z1 − z2)/(z1 z2)。四个数都为负时，这个因子是正还是负？",
        ),
    ],
    letters: &["n", "f", "z1", "z2"],
    mistakes: &[
        mistake(
            "sign",
            Wrong::Negated,
            "the sign is reversed: −f n/z1 + f n/z2 = f n (z1 − z2)/(z1 z2), so the order is preserved",
            "符号反了：−f n/z1 + f n/z2 = f n (z1 − z2)/(z1 z2)，次序保持不变",
        ),
        mistake(
            "divisor-forgotten",
            Wrong::Answer("n*f*(z1-z2)"),
            "the divisor z1 z2 is missing: 1/z2 − 1/z1 = (z1 − z2)/(z1 z2)",
            "缺少分母 z1 z2：1/z2 − 1/z1 = (z1 − z2)/(z1 z2)",
        ),
        mistake(
            "factor-forgotten",
            Wrong::Answer("(z1-z2)/(z1*z2)"),
            "the factor f n (f times n) is missing",
            "缺少因子 f n（它是乘积，不是下标）",
        ),
        mistake(
            "linear",
            Wrong::Answer("z1-z2"),
            "this is the difference before P: P keeps only the planes z = n and z = f",
            "这是 P 之前的差：P 只保持 z = n 和 z = f 两个平面",
        ),
        mistake(
            "m5-subscript",
            Wrong::Written(&["f_n", "n_f"]),
            "this has a subscript, as misprinted in the textbook: write the product of n and f as `n*f`",
            "f_n 写成了下标，与教科书印错的一样：f 与 n 的乘积请写成 `n*f`",
        ),
    ],
    shape: AnswerShape::Parts(&[&["z1'-z2'"]]),
    multiples: Multiples::None,
    samples: &[&[-1.0, -5.0, -2.0, -3.0], &[-0.3, -2.2, -1.1, -0.7], &[-2.5, -2.9, -2.6, -2.75]],
    answer: |letters| {
        let [n, f, z1, z2] = letters.try_into().ok()?;
        let p = p(n, f).ok()?;
        let depth = |z: f64| Some(p.transform_point(Point::new(0.0, 0.0, z)).divide()?.z());
        Some(vec![vec![depth(z1)? - depth(z2)?]])
    },
};

pub(super) static INVERSE_OF_P: Exercise = Exercise {
    number: 6,
    title: words("The inverse of P", "P 的逆矩阵"),
    question: words(
        "P has the rows (n 0 0 0), (0 n 0 0), (0 0 n+f −f n), (0 0 1 0). Write its inverse. For homogeneous points, any multiple of the inverse is the same map.",
        "P 的各行是 (n 0 0 0)、(0 n 0 0)、(0 0 n+f −f n)、(0 0 1 0)。写出它的逆矩阵；作为齐次点的变换，它可以差一个因子。",
    ),
    hints: &[
        words(
            "P takes (x, y, z, 1) to (n x, n y, (n + f) z − f n, z): the last coordinate is the old z.",
            "P 把 (x, y, z, 1) 映为 (n x, n y, (n + f) z − f n, z)：最后一个数就是原来的 z。",
        ),
        words(
            "With z = w' and z' = (n + f) w' − f n, the old w = 1 is ((n + f) w' − z')/(f n).",
            "由 z = w' 和 z' = (n + f) w' − f n，原来的 w = 1 等于 ((n + f) w' − z')/(f n)。",
        ),
    ],
    letters: &["n", "f"],
    mistakes: &[
        mistake(
            "not-inverted",
            Wrong::Computed(|letters| Some(rows_of(p(letters[0], letters[1]).ok()?.raw()))),
            "this is P itself, not its inverse",
            "这就是 P 本身",
        ),
        mistake(
            "near-and-far-exchanged",
            Wrong::Places(&[(0, 0, "n"), (1, 1, "n")]),
            "near and far are swapped: with n f in the third row, x and y have the factor f",
            "近平面与远平面互换了：第三行为 n f 时，x 和 y 的因子是 f",
        ),
        mistake(
            "last-row-sign",
            Wrong::Places(&[(3, 2, "1")]),
            "the −1 in the last row lacks its minus sign: multiply by P and look at the last row",
            "最后一行的 −1 丢了负号：与 P 相乘，看最后一行",
        ),
        mistake(
            "entries-inverted",
            Wrong::Answer("1/n 0 0 0; 0 1/n 0 0; 0 0 1/(n+f) -1/(n*f); 0 0 1 0"),
            "each entry was inverted separately, which works only for diagonal matrices",
            "逐个元素取了倒数：只有对角矩阵才能这样求逆",
        ),
        mistake(
            "factor-lost",
            Wrong::Places(&[(2, 3, "1")]),
            "the rows have different factors: with f in the first two, the third needs n f",
            "各行的因子不一致：前两行为 f 时，第三行应为 n f",
        ),
        mistake(
            "m5-subscript",
            Wrong::Written(&["f_n", "n_f"]),
            "this has a subscript, as misprinted in the textbook: write the product of n and f as `n*f`",
            "f_n 写成了下标，与教科书印错的一样：f 与 n 的乘积请写成 `n*f`",
        ),
        mistake(
            "last-row-negated",
            Wrong::Places(&[(3, 2, "1"), (3, 3, "-(n+f)")]),
            "the whole last row has the wrong sign: in the product with P, all rows must have the same factor",
            "最后一行整行的符号不对：与 P 相乘，各行的因子应相同",
        ),
        mistake(
            "sign-of-the-sum",
            Wrong::Places(&[(3, 3, "-(n+f)")]),
            "the sign of n + f is wrong: multiply by P and look at the last row",
            "n + f 的符号不对：与 P 相乘，看最后一行",
        ),
        mistake(
            "sign-of-the-product",
            Wrong::Places(&[(2, 3, "-n*f")]),
            "the sign of f n is wrong: multiply by P and look at the third row",
            "f n 的符号不对：与 P 相乘，看第三行",
        ),
        TRANSPOSED,
    ],
    shape: AnswerShape::Matrix(4, 4),
    multiples: Multiples::All,
    samples: &[&[-1.0, -5.0], &[-0.3, -2.2], &[-2.5, -2.9]],
    answer: |letters| {
        let [n, f] = letters.try_into().ok()?;
        Some(rows_of(p_inverse_scaled(n, f).ok()?.raw()))
    },
};

pub(super) static NEAR_CORNER: Exercise = Exercise {
    number: 7,
    title: words("The corner (r, t, n)", "角点 (r, t, n)"),
    question: words(
        "M_per = M_orth P takes the view volume with the window [l, r] × [b, t] on z = n to [−1, 1]³, where 0 > n > f and w = z. To which homogeneous point (x, y, z, w) does M_per take (r, t, n, 1) before the divide?",
        "M_per = M_orth P 把 z = n 上以 [l, r] × [b, t] 为窗口的视见体映为 [−1, 1]³；0 > n > f，且 w = z。除法之前，M_per 把 (r, t, n, 1) 映为哪个齐次点 (x, y, z, w)？",
    ),
    hints: &[
        words(
            "P leaves points on z = n where they are; as homogeneous points they are multiplied by n.",
            "P 使 z = n 上的点保持原位；作为齐次点，它们乘上了 n。",
        ),
        words(
            "M_orth is affine and takes (r, t, n) to (1, 1, 1).",
            "M_orth 把 (r, t, n) 映为 (1, 1, 1)，而它是仿射变换。",
        ),
    ],
    letters: &["r", "t", "n"],
    mistakes: &[
        mistake(
            "divided-too-early",
            Wrong::Answer("1, 1, 1, 1"),
            "this is already divided: before the divide, w = z = n",
            "这已经除过了：除法之前 w = z = n",
        ),
        mistake(
            "divided-too-early",
            Wrong::Answer("1, 1, 1"),
            "this is the point after the divide: before the divide, it has four coordinates, and w = z = n",
            "这是除法之后的点：除法之前有四个数，且 w = z = n",
        ),
        mistake(
            "w-lost",
            Wrong::Places(&[(0, 3, "1")]),
            "w is missing: the bottom row of M_per is (0 0 1 0), so w = z = n",
            "w 丢失了：M_per 的最后一行是 (0 0 1 0)，所以 w = z = n",
        ),
        mistake(
            "sign-of-w",
            Wrong::Negated,
            "this is the image under −M_per, whose w is positive in front of the eye: it is the same point, but M_per has w = z",
            "这是 −M_per 的像，它使视点前方的 w 为正：位置相同，但 M_per 的 w = z",
        ),
        mistake(
            "m8-depth-reversed",
            Wrong::Places(&[(0, 2, "-n")]),
            "near and far are swapped, as in OpenGL: here z = n maps to +1",
            "近平面与远平面按 OpenGL 的方式互换了：这里 z = n 映为 +1",
        ),
        mistake(
            "p-only",
            Wrong::Answer("n*r, n*t, n*n, n"),
            "this is the image under P: M_orth is missing",
            "这只是 P 的像：还缺 M_orth",
        ),
        mistake(
            "not-mapped",
            Wrong::Answer("r, t, n, 1"),
            "this is the original point: P keeps it, but M_orth takes it to the corner of the cube",
            "这是点本身：P 保持它不动，但 M_orth 要把它映为立方体的角点",
        ),
        mistake(
            "only-w-multiplied",
            Wrong::Answer("r, t, n, n"),
            "w is correct, but x, y and z are unchanged: P multiplies them by n, and M_orth maps the result to the corner of the cube",
            "w 正确，但 x、y、z 仍是点自身的：P 使它们乘上 n，M_orth 再把它们映为立方体的角点",
        ),
        mistake(
            "only-w-kept",
            Wrong::Answer("1, 1, 1, n"),
            "x, y and z are already divided, but w is not: before the divide, all four have the same factor",
            "x、y、z 已经除过，而 w 没有：除法之前四个数有同一个因子",
        ),
    ],
    shape: AnswerShape::Parts(&[&["x", "y", "z", "w"]]),
    multiples: Multiples::None,
    samples: &[&[4.0, 2.0, -1.0], &[1.7, -0.9, -0.4], &[-3.5, 6.0, -2.5]],
    answer: |letters| {
        let [r, t, n] = letters.try_into().ok()?;
        // The other sides cancel, so any sides that form a volume will do.
        let map = m_per(r - 3.0, r, t - 2.0, t, n, 3.0 * n).ok()?;
        let image: [f64; 4] = map.transform_point(Point::new(r, t, n)).into();
        Some(vec![image.to_vec()])
    },
};

pub(super) static P_OF_ONE_AND_TWO: Exercise = Exercise {
    number: 8,
    title: words("P for n = 1 and f = 2", "n = 1、f = 2 时的 P"),
    question: words(
        "Write the matrix P for n = 1 and f = 2. (Both are positive here: P is valid on either side of the eye.)",
        "写出 n = 1、f = 2 时的矩阵 P。（这里两者都为正：P 在视点的任一侧都有效。）",
    ),
    hints: &[words(
        "The rows of P are (n 0 0 0), (0 n 0 0), (0 0 n+f −f n), (0 0 1 0).",
        "P 的各行是 (n 0 0 0)、(0 n 0 0)、(0 0 n+f −f n)、(0 0 1 0)。",
    )],
    letters: &[],
    mistakes: &[
        mistake(
            "sign-of-the-product",
            Wrong::Places(&[(2, 3, "2")]),
            "the sign of f n is wrong: the third row ends with −f n",
            "f n 的符号不对：第三行末尾是 −f n",
        ),
        mistake(
            "near-and-far-exchanged",
            Wrong::Places(&[(0, 0, "2"), (1, 1, "2")]),
            "near and far are swapped: x and y have the factor n",
            "近平面与远平面互换了：x 和 y 的因子是 n",
        ),
        mistake(
            "difference-for-sum",
            Wrong::Places(&[(2, 2, "1-2")]),
            "this has n − f instead of n + f",
            "n + f 处写成了 n − f",
        ),
        mistake(
            "w-lost",
            Wrong::Places(&[(3, 2, "0"), (3, 3, "1")]),
            "w is wrong: with the last row (0 0 0 1), w stays 1, and nothing gets smaller with distance",
            "w 丢失了：最后一行为 (0 0 0 1) 时 w 恒为 1，远处的物体不会变小",
        ),
        mistake(
            "m14-bottom-row",
            Wrong::Places(&[(3, 3, "1")]),
            "the bottom row ends with 1, as misprinted in the lesson, so w would be z + 1",
            "最后一行以 1 结尾，与教程印错的一样：w 会成为 z + 1",
        ),
        mistake(
            "last-row-negated",
            Wrong::Places(&[(3, 2, "-1")]),
            "the last row is negated: w = −z requires a negated third row",
            "最后一行变了号：w = −z 时第三行也要变号",
        ),
        mistake(
            "negated",
            Wrong::Negated,
            "this is −P, the same map with the opposite sign of w: clipping would keep points behind the eye",
            "这是 −P：变换相同，但 w 的符号相反，裁剪会保留视点背后的部分",
        ),
        mistake(
            "m9-negative-planes",
            Wrong::Answer("-1 0 0 0; 0 -1 0 0; 0 0 -3 -2; 0 0 1 0"),
            "this is P for n = −1 and f = −2, as in the chapter, where 0 > n > f, but here n = 1 and f = 2",
            "这是 n = −1、f = −2 时的 P：这里 n 和 f 是 +1 和 +2，虽然教科书该章规定 0 > n > f",
        ),
        mistake(
            "opengl-signs",
            Wrong::Answer("1 0 0 0; 0 1 0 0; 0 0 -3 -2; 0 0 -1 0"),
            "these are the signs of an OpenGL matrix, which has w = −z, but P has w = z and n + f in its third row",
            "这是 OpenGL 矩阵的符号，w = −z：P 的 w = z，第三行含 n + f",
        ),
        mistake(
            "image-turned",
            Wrong::Answer("1 0 0 0; 0 1 0 0; 0 0 -3 2; 0 0 -1 0"),
            "with w = −z and unchanged x and y, the image is rotated by 180°, but P has w = z",
            "w = −z 而 x、y 不变时，像转了 180°：P 的 w = z",
        ),
        TRANSPOSED,
    ],
    shape: AnswerShape::Matrix(4, 4),
    multiples: Multiples::Positive,
    samples: NUMBERS,
    answer: |_| Some(rows_of(p(1.0, 2.0).ok()?.raw())),
};

pub(super) static IMAGE_OF_A_POINT: Exercise = Exercise {
    number: 9,
    title: words("The image of a point", "点的像"),
    question: words(
        "P for n = 1 and f = 2 has the rows (1 0 0 0), (0 1 0 0), (0 0 3 −2), (0 0 1 0). Enter the image of (x, y, z, 1): first the homogeneous point and then, after a `;`, the point after the divide.",
        "n = 1、f = 2 时 P 的各行是 (1 0 0 0)、(0 1 0 0)、(0 0 3 −2)、(0 0 1 0)。给出 (x, y, z, 1) 的像：先写齐次点，再在 `;` 之后写除法之后的点。",
    ),
    hints: &[
        words(
            "Each row times (x, y, z, 1) is a coordinate; the last coordinate is w.",
            "每一行乘以 (x, y, z, 1) 得到一个坐标；最后一个是 w。",
        ),
        words("Divide the first three by w.", "前三个坐标除以 w。"),
    ],
    letters: &["x", "y", "z"],
    mistakes: &[
        mistake(
            "not-divided",
            Wrong::Answer("x, y, 3*z-2, z; x, y, 3*z-2"),
            "the second point is not divided: divide all three coordinates by w = z",
            "第二个点没有除：三个坐标都要除以 w = z",
        ),
        mistake(
            "z-not-divided",
            Wrong::Places(&[(1, 2, "3*z-2")]),
            "z is not divided: the divide applies to all three coordinates",
            "z 没有除：三个坐标都要做除法",
        ),
        mistake(
            "m1-coordinate-lost",
            Wrong::Places(&[(1, 0, "1/z"), (1, 1, "1/z")]),
            "the point's x and y are missing, as in the misprint y_s = d/z: the result must be x/z and y/z",
            "点自身的 x 和 y 丢失了，与印错的 y_s = d/z 一样：应为 x/z 和 y/z",
        ),
        mistake(
            "w-lost",
            Wrong::Places(&[(0, 3, "1")]),
            "w is missing: the bottom row (0 0 1 0) gives w = z",
            "w 丢失了：最后一行 (0 0 1 0) 使 w = z",
        ),
        mistake(
            "sign-of-the-product",
            Wrong::Places(&[(0, 2, "3*z+2"), (1, 2, "3+2/z")]),
            "the sign of f n is wrong: the third row is (0 0 3 −2)",
            "f n 的符号不对：第三行是 (0 0 3 −2)",
        ),
        mistake(
            "no-divide",
            Wrong::Answer("x, y, 3*z-2, 1; x, y, 3*z-2"),
            "w is missing, so nothing is divided: the bottom row (0 0 1 0) gives w = z",
            "w 丢失了，因此没有做除法：w 由最后一行 (0 0 1 0) 给出",
        ),
    ],
    shape: AnswerShape::Parts(&[&["x", "y", "z", "w"], &["x", "y", "z"]]),
    multiples: Multiples::None,
    samples: &[&[1.0, 2.0, 4.0], &[3.0, -1.0, 0.5], &[0.7, 0.25, -2.3]],
    answer: |letters| {
        let [x, y, z] = letters.try_into().ok()?;
        let image: HPoint<View> = p(1.0, 2.0).ok()?.transform_point(Point::new(x, y, z));
        let divided = image.divide()?;
        let homogeneous: [f64; 4] = image.into();
        Some(vec![homogeneous.to_vec(), vec![divided.x(), divided.y(), divided.z()]])
    },
};
