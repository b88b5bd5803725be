//! One step of a sweep: the scene's camera and projection with one parameter changed.
//!
//! The scene's projection is first decomposed into a frustum or an orthographic box, and then one
//! of its numbers is replaced. Parameters that a projection lacks (the height of a perspective
//! projection, the angle of a parallel projection) are rejected with a suggestion to vary a
//! different parameter.

use super::super::DemonstrationError;
use super::super::number_format::format_short;
use super::SweepParameter;
use camera::Camera;
use camera::ViewProjection;
use homog::{Affine, Bounds, Point, Vector, World};
use projection::{
    Convention, Decomposed, Frustum, Orthographic, ProjectionError, Window, decompose,
};
use scene::{DepthSpan, Scene};

/// The scene's view, decomposed into camera and parameters.
///
/// It is computed once per sweep, so that the vertices of all models are collected only once.
pub(super) struct SweepBase {
    /// The scene's camera.
    camera: Camera,
    /// The scene's projection.
    projection: BaseProjection,
    /// The vertices of all models in world space, for fitting the near and far planes if the camera
    /// moves.
    points: Vec<Point<World>>,
    /// The center of the models' bounding box.
    center: Point<World>,
    /// The distance of the center along the line of sight.
    distance: f64,
}

/// The scene's projection as parameters. Only these two kinds have a near plane, a far plane and a
/// window that can be replaced one at a time.
#[derive(Clone, Copy)]
enum BaseProjection {
    Perspective(Frustum),
    Parallel(Orthographic),
}

impl BaseProjection {
    /// Returns the reason why the projection lacks a parameter, or `None` if it has the parameter.
    ///
    /// A projection with its eye at infinity has no angle and no distance. The window height of a
    /// perspective projection depends on the plane on which it is measured.
    fn reason_unsupported(self, vary: SweepParameter) -> Option<&'static str> {
        let is_of_perspective = matches!(
            vary,
            SweepParameter::Fov
                | SweepParameter::Lens
                | SweepParameter::Distance
                | SweepParameter::Dolly
        );
        match self {
            Self::Parallel(_) if is_of_perspective => Some(
                "the scene's projection is parallel; use a perspective projection, or vary `height`",
            ),
            Self::Perspective(_) if vary == SweepParameter::Height => Some(
                "the scene has a perspective projection; use an orthographic projection, or vary `fov`",
            ),
            _ => None,
        }
    }
}

impl SweepBase {
    /// Decomposes the scene's view.
    ///
    /// # Errors
    /// Returns an error if the scene's projection does not have the parameter.
    pub(super) fn new(scene: &Scene, vary: SweepParameter) -> Result<Self, DemonstrationError> {
        let unsuited =
            |reason: &str| DemonstrationError::UnsupportedParameter { vary, reason: reason.into() };
        let kind = decompose(scene.view_projection.view_to_clip, Convention::CHAPTER);
        let lens = match kind.map(|found| found.kind) {
            Ok(Decomposed::Frustum(frustum)) => BaseProjection::Perspective(frustum),
            Ok(Decomposed::Orthographic(volume)) => BaseProjection::Parallel(volume),
            _ => return Err(unsuited("use a perspective or an orthographic projection")),
        };
        if let Some(reason) = lens.reason_unsupported(vary) {
            return Err(unsuited(reason));
        }
        let points = scene.world_points();
        let nothing = || unsuited("the models have no points, lines or triangles");
        let center =
            Bounds::from_points(points.iter().copied()).map(Bounds::center).ok_or_else(nothing)?;
        let camera = scene.view_projection.camera;
        let distance = -camera.world_to_view().transform_point(center).z();
        if distance <= 0.0 && matches!(vary, SweepParameter::Distance | SweepParameter::Dolly) {
            return Err(unsuited("the center of the models is behind the eye"));
        }
        Ok(Self { camera, projection: lens, points, center, distance })
    }

    /// Returns the camera and projection for a value of the parameter, with a note.
    ///
    /// Every step starts from the original view and not from the previous step, so errors do not
    /// accumulate and a single step equals the same step of a longer sweep.
    ///
    /// | parameter | replaces | planes |
    /// | --- | --- | --- |
    /// | fov, aspect, shift | the slopes | as in the scene |
    /// | near, far | one plane | the replaced plane |
    /// | lens | near and slopes | near |
    /// | distance, dolly, angle | the camera | fitted to the models |
    ///
    /// # Errors
    /// Returns an error if the value is out of range or if the camera or frustum rejects it (for
    /// example near ≥ far).
    pub(super) fn view_at(
        &self,
        vary: SweepParameter,
        value: f64,
    ) -> Result<(ViewProjection, String), DemonstrationError> {
        let invalid = |reason: String| DemonstrationError::InvalidValue {
            vary,
            value: format_short(value, 6),
            reason,
        };
        let projection_error = |error: ProjectionError| invalid(error.to_string());
        if let Some(allowed) = self.unmet_requirement(vary, value) {
            return Err(invalid(allowed.to_owned()));
        }
        let camera = self.camera_for_value(vary, value).map_err(invalid)?;
        let frustum = match self.projection {
            BaseProjection::Perspective(frustum) => frustum,
            BaseProjection::Parallel(volume) => {
                return self.parallel_view_at(vary, value, volume, camera).map_err(invalid);
            }
        };
        let slopes = self.slopes_for_value(vary, value, frustum).map_err(projection_error)?;
        let (near, far) = match vary {
            SweepParameter::Near | SweepParameter::Lens => (value, frustum.far()),
            SweepParameter::Far => (frustum.near(), value),
            SweepParameter::Distance | SweepParameter::Dolly | SweepParameter::Angle => {
                DepthSpan::from_points(&self.points, camera).perspective_planes(None, None)
            }
            SweepParameter::Fov
            | SweepParameter::Height
            | SweepParameter::Aspect
            | SweepParameter::Shift => (frustum.near(), frustum.far()),
        };
        let frustum = Frustum::from_slopes(slopes, near, far).map_err(projection_error)?;
        let view_projection =
            ViewProjection { camera, view_to_clip: frustum.view_to_clip(Convention::CHAPTER) };
        Ok((view_projection, self.describe_frustum(frustum, camera)))
    }

    /// Returns the requirement that a value violates, if any.
    ///
    /// The planes of a parallel projection may have negative distances, that is, be behind the eye.
    /// Values that are not finite are rejected for every parameter.
    fn unmet_requirement(&self, vary: SweepParameter, value: f64) -> Option<&'static str> {
        let is_parallel = matches!(self.projection, BaseProjection::Parallel(_));
        if !value.is_finite() {
            return Some("it must be finite");
        }
        let (is_allowed, allowed) = match vary {
            SweepParameter::Fov => {
                (value > 0.0 && value < 180.0, "it must be between 0 and 180 degrees")
            }
            SweepParameter::Shift | SweepParameter::Angle => return None,
            SweepParameter::Near | SweepParameter::Far if is_parallel => return None,
            _ => (value > 0.0, "it must be greater than 0"),
        };
        (!is_allowed).then_some(allowed)
    }

    /// Returns the camera for a value of a parameter that moves it.
    ///
    /// A distance moves the eye along the gaze, e' = e + (d₀ − d) g, where d₀ is the distance in
    /// the scene and g has unit length. The orientation does not change.
    fn camera_for_value(&self, vary: SweepParameter, value: f64) -> Result<Camera, String> {
        match vary {
            SweepParameter::Distance | SweepParameter::Dolly => {
                let by = self.camera.gaze() * (self.distance - value);
                self.camera.moved(by).map_err(|error| error.to_string())
            }
            SweepParameter::Angle => self.orbit_camera(value),
            _ => Ok(self.camera),
        }
    }

    /// Returns the camera rotated about the vertical axis through the center.
    ///
    /// Applies T(c) · R_y(φ) · T(−c) to the camera's frame, so position and orientation rotate
    /// together and the center does not move in the picture.
    fn orbit_camera(&self, degrees: f64) -> Result<Camera, String> {
        let center: Vector<World> = self.center - Point::ORIGIN;
        let rotation = Affine::<World, World>::translation(-center)
            .then(Affine::rotation_y(degrees.to_radians()))
            .then(Affine::<World, World>::translation(center));
        let frame = self.camera.view_to_world().then(rotation);
        Camera::from_frame(frame).map_err(|error| error.to_string())
    }

    /// Returns the camera and the parallel projection for a value of the parameter, with a note.
    ///
    /// Changing the height keeps the aspect ratio, and vice versa. Both scale about the line of
    /// sight. Only the angle moves the camera here, so only the angle refits the planes.
    fn parallel_view_at(
        &self,
        vary: SweepParameter,
        value: f64,
        volume: Orthographic,
        camera: Camera,
    ) -> Result<(ViewProjection, String), String> {
        let to_message = |error: ProjectionError| error.to_string();
        let window = volume.window();
        let window = match vary {
            SweepParameter::Height => {
                scale_window(window, value / window.height(), value / window.height())
            }
            SweepParameter::Aspect => scale_window(window, value / window.aspect(), 1.0),
            SweepParameter::Shift => shift_window(window, value),
            _ => Ok(window),
        };
        let window = window.map_err(to_message)?;
        let (near, far) = match vary {
            SweepParameter::Near => (value, volume.far()),
            SweepParameter::Far => (volume.near(), value),
            SweepParameter::Angle => {
                DepthSpan::from_points(&self.points, camera).parallel_planes(None, None)
            }
            _ => (volume.near(), volume.far()),
        };
        if near >= far {
            // A matrix with these planes would be valid, but it would look backward.
            let [near, far] = [near, far].map(|number| format_short(number, 6));
            return Err(format!("`far` ({far}) must be beyond `near` ({near})"));
        }
        let volume = Orthographic::from_window(window, near, far).map_err(to_message)?;
        let view_projection =
            ViewProjection { camera, view_to_clip: volume.view_to_clip(Convention::CHAPTER) };
        let numbers =
            [window.width(), window.height(), near, far].map(|number| format_short(number, 4));
        let [width, height, near, far] = numbers;
        Ok((view_projection, format!("{width} wide · {height} high · near {near} · far {far}")))
    }

    /// Returns the window one unit in front of the eye for a value of the parameter.
    ///
    /// The slopes are multiplied by these factors:
    ///
    /// ```text
    ///  fov    tan(φ / 2) / (h / 2)      h: height of the window one unit ahead
    ///  lens   n₀ / n                    the window on the near plane stays
    ///  dolly  d₀ / d                    the window at the center stays
    /// ```
    /// The lens formula matches `glFrustum` with fixed sides.
    fn slopes_for_value(
        &self,
        vary: SweepParameter,
        value: f64,
        frustum: Frustum,
    ) -> Result<Window, ProjectionError> {
        let slopes = frustum.slopes();
        match vary {
            SweepParameter::Fov => {
                let half = libm::tan(0.5 * value.to_radians());
                scale_window(slopes, half / (0.5 * slopes.height()), half / (0.5 * slopes.height()))
            }
            SweepParameter::Aspect => scale_window(slopes, value / slopes.aspect(), 1.0),
            SweepParameter::Lens => {
                scale_window(slopes, frustum.near() / value, frustum.near() / value)
            }
            SweepParameter::Dolly => {
                scale_window(slopes, self.distance / value, self.distance / value)
            }
            SweepParameter::Shift => shift_window(slopes, value),
            _ => Ok(slopes),
        }
    }

    /// Returns the note of a perspective step: angle, distance and planes.
    ///
    /// The vertical angle is in degrees and distances are in world units, with four significant
    /// digits each.
    fn describe_frustum(&self, frustum: Frustum, camera: Camera) -> String {
        let slopes = frustum.slopes();
        let degrees = (libm::atan(slopes.top()) - libm::atan(slopes.bottom())).to_degrees();
        let distance = -camera.world_to_view().transform_point(self.center).z();
        let [degrees, distance, near, far] = [degrees, distance, frustum.near(), frustum.far()]
            .map(|number| format_short(number, 4));
        format!("{degrees}° high · center at {distance} · near {near} · far {far}")
    }
}

/// Moves a window to the right by a number of half widths.
///
/// A shift of 1 moves the left border to the former center.
fn shift_window(window: Window, halves: f64) -> Result<Window, ProjectionError> {
    let by = halves * 0.5 * window.width();
    Window::new(window.left() + by, window.right() + by, window.bottom(), window.top())
}

/// Scales the sides of a window about the line of sight.
///
/// Scaling about (0, 0), not about the center of the window, preserves the relative shift of an
/// off-center window.
fn scale_window(window: Window, x: f64, y: f64) -> Result<Window, ProjectionError> {
    Window::new(window.left() * x, window.right() * x, window.bottom() * y, window.top() * y)
}
