//! Sweeps: one camera or lens parameter varied from one value to another, with a picture for each
//! step (C62, C64, C94).
//!
//! Everything else stays as in the scene. The near and far planes are refitted only if the
//! parameter moves the camera, because the subject could then be clipped.
//!
//! ```text
//!  fov, lens       tan(fov / 2) = window height / (2 · near)      a smaller angle enlarges
//!  distance        image size ∝ 1 / distance                      perspective becomes steeper
//!  dolly           tan(fov / 2) ∝ 1 / distance                    the center keeps its size
//!  shift           window moved on its plane                      the picture moves undistorted
//! ```

mod step;

use super::DemonstrationError;
use super::number_format::format_short;
use camera::ViewProjection;
use camera::{NamedView, frame_parallel};
use drawing::{Overlay, Page, Panel, Panels};
use glam::DVec2;
use homog::HPoint;
use projection::{Convention, Orthographic};
use scene::Scene;
use std::fmt;
use step::SweepBase;

/// The gap between a picture and the view volume below it, in millimeters.
const PANEL_GAP: f64 = 4.0;

/// The parameter of a sweep.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SweepParameter {
    /// Vertical field of view in degrees, from a fixed eye. Small angles magnify.
    Fov,
    /// Window height of a parallel projection, with a fixed aspect ratio. Small windows magnify.
    Height,
    /// Aspect ratio of the window. The picture is distorted unless it has the same aspect ratio.
    Aspect,
    /// Distance of the near plane with a fixed angle. It affects only clipping.
    Near,
    /// Distance of the far plane. It affects only clipping.
    Far,
    /// Distance of the near plane with a fixed window on it (`glFrustum`), to change the angle.
    Lens,
    /// Shift of the window to the right, in half widths: a lens shift.
    Shift,
    /// Distance of the eye from the center of the models along the line of sight.
    Distance,
    /// Distance of the eye, with the angle adapted so that objects at the center keep their size (a
    /// dolly zoom).
    Dolly,
    /// Rotation of the camera about the vertical axis through the center of the models, in degrees,
    /// counterclockwise seen from above.
    Angle,
}

/// A parameter with its range of values, in the parameter's unit: degrees for angles, world units
/// for distances and heights, and plain ratios otherwise.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Sweep {
    /// The parameter.
    pub parameter: SweepParameter,
    /// The first value.
    ///
    /// If it is greater than the last value, the sweep is descending.
    pub from: f64,
    /// The last value.
    pub to: f64,
    /// The number of pictures, at least 1.
    pub steps: u32,
    /// Whether a second picture, below each picture, shows the view volume around the models.
    pub volumes: bool,
}

impl SweepParameter {
    /// All parameters.
    pub const ALL: [Self; 10] = [
        Self::Fov,
        Self::Height,
        Self::Aspect,
        Self::Near,
        Self::Far,
        Self::Lens,
        Self::Shift,
        Self::Distance,
        Self::Dolly,
        Self::Angle,
    ];

    /// Returns the name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fov => "fov",
            Self::Height => "height",
            Self::Aspect => "aspect",
            Self::Near => "near",
            Self::Far => "far",
            Self::Lens => "lens",
            Self::Shift => "shift",
            Self::Distance => "distance",
            Self::Dolly => "dolly",
            Self::Angle => "angle",
        }
    }

    /// Returns the effect on the picture, as stated in the lessons.
    ///
    /// It follows the name of the parameter in the page title.
    const fn caption(self) -> &'static str {
        match self {
            Self::Fov => "a smaller angle enlarges the models",
            Self::Height => "a smaller window enlarges the models, wherever the eye is",
            Self::Aspect => "an aspect ratio unlike that of the picture distorts the models",
            Self::Near => "the near plane only clips",
            Self::Far => "the far plane only clips",
            Self::Lens => "the distance of a fixed-size window sets the angle",
            Self::Shift => "a shifted window moves the picture without distorting it",
            Self::Distance => "a closer eye enlarges the models and steepens the perspective",
            Self::Dolly => "distance and angle balance: only the center keeps its size",
            Self::Angle => "the camera orbits the models",
        }
    }
}

impl fmt::Display for SweepParameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Sweep {
    /// Returns the values, evenly spaced. The first and last values are exact.
    #[must_use]
    pub fn parameter_values(&self) -> Vec<f64> {
        let last = self.steps.max(1) - 1;
        let value = |step: u32| match step {
            0 => self.from,
            step if step == last => self.to,
            step => self.from + (self.to - self.from) * (f64::from(step) / f64::from(last)),
        };
        (0..=last).map(value).collect()
    }

    /// Returns the camera and projection for each value, with a note.
    ///
    /// # Errors
    /// Returns an error if the scene's projection lacks the parameter or if a value is out of
    /// range.
    pub fn view_projections(
        &self,
        scene: &Scene,
    ) -> Result<Vec<(ViewProjection, String)>, DemonstrationError> {
        let base = SweepBase::new(scene, self.parameter)?;
        self.parameter_values()
            .into_iter()
            .map(|value| base.view_at(self.parameter, value))
            .collect()
    }

    /// Draws the pictures side by side. The number of threads does not change them.
    ///
    /// The panels have the ids `step-1`, `step-2`, … They are drawn one at a time, each with all
    /// threads. One observer is fitted to all steps, so that the view volumes can be compared
    /// between panels.
    ///
    /// # Errors
    /// Fails if [`view_projections`](Self::view_projections) fails or if a picture has no pixels.
    pub fn draw_panels(&self, scene: &Scene, threads: usize) -> Result<Panels, DemonstrationError> {
        let mut scene = scene.clone();
        scene.image.background = [1.0; 4];
        let view_projections = self.view_projections(&scene)?;
        let observer = if self.volumes { observer_view(&scene, &view_projections) } else { None };
        let mut panels = Vec::new();
        for (number, ((view_projection, note), value)) in
            view_projections.iter().zip(self.parameter_values()).enumerate()
        {
            scene.view_projection = *view_projection;
            let title = format!("{} {}", self.parameter, format_short(value, 4));
            let mut panel = pipeline::render::render_panel(
                &scene,
                format!("step-{}", number + 1),
                title,
                threads,
            )?;
            if let Some(observer) = observer {
                panel = add_volume_panel(panel, &scene, observer, threads)?;
            }
            panels.push(panel.with_notes(vec![note.clone()]));
        }
        let title =
            format!("{}: {}, {}", scene.model_names(), self.parameter, self.parameter.caption());
        Ok(Panels::new(title, panels))
    }
}

/// Draws a picture and, below it, its view volume as seen by an observer from the side.
///
/// The scene is drawn a second time from the observer's viewpoint, with the view volume of the
/// scene's camera as an overlay. Layer ids are prefixed with `view-` and `volume-`, so that they
/// are unique on the common page.
fn add_volume_panel(
    view: Panel,
    scene: &Scene,
    observer: ViewProjection,
    threads: usize,
) -> Result<Panel, DemonstrationError> {
    let mut aside = scene.clone();
    aside.overlays = vec![Overlay::Volume(Box::new(scene.view_projection))];
    aside.view_projection = observer;
    let volume = pipeline::render::render_panel(&aside, "volume", "view volume", threads)?.page;
    let size = view.page.size;
    let below = size.y + PANEL_GAP;
    let mut page = Page::new(DVec2::new(size.x, below + size.y), view.page.title.clone(), None);
    page.paste_page(&view.page, DVec2::ZERO, "view-");
    page.paste_page(&volume, DVec2::new(0.0, below), "volume-");
    Ok(Panel { page, ..view })
}

/// Returns a trimetric view that shows the models, all eyes and all near windows, or `None` if
/// there are no models.
///
/// The near windows are the corners (±1, ±1, +1) of the canonical volume, mapped back to the world.
/// Far windows are not included, because they would shrink the models to a few pixels. The margin
/// is 8% on each side.
fn observer_view(scene: &Scene, views: &[(ViewProjection, String)]) -> Option<ViewProjection> {
    let mut points = scene.world_points();
    for (view_projection, _) in views {
        let clip_to_world = view_projection.world_to_clip().inverse()?;
        let corners = [-1.0, 1.0].map(|x| [-1.0, 1.0].map(|y| HPoint::new(x, y, 1.0, 1.0)));
        let near = corners.as_flattened().iter();
        points.extend(near.filter_map(|&corner| clip_to_world.transform_hpoint(corner).divide()));
        points.push(view_projection.camera.eye());
    }
    let aspect = f64::from(scene.image.width) / f64::from(scene.image.height);
    let framed = frame_parallel(points.iter().copied(), NamedView::Trimetric.basis(), aspect, 0.08);
    let framed = framed.ok()?;
    let volume = Orthographic::new(
        framed.left,
        framed.right,
        framed.bottom,
        framed.top,
        framed.near,
        framed.far,
    );
    let view_to_clip = volume.ok()?.view_to_clip(Convention::CHAPTER);
    Some(ViewProjection { camera: framed.camera, view_to_clip })
}

#[cfg(test)]
mod tests;
