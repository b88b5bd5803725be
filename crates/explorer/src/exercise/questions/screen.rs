//! Exercises on pixels: 20 and 22.

use crate::exercise::answer_text::AnswerShape;
use crate::exercise::entries::{Entries, Multiples};
use crate::exercise::mistake::{Wrong, mistake};
use crate::exercise::{Exercise, NUMBERS};
use crate::words::words;
use homog::{ClipRange, PixelCenters, PixelConvention, Point, YAxis};
use raster::{Frame, Opacity, Samples, ScreenVertex};
use viewport::Viewport;

/// Returns the position of the NDC point (1/4, 3/10) in an image of 200 × 100 pixels.
fn position(y: YAxis, centers: PixelCenters) -> Option<Entries> {
    let viewport = Viewport::image_for(200, 100, ClipRange::CHAPTER)
        .ok()?
        .with_convention(PixelConvention { y, centers });
    let place = viewport.ndc_to_screen().transform_point(Point::new(0.25, 0.3, 0.0));
    Some(vec![vec![place.x(), place.y()]])
}

pub(super) static PIXEL_POSITION: Exercise = Exercise {
    number: 20,
    title: words("A position in the image", "图像中的位置"),
    question: words(
        "In an image of 200 × 100 pixels, pixel (i, j) covers [i, i + 1) × [j, j + 1), and rows are counted from the top. The point (x, y) = (1/4, 3/10) is given in normalized device coordinates, where y points up. What is its position in pixels?",
        "200 × 100 像素的图像中，像素 (i, j) 覆盖 [i, i + 1) × [j, j + 1)，行自上而下计数。规范化设备坐标（y 向上）的点 (x, y) = (1/4, 3/10) 位于图像的什么位置（以像素计）？",
    ),
    hints: &[
        words(
            "x = −1 is the left border, at 0, and x = +1 is the right border, at 200.",
            "x = −1 是左边界 0；x = +1 是右边界 200。",
        ),
        words(
            "y = +1 is the top border, at 0, and y = −1 is the bottom border, at 100.",
            "y = +1 是上边界 0；y = −1 是下边界 100。",
        ),
    ],
    letters: &[],
    mistakes: &[
        mistake(
            "rows-from-the-bottom",
            Wrong::Computed(|_| position(YAxis::Up, PixelCenters::Half)),
            "you counted the rows from the bottom: here they are counted from the top, so y is flipped",
            "你把行当成自下而上计数了：这里自上而下，y 要反向",
        ),
        mistake(
            "centers-at-whole-numbers",
            Wrong::Computed(|_| position(YAxis::Down, PixelCenters::Integer)),
            "you put the centers at integers, as in the chapter: here pixel 0 begins at 0, and its center is at ½",
            "像素中心取在了整数处，如教科书那样：这里像素 0 从 0 开始，中心在 ½",
        ),
        mistake(
            "chapter-viewport",
            Wrong::Computed(|_| position(YAxis::Up, PixelCenters::Integer)),
            "this is the chapter's viewport: here rows are counted from the top, and centers are at half-integers",
            "这是教科书的视口：行自下而上，像素中心在整数处",
        ),
        mistake(
            "range-forgotten",
            Wrong::Answer("25, 15"),
            "you multiplied by half the size but did not add the center of the image: x = 0 is at 100",
            "只乘了尺寸的一半，没有加图像的中心：x = 0 位于 100",
        ),
        mistake(
            "zero-to-one",
            Wrong::Answer("50, 30"),
            "the coordinates were treated as running from 0 to 1, but they run from −1 to 1",
            "当成了 0 到 1 的坐标：范围是 −1 到 1",
        ),
        mistake(
            "size-less-one",
            Wrong::Answer("5/4*199/2, 7/10*99/2"),
            "the scale uses the size minus one: borders map to borders, so −1 to 1 covers 200 pixels",
            "比例用了尺寸减一：边界对应边界，−1 到 1 共 200 像素",
        ),
    ],
    shape: AnswerShape::Parts(&[&["x", "y"]]),
    multiples: Multiples::None,
    samples: NUMBERS,
    answer: |_| position(YAxis::Down, PixelCenters::Half),
};

pub(super) static TOP_LEFT_RULE: Exercise = Exercise {
    number: 22,
    title: words("The top-left rule", "左上填充规则"),
    question: words(
        "Pixel (i, j) has its center at (i + ½, j + ½), and y points down. The triangle with the corners (½, ½), (9/2, ½) and (½, 9/2) has pixel centers on all of its edges. By the top-left rule, how many pixels belong to it?",
        "像素 (i, j) 的中心在 (i + ½, j + ½)，y 向下。三角形的顶点为 (½, ½)、(9/2, ½)、(½, 9/2)，它的每条边上都有像素中心。按左上填充规则，它拥有多少个像素？",
    ),
    hints: &[
        words(
            "A center on an edge belongs to the triangle if the edge is a left edge or a horizontal top edge.",
            "边上的中心属于该三角形，当且仅当该边是左边，或是位于上方的水平边。",
        ),
        words(
            "The third edge is on the right: count the centers with i + j < 4.",
            "第三条边在右侧：数出 i + j < 4 的中心。",
        ),
    ],
    letters: &[],
    mistakes: &[
        mistake(
            "closed",
            Wrong::Answer("15"),
            "all three edges were counted, but pixels on the right edge belong to the neighboring triangle",
            "三条边都算上了：右侧边上的相邻三角形会重复绘制这些像素",
        ),
        mistake(
            "open",
            Wrong::Answer("3"),
            "no edge was counted: left and top edges belong to the triangle",
            "一条边也没有算：左边和上边属于该三角形",
        ),
        mistake(
            "bottom-right",
            Wrong::Answer("6"),
            "the right edge was counted but the top and left edges were not: it must be the other way around",
            "算了右边，没有算上边和左边：应当相反",
        ),
        mistake(
            "area",
            Wrong::Answer("8"),
            "this is the area, but pixels are counted by their centers",
            "这是面积：像素要按中心来数",
        ),
        mistake(
            "corner-lost",
            Wrong::Answer("9"),
            "the corner (½, ½) is on the top edge and on the left edge, so it belongs to the triangle",
            "顶点 (½, ½) 同时在上边和左边上，属于该三角形",
        ),
        mistake(
            "one-end-of-the-right-edge",
            Wrong::Answer("11"),
            "one end of the right edge was counted: a center on two edges belongs to the triangle only if both are top or left edges",
            "右侧边的一个端点算上了：同时在两条边上的中心，只有两条边都是上边或左边时才属于该三角形",
        ),
        mistake(
            "ends-of-the-right-edge",
            Wrong::Answer("12"),
            "both ends of the right edge were counted: a center on two edges belongs to the triangle only if both are top or left edges",
            "右侧边的两个端点都算上了：同时在两条边上的中心，只有两条边都是上边或左边时才属于该三角形",
        ),
        mistake(
            "nearly-closed",
            Wrong::Answer("14"),
            "all centers of the closed triangle except one were counted, but no center with i + j = 4 belongs to the triangle",
            "右侧边上的中心算上了，只比闭三角形少一个：i + j = 4 的中心都不属于它",
        ),
    ],
    shape: AnswerShape::Parts(&[&["pixels"]]),
    multiples: Multiples::None,
    samples: NUMBERS,
    answer: |_| {
        let corners = [(0.5, 0.5), (4.5, 0.5), (0.5, 4.5)];
        let corner = |(x, y)| ScreenVertex::snap(Point::new(x, y, 0.5), 1.0);
        let [a, b, c] = corners.map(corner);
        let mut frame = Frame::new(8, 8, Samples::One).ok()?;
        frame.add_triangle([a?, b?, c?], 0, Opacity::Opaque);
        let covered = frame.visibility_buffer().ids.into_iter().flatten().count();
        Some(vec![vec![covered as f64]])
    },
};
