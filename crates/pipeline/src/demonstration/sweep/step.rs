//! A step of a sweep: the scene's camera and projection with one parameter changed.

use super::super::DemonstrationError;
use super::super::number::short;
use super::Vary;
use crate::scene::{DepthSpan, Scene};
use camera::Camera;
use camera::ViewProjection;
use homog::{Affine, Bounds, Point, Vector, World};
use projection::{
    Convention, Decomposed, Frustum, Orthographic, ProjectionError, Window, decompose,
};

/// What a step begins with.
pub(super) struct Base {
    camera: Camera,
    lens: Lens,
    points: Vec<Point<World>>,
    middle: Point<World>,
    /// The distance of the middle along the line of sight.
    distance: f64,
}

/// The scene's projection.
#[derive(Clone, Copy)]
enum Lens {
    Central(Frustum),
    Parallel(Orthographic),
}

impl Lens {
    /// Why there is no such parameter, if there is none.
    fn lacks(self, vary: Vary) -> Option<&'static str> {
        let is_of_perspective =
            matches!(vary, Vary::Fov | Vary::Lens | Vary::Distance | Vary::Dolly);
        match self {
            Self::Parallel(_) if is_of_perspective => {
                Some("the scene's projection is parallel; take a perspective, or vary the height")
            }
            Self::Central(_) if vary == Vary::Height => Some(
                "the scene's projection is a perspective; take an orthographic one, or vary the fov",
            ),
            _ => None,
        }
    }
}

impl Base {
    /// # Errors
    /// If the scene's projection has no such parameter.
    pub(super) fn of(scene: &Scene, vary: Vary) -> Result<Self, DemonstrationError> {
        let unsuited = |reason: &str| DemonstrationError::Unsuited { vary, reason: reason.into() };
        let kind = decompose(scene.view_projection.view_to_clip.raw(), Convention::CHAPTER);
        let lens = match kind.map(|found| found.kind) {
            Ok(Decomposed::Frustum(frustum)) => Lens::Central(frustum),
            Ok(Decomposed::Orthographic(volume)) => Lens::Parallel(volume),
            _ => return Err(unsuited("take a perspective or an orthographic projection")),
        };
        if let Some(reason) = lens.lacks(vary) {
            return Err(unsuited(reason));
        }
        let points = scene.world_points();
        let nothing = || unsuited("the models have no points, lines or triangles");
        let middle = Bounds::of(points.iter().copied()).map(Bounds::center).ok_or_else(nothing)?;
        let camera = scene.view_projection.camera;
        let distance = -camera.world_to_view().point(middle).z();
        if distance <= 0.0 && matches!(vary, Vary::Distance | Vary::Dolly) {
            return Err(unsuited("the middle of the models is behind the eye"));
        }
        Ok(Self { camera, lens, points, middle, distance })
    }

    /// Camera and projection with the parameter at this value, and what there is to say of them.
    pub(super) fn at(
        &self,
        vary: Vary,
        value: f64,
    ) -> Result<(ViewProjection, String), DemonstrationError> {
        let fault =
            |reason: String| DemonstrationError::Value { vary, value: short(value, 6), reason };
        let wrong = |error: ProjectionError| fault(error.to_string());
        if let Some(allowed) = self.forbidden(vary, value) {
            return Err(fault(allowed.to_owned()));
        }
        let camera = self.camera_at(vary, value).map_err(fault)?;
        let frustum = match self.lens {
            Lens::Central(frustum) => frustum,
            Lens::Parallel(volume) => {
                return self.parallel(vary, value, volume, camera).map_err(fault);
            }
        };
        let slopes = self.slopes_at(vary, value, frustum).map_err(wrong)?;
        let (near, far) = match vary {
            Vary::Near | Vary::Lens => (value, frustum.far()),
            Vary::Far => (frustum.near(), value),
            Vary::Distance | Vary::Dolly | Vary::Angle => {
                DepthSpan::of(&self.points, camera).perspective(None, None)
            }
            Vary::Fov | Vary::Height | Vary::Aspect | Vary::Shift => {
                (frustum.near(), frustum.far())
            }
        };
        let frustum = Frustum::from_slopes(slopes, near, far).map_err(wrong)?;
        let view_projection =
            ViewProjection { camera, view_to_clip: frustum.view_to_clip(Convention::CHAPTER) };
        Ok((view_projection, self.told(frustum, camera)))
    }

    /// What a value must be, if it is not.
    fn forbidden(&self, vary: Vary, value: f64) -> Option<&'static str> {
        let is_parallel = matches!(self.lens, Lens::Parallel(_));
        let (is_allowed, allowed) = match vary {
            Vary::Fov => (value > 0.0 && value < 180.0, "it must lie between 0 and 180 degrees"),
            Vary::Shift | Vary::Angle => (true, "it must be a number"),
            Vary::Near | Vary::Far if is_parallel => (true, "it must be a number"),
            _ => (value > 0.0, "it must be greater than 0"),
        };
        (!is_allowed || !value.is_finite()).then_some(allowed)
    }

    /// Where the eye is.
    fn camera_at(&self, vary: Vary, value: f64) -> Result<Camera, String> {
        match vary {
            Vary::Distance | Vary::Dolly => {
                let by = self.camera.gaze() * (self.distance - value);
                self.camera.moved(by).map_err(|error| error.to_string())
            }
            Vary::Angle => self.turned(value),
            _ => Ok(self.camera),
        }
    }

    /// The camera turned about the upright through the middle.
    fn turned(&self, degrees: f64) -> Result<Camera, String> {
        let middle: Vector<World> = self.middle - Point::ORIGIN;
        let about = Affine::<World, World>::translation(-middle)
            .then(Affine::rotation_y(degrees.to_radians()))
            .then(Affine::<World, World>::translation(middle));
        let frame = self.camera.view_to_world().then(about);
        Camera::from_frame(frame).map_err(|error| error.to_string())
    }

    /// A step of a parallel projection.
    fn parallel(
        &self,
        vary: Vary,
        value: f64,
        volume: Orthographic,
        camera: Camera,
    ) -> Result<(ViewProjection, String), String> {
        let told = |error: ProjectionError| error.to_string();
        let window = volume.window();
        let window = match vary {
            Vary::Height => scaled(window, value / window.height(), value / window.height()),
            Vary::Aspect => scaled(window, value / window.aspect(), 1.0),
            Vary::Shift => shifted(window, value),
            _ => Ok(window),
        };
        let window = window.map_err(told)?;
        let (near, far) = match vary {
            Vary::Near => (value, volume.far()),
            Vary::Far => (volume.near(), value),
            Vary::Angle => DepthSpan::of(&self.points, camera).parallel(None, None),
            _ => (volume.near(), volume.far()),
        };
        if near >= far {
            // The matrix would do: it looks backwards, through a volume turned inside out.
            let [near, far] = [near, far].map(|number| short(number, 6));
            return Err(format!("`far` ({far}) must lie beyond `near` ({near})"));
        }
        let volume = Orthographic::from_window(window, near, far).map_err(told)?;
        let view_projection =
            ViewProjection { camera, view_to_clip: volume.view_to_clip(Convention::CHAPTER) };
        let numbers = [window.width(), window.height(), near, far].map(|number| short(number, 4));
        let [width, height, near, far] = numbers;
        Ok((view_projection, format!("{width} wide · {height} high · near {near} · far {far}")))
    }

    /// The window one unit ahead of the eye.
    fn slopes_at(
        &self,
        vary: Vary,
        value: f64,
        frustum: Frustum,
    ) -> Result<Window, ProjectionError> {
        let slopes = frustum.slopes();
        match vary {
            Vary::Fov => {
                let half = libm::tan(0.5 * value.to_radians());
                scaled(slopes, half / (0.5 * slopes.height()), half / (0.5 * slopes.height()))
            }
            Vary::Aspect => scaled(slopes, value / slopes.aspect(), 1.0),
            Vary::Lens => scaled(slopes, frustum.near() / value, frustum.near() / value),
            Vary::Dolly => scaled(slopes, self.distance / value, self.distance / value),
            Vary::Shift => shifted(slopes, value),
            _ => Ok(slopes),
        }
    }

    /// The numbers of a step.
    fn told(&self, frustum: Frustum, camera: Camera) -> String {
        let slopes = frustum.slopes();
        let degrees = (libm::atan(slopes.top()) - libm::atan(slopes.bottom())).to_degrees();
        let distance = -camera.world_to_view().point(self.middle).z();
        let [degrees, distance, near, far] =
            [degrees, distance, frustum.near(), frustum.far()].map(|number| short(number, 4));
        format!("{degrees}° high · middle at {distance} · near {near} · far {far}")
    }
}

/// A window moved to the right by halves of its width.
fn shifted(window: Window, halves: f64) -> Result<Window, ProjectionError> {
    let by = halves * 0.5 * window.width();
    Window::new(window.left() + by, window.right() + by, window.bottom(), window.top())
}

/// A window, its sides moved away from the line of sight by factors.
fn scaled(window: Window, x: f64, y: f64) -> Result<Window, ProjectionError> {
    Window::new(window.left() * x, window.right() * x, window.bottom() * y, window.top() * y)
}
