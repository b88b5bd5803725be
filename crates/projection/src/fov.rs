//! Field of view, by angle or by focal length.

use crate::ProjectionError;
use crate::error::{check_finite, check_opening_angle, check_positive};

/// The field of view of a perspective projection. Angles are in radians, between 0 and π
/// (FOV-1, C33, C49).
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Fov {
    /// The angle between the centers of the bottom and top edges.
    Vertical(f64),
    /// The angle between the centers of the left and right edges.
    Horizontal(f64),
    /// The angle between opposite corners.
    Diagonal(f64),
    /// The focal length of a lens and the size of the film, both in the same unit.
    FocalLength {
        /// The focal length: the distance between lens and film.
        focal: f64,
        /// The size of the film.
        film: SensorSize,
    },
}

/// The dimension of the film or sensor that the picture fills.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum SensorSize {
    /// The height of the film.
    Height(f64),
    /// The width of the film.
    Width(f64),
    /// The diagonal of the film.
    Diagonal(f64),
}

impl SensorSize {
    /// The diagonal of the 36 mm × 24 mm frame to which "35 mm equivalent" focal lengths refer, in
    /// millimeters.
    pub const FULL_FRAME_MM: Self = Self::Diagonal(43.266615305567875);
}

/// Half the width and half the height of the window at distance 1 in front of the eye.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HalfSlopes {
    /// The tangent of half the horizontal angle.
    pub x: f64,
    /// The tangent of half the vertical angle.
    pub y: f64,
}

impl Fov {
    /// Creates a vertical field of view from degrees, the most common unit in files and dialogs.
    #[must_use]
    pub fn vertical_degrees(degrees: f64) -> Self {
        Self::Vertical(degrees.to_radians())
    }

    /// Creates a horizontal field of view from degrees.
    #[must_use]
    pub fn horizontal_degrees(degrees: f64) -> Self {
        Self::Horizontal(degrees.to_radians())
    }

    /// Creates a field of view from a "35 mm equivalent" focal length (by diagonal) in millimeters.
    #[must_use]
    pub const fn equivalent_35mm(focal: f64) -> Self {
        Self::FocalLength { focal, film: SensorSize::FULL_FRAME_MM }
    }

    /// Returns half the size of the window at distance 1 in front of the eye, for an image with
    /// this aspect (width / height).
    ///
    /// # Errors
    /// Returns an error if the aspect, a length or the angle is not finite or out of range.
    pub fn half_slopes(self, aspect: f64) -> Result<HalfSlopes, ProjectionError> {
        check_positive("aspect", aspect)?;
        let half = |angle: f64| libm::tan(0.5 * angle);
        match self {
            Self::Vertical(angle) => Ok(half_slopes_by_height(
                half(check_opening_angle("vertical field of view", angle)?),
                aspect,
            )),
            Self::Horizontal(angle) => Ok(half_slopes_by_width(
                half(check_opening_angle("horizontal field of view", angle)?),
                aspect,
            )),
            Self::Diagonal(angle) => Ok(half_slopes_by_diagonal(
                half(check_opening_angle("diagonal field of view", angle)?),
                aspect,
            )),
            Self::FocalLength { focal, film } => {
                check_positive("focal length", focal)?;
                Ok(match film {
                    SensorSize::Height(size) => half_slopes_by_height(
                        0.5 * check_positive("film height", size)? / focal,
                        aspect,
                    ),
                    SensorSize::Width(size) => half_slopes_by_width(
                        0.5 * check_positive("film width", size)? / focal,
                        aspect,
                    ),
                    SensorSize::Diagonal(size) => half_slopes_by_diagonal(
                        0.5 * check_positive("film diagonal", size)? / focal,
                        aspect,
                    ),
                })
            }
        }
    }
}

fn half_slopes_by_height(y: f64, aspect: f64) -> HalfSlopes {
    HalfSlopes { x: aspect * y, y }
}

fn half_slopes_by_width(x: f64, aspect: f64) -> HalfSlopes {
    HalfSlopes { x, y: x / aspect }
}

fn half_slopes_by_diagonal(half: f64, aspect: f64) -> HalfSlopes {
    let diagonal = libm::hypot(1.0, aspect);
    HalfSlopes { x: half * (aspect / diagonal), y: half / diagonal }
}

/// Returns the angle subtended at the eye by the interval from `low` to `high` on a plane at
/// `distance`, in radians: atan(high/distance) − atan(low/distance) (FOV-1).
///
/// # Errors
/// Returns an error if a number is not finite or the distance is not positive.
pub fn opening_angle_of(low: f64, high: f64, distance: f64) -> Result<f64, ProjectionError> {
    check_finite("low", low)?;
    check_finite("high", high)?;
    check_positive("distance", distance)?;
    Ok(libm::atan2(high, distance) - libm::atan2(low, distance))
}
