//! Compares a million triangles, most of them unusual, with the definition of coverage and
//! visibility.
//!
//! Each picture contains forty triangles. For every sample, brute force in integers determines
//! which of them cover it, and the nearest of these must be visible. Each triangle has a constant
//! depth, so nothing is rounded.

use raster::{Frame, Opacity, Samples, ScreenVertex, SimdLevel};

/// The number of pictures, each with [`TRIANGLES`] triangles.
const PICTURES: usize = 25_000;
const TRIANGLES: usize = 40;
/// The side of a picture: one tile and part of the next.
const SIDE: u32 = 72;
/// The pixels that are checked: a window across the border between two tiles.
const WINDOW: std::ops::Range<u32> = 56..72;

/// A pseudorandom number generator with the same output on every platform (Knuth's constants).
struct Dice(u64);

impl Dice {
    fn below(&mut self, end: i32) -> i32 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % end as u64) as i32
    }

    /// Returns a triangle near the window. Its size is between a grid step and the whole guard
    /// band. Often it is degenerate, has corners on samples, or has sides along the axes.
    fn triangle(&mut self) -> [[i32; 2]; 3] {
        let size = 1 << self.below(22);
        let center = [0, 1].map(|_| (52 * 256) + self.below(24 * 256));
        let mut corners = [[0; 2]; 3].map(|_: [i32; 2]| {
            center.map(|c| (c + self.below(2 * size) - size).clamp(-8192 * 256, 24576 * 256))
        });
        match self.below(12) {
            0 => corners[1] = corners[0],
            1 => corners[2] = [0, 1].map(|k| 2 * (corners[1][k] / 2) - corners[0][k]),
            2 => corners[1][1] = corners[0][1],
            3 => corners[2][0] = corners[1][0],
            4..=6 => corners = corners.map(|corner| corner.map(|c| c / 128 * 128)),
            _ => {}
        }
        corners.map(|corner| corner.map(|c| c.clamp(-8192 * 256, 24576 * 256)))
    }
}

/// Returns whether a triangle covers a sample at grid position (x, y), using RA-1 in 64 bits.
fn covers(mut corners: [[i32; 2]; 3], x: i32, y: i32) -> bool {
    let side = |[ax, ay]: [i32; 2], [bx, by]: [i32; 2], x: i32, y: i32| {
        let (dx, dy) = (i64::from(bx) - i64::from(ax), i64::from(by) - i64::from(ay));
        dx * (i64::from(y) - i64::from(ay)) - dy * (i64::from(x) - i64::from(ax))
    };
    let area = side(corners[0], corners[1], corners[2][0], corners[2][1]);
    if area < 0 {
        corners.swap(1, 2);
    }
    area != 0
        && (0..3).all(|k| {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            // Clockwise with y down: a left edge runs up, and a top edge runs to the right.
            let owns_border = b[1] < a[1] || (b[1] == a[1] && b[0] > a[0]);
            let value = side(a, b, x, y);
            value > 0 || (value == 0 && owns_border)
        })
}

#[test]
fn a_million_triangles_match_the_definition_of_coverage() {
    let mut dice = Dice(1);
    let instructions = SimdLevel::available();
    let mut covered = 0_u64;
    for picture in 0..PICTURES {
        let triangles: Vec<_> =
            (0..TRIANGLES).map(|_| (dice.triangle(), dice.below(8) as f32 / 8.0)).collect();
        let frame = Frame::new(SIDE, SIDE, Samples::One).expect("a small frame");
        let mut frame = frame.with_simd_level(instructions[picture % instructions.len()]);
        for (id, (corners, depth)) in (0..).zip(&triangles) {
            let vertex = |[x, y]: [i32; 2]| ScreenVertex::new(x, y, *depth, 1.0);
            let [Some(p), Some(q), Some(r)] = corners.map(vertex) else {
                panic!("vertex off the grid")
            };
            frame.add_triangle([p, q, r], id, Opacity::Opaque);
        }
        let seen = frame.visibility_buffer();
        for (y, x) in WINDOW.flat_map(|y| WINDOW.map(move |x| (y, x))) {
            let at = [x, y].map(|c| c as i32 * 256 + 128);
            let covering = (0..).zip(&triangles).filter(|(_, (c, _))| covers(*c, at[0], at[1]));
            // The nearest triangle wins; at equal depth, the first.
            let nearest = covering.max_by(|(m, (_, a)), (n, (_, b))| a.total_cmp(b).then(n.cmp(m)));
            let expected: Option<u32> = nearest.map(|(id, _)| id);
            let found = seen.ids[(y * SIDE + x) as usize];
            assert_eq!(found, expected, "picture {picture}, pixel ({x}, {y}): {triangles:?}");
            covered += u64::from(found.is_some());
        }
    }
    let share = covered as f64 / (PICTURES * WINDOW.len() * WINDOW.len()) as f64;
    assert!((0.3..0.999).contains(&share), "unsuitable share of covered samples: {share}");
}
