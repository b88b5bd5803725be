//! Decomposes a central matrix into eye, orientation and lens: the linear algebra for `decompose`.
//!
//! Take the rows x, y, w of a matrix whose w row has a linear part of length 1. That linear part is
//! the line of sight. The components of x and y perpendicular to it point right and up. The eye is
//! where all three rows vanish.

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};
use homog::{Affine, Vector, View};

/// Entries below this fraction of their neighbors count as rounding errors.
const RELATIVE_ROUNDING: f64 = 1e-12;

/// Returns whether `small` is only a rounding error compared with `large`.
pub(crate) fn is_negligible(small: DVec3, large: DVec4) -> bool {
    small.abs().max_element() <= RELATIVE_ROUNDING * large.abs().max_element()
}

/// Returns whether the vector has no component along `unit`.
pub(crate) fn is_perpendicular(vector: DVec3, unit: DVec3) -> bool {
    vector.dot(unit).abs() <= 1e-9 * vector.length()
}

/// Returns whether x and y depend only on their own coordinate and z, and z only on itself.
pub(crate) fn maps_axes_separately(x: DVec4, y: DVec4, z: DVec4) -> bool {
    let none = |entry: f64, row: DVec4| {
        entry.abs() <= RELATIVE_ROUNDING * row.truncate().abs().max_element()
    };
    none(x.y, x) && none(y.x, y) && none(z.x, z) && none(z.y, z)
}

/// Returns the rank of a matrix that has lost at least one dimension, or `None` if it has an
/// inverse.
///
/// Rows and columns are scaled first, so that large and small entries count equally.
pub(crate) fn lost_rank(matrix: DMat4) -> Option<usize> {
    let by_rows = scale_rows(matrix_rows(matrix));
    let by_columns = scale_rows(transpose_rows(by_rows));
    let mut balanced = scale_rows(transpose_rows(by_columns));
    let rank = eliminate_rows(&mut balanced);
    (rank < 4).then_some(rank)
}

fn matrix_rows(matrix: DMat4) -> [DVec4; 4] {
    [0, 1, 2, 3].map(|i| matrix.row(i))
}

/// Returns the columns of the matrix with these rows.
fn transpose_rows(rows: [DVec4; 4]) -> [DVec4; 4] {
    [0, 1, 2, 3].map(|i| DVec4::from_array(rows.map(|row| row[i])))
}

/// Returns each row divided by the largest magnitude of its entries.
fn scale_rows(rows: [DVec4; 4]) -> [DVec4; 4] {
    rows.map(|row| if max_coordinate(row) == 0.0 { row } else { row / max_coordinate(row) })
}

/// Runs Gaussian elimination with full pivoting and returns the number of pivots above the rounding
/// noise.
fn eliminate_rows(rows: &mut [DVec4; 4]) -> usize {
    let mut used = [false; 4];
    for done in 0..4 {
        let pivot = (done..4)
            .flat_map(|i| (0..4).map(move |j| (i, j)))
            .filter(|&(_, j)| !used[j])
            .max_by(|&(a, b), &(c, d)| rows[a][b].abs().total_cmp(&rows[c][d].abs()));
        let Some((i, j)) = pivot.filter(|&(i, j)| rows[i][j].abs() > 1e-14) else { return done };
        rows.swap(done, i);
        used[j] = true;
        for k in done + 1..4 {
            let factor = rows[k][j] / rows[done][j];
            rows[k] -= rows[done] * factor;
        }
    }
    4
}

/// Returns the null vector of a rank-3 matrix with w = 1, or with w = 0 and maximum coordinate 1.
pub(crate) fn null_vector(matrix: DMat4) -> Option<DVec4> {
    // The adjugate's columns are multiples of the null vector; the largest is the most accurate.
    let columns = [0, 1, 2, 3].map(|column| cofactors(matrix, column));
    let best =
        columns.into_iter().max_by(|a, b| max_coordinate(*a).total_cmp(&max_coordinate(*b)))?;
    let largest = max_coordinate(best);
    if largest == 0.0 {
        return None;
    }
    let unit = best / largest;
    Some(if unit.w.abs() > RELATIVE_ROUNDING { unit / unit.w } else { unit.with_w(0.0) })
}

fn max_coordinate(vector: DVec4) -> f64 {
    vector.abs().max_element()
}

/// Returns the cofactors of one row of the matrix.
fn cofactors(matrix: DMat4, row: usize) -> DVec4 {
    let minor = |column: usize| {
        let sign = if (row + column) % 2 == 0 { 1.0 } else { -1.0 };
        sign * DMat3::from_mat4_minor(matrix, column, row).determinant()
    };
    DVec4::new(minor(0), minor(1), minor(2), minor(3))
}

/// The eye, orientation and lens of a central matrix.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Placement {
    /// The right, up and backward axes of the camera, in the input coordinates of the matrix.
    axes: [DVec3; 3],
    pub(crate) eye: DVec3,
    /// x' = scale.x x − center.x D in camera coordinates; y' likewise.
    pub(crate) scale: DVec2,
    pub(crate) center: DVec2,
    /// The depth row in camera coordinates.
    pub(crate) depth: DVec4,
}

impl Placement {
    /// Decomposes a matrix whose last row has a linear part of length 1. Returns `None` if x and y
    /// are not perpendicular.
    pub(crate) fn from_matrix(matrix: DMat4) -> Option<Self> {
        let [x, y, z, w] = matrix_rows(matrix);
        let sight = w.truncate();
        let beside = |row: DVec4| row.truncate() - sight * row.truncate().dot(sight);
        let right = unit_vector(beside(x))?;
        let up = (-sight).cross(right);
        if !is_perpendicular(beside(y), right) {
            return None;
        }
        let (right, up) =
            if is_rolled(x, y, sight, beside(y).dot(up)) { (-right, -up) } else { (right, up) };
        let linear = DMat3::from_cols(x.truncate(), y.truncate(), sight).transpose();
        let eye = -(linear.inverse() * DVec3::new(x.w, y.w, w.w));
        let frame = Self {
            axes: [right, up, -sight],
            eye,
            scale: DVec2::new(x.truncate().dot(right), y.truncate().dot(up)),
            center: DVec2::new(-x.truncate().dot(sight), -y.truncate().dot(sight)),
            depth: DVec4::ZERO,
        };
        let z_here = z.truncate();
        let depth = DVec4::new(
            z_here.dot(right),
            z_here.dot(up),
            -z_here.dot(sight),
            z_here.dot(eye) + z.w,
        );
        eye.is_finite().then_some(Self { depth, ..frame })
    }

    /// Returns whether the camera is not rotated.
    pub(crate) fn is_upright(&self) -> bool {
        let [right, up, back] = self.axes;
        right.distance(DVec3::X) < 1e-12
            && up.distance(DVec3::Y) < 1e-12
            && back.distance(DVec3::Z) < 1e-12
    }

    /// Returns the map to camera space, which takes the eye to the origin and the camera's axes to
    /// x, y and z.
    pub(crate) fn as_affine(&self) -> Affine<View, View> {
        let rows = self.axes.map(|axis| axis.extend(-axis.dot(self.eye)));
        let matrix = DMat4::from_cols(rows[0], rows[1], rows[2], DVec4::W).transpose();
        Affine::from_raw(matrix).unwrap_or(Affine::IDENTITY)
    }
}

/// Returns whether the camera's x axis should be opposite to the picture's. For an unrotated
/// camera, this is the case if the matrix is mirrored in x; for a rotated camera, if the picture is
/// mirrored and the camera would otherwise be upside down.
fn is_rolled(x: DVec4, y: DVec4, sight: DVec3, along_up: f64) -> bool {
    let unturned = is_negligible(sight.with_z(0.0), DVec4::ONE)
        && is_negligible(DVec3::X * x.y, x.truncate().extend(0.0))
        && is_negligible(DVec3::X * y.x, y.truncate().extend(0.0));
    let up_y = (-sight).cross(x.truncate()).y;
    if unturned { x.x < 0.0 } else { along_up < 0.0 && up_y < 0.0 }
}

/// Returns the vector of length 1 in this direction.
pub(crate) fn unit_vector(vector: DVec3) -> Option<DVec3> {
    Vector::<View>::from_raw(vector).normalized().map(Vector::raw)
}
