//! Errors of cameras and framing, each with the values at fault.

use homog::{Point, Vector, View, World};

/// Why no camera can be made of the given eye, gaze and view-up.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CameraError {
    /// A coordinate is infinite or NaN.
    #[error("the {name} {value} is not finite")]
    NotFinite {
        /// Which input: "eye", "target", "gaze", "view-up" …
        name: &'static str,
        /// Its three numbers.
        value: Vector<World>,
    },
    /// The gaze is the zero vector and points nowhere.
    #[error("the gaze is the zero vector: it must point where the camera looks")]
    ZeroGaze,
    /// Eye and target are the same point, so that there is no direction between them.
    #[error("eye and target are both {eye}: move one of them")]
    TargetIsEye {
        /// The place of both.
        eye: Point<World>,
    },
    /// The view-up is the zero vector.
    #[error("the view-up is the zero vector: it must point somewhere upwards in the picture")]
    ZeroUp,
    /// View-up and gaze lie in one line, so that no side of the picture is up.
    #[error(
        "the view-up {up} is parallel to the gaze {gaze}: choose another, such as {suggestion}"
    )]
    UpParallelToGaze {
        /// The view-up as given.
        up: Vector<World>,
        /// The gaze as given.
        gaze: Vector<World>,
        /// A view-up that works with this gaze: the one the `_or_fallback` constructors take.
        suggestion: Vector<World>,
    },
    /// The eye is so far out that its distance cannot be computed.
    #[error("the eye {eye} is too far from the origin: coordinates may reach {limit:e}")]
    EyeTooFar {
        /// The eye as given.
        eye: Point<World>,
        /// The greatest coordinate allowed.
        limit: f64,
    },
    /// A number that must be finite is not.
    #[error("the {name} is {value}, which is not finite")]
    NumberNotFinite {
        /// Which input.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number that must be greater than zero is not.
    #[error("the {name} is {value}: it must be greater than 0")]
    NotPositive {
        /// Which input.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number is too large to compute with.
    #[error("the {name} is {value:e}: its size must not be above {limit:e}")]
    TooLarge {
        /// Which input.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The greatest allowed.
        limit: f64,
    },
    /// A matrix that should be a rotation has rows that are not of length 1 and at right angles.
    #[error(
        "the matrix is no rotation: dot products of its rows are off by {deviation:.2e}, \
         and 1e-4 is allowed"
    )]
    NotRotation {
        /// The largest difference of a dot product of two rows from 1 or 0.
        deviation: f64,
    },
    /// A matrix that should be a rotation mirrors.
    #[error("the matrix mirrors, its determinant is negative: negate one of its rows or columns")]
    MirroringRotation,
    /// A quaternion is zero and turns nothing.
    #[error("the quaternion is zero: one of its four numbers must be different from 0")]
    ZeroQuaternion,
    /// Two opposite sides of the window coincide.
    #[error(
        "the window [{left}, {right}] x [{bottom}, {top}] is empty: opposite sides must differ"
    )]
    EmptyWindow {
        /// Its left side.
        left: f64,
        /// Its right side.
        right: f64,
        /// Its lower side.
        bottom: f64,
        /// Its upper side.
        top: f64,
    },
    /// Two corners of the screen are the same point.
    #[error("two corners of the screen are both {corner}: it needs a width and a height")]
    FlatScreen {
        /// The place of both.
        corner: Point<World>,
    },
    /// The sides of the screen are not at right angles.
    #[error("the sides of the screen are not at right angles: their angle has the cosine {cosine}")]
    SkewedScreen {
        /// The cosine of the angle between them.
        cosine: f64,
    },
    /// The eye is in the plane of the screen or behind it.
    #[error(
        "the eye is {distance} in front of the screen: it must be in front, where left is left"
    )]
    EyeBehindScreen {
        /// Its distance from the screen's plane, not positive.
        distance: f64,
    },
}

/// Why some points cannot be framed.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FramingError {
    /// There are no points.
    #[error("there are no points to frame")]
    NoPoints,
    /// A point has an infinite or NaN coordinate.
    #[error("point {index} to be framed, {point}, is not finite")]
    PointNotFinite {
        /// Its position in the sequence, from 0.
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
        /// Its left side.
        left: f64,
        /// Its right side.
        right: f64,
        /// Its lower side.
        bottom: f64,
        /// Its upper side.
        top: f64,
    },
    /// The opening angle is not between 0 and π.
    #[error("the opening angle is {radians} rad: it must lie between 0 and pi, both excluded")]
    Angle {
        /// The angle as given.
        radians: f64,
    },
    /// The aspect ratio is not a positive finite number.
    #[error("the aspect ratio is {aspect}: it must be a positive finite number, width / height")]
    Aspect {
        /// The ratio as given.
        aspect: f64,
    },
    /// The padding leaves nothing of the frame, or is negative.
    #[error("the padding is {padding}: it must be at least 0 and less than 0.5 of the frame")]
    Padding {
        /// The padding as given.
        padding: f64,
    },
    /// The projectors run along the view plane and never meet it, or towards the viewer, or are not
    /// finite.
    #[error("the projectors run along {direction} in view space: z must be negative")]
    Projectors {
        /// Their direction as given.
        direction: Vector<View>,
    },
    /// Points or window are so large or so extreme that the camera leaves the finite numbers.
    #[error(
        "the points, up to {farthest:e} from the origin, cannot be framed within the range of f64"
    )]
    OutOfRange {
        /// The greatest coordinate among the points.
        farthest: f64,
    },
    /// The camera itself is at fault.
    #[error(transparent)]
    Camera(#[from] CameraError),
}
