//! Draws twelve frames of a spinning triangle side by side, and writes `triangle.png`.
//!
//! It shows everything a frame needs: vertices on the screen, indices, and a surface that returns
//! colors.

use homog::Point;
use raster::{CullMode, Frame, Opacity, Samples, ScreenVertex, surface_fn};

const SIDE: u32 = 96;
const FRAMES: u32 = 12;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut frame = Frame::new(SIDE * FRAMES, SIDE, Samples::Sixteen)?;
    for n in 0..FRAMES {
        let middle = f64::from(SIDE) * (f64::from(n) + 0.5);
        let corner = |k: u32| {
            let angle = f64::from(k) * 2.094395 + f64::from(n) * 0.174533;
            let (sin, cos) = libm::sincos(angle);
            ScreenVertex::snap(Point::new(middle + 40.0 * cos, 48.0 + 40.0 * sin, 0.5), 1.0)
        };
        let vertices = [corner(0), corner(1), corner(2)];
        frame.add_mesh(&vertices, &[[0, 1, 2]], n, Opacity::Opaque, CullMode::Nothing);
    }
    let mut pixels = vec![[0_u8; 4]; (frame.width() * frame.height()) as usize];
    let to_bytes = |color: [f32; 4]| color.map(|channel| (channel * 255.0 + 0.5) as u8);
    // Red, green and blue at the corners, blended between them.
    let corners = surface_fn(|fragment| {
        let [r, g, b] = fragment.weights;
        [r, g, b, 1.0]
    });
    frame.draw(&corners, [0.0; 4], 2, &mut pixels, to_bytes);

    let file = std::fs::File::create("triangle.png")?;
    let mut encoder = png::Encoder::new(file, frame.width(), frame.height());
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header()?.write_image_data(pixels.as_flattened())?;
    Ok(())
}
