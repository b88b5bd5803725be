//! The camera: an eye and an orientation, and the rigid map M_cam between world and view space
//! (CA-2).
//!
//! ```text
//!         [ xu yu zu 0 ] [ 1 0 0 -xe ]
//! M_cam = [ xv yv zv 0 ] [ 0 1 0 -ye ]     first move the eye to the origin,
//!         [ xw yw zw 0 ] [ 0 0 1 -ze ]     then rotate u, v, w to x, y, z
//!         [ 0  0  0  1 ] [ 0 0 0  1  ]
//! ```
//!
//! Source: the textbook (Shirley and Marschner, ch. 8), §8.1.3, formula CA-2. (In one set of notes,
//! the third row of the translation is misprinted as 0 0 0 −ze, M11. That matrix is singular and
//! puts every point at the same depth.)

use crate::{Basis, CameraError};
use homog::{Affine, Point, Space, Vector, View, World};

/// The largest coordinate of an eye for which u · e is still finite.
const EYE_LIMIT: f64 = f64::MAX / 4.0;

/// The position and orientation of a camera. The lens is part of the projection.
///
/// A `Camera` is always usable: every constructor rejects input that would give NaN.
///
/// ```
/// use camera::Camera;
/// use homog::{Point, Vector};
/// let camera = Camera::look_at(Point::new(0.0, 2.0, 5.0), Point::new(0.0, 2.0, 0.0), Vector::Y)?;
/// let seen = camera.world_to_view().transform_point(Point::new(1.0, 2.0, 0.0));
/// assert_eq!(seen, Point::new(1.0, 0.0, -5.0)); // one to the right, five ahead
/// # Ok::<(), camera::CameraError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Camera {
    eye: Point<World>,
    basis: Basis,
}

impl Camera {
    /// Creates a camera at `eye` with this orientation.
    ///
    /// # Errors
    /// Returns an error if the eye is not finite or has a coordinate beyond a quarter of the
    /// largest f64.
    pub fn new(eye: Point<World>, basis: Basis) -> Result<Self, CameraError> {
        check_position(eye, "eye")?;
        if eye.raw().abs().max_element() > EYE_LIMIT {
            return Err(CameraError::EyeTooFar { eye, limit: EYE_LIMIT });
        }
        Ok(Self { eye, basis })
    }

    /// Creates a camera at `eye`, with `target` at the center of the picture and `up` toward the
    /// top.
    ///
    /// # Errors
    /// Returns an error if the eye and the target are the same, if `up` is zero or parallel to the
    /// gaze, or if a coordinate is not finite.
    pub fn look_at(
        eye: Point<World>,
        target: Point<World>,
        up: Vector<World>,
    ) -> Result<Self, CameraError> {
        Self::new(eye, Basis::from_gaze(gaze_between(eye, target)?, up)?)
    }

    /// Creates a camera at `eye` that looks along `gaze`, with `up` toward the top of the picture.
    /// The lengths of the vectors do not matter.
    ///
    /// # Errors
    /// Returns an error if the gaze or `up` is zero, if they are parallel, or if a coordinate is
    /// not finite.
    pub fn look_to(
        eye: Point<World>,
        gaze: Vector<World>,
        up: Vector<World>,
    ) -> Result<Self, CameraError> {
        Self::new(eye, Basis::from_gaze(gaze, up)?)
    }

    /// Like [`look_at`](Self::look_at), but uses [`Basis::fallback_up`] if `up` is zero or parallel
    /// to the gaze: −z when looking down, +z when looking up, and +y otherwise.
    ///
    /// # Errors
    /// Returns an error if the eye and the target are the same or a coordinate is not finite.
    pub fn look_at_or_fallback(
        eye: Point<World>,
        target: Point<World>,
        up: Vector<World>,
    ) -> Result<Self, CameraError> {
        Self::new(eye, Basis::from_gaze_or_fallback(gaze_between(eye, target)?, up)?)
    }

    /// Like [`look_to`](Self::look_to), but uses [`Basis::fallback_up`] if `up` is zero or parallel
    /// to the gaze: −z when looking down, +z when looking up, and +y otherwise.
    ///
    /// # Errors
    /// Returns an error if the gaze is zero or a coordinate is not finite.
    pub fn look_to_or_fallback(
        eye: Point<World>,
        gaze: Vector<World>,
        up: Vector<World>,
    ) -> Result<Self, CameraError> {
        Self::new(eye, Basis::from_gaze_or_fallback(gaze, up)?)
    }

    /// Creates a camera at the origin of a frame, looking along the frame's −z axis with +y up,
    /// like a camera node in glTF. The frame may be scaled, sheared or mirrored; the camera is not.
    ///
    /// # Errors
    /// Returns an error if the frame is not finite or its z axis is zero or parallel to its y axis.
    pub fn from_frame<L: Space>(local_to_world: Affine<L, World>) -> Result<Self, CameraError> {
        let gaze = local_to_world.transform_vector(-Vector::Z);
        let up = local_to_world.transform_vector(Vector::Y);
        Self::look_to(local_to_world.transform_point(Point::ORIGIN), gaze, up)
    }

    /// Returns the position of the camera, which is the center of projection of a perspective
    /// projection.
    #[must_use]
    pub const fn eye(self) -> Point<World> {
        self.eye
    }

    /// Returns the orientation.
    #[must_use]
    pub const fn basis(self) -> Basis {
        self.basis
    }

    /// Returns the direction to the right in the picture: the unit vector u of CA-1.
    #[must_use]
    pub const fn u(self) -> Vector<World> {
        self.basis.u()
    }

    /// Returns the direction to the right in the picture, the same as [`u`](Self::u).
    #[must_use]
    pub const fn right(self) -> Vector<World> {
        self.basis.u()
    }

    /// Returns the direction up in the picture: the unit vector v of CA-1, perpendicular to the
    /// gaze.
    #[must_use]
    pub const fn v(self) -> Vector<World> {
        self.basis.v()
    }

    /// Returns the direction toward the viewer, opposite to the gaze: the unit vector w of CA-1.
    #[must_use]
    pub const fn w(self) -> Vector<World> {
        self.basis.w()
    }

    /// Returns the gaze direction: −w, a unit vector.
    #[must_use]
    pub fn gaze(self) -> Vector<World> {
        self.basis.gaze()
    }

    /// Returns M_cam (CA-2), which maps the eye to the origin and gives points in front of the
    /// camera a negative z.
    #[must_use]
    pub fn world_to_view(self) -> Affine<World, View> {
        self.translation().then(self.rotation())
    }

    /// Returns the inverse of M_cam, without elimination: its columns are u, v, w and the eye.
    #[must_use]
    pub fn view_to_world(self) -> Affine<View, World> {
        Affine::from_frame(self.u(), self.v(), self.w(), self.eye)
    }

    /// Returns the right factor of M_cam, applied first: it moves the eye to the origin.
    #[must_use]
    pub fn translation(self) -> Affine<World, World> {
        Affine::translation(Point::ORIGIN - self.eye)
    }

    /// Returns the left factor of M_cam, applied second: it maps u, v, w to the axes of view space.
    #[must_use]
    pub fn rotation(self) -> Affine<World, View> {
        self.basis.world_to_view_rotation()
    }

    /// Returns this camera moved by `by`, with its orientation unchanged.
    ///
    /// # Errors
    /// Returns an error if [`Camera::new`] rejects the new eye.
    pub fn moved(self, by: Vector<World>) -> Result<Self, CameraError> {
        Self::new(self.eye + by, self.basis)
    }
}

fn gaze_between(eye: Point<World>, target: Point<World>) -> Result<Vector<World>, CameraError> {
    check_position(eye, "eye")?;
    check_position(target, "target")?;
    let gaze = target - eye;
    if gaze == Vector::ZERO {
        return Err(CameraError::TargetIsEye { eye });
    }
    // The difference between two huge points on opposite sides may overflow; half of it does not.
    let half = || Vector::from_raw(target.raw() * 0.5 - eye.raw() * 0.5);
    Ok(if gaze.is_finite() { gaze } else { half() })
}

fn check_position(place: Point<World>, name: &'static str) -> Result<(), CameraError> {
    let value = place - Point::ORIGIN;
    if place.is_finite() { Ok(()) } else { Err(CameraError::NotFinite { name, value }) }
}
