//! The workload of the benchmarks: a fixed sequence of points in front of a camera.

use glam::{DMat4, DVec4};
use homog::{Affine, Clip, Model, Point, Projective, Vector, World};

/// The number of points or triangles that a variant processes in one turn.
pub const POINT_COUNT: usize = 100_000;

/// The points of a turn, as blocks to process.
///
/// One small block is processed repeatedly and stays in the L1 cache. Each turn uses a different
/// large block, which has been evicted from every cache.
#[derive(Clone, Copy)]
pub enum Blocks {
    Cached,
    Uncached,
}

/// Between two uses of a block of 100,000 points, every variant runs 12 turns, each of which
/// touches more than 60 MB.
const LARGE_BLOCKS: usize = 12;
const SMALL_BLOCK: usize = 1_000;

impl Blocks {
    /// Returns the total number of items.
    pub fn total_points(self) -> usize {
        match self {
            Self::Cached => SMALL_BLOCK,
            Self::Uncached => LARGE_BLOCKS * POINT_COUNT,
        }
    }

    /// Calls `each` with the ranges of one turn.
    pub fn for_each_block(self, turn: usize, mut each: impl FnMut(std::ops::Range<usize>)) {
        match self {
            Self::Cached => (0..POINT_COUNT / SMALL_BLOCK).for_each(|_| each(0..SMALL_BLOCK)),
            Self::Uncached => {
                let start = turn % LARGE_BLOCKS * POINT_COUNT;
                each(start..start + POINT_COUNT);
            }
        }
    }
}

/// Returns the i-th coordinate of an irregular sequence, from −1 to 1.
pub fn coordinate(i: usize) -> f64 {
    let golden = (i as f64 * 0.618_033_988_749_894_9).fract();
    golden * 2.0 - 1.0
}

/// Returns the i-th point of a cube in front of the camera. One or two corners of the cube are out
/// of view.
pub fn position(i: usize) -> [f64; 3] {
    [coordinate(3 * i), coordinate(5 * i + 1), coordinate(7 * i + 2)]
}

/// Returns a map that rotates, scales and translates, so that no entry happens to be 0 or 1.
pub fn model_to_world() -> Affine<Model, World> {
    Affine::<Model, Model>::rotation_x(0.3)
        .then(Affine::<Model, Model>::rotation_y(0.7))
        .then(Affine::<Model, Model>::scale(1.1, 0.9, 1.2))
        .then(Affine::translation(Vector::new(0.1, -0.2, -4.0)))
}

/// Returns the map to clip space for a camera at the origin, in the chapter's conventions.
pub fn model_to_clip() -> Projective<Model, Clip> {
    let (near, far) = (0.5, 20.0);
    let depth = DVec4::new(0.0, 0.0, (far + near) / (far - near), -1.0);
    let offset = DVec4::new(0.0, 0.0, 2.0 * far * near / (far - near), 0.0);
    let lens = DMat4::from_cols(DVec4::X * 2.2, DVec4::Y * 2.4, depth, offset);
    model_to_world().then_project(Projective::<World, Clip>::from_raw(lens))
}

pub fn model_points(count: usize) -> Vec<Point<Model>> {
    (0..count).map(|i| Point::from(position(i))).collect()
}
