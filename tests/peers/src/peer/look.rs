//! The shader of our rasterizer, which computes tint × texture × light for eight fragments at once,
//! like the GLSL shader for llvmpipe.

use crate::scene::{Scene, TEXTURE_SCALE, Texture, Vertex, floor_of, light, wrap};
use raster::{F32x8, Fragment, Fragments, LANES, Surface};

/// A scene, with lookup tables for its triangles.
pub struct Look<'a> {
    pub scene: &'a Scene,
    /// The part number of each triangle.
    parts: Vec<u32>,
}

/// The interpolated values: the normal and the texture coordinates.
const VARYING: usize = 5;

impl<'a> Look<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        let mut parts = vec![0; scene.triangles()];
        for (number, part) in (0..).zip(&scene.parts) {
            parts[part.indices.start / 3..part.indices.end / 3].fill(number);
        }
        Self { scene, parts }
    }

    #[inline(always)]
    fn corners(&self, id: u32) -> [&Vertex; 3] {
        let first = id as usize * 3;
        let at = |k: usize| &self.scene.vertices[self.scene.indices[first + k] as usize];
        [at(0), at(1), at(2)]
    }

    /// Interpolates normals and texture coordinates.
    #[inline(always)]
    fn varying(&self, fragments: &Fragments<'_>) -> [F32x8; VARYING] {
        let mut varying = [[0.0; LANES]; VARYING];
        let weights = fragments.weights().values;
        if fragments.is_single_primitive() {
            let corners = self.corners(fragments.id(0));
            for (corner, weights) in corners.iter().zip(&weights) {
                for (k, value) in carried(corner).into_iter().enumerate() {
                    for lane in 0..LANES {
                        varying[k][lane] += value * weights[lane];
                    }
                }
            }
            return varying;
        }
        let mut gathered = [[[0.0; LANES]; VARYING]; 3];
        for lane in 0..LANES {
            for (corner, gathered) in self.corners(fragments.id(lane)).iter().zip(&mut gathered) {
                for (value, gathered) in carried(corner).into_iter().zip(gathered) {
                    gathered[lane] = value;
                }
            }
        }
        for (corner, weights) in gathered.iter().zip(&weights) {
            for (varying, values) in varying.iter_mut().zip(corner) {
                for lane in 0..LANES {
                    varying[lane] += values[lane] * weights[lane];
                }
            }
        }
        varying
    }
}

#[inline(always)]
fn carried(vertex: &Vertex) -> [f32; VARYING] {
    let ([x, y, z], [u, v]) = (vertex.normal, vertex.uv);
    [x, y, z, u, v]
}

impl Surface for Look<'_> {
    fn passes_alpha_test(&self, _: &Fragment<'_>) -> bool {
        true
    }

    fn shade(&self, _: &Fragment<'_>) -> [f32; 4] {
        unreachable!("colors are requested eight at a time")
    }

    #[inline(always)]
    fn shade_eight(&self, fragments: &Fragments<'_>) -> [F32x8; 4] {
        let part = |lane: usize| self.parts[fragments.id(lane) as usize];
        let first = part(0);
        let mut same = fragments.is_single_primitive();
        if !same {
            same = true;
            for lane in 1..LANES {
                same &= part(lane) == first;
            }
        }
        if same {
            return self.of_part(first, fragments);
        }
        let mut colors = [[0.0; LANES]; 4];
        for lane in 0..LANES {
            let of_lane = self.of_part(part(lane), fragments);
            for (color, of_lane) in colors.iter_mut().zip(&of_lane) {
                color[lane] = of_lane[lane];
            }
        }
        colors
    }
}

impl Look<'_> {
    #[inline(always)]
    fn of_part(&self, number: u32, fragments: &Fragments<'_>) -> [F32x8; 4] {
        let part = &self.scene.parts[number as usize];
        let [r, g, b] = part.tint;
        let mut colors = [[r; LANES], [g; LANES], [b; LANES], [1.0; LANES]];
        if !part.lit && part.texture.is_none() {
            return colors;
        }
        let [x, y, z, u, v] = self.varying(fragments);
        if let Some(texture) = part.texture {
            let texels = bilinear(&self.scene.textures[texture], u, v);
            for (color, texel) in colors.iter_mut().zip(&texels) {
                for lane in 0..LANES {
                    color[lane] *= texel[lane];
                }
            }
        }
        if part.lit {
            for lane in 0..LANES {
                let light = light([x[lane], y[lane], z[lane]]);
                colors[0][lane] *= light;
                colors[1][lane] *= light;
                colors[2][lane] *= light;
            }
        }
        colors
    }
}

/// Evaluates [`Texture::bilinear`] for eight fragments.
#[inline(always)]
fn bilinear(texture: &Texture, u: F32x8, v: F32x8) -> [F32x8; 3] {
    let (width, height) = (texture.width, texture.height);
    let mut shares = [[0.0; LANES]; 2];
    let mut corners = [[0; LANES]; 2];
    for lane in 0..LANES {
        let (x, y) = (u[lane] * width as f32 - 0.5, v[lane] * height as f32 - 0.5);
        corners[0][lane] = floor_of(x);
        corners[1][lane] = floor_of(y);
        shares[0][lane] = x - corners[0][lane] as f32;
        shares[1][lane] = y - corners[1][lane] as f32;
    }
    let mut texels = [[0_u32; LANES]; 4];
    for lane in 0..LANES {
        let (left, top) = (corners[0][lane], corners[1][lane]);
        let (left, right) = (wrap(left, width), wrap(left + 1, width));
        let (top, bottom) = (wrap(top, height) * width, wrap(top + 1, height) * width);
        let places = [top + left, top + right, bottom + left, bottom + right];
        for (texels, place) in texels.iter_mut().zip(places) {
            texels[lane] = u32::from_le_bytes(texture.rgba[place]);
        }
    }
    let mut colors = [[0.0; LANES]; 3];
    for (k, color) in colors.iter_mut().enumerate() {
        for lane in 0..LANES {
            let channel = |corner: usize| (texels[corner][lane] >> (8 * k) & 255) as i32 as f32;
            let (s, t) = (shares[0][lane], shares[1][lane]);
            let upper = channel(0) + (channel(1) - channel(0)) * s;
            let lower = channel(2) + (channel(3) - channel(2)) * s;
            color[lane] = (upper + (lower - upper) * t) * TEXTURE_SCALE;
        }
    }
    colors
}
