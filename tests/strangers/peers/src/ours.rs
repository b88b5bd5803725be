//! The program written with this rasterizer.

use crate::scene::{SIZE, Scene};
use raster::homog::{ClipRange, Projective, View};
use raster::{Frame, Samples, ScreenProjection, SourceMesh, VertexAttribute, surface_fn};

pub struct Program<'a> {
    scene: &'a Scene,
    threads: usize,
    frame: Frame,
    pixels: Vec<[u8; 4]>,
}

impl<'a> Program<'a> {
    pub fn new(scene: &'a Scene, threads: usize) -> Self {
        let frame = Frame::new(SIZE.0, SIZE.1, Samples::One).expect("pixels").with_threads(threads);
        Self { scene, threads, frame, pixels: vec![[0; 4]; (SIZE.0 * SIZE.1) as usize] }
    }

    pub fn draw(&mut self) {
        let Scene { positions, triangles, uvs, .. } = self.scene;
        let screen =
            ScreenProjection::for_image(SIZE.0, SIZE.1, ClipRange::OPENGL).expect("pixels");
        let to_clip = Projective::<View, _>::from_column_major_f32(self.scene.to_clip);
        self.frame.clear();
        self.frame.add_clipped_mesh(&screen, to_clip, SourceMesh::new(positions, triangles));

        let uv = VertexAttribute::new(triangles, uvs);
        let surface = surface_fn(|fragment| {
            let [u, v] = uv.at(fragment);
            let [r, g, b] = self.scene.texel(u, v).map(f32::from);
            [r, g, b, 255.0]
        });
        let encode = |color: [f32; 4]| color.map(|channel| channel as u8);
        self.frame.draw(&surface, [0.0; 4], self.threads, &mut self.pixels, encode);
    }

    pub fn pixels(&self) -> &[[u8; 4]] {
        &self.pixels
    }
}
