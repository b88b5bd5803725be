//! The program written with euc.

use crate::scene::{SIZE, Scene};
use euc::{Interpolate, Pipeline, Target, buffer::Buffer2d, rasterizer};

struct Shader<'a>(&'a Scene);

impl Pipeline for Shader<'_> {
    type Vertex = u32;
    type VsOut = Uv;
    type Pixel = [u8; 4];

    #[inline(always)]
    fn vert(&self, index: &u32) -> ([f32; 4], Self::VsOut) {
        let ([x, y, z], m) = (self.0.positions[*index as usize], &self.0.to_clip);
        let clip = [0, 1, 2, 3].map(|k| m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k]);
        (clip, Uv(self.0.uvs[*index as usize]))
    }

    #[inline(always)]
    fn frag(&self, Uv([u, v]): &Self::VsOut) -> [u8; 4] {
        let [r, g, b] = self.0.texel(*u, *v);
        [r, g, b, 255]
    }
}

pub struct Program<'a> {
    scene: &'a Scene,
    color: Buffer2d<[u8; 4]>,
    depth: Buffer2d<f32>,
}

impl<'a> Program<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        let size = [SIZE.0 as usize, SIZE.1 as usize];
        Self { scene, color: Buffer2d::new(size, [0; 4]), depth: Buffer2d::new(size, 1.0) }
    }

    pub fn draw(&mut self) {
        type Triangles<'a> =
            rasterizer::Triangles<'a, Buffer2d<f32>, rasterizer::BackfaceCullingDisabled>;
        self.color.clear([0; 4]);
        self.depth.clear(1.0);
        let indices = self.scene.triangles.as_flattened();
        Shader(self.scene).draw::<Triangles<'_>, _>(
            indices,
            &mut self.color,
            Some(&mut self.depth),
        );
    }

    pub fn pixels(&self) -> &[[u8; 4]] {
        self.color.as_ref()
    }
}

/// The data passed from vertices to pixels.
#[derive(Clone)]
struct Uv([f32; 2]);

impl Interpolate for Uv {
    #[inline(always)]
    fn lerp2(a: Self, b: Self, x: f32, y: f32) -> Self {
        Self([0, 1].map(|k| a.0[k] * x + b.0[k] * y))
    }

    #[inline(always)]
    fn lerp3(a: Self, b: Self, c: Self, x: f32, y: f32, z: f32) -> Self {
        Self([0, 1].map(|k| a.0[k] * x + b.0[k] * y + c.0[k] * z))
    }
}
