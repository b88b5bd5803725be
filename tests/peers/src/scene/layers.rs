//! Full-screen layers, one behind another, for measuring the cost of overdraw.

use super::{Lens, Part, SIZE, Scene, Texture, Vertex};
use camera::Camera;
use homog::{Point, Vector};
use projection::Orthographic;

/// The order in which the layers are drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Order {
    /// The farthest layer first, so that every layer is visible until the next layer hides it.
    BackToFront,
    /// The nearest layer first, so that all others are hidden.
    FrontToBack,
}

/// Returns `count` layers, each with two triangles and one color. If `textured` is set, each also
/// has a texture of 256 × 256 texels.
pub fn layers(
    name: &'static str,
    count: usize,
    order: Order,
    textured: bool,
) -> Result<Scene, String> {
    let (width, height) = (SIZE.0 as f32 / 2.0, SIZE.1 as f32 / 2.0);
    let mut vertices = Vec::new();
    let mut indices = Vec::new();
    let mut parts = Vec::new();
    for layer in 0..count {
        let away = if order == Order::BackToFront { count - layer } else { layer + 1 };
        let first = vertices.len() as u32;
        for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            // The layers are slightly tilted, so that depth must be interpolated.
            let z = -(away as f32) - 0.2 * x;
            // There is about one texel per pixel, slightly offset, so that all four surrounding
            // texels contribute to each pixel.
            let uv = [x * 0.97 * width / 256.0, y * 0.97 * height / 256.0];
            vertices.push(Vertex { position: [x, y, z], normal: [0.0, 0.0, 1.0], uv });
        }
        let begin = indices.len();
        indices.extend([0, 1, 2, 0, 2, 3].map(|k| first + k));
        let share = away as f32 / count as f32;
        parts.push(Part {
            indices: begin..indices.len(),
            tint: [share, 1.0 - share, 0.25 + 0.5 * share],
            lit: false,
            texture: textured.then_some(0),
            two_sided: false,
        });
    }
    let towards = if order == Order::BackToFront { "back to front" } else { "front to back" };
    let look = if textured { "textured" } else { "flat" };
    let far = count as f64 + 2.0;
    let lens = Orthographic::new(-1.0, 1.0, -1.0, 1.0, 0.5, far);
    let camera = Camera::look_at(Point::ORIGIN, Point::new(0.0, 0.0, -1.0), Vector::Y);
    Ok(Scene {
        name,
        about: format!("{count} full-screen layers, {towards}, {look}"),
        vertices,
        indices,
        parts,
        textures: vec![Texture::board(256, 8, [[240, 230, 210], [90, 120, 170]])],
        camera: camera.map_err(|error| error.to_string())?,
        lens: Lens::Parallel(lens.map_err(|error| error.to_string())?),
        behind_the_eye: false,
    })
}
