//! Exercises on viewports: 1, 2 and 21.

use crate::exercise::answer_text::AnswerShape;
use crate::exercise::entries::{Entries, Multiples, planar_rows_of, rows_of};
use crate::exercise::mistake::{TRANSPOSED, Wrong, mistake};
use crate::exercise::{Exercise, NUMBERS};
use crate::words::words;
use homog::PixelConvention;
use projection::chapter::m_orth;
use viewport::{Limits, Viewport, WindowToViewport};

/// Returns the viewport matrix for an image of `size[0]` by `size[1]` pixels.
fn viewport_matrix(size: &[f64], convention: PixelConvention) -> Option<glam::DMat4> {
    let (width, height) = (*size.first()? as u32, *size.get(1)? as u32);
    let viewport = Viewport::chapter(width, height).ok()?.with_convention(convention);
    Some(viewport.ndc_to_screen().raw())
}

pub(super) static ROWS_FROM_THE_TOP: Exercise = Exercise {
    number: 1,
    title: words("Rows from the top", "自上而下的像素行"),
    question: words(
        "An image has nx × ny pixels with centers at integers, and its rows are counted from the top. Write the viewport matrix: x = −1 maps to −½, x = +1 to nx − ½, y = +1 to −½, y = −1 to ny − ½, and z is unchanged.",
        "图像有 nx × ny 个像素，像素中心位于整数处，行自上而下计数。写出视口矩阵：x = −1 映为 −½，x = +1 映为 nx − ½，y = +1 映为 −½，y = −1 映为 ny − ½，z 保持不变。",
    ),
    hints: &[
        words(
            "Along each axis, the map has a scale and an offset: find both from the two pairs of values.",
            "每个轴都是一次函数：由两对数值求比例和偏移。",
        ),
        words(
            "Counted from the bottom, the row is y_s = ny/2 · y + (ny − 1)/2; counted from the top, it is ny − 1 − y_s.",
            "自下而上的行号是 y_s = ny/2 · y + (ny − 1)/2；自上而下则是 ny − 1 − y_s。",
        ),
    ],
    letters: &["nx", "ny"],
    mistakes: &[
        mistake(
            "rows-from-the-bottom",
            Wrong::Computed(|size| Some(rows_of(viewport_matrix(size, PixelConvention::CHAPTER)?))),
            "you counted the rows from the bottom: here they are counted from the top, so the scale of y is negative",
            "你把行当成自下而上计数了：这里自上而下，y 的比例应为负",
        ),
        mistake(
            "centers-at-halves",
            Wrong::Computed(|size| Some(rows_of(viewport_matrix(size, PixelConvention::IMAGE)?))),
            "you put the centers at half-integers: with centers at integers, the offsets are (nx − 1)/2 and (ny − 1)/2",
            "像素中心取在了半整数处：中心在整数处时，偏移是 (nx − 1)/2 和 (ny − 1)/2",
        ),
        mistake(
            "offset-of-y-negated",
            Wrong::Places(&[(1, 3, "-(ny-1)/2")]),
            "you negated the offset of y along with its scale, but the center of the image stays at (ny − 1)/2",
            "y 的偏移随比例一起变了号：图像的中央仍在 (ny − 1)/2",
        ),
        mistake(
            "sizes-exchanged",
            Wrong::Exchanged(0, 1),
            "width and height are swapped: nx belongs to x, and ny to y",
            "宽与高互换了：nx 属于 x，ny 属于 y",
        ),
        mistake(
            "z-lost",
            Wrong::Places(&[(2, 2, "0")]),
            "z is missing: the third row must preserve it for the depth test",
            "z 丢失了：第三行要保留它，供深度测试使用",
        ),
        TRANSPOSED,
    ],
    shape: AnswerShape::Matrix(4, 4),
    multiples: Multiples::None,
    samples: &[&[640.0, 480.0], &[7.0, 3.0], &[11.0, 30.0]],
    answer: |size| Some(rows_of(viewport_matrix(size, PixelConvention::CHAPTER_Y_DOWN)?)),
};

/// Returns M_vp and M_orth for nx, ny, l, r, b, t, n and f.
fn viewport_and_box(letters: &[f64]) -> Option<[glam::DMat4; 2]> {
    let [_, _, l, r, b, t, n, f] = letters.try_into().ok()?;
    let to_screen = viewport_matrix(letters, PixelConvention::CHAPTER)?;
    Some([to_screen, m_orth(l, r, b, t, n, f).ok()?.raw()])
}

pub(super) static ONE_WINDOWING: Exercise = Exercise {
    number: 2,
    title: words("One windowing", "一次窗口变换"),
    question: words(
        "M_orth takes the box [l, r] × [b, t] × [f, n] to [−1, 1]³, where 0 > n > f; z = n maps to +1, and z = f maps to −1. M_vp takes [−1, 1]² to the image [−½, nx − ½] × [−½, ny − ½], with rows counted from the bottom, and preserves z. Write their product M_vp M_orth as one matrix.",
        "M_orth 把长方体 [l, r] × [b, t] × [f, n] 映为 [−1, 1]³，其中 0 > n > f，z = n 映为 +1，z = f 映为 −1。M_vp 把 [−1, 1]² 映为图像 [−½, nx − ½] × [−½, ny − ½]，行自下而上计数，z 不变。把乘积 M_vp M_orth 写成一个矩阵。",
    ),
    hints: &[
        words(
            "The product is a single windowing transform: l maps to −½, r to nx − ½, b to −½ and t to ny − ½.",
            "乘积就是一次窗口变换：l 映为 −½，r 映为 nx − ½，b 映为 −½，t 映为 ny − ½。",
        ),
        words(
            "A map from [l, r] to [L, R] has the scale (R − L)/(r − l) and takes l to L.",
            "把 [l, r] 映为 [L, R] 的映射，比例是 (R − L)/(r − l)，并把 l 映为 L。",
        ),
    ],
    letters: &["nx", "ny", "l", "r", "b", "t", "n", "f"],
    mistakes: &[
        mistake(
            "centers-at-halves",
            Wrong::Places(&[(0, 3, "-l*nx/(r-l)"), (1, 3, "-b*ny/(t-b)")]),
            "the −½ is missing: the image begins half a pixel before the center of its first pixel",
            "缺少 −½：图像从第一个像素中心之前半个像素处开始",
        ),
        mistake(
            "order-exchanged",
            Wrong::Computed(|letters| {
                let [to_screen, to_cube] = viewport_and_box(letters)?;
                Some(rows_of(to_cube * to_screen))
            }),
            "this is M_orth M_vp, but the matrix on the right is applied first",
            "这是 M_orth M_vp：点先经过右边的矩阵",
        ),
        mistake(
            "viewport-forgotten",
            Wrong::Computed(|letters| Some(rows_of(viewport_and_box(letters)?[1]))),
            "this is only M_orth: the viewport is missing",
            "这只是 M_orth：还没有变换到像素",
        ),
        mistake(
            "depth-reversed",
            Wrong::Places(&[(2, 2, "2/(f-n)"), (2, 3, "-(n+f)/(f-n)")]),
            "the third row takes z = n to −1 and z = f to +1, as in OpenGL: here n maps to +1 and f to −1",
            "第三行把 z = n 映为 −1、z = f 映为 +1，这是 OpenGL 的深度方向：这里 n 映为 +1，f 映为 −1",
        ),
        mistake(
            "opengl-distances",
            Wrong::Places(&[(2, 3, "(n+f)/(n-f)")]),
            "the third row is from OpenGL, where N and F are distances: here n and f are z-coordinates, and z = n maps to +1",
            "第三行是 OpenGL 的写法，用的是距离 N 和 F：这里 n 和 f 是 z 坐标，z = n 应映为 +1",
        ),
        mistake(
            "viewport-offset-lost",
            Wrong::Places(&[(0, 3, "-(r+l)*nx/(2*(r-l))"), (1, 3, "-(t+b)*ny/(2*(t-b))")]),
            "the viewport offsets (nx − 1)/2 and (ny − 1)/2 are missing: the center of the box maps to the center of the image",
            "缺少视口自身的偏移 (nx − 1)/2 和 (ny − 1)/2：长方体的中央应映为图像的中央",
        ),
        mistake(
            "sign-of-the-offset",
            Wrong::Places(&[(0, 3, "-1/2+l*nx/(r-l)"), (1, 3, "-1/2+b*ny/(t-b)")]),
            "a sign in each offset is wrong: substitute x = l and y = b, which must map to −½",
            "偏移的符号不对：代入 x = l 和 y = b 验证，它们应映为 −½",
        ),
        TRANSPOSED,
    ],
    shape: AnswerShape::Matrix(4, 4),
    multiples: Multiples::None,
    samples: &[
        &[640.0, 480.0, -2.0, 4.0, -1.0, 2.0, -1.0, -5.0],
        &[7.0, 3.0, 0.3, 1.7, -2.2, -0.9, -0.4, -3.1],
        &[90.0, 200.0, -5.0, -3.5, 1.25, 6.0, -2.5, -2.9],
    ],
    answer: |letters| {
        let [to_screen, to_cube] = viewport_and_box(letters)?;
        Some(rows_of(to_screen * to_cube))
    },
};

fn window_map(viewport_corner: [f64; 2]) -> Option<WindowToViewport> {
    let [x, y] = viewport_corner;
    let window = Limits { x: [2.0, 6.0], y: [1.0, 3.0] };
    WindowToViewport::new(window, Limits { x: [x, x + 400.0], y: [y, y + 100.0] }).ok()
}

fn window_rows(map: WindowToViewport) -> Entries {
    planar_rows_of(map.homography().raw())
}

pub(super) static WINDOW_TO_VIEWPORT: Exercise = Exercise {
    number: 21,
    title: words("Window to viewport", "窗口到视口"),
    question: words(
        "Write the 3 × 3 matrix that takes the window [2, 6] × [1, 3] to the viewport [10, 410] × [20, 120], for column vectors (x, y, 1).",
        "写出把窗口 [2, 6] × [1, 3] 映为视口 [10, 410] × [20, 120] 的 3 × 3 矩阵，点写成列 (x, y, 1)。",
    ),
    hints: &[
        words(
            "There are three steps: move the window's lower left corner to the origin, scale, and move the corner to that of the viewport.",
            "分三步：把窗口左下角移到原点，缩放，再移到视口的左下角。",
        ),
        words(
            "The offset of x is 10 − 2 s_x, with the scale s_x = 400/4.",
            "x 的偏移是 10 − 2 s_x，比例 s_x = 400/4。",
        ),
    ],
    letters: &[],
    mistakes: &[
        mistake(
            "m18-sign",
            Wrong::Places(&[(1, 2, "20+50*1")]),
            "the window was moved by +1 in y, as misprinted in the slides: −1 moves its corner to the origin",
            "窗口在 y 方向移动了 +1，与课件印错的一样：要移动 −1 才能把角点移到原点",
        ),
        mistake(
            "viewport-corner-forgotten",
            Wrong::Computed(|_| Some(window_rows(window_map([0.0, 0.0])?))),
            "the viewport's corner is missing: add 10 and 20 at the end",
            "缺少视口的角点：最后要加上 10 和 20",
        ),
        mistake(
            "window-corner-forgotten",
            Wrong::Places(&[(0, 2, "10"), (1, 2, "20")]),
            "the window's corner is missing: (2, 1) must map to (10, 20)",
            "缺少窗口的角点：(2, 1) 应映为 (10, 20)",
        ),
        mistake(
            "window-corner-not-scaled",
            Wrong::Places(&[(0, 2, "10-2"), (1, 2, "20-1")]),
            "the window was moved after scaling: its corner must be moved to the origin first",
            "窗口在缩放之后才移动：应先把它的角点移到原点",
        ),
        mistake(
            "inverse",
            Wrong::Computed(|_| Some(window_rows(window_map([10.0, 20.0])?.inverse()))),
            "this is the inverse, from the viewport to the window",
            "这是从视口回到窗口的变换，方向反了",
        ),
        TRANSPOSED,
    ],
    shape: AnswerShape::Matrix(3, 3),
    multiples: Multiples::Positive,
    samples: NUMBERS,
    answer: |_| Some(window_rows(window_map([10.0, 20.0])?)),
};
