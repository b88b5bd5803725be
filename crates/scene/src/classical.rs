//! The classical projections: axonometric, oblique, planometric, and perspectives from vanishing
//! points. Each fits its window around the models.
//!
//! - Projections onto a picture plane: the window is the box around the projected vertices, and the
//!   depths of that box give the near and far planes.
//! - Perspectives from vanishing points: the points determine the orientation of the eye and the
//!   slopes of the window around its line of sight; framing finds the position of the eye.

use super::Origin;
use super::camera_fields::{PROJECTION_PATH, VIEW_PATH};
use super::camera_resolver::CameraResolver;
use camera::ViewProjection;
use camera::{Basis, Camera, Slopes, frame_perspective};
use glam::DVec3;
use homog::{Point, Projective, Vector, View};
use projection::{
    Axonometric, Classical, ConstructedPerspective, Convention, Frustum, NPoint, Oblique,
    Orthographic, Planometric, PrincipalView, ProjectionError, Window,
};
use scene_file::SceneError;
use scene_file::file::{Finite, FromFile, ProjectionFile};

/// The axis-aligned bounding box of the projected vertices, in picture plane space.
#[derive(Clone, Copy, Debug)]
struct ProjectedBounds {
    /// The smallest x, y and z.
    low: DVec3,
    /// The largest x, y and z; larger z is nearer.
    high: DVec3,
}

impl CameraResolver<'_> {
    /// Frames the models with a classical projection, as seen from `from`, by default from the
    /// front.
    ///
    /// `padding` is the margin on each side, as a fraction of the window. The camera of a
    /// projection onto a picture plane is at the center of the models, since parallel projections
    /// do not depend on its position.
    ///
    /// # Errors
    /// Returns an error if the parameters are invalid, there is nothing to draw, or a vertex is
    /// behind the eye.
    pub(super) fn frame_classical(
        &self,
        from: Option<&FromFile>,
        padding: f64,
        projection: &ProjectionFile,
    ) -> Result<ViewProjection, SceneError> {
        let basis = self.view_basis(from.unwrap_or(&FromFile::Front))?;
        if let Some(construction) = vanishing_point_construction(projection) {
            let construction = construction.map_err(|error| self.projection_error(&error))?;
            return self.frame_construction(basis, construction, padding);
        }
        let middle = self.bounds_center().ok_or_else(|| self.nothing_to_draw_error())?;
        let camera = Camera::new(middle, basis).map_err(|error| self.camera_error(&error))?;
        self.frame_on_picture_plane(camera, projection, padding)
    }

    /// Returns a classical projection for a camera with an explicit position; the window is fitted
    /// with a margin of 5%.
    ///
    /// # Errors
    /// Returns an error for perspectives from vanishing points, which determine the eye themselves.
    pub(super) fn project_classical(
        &self,
        camera: Camera,
        projection: &ProjectionFile,
    ) -> Result<ViewProjection, SceneError> {
        if vanishing_point_construction(projection).is_some() {
            return Err(own_eye_error(self.origin));
        }
        self.frame_on_picture_plane(camera, projection, 0.05)
    }

    /// Returns a projection onto a picture plane, with the window fitted to the models.
    ///
    /// The depth-preserving form of the projection keeps a third coordinate for the depth test. The
    /// orthographic volume around the projected bounds then maps to clip space: M = V · P.
    fn frame_on_picture_plane(
        &self,
        camera: Camera,
        projection: &ProjectionFile,
        padding: f64,
    ) -> Result<ViewProjection, SceneError> {
        let world_to_view = camera.world_to_view();
        let points: Vec<Point<View>> =
            self.points.iter().map(|&point| world_to_view.transform_point(point)).collect();
        let fault = |error: ProjectionError| self.projection_error(&error);
        let depth_kept = picture_plane_projection(projection, bounding_radius(&points))
            .map_err(fault)?
            .depth_preserving();
        let image = ProjectedBounds::from_points(&points, depth_kept).ok_or_else(|| {
            let help = "reduce p, q and r to move the eye away; values below 0.5 always suffice";
            self.projection_error_with(
                "part of the models is behind the eye",
                Some(help.to_owned()),
            )
        })?;
        let volume = image.view_volume(self.aspect, padding).map_err(fault)?;
        let view_to_clip = depth_kept.then(volume.view_to_clip(Convention::CHAPTER));
        Ok(ViewProjection { camera, view_to_clip })
    }

    /// Returns a perspective from vanishing points, with the eye placed so that the models fit.
    ///
    /// The points determine the rotation of the eye relative to the axes, and the off-axis window
    /// (slopes per unit of distance); neither depends on scale. [`frame_perspective`] then finds
    /// the eye in closed form.
    fn frame_construction(
        &self,
        from: Basis,
        construction: ConstructedPerspective,
        padding: f64,
    ) -> Result<ViewProjection, SceneError> {
        let fault = |error: ProjectionError| self.projection_error(&error);
        // The rows of the rotation are the eye's axes, relative to the basis `from`.
        let rows = construction.world_to_view().raw().transpose();
        let axis = |row: glam::DVec4| from.to_world(Vector::from_raw(row.truncate()));
        let basis = Basis::from_gaze(-axis(rows.z_axis), axis(rows.y_axis))
            .map_err(|error| self.camera_error(&error))?;
        let window = Window::new(-self.aspect, self.aspect, -1.0, 1.0).map_err(fault)?;
        // Slopes do not depend on the near and far planes, so 1 and 2 are as good as any.
        let slopes = construction.frustum(window, 1.0, 2.0).map_err(fault)?.slopes();
        let frame = Slopes {
            left: slopes.left(),
            right: slopes.right(),
            bottom: slopes.bottom(),
            top: slopes.top(),
        };
        let points = self.points.iter().copied();
        let framed = frame_perspective(points, basis, frame, padding);
        let framed = framed.map_err(|error| self.framing_error(&error))?;
        // The planes are chosen after framing because they depend on the position of the eye.
        let span = super::depth_span::DepthSpan::from_points(&self.points, framed.camera);
        let (near, far) = span.perspective_planes(None, None);
        let frustum = Frustum::from_slopes(slopes, near, far).map_err(fault)?;
        Ok(ViewProjection {
            camera: framed.camera,
            view_to_clip: frustum.view_to_clip(Convention::CHAPTER),
        })
    }
}

/// Validates the parameters of a classical projection without models; returns `None` if they are
/// valid.
///
/// Perspectives from vanishing points also need a framed view (`is_framed`), since they determine
/// the eye themselves.
pub(super) fn check_classical_projection(
    origin: &Origin,
    projection: Option<&ProjectionFile>,
    is_framed: bool,
) -> Option<SceneError> {
    let projection = projection.filter(|projection| projection.is_classical())?;
    let construction = vanishing_point_construction(projection);
    if construction.is_some() && !is_framed {
        return Some(own_eye_error(origin));
    }
    let error = match construction {
        Some(construction) => construction.err()?,
        None => picture_plane_projection(projection, 1.0).err()?,
    };
    Some(origin.error_at(&PROJECTION_PATH, error.to_string(), None))
}

/// Creates the error for a perspective from vanishing points that has a camera position too.
fn own_eye_error(origin: &Origin) -> SceneError {
    let help = "use Frame(from: …), or remove the view".to_owned();
    let message = "a projection with vanishing points determines its own eye position";
    origin.error_at(&VIEW_PATH, message, Some(help))
}

/// Constructs a one-, two- or three-point perspective from its vanishing points (VN-1); returns
/// `None` for other projections.
///
/// The coordinates of the points are relative to the center of the picture, in units of half its
/// height, with y up. The inner error reports points that orthogonal axes cannot have, such as
/// three that form an obtuse triangle.
fn vanishing_point_construction(
    projection: &ProjectionFile,
) -> Option<Result<ConstructedPerspective, ProjectionError>> {
    let at = |(x, y): (Finite, Finite)| (x.value(), y.value());
    Some(match *projection {
        ProjectionFile::OnePoint { at: point, distance } => {
            ConstructedPerspective::one_point(at(point), distance.value())
        }
        ProjectionFile::TwoPoint { x, z, fraction } => {
            ConstructedPerspective::two_point(at(x), at(z), fraction.value())
        }
        ProjectionFile::ThreePoint { x, y, z } => {
            ConstructedPerspective::three_point(at(x), at(y), at(z))
        }
        _ => return None,
    })
}

/// Returns the projection onto the picture plane.
///
/// `radius` is the largest distance of a vertex from the camera. In an n-point perspective, p, q
/// and r are divided by it, so that their effect does not depend on the size of the models.
/// Projections without parameters cannot fail.
fn picture_plane_projection(
    projection: &ProjectionFile,
    radius: f64,
) -> Result<Classical, ProjectionError> {
    // Files specify the direction in which depth recedes; `Oblique` expects the opposite direction.
    let phi = |degrees: Finite| (degrees.value() + 180.0).to_radians();
    Ok(match *projection {
        ProjectionFile::Isometric => Axonometric::isometric().into(),
        ProjectionFile::Dimetric => Axonometric::dimetric_42_7().into(),
        ProjectionFile::Trimetric => default_trimetric()?.into(),
        ProjectionFile::Axonometric { x, y, z } => {
            Axonometric::by_foreshortening(x.value(), y.value(), z.value())?.into()
        }
        ProjectionFile::Cavalier { angle_degrees } => Oblique::cavalier(phi(angle_degrees))?.into(),
        ProjectionFile::Cabinet { angle_degrees } => Oblique::cabinet(phi(angle_degrees))?.into(),
        ProjectionFile::Oblique { length, angle_degrees } => {
            Oblique::new(length.value(), phi(angle_degrees))?.into()
        }
        ProjectionFile::Military { rotation_degrees, height } => {
            Planometric::new(rotation_degrees.value().to_radians(), height.value())?.into()
        }
        ProjectionFile::NPoint { p, q, r } => {
            let [p, q, r] = [p, q, r].map(|entry| entry.value() / radius);
            NPoint::new(p, q, r)?.into()
        }
        ProjectionFile::Multiview(view) => view.into(),
        _ => PrincipalView::Front.into(),
    })
}

/// Returns the default trimetric projection, with view direction (2, 3, 6) as in the camera crate's
/// named view.
fn default_trimetric() -> Result<Axonometric, ProjectionError> {
    Axonometric::by_normal(homog::Normal::new(2.0, 3.0, 6.0))
}

/// Returns the largest distance of a point from the origin of view space, or 1 if there are no
/// points or all are at the origin.
fn bounding_radius(points: &[Point<View>]) -> f64 {
    let most = points.iter().map(|point| point.raw().length()).fold(0.0, f64::max);
    if most > 0.0 { most } else { 1.0 }
}

impl ProjectedBounds {
    /// Returns the bounding box of the projected points, or `None` if there are no points or if one
    /// has w ≤ 0, which puts it behind the eye.
    fn from_points(points: &[Point<View>], map: Projective<View, View>) -> Option<Self> {
        let nothing = DVec3::splat(f64::INFINITY);
        let mut image = Self { low: nothing, high: -nothing };
        for &point in points {
            let seen = map.transform_point(point);
            let seen = seen.raw();
            if seen.w <= 0.0 {
                return None;
            }
            let place = seen.truncate() / seen.w;
            (image.low, image.high) = (image.low.min(place), image.high.max(place));
        }
        (image.low.is_finite() && image.high.is_finite()).then_some(image)
    }

    /// Returns the orthographic volume around the box, with the picture's aspect ratio.
    ///
    /// The window grows along the shorter direction, then by 1 / (1 − 2 padding). The near and far
    /// planes get a margin of 1% of the larger of depth and height, so that no vertex is on a
    /// plane. A box without width and height gets its depth as its height, but at least 1.
    fn view_volume(self, aspect: f64, padding: f64) -> Result<Orthographic, ProjectionError> {
        let (size, middle) = (self.high - self.low, (self.high + self.low) * 0.5);
        let height = size.y.max(size.x / aspect);
        let height = if height > 0.0 { height } else { size.z.max(1.0) };
        let half = 0.5 * height / (1.0 - 2.0 * padding.clamp(0.0, 0.49));
        let (right, top) = (half * aspect, half);
        let room = size.z.max(height) * 0.01;
        let window = [middle.x - right, middle.x + right, middle.y - top, middle.y + top];
        let [left, right, bottom, top] = window;
        Orthographic::new(left, right, bottom, top, -self.high.z - room, -self.low.z + room)
    }
}
