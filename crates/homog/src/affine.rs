//! Affine maps, which map points to points without a divide.

use crate::{Normal, Plane, Point, Projective, Space, Vector};
use core::marker::PhantomData;
use glam::{DMat3, DMat4, DVec3, DVec4};

/// An affine map from space `A` to space `B`: a 4×4 matrix with bottom row (0, 0, 0, 1), applied to
/// column vectors.
///
/// Parallel lines stay parallel and w stays 1. Chain maps with [`then`](Self::then), in the order
/// in which a point passes through them.
///
/// ```
/// use homog::{Affine, Model, Point, Vector, World};
/// let turned = Affine::<Model, Model>::rotation_y(90_f64.to_radians());
/// let placed = turned.then(Affine::<Model, World>::translation(Vector::new(5.0, 0.0, 0.0)));
/// let p = placed.transform_point(Point::new(1.0, 0.0, 0.0));
/// assert!((p - Point::new(5.0, 0.0, -1.0)).length() < 1e-15);
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Affine<A: Space, B: Space> {
    pub(crate) raw: DMat4,
    spaces: PhantomData<(A, B)>,
}

impl<A: Space, B: Space> Affine<A, B> {
    /// The map that changes only the space and leaves the coordinates unchanged.
    pub const IDENTITY: Self = Self::tagged(DMat4::IDENTITY);

    pub(crate) const fn tagged(raw: DMat4) -> Self {
        Self { raw, spaces: PhantomData }
    }

    /// Tags a matrix with its two spaces, or returns `None` if its bottom row is not exactly
    /// (0, 0, 0, 1).
    pub(crate) fn from_matrix(raw: DMat4) -> Option<Self> {
        (raw.row(3) == DVec4::W).then_some(Self::tagged(raw))
    }

    /// Creates a map from the images of the x, y and z axes and of the origin: a change of frame.
    #[must_use]
    pub fn from_frame(x: Vector<B>, y: Vector<B>, z: Vector<B>, origin: Point<B>) -> Self {
        Self::tagged(DMat4::from_cols(
            x.raw.extend(0.0),
            y.raw.extend(0.0),
            z.raw.extend(0.0),
            origin.raw.extend(1.0),
        ))
    }

    /// Creates the map that moves points by `by` and leaves vectors unchanged (HO-4).
    #[must_use]
    pub fn translation(by: Vector<B>) -> Self {
        Self::tagged(DMat4::from_translation(by.raw))
    }

    /// Creates a scaling of each coordinate. A factor of 0 flattens; a negative factor mirrors.
    #[must_use]
    pub fn scale(x: f64, y: f64, z: f64) -> Self {
        Self::tagged(DMat4::from_scale(DVec3::new(x, y, z)))
    }

    /// Creates the rotation about `axis` by `angle` radians: counterclockwise when the axis points
    /// at the viewer (right-hand rule). Returns `None` if the axis is zero or not finite.
    #[must_use]
    pub fn rotation(axis: Vector<B>, angle: f64) -> Option<Self> {
        let [x, y, z] = axis.normalized()?.raw.to_array();
        let (s, c) = libm::sincos(angle / 2.0);
        Self::from_quaternion([x * s, y * s, z * s, c])
    }

    /// Creates the rotation about the x axis by `angle` radians: y turns toward z.
    #[must_use]
    pub fn rotation_x(angle: f64) -> Self {
        let (s, c) = libm::sincos(angle);
        Self::from_linear(DVec3::X, DVec3::new(0.0, c, s), DVec3::new(0.0, -s, c))
    }

    /// Creates the rotation about the y axis by `angle` radians: z turns toward x.
    #[must_use]
    pub fn rotation_y(angle: f64) -> Self {
        let (s, c) = libm::sincos(angle);
        Self::from_linear(DVec3::new(c, 0.0, -s), DVec3::Y, DVec3::new(s, 0.0, c))
    }

    /// Creates the rotation about the z axis by `angle` radians: x turns toward y.
    #[must_use]
    pub fn rotation_z(angle: f64) -> Self {
        let (s, c) = libm::sincos(angle);
        Self::from_linear(DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0), DVec3::Z)
    }

    /// Returns the rotation of the quaternion (x, y, z, w), which need not have length 1, or `None`
    /// if it is zero or not finite.
    #[must_use]
    pub fn from_quaternion([x, y, z, w]: [f64; 4]) -> Option<Self> {
        let largest = x.abs().max(y.abs()).max(z.abs()).max(w.abs());
        let q = DVec4::new(x, y, z, w) / largest;
        let n = q.length_squared();
        if !n.is_finite() || n == 0.0 {
            return None;
        }
        let [x, y, z, w] = q.to_array();
        let s = 2.0 / n;
        Some(Self::from_linear(
            DVec3::new(1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)),
            DVec3::new(s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w)),
            DVec3::new(s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y)),
        ))
    }

    fn from_linear(x: DVec3, y: DVec3, z: DVec3) -> Self {
        Self::tagged(DMat4::from_mat3(DMat3::from_cols(x, y, z)))
    }

    /// Returns the image of a point.
    #[must_use]
    #[inline(always)]
    pub fn transform_point(self, point: Point<A>) -> Point<B> {
        Point::tagged(self.raw.transform_point3(point.raw))
    }

    /// Writes the images of `points` to `images` in one pass, bit-identical to
    /// [`transform_point`](Self::transform_point). Extra elements of the longer slice are ignored.
    pub fn transform_points_into(self, points: &[Point<A>], images: &mut [Point<B>]) {
        for (point, image) in points.iter().zip(images) {
            *image = self.transform_point(*point);
        }
    }

    /// Returns the image of a vector, which the translation does not affect.
    #[must_use]
    pub fn transform_vector(self, vector: Vector<A>) -> Vector<B> {
        Vector::tagged(self.raw.transform_vector3(vector.raw))
    }

    /// Returns the image of a normal, computed with the cofactors of the linear part. The cofactor
    /// matrix is the inverse transpose times the determinant, so it also exists for flattening
    /// maps. If the map mirrors, it is negated to keep the normal on its side.
    #[must_use]
    pub fn transform_normal(self, normal: Normal<A>) -> Normal<B> {
        let [x, y, z] = self.linear_columns();
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let mirrored = x.dot(cofactors.x_axis) < 0.0;
        let image = cofactors * normal.raw;
        Normal::tagged(if mirrored { -image } else { image })
    }

    /// Returns the image of a plane, or `None` if the map flattens space or a coefficient of the
    /// image is not finite.
    #[must_use]
    pub fn transform_plane(self, plane: Plane<A>) -> Option<Plane<B>> {
        let image = self.inverse()?.raw.transpose() * plane.raw;
        image.is_finite().then_some(Plane::tagged(image))
    }

    fn linear_columns(self) -> [DVec3; 3] {
        let m = self.raw;
        [m.x_axis.truncate(), m.y_axis.truncate(), m.z_axis.truncate()]
    }

    /// Returns the determinant of the linear part: the factor by which volumes change. It is
    /// negative if the map mirrors and 0 if it flattens.
    #[must_use]
    pub fn determinant(self) -> f64 {
        let [x, y, z] = self.linear_columns();
        x.dot(y.cross(z))
    }

    /// Returns the map that applies this map first, then `next`.
    #[must_use]
    pub fn then<C: Space>(self, next: Affine<B, C>) -> Affine<A, C> {
        Affine::tagged(next.raw * self.raw)
    }

    /// Returns the map that applies this map first, then the projection `next`.
    #[must_use]
    pub fn then_project<C: Space>(self, next: Projective<B, C>) -> Projective<A, C> {
        Projective::from(self).then(next)
    }

    /// Returns the inverse map, or `None` if this one flattens space or is not finite.
    #[must_use]
    pub fn inverse(self) -> Option<Affine<B, A>> {
        if !self.is_finite() {
            return None;
        }
        // Columns of length near 1 keep the determinant in range; scaling by powers of two is
        // exact.
        let columns = self.linear_columns();
        let exponents = columns.map(|column| match column.abs().max_element() {
            0.0 => 0,
            largest => -libm::ilogb(largest),
        });
        let scaled =
            |column: DVec3, by: i32| DVec3::from(column.to_array().map(|c| libm::scalbn(c, by)));
        let [x, y, z] = core::array::from_fn(|i| scaled(columns[i], exponents[i]));
        let determinant = x.dot(y.cross(z));
        let crosses = [y.cross(z), z.cross(x), x.cross(y)];
        let [x, y, z] = core::array::from_fn(|i| scaled(crosses[i] / determinant, exponents[i]));
        let linear = DMat3::from_cols(x, y, z).transpose();
        let origin = -(linear * self.raw.w_axis.truncate());
        let finite = determinant != 0.0 && linear.is_finite() && origin.is_finite();
        finite.then(|| Affine::tagged(DMat4::from_mat3_translation(linear, origin)))
    }

    /// Returns whether all entries are finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.raw.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Model, World};

    type Map = Affine<Model, World>;

    #[test]
    fn inverses_undo_the_map_and_flat_maps_have_none() {
        let turn = Affine::<Model, Model>::rotation_x(0.3);
        let map = turn.then(Map::translation(Vector::new(1.0, -2.0, 3.0)));
        let p = Point::new(0.5, 0.25, -4.0);
        let back = map
            .inverse()
            .expect("a rigid map has an inverse")
            .transform_point(map.transform_point(p));
        assert!((back - p).length() < 1e-14);
        assert_eq!(Map::scale(1.0, 0.0, 1.0).inverse(), None);
        let tiny = Map::scale(1e-150, 1e-300, 1.0).inverse().expect("small is not flat");
        assert!((tiny.transform_vector(Vector::Y).y() / 1e300 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn maps_that_are_not_finite_have_no_inverse() {
        for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(Map::scale(odd, 1.0, 1.0).inverse(), None);
            assert_eq!(Map::translation(Vector::new(0.0, odd, 0.0)).inverse(), None);
        }
    }

    #[test]
    fn normals_stay_perpendicular_when_scaled_and_on_their_side_when_mirrored() {
        let squash = Map::scale(1.0, 0.25, 1.0);
        let n = squash.transform_normal(Normal::new(1.0, 1.0, 0.0));
        assert_eq!(n.dot(squash.transform_vector(Vector::new(1.0, -1.0, 0.0))), 0.0);
        let mirror = Map::scale(-1.0, 1.0, 1.0);
        assert_eq!(mirror.transform_normal(Normal::new(0.0, 1.0, 0.0)), Normal::new(0.0, 1.0, 0.0));
    }

    #[test]
    fn rotation_about_any_axis_matches_the_coordinate_axes() {
        let turns = [
            (Vector::X * 5.0, Map::rotation_x(0.7)),
            (Vector::Y * 1e-200, Map::rotation_y(0.7)),
            (Vector::Z, Map::rotation_z(0.7)),
        ];
        let p = Point::new(1.0, 2.0, 3.0);
        for (axis, turn) in turns {
            let same = Map::rotation(axis, 0.7).expect("an axis");
            assert!(
                (same.transform_point(p) - turn.transform_point(p)).length() < 1e-15,
                "about {axis}"
            );
        }
        assert_eq!(Map::rotation(Vector::ZERO, 0.7), None);
    }

    #[test]
    fn misprint_m6_each_coordinate_moves_by_its_own_amount() {
        // Printed with t_y in the third row; the right-hand side of the same line has h t_z.
        let by = Vector::new(1.0, 2.0, 3.0);
        let rows = Map::translation(by).rows();
        assert_eq!([rows[0][3], rows[1][3], rows[2][3]], [1.0, 2.0, 3.0]);
    }

    #[test]
    fn c37_c52_translations_move_points_but_not_directions() {
        let by = Vector::new(1.0, 2.0, 3.0);
        let map = Projective::from(Map::translation(by));
        let (x, y, z, h) = (2.0, -6.0, 4.0, 4.0);
        let moved = map.transform_hpoint(crate::HPoint::new(x, y, z, h));
        assert_eq!(moved.divide(), Some(Point::new(x / h + 1.0, y / h + 2.0, z / h + 3.0)));
        let direction = crate::HPoint::new(x, y, z, 0.0);
        assert_eq!(map.transform_hpoint(direction).raw, direction.raw);
    }

    #[test]
    fn exercise_5_c42_under_an_affine_map_multiples_stay_multiples() {
        let rows = [
            [1.0, 2.0, 3.0, 4.0],
            [0.0, -1.0, 2.0, 0.5],
            [5.0, 0.0, 0.0, -1.0],
            [0.0, 0.0, 0.0, 1.0],
        ];
        let map = Map::from_rows(rows).expect("affine");
        let (p, h) = (Point::new(1.0, -2.0, 3.0), 4.0);
        let lifted = crate::HPoint::tagged(crate::HPoint::from(p).raw * h);
        let image = Projective::from(map).transform_hpoint(lifted);
        assert_eq!(image.w(), h);
        assert_eq!(image.raw, crate::HPoint::from(map.transform_point(p)).raw * h, "M(hp) = h Mp");
        assert_eq!(image.divide(), Some(Point::new(10.0, 8.5, 4.0)));
    }

    #[test]
    fn quaternion_length_does_not_matter_and_zero_is_rejected() {
        let half_turn = Map::from_quaternion([0.0, 3e-200, 0.0, 0.0]).expect("not zero");
        assert_eq!(
            half_turn.transform_point(Point::new(1.0, 2.0, 3.0)),
            Point::new(-1.0, 2.0, -3.0)
        );
        assert_eq!(Map::from_quaternion([0.0; 4]), None);
        assert_eq!(Map::from_quaternion([f64::NAN, 0.0, 0.0, 1.0]), None);
    }
}
