//! The background of a frame: an environment or a backdrop, drawn as two triangles that fill the
//! picture behind everything else.
//!
//! Both are ordinary draw calls at the minimum depth, so translucent surfaces blend over them and
//! only visible fragments are shaded. The depth of the far plane would not suffice, because the
//! ground may extend beyond that plane.
//!
//! | kind | vertices carry | shading |
//! | --- | --- | --- |
//! | environment | positions on the far plane, pixel coordinates | radiance along the direction from the eye, optionally blurred |
//! | backdrop | fractions of the picture | color, gradient or image |

use super::RenderError;
use super::primitive_assembly::{DEFAULT_MATERIAL, PrimitiveAssembler, QUAD};
use homog::{Ndc, PixelRect, Point};
use model::Primitive;
use raster::{CullMode, Opacity, ScreenVertex};
use scene::ImageSpec;
use shade::{Backdrop, Draw, DrawKind, MaterialTextures, POSITION, Tangents, UV, Vertex};

/// The corners of the picture in NDC: lower left, lower right, upper right, upper left.
const NDC_CORNERS: [(f64, f64); 4] = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];

impl PrimitiveAssembler<'_> {
    /// Adds the environment behind everything, blurred by `blur` from 0 to 1. The vertices carry
    /// world positions, from which shading derives directions.
    pub(super) fn add_environment(&mut self, blur: f32) -> Result<(), RenderError> {
        let clip_to_world = self.transform.world_to_clip().raw().inverse();
        let unproject = |(x, y): (f64, f64)| {
            let corner = clip_to_world * Point::<Ndc>::new(x, y, -1.0).raw().extend(1.0);
            (corner.truncate() / corner.w).as_vec3().to_array()
        };
        let corners = NDC_CORNERS.map(unproject);
        let PixelRect { x, y, width, height } = self.memory.tile.rect;
        let [left, top, right, bottom] = [x, y, x + width, y + height].map(|side| side as f32);
        let pixels = [[left, bottom], [right, bottom], [right, top], [left, top]];
        self.add_screen_quad(DrawKind::Environment(blur), corners, pixels, Opacity::Opaque)
    }

    /// Adds a backdrop. The vertices carry fractions of the whole picture's width and height, so
    /// adjacent image tiles match.
    pub(super) fn add_backdrop(
        &mut self,
        backdrop: &Backdrop,
        image: ImageSpec,
    ) -> Result<(), RenderError> {
        let PixelRect { x, y, width, height } = self.memory.tile.rect;
        let fraction = |at: u32, side: u32| (f64::from(at) / f64::from(side)) as f32;
        let (left, right) = (fraction(x, image.width), fraction(x + width, image.width));
        let (top, bottom) = (fraction(y, image.height), fraction(y + height, image.height));
        let uvs = [[left, bottom, 0.0], [right, bottom, 0.0], [right, top, 0.0], [left, top, 0.0]];
        let opacity = if backdrop.is_opaque() { Opacity::Opaque } else { Opacity::Translucent };
        self.add_screen_quad(DrawKind::Backdrop, uvs, [[0.0; 2]; 4], opacity)
    }

    /// Adds a rectangle that fills the picture at the minimum depth, with a position and texture
    /// coordinates at each corner.
    fn add_screen_quad(
        &mut self,
        kind: DrawKind,
        positions: [[f32; 3]; 4],
        uvs: [[f32; 2]; 4],
        opacity: Opacity,
    ) -> Result<(), RenderError> {
        let first_id = self.next_id;
        self.next_id = first_id.checked_add(2).ok_or(RenderError::TooManyPrimitives)?;
        let ndc_to_screen = self.transform.ndc_to_screen();
        // With w = 1 at all corners the attributes are linear on the screen, as are positions on a
        // plane parallel to the picture.
        let corners = NDC_CORNERS.map(|(x, y)| {
            let corner = ndc_to_screen.transform_point(Point::<Ndc>::new(x, y, -1.0));
            let least_depth = -f64::from(raster::MAX_DEPTH);
            ScreenVertex::snap(Point::new(corner.x(), corner.y(), least_depth), 1.0)
        });
        let vertex = |(position, uv): ([f32; 3], [f32; 2])| {
            let mut vertex: Vertex = [0.0; 8];
            vertex[POSITION..POSITION + 3].copy_from_slice(&position);
            vertex[UV..].copy_from_slice(&uv);
            vertex
        };
        let primitive: &'static Primitive = &QUAD;
        self.memory.draws.draws.push(Draw {
            first_id,
            part_id: self.next_part_id,
            primitive,
            material: &DEFAULT_MATERIAL,
            textures: MaterialTextures::default(),
            vertices: positions.into_iter().zip(uvs).map(vertex).collect(),
            tangents: Tangents::None,
            is_smooth: false,
            uv_set: None,
            colors: None,
            kind,
            flips_winding: false,
            world_scale: 1.0,
        });
        let triangles = primitive.indices.as_chunks::<3>().0;
        self.memory.frame.add_mesh(&corners, triangles, first_id, opacity, CullMode::Nothing);
        Ok(())
    }
}
