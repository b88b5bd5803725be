//! Draws a checkered floor that extends to the horizon with a custom shader, and writes
//! `shader.png`.
//!
//! Each corner carries its position on the floor. Blending these positions by the fragment's
//! weights gives the position at the pixel, perspective-correct because the vertices carry their w.
//! The derivatives of the weights give the size of the pixel on the floor: where a pixel covers a
//! whole square or more, the checkerboard fades to its mean.

use homog::{HPoint, Screen};
use raster::{
    CullMode, Fragment, Frame, Opacity, Samples, ScreenVertex, VertexAttribute, surface_fn,
};

/// The corners of the floor: x to the right, and distance in front of the eye.
const FLOOR: [[f32; 2]; 4] = [[-9.0, 1.0], [9.0, 1.0], [400.0, 400.0], [-400.0, 400.0]];
const TRIANGLES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

fn checker(fragment: &Fragment<'_>) -> [f32; 4] {
    let place = VertexAttribute::new(&TRIANGLES, &FLOOR);
    let (here, [right, below]) = (place.at(fragment), place.derivatives(fragment));
    let reach = |[x, ahead]: [f32; 2]| x.abs().max(ahead.abs());
    let fade = (1.0 - reach(right).max(reach(below))).max(0.0);
    let odd = (here[0].floor() + here[1].floor()).rem_euclid(2.0) == 1.0;
    let light = 0.5 + if odd { 0.35 } else { -0.35 } * fade;
    [light, light * 0.95, light * 0.85, 1.0]
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (width, height) = (640, 360);
    let vertices = FLOOR.map(|[x, ahead]| {
        // The eye is one unit above the floor. The projection follows from similar triangles, and w
        // is the distance in front of the eye.
        let (x, ahead) = (f64::from(x), f64::from(ahead));
        let image =
            HPoint::<Screen>::new(320.0 * ahead + 360.0 * x, 120.0 * ahead + 240.0, 1.0, ahead);
        ScreenVertex::snap(image.divide()?, ahead)
    });
    let mut frame = Frame::new(width, height, Samples::Four)?;
    frame.add_mesh(&vertices, &TRIANGLES, 0, Opacity::Opaque, CullMode::Nothing);
    let mut pixels = vec![[0_u8; 3]; (width * height) as usize];
    let sky = [0.55, 0.72, 0.9, 1.0];
    frame.draw(&surface_fn(checker), sky, 2, &mut pixels, |[r, g, b, _]: [f32; 4]| {
        [r, g, b].map(|channel| (channel.sqrt() * 255.0 + 0.5) as u8)
    });
    let mut encoder = png::Encoder::new(std::fs::File::create("shader.png")?, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(pixels.as_flattened())?;
    Ok(())
}
