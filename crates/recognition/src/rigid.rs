//! Readings of rigid matrices: rotations, reflections, cameras with eye, gaze and up (CA-2), their
//! poses, and model transforms.

use super::matrix_reading::factor_cost;
use super::placed::posture_cost;
use super::rounded::{Entries, Rounded, divide_entries};
use super::{MatrixMeaning, MatrixReading};
use alloc::vec::Vec;
use glam::{DMat3, DVec3};

/// The axes of a view space. A rigid matrix does not determine them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum ViewAxes {
    /// x right, y up, and the camera looks along −z, as in OpenGL and the textbook.
    OpenGl,
    /// x right, y up, and the camera looks along +z, in a left-handed world, as in Direct3D.
    Direct3d,
    /// x right, y down, and the camera looks along +z, as in OpenCV and COLMAP.
    OpenCv,
}

/// The position and axes of a camera in the world, from its matrix from world to view space (CA-2).
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct CameraReading {
    /// The position of the camera.
    pub eye: [f64; 3],
    /// The gaze direction, with length 1: the textbook's −w (Shirley and Marschner, ch. 8).
    pub gaze: [f64; 3],
    /// The up direction in the picture, with length 1: the textbook's v.
    pub up: [f64; 3],
    /// The right direction in the picture, with length 1: the textbook's u.
    pub right: [f64; 3],
    /// The axes of the view space in which the matrix is read.
    pub axes: ViewAxes,
}

impl CameraReading {
    /// Returns the camera for other axes, from a camera that looks along −z with y up.
    fn with_axes(self, axes: ViewAxes) -> Self {
        let negated = |v: [f64; 3]| v.map(|x| if x == 0.0 { 0.0 } else { -x });
        let gaze = if axes == ViewAxes::OpenGl { self.gaze } else { negated(self.gaze) };
        let up = if axes == ViewAxes::OpenCv { negated(self.up) } else { self.up };
        Self { gaze, up, axes, ..self }
    }

    /// Returns the cost of a posture: rolled, upside down, or with the origin of the world behind the
    /// camera, because most cameras look at something near the origin. OpenGL's axes are the most
    /// common.
    fn posture(&self) -> u32 {
        // Few cameras are rolled, so the right axis is usually level in a world where y or z is up.
        let is_level = self.right[1..].iter().any(|x| x.abs() < 1e-9);
        let (eye, gaze) = (DVec3::from_array(self.eye), DVec3::from_array(self.gaze));
        let along = eye.dot(gaze);
        let is_exact = (eye - gaze * along).length() < 2e-3 * eye.length();
        let away = match along > 0.5 * eye.length() {
            true if is_exact => 4,
            true => 3,
            false => 0,
        };
        let rare = if self.axes == ViewAxes::OpenGl { 0 } else { 2 };
        rare + posture_cost(self) + away + if is_level { 0 } else { 4 }
    }

    /// Returns whether the camera is at the origin and looks along the z axis, in either direction.
    pub(crate) fn is_turned_round(&self) -> bool {
        self.eye == [0.0; 3] && self.gaze[2].abs() > 1.0 - 1e-6
    }
}

/// Returns whether three unit vectors are perpendicular up to rounding.
pub(crate) fn is_square_frame(axes: &[[Rounded; 3]; 3]) -> bool {
    let dot = |a: [Rounded; 3], b: [Rounded; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let slack = 1e-12 + largest_error(axes);
    let square = |a: usize, b: usize| dot(axes[a], axes[b]).is_within(0.0, slack);
    square(0, 1) && square(1, 2) && square(2, 0)
}

/// Returns the largest error of the entries. It applies to all of them: even ±1 may be rounded.
pub(crate) fn largest_error(rows: &[[Rounded; 3]; 3]) -> f64 {
    rows.as_flattened().iter().fold(0.0, |error: f64, entry| error.max(entry.error))
}

/// Returns the rows of a 3×3 matrix, made exactly orthonormal, or `None` if they are not nearly
/// orthonormal.
pub(crate) fn orthonormal_rows(rows: &[[Rounded; 3]; 3]) -> Option<[DVec3; 3]> {
    let unit = rows.iter().all(|[x, y, z]| {
        let square = *x * *x + *y * *y + *z * *z;
        square.is_within(1.0, 1e-12 + largest_error(rows))
    });
    if !unit || !is_square_frame(rows) {
        return None;
    }
    let [u, v, w] = rows.map(|row| DVec3::from_array(row.map(|entry| entry.value)));
    // Gram–Schmidt makes the rounded rows orthonormal again.
    let u = u / libm::sqrt(u.length_squared());
    let v = v - u * u.dot(v);
    let v = v / libm::sqrt(v.length_squared());
    let turned = u.cross(v);
    Some([u, v, if turned.dot(w) < 0.0 { -turned } else { turned }])
}

/// Adds the readings of a rigid matrix: rotation, camera, model transform or reflection.
pub(crate) fn read_rigid(m: &Entries<4>, found: &mut Vec<MatrixReading>) {
    let factor = m[3][3];
    if factor.is_zero() || ![m[3][0], m[3][1], m[3][2]].into_iter().all(Rounded::is_zero) {
        return;
    }
    let unit = divide_entries(m, factor);
    let linear = [0, 1, 2].map(|i| [unit[i][0], unit[i][1], unit[i][2]]);
    let offset = [unit[0][3], unit[1][3], unit[2][3]];
    let Some([u, v, w]) = orthonormal_rows(&linear) else { return };
    let stays = offset.into_iter().all(Rounded::is_zero);
    let rotation = DMat3::from_cols(u, v, w).transpose();
    let turned = u.distance(DVec3::X) > 1e-6 || v.distance(DVec3::Y) > 1e-6;
    let eye = eye_of(&linear, offset);
    let clean = |v: DVec3| v.to_array().map(|x| shorten(x, largest_error(&linear)));
    let camera = CameraReading {
        eye: eye.map(Rounded::simplest),
        gaze: clean(-w),
        up: clean(v),
        right: clean(u),
        axes: ViewAxes::OpenGl,
    };
    let mut push = |meaning: MatrixMeaning, cost: u32| {
        let (factor, cost) = (factor.simplest(), cost + factor_cost(factor));
        found.push(MatrixReading { meaning, factor, cost });
    };
    let digits = |numbers: [Rounded; 3]| numbers.iter().map(|x| x.digits()).sum::<u32>();
    if w.dot(u.cross(v)) < 0.0 {
        if let Some((meaning, cost)) = reflection(&linear, offset) {
            push(meaning, cost);
        }
        return;
    }
    if !turned {
        return;
    }
    let error = largest_error(&linear);
    let (axis, angle_degrees) = axis_angle(rotation, error);
    if stays {
        push(MatrixMeaning::Rotation { axis, angle_degrees, camera }, 6);
        return;
    }
    for camera in cameras_with_axes(camera) {
        push(MatrixMeaning::Camera(camera), 6 + camera.posture() + 2 * digits(eye));
    }
    let translation = offset.map(Rounded::simplest);
    let angle = Rounded { value: angle_degrees, error: error.to_degrees().max(1e-10) };
    let cost = turn_cost(axis, angle) + 2 * digits(offset);
    push(MatrixMeaning::ModelTransform { translation, axis, angle_degrees, scale: [1.0; 3] }, cost);
    let [right, up, backwards] = [rotation.x_axis, rotation.y_axis, rotation.z_axis];
    let pose = CameraReading {
        eye: translation,
        gaze: clean(-backwards),
        up: clean(up),
        right: clean(right),
        axes: ViewAxes::OpenGl,
    };
    if let Some(pose) = cameras_with_axes(pose).min_by_key(CameraReading::posture) {
        push(MatrixMeaning::CameraPose(pose), 8 + pose.posture() + 2 * digits(offset));
    }
}

/// Returns a camera in the axes of OpenGL and Direct3D, and in those of OpenCV if it is upside down
/// in the others.
fn cameras_with_axes(camera: CameraReading) -> impl Iterator<Item = CameraReading> {
    let is_upside_down = posture_cost(&camera) > 0;
    [ViewAxes::OpenGl, ViewAxes::Direct3d, ViewAxes::OpenCv]
        .into_iter()
        .filter(move |axes| is_upside_down || *axes != ViewAxes::OpenCv)
        .map(move |axes| camera.with_axes(axes))
}

/// Returns the cost of a rotation in a model transform. Rotations about coordinate axes by angles
/// with few digits are common, especially about the z axis in two-dimensional pictures; cameras
/// seldom roll about it.
fn turn_cost(axis: [f64; 3], angle: Rounded) -> u32 {
    match axis.map(|x| x == 0.0) {
        [true, true, false] => 2 + 2 * angle.digits(),
        [true, false, true] | [false, true, true] => 6 + 2 * angle.digits(),
        _ => 10,
    }
}

/// Returns a component of a unit vector, without digits below its rounding error.
pub(crate) fn shorten(value: f64, error: f64) -> f64 {
    Rounded { value, error: error.max(1e-13) }.simplest()
}

/// Solves R e = −t for the eye e, with the transpose of R.
fn eye_of(rows: &[[Rounded; 3]; 3], offset: [Rounded; 3]) -> [Rounded; 3] {
    [0, 1, 2].map(|j| -(rows[0][j] * offset[0] + rows[1][j] * offset[1] + rows[2][j] * offset[2]))
}

/// Reads I − 2nnᵀ with a shift along n as the reflection in the plane n·p = distance.
fn reflection(rows: &[[Rounded; 3]; 3], offset: [Rounded; 3]) -> Option<(MatrixMeaning, u32)> {
    let symmetric = (0..3).all(|i| (0..i).all(|j| rows[i][j].equals(rows[j][i])));
    let trace = rows[0][0] + rows[1][1] + rows[2][2];
    if !symmetric || !trace.is_within(1.0, 1e-12) {
        return None;
    }
    let half = Rounded::exact(0.5);
    let squares = [0, 1, 2].map(|i| (Rounded::ONE - rows[i][i]) * half);
    let largest = (0..3).max_by(|&a, &b| squares[a].value.total_cmp(&squares[b].value))?;
    let size = squares[largest].sqrt();
    let normal =
        [0, 1, 2].map(|i| if i == largest { size } else { -(rows[i][largest] * half) / size });
    let distance = offset[largest] * half / normal[largest];
    let along = (0..3).all(|i| {
        let gap = offset[i] - normal[i] * distance * Rounded::exact(2.0);
        gap.is_within(0.0, 1e-12)
    });
    let axes = normal.into_iter().filter(|n| !n.is_zero()).count() as u32;
    let cost = 2 + 4 * axes.saturating_sub(1) + 2 * distance.digits();
    let (normal, distance) = (normal.map(Rounded::simplest), distance.simplest());
    along.then_some((MatrixMeaning::Reflection { normal, distance }, cost))
}

/// Returns the unit axis and the angle in degrees, 0 to 180, of a rotation with entries of this
/// error.
pub(crate) fn axis_angle(rotation: DMat3, error: f64) -> ([f64; 3], f64) {
    let m = |i: usize, j: usize| rotation.col(j)[i];
    let trace = m(0, 0) + m(1, 1) + m(2, 2);
    let skew = DVec3::new(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
    let sine = 0.5 * libm::sqrt(skew.length_squared());
    let angle = libm::atan2(sine, 0.5 * (trace - 1.0));
    let axis = if sine > 1e-4 {
        skew / (2.0 * sine)
    } else {
        // Near 180°, the symmetric part gives the axis: (R + I)/2 = nnᵀ. Near 0°, any axis will do.
        let column = (0..3).max_by(|&a, &b| m(a, a).total_cmp(&m(b, b))).unwrap_or(0);
        let mut along = rotation.col(column);
        along[column] += 1.0;
        let length = libm::sqrt(along.length_squared());
        if length > 0.0 { along / length } else { DVec3::Z }
    };
    let shorter = |x: f64| shorten(x, error.max(1e-12));
    (axis.to_array().map(shorter), shorten(angle.to_degrees(), error.to_degrees().max(1e-10)))
}
