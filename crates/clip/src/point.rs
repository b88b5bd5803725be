//! Points (CL-1).

use crate::Volume;
use homog::{Clip, HPoint};

/// The point itself if it is inside the volume or on its boundary; `None` otherwise, and if it is
/// not finite or not a point.
///
/// The test comes before the divide. Afterward it would be too late: a point behind the eye divides
/// into the cube like a visible one.
///
/// ```
/// use clip::{Volume, clip_point};
/// use homog::HPoint;
/// let behind = HPoint::new(0.0, 0.0, 0.5, -1.0);
/// assert_eq!(behind.divide().map(|p| p.z()), Some(-0.5)); // looks visible
/// assert_eq!(clip_point(behind, &Volume::CHAPTER), None); // is not
/// ```
#[must_use]
pub fn clip_point(point: HPoint<Clip>, volume: &Volume) -> Option<HPoint<Clip>> {
    volume.contains(point).then_some(point)
}
