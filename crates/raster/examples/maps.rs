//! Writes a visibility buffer as two pictures: a depth map, `depth.png`, and an id map, `ids.png`.
//!
//! The scene is three hundred triangles at random positions and depths.

use homog::Point;
use raster::{Frame, Opacity, Samples, ScreenVertex};

const WIDTH: u32 = 480;
const HEIGHT: u32 = 320;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut frame = Frame::new(WIDTH, HEIGHT, Samples::One)?;
    let mut numbers = Numbers(7);
    for id in 0..300 {
        let (x, y, depth) = (numbers.next() * 480.0, numbers.next() * 320.0, numbers.next());
        let mut corner = || {
            let (dx, dy) = (numbers.next() * 120.0 - 60.0, numbers.next() * 120.0 - 60.0);
            ScreenVertex::snap(Point::new(x + dx, y + dy, 0.2 + 0.8 * depth), 1.0)
        };
        if let (Some(p), Some(q), Some(r)) = (corner(), corner(), corner()) {
            frame.add_triangle([p, q, r], id, Opacity::Opaque);
        }
    }
    let seen = frame.visibility_buffer();
    write("depth.png", seen.depth.iter().map(|depth| [(depth * 255.0) as u8; 3]))?;
    // Neighboring ids get very different colors.
    let color = |id: u32| [id.wrapping_mul(97) as u8, id.wrapping_mul(57) as u8, !(id as u8)];
    write("ids.png", seen.ids.iter().map(|id| id.map_or([0; 3], color)))?;
    Ok(())
}

fn write(
    name: &str,
    pixels: impl Iterator<Item = [u8; 3]>,
) -> Result<(), Box<dyn std::error::Error>> {
    let mut encoder = png::Encoder::new(std::fs::File::create(name)?, WIDTH, HEIGHT);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(&pixels.flatten().collect::<Vec<u8>>())?;
    Ok(())
}

/// A source of numbers between 0 and 1 that look random but are the same in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 40) as f64 / (1_u64 << 24) as f64
    }
}
