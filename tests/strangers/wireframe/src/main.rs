//! Draws the edges of a cube, from the model to a picture: camera, projection, clipping, division,
//! viewport, and strokes by tiny-skia.

use camera::{
    Camera,
    homog::{Affine, Model, Point, Vector, World},
};
use clip::{Volume, clip_segment};
use projection::{Convention, Fov, Perspective};
use tiny_skia::{Color, Paint, PathBuilder, Pixmap, Stroke, Transform};
use viewport::Viewport;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let convention = Convention::OPENGL;
    // The eye is inside, so edges behind it are clipped, not mirrored.
    let camera =
        Camera::look_at(Point::new(0.5, 0.8, 0.4), Point::new(-1.0, -0.2, -1.0), Vector::Y)?;
    let lens = Perspective::new(Fov::vertical_degrees(75.0), 4.0 / 3.0, 0.01, 10.0)?;
    let to_world = Affine::<Model, World>::rotation_y(0.3);
    let to_clip = lens.view_to_clip(convention) * camera.world_to_view() * to_world;
    let to_screen = Viewport::image_for(320, 240, convention)?.ndc_to_screen();

    let corner =
        |bits: u32| Point::from([0, 1, 2].map(|axis| f64::from(bits >> axis & 1) * 2.0 - 1.0));
    let mut path = PathBuilder::new();
    let mut count = 0;
    for (from, axis) in (0..8).flat_map(|from| (0..3).map(move |axis| (from, axis))) {
        let to = from | 1 << axis;
        let ends = [from, to].map(|bits| to_clip * corner(bits));
        let Some(seen) =
            clip_segment(ends[0], ends[1], &Volume::for_range(convention)).filter(|_| to != from)
        else {
            continue;
        };
        let [a, b] = [seen.start, seen.end]
            .map(|end| to_screen * end.divide().expect("w > 0 inside the volume"));
        path.move_to(a.x() as f32, a.y() as f32);
        path.line_to(b.x() as f32, b.y() as f32);
        count += 1;
    }
    let (mut picture, mut paint) = (Pixmap::new(320, 240).expect("pixels"), Paint::default());
    picture.fill(Color::WHITE);
    paint.set_color_rgba8(20, 40, 90, 255);
    picture.stroke_path(
        &path.finish().ok_or("no edge")?,
        &paint,
        &Stroke::default(),
        Transform::identity(),
        None,
    );
    picture.save_png(std::env::temp_dir().join("wireframe.png"))?;
    let inked = picture.pixels().iter().filter(|pixel| pixel.red() < 200).count();
    println!("{count} edges, {inked} pixels");
    assert!((4..12).contains(&count) && inked > 300);
    Ok(())
}
