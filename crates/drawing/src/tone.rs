//! Tones of faces: how light each would be in a fixed light, for hatching and for flat tones under the lines.
//!
//! A flat tone is a picture, not a drawing: faces that overlap in a circle, or cross, cannot be painted one after the other in
//! any order, and what is seen of each would have to be cut out. So the z-buffer paints them, finer than any screen shows, and
//! the exact lines go over it.

use super::options::Options;
use super::sight::Sight;
use crate::DrawError;
use camera::ViewProjection;
use clip::{ClipVertex, Volume, clip_triangle};
use glam::DVec3;
use homog::{Point, Vector, View};
use raster::{Cover, Frame, Samples, ScreenVertex};
use shade::Picture;
use shade::color::SrgbEncoder;
use viewport::Viewport;

/// The light that is everywhere; the rest comes from the side.
const AMBIENT: f64 = 0.35;

/// The longest side of a picture of tones in pixels.
const LONGEST: f64 = 8192.0;

/// The light from above the viewer's left shoulder.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lamp {
    towards: DVec3,
    sight: Sight,
}

impl Lamp {
    pub(super) fn of(view_projection: &ViewProjection, sight: Sight) -> Self {
        let towards = Vector::<View>::new(-0.5, 0.7, 0.6);
        let towards =
            view_projection.camera.view_to_world().vector(towards).raw().normalize_or_zero();
        Self { towards, sight }
    }

    /// The linear colour of a face whose surface has this one. Both of its sides are lit as the one that is seen.
    pub(super) fn color(&self, [a, b, c]: [DVec3; 3], surface: [f32; 3]) -> [f32; 3] {
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let normal = normal * normal.dot(self.sight.towards_viewer(a)).signum();
        let light = AMBIENT + (1.0 - AMBIENT) * normal.dot(self.towards).max(0.0);
        surface.map(|channel| (f64::from(channel) * light) as f32)
    }

    /// How light such a face looks, from 0 for black to 1 for white.
    pub(super) fn tone(&self, corners: [DVec3; 3], surface: [f32; 3]) -> f64 {
        let [r, g, b] = self.color(corners, surface);
        let code = SrgbEncoder::shared().pixel([r, g, b, 1.0]);
        let [r, g, b, _] = code.map(f64::from);
        (r * 0.2126 + g * 0.7152 + b * 0.0722) / 255.0
    }
}

/// Faces painted in one tone each: a picture of what is seen of them, transparent where there is none.
///
/// # Errors
/// If the picture cannot be made.
pub(super) fn painted(
    faces: impl Iterator<Item = ([DVec3; 3], [f32; 3])>,
    view_projection: &ViewProjection,
    size: [u32; 2],
    options: &Options,
) -> Result<Picture, DrawError> {
    let longest = f64::from(size[0].max(size[1]));
    let scale = options.tone_scale.min(LONGEST / longest);
    let [width, height] = size.map(|side| (f64::from(side) * scale).ceil().max(1.0) as u32);
    let sight = Sight::new(view_projection, &Viewport::image(width, height)?);
    let lamp = Lamp::of(view_projection, sight);
    let mut frame = Frame::new(width, height, Samples::One)?;
    let mut codes: Vec<[u8; 4]> = Vec::new();
    for (corners, surface) in faces {
        let id = u32::try_from(codes.len()).map_err(|_| DrawError::TooManyPrimitives)?;
        let [r, g, b] = lamp.color(corners, surface);
        codes.push(SrgbEncoder::shared().pixel([r, g, b, 1.0]));
        let clip = corners.map(|corner| sight.project(corner));
        for piece in clip_triangle(clip, &Volume::CHAPTER).triangles() {
            let snap = |vertex: ClipVertex| {
                let place = Point::from_raw(sight.place(vertex.point)?);
                ScreenVertex::snap(place, vertex.point.w())
            };
            if let [Some(p), Some(q), Some(r)] = piece.map(snap) {
                frame.triangle([p, q, r], id, Cover::Solid);
            }
        }
    }
    let seen = frame.visibility().ids.into_iter();
    let pixels = seen.map(|id| id.map_or([0; 4], |id| codes[id as usize])).collect();
    Ok(Picture { width, height, pixels })
}
