//! Camera and projection of a scene: given, framed, or taken from the model.

use super::bounds::DepthSpan;
use super::file::{CameraChoice, CameraFile, FromFile, ProjectionFile, ViewFile};
use super::locate::Step::{self, Field};
use super::wording::suggestion;
use super::{ImageSpec, Origin, SceneError};
use camera::ViewProjection;
use camera::{Basis, Camera, NamedView, Slopes, frame_parallel, frame_perspective};
use homog::{Point, Vector, World};
use model::ModelInstance;
use model::world_points;
use model::{Instance, Lens, LensKind};
use projection::{Convention, Fov, Frustum, Orthographic, Perspective, ProjectionError};

const VIEW: Step<'static> = Field("view");
const CAMERA: Step<'static> = Field("camera");
const PROJECTION: [Step<'static>; 2] = [CAMERA, Field("projection")];

/// Everything that camera and projection are resolved from.
pub(super) struct Resolver<'a> {
    origin: &'a Origin,
    models: &'a [ModelInstance],
    pub(super) points: Vec<Point<World>>,
    pub(super) aspect: f64,
}

/// Camera and projection of a scene.
pub(super) fn resolve_shot(
    origin: &Origin,
    file: &CameraFile,
    models: &[ModelInstance],
    image: ImageSpec,
) -> Result<ViewProjection, SceneError> {
    let aspect = f64::from(image.width) / f64::from(image.height);
    let points = world_points(models);
    let resolver = Resolver { origin, models, points, aspect };
    let projection = file.projection.as_ref();
    let or_usual = projection.unwrap_or(&ProjectionFile::PERSPECTIVE);
    match &file.view {
        ViewFile::LookAt { eye, target, up } => {
            let camera = Camera::look_at(eye.0.into(), target.0.into(), up.0.into());
            let camera = camera.map_err(|error| resolver.camera_fault(&error))?;
            resolver.project(camera, or_usual, None)
        }
        ViewFile::LookTo { eye, gaze, up } => {
            let camera = Camera::look_to(eye.0.into(), gaze.0.into(), up.0.into());
            let camera = camera.map_err(|error| resolver.camera_fault(&error))?;
            resolver.project(camera, or_usual, None)
        }
        ViewFile::Frame { from, padding_percent } => {
            resolver.frame(from.as_ref(), padding_percent.value() / 100.0, or_usual)
        }
        ViewFile::FromModel(choice) => resolver.through_camera(choice, projection),
    }
}

/// The lens of the camera that is chosen; `None` if there is no such camera.
pub(super) fn chosen_lens<'a>(
    origin: &'a Origin,
    models: &'a [ModelInstance],
    choice: &CameraChoice,
) -> Option<&'a Lens> {
    let resolver = Resolver { origin, models, points: Vec::new(), aspect: 1.0 };
    Some(resolver.chosen_camera(choice).ok()?.2)
}

impl<'a> Resolver<'a> {
    pub(super) fn camera_fault(&self, error: &camera::CameraError) -> SceneError {
        self.view_fault(error.to_string(), None)
    }

    pub(super) fn view_fault(
        &self,
        message: impl Into<String>,
        help: Option<String>,
    ) -> SceneError {
        self.origin.fault(&[CAMERA, VIEW], message, help)
    }

    pub(super) fn projection_fault(&self, error: &ProjectionError) -> SceneError {
        self.whole_fault(error.to_string(), None)
    }

    /// A fault of the projection as a whole.
    pub(super) fn whole_fault(
        &self,
        message: impl Into<String>,
        help: Option<String>,
    ) -> SceneError {
        self.origin.fault(&PROJECTION, message, help)
    }

    pub(super) fn framing_fault(&self, error: &camera::FramingError) -> SceneError {
        if matches!(error, camera::FramingError::NoPoints) {
            return self.nothing_to_draw();
        }
        self.view_fault(error.to_string(), None)
    }

    pub(super) fn nothing_to_draw(&self) -> SceneError {
        // What the importer left out is the likely reason.
        let warnings = self.models.iter().flat_map(|placed| &placed.model.warnings).next();
        let help = warnings.map(|warning| format!("{}: {}", warning.pointer, warning.message));
        let message = "there is nothing to draw: the models have no points, lines or triangles";
        self.view_fault(message, help)
    }

    /// The middle of the box around everything.
    pub(super) fn middle(&self) -> Option<Point<World>> {
        homog::Bounds::of(self.points.iter().copied()).map(homog::Bounds::center)
    }

    /// A camera in its place with a projection; `height` is that of a parallel window whose file leaves it open.
    fn project(
        &self,
        camera: Camera,
        projection: &ProjectionFile,
        height: Option<f64>,
    ) -> Result<ViewProjection, SceneError> {
        let span = DepthSpan::of(&self.points, camera);
        let view_to_clip = match *projection {
            ProjectionFile::Perspective { fov_y_degrees, near, far } => {
                let (near, far) = span.perspective(
                    near.map(super::number::Positive::value),
                    far.map(super::number::Positive::value),
                );
                let fov = Fov::Vertical(fov_y_degrees.value().to_radians());
                Perspective::new(fov, self.aspect, near, far)
                    .map(|p| p.view_to_clip(Convention::CHAPTER))
            }
            ProjectionFile::Orthographic { height: given, near, far } => {
                let (near, far) = span.parallel(
                    near.map(super::number::Finite::value),
                    far.map(super::number::Finite::value),
                );
                let height = given.map(super::number::Positive::value).or(height);
                let half = 0.5 * height.unwrap_or_else(|| self.height_in_front_of(camera));
                let right = half * self.aspect;
                Orthographic::new(-right, right, -half, half, near, far)
                    .map(|p| p.view_to_clip(Convention::CHAPTER))
            }
            ProjectionFile::Frustum { left, right, bottom, top, near, far } => {
                let far =
                    span.perspective(Some(near.value()), far.map(super::number::Positive::value)).1;
                let [l, r, b, t] = [left, right, bottom, top].map(super::number::Finite::value);
                Frustum::new(l, r, b, t, near.value(), far)
                    .map(|p| p.view_to_clip(Convention::CHAPTER))
            }
            _ => return self.classical(camera, projection),
        };
        let view_to_clip = view_to_clip.map_err(|error| self.projection_fault(&error))?;
        Ok(ViewProjection { camera, view_to_clip })
    }

    /// The height of the window, centred on the line of sight, into which the whole scene fits.
    fn height_in_front_of(&self, camera: Camera) -> f64 {
        let world_to_view = camera.world_to_view();
        let reach = self.points.iter().map(|&point| {
            let point = world_to_view.point(point);
            point.y().abs().max(point.x().abs() / self.aspect)
        });
        let reach = reach.fold(0.0, f64::max);
        if reach > 0.0 { 2.1 * reach } else { 1.0 }
    }

    /// A camera that looks in a given direction from where everything just fits.
    fn frame(
        &self,
        from: Option<&FromFile>,
        padding: f64,
        projection: &ProjectionFile,
    ) -> Result<ViewProjection, SceneError> {
        let usual =
            if projection.is_classical() { FromFile::Front } else { FromFile::ThreeQuarter };
        let basis = self.basis(from.unwrap_or(&usual))?;
        let points = self.points.iter().copied();
        let fault = |error: camera::FramingError| self.framing_fault(&error);
        let slopes = match *projection {
            ProjectionFile::Orthographic { .. } => {
                let framed = frame_parallel(points, basis, self.aspect, padding).map_err(fault)?;
                return self.project(framed.camera, projection, Some(framed.top - framed.bottom));
            }
            ProjectionFile::Perspective { fov_y_degrees, .. } => {
                let angle = fov_y_degrees.value().to_radians();
                Slopes::vertical_angle(angle, self.aspect).map_err(fault)?
            }
            ProjectionFile::Frustum { left, right, bottom, top, near, .. } => {
                let slope = |side: super::number::Finite| side.value() / near.value();
                Slopes {
                    left: slope(left),
                    right: slope(right),
                    bottom: slope(bottom),
                    top: slope(top),
                }
            }
            _ => return self.frame_classical(from, padding, projection),
        };
        let framed = frame_perspective(points, basis, slopes, padding).map_err(fault)?;
        self.project(framed.camera, projection, None)
    }

    pub(super) fn basis(&self, from: &FromFile) -> Result<Basis, SceneError> {
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
                    .map_err(|error| self.camera_fault(&error));
            }
        };
        Ok(named.basis())
    }

    /// The view, and unless the scene has its own the projection, of a camera in a model.
    fn through_camera(
        &self,
        choice: &CameraChoice,
        projection: Option<&ProjectionFile>,
    ) -> Result<ViewProjection, SceneError> {
        let (placed, instance, lens) = self.chosen_camera(choice)?;
        let to_world = instance.node_to_model.then(placed.model_to_world);
        // Only where a node stands and where it points matter to a camera, not how it is scaled.
        let eye = to_world.point(Point::ORIGIN);
        let gaze = to_world.vector(-Vector::Z);
        let up = to_world.vector(Vector::Y);
        let camera = Camera::look_to(eye, gaze, up).map_err(|error| self.camera_fault(&error))?;
        match projection {
            Some(projection) => self.project(camera, projection, None),
            None => self.through_lens(camera, lens),
        }
    }

    fn through_lens(&self, camera: Camera, lens: &Lens) -> Result<ViewProjection, SceneError> {
        let view_to_clip = match lens.kind {
            LensKind::Perspective { fov_y, near, far, .. } => {
                Perspective::new(Fov::Vertical(fov_y), self.aspect, near, far)
                    .map(|p| p.view_to_clip(Convention::CHAPTER))
            }
            LensKind::Orthographic { half_width, half_height, near, far } => {
                let top = half_height.max(half_width / self.aspect);
                let right = top * self.aspect;
                Orthographic::new(-right, right, -top, top, near, far)
                    .map(|p| p.view_to_clip(Convention::CHAPTER))
            }
        };
        let view_to_clip = view_to_clip.map_err(|error| self.projection_fault(&error))?;
        Ok(ViewProjection { camera, view_to_clip })
    }

    /// The first shown node that carries the camera.
    fn chosen_camera(
        &self,
        choice: &CameraChoice,
    ) -> Result<(&'a ModelInstance, Instance, &'a Lens), SceneError> {
        let mut names = Vec::new();
        for placed in self.models {
            for instance in placed.model.instances() {
                let node = &placed.model.nodes[instance.node];
                let Some(number) = node.camera else { continue };
                let lens = &placed.model.cameras[number];
                let is_chosen = match choice {
                    CameraChoice::Index(wanted) => *wanted == number,
                    CameraChoice::Name(wanted) => {
                        [&lens.name, &node.name].into_iter().flatten().any(|name| name == wanted)
                    }
                };
                if is_chosen {
                    return Ok((placed, instance, lens));
                }
                names.extend(lens.name.clone().or_else(|| node.name.clone()));
                names.push(number.to_string());
            }
        }
        Err(self.no_such_camera(choice, &names))
    }

    fn no_such_camera(&self, choice: &CameraChoice, names: &[String]) -> SceneError {
        let wanted = match choice {
            CameraChoice::Index(index) => index.to_string(),
            CameraChoice::Name(name) => name.clone(),
        };
        let (message, help) = if names.is_empty() {
            let help = "leave it out, or choose a view: Frame(from: Front) in a scene, --view front as a flag";
            ("the models have no camera".to_owned(), Some(help.to_owned()))
        } else {
            (format!("the models have no camera `{wanted}`"), suggestion(&wanted, names))
        };
        self.origin.fault(&[CAMERA, VIEW], message, help)
    }
}
