//! Readings as a camera and its projection in one matrix, from world to clip space, and as a
//! frustum with an inclined near plane.
//!
//! Take the rows x, y, w of a central projection. The line of sight is the linear part of w. The
//! parts of x and y perpendicular to it point right and up, and the eye is where all three rows
//! vanish. The numbers do not determine whether the world is left-handed (Direct3D), or
//! right-handed with y down in clip space (Vulkan). The reading whose up direction points up in the
//! world is more likely.

use super::convention_list::placed_conventions;
use super::matrix_reading::factor_cost;
use super::parallel::box_rarity;
use super::perspective::{MIRRORED, depth_planes, lens_digits, planes_cost, read_lens};
use super::rigid::shorten;
use super::rounded::{Entries, Rounded, divide_entries};
use super::{CameraReading, MatrixMeaning, MatrixReading, ViewAxes};
use alloc::vec::Vec;
use glam::{DMat3, DMat4, DVec3};
use homog::Projective;
use projection::{Convention, Decomposed, Frustum, Orthographic, decompose};

/// The cost of a camera that is upside down in the world, if a rival reading has it right side up.
const UPSIDE_DOWN: u32 = 6;

/// The cost of a camera at the origin that only looks backward or is only upside down. Signs that
/// contradict each other have such a reading.
const TURNED_ROUND: u32 = 4;

/// Adds the readings as a camera with a frustum, in a right-handed or left-handed world.
pub(crate) fn read_placed_perspective(m: &Entries<4>, found: &mut Vec<MatrixReading>) {
    let linear = [m[3][0], m[3][1], m[3][2]];
    let length = length_of(linear);
    if length.is_zero() {
        return;
    }
    for sign in [1.0, -1.0] {
        let factor = Rounded { value: sign * length.value, ..length };
        let unit = divide_entries(m, factor);
        let Some(frame) = PlacedFrame::from_central(&unit) else { continue };
        if frame.is_unplaced() {
            continue;
        }
        for (convention, rarity) in placed_conventions() {
            let factor_digits =
                if factor.is(1.0) || is_close(factor, 1.0) { 0 } else { factor_cost(factor) };
            let reading = frame.perspective(convention).map(|(meaning, cost)| MatrixReading {
                meaning,
                factor: if is_close(factor, sign) { sign } else { factor.simplest() },
                cost: cost + rarity + factor_digits,
            });
            found.extend(reading);
        }
    }
}

/// Whether a length computed from three rounded numbers may equal `expected`, within twice its
/// error.
fn is_close(number: Rounded, expected: f64) -> bool {
    number.is_within(expected, number.error + 1e-12)
}

fn length_of([x, y, z]: [Rounded; 3]) -> Rounded {
    (x * x + y * y + z * z).sqrt()
}

fn dot(a: [Rounded; 3], b: [Rounded; 3]) -> Rounded {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn linear_part(row: &[Rounded; 4]) -> [Rounded; 3] {
    [row[0], row[1], row[2]]
}

/// Returns `vector` without its component along a unit vector.
fn beside(vector: [Rounded; 3], unit: [Rounded; 3]) -> [Rounded; 3] {
    let along = dot(vector, unit);
    [0, 1, 2].map(|i| vector[i] - unit[i] * along)
}

fn values(vector: [Rounded; 3]) -> DVec3 {
    DVec3::from_array(vector.map(|x| x.value))
}

/// Returns whether two vectors may be perpendicular.
fn is_square(a: [Rounded; 3], b: [Rounded; 3]) -> bool {
    dot(a, b).is_within(0.0, 1e-11 * values(a).length() * values(b).length())
}

/// A camera in the world, with the rows of its projection.
struct PlacedFrame {
    eye: DVec3,
    eye_error: f64,
    right: DVec3,
    up: DVec3,
    gaze: DVec3,
    /// The scales of x and y; together with `center`, x' = scale x − center D.
    scale: [Rounded; 2],
    center: [Rounded; 2],
    /// The factor and offset in z' = factor D + offset.
    depth: [Rounded; 2],
}

impl PlacedFrame {
    /// Reads a matrix whose last row has a linear part of length 1.
    fn from_central(m: &Entries<4>) -> Option<Self> {
        let [x, y, z, w] = m;
        let sight = linear_part(w);
        let (across, upwards) = (beside(linear_part(x), sight), beside(linear_part(y), sight));
        let (width, height) = (length_of(across), length_of(upwards));
        if width.is_zero() || height.is_zero() || !is_square(across, upwards) {
            return None;
        }
        let residue = beside(linear_part(z), sight);
        let along = residue.iter().all(|part| part.is_within(0.0, part.error + 1e-11));
        let (gaze, right) = (values(sight), values(across) / width.value);
        let rows = [linear_part(x), linear_part(y), sight].map(values);
        let to_eye = DMat3::from_cols(rows[0], rows[1], rows[2]).transpose().inverse();
        let eye = -(to_eye * DVec3::new(x[3].value, y[3].value, w[3].value));
        if !along || !eye.is_finite() {
            return None;
        }
        let eye_error = [x, y, w].iter().zip([width, height, Rounded::ONE]).fold(
            1e-14 * eye.length(),
            |error: f64, (row, scale)| {
                let entry = row[3].error + row[0].error.max(row[1].error) * eye.length();
                error.max(2.0 * entry / scale.value)
            },
        );
        let up = right.cross(gaze);
        let mirrored = values(upwards).dot(up) < 0.0;
        let center = [dot(linear_part(x), sight), dot(linear_part(y), sight)].map(|c| -c);
        let factor = dot(linear_part(z), sight);
        let at_eye = linear_part(z).map(|entry| entry.error).into_iter().fold(0.0, f64::max);
        let offset = Rounded {
            value: rows_dot(z, eye) + z[3].value,
            error: z[3].error + at_eye * eye.length() + factor.value.abs() * eye_error,
        };
        let height = if mirrored { -height } else { height };
        let (depth, scale) = ([factor, offset], [width, height]);
        Some(Self { eye, eye_error, right, up, gaze, scale, center, depth })
    }

    /// Returns whether the camera is unrotated and at the origin, so that the matrix contains no
    /// camera.
    fn is_unplaced(&self) -> bool {
        let turn = 1e-9 + 4.0 * self.scale[0].error / self.scale[0].value.abs();
        let is_unrotated = self.right.distance(DVec3::X) < turn && self.gaze.z.abs() > 1.0 - turn;
        is_unrotated && self.eye.length() <= self.eye_error + 1e-12
    }

    fn perspective(&self, convention: Convention) -> Option<(MatrixMeaning, u32)> {
        let (near, far) = depth_planes(self.depth[0], self.depth[1], convention)?;
        let top = Rounded::exact(convention.top());
        let camera = self.camera(convention);
        let [sx, sy] = [self.scale[0], self.scale[1] * Rounded::exact(-convention.ahead()) * top];
        let [cx, cy] = [self.center[0], self.center[1] * top];
        let edge = |c: Rounded, s: Rounded, side: f64| {
            let sum = c + Rounded::exact(side);
            if sum.is_zero() { Rounded::exact(0.0) } else { sum / s * near }
        };
        // Rounded centers that may be 0 are treated as 0, because most cameras are symmetric.
        let [cx, cy] = [cx, cy].map(|c| if is_close(c, 0.0) { Rounded::exact(0.0) } else { c });
        let window = [edge(cx, sx, -1.0), edge(cx, sx, 1.0), edge(cy, sy, -1.0), edge(cy, sy, 1.0)];
        let [l, r, b, t] = window.map(Rounded::simplest);
        let far_distance = far.map_or(f64::INFINITY, Rounded::simplest);
        let frustum = Frustum::new(l, r, b, t, near.simplest(), far_distance).ok()?;
        let lens = read_lens(window, near);
        let digits = lens_digits(window, near, sy, sx) + self.eye_digits();
        // A camera that is upside down in OpenGL's convention is upside down in all conventions.
        let rivaled = convention.ahead() > 0.0 || convention.top() < 0.0;
        let turned = match sy.value < 0.0 {
            true => MIRRORED,
            false if rivaled => posture_cost(&camera),
            false => 0,
        };
        let at_origin = if camera.is_turned_round() { TURNED_ROUND } else { 0 };
        let meaning = MatrixMeaning::CameraPerspective { camera, frustum, lens, convention };
        Some((meaning, 12 + at_origin + turned + planes_cost(near, far) + 2 * digits))
    }

    fn eye_digits(&self) -> u32 {
        let number = |value| Rounded { value, error: self.eye_error }.digits();
        self.eye.to_array().into_iter().map(number).sum()
    }

    /// Returns the camera in this convention. For the same right axis and line of sight, the up
    /// direction is reversed in a left-handed world.
    fn camera(&self, convention: Convention) -> CameraReading {
        let clean = |v: DVec3, error: f64| v.to_array().map(|x| shorten(x, error));
        let turn = self.scale[0].error / self.scale[0].value.abs();
        CameraReading {
            eye: clean(self.eye, self.eye_error),
            gaze: clean(self.gaze, turn),
            up: clean(self.up * -convention.ahead(), turn),
            right: clean(self.right, turn),
            axes: axes_of(convention),
        }
    }
}

fn axes_of(convention: Convention) -> ViewAxes {
    if convention.ahead() > 0.0 { ViewAxes::Direct3d } else { ViewAxes::OpenGl }
}

/// Returns the cost of an upside-down camera whose numbers may also describe a normal camera in
/// another convention.
///
/// The up axis is y. It is z if the camera's right axis is level only with z up, or if the camera's
/// up direction has no y component.
pub(crate) fn posture_cost(camera: &CameraReading) -> u32 {
    let level = |axis: usize| camera.right[axis].abs() < 1e-6;
    let upwards = if (level(2) && !level(1)) || camera.up[1].abs() < 1e-6 {
        camera.up[2]
    } else {
        camera.up[1]
    };
    if upwards < 0.0 { UPSIDE_DOWN } else { 0 }
}

fn rows_dot(row: &[Rounded; 4], point: DVec3) -> f64 {
    values(linear_part(row)).dot(point)
}

/// Adds the readings as a camera with an orthographic box, for a matrix with perpendicular rows.
pub(crate) fn read_placed_box(m: &Entries<4>, found: &mut Vec<MatrixReading>) {
    let factor = m[3][3];
    if factor.is_zero() || ![m[3][0], m[3][1], m[3][2]].into_iter().all(Rounded::is_zero) {
        return;
    }
    let unit = divide_entries(m, factor);
    let rows = [0, 1, 2].map(|i| linear_part(&unit[i]));
    let lengths = rows.map(length_of);
    let square =
        is_square(rows[0], rows[1]) && is_square(rows[1], rows[2]) && is_square(rows[2], rows[0]);
    let is_unrotated = (0..3).all(|i| (0..3).all(|j| i == j || rows[i][j].is_zero()));
    if is_unrotated || !square || lengths.into_iter().any(Rounded::is_zero) {
        return;
    }
    let axes = [0, 1, 2].map(|i| values(rows[i]) / lengths[i].value);
    for (convention, rarity) in placed_conventions() {
        let reading = placed_box(&unit, axes, lengths, convention).map(|(meaning, cost)| {
            let cost = cost + box_rarity(convention, rarity) + factor_cost(factor);
            MatrixReading { meaning, factor: factor.simplest(), cost }
        });
        found.extend(reading);
    }
}

fn placed_box(
    unit: &Entries<4>,
    [right, up, depth]: [DVec3; 3],
    lengths: [Rounded; 3],
    convention: Convention,
) -> Option<(MatrixMeaning, u32)> {
    let up = up * convention.top();
    let gaze = right.cross(up) * convention.ahead();
    let forwards = Rounded::exact(depth.dot(gaze).signum()) * lengths[2];
    let edge = |row: usize, side: f64| {
        let sign = if row == 1 { convention.top() } else { 1.0 };
        (Rounded::exact(side) - unit[row][3] * Rounded::exact(sign)) / lengths[row]
    };
    let distance = |at: f64| (Rounded::exact(at) - unit[2][3]) / forwards;
    let window = [edge(0, -1.0), edge(0, 1.0), edge(1, -1.0), edge(1, 1.0)];
    let planes = [distance(convention.near_depth()), distance(convention.far_depth())];
    if planes[0].value >= planes[1].value {
        return None;
    }
    let digits: u32 = window.iter().chain(&planes).map(|number| number.digits()).sum();
    let [l, r, b, t] = window.map(Rounded::simplest);
    let volume = Orthographic::new(l, r, b, t, planes[0].simplest(), planes[1].simplest()).ok()?;
    let error = lengths[0].error / lengths[0].value;
    let clean = |v: DVec3| v.to_array().map(|x| shorten(x, error));
    let camera = CameraReading {
        eye: [0.0; 3],
        gaze: clean(gaze),
        up: clean(up),
        right: clean(right),
        axes: axes_of(convention),
    };
    let cost = 14 + posture_cost(&camera) + 2 * digits;
    Some((MatrixMeaning::CameraOrthographic { camera, volume, convention }, cost))
}

/// Adds the reading as a frustum from the origin with an inclined near plane (Lengyel 2005).
pub(crate) fn read_oblique_near(m: &Entries<4>, found: &mut Vec<MatrixReading>) {
    let rows = m.map(|row| row.map(|entry| entry.value));
    let view_to_clip = Projective::from_rows(rows);
    let named = [Convention::OPENGL, Convention::WEBGPU, Convention::VULKAN, Convention::DIRECT3D];
    for convention in named {
        let Ok(found_there) = decompose(view_to_clip, convention) else { continue };
        let Decomposed::ObliqueNear { placement, slopes, near_plane } = found_there.kind else {
            continue;
        };
        let unplaced = placement.raw().abs_diff_eq(DMat4::IDENTITY, 1e-9);
        if unplaced && found_there.factor > 0.0 {
            let meaning = MatrixMeaning::ObliqueNear { slopes, near_plane, convention };
            found.push(MatrixReading { meaning, factor: found_there.factor, cost: 120 });
        }
    }
}
