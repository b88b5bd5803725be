//! The inputs for resolving a camera and its projection, and their shared errors.

use super::Origin;
use super::camera_fields::{PROJECTION_PATH, VIEW_PATH};
use camera::{Basis, NamedView};
use homog::{Point, Vector, World};
use model::ModelInstance;
use projection::ProjectionError;
use scene_file::SceneError;
use scene_file::file::FromFile;

/// Everything from which the camera and the projection are resolved.
pub(super) struct CameraResolver<'a> {
    pub(super) origin: &'a Origin,
    pub(super) models: &'a [ModelInstance],
    pub(super) points: Vec<Point<World>>,
    /// Points that a framed view shows in addition to the models: their shadows on the ground.
    pub(super) shadow_points: Vec<Point<World>>,
    pub(super) aspect: f64,
    /// The columns and rows of the picture.
    pub(super) picture_size: [u32; 2],
}

impl CameraResolver<'_> {
    /// Creates the error for an invalid camera, such as a view-up vector along the line of sight.
    pub(super) fn camera_error(&self, error: &camera::CameraError) -> SceneError {
        self.view_error(error.to_string(), None)
    }

    /// Creates an error that points at the view.
    pub(super) fn view_error(
        &self,
        message: impl Into<String>,
        help: Option<String>,
    ) -> SceneError {
        self.origin.error_at(&VIEW_PATH, message, help)
    }

    /// Creates the error for an invalid projection, such as a far plane in front of the near plane.
    pub(super) fn projection_error(&self, error: &ProjectionError) -> SceneError {
        self.projection_error_with(error.to_string(), None)
    }

    /// Creates an error that points at the projection.
    pub(super) fn projection_error_with(
        &self,
        message: impl Into<String>,
        help: Option<String>,
    ) -> SceneError {
        self.origin.error_at(&PROJECTION_PATH, message, help)
    }

    /// Creates a framing error: nothing to frame, or no room for it.
    pub(super) fn framing_error(&self, error: &camera::FramingError) -> SceneError {
        if matches!(error, camera::FramingError::NoPoints) {
            return self.nothing_to_draw_error();
        }
        self.view_error(error.to_string(), None)
    }

    /// Creates the error for models without primitives, which leave nothing to frame.
    pub(super) fn nothing_to_draw_error(&self) -> SceneError {
        // The parts that the importer skipped are the likely reason.
        let warnings = self.models.iter().flat_map(|placed| &placed.model.warnings).next();
        let help = warnings.map(|warning| format!("{}: {}", warning.location, warning.message));
        let message = "there is nothing to draw: the models have no points, lines or triangles";
        self.view_error(message, help)
    }

    /// Returns the center of the bounding box of the models.
    pub(super) fn bounds_center(&self) -> Option<Point<World>> {
        homog::Bounds::from_points(self.points.iter().copied()).map(homog::Bounds::center)
    }

    /// Returns the axes of a camera that looks at the models from a named direction or a vector.
    pub(super) fn view_basis(&self, from: &FromFile) -> Result<Basis, SceneError> {
        let named = match from {
            FromFile::Front => NamedView::Front,
            FromFile::Back => NamedView::Back,
            FromFile::Left => NamedView::Left,
            FromFile::Right => NamedView::Right,
            FromFile::Top => NamedView::Top,
            FromFile::Bottom => NamedView::Bottom,
            FromFile::ThreeQuarter => NamedView::ThreeQuarter,
            FromFile::Isometric => NamedView::Isometric,
            FromFile::Dimetric => NamedView::Dimetric,
            FromFile::Trimetric => NamedView::Trimetric,
            FromFile::Direction(direction) => {
                let gaze = -Vector::from(direction.0);
                return Basis::from_gaze_or_fallback(gaze, Vector::Y)
                    .map_err(|error| self.camera_error(&error));
            }
        };
        Ok(named.basis())
    }
}
