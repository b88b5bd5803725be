//! Resolution of the camera: world-to-view and projection matrices from the fields of the file.
//!
//! ```text
//!  LookAt, LookTo ─► camera frame ─┐
//!  Frame ─► bounds, direction ─────┼─► near and far from the depths of the vertices ─► projection
//!  FromModel ─► node of the model ─┘    unless the file sets them
//! ```
//! Framing finds the eye from which all vertices just fit in the window: in closed form for
//! perspective, and from the box around the projected points for parallel projections.

use super::calibrated_lens::{calibrated_lens, check_calibrated_shape};
use super::camera_fields::VIEW_PATH;
use super::camera_placement::CameraPlacement;
use super::camera_resolver::CameraResolver;
use super::caption::map_window;
use super::classical::check_classical_projection;
use super::depth_span::DepthSpan;
use super::lens::{Lens, check_lens, check_lens_fields, given_window};
use super::{ImageSpec, Origin};
use camera::ViewProjection;
use camera::{Basis, Camera, Slopes, frame_parallel, frame_perspective};
use glam::DVec2;
use homog::{Point, Vector, World};
use model::ModelInstance;
use model::world_points;
use model::{CameraProjection, MeshInstance, ModelCamera};
use projection::{
    ApexMovedFrustum, Convention, Fov, Frustum, Intrinsics, Orthographic, Perspective,
    ProjectionError,
};
use scene_file::file::{
    CameraChoice, CameraFile, Finite, FromFile, Positive, ProjectionFile, ViewFile,
};
use scene_file::{SceneError, closest_name};

/// Resolves the camera and projection of a scene.
pub(super) fn resolve_view_projection(
    origin: &Origin,
    file: &CameraFile,
    models: &[ModelInstance],
    image: ImageSpec,
) -> Result<ViewProjection, SceneError> {
    resolve_view_of_points(origin, file, models, world_points(models), image, Vec::new())
}

/// Resolves the camera and projection of a scene. A framed view shows the models' `points` and the
/// `shadow_points`.
///
/// Shadow points do not affect the view direction or the near and far planes.
pub(super) fn resolve_view_of_points(
    origin: &Origin,
    file: &CameraFile,
    models: &[ModelInstance],
    points: Vec<Point<World>>,
    image: ImageSpec,
    shadow_points: Vec<Point<World>>,
) -> Result<ViewProjection, SceneError> {
    let view_size = image.view_size();
    let aspect = view_size.x / view_size.y;
    let picture_size = [view_size.x as u32, view_size.y as u32];
    let resolver = CameraResolver { origin, models, points, shadow_points, aspect, picture_size };
    let projection = file.projection.as_ref();
    let or_usual = projection.unwrap_or(&ProjectionFile::PERSPECTIVE);
    let fault = check_lens_fields(origin, or_usual)
        .or_else(|| check_calibrated_shape(origin, or_usual, picture_size));
    if let Some(error) = fault {
        return Err(error);
    }
    let placement = CameraPlacement::from_file(&file.view);
    let view = match placement.map_err(|error| resolver.camera_error(&error))? {
        CameraPlacement::Placed(camera) => resolver.project_from_camera(camera, or_usual, None),
        CameraPlacement::Framed { from, padding } => resolver.frame_models(from, padding, or_usual),
        CameraPlacement::OfModel(choice) => resolver.project_from_model_camera(choice, projection),
    };
    // Zoom is applied after framing, which would undo it.
    view.map(|view| image.place_view(zoom_view(view, file.zoom)))
}

/// Returns the view magnified by a factor about the center of the picture.
fn zoom_view(view: ViewProjection, zoom: Positive) -> ViewProjection {
    if zoom == Positive::ONE {
        return view;
    }
    map_window(view, DVec2::splat(zoom.value()), DVec2::ZERO)
}

/// Returns the camera mistakes that can be found without the models, such as a missing direction or
/// planes in the wrong order.
pub(super) fn check_camera(origin: &Origin, file: &CameraFile) -> Vec<SceneError> {
    let view_error = CameraPlacement::from_file(&file.view).err();
    let view_error = view_error.map(|error| origin.error_at(&VIEW_PATH, error.to_string(), None));
    let is_framed = matches!(file.view, ViewFile::Frame { .. });
    let projection = file.projection.as_ref();
    let projection_error = projection
        .and_then(|projection| check_lens(origin, projection))
        .or_else(|| check_classical_projection(origin, projection, is_framed));
    view_error.into_iter().chain(projection_error).collect()
}

/// Returns the lens of the selected camera, or `None` if there is no such camera.
pub(super) fn select_lens<'a>(
    origin: &'a Origin,
    models: &'a [ModelInstance],
    choice: &CameraChoice,
) -> Option<&'a ModelCamera> {
    let (points, shadow_points) = (Vec::new(), Vec::new());
    let (aspect, picture_size) = (1.0, [1; 2]);
    let resolver = CameraResolver { origin, models, points, shadow_points, aspect, picture_size };
    Some(resolver.select_model_camera(choice).ok()?.2)
}

impl<'a> CameraResolver<'a> {
    /// Creates the error for a skewed lens, for which no camera position can be found.
    fn skewed_framing_error(&self, error: &ProjectionError) -> SceneError {
        let help = "set the position of the camera: view: LookAt(…), Extrinsics(…) or Pose(…)";
        self.projection_error_with(error.to_string(), Some(help.to_owned()))
    }

    /// Returns the view-projection of a positioned camera; `height` is the height of a parallel
    /// view's window if the file sets none.
    fn project_from_camera(
        &self,
        camera: Camera,
        projection: &ProjectionFile,
        height: Option<f64>,
    ) -> Result<ViewProjection, SceneError> {
        let span = DepthSpan::from_points(&self.points, camera);
        let window = given_window(projection);
        let [l, r, b, t] = window.unwrap_or_default();
        let view_to_clip = match *projection {
            ProjectionFile::Perspective {
                fov_y_degrees: y,
                fov_x_degrees: x,
                fov_diagonal_degrees: diagonal,
                shift,
                near,
                far,
            } => {
                let (near, far) =
                    span.perspective_planes(near.map(Positive::value), far.map(Positive::value));
                Lens::new([y, x, diagonal], shift).view_to_clip(self.aspect, [near, far])
            }
            ProjectionFile::Orthographic { height: given, near, far, .. } => {
                let (near, far) =
                    span.parallel_planes(near.map(Finite::value), far.map(Finite::value));
                let [l, r, b, t] = window.unwrap_or_else(|| {
                    // Prefer the file's height, then the framing's, then one that fits the models.
                    let height = given.map(Positive::value).or(height);
                    let half = 0.5 * height.unwrap_or_else(|| self.fitting_window_height(camera));
                    let right = half * self.aspect;
                    [-right, right, -half, half]
                });
                Orthographic::new(l, r, b, t, near, far)
                    .map(|p| p.view_to_clip(Convention::CHAPTER))
            }
            ProjectionFile::Frustum { near, far, .. } => {
                // The near plane is part of this projection, so only the far plane follows the
                // models.
                let far = span.perspective_planes(Some(near.value()), far.map(Positive::value)).1;
                Frustum::new(l, r, b, t, near.value(), far)
                    .map(|p| p.view_to_clip(Convention::CHAPTER))
            }
            ProjectionFile::ApexMovedFrustum { near, far, .. } => {
                let far = span.perspective_planes(Some(near.value()), far.map(Positive::value)).1;
                ApexMovedFrustum::new(l, r, b, t, near.value(), far)
                    .map(|p| p.view_to_clip(Convention::CHAPTER))
            }
            ProjectionFile::Intrinsics { near, far, .. } => {
                let planes =
                    span.perspective_planes(near.map(Positive::value), far.map(Positive::value));
                self.calibrated_lens(projection)?.view_to_clip(planes.into(), Convention::CHAPTER)
            }
            _ => return self.project_classical(camera, projection),
        };
        let view_to_clip = view_to_clip.map_err(|error| self.projection_error(&error))?;
        Ok(ViewProjection { camera, view_to_clip })
    }

    /// Returns the lens of a projection with intrinsic parameters.
    fn calibrated_lens(&self, projection: &ProjectionFile) -> Result<Intrinsics, SceneError> {
        let missing = ProjectionError::Unrepresentable { what: "intrinsics" };
        let lens = calibrated_lens(projection, self.picture_size).unwrap_or(Err(missing));
        lens.map_err(|error| self.projection_error(&error))
    }

    /// Returns the height of the window, centered on the line of sight, in which the whole scene
    /// fits.
    fn fitting_window_height(&self, camera: Camera) -> f64 {
        let world_to_view = camera.world_to_view();
        let reach = self.points.iter().map(|&point| {
            let point = world_to_view.transform_point(point);
            point.y().abs().max(point.x().abs() / self.aspect)
        });
        let reach = reach.fold(0.0, f64::max);
        if reach > 0.0 { 2.1 * reach } else { 1.0 }
    }

    /// Returns the view in a given direction, from a camera placed so that everything just fits.
    fn frame_models(
        &self,
        from: Option<&FromFile>,
        padding: f64,
        projection: &ProjectionFile,
    ) -> Result<ViewProjection, SceneError> {
        // Classical projections are defined relative to the front view.
        let usual =
            if projection.is_classical() { FromFile::Front } else { FromFile::ThreeQuarter };
        let basis = self.view_basis(from.unwrap_or(&usual))?;
        let points = self.points.iter().chain(&self.shadow_points).copied();
        let fault = |error: camera::FramingError| self.framing_error(&error);
        let slopes = match *projection {
            ProjectionFile::Orthographic { .. } => {
                let framed = frame_parallel(points, basis, self.aspect, padding).map_err(fault)?;
                return self.project_from_camera(
                    framed.camera,
                    projection,
                    Some(framed.top - framed.bottom),
                );
            }
            ProjectionFile::Perspective { .. } | ProjectionFile::Frustum { .. } => {
                self.window_slopes(projection)?
            }
            ProjectionFile::Intrinsics { .. } => {
                // Slopes do not depend on the near and far planes, so any two will do.
                let frustum = self.calibrated_lens(projection)?.to_frustum(1.0, 2.0);
                let window = frustum.map_err(|error| self.skewed_framing_error(&error))?.slopes();
                let (left, right) = (window.left(), window.right());
                Slopes { left, right, bottom: window.bottom(), top: window.top() }
            }
            ProjectionFile::ApexMovedFrustum { .. } => {
                return self.frame_apex_moved(basis, padding, projection);
            }
            _ => return self.frame_classical(from, padding, projection),
        };
        let framed = frame_perspective(points, basis, slopes, padding).map_err(fault)?;
        self.project_from_camera(framed.camera, projection, None)
    }

    /// Returns the borders of a perspective view's window, one unit ahead of the eye.
    fn window_slopes(&self, projection: &ProjectionFile) -> Result<Slopes, SceneError> {
        let lens = Lens::from_file(projection);
        if let Some(Lens { fov: Fov::Vertical(angle), .. }) = lens.filter(|lens| lens.is_centered())
        {
            return Slopes::vertical_angle(angle, self.aspect)
                .map_err(|error| self.framing_error(&error));
        }
        let [left, right, bottom, top] = match (lens, projection, given_window(projection)) {
            (Some(lens), ..) => {
                let window =
                    lens.slopes(self.aspect).map_err(|error| self.projection_error(&error))?;
                [window.left(), window.right(), window.bottom(), window.top()]
            }
            (
                None,
                ProjectionFile::Frustum { near, .. }
                | ProjectionFile::ApexMovedFrustum { near, .. },
                Some(window),
            ) => window.map(|side| side / near.value()),
            _ => [-1.0, 1.0, -1.0, 1.0],
        };
        Ok(Slopes { left, right, bottom, top })
    }

    /// Returns the moved-apex frustum framed around the models: the apex is placed where the eye of
    /// a centered window would be, and the camera beside it.
    fn frame_apex_moved(
        &self,
        basis: Basis,
        padding: f64,
        projection: &ProjectionFile,
    ) -> Result<ViewProjection, SceneError> {
        let Slopes { left, right, bottom, top } = self.window_slopes(projection)?;
        let (x, y) = (0.5 * (right - left), 0.5 * (top - bottom));
        let centered = Slopes { left: -x, right: x, bottom: -y, top: y };
        let points = self.points.iter().chain(&self.shadow_points).copied();
        let framed = frame_perspective(points, basis, centered, padding)
            .map_err(|error| self.framing_error(&error))?;
        let [l, r, b, t] = given_window(projection).unwrap_or_default();
        let beside = basis.u() * (0.5 * (l + r)) + basis.v() * (0.5 * (b + t));
        let camera = framed.camera.moved(-beside).map_err(|error| self.camera_error(&error))?;
        self.project_from_camera(camera, projection, None)
    }

    /// Returns the view and, unless the scene sets one, the projection of a camera in a model.
    fn project_from_model_camera(
        &self,
        choice: &CameraChoice,
        projection: Option<&ProjectionFile>,
    ) -> Result<ViewProjection, SceneError> {
        let (placed, instance, lens) = self.select_model_camera(choice)?;
        let to_world = instance.node_to_model.then(placed.model_to_world);
        // Only a node's position and direction matter to a camera, not its scale.
        let eye = to_world.transform_point(Point::ORIGIN);
        let gaze = to_world.transform_vector(-Vector::Z);
        let up = to_world.transform_vector(Vector::Y);
        let camera = Camera::look_to(eye, gaze, up).map_err(|error| self.camera_error(&error))?;
        match projection {
            Some(projection) => self.project_from_camera(camera, projection, None),
            None => self.project_through_lens(camera, lens),
        }
    }

    /// Returns the projection of a camera in a model, with the image's aspect ratio. A perspective
    /// camera keeps its vertical field of view; the window of an orthographic camera is extended.
    fn project_through_lens(
        &self,
        camera: Camera,
        lens: &ModelCamera,
    ) -> Result<ViewProjection, SceneError> {
        let view_to_clip = match lens.projection {
            CameraProjection::Perspective { fov_y, near, far, .. } => {
                Perspective::new(Fov::Vertical(fov_y), self.aspect, near, far)
                    .map(|p| p.view_to_clip(Convention::CHAPTER))
            }
            CameraProjection::Orthographic { half_width, half_height, near, far } => {
                let top = half_height.max(half_width / self.aspect);
                let right = top * self.aspect;
                Orthographic::new(-right, right, -top, top, near, far)
                    .map(|p| p.view_to_clip(Convention::CHAPTER))
            }
        };
        let view_to_clip = view_to_clip.map_err(|error| self.projection_error(&error))?;
        Ok(ViewProjection { camera, view_to_clip })
    }

    /// Returns the first visible node that has the camera.
    fn select_model_camera(
        &self,
        choice: &CameraChoice,
    ) -> Result<(&'a ModelInstance, MeshInstance, &'a ModelCamera), SceneError> {
        let mut names = Vec::new();
        for placed in self.models {
            for instance in placed.model.node_instances() {
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
                let name = lens.name.as_ref().or(node.name.as_ref());
                names.push((number, name.cloned().unwrap_or_default()));
            }
        }
        Err(self.unknown_camera_error(choice, &names))
    }

    /// Creates the error for a camera that no model has, with the existing camera names.
    fn unknown_camera_error(
        &self,
        choice: &CameraChoice,
        cameras: &[(usize, String)],
    ) -> SceneError {
        let wanted = match choice {
            CameraChoice::Index(index) => index.to_string(),
            CameraChoice::Name(name) => name.clone(),
        };
        let (message, help) = if cameras.is_empty() {
            // In other programs `--camera` takes coordinates.
            let numbers: Vec<&str> = wanted.split(',').map(str::trim).collect();
            let is_place = numbers.len() > 2 && numbers.iter().all(|it| it.parse::<f64>().is_ok());
            let help = if is_place {
                let eye = numbers[..3].join(",");
                let target =
                    numbers.get(3..6).map_or_else(|| "0,0,0".to_owned(), |it| it.join(","));
                format!(
                    "`--camera` selects a camera of the model; to place a camera, use `--eye {eye} --target {target}`"
                )
            } else {
                "use `--view front` or `--eye 4,3,6 --target 0,0,0` instead, and `--projection` \
                 for the projection; in a scene, write `view: Frame(from: Front)`"
                    .to_owned()
            };
            let message = format!("there is no camera `{wanted}`: the models have no cameras");
            (message, Some(help))
        } else {
            let names: Vec<&str> = cameras.iter().map(|(_, name)| name.as_str()).collect();
            let listed = cameras.iter().map(|(number, name)| match name.as_str() {
                "" => number.to_string(),
                name => format!("{number} `{name}`"),
            });
            let listed: Vec<String> = listed.collect();
            let help = closest_name(&wanted, &names).map_or_else(
                || format!("the cameras are {}", listed.join(", ")),
                |name| format!("did you mean `{name}`?"),
            );
            (format!("there is no camera `{wanted}`"), Some(help))
        };
        self.origin.error_at(&VIEW_PATH, message, help)
    }
}
