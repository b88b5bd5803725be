//! Lenses in a scene file: the field of view and shift of a perspective, the windows of other
//! projections, and the mistakes in them.
//!
//! ```text
//!             2 max(hx, hy) · shift            the window one unit ahead of the eye, moved by the
//!          ┌──┬──────────┬──┐                  shift: half width hx = tan(fov_x/2),
//!   eye ●──┤  │    ●     │  │                  half height hy = tan(fov_y/2)
//!          └──┴──────────┴──┘
//! ```

use super::Origin;
use super::calibrated_lens::calibrated_lens;
use super::camera_fields::PROJECTION_PATH;
use homog::{Clip, Projective, View};
use projection::{
    ApexMovedFrustum, Convention, Fov, Frustum, Orthographic, Perspective, ProjectionError, Window,
};
use scene_file::PathStep::Field;
use scene_file::SceneError;
use scene_file::file::{FieldOfView, Finite, Positive, ProjectionFile};

/// The lens of a perspective: its field of view and its shift.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Lens {
    pub(super) fov: Fov,
    /// The shift to the right and up, in fractions of the picture's longer side.
    shift: [f64; 2],
}

impl Lens {
    /// Creates a lens from a vertical, horizontal or diagonal field of view. If several are set,
    /// which is an error, the first is used.
    pub(super) fn new(angles: [Option<FieldOfView>; 3], shift: (Finite, Finite)) -> Self {
        let radians = |angle: FieldOfView| angle.value().to_radians();
        let fov = match angles {
            [None, Some(angle), _] => Fov::Horizontal(radians(angle)),
            [None, None, Some(angle)] => Fov::Diagonal(radians(angle)),
            [angle, ..] => Fov::Vertical(radians(angle.unwrap_or_default())),
        };
        let (x, y) = shift;
        Self { fov, shift: [x.value(), y.value()] }
    }

    /// Returns the lens of a perspective, or `None` for other projections.
    pub(super) fn from_file(projection: &ProjectionFile) -> Option<Self> {
        match *projection {
            ProjectionFile::Perspective {
                fov_y_degrees: y,
                fov_x_degrees: x,
                fov_diagonal_degrees: diagonal,
                shift,
                ..
            } => Some(Self::new([y, x, diagonal], shift)),
            _ => None,
        }
    }

    /// Whether the lens is centered on the picture.
    pub(super) fn is_centered(self) -> bool {
        self.shift == [0.0; 2]
    }

    /// Returns the borders of the window one unit ahead of the eye (FOV-1), for a picture with this
    /// aspect ratio.
    pub(super) fn slopes(self, aspect: f64) -> Result<Window, ProjectionError> {
        let half = self.fov.half_slopes(aspect)?;
        let window = Window::centered(2.0 * half.x, 2.0 * half.y)?;
        if self.is_centered() {
            return Ok(window);
        }
        let [dx, dy] = self.shift.map(|fraction| fraction * 2.0 * half.x.max(half.y));
        Window::new(
            window.left() + dx,
            window.right() + dx,
            window.bottom() + dy,
            window.top() + dy,
        )
    }

    /// Returns the matrix from view space to clip space.
    pub(super) fn view_to_clip(
        self,
        aspect: f64,
        [near, far]: [f64; 2],
    ) -> Result<Projective<View, Clip>, ProjectionError> {
        if self.is_centered() {
            return Perspective::new(self.fov, aspect, near, far)
                .map(|lens| lens.view_to_clip(Convention::CHAPTER));
        }
        let frustum = Frustum::from_slopes(self.slopes(aspect)?, near, far)?;
        Ok(frustum.view_to_clip(Convention::CHAPTER))
    }
}

/// Returns the window of a projection with four borders, or `None` for other projections.
pub(super) fn given_window(projection: &ProjectionFile) -> Option<[f64; 4]> {
    let sides = match *projection {
        ProjectionFile::Frustum { left, right, bottom, top, .. }
        | ProjectionFile::ApexMovedFrustum { left, right, bottom, top, .. } => {
            [left, right, bottom, top]
        }
        ProjectionFile::Orthographic { left, right, bottom, top, .. } => {
            [left?, right?, bottom?, top?]
        }
        _ => return None,
    };
    Some(sides.map(Finite::value))
}

/// Returns a lens or window error that does not depend on models: mutually exclusive fields, or
/// planes or borders in the wrong order.
pub(super) fn check_lens(origin: &Origin, projection: &ProjectionFile) -> Option<SceneError> {
    check_lens_fields(origin, projection).or_else(|| {
        let error = check_planes(projection)?;
        let is_order = matches!(error, ProjectionError::FarNotBeyondNear { .. });
        let order = "planes are distances from the eye; `near` must be the smaller one";
        let help = is_order.then(|| order.to_owned());
        Some(origin.error_at(&PROJECTION_PATH, error.to_string(), help))
    })
}

/// Returns the error for mutually exclusive fields in a projection, or for fields that are
/// incomplete without others.
pub(super) fn check_lens_fields(
    origin: &Origin,
    projection: &ProjectionFile,
) -> Option<SceneError> {
    check_fields_of_view(origin, projection)
        .or_else(|| check_orthographic_window(origin, projection))
}

/// Checks that a perspective has at most one field of view.
fn check_fields_of_view(origin: &Origin, projection: &ProjectionFile) -> Option<SceneError> {
    let ProjectionFile::Perspective { fov_y_degrees, fov_x_degrees, fov_diagonal_degrees, .. } =
        projection
    else {
        return None;
    };
    let given: Vec<&str> = [
        (fov_y_degrees, "fov_y_degrees"),
        (fov_x_degrees, "fov_x_degrees"),
        (fov_diagonal_degrees, "fov_diagonal_degrees"),
    ]
    .into_iter()
    .filter_map(|(angle, name)| angle.as_ref().map(|_| name))
    .collect();
    let &[first, second, ..] = given.as_slice() else { return None };
    let message = format!("`{second}` and `{first}` both set the field of view");
    let help = "keep one of them; the other follows from the aspect ratio".to_owned();
    let path = [&PROJECTION_PATH[..], &[Field(second)]].concat();
    Some(origin.error_at(&path, message, Some(help)))
}

/// Checks that an orthographic window has a height, all four borders, or neither.
fn check_orthographic_window(origin: &Origin, projection: &ProjectionFile) -> Option<SceneError> {
    let ProjectionFile::Orthographic { height, left, right, bottom, top, .. } = projection else {
        return None;
    };
    let borders = [(left, "left"), (right, "right"), (bottom, "bottom"), (top, "top")];
    let names = |is_given: bool| {
        let names = borders.iter().filter(move |(side, _)| side.is_some() == is_given);
        names.map(|(_, name)| *name).collect::<Vec<&'static str>>()
    };
    let (given, missing) = (names(true), names(false));
    let &first = given.first()?;
    let (at, message, help) = if height.is_some() {
        let message = format!("`height` and `{first}` both set the window");
        ("height", message, "keep either the height or the four borders".to_owned())
    } else if !missing.is_empty() {
        let message = format!("the window has only `{}`", given.join("`, `"));
        let rest: Vec<String> = missing.iter().map(|name| format!("`{name}: …`")).collect();
        (first, message, format!("add {}, or set the height instead", rest.join(", ")))
    } else {
        return None;
    };
    let path = [&PROJECTION_PATH[..], &[Field(at)]].concat();
    Some(origin.error_at(&path, message, Some(help)))
}

/// Returns the error for a projection with planes or borders in the wrong order.
fn check_planes(projection: &ProjectionFile) -> Option<ProjectionError> {
    // Omitted values get valid defaults, so that only values in the file can cause an error.
    let [l, r, b, t] = given_window(projection).unwrap_or([-1.0, 1.0, -1.0, 1.0]);
    let far_of =
        |near: Positive, far: Option<Positive>| far.map_or(2.0 * near.value(), Positive::value);
    match *projection {
        ProjectionFile::Perspective { near, far, .. } => {
            let near = near.map_or(far.map_or(1.0, |far| 0.5 * far.value()), Positive::value);
            let far = far.map_or(2.0 * near, Positive::value);
            Lens::from_file(projection)?.view_to_clip(1.0, [near, far]).err()
        }
        ProjectionFile::Orthographic { near, far, .. } => {
            let near = near.map_or(far.map_or(0.0, |far| far.value() - 1.0), Finite::value);
            let far = far.map_or(near + 1.0, Finite::value);
            Orthographic::new(l, r, b, t, near, far).err()
        }
        ProjectionFile::Frustum { near, far, .. } => {
            Frustum::new(l, r, b, t, near.value(), far_of(near, far)).err()
        }
        ProjectionFile::ApexMovedFrustum { near, far, .. } => {
            ApexMovedFrustum::new(l, r, b, t, near.value(), far_of(near, far)).err()
        }
        ProjectionFile::Intrinsics { near, far, .. } => {
            let near = near.map_or(far.map_or(1.0, |far| 0.5 * far.value()), Positive::value);
            let far = far.map_or(2.0 * near, Positive::value);
            // The picture size does not affect the order of the planes.
            let lens = calibrated_lens(projection, [640, 480])?;
            lens.and_then(|lens| lens.view_to_clip([near, far], Convention::CHAPTER)).err()
        }
        _ => None,
    }
}
