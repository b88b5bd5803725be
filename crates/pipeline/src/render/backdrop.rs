//! What is behind everything in a frame: two triangles at the far plane that fill the picture.

use super::RenderError;
use super::assemble::{Assembler, BACKDROP, DEFAULT_MATERIAL};
use crate::scene::ImageSpec;
use homog::PixelRect;
use homog::{Ndc, Point};
use model::Primitive;
use raster::{Cover, Cull, ScreenVertex};
use shade::Painting;
use shade::{Draw, Maps, PLACE, Role, Tangents, Vertex};

/// The corners of the picture in the canonical volume: lower left, lower right, upper right, upper left.
const CORNERS: [(f64, f64); 4] = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];

impl Assembler<'_> {
    /// Adds the environment behind everything.
    pub(super) fn backdrop(&mut self, blur: f32) -> Result<(), RenderError> {
        let clip_to_world = self.stage.world_to_clip.raw().inverse();
        let place = |(x, y): (f64, f64)| {
            let place = clip_to_world * Point::<Ndc>::new(x, y, -1.0).raw().extend(1.0);
            (place.truncate() / place.w).as_vec3().to_array()
        };
        self.behind(Role::Backdrop(blur), CORNERS.map(place), Cover::Solid)
    }

    /// Adds what is painted behind everything. Its corners carry their places in the whole picture.
    pub(super) fn painting(
        &mut self,
        painting: &Painting,
        image: ImageSpec,
    ) -> Result<(), RenderError> {
        let PixelRect { x, y, width, height } = self.memory.sheet.area;
        let part = |at: u32, of: u32| (f64::from(at) / f64::from(of)) as f32;
        let (left, right) = (part(x, image.width), part(x + width, image.width));
        let (top, bottom) = (part(y, image.height), part(y + height, image.height));
        let places =
            [[left, bottom, 0.0], [right, bottom, 0.0], [right, top, 0.0], [left, top, 0.0]];
        let cover = if painting.is_opaque() { Cover::Solid } else { Cover::Translucent };
        self.behind(Role::Painting, places, cover)
    }

    fn behind(
        &mut self,
        role: Role,
        places: [[f32; 3]; 4],
        cover: Cover,
    ) -> Result<(), RenderError> {
        let first_id = self.next_id;
        self.next_id = first_id.checked_add(2).ok_or(RenderError::TooManyPrimitives)?;
        let ndc_to_screen = self.stage.ndc_to_screen;
        // With one w for all of them, what they carry is linear on the screen, as places on a plane across the view are.
        let corners = CORNERS.map(|(x, y)| {
            ScreenVertex::snap(ndc_to_screen.point(Point::<Ndc>::new(x, y, -1.0)), 1.0)
        });
        let vertex = |place: [f32; 3]| {
            let mut vertex: Vertex = [0.0; 8];
            vertex[PLACE..PLACE + 3].copy_from_slice(&place);
            vertex
        };
        let primitive: &'static Primitive = &BACKDROP;
        self.memory.draws.draws.push(Draw {
            first_id,
            part: self.next_part,
            primitive,
            material: &DEFAULT_MATERIAL,
            maps: Maps::default(),
            vertices: places.map(vertex).to_vec(),
            tangents: Tangents::None,
            smooth: false,
            uv_set: None,
            colors: None,
            role,
            mirrored: false,
            scale: 1.0,
        });
        let triangles = primitive.indices.as_chunks::<3>().0;
        self.memory.frame.mesh(&corners, triangles, first_id, cover, Cull::Nothing);
        Ok(())
    }
}
