//! Flat shading of faces under the lines: a fixed key light, and a z-buffer image of flat colors.
//!
//! A flat fill is an image rather than a set of vector fills. Faces that overlap cyclically or
//! intersect cannot be painted in any order (the painter's algorithm fails); their visible parts
//! would have to be cut out. A z-buffer resolves visibility at several times the resolution of the
//! drawing, and the exact lines are drawn over it.

use super::FaceFill;
use super::gray_fill::gray_pixel;
use camera::ViewProjection;
use glam::DVec3;
use hidden_line::{DrawError, Projector, rasterize_faces};
use homog::{ClipRange, Vector, View};
use picture::Picture;
use shade::color::SrgbEncoder;
use viewport::Viewport;

/// The ambient fraction of the light; the key light adds the rest.
const AMBIENT_LIGHT: f64 = 0.35;

/// The maximum side length of a fill image in pixels.
const MAX_FILL_SIDE: f64 = 8192.0;

/// Options for the fill of faces under the lines of a drawing.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct FillOptions {
    /// The kind of fill. Default: none.
    pub face_fill: FaceFill,
    /// Fill-image pixels per drawing pixel. Default: 3, or 6 for a gray fill.
    pub scale: f64,
}

impl Default for FillOptions {
    fn default() -> Self {
        Self::new(FaceFill::None)
    }
}

impl FillOptions {
    /// Returns options for a fill of this kind at the resolution it requires.
    #[must_use]
    pub fn new(face_fill: FaceFill) -> Self {
        // Borders of gray areas must stay hidden under the lines, which are at least a pixel wide.
        Self { face_fill, scale: if face_fill == FaceFill::Gray { 6.0 } else { 3.0 } }
    }
}

/// A directional light from above the viewer's left shoulder, fixed to the camera.
#[derive(Clone, Copy, Debug)]
pub(super) struct KeyLight {
    /// The unit vector toward the light, in world space.
    direction: DVec3,
    /// Provides the direction to the viewer, so that a face is lit on its visible side.
    projector: Projector,
}

impl KeyLight {
    /// Returns the key light for a camera.
    pub(super) fn new(view_projection: &ViewProjection, projector: Projector) -> Self {
        let towards = Vector::<View>::new(-0.5, 0.7, 0.6);
        let direction = view_projection
            .camera
            .view_to_world()
            .transform_vector(towards)
            .raw()
            .normalize_or_zero();
        Self { direction, projector }
    }

    /// Returns the linear color of a face by Lambert's cosine law: base color · (ambient + (1 −
    /// ambient) · max(n·l, 0)).
    pub(super) fn shade_face(&self, [a, b, c]: [DVec3; 3], surface: [f32; 3]) -> [f32; 3] {
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let normal = normal * normal.dot(self.projector.towards_viewer(a)).signum();
        let light = AMBIENT_LIGHT + (1.0 - AMBIENT_LIGHT) * normal.dot(self.direction).max(0.0);
        surface.map(|channel| (f64::from(channel) * light) as f32)
    }

    /// Returns the luma of the shaded face, from 0 for black to 1 for white: Rec. 709 weights on
    /// sRGB-encoded channels.
    ///
    /// Hatching compares the luma with thresholds. Equal steps between encoded values look nearly
    /// equal; equal steps between linear values do not.
    pub(super) fn face_luma(&self, vertices: [DVec3; 3], surface: [f32; 3]) -> f64 {
        let [r, g, b] = self.shade_face(vertices, surface);
        let code = SrgbEncoder::shared().encode_pixel([r, g, b, 1.0]);
        let [r, g, b, _] = code.map(f64::from);
        (r * 0.2126 + g * 0.7152 + b * 0.0722) / 255.0
    }
}

/// Renders each face in one flat color, or in the gray of its material. Returns an image that is
/// transparent outside the visible faces, or `None` if the fill is of another kind or there are no
/// faces.
///
/// Each face comes with the linear color of its material, or `None` for section caps, which are
/// white or, in gray fills, blank. The image has `fill.scale` pixels per drawing pixel, but no side
/// is longer than [`MAX_FILL_SIDE`]. It is not filtered, because its pixels are finer than the
/// output pixels.
///
/// # Errors
/// Fails if the image has no valid viewport or if there are more faces than ids.
pub(super) fn rasterize_fill(
    faces: impl Iterator<Item = ([DVec3; 3], Option<[f32; 3]>)>,
    view_projection: &ViewProjection,
    size: [u32; 2],
    fill: &FillOptions,
) -> Result<Option<Picture>, DrawError> {
    let mut faces = faces.peekable();
    let is_image = matches!(fill.face_fill, FaceFill::Flat | FaceFill::Gray);
    if !is_image || faces.peek().is_none() {
        return Ok(None);
    }
    let longest = f64::from(size[0].max(size[1]));
    let scale = fill.scale.min(MAX_FILL_SIDE / longest);
    let [width, height] = size.map(|side| (f64::from(side) * scale).ceil().max(1.0) as u32);
    let projector =
        Projector::new(view_projection, &Viewport::image_for(width, height, ClipRange::CHAPTER)?);
    let key_light = KeyLight::new(view_projection, projector);
    let is_gray = fill.face_fill == FaceFill::Gray;
    let mut colors: Vec<[u8; 4]> = Vec::new();
    let triangles = faces.map(|(vertices, surface)| {
        colors.push(if is_gray {
            gray_pixel(surface)
        } else {
            let [r, g, b] = key_light.shade_face(vertices, surface.unwrap_or([1.0; 3]));
            SrgbEncoder::shared().encode_pixel([r, g, b, 1.0])
        });
        vertices
    });
    let ids = rasterize_faces(triangles, &projector, [width, height])?;
    let pixels = ids.into_iter().map(|id| id.map_or([0; 4], |id| colors[id as usize])).collect();
    Ok(Some(Picture { width, height, pixels }))
}
