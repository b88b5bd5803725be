//! A tiled floor that passes under and behind the eye, for measuring the cost of clipping and of
//! obliquely viewed textures.

use super::{Lens, Part, Scene, Texture, Vertex, aspect};
use camera::Camera;
use homog::{Point, Vector};
use projection::{Fov, Perspective};

/// The number of squares along each side of the floor.
const SIDE: u32 = 200;

/// Returns the floor, which has `SIDE` × `SIDE` squares around the eye.
pub fn floor(name: &'static str) -> Result<Scene, String> {
    let place = |n: u32| n as f32 - SIDE as f32 / 2.0;
    let vertices: Vec<Vertex> = (0..=SIDE)
        .flat_map(|i| (0..=SIDE).map(move |j| (place(j), place(i))))
        .map(|(x, z)| Vertex {
            position: [x, 0.0, z],
            normal: [0.0, 1.0, 0.0],
            uv: [x / 4.0, z / 4.0],
        })
        .collect();
    let stride = SIDE + 1;
    let squares = (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| i * stride + j));
    let indices: Vec<u32> =
        squares.flat_map(|a| [a, a + stride, a + 1, a + 1, a + stride, a + stride + 1]).collect();
    let camera = Camera::look_at(Point::new(0.3, 1.6, 0.2), Point::new(3.0, 0.9, -8.0), Vector::Y);
    let lens = Perspective::new(Fov::vertical_degrees(60.0), aspect(), 0.1, 500.0);
    Ok(Scene {
        name,
        about: format!(
            "A floor around the eye, {} triangles, textured, diffuse shading",
            indices.len() / 3
        ),
        parts: vec![Part {
            indices: 0..indices.len(),
            tint: [1.0; 3],
            lit: true,
            texture: Some(0),
            two_sided: false,
        }],
        vertices,
        indices,
        textures: vec![Texture::board(256, 4, [[220, 214, 200], [110, 80, 60]])],
        camera: camera.map_err(|error| error.to_string())?,
        lens: Lens::Perspective(lens.map_err(|error| error.to_string())?),
        behind_the_eye: true,
    })
}
