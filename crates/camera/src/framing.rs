//! Perspective framing: the eye position at which a set of points just fills the picture.
//!
//! ```text
//!  v
//!  │                ___──── upper side of the frame, of slope t
//!  │         ___─── ●
//!  │   ___───    ●      ●
//! eye ───────────────────────────► −w
//!  │   ‾‾‾───   ●     ●
//!  │         ‾‾‾─── ●
//!                   ‾‾‾──── lower side, of slope b
//! ```
//!
//! Each side of the pyramid moves inward, keeping its slope, until it touches a point. In
//! coordinates along u, v, w a point (x, y, z) is left of the right side, which has slope r, if x −
//! ex ≤ r (ez − z), that is, if ex + r ez ≥ x + r z. Only the largest x + r z of all points, R,
//! matters. For the left side, of slope l, only the smallest x + l z, L, matters. With ex + r ez ≥
//! R and ex + l ez ≤ L, ez ≥ (R − L)/(r − l), the smallest distance at which the width fits. The
//! height gives a second distance. The larger one is used, and the picture is centered in the other
//! direction. No bounding sphere or safety margin is needed, and no point is cropped.

use crate::point_coordinates::PointCoordinates;
use crate::{Basis, Camera, FramingError};
use homog::{Point, Vector, World};

/// The minimum distance from the eye to the nearest point, as a fraction of the diagonal of the
/// points.
///
/// Without this minimum, the eye could touch the tip of a needle that points at the viewer and is
/// narrower than the pyramid.
const MIN_CLEARANCE: f64 = 1.0 / 64.0;

/// The frame as the slopes of its four sides: the window at distance 1 in front of the eye.
///
/// A symmetric frame with a vertical field of view θ has `top` = −`bottom` = tan(θ/2) and `right` =
/// −`left` = `top` × width/height. Off-axis frames, as for shifted lenses and stereo pairs, also
/// work.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Slopes {
    /// The left side: x at distance 1, less than `right`.
    pub left: f64,
    /// The right side.
    pub right: f64,
    /// The lower side: y at distance 1, less than `top`.
    pub bottom: f64,
    /// The upper side.
    pub top: f64,
}

impl Slopes {
    /// Creates a symmetric frame from a vertical field of view in radians, in (0, π), and an aspect
    /// ratio, width/height (FOV-1).
    ///
    /// # Errors
    /// Returns an error if the angle is out of range, if the aspect is not positive and finite, or
    /// if the slopes are too extreme to represent.
    pub fn vertical_angle(radians: f64, aspect: f64) -> Result<Self, FramingError> {
        if !(radians > 0.0 && radians < core::f64::consts::PI) {
            return Err(FramingError::Angle { radians });
        }
        check_aspect(aspect)?;
        let top = libm::tan(radians / 2.0);
        let right = top * aspect;
        let slopes = Self { left: -right, right, bottom: -top, top };
        slopes.padded(0.0)
    }

    /// Returns the frame reduced by `padding` of its width on the left and right, and of its height
    /// at the top and bottom.
    ///
    /// # Errors
    /// Returns an error if the window is empty, mirrored or not finite, or if the padding is
    /// outside [0, ½).
    pub fn padded(self, padding: f64) -> Result<Self, FramingError> {
        let Self { left, right, bottom, top } = self;
        check_padding(padding)?;
        let (width, height) = (right - left, top - bottom);
        if !(width > 0.0 && height > 0.0 && width.is_finite() && height.is_finite()) {
            return Err(FramingError::Window { left, right, bottom, top });
        }
        let (dx, dy) = (padding * width, padding * height);
        Ok(Self { left: left + dx, right: right - dx, bottom: bottom + dy, top: top - dy })
    }
}

/// The constraint that determined the distance of the eye or the size of the window.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FramingConstraint {
    /// The points touch the left and right sides of the padded frame, and fit within its height.
    Width,
    /// The points touch the lower and upper sides of the padded frame, and fit within its width.
    Height,
    /// The points do not touch any side, because otherwise their image would have no size, or the
    /// eye would coincide with the nearest point.
    Loose,
}

/// A framed camera, with the depth range of the points in front of it.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct Framing {
    /// The camera.
    pub camera: Camera,
    /// The distance of the nearest point along the gaze, greater than 0, without padding.
    pub near: f64,
    /// The distance of the farthest point along the gaze, without padding. It equals `near` if the
    /// points are in one plane.
    pub far: f64,
    /// The constraint that determined the distance.
    pub constraint: FramingConstraint,
}

/// Places a camera with the given orientation where the image of `points` just fills the frame.
///
/// In the direction named by [`FramingConstraint`], the image touches both sides of the padded
/// frame; in the other direction it is centered. `padding` is the fraction of the frame's width and
/// height left free on every side: 0.05 is 5%. To frame bounds, pass [`homog::Bounds::corners`];
/// the points themselves give a closer fit.
///
/// A single point is framed as a cube with side 1 around it, or with a millionth of its distance
/// from the origin if that is more. The same applies to points closer together than 10⁻¹² of that
/// distance. The eye stays at least 1/64 of the diagonal of the points away from the nearest point.
///
/// # Errors
/// Returns an error if there are no points, if a point is not finite, if the window is empty or
/// mirrored, or if the padding is outside [0, ½). It is also an error if the points are so far
/// away, or the frame is so narrow or so far off the axis, that f64 cannot represent the eye.
///
/// ```
/// use camera::{NamedView, Slopes, frame_perspective};
/// use homog::{Bounds, Point};
/// let cube = Bounds::from_points([[-1.0; 3], [1.0; 3]].map(Point::from)).expect("a cube");
/// let slopes = Slopes { left: -0.5, right: 0.5, bottom: -0.5, top: 0.5 };
/// let framing = frame_perspective(cube.corners(), NamedView::Front.basis(), slopes, 0.0)?;
/// // The cube's front face, 2 wide, is at distance 2.
/// assert_eq!(framing.camera.eye(), Point::new(0.0, 0.0, 3.0));
/// assert_eq!((framing.near, framing.far), (2.0, 4.0));
/// # Ok::<(), camera::FramingError>(())
/// ```
pub fn frame_perspective<I>(
    points: I,
    orientation: Basis,
    slopes: Slopes,
    padding: f64,
) -> Result<Framing, FramingError>
where
    I: IntoIterator<Item = Point<World>>,
    I::IntoIter: Clone,
{
    let frame = slopes.padded(padding)?;
    let points = PointCoordinates::new(points.into_iter(), orientation)?;
    let sides = SupportPlanes::from_points(&points, frame);
    let (eye, fit) = sides.eye_coordinates(&points, frame);
    let (near, far) = (eye.z() - points.extent.max.z, eye.z() - points.extent.min.z);
    points.check_range(near.is_finite() && far.is_finite())?;
    let camera = points.camera_at(eye, near)?;
    Ok(Framing { camera, near, far, constraint: fit })
}

/// The four supporting planes: the maximum x + r z and y + t z, the minimum x + l z and y + b z.
struct SupportPlanes {
    left: f64,
    right: f64,
    bottom: f64,
    top: f64,
}

impl SupportPlanes {
    fn from_points<I: Iterator<Item = Point<World>> + Clone>(
        points: &PointCoordinates<I>,
        frame: Slopes,
    ) -> Self {
        let out = f64::INFINITY;
        let mut sides = Self { left: out, right: -out, bottom: out, top: -out };
        points.for_each(|p| {
            sides.left = sides.left.min(p.x + frame.left * p.z);
            sides.right = sides.right.max(p.x + frame.right * p.z);
            sides.bottom = sides.bottom.min(p.y + frame.bottom * p.z);
            sides.top = sides.top.max(p.y + frame.top * p.z);
        });
        sides
    }

    /// Returns the eye in coordinates along u, v, w relative to the center of the points.
    fn eye_coordinates<I: Iterator<Item = Point<World>> + Clone>(
        &self,
        points: &PointCoordinates<I>,
        frame: Slopes,
    ) -> (Vector<homog::View>, FramingConstraint) {
        let for_width = (self.right - self.left) / (frame.right - frame.left);
        let for_height = (self.top - self.bottom) / (frame.top - frame.bottom);
        let clear = points.extent.max.z + MIN_CLEARANCE * points.extent.diagonal();
        let z = for_width.max(for_height).max(clear);
        let fit = match z {
            _ if points.is_single_point() => FramingConstraint::Loose,
            z if z == for_width => FramingConstraint::Width,
            z if z == for_height => FramingConstraint::Height,
            _ => FramingConstraint::Loose,
        };
        let x_range = (self.right - frame.right * z, self.left - frame.left * z);
        let y_range = (self.top - frame.top * z, self.bottom - frame.bottom * z);
        let x = points.center_image(z, x_range, frame.left + frame.right, |p| p.x);
        let y = points.center_image(z, y_range, frame.bottom + frame.top, |p| p.y);
        (Vector::new(x, y, z), fit)
    }
}

impl<I: Iterator<Item = Point<World>> + Clone> PointCoordinates<I> {
    /// Returns the coordinate of the eye within `range` at which the outermost slopes add up to
    /// `sum`, which makes the margins equal. `along` selects x or y of a point; `z` is the third
    /// coordinate of the eye.
    ///
    /// The slope (x − e)/D of each point falls linearly with e, so the sum of the largest and the
    /// smallest also falls and is piecewise linear. The loop finds the correct piece and solves one
    /// linear equation there.
    fn center_image(
        &self,
        z: f64,
        range: (f64, f64),
        sum: f64,
        along: impl Fn(glam::DVec3) -> f64,
    ) -> f64 {
        let (mut low, mut high) = range;
        let mut eye = low * 0.5 + high * 0.5;
        for _ in 0..64 {
            let [(a, da), (b, db)] = self.outermost_slopes(z, eye, &along);
            let excess = (a - eye) / da + (b - eye) / db - sum;
            let side = if excess > 0.0 { &mut low } else { &mut high };
            *side = eye;
            let solved = (a * db + b * da - sum * da * db) / (da + db);
            let within = solved >= low && solved <= high;
            let next = if within { solved } else { low * 0.5 + high * 0.5 };
            if next == eye {
                break;
            }
            eye = next;
        }
        eye
    }

    /// Returns the coordinate and distance of the points with the largest and smallest slopes as
    /// seen from `eye`.
    fn outermost_slopes(
        &self,
        z: f64,
        eye: f64,
        along: impl Fn(glam::DVec3) -> f64,
    ) -> [(f64, f64); 2] {
        let (mut greatest, mut least) = (-f64::INFINITY, f64::INFINITY);
        let mut ends = [(eye, 1.0); 2];
        self.for_each(|p| {
            let (x, distance) = (along(p), z - p.z);
            let slope = (x - eye) / distance;
            if slope > greatest {
                (greatest, ends[0]) = (slope, (x, distance));
            }
            if slope < least {
                (least, ends[1]) = (slope, (x, distance));
            }
        });
        ends
    }
}

pub(crate) fn check_padding(padding: f64) -> Result<(), FramingError> {
    if (0.0..0.5).contains(&padding) { Ok(()) } else { Err(FramingError::Padding { padding }) }
}

pub(crate) fn check_aspect(aspect: f64) -> Result<(), FramingError> {
    if aspect > 0.0 && aspect.is_finite() { Ok(()) } else { Err(FramingError::Aspect { aspect }) }
}
