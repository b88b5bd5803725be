//! The depth curve: depth as a function of distance, and its resolution (ZP-1).
//!
//! ```text
//! depth 1 ┤            ________      perspective uses half of the depth range for distances
//!         │      ___---              from N to 2FN/(F+N), about twice the near distance
//!       ½ ┤   .-´
//!         │  /
//!       0 ┼─┴──┬────────────────►
//!           N  2FN/(F+N)         D
//! ```

use crate::error::{check_finite, check_positive};
use crate::frustum::check_planes;
use crate::matrix::DepthRow;
use crate::{Convention, Frustum, Orthographic, Perspective, ProjectionError};

/// The storage format of depth values.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum DepthFormat {
    /// Integers with this number of bits (1 to 64), which divide the range from the near to the far
    /// depth evenly.
    FixedPoint(u32),
    /// 32-bit floating-point numbers, in the depth range of the convention.
    Float32,
}

#[derive(Clone, Copy, PartialEq, Debug)]
enum CurveShape {
    Central,
    Parallel,
}

/// The map from distance in front of the eye to depth after the divide, and back (C56, C67).
///
/// ```
/// use projection::{Convention, DepthCurve};
/// let curve = DepthCurve::perspective(2.0, 40.0, Convention::OPENGL)?;
/// assert_eq!(curve.depth(2.0), Some(-1.0));
/// assert_eq!(curve.half_range_distance(), 80.0 / 21.0); // the lesson rounds it to 3.8
/// # Ok::<(), projection::ProjectionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct DepthCurve {
    near: f64,
    far: f64,
    convention: Convention,
    shape: CurveShape,
}

impl DepthCurve {
    /// Returns the curve of a perspective projection. `far` may be infinite.
    ///
    /// # Errors
    /// Returns an error unless 0 < near < far.
    pub fn perspective(
        near: f64,
        far: f64,
        convention: Convention,
    ) -> Result<Self, ProjectionError> {
        check_planes(near, far)?;
        Ok(Self { near, far, convention, shape: CurveShape::Central })
    }

    /// Returns the curve of a parallel projection, which is a straight line.
    ///
    /// # Errors
    /// Returns an error if a distance is not finite or the distances are equal.
    pub fn parallel(near: f64, far: f64, convention: Convention) -> Result<Self, ProjectionError> {
        let volume = Orthographic::new(-1.0, 1.0, -1.0, 1.0, near, far)?;
        Ok(volume.depth_curve(convention))
    }

    /// Returns (a, b), where depth = a + b/D for a perspective projection and depth = a D + b for a
    /// parallel projection.
    ///
    /// For OpenGL these are the lesson's c2 = (F+N)/(F−N) and c1 = 2FN/(N−F) (C67).
    #[must_use]
    pub fn coefficients(self) -> (f64, f64) {
        let row = match self.shape {
            CurveShape::Central => DepthRow::central(self.near, self.far, self.convention),
            CurveShape::Parallel => DepthRow::parallel(self.near, self.far, self.convention),
        };
        (row.factor, row.offset)
    }

    /// Returns the depth of points at `distance`, or `None` in the plane of the eye, for NaN, or
    /// if the result is too large to represent.
    #[must_use]
    pub fn depth(self, distance: f64) -> Option<f64> {
        let (at_near, at_far) = (self.convention.near_depth(), self.convention.far_depth());
        let t = self.depth_fraction(distance);
        let depth = at_near + (at_far - at_near) * t;
        depth.is_finite().then_some(depth)
    }

    /// Returns the fraction of the depth range that is used between the near plane and `distance`:
    /// 0 at near, 1 at far.
    fn depth_fraction(self, distance: f64) -> f64 {
        let (near, far) = (self.near, self.far);
        match self.shape {
            CurveShape::Central if far == f64::INFINITY => 1.0 - near / distance,
            CurveShape::Central => (distance - near) / (far - near) * (far / distance),
            CurveShape::Parallel => (distance - near) / (far - near),
        }
    }

    /// Returns the distance at which points have the given depth. Use it to linearize a depth buffer.
    ///
    /// Returns `None` if no finite distance has this depth, such as the far depth of a
    /// projection without a far plane.
    #[must_use]
    pub fn distance(self, depth: f64) -> Option<f64> {
        let (at_near, at_far) = (self.convention.near_depth(), self.convention.far_depth());
        // Each difference is exact near its plane, where accuracy matters.
        let (from_near, to_far) =
            ((depth - at_near) / (at_far - at_near), (at_far - depth) / (at_far - at_near));
        let distance = match self.shape {
            CurveShape::Central => self.near / (to_far + from_near * (self.near / self.far)),
            CurveShape::Parallel => self.near * to_far + self.far * from_near,
        };
        distance.is_finite().then_some(distance)
    }

    /// Returns the derivative of depth with respect to distance, d depth/dD, or `None` in the plane
    /// of the eye.
    #[must_use]
    pub fn slope(self, distance: f64) -> Option<f64> {
        let (a, b) = self.coefficients();
        let slope = match self.shape {
            CurveShape::Central => -b / distance / distance,
            CurveShape::Parallel => a,
        };
        (slope.is_finite() && distance.is_finite()).then_some(slope)
    }

    /// Returns the distance at which half of the depth range is used up: 2FN/(F+N) for a
    /// perspective projection, or 2N without a far plane.
    #[must_use]
    pub fn half_range_distance(self) -> f64 {
        let (near, far) = (self.near, self.far);
        match self.shape {
            CurveShape::Central => 2.0 * near / (1.0 + near / far),
            CurveShape::Parallel => 0.5 * near + 0.5 * far,
        }
    }

    /// Returns the smallest step from `distance` toward the far plane that changes the stored
    /// depth.
    ///
    /// # Errors
    /// Returns an error if the distance is not finite or, for a perspective projection, not above
    /// 0, or if the format does not have 1 to 64 bits.
    pub fn resolution(self, distance: f64, format: DepthFormat) -> Result<f64, ProjectionError> {
        match self.shape {
            CurveShape::Central => check_positive("distance", distance)?,
            CurveShape::Parallel => check_finite("distance", distance)?,
        };
        let lost = ProjectionError::Unrepresentable { what: "depth at this distance" };
        let step = match format {
            DepthFormat::FixedPoint(bits) => self.fixed_step(distance, bits)?,
            DepthFormat::Float32 => self.float_step(distance).ok_or(lost)?,
        };
        step.is_finite().then_some(step).ok_or(lost)
    }

    /// Returns one step of the range, 1/(2^bits − 1), divided by the slope.
    fn fixed_step(self, distance: f64, bits: u32) -> Result<f64, ProjectionError> {
        if !(1..=64).contains(&bits) {
            let allowed = "from 1 to 64";
            return Err(ProjectionError::OutOfRange {
                parameter: "bits",
                value: f64::from(bits),
                allowed,
            });
        }
        let parts = libm::exp2(f64::from(bits)) - 1.0;
        let range = (self.convention.far_depth() - self.convention.near_depth()).abs();
        let slope = self.slope(distance).unwrap_or(0.0).abs();
        Ok(range / parts / slope)
    }

    /// Returns the change in distance that corresponds to one f32 step from the stored depth
    /// toward the far depth.
    #[expect(clippy::cast_possible_truncation, reason = "the stored depth is an f32")]
    fn float_step(self, distance: f64) -> Option<f64> {
        let here = self.depth(distance)? as f32;
        let is_far_greater = self.convention.far_depth() > self.convention.near_depth();
        let next = libm::nextafterf(here, if is_far_greater { f32::MAX } else { f32::MIN });
        let gap = f64::from(next) - f64::from(here);
        match self.shape {
            CurveShape::Central => {
                let ends = self.distance(f64::from(here))? * self.distance(f64::from(next))?;
                Some((gap / self.coefficients().1).abs() * ends.abs())
            }
            CurveShape::Parallel => Some((gap / self.coefficients().0).abs()),
        }
    }

    /// Returns (distance, depth) for each distance, as in the lesson's table (LW-3, C68).
    pub fn table(
        self,
        distances: impl IntoIterator<Item = f64>,
    ) -> impl Iterator<Item = (f64, Option<f64>)> {
        distances.into_iter().map(move |distance| (distance, self.depth(distance)))
    }
}

impl Perspective {
    /// Returns the depth curve of this projection.
    #[must_use]
    pub fn depth_curve(self, convention: Convention) -> DepthCurve {
        DepthCurve { near: self.near(), far: self.far(), convention, shape: CurveShape::Central }
    }
}

impl Frustum {
    /// Returns the depth curve of this projection.
    #[must_use]
    pub fn depth_curve(self, convention: Convention) -> DepthCurve {
        DepthCurve { near: self.near(), far: self.far(), convention, shape: CurveShape::Central }
    }
}

impl Orthographic {
    /// Returns the depth curve of this projection.
    #[must_use]
    pub fn depth_curve(self, convention: Convention) -> DepthCurve {
        DepthCurve { near: self.near(), far: self.far(), convention, shape: CurveShape::Parallel }
    }
}

/// Returns A and B of the third row (0, 0, A, B) for w = z, where A + B/z is `at_1` at z = `z_1`
/// and `at_2` at z = `z_2`. `first` is (`z_1`, `at_1`), and `second` is (`z_2`, `at_2`).
///
/// This determines the third row of P (exercise 3, C40): with z preserved on n and f, A = n + f and
/// B = −nf. With −1 at z = −N and +1 at z = −F it gives the OpenGL row (C56) with its sign flipped.
///
/// # Errors
/// Returns an error if a number is not finite, a z is 0, or the two z values are equal.
pub fn third_row(first: (f64, f64), second: (f64, f64)) -> Result<(f64, f64), ProjectionError> {
    let ((z_1, at_1), (z_2, at_2)) = (first, second);
    for (parameter, value) in [("z_1", z_1), ("z_2", z_2)] {
        if check_finite(parameter, value)? == 0.0 {
            return Err(ProjectionError::OutOfRange { parameter, value, allowed: "nonzero" });
        }
    }
    check_finite("at_1", at_1)?;
    check_finite("at_2", at_2)?;
    if z_1 == z_2 {
        return Err(ProjectionError::EmptyDepth { value: z_1 });
    }
    let a = (z_1 * at_1 - z_2 * at_2) / (z_1 - z_2);
    let b = (at_1 - at_2) * z_1 * z_2 / (z_2 - z_1);
    let usable = a.is_finite() && b.is_finite();
    usable.then_some((a, b)).ok_or(ProjectionError::Unrepresentable { what: "depth range" })
}
