//! Point clipping (CL-1).

use crate::Volume;
use homog::{Clip, HPoint};

/// Returns the point itself if it is inside the volume or on its boundary. Returns `None` if it is
/// outside, not finite, or the zero vector.
///
/// The test comes before the divide. Afterward it would be too late: dividing can move a point
/// behind the eye into the cube, where it looks visible.
///
/// ```
/// use clip::{Volume, clip_point};
/// use homog::HPoint;
/// let behind = HPoint::new(0.0, 0.0, 0.5, -1.0);
/// assert_eq!(behind.divide().map(|p| p.z()), Some(-0.5)); // it looks visible
/// assert_eq!(clip_point(behind, &Volume::CHAPTER), None); // but it is not
/// ```
#[must_use]
pub fn clip_point(point: HPoint<Clip>, volume: &Volume) -> Option<HPoint<Clip>> {
    volume.contains(point).then_some(point)
}
