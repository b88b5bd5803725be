//! Blocker search at many positions of a shadow map, eight at a time.

use super::visibility::floor_lanes;
use super::{ReceiverPlane, SLOPE_BIAS, ShadowMap};
use crate::lanes::Lanes;
use raster::{LANES, SurfaceDepth};
use std::sync::LazyLock;

/// Evenly distributed positions in a disc of radius 1, for the search and filter of point lights.
pub(crate) static VOGEL_DISC: LazyLock<[[f32; 2]; 48]> =
    LazyLock::new(|| std::array::from_fn(|index| vogel_position(index, 48)));

/// Returns one of `count` evenly distributed positions in a disc of radius 1, on Vogel's spiral
/// (1979) with the golden angle.
fn vogel_position(index: usize, count: usize) -> [f32; 2] {
    let radius = ((index as f64 + 0.5) / count as f64).sqrt();
    let angle = index as f64 * 2.399_963_229_728_653;
    [(radius * libm::cos(angle)) as f32, (radius * libm::sin(angle)) as f32]
}

/// Positions in a disc of radius 1, with x and y in groups of eight.
#[derive(Clone, Copy)]
pub(super) struct Disc<'a>(&'a [[Lanes<LANES>; 2]]);

impl Disc<'_> {
    /// Returns the number of positions.
    #[inline(always)]
    pub(super) fn position_count(self) -> f32 {
        (self.0.len() * LANES) as f32
    }
}

/// Discs of 8, 16, 24 and 48 positions, one after another.
static DISCS: LazyLock<[[Lanes<LANES>; 2]; 12]> = LazyLock::new(|| {
    let counts = [8, 16, 24, 48];
    let mut positions = counts
        .into_iter()
        .flat_map(|count| (0..count).map(move |index| vogel_position(index, count)));
    std::array::from_fn(|_| {
        let eight: [_; LANES] = std::array::from_fn(|_| positions.next().unwrap_or_default());
        [0, 1].map(|axis: usize| Lanes::from_fn(|lane| eight[lane][axis]))
    })
});

/// Returns the positions for the search. A narrow disc has fewer positions, because it covers few
/// texels.
#[inline(always)]
pub(super) fn search_disc(radius: f32) -> Disc<'static> {
    let range = match radius {
        ..=3.0 => 0..1,
        ..=8.0 => 1..3,
        _ => 3..6,
    };
    Disc(DISCS.get(range).unwrap_or_default())
}

/// Returns the positions for the filter.
#[inline(always)]
pub(super) fn filter_disc(radius: f32) -> Disc<'static> {
    let range = match radius {
        ..=3.0 => 1..3,
        ..=6.0 => 3..6,
        _ => 6..12,
    };
    Disc(DISCS.get(range).unwrap_or_default())
}

/// The number of blockers found, and the sum of their depths.
pub(super) struct Blockers {
    pub(super) count: f32,
    pub(super) depth_sum: f32,
}

impl ShadowMap {
    /// Counts the blockers of a receiver at the positions of a disc around it, and sums their
    /// depths. The comparisons are the same as in [`ShadowMap::find_blocker`].
    #[inline(always)]
    pub(super) fn count_blockers(
        &self,
        receiver: &ReceiverPlane,
        radius: f32,
        disc: Disc<'_>,
    ) -> Blockers {
        let (mut counts, mut depth_sums) = (Lanes::<LANES>::ZERO, Lanes::ZERO);
        for [offset_x, offset_y] in disc.0 {
            let (x, y) = (receiver.x + *offset_x * radius, receiver.y + *offset_y * radius);
            let (columns, rows) = (floor_lanes(x), floor_lanes(y));
            let mut indices = [0; LANES];
            for lane in 0..LANES {
                indices[lane] = self.texel_index(columns[lane], rows[lane]);
            }
            let texel =
                |lane: usize| self.texels.get(indices[lane]).unwrap_or(&SurfaceDepth::EMPTY);
            let depths = Lanes::from_fn(|lane| texel(lane).depth);
            let columns = Lanes::from_fn(|lane| columns[lane] as f32);
            let rows = Lanes::from_fn(|lane| rows[lane] as f32);
            let at_center = depths - plane_depths(receiver, columns + 0.5, rows + 0.5);
            // Read slopes only if something is above the plane.
            if !at_center.is_above(receiver.bias).contains(&true) {
                continue;
            }
            let texel_dx = Lanes::from_fn(|lane| texel(lane).dx);
            let texel_dy = Lanes::from_fn(|lane| texel(lane).dy);
            let (dx, dy) = (x - columns - 0.5, y - rows - 0.5);
            let bias = receiver.bias + SLOPE_BIAS * (texel_dx.abs() + texel_dy.abs());
            let here = depths + texel_dx * dx + texel_dy * dy - plane_depths(receiver, x, y);
            let is_blocker = (at_center.min_lanes(here) - bias).is_above(0.0);
            counts += Lanes::ONE.select(&is_blocker, Lanes::ZERO);
            depth_sums += depths.select(&is_blocker, Lanes::ZERO);
        }
        Blockers { count: sum_lanes(counts), depth_sum: sum_lanes(depth_sums) }
    }
}

/// Computes the sum of all lanes by halving.
#[inline(always)]
fn sum_lanes(Lanes([a, b, c, d, e, f, g, h]): Lanes<LANES>) -> f32 {
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

/// Computes the depths of the receiver's plane at positions of the map.
#[inline(always)]
fn plane_depths(receiver: &ReceiverPlane, x: Lanes<LANES>, y: Lanes<LANES>) -> Lanes<LANES> {
    receiver.depth + receiver.slope[0] * (x - receiver.x) + receiver.slope[1] * (y - receiver.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Vec3Lanes;
    use crate::shadow_map::tests::map;

    #[test]
    fn eight_positions_at_once_match_single_positions() {
        let map = map(0.5, 30.0);
        for step in 0..500 {
            let [x, z] = [step * 37 % 1000, step * 91 % 1000].map(|c| c as f32 * 0.001);
            let (position, normal) = ([x, 0.1, z], [0.1, 0.99, 0.1]);
            let planes =
                map.project_receivers::<1>(Vec3Lanes::splat(position), Vec3Lanes::splat(normal));
            if !planes.is_on_map[0] {
                continue;
            }
            let receiver = planes.lane(0);
            let radius = 1.5 + (step % 60) as f32;
            let disc = filter_disc(radius);
            let (mut count, mut depth_sum) = (0.0, 0.0);
            for [dx, dy] in disc.0 {
                for lane in 0..LANES {
                    let position = [receiver.x + dx[lane] * radius, receiver.y + dy[lane] * radius];
                    if let Some(depth) = map.find_blocker(&receiver, position) {
                        count += 1.0;
                        depth_sum += depth;
                    }
                }
            }
            let found = map.count_blockers(&receiver, radius, disc);
            assert_eq!(found.count, count, "{x} {z}");
            assert!((found.depth_sum - depth_sum).abs() < 1e-4, "{x} {z}");
        }
    }

    #[test]
    fn disc_positions_are_evenly_distributed() {
        for (radius, count) in [(2.0, 16.0), (4.0, 24.0), (60.0, 48.0)] {
            let disc = filter_disc(radius);
            assert_eq!(disc.position_count(), count);
            // Over a disc of radius 1, the mean of x² + y² is ½, and the means of x and y are 0.
            let (mut sums, mut squares) = ([0.0; 2], 0.0);
            for [x, y] in disc.0 {
                for lane in 0..LANES {
                    sums[0] += x[lane] / count;
                    sums[1] += y[lane] / count;
                    squares += (x[lane] * x[lane] + y[lane] * y[lane]) / count;
                }
            }
            assert!((squares - 0.5).abs() < 1e-3, "{count}: {squares}");
            assert!(sums.iter().all(|mean| mean.abs() < 0.04), "{count}: {sums:?}");
        }
    }
}
