//! What is behind everything in a frame: two triangles at the far plane that fill the picture.

use super::RenderError;
use super::primitive_assembly::{DEFAULT_MATERIAL, PrimitiveAssembler, QUAD};
use crate::scene::ImageSpec;
use homog::PixelRect;
use homog::{Ndc, Point};
use model::Primitive;
use raster::{CullMode, Opacity, ScreenVertex};
use shade::Backdrop;
use shade::{Draw, DrawKind, MaterialTextures, POSITION, Tangents, Vertex};

/// The corners of the picture in the canonical volume: lower left, lower right, upper right, upper left.
const NDC_CORNERS: [(f64, f64); 4] = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];

impl PrimitiveAssembler<'_> {
    /// Adds the environment behind everything.
    pub(super) fn add_environment(&mut self, blur: f32) -> Result<(), RenderError> {
        let clip_to_world = self.transform.world_to_clip.raw().inverse();
        let place = |(x, y): (f64, f64)| {
            let place = clip_to_world * Point::<Ndc>::new(x, y, -1.0).raw().extend(1.0);
            (place.truncate() / place.w).as_vec3().to_array()
        };
        self.add_far_quad(DrawKind::Environment(blur), NDC_CORNERS.map(place), Opacity::Opaque)
    }

    /// Adds what is painted behind everything. Its corners carry their places in the whole picture.
    pub(super) fn add_backdrop(
        &mut self,
        painting: &Backdrop,
        image: ImageSpec,
    ) -> Result<(), RenderError> {
        let PixelRect { x, y, width, height } = self.memory.tile.rect;
        let fraction = |at: u32, of: u32| (f64::from(at) / f64::from(of)) as f32;
        let (left, right) = (fraction(x, image.width), fraction(x + width, image.width));
        let (top, bottom) = (fraction(y, image.height), fraction(y + height, image.height));
        let uvs = [[left, bottom, 0.0], [right, bottom, 0.0], [right, top, 0.0], [left, top, 0.0]];
        let cover = if painting.is_opaque() { Opacity::Opaque } else { Opacity::Translucent };
        self.add_far_quad(DrawKind::Backdrop, uvs, cover)
    }

    fn add_far_quad(
        &mut self,
        role: DrawKind,
        places: [[f32; 3]; 4],
        cover: Opacity,
    ) -> Result<(), RenderError> {
        let first_id = self.next_id;
        self.next_id = first_id.checked_add(2).ok_or(RenderError::TooManyPrimitives)?;
        let ndc_to_screen = self.transform.ndc_to_screen;
        // With one w for all of them, what they carry is linear on the screen, as places on a plane across the view are.
        let corners = NDC_CORNERS.map(|(x, y)| {
            ScreenVertex::snap(ndc_to_screen.transform_point(Point::<Ndc>::new(x, y, -1.0)), 1.0)
        });
        let vertex = |place: [f32; 3]| {
            let mut vertex: Vertex = [0.0; 8];
            vertex[POSITION..POSITION + 3].copy_from_slice(&place);
            vertex
        };
        let primitive: &'static Primitive = &QUAD;
        self.memory.draws.draws.push(Draw {
            first_id,
            part_id: self.next_part_id,
            primitive,
            material: &DEFAULT_MATERIAL,
            textures: MaterialTextures::default(),
            vertices: places.map(vertex).to_vec(),
            tangents: Tangents::None,
            is_smooth: false,
            uv_set: None,
            colors: None,
            kind: role,
            flips_winding: false,
            world_scale: 1.0,
        });
        let triangles = primitive.indices.as_chunks::<3>().0;
        self.memory.frame.add_mesh(&corners, triangles, first_id, cover, CullMode::Nothing);
        Ok(())
    }
}
