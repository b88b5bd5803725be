//! Draws triangles directly into a `tiny_skia::Pixmap`, adds tiny-skia strokes on top, and writes
//! `pixmap.png`.
//!
//! `Frame::draw` accepts any slice of pixels and a closure that encodes colors. Here it encodes
//! tiny-skia pixels, whose channels are premultiplied by alpha after encoding. Where nothing is
//! drawn, the pixmap stays transparent.

use homog::Point;
use raster::{CullMode, Frame, Opacity, Samples, ScreenVertex, surface_fn};
use tiny_skia::{Paint, PathBuilder, Pixmap, PremultipliedColorU8, Stroke, Transform};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut pixmap = Pixmap::new(256, 256).ok_or("cannot allocate the pixmap")?;
    let corner = |n: u32| {
        let (sin, cos) = libm::sincos(f64::from(n) * std::f64::consts::PI / 5.0);
        let reach = if n.is_multiple_of(2) { 110.0 } else { 50.0 };
        (128.0 + reach * cos, 128.0 + reach * sin)
    };
    let corners: Vec<_> = [(128.0, 128.0)].into_iter().chain((0..10).map(corner)).collect();
    let snap = |&(x, y): &(f64, f64)| ScreenVertex::snap(Point::new(x, y, 0.5), 1.0);
    let vertices: Vec<_> = corners.iter().map(snap).collect();
    let triangles: [[u32; 3]; 10] =
        std::array::from_fn(|n| [0, n as u32 + 1, (n as u32 + 1) % 10 + 1]);

    let mut frame = Frame::new(256, 256, Samples::Sixteen)?;
    frame.add_mesh(&vertices, &triangles, 0, Opacity::Opaque, CullMode::Nothing);
    // The facets of a star, each lighter than the previous one.
    let facets = surface_fn(|fragment| {
        let light = 0.2 + 0.07 * fragment.id as f32;
        [light, 0.8 * light, 0.3 * light, 1.0]
    });
    frame.draw(&facets, [0.0; 4], 2, pixmap.pixels_mut(), |[r, g, b, alpha]: [f32; 4]| {
        // A square root approximates the sRGB encoding. The encoded channels are then multiplied by
        // alpha.
        let code = |light: f32| ((light * alpha).sqrt() * 255.0 + 0.5) as u8;
        let alpha = (alpha * 255.0 + 0.5) as u8;
        let [r, g, b] = [r, g, b].map(|light| code(light).min(alpha));
        PremultipliedColorU8::from_rgba(r, g, b, alpha).unwrap_or(PremultipliedColorU8::TRANSPARENT)
    });

    let mut path = PathBuilder::new();
    for &(x, y) in &corners[1..] {
        path.move_to(128.0, 128.0);
        path.line_to(x as f32, y as f32);
    }
    let path = path.finish().ok_or("the path is empty")?;
    pixmap.stroke_path(&path, &Paint::default(), &Stroke::default(), Transform::identity(), None);
    pixmap.save_png("pixmap.png")?;
    Ok(())
}
