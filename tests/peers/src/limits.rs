//! The best that the machine can do, measured in the same process: clearing memory, and the
//! innermost loop of a rasterizer.

use crate::scene::SIZE;
use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f32x8, u32x8};
use std::hint::black_box;

/// The number of pixels in a tile, whose 32 KiB of depth and numbers fit in the L1 cache.
const TILE: usize = 64 * 64;
/// The number of pixels that the kernel fills: fifty layers, rounded down to whole tiles.
pub const KERNEL_PIXELS: usize = 50 * (SIZE.0 * SIZE.1) as usize / TILE * TILE;

/// The number of pictures cleared in turn. Together, they are larger than any cache.
const PICTURES: usize = 16;

/// The color and depth buffers of pictures to clear.
pub struct Clearing {
    pictures: Vec<(Vec<[u8; 4]>, Vec<f32>)>,
    next: usize,
}

impl Clearing {
    /// Creates buffers of the size of the scenes' pictures: one picture that stays in the caches,
    /// or many that are cleared in turn.
    pub fn new(cached: bool) -> Self {
        let area = (SIZE.0 * SIZE.1) as usize;
        let picture = || (vec![[1; 4]; area], vec![1.0; area]);
        let count = if cached { 1 } else { PICTURES };
        Self { pictures: (0..count).map(|_| picture()).collect(), next: 0 }
    }

    /// Clears the color and depth of one picture.
    pub fn run(&mut self) {
        let (color, depth) = &mut self.pictures[self.next];
        color.fill(black_box([0; 4]));
        depth.fill(black_box(0.0));
        black_box(&self.pictures);
        self.next = (self.next + 1) % self.pictures.len();
    }
}

/// The innermost loop, which interpolates the depth at each pixel of a tile, compares it, and
/// stores the nearer depth with its number. It has no edges, setup or occlusion test, and every
/// pixel passes. No rasterizer that stores depth and number can beat it with the same instructions.
#[derive(Clone)]
pub struct Kernel {
    depth: Vec<f32>,
    number: Vec<u32>,
    level: Level,
}

impl Kernel {
    /// Returns one kernel for each set of vector instructions from AVX2 (or the best available)
    /// upward.
    pub fn all() -> Vec<Self> {
        let best = Level::new();
        let mut levels = vec![best];
        #[cfg(target_arch = "x86_64")]
        if let (Some(avx2), true) = (best.as_avx2(), best.as_avx512().is_some()) {
            levels.insert(0, Level::Avx2(avx2));
        }
        levels.into_iter().map(Self::new).collect()
    }

    /// Creates a kernel with these instructions.
    fn new(level: Level) -> Self {
        Self { depth: vec![0.0; TILE], number: vec![0; TILE], level }
    }

    /// Returns the instructions in use.
    pub fn level(&self) -> String {
        let text = format!("{:?}", self.level);
        text.split('(').next().unwrap_or(&text).to_owned()
    }

    /// Fills the tile until [`KERNEL_PIXELS`] are filled, a little nearer each time.
    pub fn vectors(&mut self) {
        let level = self.level;
        for layer in 0..KERNEL_PIXELS / TILE {
            dispatch!(level, simd => fill(simd, &mut self.depth, &mut self.number, layer as u32));
        }
        self.empty();
    }

    /// Runs a plain loop with the same result, whose vectorization is left to the compiler.
    pub fn plain(&mut self) {
        for layer in 0..KERNEL_PIXELS / TILE {
            let (start, dx) = plane(layer as u32);
            let pixels = self.depth.iter_mut().zip(&mut self.number);
            for (x, (depth, number)) in pixels.enumerate() {
                let z = start + dx * (x % 64) as f32;
                if z > *depth {
                    *depth = z;
                    *number = layer as u32;
                }
            }
        }
        self.empty();
    }

    fn empty(&mut self) {
        black_box((&self.depth, &self.number));
        self.depth.fill(0.0);
        self.number.fill(0);
    }
}

/// Returns the depth at the first pixel, and its step.
fn plane(layer: u32) -> (f32, f32) {
    (black_box(0.001 * (layer + 1) as f32), black_box(1e-6))
}

#[inline(always)]
fn fill<S: Simd>(simd: S, depth: &mut [f32], number: &mut [u32], layer: u32) {
    let (start, dx) = plane(layer);
    let along: f32x8<S> = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0].simd_into(simd);
    let along = along * f32x8::splat(simd, dx);
    let name = u32x8::splat(simd, layer);
    let groups = depth.as_chunks_mut::<8>().0.iter_mut().zip(number.as_chunks_mut::<8>().0);
    for (group, (depth, number)) in groups.enumerate() {
        let z = along + f32x8::splat(simd, start + dx * (group % 8 * 8) as f32);
        let old = f32x8::from_slice(simd, depth);
        let nearer = z.simd_gt(old);
        nearer.select(z, old).store_slice(depth);
        let old = u32x8::from_slice(simd, number);
        nearer.select(name, old).store_slice(number);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kernel_keeps_the_nearest_layer() {
        let mut kernel = Kernel::new(Level::new());
        for layer in [4, 2] {
            dispatch!(Level::new(), simd => fill(simd, &mut kernel.depth, &mut kernel.number, layer));
        }
        assert!(kernel.number.iter().all(|&number| number == 4));
        assert!(kernel.depth.iter().all(|&depth| depth >= 0.005));
    }
}
