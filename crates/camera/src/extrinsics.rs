//! Extrinsic parameters: the camera position and orientation as stored by calibration tools,
//! photogrammetry software and data sets.
//!
//! ```text
//!  camera = R · world + t      eye = −Rᵀ t       pose [Rᵀ | eye]: camera to world
//!
//!            x       y      z
//!  OpenCv    right   down   forward      OpenCV, COLMAP, optical frames of ROS
//!  OpenGl    right   up     backward     OpenGL, Blender, glTF, NeRF; view space here
//!  Pytorch3d left    up     forward      PyTorch3D
//! ```
//!
//! All three are right-handed and differ by half turns about one axis.
//!
//! Source: R. Hartley, A. Zisserman, *Multiple View Geometry in Computer Vision*, 2nd ed., 2004,
//! §6.1.

use crate::{Basis, Camera, CameraError};
use homog::{Point, Vector, World};

/// The tolerance for dot products of rotation rows; matrices are often written with six digits.
const ROTATION_TOLERANCE: f64 = 1e-4;

/// The directions of the camera axes in the picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum CameraAxes {
    /// x right, y down, z forward: OpenCV, COLMAP and ROS optical frames.
    #[default]
    OpenCv,
    /// x right, y up, z backward: OpenGL, Blender, glTF, NeRF and this project's view space.
    OpenGl,
    /// x left, y up, z forward: PyTorch3D.
    Pytorch3d,
}

impl CameraAxes {
    /// Returns the signs that convert view coordinates (right, up, backward) to these axes and
    /// back.
    const fn signs(self) -> [f64; 3] {
        match self {
            Self::OpenCv => [1.0, -1.0, -1.0],
            Self::OpenGl => [1.0, 1.0, 1.0],
            Self::Pytorch3d => [-1.0, 1.0, -1.0],
        }
    }
}

/// A rotation R and a translation t from world to camera space: camera = R · world + t.
///
/// # Guarantees
/// All numbers are finite, and R is a rotation to within 10⁻⁴.
///
/// ```
/// use camera::{CameraAxes, Extrinsics};
/// use homog::Point;
/// // An OpenCV camera that looks along world +z, three units in front of the origin.
/// let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let extrinsics = Extrinsics::new(identity, [0.0, 0.0, 3.0], CameraAxes::OpenCv)?;
/// let camera = extrinsics.to_camera()?;
/// assert_eq!(camera.eye(), Point::new(0.0, 0.0, -3.0));
/// assert_eq!(camera.v().y(), -1.0); // +y of the world is down in the picture
/// # Ok::<(), camera::CameraError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Extrinsics {
    rotation: [[f64; 3]; 3],
    translation: [f64; 3],
    axes: CameraAxes,
}

impl Extrinsics {
    /// Creates the parameters for camera = R · world + t, where `rotation` is R row by row.
    ///
    /// # Errors
    /// Returns an error if a number is not finite or the matrix is not a rotation to within 10⁻⁴.
    pub fn new(
        rotation: [[f64; 3]; 3],
        translation: [f64; 3],
        axes: CameraAxes,
    ) -> Result<Self, CameraError> {
        for (name, row) in ["first row", "second row", "third row"].into_iter().zip(rotation) {
            check_finite(name, row)?;
        }
        check_finite("translation", translation)?;
        check_rotation(rotation)?;
        Ok(Self { rotation, translation, axes })
    }

    /// Creates the parameters of a camera at `eye` whose camera-to-world rotation has these axes as
    /// columns.
    ///
    /// # Errors
    /// See [`new`](Self::new).
    pub fn from_pose(
        rotation: [[f64; 3]; 3],
        eye: [f64; 3],
        axes: CameraAxes,
    ) -> Result<Self, CameraError> {
        let rotation = transpose(rotation);
        let translation = rotate(rotation, eye).map(|coordinate| -coordinate);
        check_finite("eye", eye)?;
        Self::new(rotation, translation, axes)
    }

    /// Creates the parameters from a world-to-camera quaternion (w, x, y, z) and translation, as in
    /// COLMAP's `images.txt`. The quaternion need not have length 1.
    ///
    /// # Errors
    /// Returns an error if a number is not finite or the quaternion has length 0.
    pub fn from_quaternion(
        [w, x, y, z]: [f64; 4],
        translation: [f64; 3],
        axes: CameraAxes,
    ) -> Result<Self, CameraError> {
        check_finite("vector part of the quaternion", [x, y, z])?;
        check_finite("real part of the quaternion", [w, 0.0, 0.0])?;
        // Scale first, to keep the squares from overflowing or underflowing.
        let largest = [w, x, y, z].into_iter().fold(0.0, |most: f64, part| most.max(part.abs()));
        if largest == 0.0 {
            return Err(CameraError::ZeroQuaternion);
        }
        let [w, x, y, z] = [w, x, y, z].map(|part| part / largest);
        let s = 2.0 / (w * w + x * x + y * y + z * z);
        let rotation = [
            [1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
            [s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)],
            [s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)],
        ];
        Self::new(rotation, translation, axes)
    }

    /// Creates the parameters from PyTorch3D's R and T, which apply to row vectors: camera = world
    /// · R + T.
    ///
    /// # Errors
    /// See [`new`](Self::new).
    pub fn from_pytorch3d(
        rotation: [[f64; 3]; 3],
        translation: [f64; 3],
    ) -> Result<Self, CameraError> {
        Self::new(transpose(rotation), translation, CameraAxes::Pytorch3d)
    }

    /// Returns the parameters of a camera in these axes.
    #[must_use]
    pub fn from_camera(camera: Camera, axes: CameraAxes) -> Self {
        let from_eye = camera.eye() - Point::ORIGIN;
        let row = |axis: Vector<World>, sign: f64| (axis * sign).raw().to_array();
        let [x, y, z] = axes.signs();
        let rotation = [row(camera.u(), x), row(camera.v(), y), row(camera.w(), z)];
        let translation = [
            -camera.u().dot(from_eye) * x,
            -camera.v().dot(from_eye) * y,
            -camera.w().dot(from_eye) * z,
        ];
        Self { rotation, translation, axes }
    }

    /// Returns the camera with these parameters. A rotation with rounded numbers is corrected: the
    /// direction of the third row is unchanged, and the second row is made perpendicular to it.
    ///
    /// # Errors
    /// Returns an error if the translation is so large that the eye is out of range.
    pub fn to_camera(self) -> Result<Camera, CameraError> {
        let signs = self.axes.signs();
        let [_, up, backwards] = [0, 1, 2].map(|row| {
            let [x, y, z] = self.rotation[row].map(|entry| entry * signs[row]);
            Vector::<World>::new(x, y, z)
        });
        let basis = Basis::from_gaze(-backwards, up)?;
        let [x, y, z] = [0, 1, 2].map(|row| self.translation[row] * signs[row]);
        let eye = basis.u() * -x + basis.v() * -y + basis.w() * -z;
        Camera::new(Point::ORIGIN + eye, basis)
    }

    /// Returns the parameters of the same camera in other axes.
    #[must_use]
    pub fn in_axes(self, axes: CameraAxes) -> Self {
        let (from, to) = (self.axes.signs(), axes.signs());
        let flip = |row: usize| from[row] * to[row];
        let rotation = [0, 1, 2].map(|row| self.rotation[row].map(|entry| entry * flip(row)));
        let translation = [0, 1, 2].map(|row| self.translation[row] * flip(row));
        Self { rotation, translation, axes }
    }

    /// Returns R row by row: the rotation from world axes to camera axes.
    #[must_use]
    pub const fn rotation(self) -> [[f64; 3]; 3] {
        self.rotation
    }

    /// Returns t, the world origin in camera space.
    #[must_use]
    pub const fn translation(self) -> [f64; 3] {
        self.translation
    }

    /// Returns the directions of the axes.
    #[must_use]
    pub const fn axes(self) -> CameraAxes {
        self.axes
    }

    /// Returns the camera-to-world pose: a rotation, row by row, and the eye.
    #[must_use]
    pub fn to_pose(self) -> ([[f64; 3]; 3], [f64; 3]) {
        let rotation = transpose(self.rotation);
        (rotation, rotate(rotation, self.translation).map(|coordinate| -coordinate))
    }

    /// Returns the rotation as a quaternion (w, x, y, z) of length 1 with w ≥ 0.
    ///
    /// Source: S. W. Shepperd, *Quaternion from Rotation Matrix*, 1978: the largest component is
    /// computed first, to avoid dividing by a small number.
    #[must_use]
    pub fn to_quaternion(self) -> [f64; 4] {
        let [[a, b, c], [d, e, f], [g, h, i]] = self.rotation;
        let squares = [a + e + i, a - e - i, e - a - i, i - a - e];
        let largest =
            (1..4).fold(0, |at, next| if squares[next] > squares[at] { next } else { at });
        let quaternion = match largest {
            0 => [1.0 + squares[0], h - f, c - g, d - b],
            1 => [h - f, 1.0 + squares[1], b + d, c + g],
            2 => [c - g, b + d, 1.0 + squares[2], f + h],
            _ => [d - b, c + g, f + h, 1.0 + squares[3]],
        };
        let length = libm::sqrt(quaternion.into_iter().map(|part| part * part).sum());
        let sign = if quaternion[0] < 0.0 { -1.0 } else { 1.0 };
        quaternion.map(|part| sign * part / length)
    }
}

/// Checks that the three numbers are finite.
fn check_finite(name: &'static str, value: [f64; 3]) -> Result<(), CameraError> {
    let value = Vector::from(value);
    if value.is_finite() { Ok(()) } else { Err(CameraError::NotFinite { name, value }) }
}

/// Checks that the rows are perpendicular unit vectors and that the matrix does not mirror.
fn check_rotation(rotation: [[f64; 3]; 3]) -> Result<(), CameraError> {
    let [x, y, z] = rotation.map(Vector::<World>::from);
    let lengths = [x, y, z].map(|row| row.dot(row) - 1.0);
    let angles = [x.dot(y), y.dot(z), z.dot(x)];
    let deviation = lengths.into_iter().chain(angles).fold(0.0, |most: f64, d| most.max(d.abs()));
    // On overflow, the deviation is infinite.
    if deviation > ROTATION_TOLERANCE {
        return Err(CameraError::NotRotation { deviation });
    }
    if x.cross(y).dot(z) < 0.0 {
        return Err(CameraError::MirroringRotation);
    }
    Ok(())
}

/// Returns the transpose of the matrix.
fn transpose(rows: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|column| [0, 1, 2].map(|row: usize| rows[row][column]))
}

/// Applies a matrix to a vector.
fn rotate(rows: [[f64; 3]; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    rows.map(|[a, b, c]| a * x + b * y + c * z)
}
