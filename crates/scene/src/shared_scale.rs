//! One scale for several views: the same length appears equally long in all of them.
//!
//! The scale of a parallel view is the number of pixels per unit of world length parallel to the
//! picture plane. In an oblique projection, lengths in the front plane have this scale. In an
//! isometric projection, axes appear √⅔ as long (AX-1). Perspective views have no scale.
//!
//! Each view has a scale at which it fits its rectangle; the shared scale is the smallest of these.

use super::camera_fields::PROJECTION_PATH;
use super::caption::map_window;
use super::insets::Inset;
use super::lens::given_window;
use super::{Origin, Scene};
use glam::{DVec2, Vec4Swizzles};
use scene_file::PathStep::Field;
use scene_file::SceneError;
use scene_file::file::{CameraFile, ProjectionFile, SceneFile, ViewFile, ViewportsScale};

impl Scene {
    /// Returns the scale of the view in pixels per world unit, or `None` in perspective, where the
    /// scale depends on the distance.
    ///
    /// The scale is the smaller singular value of the rows x and y of the map from the world to
    /// pixels. In an orthographic projection, both values equal the scale; in an oblique
    /// projection, receding lines increase the larger value.
    #[must_use]
    pub fn pixels_per_unit(&self) -> Option<f64> {
        let view = &self.view_projection;
        if view.viewer().w() != 0.0 {
            return None;
        }
        let map = view.world_to_clip().raw();
        let half = DVec2::new(self.image.width.into(), self.image.height.into()) * 0.5;
        let [x, y] = [map.row(0).xyz() * half.x, map.row(1).xyz() * half.y];
        let (xx, yy, xy) = (x.length_squared(), y.length_squared(), x.dot(y));
        let spread = DVec2::new((xx - yy) * 0.5, xy).length();
        let least = ((xx + yy) * 0.5 - spread).max(0.0).sqrt() / map.w_axis.w.abs();
        (least > 0.0 && least.is_finite()).then_some(least)
    }

    /// Scales a parallel view about its center to this scale; a perspective view stays unchanged.
    pub fn set_pixels_per_unit(&mut self, scale: f64) {
        let Some(own) = self.pixels_per_unit() else { return };
        let (factor, center) = (scale / own, self.image.view_center());
        let shift = center * (1.0 - factor);
        self.view_projection = map_window(self.view_projection, DVec2::splat(factor), shift);
    }
}

/// Gives the parallel views among the viewports one scale, if the scene requests it.
///
/// # Errors
/// Returns an error if fewer than two viewports are parallel views, or if such a view sets a scale.
pub(super) fn share_scale_of_viewports(
    origin: &Origin,
    file: &SceneFile,
    insets: &mut [Inset],
) -> Result<(), SceneError> {
    if file.viewports_scale == ViewportsScale::Individual {
        return Ok(());
    }
    // Only parallel views have a scale.
    let scales: Vec<f64> =
        insets.iter().filter_map(|inset| inset.scene.pixels_per_unit()).collect();
    if scales.len() < 2 {
        let count = if scales.is_empty() { "are none" } else { "is one" };
        let message = format!(
            "a shared scale needs at least two parallel views among the viewports, but there {count}"
        );
        let help =
            "choose projections such as Orthographic() or Isometric, or remove `viewports_scale`";
        return Err(origin.error_at(&[Field("viewports_scale")], message, Some(help.to_owned())));
    }
    for (number, (inset, viewport)) in insets.iter().zip(&file.viewports).enumerate() {
        let camera = viewport.camera.as_ref().unwrap_or(&file.camera);
        if inset.scene.pixels_per_unit().is_some() && has_own_scale(camera) {
            let message = "this view sets its own scale, but must share the scale of the others";
            let help = "remove its `height` or window, or `viewports_scale: Shared`".to_owned();
            let origin = origin.for_viewport(number);
            return Err(origin.error_at(&PROJECTION_PATH, message, Some(help)));
        }
    }
    // Use the smallest scale, so that every view still shows everything.
    let shared = scales.into_iter().fold(f64::INFINITY, f64::min);
    insets.iter_mut().for_each(|inset| inset.scene.set_pixels_per_unit(shared));
    Ok(())
}

/// Whether the file, or a model's camera, sets the size of a parallel window.
fn has_own_scale(camera: &CameraFile) -> bool {
    match &camera.projection {
        Some(ProjectionFile::Orthographic { height: Some(_), .. }) => true,
        Some(projection) => given_window(projection).is_some(),
        None => matches!(camera.view, ViewFile::FromModel(_)),
    }
}
