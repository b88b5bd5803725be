//! Face rasterization: the id of the nearest face in each pixel, from the z-buffer used for
//! pictures.
//!
//! ```text
//!  triangles ─► clip space ─► clip ─► divide, snap ─► Frame ─► visibility buffer of ids
//! ```
//! The drawing check uses the ids to find the face in front, and face fills assign colors to them.
//! Samples are at pixel centers; faces are opaque and visible from both sides.

use super::projector::Projector;
use crate::DrawError;
use clip::{ClipVertex, Volume, clip_triangle};
use glam::DVec3;
use homog::Point;
use raster::{Frame, Opacity, Samples, ScreenVertex};

/// Rasterizes world-space triangles and returns, for each pixel, row by row, the index of the
/// nearest triangle, or `None` if the pixel is empty.
///
/// `size` is the size of the viewport of `projector`.
///
/// # Errors
/// Fails if the image is too large, or if there are more triangles than ids.
pub fn rasterize_faces(
    triangles: impl Iterator<Item = [DVec3; 3]>,
    projector: &Projector,
    [width, height]: [u32; 2],
) -> Result<Vec<Option<u32>>, DrawError> {
    let mut frame = Frame::new(width, height, Samples::One)?;
    let snap = |vertex: ClipVertex| {
        let position = Point::from_raw(projector.project_to_screen(vertex.point)?);
        ScreenVertex::snap(position, vertex.point.w())
    };
    for (index, vertices) in triangles.enumerate() {
        let id = u32::try_from(index).map_err(|_| DrawError::TooManyPrimitives)?;
        let clip = vertices.map(|vertex| projector.world_to_clip_point(vertex));
        for clipped in clip_triangle(clip, &Volume::CHAPTER).triangles() {
            if let [Some(a), Some(b), Some(c)] = clipped.map(snap) {
                frame.add_triangle([a, b, c], id, Opacity::Opaque);
            }
        }
    }
    Ok(frame.visibility_buffer().ids)
}
