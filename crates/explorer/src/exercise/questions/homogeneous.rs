//! Exercises on homogeneous points: 5, 12 and 15.

use crate::exercise::answer_text::AnswerShape;
use crate::exercise::entries::Multiples;
use crate::exercise::mistake::{Wrong, mistake};
use crate::exercise::{Exercise, NUMBERS};
use crate::words::words;
use homog::{Affine, HPoint, Normal, Plane, Point, Projective, Vector, View};
use projection::Projector;

pub(super) static MULTIPLES_OF_A_POINT: Exercise = Exercise {
    number: 5,
    title: words("Multiples of a point", "点的倍数"),
    question: words(
        "An affine matrix M (bottom row 0 0 0 1) takes (x, y, z, 1) to (a, b, c, 1). Where does it take (h x, h y, h z, h), which represents the same point?",
        "仿射矩阵 M（最后一行为 0 0 0 1）把 (x, y, z, 1) 映为 (a, b, c, 1)。它把同一点的另一写法 (h x, h y, h z, h) 映为什么？",
    ),
    hints: &[
        words(
            "M is linear on 4-vectors: M (h p) = h (M p).",
            "M 对四维向量是线性的：M (h p) = h (M p)。",
        ),
        words(
            "Both images are the same point after the divide by w.",
            "除以 w 之后，两个像是同一点。",
        ),
    ],
    letters: &["a", "b", "c", "h"],
    mistakes: &[
        mistake(
            "divided-too-early",
            Wrong::Answer("a, b, c, 1"),
            "this is the same point after the divide, but the matrix gives h times these values",
            "这已经除过了：点是同一个，但矩阵给出的是它的 h 倍",
        ),
        mistake(
            "w-lost",
            Wrong::Places(&[(0, 3, "1")]),
            "w is missing: the last row (0 0 0 1) keeps w = h",
            "w 丢失了：最后一行 (0 0 0 1) 保持 w = h",
        ),
        mistake(
            "only-w-multiplied",
            Wrong::Answer("a, b, c, h"),
            "only w was multiplied: all four coordinates have the factor h",
            "只有 w 乘了 h：四个坐标都有因子 h",
        ),
        mistake(
            "divided-by-h",
            Wrong::Answer("a/h, b/h, c/h, 1"),
            "this was divided by h one time too many: the divide gives (a, b, c)",
            "多除了一次 h：除法之后的点仍是 (a, b, c)",
        ),
        mistake(
            "w-squared",
            Wrong::Places(&[(0, 3, "h*h")]),
            "w is h times too large: w = 1 is multiplied by h only once",
            "w 多乘了一次 h：像的 w = 1 只乘一次 h",
        ),
        mistake(
            "w-inverted",
            Wrong::Places(&[(0, 3, "1/h")]),
            "w is inverted: multiply it by h, like the other three coordinates",
            "w 取成了倒数：它和另外三个坐标一样要乘以 h",
        ),
    ],
    shape: AnswerShape::Parts(&[&["x", "y", "z", "w"]]),
    multiples: Multiples::None,
    samples: &[&[3.0, 5.0, -2.0, 4.0], &[0.7, -1.3, 2.1, -0.6], &[-4.0, 2.5, 1.5, 1.25]],
    answer: |letters| {
        let [a, b, c, h] = letters.try_into().ok()?;
        // Any affine map and any point would do. This is a translation of the origin.
        let map: Projective<View, View> = Affine::translation(Vector::new(a, b, c)).into();
        let image: [f64; 4] = map.transform_hpoint(HPoint::new(0.0, 0.0, 0.0, h)).into();
        Some(vec![image.to_vec()])
    },
};

pub(super) static PLACE_OF_A_POINT: Exercise = Exercise {
    number: 12,
    title: words("A homogeneous point", "齐次点"),
    question: words(
        "Which point (x, y, z) does the homogeneous point (−2, 6, 4, −2) represent?",
        "齐次点 (−2, 6, 4, −2) 表示哪个位置 (x, y, z)？",
    ),
    hints: &[words(
        "Any multiple represents the same point: find the multiple with w = 1.",
        "任意倍数都表示同一位置：取 w 为 1 的那一个。",
    )],
    letters: &[],
    mistakes: &[
        mistake(
            "w-lost",
            Wrong::Answer("-2, 6, 4"),
            "w is ignored: x, y and z must be divided by it",
            "w 丢失了：x、y、z 都要除以它",
        ),
        mistake(
            "multiplied",
            Wrong::Answer("4, -12, -8"),
            "you multiplied by w: divide by it instead",
            "应除以 w，却乘上了它",
        ),
        mistake(
            "sign-of-w-lost",
            Wrong::Negated,
            "the sign of w is ignored: −2/−2 is 1",
            "w 的符号丢了：−2/−2 等于 1",
        ),
        mistake(
            "z-not-divided",
            Wrong::Places(&[(0, 2, "4")]),
            "z is not divided: the divide applies to all three coordinates",
            "z 没有除：三个坐标都要做除法",
        ),
        mistake(
            "signs-of-y-and-z",
            Wrong::Answer("1, 3, 2"),
            "x is correct, but y and z have the wrong sign: divide them by −2 too",
            "x 正确，但 y 和 z 丢了 w 的符号：它们也要除以 −2",
        ),
    ],
    shape: AnswerShape::Parts(&[&["x", "y", "z"]]),
    multiples: Multiples::None,
    samples: NUMBERS,
    answer: |_| {
        let place = HPoint::<View>::new(-2.0, 6.0, 4.0, -2.0).divide()?;
        Some(vec![vec![place.x(), place.y(), place.z()]])
    },
};

pub(super) static VANISHING_POINT: Exercise = Exercise {
    number: 15,
    title: words("A vanishing point", "灭点"),
    question: words(
        "The eye is at the origin, and the picture plane is z = −2. Find the vanishing point (x, y) of all lines in the direction (1, −2, −4).",
        "视点在原点，画面是平面 z = −2。沿方向 (1, −2, −4) 的所有直线，其灭点 (x, y) 在画面何处？",
    ),
    hints: &[
        words(
            "The vanishing point is the image of the direction: the point where the line through the eye in this direction meets the plane.",
            "灭点是方向的像：过视点、沿该方向的直线与画面的交点。",
        ),
        words("Which multiple of (1, −2, −4) has z = −2?", "(1, −2, −4) 的哪个倍数满足 z = −2？"),
    ],
    letters: &[],
    mistakes: &[
        mistake(
            "sign-of-z",
            Wrong::Negated,
            "the sign of z is ignored: both the plane and the direction have a negative z, so the quotient is positive",
            "z 的符号丢了：画面与方向的 z 都为负，商为正",
        ),
        mistake(
            "distance-forgotten",
            Wrong::Answer("1/4, -1/2"),
            "the factor 2, the distance to the picture plane, is missing",
            "忘了画面的距离 2",
        ),
        mistake(
            "sign-and-distance",
            Wrong::Answer("-1/4, 1/2"),
            "this is only x/z and y/z: multiply both by −2, the z of the plane",
            "只求了 x/z 和 y/z：还要乘以画面的 z = −2",
        ),
        mistake(
            "direction-itself",
            Wrong::Answer("1, -2"),
            "this is the direction itself: scale it so that z = −2",
            "这是方向本身：要把它缩放到 z 等于画面的 z",
        ),
        mistake(
            "distance-divided",
            Wrong::Answer("1/8, -1/4"),
            "you divided by the distance to the plane: multiply by it instead",
            "应乘以画面的距离，却除以了它",
        ),
    ],
    shape: AnswerShape::Parts(&[&["x", "y"]]),
    multiples: Multiples::None,
    samples: NUMBERS,
    answer: |_| {
        let plane = Plane::through(Point::new(0.0, 0.0, -2.0), Normal::new(0.0, 0.0, 1.0));
        let projector = Projector::<View>::from_eye(Point::ORIGIN, plane).ok()?;
        let image = projector.onto_plane().transform_direction(Vector::new(1.0, -2.0, -4.0));
        let place = image.divide()?;
        Some(vec![vec![place.x(), place.y()]])
    },
};
