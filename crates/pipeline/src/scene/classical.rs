//! The classical projections: axonometric, oblique, planometric, and perspectives by vanishing
//! points. Each of them fits its own window around the models.
//!
//! - Projections by a picture plane: the vertices are projected, the box around their images is
//!   the window, and the depths of that box are the near and far planes.
//! - Perspectives by vanishing points: the points fix the orientation of the eye and the slopes of
//!   the window beside its line of sight; framing finds the position of the eye.

use super::file::{Finite, FromFile, ProjectionFile};
use super::view_projection::{CameraResolver, PROJECTION_PATH, VIEW_PATH};
use super::{Origin, SceneError};
use camera::ViewProjection;
use camera::{Basis, Camera, Slopes, frame_perspective};
use glam::DVec3;
use homog::{Point, Projective, Vector, View};
use projection::{
    Axonometric, Classical, ConstructedPerspective, Convention, Frustum, NPoint, Oblique,
    Orthographic, Planometric, PrincipalView, ProjectionError, Window,
};

/// The box around the images of all points.
#[derive(Clone, Copy, Debug)]
struct ProjectedBounds {
    low: DVec3,
    high: DVec3,
}

impl CameraResolver<'_> {
    /// A classical projection of the models as seen from a side; the front, unless another is
    /// named.
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

    /// A classical projection before a camera that stands somewhere.
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

    /// A projection that is given by its picture plane.
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
            let help = "smaller p, q and r move the eye away: below 0.5 in all they always do";
            self.projection_error_with(
                "a part of the models is behind the eye",
                Some(help.to_owned()),
            )
        })?;
        let volume = image.view_volume(self.aspect, padding).map_err(fault)?;
        let view_to_clip = depth_kept.then(volume.view_to_clip(Convention::CHAPTER));
        Ok(ViewProjection { camera, view_to_clip })
    }

    /// A perspective that is given by vanishing points.
    fn frame_construction(
        &self,
        from: Basis,
        construction: ConstructedPerspective,
        padding: f64,
    ) -> Result<ViewProjection, SceneError> {
        let fault = |error: ProjectionError| self.projection_error(&error);
        // The rows of the rotation are the eye's axes as the side from which the models are seen
        // has them.
        let rows = construction.world_to_view().raw().transpose();
        let axis = |row: glam::DVec4| from.to_world(Vector::from_raw(row.truncate()));
        let basis = Basis::from_gaze(-axis(rows.z_axis), axis(rows.y_axis))
            .map_err(|error| self.camera_error(&error))?;
        let window = Window::new(-self.aspect, self.aspect, -1.0, 1.0).map_err(fault)?;
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
        let span = super::depth_span::DepthSpan::from_points(&self.points, framed.camera);
        let (near, far) = span.perspective_planes(None, None);
        let frustum = Frustum::from_slopes(slopes, near, far).map_err(fault)?;
        Ok(ViewProjection {
            camera: framed.camera,
            view_to_clip: frustum.view_to_clip(Convention::CHAPTER),
        })
    }
}

/// The mistake in the numbers of a classical projection, if there is one. Those by vanishing points
/// find their own eye: they need a view that is framed.
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

/// A perspective by vanishing points before a camera whose position is given.
fn own_eye_error(origin: &Origin) -> SceneError {
    let help = "take Frame(from: …), or leave the view out".to_owned();
    let message = "a perspective by vanishing points finds its own eye";
    origin.error_at(&VIEW_PATH, message, Some(help))
}

/// The construction, for the projections that are given by vanishing points.
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

/// The projection that is given by its picture plane; `radius` is that of the models about the
/// camera.
fn picture_plane_projection(
    projection: &ProjectionFile,
    radius: f64,
) -> Result<Classical, ProjectionError> {
    // People say where depth recedes to; the builder wants where it comes from.
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

/// From (2, 3, 6), as the camera of that name sees.
fn default_trimetric() -> Result<Axonometric, ProjectionError> {
    Axonometric::by_normal(homog::Normal::new(2.0, 3.0, 6.0))
}

/// The greatest distance of a point from the camera; 1 if there is none.
fn bounding_radius(points: &[Point<View>]) -> f64 {
    let most = points.iter().map(|point| point.raw().length()).fold(0.0, f64::max);
    if most > 0.0 { most } else { 1.0 }
}

impl ProjectedBounds {
    /// The box around the images; `None` if a point has none or lies behind the eye.
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

    /// The volume with everything in it, of this aspect, with a part of its sides free.
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
