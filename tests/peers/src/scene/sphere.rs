//! A bumpy sphere of a million triangles or more, for measuring the cost of geometry.

use super::{Lens, Part, Scene, Vertex, aspect};
use camera::Camera;
use homog::{Point, Vector};
use projection::{Fov, Perspective};
use std::f64::consts::{PI, TAU};

/// Returns a sphere of `rows` × 2 `rows` quads, which are 4 `rows`² triangles. Half of them face
/// away and are skipped unless both sides are drawn.
pub fn sphere(name: &'static str, rows: u32, two_sided: bool) -> Result<Scene, String> {
    let vertices: Vec<Vertex> = (0..=rows)
        .flat_map(|i| (0..=2 * rows).map(move |j| (i, j)))
        .map(|(i, j)| vertex(f64::from(i) / f64::from(rows), f64::from(j) / f64::from(2 * rows)))
        .collect();
    let stride = 2 * rows + 1;
    let quads = (0..rows).flat_map(|i| (0..2 * rows).map(move |j| i * stride + j));
    let indices: Vec<u32> =
        quads.flat_map(|a| [a, a + stride, a + 1, a + 1, a + stride, a + stride + 1]).collect();
    let sides = if two_sided { "double-sided " } else { "" };
    let camera = Camera::look_at(Point::new(1.2, 0.9, 3.4), Point::ORIGIN, Vector::Y);
    let lens = Perspective::new(Fov::vertical_degrees(36.0), aspect(), 1.0, 10.0);
    Ok(Scene {
        name,
        about: format!("A bumpy sphere, {} {sides}triangles, diffuse shading", indices.len() / 3),
        parts: vec![Part {
            indices: 0..indices.len(),
            tint: [0.9, 0.7, 0.5],
            lit: true,
            texture: None,
            two_sided,
        }],
        vertices,
        indices,
        textures: Vec::new(),
        camera: camera.map_err(|error| error.to_string())?,
        lens: Lens::Perspective(lens.map_err(|error| error.to_string())?),
        behind_the_eye: false,
    })
}

/// Returns the vertex at a position in the unit square, where `down` runs from pole to pole and
/// `around` along the equator.
fn vertex(down: f64, around: f64) -> Vertex {
    let step = 1e-4;
    let p = place(down, around);
    let along = |a: [f64; 3]| [0, 1, 2].map(|k| a[k] - p[k]);
    let (a, b) = (along(place(down + step, around)), along(place(down, around + step)));
    let normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let length = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
    // At the poles, the step around has zero length.
    let normal = if length > 1e-12 { normal.map(|c| c / length) } else { p };
    let narrow = |v: [f64; 3]| v.map(|c| c as f32);
    Vertex { position: narrow(p), normal: narrow(normal), uv: [around as f32, down as f32] }
}

fn place(down: f64, around: f64) -> [f64; 3] {
    let (theta, phi) = (down * PI, around * TAU);
    let bumps =
        libm::sin(12.0 * theta) * libm::sin(9.0 * phi) + libm::sin(31.0 * theta + 17.0 * phi) * 0.3;
    let radius = 1.0 + 0.04 * bumps * libm::sin(theta);
    let (sin, cos) = (libm::sin(theta), libm::cos(theta));
    [radius * sin * libm::sin(phi), radius * cos, radius * sin * libm::cos(phi)]
}
