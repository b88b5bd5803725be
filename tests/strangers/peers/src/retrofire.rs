//! The program written with retrofire.

use crate::scene::{SIZE, Scene};
use retrofire_core::math::mat::Mat4;
use retrofire_core::prelude::*;
use retrofire_core::render::target::{Colorbuf, Framebuf};
use retrofire_core::render::tex::{TexCoord, uv};
use retrofire_core::render::{Model, View, render, shader};
use retrofire_core::util::pixfmt::Rgba8888;

pub struct Program<'a> {
    scene: &'a Scene,
    vertices: Vec<Vertex3<TexCoord>>,
    triangles: Vec<Tri<usize>>,
    target: Framebuf<Colorbuf<Buf2<[u8; 4]>, Rgba8888>, Buf2<f32>>,
}

impl<'a> Program<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        let places = scene.positions.iter().zip(&scene.uvs);
        let corners = |triangle: &[u32; 3]| triangle.map(|index| index as usize);
        let size = Dims(SIZE.0, SIZE.1);
        Self {
            scene,
            vertices: places.map(|(&[x, y, z], &[u, v])| vertex(pt3(x, y, -z), uv(u, v))).collect(),
            triangles: scene.triangles.iter().map(corners).map(|[a, b, c]| tri(a, b, c)).collect(),
            target: Framebuf {
                color_buf: Colorbuf::new(Buf2::new(size)),
                depth_buf: Buf2::new(size),
            },
        }
    }

    pub fn draw(&mut self) {
        let shader = shader::new(
            |v: Vertex3<TexCoord>, mvp: &ProjMat3<Model>| vertex(mvp.apply(&v.pos), v.attrib),
            |frag: Frag<TexCoord>, _| {
                let [r, g, b] = self.scene.texel(frag.var.u(), frag.var.v());
                rgba(r, g, b, 255)
            },
        );
        let project = perspective(1.5, SIZE.0 as f32 / SIZE.1 as f32, 0.1..100.0);
        let to_project = Mat4::<Model, View>::identity().then(&project);
        let context = Context { face_cull: None, ..Context::default() };
        let viewport = viewport(pt2(0, SIZE.1)..pt2(SIZE.0, 0));
        self.target.color_buf.buf.fill([0; 4]);
        self.target.depth_buf.fill(0.0);
        render(
            &self.triangles,
            &self.vertices,
            &shader,
            &to_project,
            viewport,
            &mut self.target,
            &context,
        );
    }

    pub fn pixels(&self) -> &[[u8; 4]] {
        self.target.color_buf.buf.data()
    }
}
