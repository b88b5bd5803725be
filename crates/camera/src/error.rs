//! Camera and framing errors, with the offending values.

use homog::{Point, Vector, View, World};

/// The reason why an eye, gaze and view-up do not define a camera.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CameraError {
    /// A coordinate is infinite or NaN.
    #[error("the {name} {value} is not finite")]
    NotFinite {
        /// The name of the input: "eye", "target", "gaze", "view-up" and so on.
        name: &'static str,
        /// The three coordinates of the input.
        value: Vector<World>,
    },
    /// The gaze is the zero vector, which has no direction.
    #[error("the gaze is the zero vector: it must point in the direction the camera looks")]
    ZeroGaze,
    /// Eye and target are the same point, so there is no direction between them.
    #[error("the eye and the target are both at {eye}: move one of them")]
    TargetIsEye {
        /// The position of both.
        eye: Point<World>,
    },
    /// The view-up is the zero vector.
    #[error("the view-up is the zero vector: it must point upward in the picture")]
    ZeroUp,
    /// View-up and gaze are parallel, so no side of the picture is up.
    #[error(
        "the view-up {up} is parallel to the gaze {gaze}: choose another view-up, such as \
         {suggestion}"
    )]
    UpParallelToGaze {
        /// The rejected view-up.
        up: Vector<World>,
        /// The gaze to which it is parallel.
        gaze: Vector<World>,
        /// A view-up that works with this gaze, as used by the `_or_fallback` constructors.
        suggestion: Vector<World>,
    },
    /// The eye is too far away for its distance to be computed.
    #[error("the eye {eye} is too far from the origin: coordinates must not exceed {limit:e}")]
    EyeTooFar {
        /// The rejected eye.
        eye: Point<World>,
        /// The largest coordinate allowed.
        limit: f64,
    },
    /// A number is not finite.
    #[error("the {name} is {value}, which is not finite")]
    NumberNotFinite {
        /// The name of the input.
        name: &'static str,
        /// The rejected value.
        value: f64,
    },
    /// A number is not greater than zero.
    #[error("the {name} is {value}: it must be greater than 0")]
    NotPositive {
        /// The name of the input.
        name: &'static str,
        /// The rejected value.
        value: f64,
    },
    /// A number is too large to compute with.
    #[error("the {name} is {value:e}: its magnitude must not exceed {limit:e}")]
    TooLarge {
        /// The name of the input.
        name: &'static str,
        /// The rejected value.
        value: f64,
        /// The largest value allowed.
        limit: f64,
    },
    /// A matrix that should be a rotation has rows that are not perpendicular unit vectors.
    #[error(
        "the matrix is not a rotation: dot products of its rows are off by {deviation:.2e}, \
         more than the allowed 1e-4"
    )]
    NotRotation {
        /// The largest deviation of a dot product of two rows from 1 or 0.
        deviation: f64,
    },
    /// A matrix that should be a rotation is a reflection instead.
    #[error(
        "the matrix is a reflection (its determinant is negative): \
         negate one of its rows or columns"
    )]
    MirroringRotation,
    /// A quaternion is zero and does not represent a rotation.
    #[error("the quaternion is zero: at least one of its four numbers must be nonzero")]
    ZeroQuaternion,
    /// Two opposite sides of the window coincide.
    #[error(
        "the window [{left}, {right}] x [{bottom}, {top}] is empty: opposite sides must differ"
    )]
    EmptyWindow {
        /// The left side of the window.
        left: f64,
        /// The right side of the window.
        right: f64,
        /// The lower side of the window.
        bottom: f64,
        /// The upper side of the window.
        top: f64,
    },
    /// Two corners of the screen are the same point.
    #[error(
        "two corners of the screen are both at {corner}: the screen needs a width and a height"
    )]
    FlatScreen {
        /// The position of both.
        corner: Point<World>,
    },
    /// The sides of the screen are not perpendicular.
    #[error(
        "the sides of the screen are not at right angles: \
         the cosine of the angle between them is {cosine}"
    )]
    SkewedScreen {
        /// The cosine of the angle between them.
        cosine: f64,
    },
    /// The eye is in the plane of the screen or behind the screen.
    #[error(
        "the eye is at distance {distance} from the screen: the distance must be positive, so \
         check the order of the corners"
    )]
    EyeBehindScreen {
        /// The distance of the eye from the screen's plane, which is not positive.
        distance: f64,
    },
}

/// The reason why points cannot be framed.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FramingError {
    /// There are no points.
    #[error("there are no points to frame")]
    NoPoints,
    /// A point has an infinite or NaN coordinate.
    #[error("point {index} of the points to frame is not finite: {point}")]
    PointNotFinite {
        /// The index of the point in the sequence, counted from 0.
        index: usize,
        /// The point.
        point: Point<World>,
    },
    /// The window is empty, mirrored or not finite.
    #[error(
        "the window [{left}, {right}] x [{bottom}, {top}] is empty or mirrored: \
         left must be less than right and bottom less than top"
    )]
    Window {
        /// The left side of the window.
        left: f64,
        /// The right side of the window.
        right: f64,
        /// The lower side of the window.
        bottom: f64,
        /// The upper side of the window.
        top: f64,
    },
    /// The field of view is not between 0 and π.
    #[error("the field of view is {radians} rad: it must be greater than 0 and less than pi")]
    Angle {
        /// The rejected angle.
        radians: f64,
    },
    /// The aspect ratio is not a positive finite number.
    #[error("the aspect ratio is {aspect}: it must be a positive finite number, width / height")]
    Aspect {
        /// The rejected ratio.
        aspect: f64,
    },
    /// The padding is negative or leaves no space in the frame.
    #[error("the padding is {padding}: it must be at least 0 and less than 0.5 of the frame")]
    Padding {
        /// The rejected padding.
        padding: f64,
    },
    /// The projectors are parallel to the view plane, point toward the viewer or are not finite.
    #[error("the projectors run along {direction} in view space: z must be negative")]
    Projectors {
        /// The rejected direction.
        direction: Vector<View>,
    },
    /// The points or the window are so large or so extreme that the camera is not finite.
    #[error(
        "the points, up to {farthest:e} from the origin, cannot be framed within the range of f64"
    )]
    OutOfRange {
        /// The largest coordinate of any point.
        farthest: f64,
    },
    /// The camera itself is invalid.
    #[error(transparent)]
    Camera(#[from] CameraError),
}
