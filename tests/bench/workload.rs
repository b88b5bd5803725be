//! A fixed piece of work for the rasteriser alone, to count its instructions: `cargo xtask bench --instructions`.
//!
//! Twenty thousand triangles of a few pixels, as models have them, and forty that cross the picture, one behind the
//! other, drawn with the instructions that every processor has. The argument is the number of samples for each pixel.
//! What is printed depends on every pixel, so that nothing can be left undone.

#![allow(clippy::print_stdout, reason = "a program speaks on its standard output")]

use homog::Point;
use raster::{Cover, Cull, Fragment, Frame, Instructions, Samples, ScreenVertex, Surface};
use std::process::ExitCode;

const SIZE: (u32, u32) = (640, 360);
const SMALL: u32 = 20_000;
const LARGE: u32 = 40;

/// Numbers without rhyme that are the same everywhere (Knuth's constants).
struct Dice(u64);

impl Dice {
    /// Between 0 and 1.
    fn throw(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A colour of the triangle's name, blended over its corners.
struct Names;

impl Surface for Names {
    fn keeps(&self, _: &Fragment<'_>) -> bool {
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
        println!("give the number of samples: 1, 4, 8 or 16");
        return ExitCode::FAILURE;
    };
    match work(samples) {
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

fn work(samples: Samples) -> Result<u32, raster::RasterError> {
    let (width, height) = SIZE;
    let frame = Frame::new(width, height, samples)?;
    let mut frame = frame.with_instructions(Instructions::baseline());
    let mut dice = Dice(2024);
    let vertices: Vec<_> = (0..SMALL).flat_map(|_| small(&mut dice)).collect();
    let triangles: Vec<_> = (0..SMALL).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect();
    frame.mesh(&vertices, &triangles, 0, Cover::Solid, Cull::Nothing);
    for n in 0..LARGE {
        let depth = f64::from(n) / f64::from(LARGE);
        let far =
            [(-50.0, -50.0), (1400.0, -30.0), (-30.0, 800.0)].map(|(x, y)| vertex(x, y, depth));
        if let [Some(p), Some(q), Some(r)] = far {
            frame.triangle([p, q, r], SMALL + n, Cover::Solid);
        }
    }
    let mut pixels = vec![[0_u8; 4]; (width * height) as usize];
    let encode = |color: [f32; 4]| color.map(|channel| (channel * 255.0) as u8);
    frame.draw(&Names, [0.0; 4], 1, &mut pixels, encode);
    let mix = |sum: u32, byte: &u8| (sum ^ u32::from(*byte)).wrapping_mul(16_777_619);
    Ok(pixels.as_flattened().iter().fold(2_166_136_261, mix))
}

/// A triangle of up to six pixels each way, with everything from the nearest to the farthest.
fn small(dice: &mut Dice) -> [Option<ScreenVertex>; 3] {
    let (x, y) = (dice.throw() * f64::from(SIZE.0), dice.throw() * f64::from(SIZE.1));
    [(); 3].map(|()| vertex(x + dice.throw() * 6.0, y + dice.throw() * 6.0, dice.throw()))
}

fn vertex(x: f64, y: f64, depth: f64) -> Option<ScreenVertex> {
    ScreenVertex::snap(Point::new(x, y, depth), 2.0 - depth)
}
