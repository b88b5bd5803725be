//! The orientation of a camera: three perpendicular unit vectors (CA-1).
//!
//! ```text
//!        v (up in the picture)        w = −g / ‖g‖          opposite to the gaze
//!        │   view-up t                u = (t × w) / ‖t × w‖   to the right
//!        │  ╱                         v = w × u             up
//!        │ ╱
//!      eye ────── u (right)           The view-up t need not be perpendicular to the gaze g;
//!      ╱                              it only determines which side of the picture is up.
//!     w          g points from the eye into the page, opposite to w
//! ```
//!
//! Source: the textbook (Shirley and Marschner, ch. 8), §8.1.3, formula CA-1.

use crate::{CameraError, exact_cross};
use homog::{Affine, Point, Vector, View, World};

/// Vectors count as parallel if ‖t × g‖ is at most this fraction of ‖t‖ ‖g‖. Directions a millionth
/// of a radian apart are far above this limit.
const PARALLEL_SINE: f64 = 1e-12;

/// The orientation of a camera: right-handed orthonormal axes u (right), v (up), w (backward) in
/// world space.
///
/// ```
/// use camera::Basis;
/// use homog::Vector;
/// let down = Basis::from_gaze(Vector::new(0.0, -1.0, 0.0), Vector::new(1.0, 1.0, 0.0))?;
/// assert_eq!(down.u(), Vector::Z);
/// assert_eq!(down.v(), Vector::X);
/// assert_eq!(down.w(), Vector::Y);
/// # Ok::<(), camera::CameraError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Basis {
    u: Vector<World>,
    v: Vector<World>,
    w: Vector<World>,
}

impl Basis {
    /// The world axes: looking along −z with y up.
    pub const WORLD: Self = Self { u: Vector::X, v: Vector::Y, w: Vector::Z };

    /// Creates a basis that looks along `gaze`, with `up` toward the top of the picture (CA-1). The
    /// lengths of the vectors do not matter.
    ///
    /// # Errors
    /// Returns an error if a vector is zero or not finite, or if `up` is parallel to the gaze.
    /// Vectors are considered parallel if the sine of the angle between them is at most 10⁻¹².
    pub fn from_gaze(gaze: Vector<World>, up: Vector<World>) -> Result<Self, CameraError> {
        let backwards = -unit_vector(gaze, "gaze", CameraError::ZeroGaze)?;
        unit_vector(up, "view-up", CameraError::ZeroUp)?;
        let right = exact_cross::cross_exact(gaze.raw(), up.raw());
        let lengths = exact_cross::scale_near_one(gaze.raw()).length()
            * exact_cross::scale_near_one(up.raw()).length();
        if right.length() <= PARALLEL_SINE * lengths {
            let suggestion = Self::fallback_up(gaze);
            return Err(CameraError::UpParallelToGaze { up, gaze, suggestion });
        }
        Ok(Self::from_right(Vector::from_raw(right), backwards))
    }

    /// Like [`from_gaze`](Self::from_gaze), but uses [`fallback_up`](Self::fallback_up) if `up` is
    /// zero or parallel to the gaze.
    ///
    /// # Errors
    /// Returns an error if the gaze is zero or a vector is not finite.
    pub fn from_gaze_or_fallback(
        gaze: Vector<World>,
        up: Vector<World>,
    ) -> Result<Self, CameraError> {
        Self::from_gaze(gaze, up).or_else(|error| match error {
            CameraError::ZeroUp | CameraError::UpParallelToGaze { .. } => {
                Self::from_gaze(gaze, Self::fallback_up(gaze))
            }
            other => Err(other),
        })
    }

    /// Returns a substitute for an unusable view-up: −z when looking mostly down (as on a map with
    /// north at the top), +z when looking mostly up, and +y otherwise. It is always at least 45°
    /// from the gaze.
    #[must_use]
    pub fn fallback_up(gaze: Vector<World>) -> Vector<World> {
        let [x, y, z] = gaze.raw().abs().to_array();
        match () {
            () if x.max(z) > y => Vector::Y,
            () if gaze.y() < 0.0 => -Vector::Z,
            () => Vector::Z,
        }
    }

    /// Creates a basis from w = `backwards`, which must have length 1, and `right`, which must be
    /// perpendicular to it and may have any length.
    fn from_right(right: Vector<World>, backwards: Vector<World>) -> Self {
        let w = backwards;
        let right = right / right.length();
        // The two vectors were rounded independently; this removes the error in the last digit
        // along w.
        let right = right - w * right.dot(w);
        let u = right / right.length();
        let v = w.cross(u);
        Self { u, v: v / v.length(), w }
    }

    /// Creates a basis from axes that are orthonormal by construction.
    pub(crate) const fn from_orthonormal(
        u: Vector<World>,
        v: Vector<World>,
        w: Vector<World>,
    ) -> Self {
        Self { u, v, w }
    }

    /// Returns the unit vector that points right in the picture.
    #[must_use]
    pub const fn u(self) -> Vector<World> {
        self.u
    }

    /// Returns the unit vector that points up in the picture.
    #[must_use]
    pub const fn v(self) -> Vector<World> {
        self.v
    }

    /// Returns the unit vector that points out of the picture toward the viewer, opposite to the
    /// gaze.
    #[must_use]
    pub const fn w(self) -> Vector<World> {
        self.w
    }

    /// Returns the gaze direction: −w, a unit vector.
    #[must_use]
    pub fn gaze(self) -> Vector<World> {
        -self.w
    }

    /// Returns the rotation that maps u, v, w to the axes x, y, z of view space: the left factor of
    /// M_cam (CA-2).
    #[must_use]
    pub fn world_to_view_rotation(self) -> Affine<World, View> {
        let [u, v, w] = [self.u, self.v, self.w];
        let column = |x: f64, y: f64, z: f64| Vector::new(x, y, z);
        Affine::from_frame(
            column(u.x(), v.x(), w.x()),
            column(u.y(), v.y(), w.y()),
            column(u.z(), v.z(), w.z()),
            Point::ORIGIN,
        )
    }

    /// Returns the world vector with these coordinates along u, v and w.
    #[must_use]
    pub fn to_world(self, along: Vector<View>) -> Vector<World> {
        self.u * along.x() + self.v * along.y() + self.w * along.z()
    }

    /// Returns the coordinates of a world vector along u, v and w.
    #[must_use]
    pub fn to_view(self, vector: Vector<World>) -> Vector<View> {
        Vector::new(self.u.dot(vector), self.v.dot(vector), self.w.dot(vector))
    }
}

/// Returns the unit vector along `vector`, or an error if it is zero or not finite.
fn unit_vector(
    vector: Vector<World>,
    name: &'static str,
    zero: CameraError,
) -> Result<Vector<World>, CameraError> {
    if !vector.is_finite() {
        return Err(CameraError::NotFinite { name, value: vector });
    }
    vector.normalized().ok_or(zero)
}
