//! The compared scenes, as plain arrays that all rasterizers draw with the same camera.

mod floor;
mod layers;
mod model;
mod sphere;

pub use floor::floor;
pub use layers::{Order, layers};
pub use model::{assets, helmet};
pub use sphere::sphere;

use camera::Camera;
use homog::{Clip, Projective, World};
use projection::{Convention, Orthographic, Perspective};
use std::ops::Range;

/// The picture's width and height.
pub const SIZE: (u32, u32) = (1920, 1080);

/// The unit direction toward the light.
pub const TOWARDS_LIGHT: [f32; 3] = [0.48, 0.6, 0.64];
/// The fraction of light that comes from all directions; the rest is directional.
pub const AMBIENT: f32 = 0.2;

/// A vertex as stored in the buffers: 32 bytes.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct Vertex {
    /// The position in world space.
    pub position: [f32; 3],
    /// The unit normal in world space.
    pub normal: [f32; 3],
    /// The texture coordinates, with (0, 0) at the first texel.
    pub uv: [f32; 2],
}

/// An 8-bit RGBA image without color conversion or mip maps. It is repeated in both directions and
/// filtered bilinearly.
#[derive(Clone, Debug)]
pub struct Texture {
    /// The number of texels per row.
    pub width: usize,
    /// The number of rows.
    pub height: usize,
    /// The texels, row by row.
    pub rgba: Vec<[u8; 4]>,
}

/// A run of triangles with one material: `tint` × texture × (ambient + Lambert).
#[derive(Clone, Debug)]
pub struct Part {
    /// The range of its indices.
    pub indices: Range<usize>,
    /// The color.
    pub tint: [f32; 3],
    /// Whether it is lit.
    pub lit: bool,
    /// The index of its texture.
    pub texture: Option<usize>,
    /// Whether its back is visible too.
    pub two_sided: bool,
}

/// The projection of a scene.
#[derive(Clone, Copy, Debug)]
pub enum Lens {
    /// A perspective projection.
    Perspective(Perspective),
    /// A parallel projection.
    Parallel(Orthographic),
}

/// A scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The name in reports.
    pub name: &'static str,
    /// A readable description.
    pub about: String,
    /// All vertices.
    pub vertices: Vec<Vertex>,
    /// Three indices per triangle, counter-clockwise as seen from the front.
    pub indices: Vec<u32>,
    /// The parts, in the order of their triangles.
    pub parts: Vec<Part>,
    /// The textures.
    pub textures: Vec<Texture>,
    /// The position and orientation of the eye.
    pub camera: Camera,
    /// The projection.
    pub lens: Lens,
    /// Whether something is behind the eye, so that a rasterizer must clip.
    pub behind_the_eye: bool,
}

impl Scene {
    /// Returns the number of triangles.
    pub fn triangles(&self) -> usize {
        self.indices.len() / 3
    }

    /// Returns the map from the world to clip space in a convention.
    pub fn world_to_clip(&self, convention: Convention) -> Projective<World, Clip> {
        self.camera.world_to_view().then_project(self.view_to_clip(convention))
    }

    /// Returns the projection's matrix in a convention.
    pub fn view_to_clip(&self, convention: Convention) -> Projective<homog::View, Clip> {
        match self.lens {
            Lens::Perspective(lens) => lens.view_to_clip(convention),
            Lens::Parallel(lens) => lens.view_to_clip(convention),
        }
    }
}

/// The factor from a texel's channel to the range from 0 to 1.
pub const TEXTURE_SCALE: f32 = 1.0 / 255.0;

impl Texture {
    /// Creates a checkerboard of two colors with smoothly varying brightness, `size` × `size`
    /// texels in `fields` × `fields` squares.
    pub fn board(size: usize, fields: usize, colors: [[u8; 3]; 2]) -> Self {
        let texel = |n: usize| {
            let (x, y) = (n % size, n / size);
            let [r, g, b] = colors[(x * fields / size + y * fields / size) % 2];
            let shade = |c: u8| (u32::from(c) * (192 + (x * 7 + y * 13) as u32 % 64) / 255) as u8;
            [shade(r), shade(g), shade(b), 255]
        };
        Self { width: size, height: size, rgba: (0..size * size).map(texel).collect() }
    }

    /// Returns the color at texture coordinates, with channels from 0 to 1. The shaders of all Rust
    /// rasterizers use it.
    #[inline]
    pub fn bilinear(&self, [u, v]: [f32; 2]) -> [f32; 3] {
        let (x, y) = (u * self.width as f32 - 0.5, v * self.height as f32 - 0.5);
        let (left, top) = (floor_of(x), floor_of(y));
        let (s, t) = (x - left as f32, y - top as f32);
        let columns = [wrap(left, self.width), wrap(left + 1, self.width)];
        let rows = [wrap(top, self.height), wrap(top + 1, self.height)].map(|y| y * self.width);
        let at = |row: usize, column: usize| self.rgba[rows[row] + columns[column]].map(f32::from);
        let (a, b, c, d) = (at(0, 0), at(0, 1), at(1, 0), at(1, 1));
        [0, 1, 2].map(|k| {
            let upper = a[k] + (b[k] - a[k]) * s;
            let lower = c[k] + (d[k] - c[k]) * s;
            (upper + (lower - upper) * t) * TEXTURE_SCALE
        })
    }
}

/// Returns the largest integer not greater than `x`.
#[inline(always)]
pub fn floor_of(x: f32) -> i32 {
    let cut = x as i32;
    cut - i32::from(cut as f32 > x)
}

/// Returns the texel at index `at` of a repeated row.
#[inline(always)]
pub fn wrap(at: i32, size: usize) -> usize {
    if size.is_power_of_two() {
        return at as usize & (size - 1);
    }
    at.rem_euclid(size as i32) as usize
}

/// Returns the fraction of light that a surface with this normal reflects to the eye.
#[inline(always)]
pub fn light(normal: [f32; 3]) -> f32 {
    let [x, y, z] = normal;
    let squared = x * x + y * y + z * z;
    let [lx, ly, lz] = TOWARDS_LIGHT;
    let cosine = (x * lx + y * ly + z * lz) / squared.sqrt();
    AMBIENT + (1.0 - AMBIENT) * cosine.max(0.0)
}

/// Returns the aspect ratio of the picture.
fn aspect() -> f64 {
    f64::from(SIZE.0) / f64::from(SIZE.1)
}
