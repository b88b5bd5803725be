//! Draws a shadow map with only the rasterizer: first the depth seen from a light, then a picture
//! that looks up this depth.

use camera::{
    Camera,
    homog::{Clip, Interpolate as _, Point, Projective, Vector, View, World},
};
use projection::{Convention, Fov, Orthographic, Perspective};
use raster::{Frame, Samples, ScreenProjection, SourceMesh, VertexAttribute, surface_fn};

const TRIANGLES: [[u32; 3]; 3] = [[0, 1, 2], [0, 2, 3], [4, 5, 6]];

fn frame(
    size: [u32; 2],
    view: Camera,
    lens: Projective<View, Clip>,
    positions: &[[f32; 3]],
) -> Result<Frame, Box<dyn std::error::Error>> {
    let mut frame = Frame::new(size[0], size[1], Samples::One)?;
    let screen = ScreenProjection::for_image(size[0], size[1], Convention::CHAPTER)?;
    let mesh = SourceMesh::new(positions, &TRIANGLES);
    frame.add_clipped_mesh(&screen, lens * view.world_to_view(), mesh);
    Ok(frame)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A floor, and a triangle floating above it.
    let positions = [
        [-4.0, 0.0, 4.0_f32],
        [4.0, 0.0, 4.0],
        [4.0, 0.0, -4.0],
        [-4.0, 0.0, -4.0],
        [-1.0, 1.5, 0.5],
        [1.0, 1.5, 0.5],
        [0.0, 1.5, -1.0],
    ];
    let light = Camera::look_at(Point::new(2.0, 6.0, 1.0), Point::ORIGIN, Vector::Z)?;
    let sun = Orthographic::new(-6.0, 6.0, -6.0, 6.0, 1.0, 20.0)?.view_to_clip(Convention::CHAPTER);
    let map = frame([512; 2], light, sun, &positions)?.depth_buffer(&surface_fn(|_| [0.0; 4]), 2);
    let to_map = sun * light.world_to_view();

    let eye = Camera::look_at(Point::new(0.0, 4.0, 6.0), Point::ORIGIN, Vector::Y)?;
    let lens = Perspective::new(Fov::vertical_degrees(50.0), 1.0, 0.1, 50.0)?
        .view_to_clip(Convention::CHAPTER);
    let picture = frame([200; 2], eye, lens, &positions)?;
    let places = positions.map(Point::<World>::from);
    let place = VertexAttribute::new(&TRIANGLES, &places);
    let is_lit = |p: Point<World>| {
        let [x, y, z, _] = <[f64; 4]>::from(to_map * p);
        // The pixel and depth in the map, with the depth moved toward the light to allow for
        // rounding.
        map.depth(((x + 1.0) * 256.0) as u32, ((1.0 - y) * 256.0) as u32)
            <= ((z + 1.0) / 2.0 + 0.004) as f32
    };
    let surface = surface_fn(|fragment| {
        let light = if is_lit(place.at(fragment)) { 0.9 } else { 0.15 };
        if fragment.id < 2 { [light, light, light, 1.0] } else { [light, 0.2, 0.2, 1.0] }
    });
    let mut pixels = vec![[0.0_f32; 4]; 200 * 200];
    picture.draw(&surface, [0.0; 4], 2, &mut pixels, |color: [f32; 4]| color);

    let [dark, bright] =
        [0.15, 0.9].map(|gray| pixels.iter().filter(|pixel| pixel[..3] == [gray; 3]).count());
    println!("{dark} pixels of the floor in shadow, {bright} in light");
    assert!((200..4000).contains(&dark) && bright > 5 * dark);
    // The floor is dark under the middle of the triangle, away from the light, but not beside the
    // triangle.
    let below = [4, 5, 6].map(|corner| places[corner as usize]);
    let middle = Point::weighted_sum(below, [1.0 / 3.0; 3]);
    let ray = middle - light.eye();
    assert!(!is_lit(middle + light.gaze() * (middle.y() / -light.gaze().y())), "{ray}");
    assert!(is_lit(Point::new(3.0, 0.0, 3.0)));
    Ok(())
}
