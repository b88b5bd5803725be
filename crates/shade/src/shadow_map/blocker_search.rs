//! The search for blockers at many positions of a shadow map, eight at once.

use super::{ReceiverPlane, SLOPE_BIAS, ShadowMap, VOGEL_DISC};
use crate::approximations::floor_to_int;
use crate::lanes::Lanes;
use raster::{Kernel, LANES, SurfaceDepth};
use std::sync::LazyLock;

/// Positions in a disc of radius 1, x and y of eight at a time.
pub(super) type DiscLanes = [[Lanes<LANES>; 2]];

/// All positions of the disc, for the filter.
pub(super) static FILTER_DISC: LazyLock<[[Lanes<LANES>; 2]; 6]> =
    LazyLock::new(|| std::array::from_fn(|packet| disc_lanes(packet, 1)));
/// Every second one, for the search.
pub(super) static SEARCH_DISC: LazyLock<[[Lanes<LANES>; 2]; 3]> =
    LazyLock::new(|| std::array::from_fn(|packet| disc_lanes(packet, 2)));

/// Eight positions of the disc, `step` apart.
fn disc_lanes(packet: usize, step: usize) -> [Lanes<LANES>; 2] {
    let at = |lane: usize| VOGEL_DISC[(packet * LANES + lane) * step];
    [Lanes::from_fn(|lane| at(lane)[0]), Lanes::from_fn(|lane| at(lane)[1])]
}

/// The kernel that counts the blockers of a receiver in a disc around it, and adds up their depths
/// in the order of the positions.
pub(super) struct CountBlockers<'a> {
    pub(super) map: &'a ShadowMap,
    pub(super) receiver: &'a ReceiverPlane,
    /// The radius of the disc in texels.
    pub(super) radius: f32,
    pub(super) disc: &'a DiscLanes,
}

/// The blockers that were found.
pub(super) struct Blockers {
    pub(super) count: f32,
    pub(super) depth_sum: f32,
}

impl Kernel for CountBlockers<'_> {
    type Output = Blockers;

    /// The comparisons of [`ShadowMap::find_blocker`], bit for bit.
    #[inline(always)]
    fn run(self) -> Blockers {
        let Self { map, receiver, radius, disc } = self;
        let mut blockers = Blockers { count: 0.0, depth_sum: 0.0 };
        for [offset_x, offset_y] in disc {
            let (x, y) = (receiver.x + *offset_x * radius, receiver.y + *offset_y * radius);
            let (columns, rows) = (floor_of(x), floor_of(y));
            let mut texels = [Lanes::ZERO; 3];
            for lane in 0..LANES {
                let texel = map.texel_at(columns[lane], rows[lane]);
                let SurfaceDepth { depth, dx, dy } = *texel.unwrap_or(&SurfaceDepth::EMPTY);
                texels[0][lane] = depth;
                texels[1][lane] = dx;
                texels[2][lane] = dy;
            }
            let [depths, texel_dx, texel_dy] = texels;
            let columns = Lanes::from_fn(|lane| columns[lane] as f32);
            let rows = Lanes::from_fn(|lane| rows[lane] as f32);
            let (dx, dy) = (x - columns - 0.5, y - rows - 0.5);
            let bias = receiver.bias + SLOPE_BIAS * (texel_dx.abs() + texel_dy.abs());
            let at_center = depths - plane_depths(receiver, columns + 0.5, rows + 0.5);
            let here = depths + texel_dx * dx + texel_dy * dy - plane_depths(receiver, x, y);
            for lane in 0..LANES {
                let blocks = (at_center[lane] > bias[lane]) & (here[lane] > bias[lane]);
                blockers.count += if blocks { 1.0 } else { 0.0 };
                blockers.depth_sum += if blocks { depths[lane] } else { 0.0 };
            }
        }
        blockers
    }
}

/// The largest integers not above some numbers.
#[inline(always)]
fn floor_of(numbers: Lanes<LANES>) -> [i32; LANES] {
    let mut integers = [0; LANES];
    for (integer, number) in integers.iter_mut().zip(numbers.0) {
        *integer = floor_to_int(number);
    }
    integers
}

/// The depths of the receiver's plane at positions of the map.
#[inline(always)]
fn plane_depths(receiver: &ReceiverPlane, x: Lanes<LANES>, y: Lanes<LANES>) -> Lanes<LANES> {
    receiver.depth + receiver.slope[0] * (x - receiver.x) + receiver.slope[1] * (y - receiver.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shadow_map::tests::map;
    use raster::SimdLevel;

    #[test]
    fn eight_at_once_are_those_found_one_by_one() {
        let map = map(0.5, 30.0);
        for step in 0..500 {
            let [x, z] = [step * 37 % 1000, step * 91 % 1000].map(|c| c as f32 * 0.001);
            let receiver = map.project_receiver([x, 0.1, z], [0.1, 0.99, 0.1]);
            let Some(receiver) = receiver else { continue };
            let radius = 1.0 + (step % 60) as f32;
            let (mut count, mut depth_sum) = (0.0, 0.0);
            for [dx, dy] in VOGEL_DISC.iter() {
                let position = [receiver.x + dx * radius, receiver.y + dy * radius];
                if let Some(depth) = map.find_blocker(&receiver, position) {
                    count += 1.0;
                    depth_sum += depth;
                }
            }
            let receiver = &receiver;
            let disc = FILTER_DISC.as_slice();
            for level in SimdLevel::available() {
                let found = level.run_kernel(CountBlockers { map: &map, receiver, radius, disc });
                assert_eq!((found.count, found.depth_sum), (count, depth_sum), "{x} {z}");
            }
        }
    }
}
