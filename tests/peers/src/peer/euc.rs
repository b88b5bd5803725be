//! euc 0.5, a rasterizer in Rust. It uses float edges, tests every pixel of a bounding box, and
//! does not clip.

use super::{AREA, Peer, Quantized};
use crate::scene::{Part, SIZE, Scene, Texture, light};
use ::raster::Encode as _;
use euc::buffer::Buffer2d;
use euc::rasterizer::{BackfaceCullingDisabled, BackfaceCullingEnabled, Triangles};
use euc::{Interpolate, Pipeline, Target};
use projection::Convention;

/// The euc rasterizer with a scene.
pub struct Euc<'a> {
    scene: &'a Scene,
    world_to_clip: [[f32; 4]; 4],
    color: Buffer2d<[u8; 4]>,
    depth: Buffer2d<f32>,
}

impl<'a> Euc<'a> {
    /// Creates the rasterizer with one sample and one thread, because it supports no more.
    pub fn new(scene: &'a Scene) -> Self {
        let size = [SIZE.0 as usize, SIZE.1 as usize];
        let matrix = scene.world_to_clip(Convention::OPENGL).raw().as_mat4();
        Self {
            scene,
            world_to_clip: matrix.to_cols_array_2d(),
            color: Buffer2d::new(size, [0; 4]),
            depth: Buffer2d::new(size, 1.0),
        }
    }

    fn part<const LIT: bool, const TEXTURED: bool>(&mut self, part: &Part) {
        let textures = &self.scene.textures;
        let shader: Shader<'_, LIT, TEXTURED> = Shader {
            scene: self.scene,
            part,
            texture: part.texture.map(|texture| &textures[texture]),
            world_to_clip: self.world_to_clip,
        };
        let indices = &self.scene.indices[part.indices.clone()];
        let (color, depth) = (&mut self.color, Some(&mut self.depth));
        if part.two_sided {
            shader.draw::<Triangles<'_, _, BackfaceCullingDisabled>, _>(indices, color, depth);
        } else {
            shader.draw::<Triangles<'_, _, BackfaceCullingEnabled>, _>(indices, color, depth);
        }
    }
}

impl Peer for Euc<'_> {
    fn name(&self) -> String {
        "euc 0.5".into()
    }

    fn is_comparable(&self) -> bool {
        true
    }

    fn draw(&mut self) {
        self.color.clear([0; 4]);
        self.depth.clear(1.0);
        for part in &self.scene.parts {
            match (part.lit, part.texture.is_some()) {
                (false, false) => self.part::<false, false>(part),
                (false, true) => self.part::<false, true>(part),
                (true, false) => self.part::<true, false>(part),
                (true, true) => self.part::<true, true>(part),
            }
        }
    }

    fn pixels(&mut self) -> Vec<[u8; 4]> {
        debug_assert_eq!(self.color.as_ref().len(), AREA);
        self.color.as_ref().to_vec()
    }
}

struct Shader<'a, const LIT: bool, const TEXTURED: bool> {
    scene: &'a Scene,
    part: &'a Part,
    texture: Option<&'a Texture>,
    world_to_clip: [[f32; 4]; 4],
}

/// The data passed from vertices to pixels.
#[derive(Clone)]
struct Carried {
    normal: [f32; 3],
    uv: [f32; 2],
}

impl Interpolate for Carried {
    #[inline(always)]
    fn lerp2(a: Self, b: Self, x: f32, y: f32) -> Self {
        Self::lerp3(a.clone(), b, a, x, y, 0.0)
    }

    #[inline(always)]
    fn lerp3(a: Self, b: Self, c: Self, x: f32, y: f32, z: f32) -> Self {
        Self {
            normal: [0, 1, 2].map(|k| a.normal[k] * x + b.normal[k] * y + c.normal[k] * z),
            uv: [0, 1].map(|k| a.uv[k] * x + b.uv[k] * y + c.uv[k] * z),
        }
    }
}

impl<const LIT: bool, const TEXTURED: bool> Pipeline for Shader<'_, LIT, TEXTURED> {
    type Vertex = u32;
    type VsOut = Carried;
    type Pixel = [u8; 4];

    #[inline(always)]
    fn vert(&self, index: &u32) -> ([f32; 4], Carried) {
        let vertex = &self.scene.vertices[*index as usize];
        let ([x, y, z], m) = (vertex.position, &self.world_to_clip);
        let clip = [0, 1, 2, 3].map(|k| m[0][k] * x + m[1][k] * y + m[2][k] * z + m[3][k]);
        (clip, Carried { normal: vertex.normal, uv: vertex.uv })
    }

    #[inline(always)]
    fn frag(&self, carried: &Carried) -> [u8; 4] {
        let mut color = self.part.tint;
        if let Some(texture) = self.texture.filter(|_| TEXTURED) {
            let texel = texture.bilinear(carried.uv);
            color = [0, 1, 2].map(|k| color[k] * texel[k]);
        }
        if LIT {
            let light = light(carried.normal);
            color = color.map(|channel| channel * light);
        }
        Quantized.encode_pixel([color[0], color[1], color[2], 1.0])
    }
}
