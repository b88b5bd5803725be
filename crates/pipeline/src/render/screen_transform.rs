//! The view transform of one image tile or shadow map, with its guard band.
//!
//! ```text
//!  Model ──model_to_clip──► Clip ──clip against near, far, guard band──► ÷ w ──viewport──► snap
//! ```
//!
//! Triangles are not clipped against the sides of the view volume, but against a *guard band* far
//! outside it (CL-4). The rasterizer's tiles discard anything in between. Only the near and far
//! planes and the limits of the rasterizer's fixed-point grid need geometric clipping.

use super::RenderError;
use super::image_tiles::ImageTile;
use camera::{ViewProjection, ViewTransform};
use clip::{Outcode, OutcodeSummary, Volume};
use glam::{DMat4, DVec3, DVec4, Vec3};
use homog::{Affine, Clip, ClipRange, HPoint, Model, Ndc, Point, Projective, Screen, World};
use raster::ScreenProjection;
use scene::Scene;
use viewport::Viewport;

/// The transform world → clip → screen for one raster, and the volume that geometry is clipped
/// against.
#[derive(Clone, Copy, Debug)]
pub(super) struct ScreenTransform {
    /// World to clip space. For an image tile, the tile fills the view volume.
    view: ViewTransform,
    /// Clipping against the near and far planes and the guard band, divide, viewport and snapping.
    pub(super) screen: ScreenProjection,
    /// The inverse viewport transform.
    screen_to_ndc: Affine<Screen, Ndc>,
    /// Whether the projection mirrors the picture, which reverses the winding of triangles.
    pub(super) is_mirrored: bool,
}

/// The result of frustum culling a bounding box.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Containment {
    /// Inside the guard band and between the near and far planes: nothing needs clipping.
    Inside,
    /// Outside one plane of the view volume: nothing is visible.
    Outside,
    /// Undecided: vertices must be tested individually.
    Intersecting,
}

impl ScreenTransform {
    /// Creates the transform for an image tile.
    pub(super) fn for_tile(scene: &Scene, tile: ImageTile) -> Result<Self, RenderError> {
        let whole = Self::new(&scene.view_projection, tile.rect.width, tile.rect.height)?;
        let (ndc_to_screen, viewer) = (whole.view.ndc_to_screen(), whole.view.viewer());
        let world_to_clip = tile.world_to_clip(scene)?;
        let view = ViewTransform::with_world_to_clip(world_to_clip, ndc_to_screen, viewer);
        Ok(Self { view, ..whole })
    }

    /// Creates the transform for a raster of `width` × `height` pixels that shows the whole view
    /// volume.
    pub(super) fn new(
        view_projection: &ViewProjection,
        width: u32,
        height: u32,
    ) -> Result<Self, RenderError> {
        let viewport = Viewport::image_for(width, height, ClipRange::CHAPTER)?;
        Ok(Self {
            view: ViewTransform::new(view_projection, viewport.ndc_to_screen()),
            screen: ScreenProjection::new(&viewport),
            screen_to_ndc: viewport.screen_to_ndc(),
            is_mirrored: view_projection.is_mirrored(),
        })
    }

    /// Returns the transform from world to clip space, in which the tile fills the view volume.
    pub(super) fn world_to_clip(&self) -> Projective<World, Clip> {
        self.view.world_to_clip()
    }

    /// Returns the viewport transform.
    pub(super) fn ndc_to_screen(&self) -> Affine<Ndc, Screen> {
        self.view.ndc_to_screen()
    }

    /// Returns the inverse viewport transform, from pixels back to the canonical volume.
    pub(super) fn screen_to_ndc(&self) -> Affine<Screen, Ndc> {
        self.screen_to_ndc
    }

    /// Returns the transform from the world to pixels and depth as one matrix, before the divide.
    pub(super) fn world_to_screen(&self) -> DMat4 {
        self.view.world_to_screen().raw()
    }

    /// Returns the model-view-projection matrix, from model to clip space.
    pub(super) fn model_to_clip(
        &self,
        model_to_world: Affine<Model, World>,
    ) -> Projective<Model, Clip> {
        model_to_world.then_project(self.view.world_to_clip())
    }

    /// Tests a box, given by its minimum and maximum coordinates, for frustum culling.
    ///
    /// Testing the eight corners is enough: a box stays convex in clip space, so if all corners are
    /// on one side of a plane, the whole box is too.
    pub(super) fn classify_bounds(
        &self,
        model_to_clip: Projective<Model, Clip>,
        bounds: [[f32; 3]; 2],
    ) -> Containment {
        let coordinate = |corner: usize, axis: usize| bounds[corner >> axis & 1][axis];
        let corners: [[f32; 3]; 8] =
            std::array::from_fn(|corner| [0, 1, 2].map(|axis| coordinate(corner, axis)));
        // Corners at infinity are always outside all planes.
        if !corners.iter().flatten().all(|c| c.abs() < 1e30) {
            return Containment::Intersecting;
        }
        if summarize_outcodes(self.screen.volume(), model_to_clip, &corners).is_inside() {
            return Containment::Inside;
        }
        match summarize_outcodes(&Volume::CHAPTER, model_to_clip, &corners).is_outside() {
            true => Containment::Outside,
            false => Containment::Intersecting,
        }
    }
}

/// Combines the outcodes of a box's corners: all inside, all outside one plane, or neither.
fn summarize_outcodes(
    volume: &Volume,
    model_to_clip: Projective<Model, Clip>,
    corners: &[[f32; 3]; 8],
) -> OutcodeSummary {
    let mut points = corners.map(|_| HPoint::new(0.0, 0.0, 0.0, 1.0));
    volume.project_positions(model_to_clip, corners, &mut points, &mut [Outcode::INSIDE; 8])
}

/// Converts a vertex position to f64. All geometry before the rasterizer uses f64, because products
/// of matrices and f32 positions must not lose any bits.
pub(super) fn model_point(position: [f32; 3]) -> Point<Model> {
    Point::from_raw(Vec3::from_array(position).as_dvec3())
}

/// Returns the center of a view volume in the world, or the eye if the volume is infinite.
///
/// The center is close to everything visible, so positions relative to it lose few bits in `f32`.
pub(super) fn volume_center(view: &ViewProjection) -> DVec3 {
    let center = view.world_to_clip().raw().inverse() * DVec4::new(0.0, 0.0, 0.0, 1.0);
    let center = center.truncate() / center.w;
    if center.is_finite() { center } else { view.camera.eye().raw() }
}
