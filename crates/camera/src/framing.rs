//! Framing in perspective: where the eye must stand so that some points just fill the picture.
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
//! Each side of the pyramid is pushed inwards, at its own slope, until it touches a point. In
//! coordinates along u, v, w a point (x, y, z) is left of the right side, of slope r, if x − ex ≤ r
//! (ez − z), that is if ex + r ez ≥ x + r z: one number per side and point, and of these only the
//! greatest, R, counts. With the least, L, for the left side we have ex + r ez ≥ R and ex + l ez ≤
//! L, hence ez ≥ (R − L)/(r − l): the least distance at which the width fits. The height gives
//! another; the greater one counts, and in the other direction the picture is centered. There is no
//! sphere around the points, no trial and no margin, and no point is cropped.

use crate::point_coordinates::PointCoordinates;
use crate::{Basis, Camera, FramingError};
use homog::{Point, Vector, World};

/// The nearest point stands at least this part of the points' diagonal in front of the eye.
///
/// Otherwise a needle that points at the viewer, narrower than the pyramid, would be framed from
/// its very tip.
const MIN_CLEARANCE: f64 = 1.0 / 64.0;

/// The frame as the slopes of its four sides: the window at distance 1 in front of the eye.
///
/// A symmetric frame with a vertical opening angle θ has `top` = −`bottom` = tan(θ/2) and `right` =
/// −`left` = `top` × width/height. Frames off the axis, of a shifted lens or a stereo eye, are as
/// welcome.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Slopes {
    /// Left side: x at distance 1, less than `right`.
    pub left: f64,
    /// Right side.
    pub right: f64,
    /// Lower side: y at distance 1, less than `top`.
    pub bottom: f64,
    /// Upper side.
    pub top: f64,
}

impl Slopes {
    /// The symmetric frame with a vertical opening angle in radians, in (0, π), and an aspect ratio
    /// width/height (FOV-1).
    ///
    /// # Errors
    /// An angle out of its range, an aspect that is not positive and finite, or both so extreme
    /// that the frame is no longer a pair of numbers.
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

    /// The frame less `padding` of its width at the left and right, and of its height below and
    /// above.
    ///
    /// # Errors
    /// A window that is empty, mirrored or not finite; a padding outside [0, ½).
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

/// Which demand decided how far away the eye stands, or how large the window is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FramingConstraint {
    /// The points touch the left and right sides of the padded frame, and fit within its height.
    Width,
    /// The points touch the lower and upper sides of the padded frame, and fit within its width.
    Height,
    /// The points touch no side: their image would have no size, or the eye would stand in the
    /// nearest of them.
    Loose,
}

/// A camera in the right place, and how far the points reach in front of it.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct Framing {
    /// The camera.
    pub camera: Camera,
    /// Distance of the nearest point along the gaze, greater than 0. Not padded.
    pub near: f64,
    /// Distance of the farthest point along the gaze. Not padded: equal to `near` if the points lie
    /// in one plane.
    pub far: f64,
    /// The constraint that decided the distance.
    pub constraint: FramingConstraint,
}

/// Places a camera of the given orientation so that the image of `points` just fills the frame.
///
/// In the direction that [`FramingConstraint`] names the image touches both sides of the padded
/// frame; in the other it is centered, with the same margin on both sides. `padding` is the part of
/// the frame's width and height to be left free on every side: 0.05 is 5 per cent. For bounds pass
/// [`homog::Bounds::corners`]; the points themselves give a closer fit.
///
/// A single point is framed as a cube of side 1 around it (or of a millionth of its distance from
/// the origin, if that is more); so are points that lie closer together than 10⁻¹² of that
/// distance. The eye keeps off the nearest point by at least 1/64 of the points' diagonal.
///
/// # Errors
/// No points; a point that is not finite; an empty or mirrored window; a padding outside [0, ½);
/// points so far out, or a frame so narrow or so far off the axis, that f64 has no place for the
/// eye.
///
/// ```
/// use camera::{NamedView, Slopes, frame_perspective};
/// use homog::{Bounds, Point};
/// let cube = Bounds::from_points([[-1.0; 3], [1.0; 3]].map(Point::from)).expect("a cube");
/// let slopes = Slopes { left: -0.5, right: 0.5, bottom: -0.5, top: 0.5 };
/// let framing = frame_perspective(cube.corners(), NamedView::Front.basis(), slopes, 0.0)?;
/// // Its front face, 2 wide, is at distance 2.
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

/// The four supporting planes: the greatest x + r z and y + t z, the least x + l z and y + b z.
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

    /// The eye in coordinates along u, v, w from the points' middle.
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
    /// The eye's coordinate within `range` for which the outermost slopes add up to `sum`, so that
    /// the margins on both sides are alike. `along` picks x or y of a point; the eye is at height
    /// `z`.
    ///
    /// Each point's slope (x − e)/D falls linearly with e, so that the sum of the greatest and the
    /// least falls too, piece by piece. On the right piece one linear equation gives the answer;
    /// the loop finds the piece.
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

    /// Coordinate and distance of the points with the greatest and the least slope as seen from
    /// `eye`.
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
