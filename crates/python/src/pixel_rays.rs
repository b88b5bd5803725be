//! Pixels and rays: the maps between the world, pixel coordinates and depths of one camera.
//!
//! ```text
//!  world ─► view ─► clip ─► pixel (column, row), depth = −z of view space
//!  pixel, depth ─► x and y of view space, from two equations ─► world
//! ```
//! In pixel coordinates, the center of the upper left pixel is (0, 0), as in OpenCV and array
//! indices. For every projection, depth is measured along the view axis.

use camera::ViewProjection;
use glam::{DMat4, DVec3, DVec4};
use homog::{Affine, Point, View, World};

/// The rays through the pixels of a picture.
pub(crate) struct PixelRays {
    /// The column and row counts.
    pub(crate) size: [usize; 2],
    world_to_view: Affine<World, View>,
    view_to_world: Affine<View, World>,
    view_to_clip: DMat4,
}

impl PixelRays {
    /// Returns the rays of a camera for a given picture size.
    pub(crate) fn new(view_projection: ViewProjection, size: (u32, u32)) -> Self {
        let (width, height) = size;
        Self {
            size: [width as usize, height as usize],
            world_to_view: view_projection.camera.world_to_view(),
            view_to_world: view_projection.camera.view_to_world(),
            view_to_clip: view_projection.view_to_clip.raw(),
        }
    }

    /// Returns the coordinates of all pixels, row by row.
    pub(crate) fn pixels(&self) -> impl Iterator<Item = [f64; 2]> + use<> {
        let [width, height] = self.size;
        (0..height).flat_map(move |row| (0..width).map(move |column| [column as f64, row as f64]))
    }

    /// Returns the pixel coordinates and depth of a world point; the coordinates are NaN for points
    /// that are not in front of the eye.
    pub(crate) fn project(&self, point: [f64; 3]) -> ([f64; 2], f64) {
        let view = self.world_to_view.transform_point(Point::from(point)).raw();
        let clip = self.view_to_clip * view.extend(1.0);
        let [width, height] = self.size.map(|side| side as f64);
        let pixel = if clip.w > 0.0 {
            let (x, y) = (clip.x / clip.w, clip.y / clip.w);
            [0.5 * (x + 1.0) * width - 0.5, 0.5 * (1.0 - y) * height - 0.5]
        } else {
            [f64::NAN; 2]
        };
        (pixel, -view.z)
    }

    /// Returns the view-space point at pixel coordinates and a depth: its x and y satisfy clip.x =
    /// ndc.x · clip.w and clip.y = ndc.y · clip.w.
    fn view_point(&self, [column, row]: [f64; 2], depth: f64) -> DVec3 {
        let [width, height] = self.size.map(|side| side as f64);
        let x = 2.0 * (column + 0.5) / width - 1.0;
        let y = 1.0 - 2.0 * (row + 0.5) / height;
        let rows = self.view_to_clip.transpose();
        let (p, q) = (rows.x_axis - rows.w_axis * x, rows.y_axis - rows.w_axis * y);
        let z = -depth;
        let at_depth = |row: DVec4| -(row.z * z + row.w);
        let (b, c) = (at_depth(p), at_depth(q));
        let determinant = p.x * q.y - p.y * q.x;
        DVec3::new((b * q.y - p.y * c) / determinant, (p.x * c - b * q.x) / determinant, z)
    }

    /// Returns the world point at pixel coordinates and a depth; NaN if the depth is not finite.
    pub(crate) fn point_at(&self, pixel: [f64; 2], depth: f64) -> [f64; 3] {
        if !depth.is_finite() {
            return [f64::NAN; 3];
        }
        let view = Point::<View>::from_raw(self.view_point(pixel, depth));
        self.view_to_world.transform_point(view).raw().to_array()
    }

    /// Returns the distance from the eye to the point at a depth; infinite if the depth is
    /// infinite.
    pub(crate) fn distance(&self, pixel: [f64; 2], depth: f32) -> f32 {
        if !depth.is_finite() {
            return depth;
        }
        self.view_point(pixel, f64::from(depth)).length() as f32
    }

    /// Returns the world-space origin and unit direction of the ray through a pixel. The ray
    /// starts in the plane of the eye and, in perspective, at the eye itself.
    pub(crate) fn ray(&self, pixel: [f64; 2]) -> ([f64; 3], [f64; 3]) {
        let origin = self.point_at(pixel, 0.0);
        let ahead = self.point_at(pixel, 1.0);
        let direction = (DVec3::from(ahead) - DVec3::from(origin)).normalize_or_zero();
        (origin, direction.to_array())
    }
}
