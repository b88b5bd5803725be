//! Axonometric projection: orthographic projection onto a plane that is not parallel to any
//! principal face (AX-1; C76).
//!
//! ```text
//!      isometric 1:1:1        dimetric 42°/7°  1:1:½      trimetric
//!            │ y                     │ y                     │ y
//!            │                       │                       │
//!           ⟋ ⟍                     ⟋ ╲___                  ⟋ ‾‾⟍
//!        z ⟋   ⟍ x               z ⟋      x              z ⟋     x
//! ```
//!
//! The object is rotated by −α about y and then by β about x until the normal of the plane points
//! to the viewer. Then z is dropped. A unit along an axis at angle γ to the plane shrinks to cos γ.
//! The squares of these ratios for the three axes sum to 2.

use crate::ProjectionError;
use crate::error::{check_finite, check_positive};
use crate::matrix::check_representable;
use homog::{Affine, Normal, Point, Vector, View};

/// An axonometric projection. Its [`kind`](Self::kind) depends on its
/// [`foreshortening`](Self::foreshortening).
///
/// ```
/// use projection::{Axonometric, AxonometricKind};
/// let iso = Axonometric::isometric();
/// assert_eq!(iso.kind(), AxonometricKind::Isometric);
/// let all = (2.0_f64 / 3.0).sqrt();
/// assert!(iso.foreshortening().iter().all(|ratio| (ratio - all).abs() < 1e-15));
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Axonometric {
    alpha: f64,
    beta: f64,
    origin: Point<View>,
}

/// Kinds of axonometric projections, by the number of equally foreshortened axes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum AxonometricKind {
    /// All three axes are foreshortened equally.
    Isometric,
    /// Two axes are foreshortened equally.
    Dimetric,
    /// All three axes are foreshortened differently.
    Trimetric,
    /// An axis is perpendicular to the plane: a principal view, possibly rotated.
    Multiview,
}

impl Axonometric {
    /// Returns the projection that rotates by −`alpha` about y, then by `beta` about x, in radians.
    ///
    /// # Errors
    /// Returns an error if an angle is not finite.
    pub fn by_angles(alpha: f64, beta: f64) -> Result<Self, ProjectionError> {
        check_finite("alpha", alpha)?;
        check_finite("beta", beta)?;
        Ok(Self { alpha, beta, origin: Point::ORIGIN })
    }

    /// Returns the projection onto the plane with this normal, which points to the viewer. The y
    /// axis stays vertical. For a normal along ±y, α is 0.
    ///
    /// # Errors
    /// Returns an error if the normal is zero or not finite.
    pub fn by_normal(normal: Normal<View>) -> Result<Self, ProjectionError> {
        for value in normal.raw().to_array() {
            check_finite("normal", value)?;
        }
        let unit =
            normal.normalized().ok_or(ProjectionError::ZeroVector { parameter: "normal" })?.raw();
        let level = libm::hypot(unit.x, unit.z);
        let alpha = if level == 0.0 { 0.0 } else { libm::atan2(unit.x, unit.z) };
        Self::by_angles(alpha, libm::atan2(unit.y, level))
    }

    /// Returns the projection that foreshortens the x, y and z axes in the ratio `x : y : z`, seen
    /// from the octant of positive axes.
    ///
    /// The ratios may have any common factor. The square of each must not exceed the sum of the
    /// squares of the other two.
    ///
    /// # Errors
    /// Returns an error if a ratio is not finite and positive, or if no plane foreshortens the axes
    /// this way.
    pub fn by_foreshortening(x: f64, y: f64, z: f64) -> Result<Self, ProjectionError> {
        check_positive("x ratio", x)?;
        check_positive("y ratio", y)?;
        check_positive("z ratio", z)?;
        let largest = x.max(y).max(z);
        let squares = [x, y, z].map(|ratio| (ratio / largest) * (ratio / largest));
        let sum = squares[0] + squares[1] + squares[2];
        // Once the squared ratios are scaled to sum to 2, each of them is 1 − n², where n is the
        // corresponding coordinate of the unit normal.
        let normal = squares.map(|square| 1.0 - 2.0 * square / sum);
        if normal.iter().any(|&square| square < -4.0 * f64::EPSILON) {
            let reason = "no square may exceed the sum of the other two";
            return Err(ProjectionError::ImpossibleForeshortening { x, y, z, reason });
        }
        let [nx, ny, nz] = normal.map(|square| libm::sqrt(square.max(0.0)));
        Self::by_normal(Normal::new(nx, ny, nz))
    }

    /// Returns the isometric projection, which foreshortens all axes equally: α = 45°, sin β =
    /// 1/√3.
    #[must_use]
    pub fn isometric() -> Self {
        let beta = libm::atan(core::f64::consts::FRAC_1_SQRT_2);
        Self { alpha: core::f64::consts::FRAC_PI_4, beta, origin: Point::ORIGIN }
    }

    /// Returns the dimetric projection of engineering drawing (ISO 5456-3), with x and y at full
    /// length and z at half length. In the drawing, the z axis is at 41.4° (nominally 42°) and the
    /// x axis at 7.2° (nominally 7°) to the horizontal.
    #[must_use]
    pub fn dimetric_42_7() -> Self {
        // The normal is (1, 1, √7)/3.
        let alpha = libm::atan2(1.0, libm::sqrt(7.0));
        Self { alpha, beta: libm::asin(1.0 / 3.0), origin: Point::ORIGIN }
    }

    /// Returns this projection with `origin` mapped to the origin of the picture.
    ///
    /// # Errors
    /// Returns an error if the origin is not finite.
    pub fn about(self, origin: Point<View>) -> Result<Self, ProjectionError> {
        for value in <[f64; 3]>::from(origin) {
            check_finite("origin", value)?;
        }
        let moved = Self { origin, ..self };
        check_representable(moved.depth_preserving().raw(), "origin")?;
        Ok(moved)
    }

    /// Returns α, the rotation about y, in radians.
    #[must_use]
    pub const fn alpha(self) -> f64 {
        self.alpha
    }

    /// Returns β, the rotation about x, in radians.
    #[must_use]
    pub const fn beta(self) -> f64 {
        self.beta
    }

    /// Returns the point that maps to the origin of the picture.
    #[must_use]
    pub const fn origin(self) -> Point<View> {
        self.origin
    }

    /// Returns the images of the unit vectors of the axes as columns; the third row is the depth.
    fn axes(self) -> [Vector<View>; 3] {
        let (sin_a, cos_a) = libm::sincos(self.alpha);
        let (sin_b, cos_b) = libm::sincos(self.beta);
        [
            Vector::new(cos_a, -sin_a * sin_b, sin_a * cos_b),
            Vector::new(0.0, cos_b, sin_b),
            Vector::new(-sin_a, -cos_a * sin_b, cos_a * cos_b),
        ]
    }

    /// Returns the transform that rotates the object and keeps its depth: Rx(β) Ry(−α) T(−origin).
    /// The picture's z axis points to the viewer.
    #[must_use]
    pub fn depth_preserving(self) -> Affine<View, View> {
        let [x, y, z] = self.axes();
        let to_origin = Affine::translation(Point::ORIGIN - self.origin);
        to_origin.then(Affine::from_frame(x, y, z, Point::ORIGIN))
    }

    /// Returns the inverse of [`depth_preserving`](Self::depth_preserving): the transposed
    /// rotation, then the translation back.
    #[must_use]
    pub fn depth_preserving_inverse(self) -> Affine<View, View> {
        let [x, y, z] = self.axes().map(Vector::raw);
        let back = |a: f64, b: f64, c: f64| Vector::new(a, b, c);
        let (to_x, to_y, to_z) = (back(x.x, y.x, z.x), back(x.y, y.y, z.y), back(x.z, y.z, z.z));
        Affine::from_frame(to_x, to_y, to_z, self.origin)
    }

    /// Returns the classical projection, which drops z after the rotation. Its matrix is singular.
    #[must_use]
    pub fn onto_plane(self) -> Affine<View, View> {
        self.depth_preserving().then(Affine::scale(1.0, 1.0, 0.0))
    }

    /// Returns the lengths of the images of the unit vectors along x, y and z; their squares sum to
    /// 2.
    #[must_use]
    pub fn foreshortening(self) -> [f64; 3] {
        self.axes().map(|axis| libm::hypot(axis.x(), axis.y()))
    }

    /// Returns the directions in which the x, y and z axes are drawn, in radians counterclockwise
    /// from the right. An axis that appears as a point has the direction `None`.
    #[must_use]
    pub fn drawn_angles(self) -> [Option<f64>; 3] {
        self.axes().map(|axis| {
            let seen = libm::hypot(axis.x(), axis.y()) > 1e-15;
            seen.then(|| libm::atan2(axis.y(), axis.x()))
        })
    }

    /// Returns the kind, with ratios compared to twelve digits.
    #[must_use]
    pub fn kind(self) -> AxonometricKind {
        let [x, y, z] = self.foreshortening();
        let alike = |a: f64, b: f64| (a - b).abs() < 1e-12;
        if [x, y, z].iter().any(|&ratio| alike(ratio, 0.0)) {
            return AxonometricKind::Multiview;
        }
        match (alike(x, y), alike(y, z), alike(z, x)) {
            (true, true, _) | (true, _, true) | (_, true, true) => AxonometricKind::Isometric,
            (false, false, false) => AxonometricKind::Trimetric,
            _ => AxonometricKind::Dimetric,
        }
    }
}
