//! Readings of 3×3 matrices: maps of the plane in homogeneous coordinates, camera intrinsics, and
//! rotations of space.

use super::matrix_reading::{UNNAMED, is_moderate, readings_of};
use super::rigid::{axis_angle, largest_error, orthonormal_rows};
use super::rounded::{Entries, Rounded, measure_entries};
use super::viewport::intrinsics_of;
use super::{IntrinsicsReading, MatrixMeaning};
use alloc::vec::Vec;
use glam::DMat3;

/// The meaning of a 3×3 matrix for column vectors (x, y, w).
#[derive(Clone, Copy, PartialEq, Debug)]
#[expect(clippy::large_enum_variant, reason = "few are created, and they contain only numbers")]
pub enum PlanarMatrix {
    /// An affine map of the plane, as the meaning of a map of space whose z is to be ignored.
    Plane(MatrixMeaning),
    /// The intrinsic matrix of a camera, which maps camera coordinates to pixels.
    Intrinsics(IntrinsicsReading),
    /// A rotation in space, without homogeneous coordinates.
    SpatialRotation {
        /// The axis, with length 1.
        axis: [f64; 3],
        /// The angle in degrees, from 0 to 180, counterclockwise when the axis points at the
        /// viewer.
        angle_degrees: f64,
    },
    /// A projective map of the plane, which maps a line to infinity (HO-3).
    Homography,
    /// A map onto a line or a point.
    Singular,
}

/// One meaning of a 3×3 matrix.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PlanarReading {
    /// The meaning.
    pub meaning: PlanarMatrix,
    /// The common factor of all entries; a multiple of a matrix is the same map.
    pub factor: f64,
    /// Twice the number of digits of the parameters, with a penalty for rare maps. A reading with a
    /// lower cost is more likely.
    pub cost: u32,
}

/// Recognizes a 3×3 matrix for column vectors, specified by its rows. Returns the readings, most
/// likely first, and whether the transposed matrix has a clearly better reading.
///
/// ```
/// use recognition::{MatrixMeaning, PlanarMatrix, recognize_planar};
/// let k = [[1200.0, 0.0, 639.5], [0.0, 1200.0, 359.5], [0.0, 0.0, 1.0]];
/// let (readings, transposed) = recognize_planar(k);
/// assert!(matches!(readings[0].meaning, PlanarMatrix::Intrinsics(k) if k.fx == 1200.0));
/// assert!(!transposed);
/// ```
#[must_use]
pub fn recognize_planar(rows: [[f64; 3]; 3]) -> (Vec<PlanarReading>, bool) {
    let entries = measure_entries(rows);
    let readings = planar_readings(&entries);
    let cost = |readings: &[PlanarReading]| readings.first().map_or(UNNAMED, |first| first.cost);
    let turned = planar_readings(&[0, 1, 2].map(|i| [0, 1, 2].map(|j| entries[j][i])));
    let transposed = cost(&turned) + 8 <= cost(&readings);
    (readings, transposed)
}

fn planar_readings(entries: &Entries<3>) -> Vec<PlanarReading> {
    let values = entries.map(|row| row.map(|entry| entry.value));
    let mut found = Vec::new();
    if values.as_flattened().iter().all(|&value| is_moderate(value)) {
        read_affine_plane(entries, &mut found);
        found.extend(intrinsics_of(entries).map(|(intrinsics, cost)| PlanarReading {
            meaning: PlanarMatrix::Intrinsics(intrinsics),
            factor: 1.0,
            cost,
        }));
        found.extend(spatial_rotation(entries));
    }
    let determinant = DMat3::from_cols_array_2d(&values).determinant();
    let size = values.as_flattened().iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    let meaning = if determinant.abs() > 1e-12 * size * size * size {
        PlanarMatrix::Homography
    } else {
        PlanarMatrix::Singular
    };
    let simple = is_simple_homography(entries);
    let cost = simple.unwrap_or(UNNAMED);
    found.push(PlanarReading { meaning, factor: 1.0, cost });
    found.sort_by_key(|reading| reading.cost);
    found
}

/// Returns the cost of the identity with the bottom row (p, q, 1). It is a correct matrix for
/// column vectors, but also a translation for row vectors.
fn is_simple_homography([x, y, w]: &Entries<3>) -> Option<u32> {
    let identity = x[0].is(1.0) && y[1].is(1.0) && w[2].is(1.0);
    let zeros = [x[1], x[2], y[0], y[2]].into_iter().all(Rounded::is_zero);
    let digits = w[0].digits() + w[1].digits();
    (identity && zeros && digits > 0).then_some(3 + 2 * digits)
}

/// Reads a matrix with the bottom row (0, 0, s) as a map of space that leaves z unchanged.
fn read_affine_plane([x, y, w]: &Entries<3>, found: &mut Vec<PlanarReading>) {
    if !(w[0].is_zero() && w[1].is_zero()) || w[2].is_zero() {
        return;
    }
    let (zero, one) = (Rounded::exact(0.0), w[2]);
    let lifted = [
        [x[0], x[1], zero, x[2]],
        [y[0], y[1], zero, y[2]],
        [zero, zero, one, zero],
        [zero, zero, zero, one],
    ];
    found.extend(
        readings_of(&lifted)
            .into_iter()
            .filter(|reading| {
                let volume = reading.meaning.convention().is_some();
                let of_space = matches!(
                    reading.meaning,
                    MatrixMeaning::Projective
                        | MatrixMeaning::CameraPose(_)
                        | MatrixMeaning::ModelTransform { scale: [1.0, 1.0, 1.0], .. }
                );
                !volume && !of_space
            })
            .map(|reading| PlanarReading {
                meaning: PlanarMatrix::Plane(reading.meaning),
                factor: reading.factor,
                cost: reading.cost,
            }),
    );
}

fn spatial_rotation(entries: &Entries<3>) -> Option<PlanarReading> {
    let planar = (0..2).all(|i| entries[2][i].is_zero() && entries[i][2].is_zero());
    let [u, v, w] = orthonormal_rows(entries).filter(|_| !planar)?;
    if u.cross(v).dot(w) < 0.0 {
        return None;
    }
    let rotation = DMat3::from_cols(u, v, w).transpose();
    let (axis, angle_degrees) = axis_angle(rotation, largest_error(entries));
    let meaning = PlanarMatrix::SpatialRotation { axis, angle_degrees };
    Some(PlanarReading { meaning, factor: 1.0, cost: 6 })
}
