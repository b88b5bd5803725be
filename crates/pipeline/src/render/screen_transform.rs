//! The way from the world to the screen.

use super::RenderError;
use super::image_tiles::ImageTile;
use crate::scene::Scene;
use camera::ViewProjection;
use clip::{Outcode, OutcodeSummary, Volume, clip_segment};
use glam::DVec3;
use homog::{Affine, Clip, HPoint, Model, Ndc, Point, Projective, Screen, World};
use raster::{GUARD_BAND, ScreenVertex};
use viewport::Viewport;

/// The way from the world to the screen.
#[derive(Clone, Copy, Debug)]
pub(super) struct ScreenTransform {
    /// With the sheet of the picture in the whole of the view volume.
    pub(super) world_to_clip: Projective<World, Clip>,
    /// What is kept: the view volume with a guard band.
    pub(super) guard_band: Volume,
    pub(super) ndc_to_screen: Affine<Ndc, Screen>,
    screen_to_ndc: Affine<Screen, Ndc>,
    pub(super) is_mirrored: bool,
}

/// Where a mesh or a part of it is, as far as the box around its vertices tells.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Containment {
    /// All of it is inside of the view volume and its guard band.
    Inside,
    /// All of it is outside of the view volume.
    Outside,
    /// Vertices must be looked at one by one.
    Intersecting,
}

impl ScreenTransform {
    pub(super) fn for_tile(scene: &Scene, sheet: ImageTile) -> Result<Self, RenderError> {
        let mut stage = Self::new(&scene.view_projection, sheet.rect.width, sheet.rect.height)?;
        stage.world_to_clip = sheet.world_to_clip(scene)?;
        Ok(stage)
    }

    /// The way to a picture of this size.
    pub(super) fn new(
        view_projection: &ViewProjection,
        width: u32,
        height: u32,
    ) -> Result<Self, RenderError> {
        let viewport = Viewport::image(width, height)?;
        // Clip only what would leave the rasteriser's grid, with a pixel to spare: its tiles cut the rest (CL-4).
        let band = |side: u32| {
            let half = 0.5 * f64::from(side);
            (1.0 - (GUARD_BAND.start() + 1.0) / half).clamp(1.0, Volume::MAX_GUARD_BAND)
        };
        let volume = Volume::CHAPTER;
        let volume = volume.with_guard_band(band(width), band(height)).unwrap_or(volume);
        Ok(Self {
            world_to_clip: view_projection.world_to_clip(),
            guard_band: volume,
            ndc_to_screen: viewport.ndc_to_screen(),
            screen_to_ndc: viewport.screen_to_ndc(),
            is_mirrored: view_projection.is_mirrored(),
        })
    }

    /// From a model to clip space.
    pub(super) fn model_to_clip(
        &self,
        model_to_world: Affine<Model, World>,
    ) -> Projective<Model, Clip> {
        model_to_world.then_project(self.world_to_clip)
    }

    /// Where what is in a box is, by the box's least and greatest coordinates. Boxes are convex, and stay so on the way to clip
    /// space.
    pub(super) fn classify_bounds(
        &self,
        model_to_clip: Projective<Model, Clip>,
        bounds: [[f32; 3]; 2],
    ) -> Containment {
        let corner = |number: usize, axis: usize| bounds[number >> axis & 1][axis];
        let corners: [[f32; 3]; 8] = std::array::from_fn(|n| [0, 1, 2].map(|axis| corner(n, axis)));
        // Corners that are not finite are outside of all planes, which says nothing of what is between them.
        if !corners.iter().flatten().all(|c| c.abs() < 1e30) {
            return Containment::Intersecting;
        }
        if self.project_corners(&self.guard_band, model_to_clip, &corners).is_inside() {
            return Containment::Inside;
        }
        let is_outside =
            self.project_corners(&Volume::CHAPTER, model_to_clip, &corners).is_outside();
        if is_outside { Containment::Outside } else { Containment::Intersecting }
    }

    fn project_corners(
        &self,
        volume: &Volume,
        model_to_clip: Projective<Model, Clip>,
        corners: &[[f32; 3]; 8],
    ) -> OutcodeSummary {
        let mut points = corners.map(|_| HPoint::new(0.0, 0.0, 0.0, 1.0));
        volume.project_positions(model_to_clip, corners, &mut points, &mut [Outcode::INSIDE; 8])
    }

    /// The visible part of a line; `None` if there is none.
    pub(super) fn clip_line(&self, ends: [HPoint<Clip>; 2]) -> Option<clip::ClippedSegment> {
        clip_segment(ends[0], ends[1], &self.guard_band)
    }

    /// From pixels back to the canonical volume.
    pub(super) fn screen_to_ndc(&self) -> Affine<Screen, Ndc> {
        self.screen_to_ndc
    }

    /// The divide and the viewport.
    pub(super) fn project_to_screen(&self, point: HPoint<Clip>) -> Option<Point<Screen>> {
        Some(self.ndc_to_screen.transform_point(point.divide()?))
    }

    #[inline]
    pub(super) fn snap_vertex(&self, point: HPoint<Clip>) -> Option<ScreenVertex> {
        ScreenVertex::snap(self.project_to_screen(point)?, point.w())
    }

    pub(super) fn snap_vertices<const N: usize>(
        &self,
        points: [HPoint<Clip>; N],
    ) -> Option<[ScreenVertex; N]> {
        all_vertices(points.map(|point| self.snap_vertex(point)))
    }
}

/// All vertices of a primitive, if none is missing.
#[inline]
pub(super) fn all_vertices<const N: usize>(
    vertices: [Option<ScreenVertex>; N],
) -> Option<[ScreenVertex; N]> {
    let mut complete = [vertices[0]?; N];
    for (place, vertex) in complete.iter_mut().zip(vertices) {
        *place = vertex?;
    }
    Some(complete)
}

pub(super) fn model_point(position: [f32; 3]) -> Point<Model> {
    Point::from_raw(DVec3::from_array(position.map(f64::from)))
}
