//! Framing in parallel projection: the smallest window that contains the image of a set of points.
//!
//! ```text
//!        window
//!    top ┌────────┐
//!        │ ●    ● │ ◄── d      The box around the images of the points,
//!        │    ●   │            with the requested aspect.
//! bottom └────────┘
//!       left    right
//! ```
//!
//! The projectors run along the gaze (orthographic) or along any direction d away from the viewer
//! (oblique). A point (x, y, z) of view space has its image in the plane of the eye, z = 0, at (x −
//! z dx/dz, y − z dy/dz). Sources: OB-1, VV-1.

use crate::framing::{check_aspect, check_padding};
use crate::point_coordinates::PointCoordinates;
use crate::{Basis, Camera, FramingConstraint, FramingError};
use glam::DVec3;
use homog::{Point, Vector, View, World};

/// A camera, a window and a depth range for a parallel projection.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct ParallelFraming {
    /// The camera. Its eye is on the projector through the center of the picture. The eye's
    /// distance from the nearest point is the diagonal of the points.
    pub camera: Camera,
    /// The left side of the window in view space, in the plane z = 0 of the eye: −`right`.
    pub left: f64,
    /// The right side.
    pub right: f64,
    /// The lower side: −`top`.
    pub bottom: f64,
    /// The upper side.
    pub top: f64,
    /// The distance of the nearest point along the gaze, greater than 0, without padding.
    pub near: f64,
    /// The distance of the farthest point along the gaze, without padding. It equals `near` if the
    /// points are in one plane.
    pub far: f64,
    /// The dimension of the picture that determined the size.
    pub constraint: FramingConstraint,
}

/// Chooses the camera and window of an orthographic projection in which the image of `points` just
/// fills the frame.
///
/// The image touches two opposite sides of the padded frame and is centered between the other two.
/// `aspect` is the width of the frame divided by its height, and `padding` is the fraction of the
/// frame left free on every side: 0.05 is 5%. If all images coincide, because the points are on one
/// projector, the height of the frame is the diagonal of the points. A single point is framed as a
/// cube with side 1 around it, or with a millionth of its distance from the origin if that is more.
///
/// # Errors
/// Returns an error if there are no points, if a point is not finite, if the aspect is not positive
/// and finite, or if the padding is outside [0, ½). It is also an error if the points are so far
/// away, or the aspect or the projectors are so extreme, that f64 cannot represent the eye.
///
/// ```
/// use camera::{NamedView, frame_parallel};
/// use homog::{Bounds, Point};
/// let slab = Bounds::from_points([[0.0; 3], [8.0, 2.0, 1.0]].map(Point::from)).expect("a slab");
/// let front = frame_parallel(slab.corners(), NamedView::Front.basis(), 2.0, 0.0)?;
/// assert_eq!((front.left, front.right), (-4.0, 4.0));
/// assert_eq!((front.bottom, front.top), (-2.0, 2.0));
/// assert_eq!((front.camera.eye().x(), front.camera.eye().y()), (4.0, 1.0));
/// # Ok::<(), camera::FramingError>(())
/// ```
pub fn frame_parallel<I>(
    points: I,
    orientation: Basis,
    aspect: f64,
    padding: f64,
) -> Result<ParallelFraming, FramingError>
where
    I: IntoIterator<Item = Point<World>>,
    I::IntoIter: Clone,
{
    frame_oblique(points, orientation, -Vector::Z, aspect, padding)
}

/// Like [`frame_parallel`], but with projectors along `projectors`, a direction in view space that
/// points away from the viewer (z < 0). Its length does not matter; (0, 0, −1) gives the
/// orthographic projection.
///
/// The window is in the plane of the eye, z = 0: a point (x, y, z) of view space has its image at
/// (x − z a/c, y − z b/c) for projectors (a, b, c).
///
/// # Errors
/// Returns the same errors as [`frame_parallel`], and an error if the projectors are not finite or
/// have z ≥ 0.
pub fn frame_oblique<I>(
    points: I,
    orientation: Basis,
    projectors: Vector<View>,
    aspect: f64,
    padding: f64,
) -> Result<ParallelFraming, FramingError>
where
    I: IntoIterator<Item = Point<World>>,
    I::IntoIter: Clone,
{
    check_padding(padding)?;
    check_aspect(aspect)?;
    let shear = projector_shear(projectors)?;
    let points = PointCoordinates::new(points.into_iter(), orientation)?;
    let image = ImageBounds::from_points(&points, shear);
    let (half_width, half_height, fit) = image.padded_window(&points, aspect, padding);

    // The eye is on the projector through the center of the image, which is in the plane z = 0
    // through the center of the points.
    let near = points.extent.diagonal();
    let z = points.extent.max.z + near;
    let middle = image.center();
    let eye = Vector::new(middle.x + z * shear.x, middle.y + z * shear.y, z);
    let far = z - points.extent.min.z;
    points.check_range(half_width.is_finite() && half_height.is_finite() && far.is_finite())?;
    let camera = points.camera_at(eye, near.min(half_width).min(half_height))?;
    let (left, right, bottom, top) = (-half_width, half_width, -half_height, half_height);
    Ok(ParallelFraming { camera, left, right, bottom, top, near, far, constraint: fit })
}

/// Returns the change of x and y per unit of z along a projector.
fn projector_shear(projectors: Vector<View>) -> Result<DVec3, FramingError> {
    let shear = projectors.raw() / projectors.z();
    let usable = projectors.is_finite() && projectors.z() < 0.0 && shear.is_finite();
    usable.then_some(shear).ok_or(FramingError::Projectors { direction: projectors })
}

/// The box around the images, in the plane through the center of the points.
struct ImageBounds {
    min: DVec3,
    max: DVec3,
}

impl ImageBounds {
    fn from_points<I: Iterator<Item = Point<World>> + Clone>(
        points: &PointCoordinates<I>,
        shear: DVec3,
    ) -> Self {
        let nothing = DVec3::splat(f64::INFINITY);
        let mut image = Self { min: nothing, max: -nothing };
        points.for_each(|p| {
            let foot = p - shear * p.z;
            image.min = image.min.min(foot);
            image.max = image.max.max(foot);
        });
        image
    }

    fn center(&self) -> DVec3 {
        self.min * 0.5 + self.max * 0.5
    }

    /// Returns half the width and half the height of the padded window, and the constraint that
    /// determined them.
    fn padded_window<I: Iterator<Item = Point<World>> + Clone>(
        &self,
        points: &PointCoordinates<I>,
        aspect: f64,
        padding: f64,
    ) -> (f64, f64, FramingConstraint) {
        let size = self.max - self.min;
        let inner = 1.0 - 2.0 * padding;
        let height = match size.y.max(size.x / aspect) {
            0.0 => points.extent.diagonal(),
            height => height,
        };
        let fit = match height {
            _ if points.is_single_point() => FramingConstraint::Loose,
            h if h == size.y => FramingConstraint::Height,
            h if h == size.x / aspect => FramingConstraint::Width,
            _ => FramingConstraint::Loose,
        };
        let half = height / inner / 2.0;
        (half * aspect, half, fit)
    }
}
