//! The nearest surface of each pixel as a plane: what shadow maps and ambient occlusion read.

use crate::plane::index_of;
use crate::setup::slopes;
use crate::walk::Filled;
use crate::{Frame, Surface};

/// How near the nearest surface is at a pixel's centre, and how that changes from pixel to pixel.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Nearest {
    /// Depth: 1 at the near plane, 0 at the far plane; −∞ where nothing is seen.
    pub depth: f32,
    /// What depth grows by from pixel to pixel to the right, on the surface's plane. It is cut off at the difference between the
    /// nearest and the farthest corner: beside a triangle smaller than a pixel its plane means nothing.
    pub dx: f32,
    /// The same from pixel to pixel downwards.
    pub dy: f32,
}

impl Nearest {
    /// No surface.
    pub const NOTHING: Self = Self { depth: f32::NEG_INFINITY, dx: 0.0, dy: 0.0 };
}

impl Frame {
    /// Finds the nearest surface at the first sample of each pixel, with its depth at the pixel's centre, rows from the top: `width` ×
    /// `height` of them. Masked primitives count where `surface` keeps them, translucent ones not at all. Uses up to `threads`
    /// threads, whose number does not matter.
    pub fn nearest<S: Surface>(&self, surface: &S, threads: usize, target: &mut [Nearest]) {
        let first = self.samples.offset(0);
        let to_center = [first.0, first.1].map(|at| 0.5 - at as f32 / 256.0);
        let begin = |band: &mut [Nearest]| band.fill(Nearest::NOTHING);
        self.each_tile(surface, threads, target, begin, |Filled { tile, rect, band, .. }| {
            // Neighbours are most often of one piece.
            let (mut last, mut slope) = (None, [0.0; 2]);
            for (y, x) in
                (rect.top..rect.bottom).flat_map(|y| (rect.left..rect.right).map(move |x| (y, x)))
            {
                let at = index_of(x as usize, y as usize);
                let number = tile.piece(0, at);
                let Some(piece) = self.pieces.get(number) else { continue };
                if last != Some(number) {
                    (last, slope) = (Some(number), slopes(piece));
                }
                let place = (y - rect.top) as usize * self.part.width as usize
                    + (rect.x + x - self.part.x) as usize;
                if let Some(nearest) = band.get_mut(place) {
                    let [dx, dy] = slope;
                    let depth = tile.depth(0, at) + dx * to_center[0] + dy * to_center[1];
                    *nearest = Nearest { depth, dx, dy };
                }
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Cover, Fragment, Samples, ScreenVertex};
    use homog::Point;

    /// Keeps the left half.
    struct Left;

    impl Surface for Left {
        fn keeps(&self, fragment: &Fragment<'_>) -> bool {
            fragment.x < 50
        }
        fn shade(&self, _: &Fragment<'_>) -> [f32; 4] {
            [0.0; 4]
        }
    }

    fn sloped(cover: Cover) -> Frame {
        let mut frame = Frame::new(100, 70, Samples::One).expect("a frame");
        // Depth 0.1 + x / 200 + y / 400 over all of it.
        let corner = |x: f64, y: f64| {
            let depth = 0.1 + x / 200.0 + y / 400.0;
            ScreenVertex::snap(Point::new(x, y, depth), 1.0).expect("a corner")
        };
        frame.triangle([corner(0.0, 0.0), corner(0.0, 200.0), corner(200.0, 0.0)], 3, cover);
        frame
    }

    #[test]
    fn planes_are_those_of_the_triangles_for_any_number_of_threads() {
        let mut target = vec![Nearest::NOTHING; 7000];
        let mut other = target.clone();
        sloped(Cover::Solid).nearest(&Left, 1, &mut target);
        sloped(Cover::Solid).nearest(&Left, 3, &mut other);
        assert!(target == other);
        for (at, nearest) in target.iter().enumerate() {
            let (x, y) = ((at % 100) as f32 + 0.5, (at / 100) as f32 + 0.5);
            assert!((nearest.depth - (0.1 + x / 200.0 + y / 400.0)).abs() < 1e-6);
            assert!((nearest.dx - 0.005).abs() < 1e-7 && (nearest.dy - 0.0025).abs() < 1e-7);
        }
    }

    #[test]
    fn holes_and_glass_are_not_seen() {
        let mut target = vec![Nearest::NOTHING; 7000];
        sloped(Cover::Masked).nearest(&Left, 1, &mut target);
        assert!((0..7000).all(|at| (target[at].depth > 0.0) == (at % 100 < 50)));
        sloped(Cover::Translucent).nearest(&Left, 1, &mut target);
        assert!(target.iter().all(|nearest| *nearest == Nearest::NOTHING));
    }
}
