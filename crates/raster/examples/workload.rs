//! A fixed workload for counting the instructions of the rasterizer: `cargo xtask bench
//! --instructions`.
//!
//! It draws twenty thousand triangles of a few pixels, as in typical models, and a stack of forty
//! triangles across the whole picture, using baseline instructions. The argument is the number of
//! samples per pixel. The printed number depends on every pixel, so no work can be optimized away.

#![allow(clippy::print_stdout, reason = "the program prints its result")]

use homog::Point;
use raster::{CullMode, Fragment, Frame, Opacity, Samples, ScreenVertex, SimdLevel, Surface};
use std::process::ExitCode;

const IMAGE_SIZE: (u32, u32) = (640, 360);
const SMALL_TRIANGLES: u32 = 20_000;
const LARGE_TRIANGLES: u32 = 40;

/// A pseudorandom number generator with the same output on every platform (Knuth's constants).
struct Random(u64);

impl Random {
    /// Returns a number between 0 and 1.
    fn next_unit(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A surface whose color depends on the triangle's id and is blended between the corners.
struct IdSurface;

impl Surface for IdSurface {
    fn passes_alpha_test(&self, _: &Fragment<'_>) -> bool {
        true
    }

    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        let [r, g, b] = fragment.weights;
        let share = (fragment.id % 256) as f32 / 255.0;
        [r * share, g * share, b, 1.0]
    }
}

fn main() -> ExitCode {
    let samples = std::env::args().nth(1).and_then(|count| count.parse().ok());
    let Some(samples) = samples.and_then(Samples::from_count) else {
        println!("pass the number of samples: 1, 4, 8 or 16");
        return ExitCode::FAILURE;
    };
    match draw_workload(samples) {
        Ok(sum) => {
            println!("{sum:08x}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            println!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn draw_workload(samples: Samples) -> Result<u32, raster::RasterError> {
    let (width, height) = IMAGE_SIZE;
    let frame = Frame::new(width, height, samples)?;
    let mut frame = frame.with_simd_level(SimdLevel::baseline());
    let mut dice = Random(2024);
    let vertices: Vec<_> = (0..SMALL_TRIANGLES).flat_map(|_| small_triangle(&mut dice)).collect();
    let triangles: Vec<_> = (0..SMALL_TRIANGLES).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect();
    frame.add_mesh(&vertices, &triangles, 0, Opacity::Opaque, CullMode::Nothing);
    for n in 0..LARGE_TRIANGLES {
        let depth = f64::from(n) / f64::from(LARGE_TRIANGLES);
        let far = [(-50.0, -50.0), (1400.0, -30.0), (-30.0, 800.0)]
            .map(|(x, y)| screen_vertex(x, y, depth));
        if let [Some(p), Some(q), Some(r)] = far {
            frame.add_triangle([p, q, r], SMALL_TRIANGLES + n, Opacity::Opaque);
        }
    }
    let mut pixels = vec![[0_u8; 4]; (width * height) as usize];
    let encode = |color: [f32; 4]| color.map(|channel| (channel * 255.0) as u8);
    frame.draw(&IdSurface, [0.0; 4], 1, &mut pixels, encode);
    let mix = |sum: u32, byte: &u8| (sum ^ u32::from(*byte)).wrapping_mul(16_777_619);
    Ok(pixels.as_flattened().iter().fold(2_166_136_261, mix))
}

/// Returns a triangle up to six pixels wide and high, at any depth.
fn small_triangle(dice: &mut Random) -> [Option<ScreenVertex>; 3] {
    let (x, y) =
        (dice.next_unit() * f64::from(IMAGE_SIZE.0), dice.next_unit() * f64::from(IMAGE_SIZE.1));
    [(); 3].map(|()| {
        screen_vertex(x + dice.next_unit() * 6.0, y + dice.next_unit() * 6.0, dice.next_unit())
    })
}

fn screen_vertex(x: f64, y: f64, depth: f64) -> Option<ScreenVertex> {
    ScreenVertex::snap(Point::new(x, y, depth), 2.0 - depth)
}
