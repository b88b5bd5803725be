//! Percentage-closer soft shadows: the visibility of a light from many positions at once.

use super::blocker_search::{filter_disc, search_disc};
use super::receiver_planes::ReceiverPlanes;
use super::{MAX_FILTER_RADIUS, ReceiverPlane, SLOPE_BIAS, ShadowMap};
use crate::approximations::floor_to_int;
use crate::lanes::{Lanes, Mask};
use crate::shadow_receiver::ShadowReceiver;
use raster::{Kernel, SimdLevel, SurfaceDepth};

impl ShadowMap {
    /// Computes the visibility of the light, 0 to 1, from the receivers in the `wanted` lanes.
    /// Other lanes are 0.
    ///
    /// For hard shadows, four texels are compared. For soft shadows there are up to 24 comparisons,
    /// and up to 48 more within a penumbra. Outside the map and behind the light, nothing is in
    /// shadow.
    #[inline(always)]
    pub(crate) fn visibility<const N: usize>(
        &self,
        receiver: &ShadowReceiver<N>,
        wanted: Mask<N>,
    ) -> Lanes<N> {
        if !wanted.contains(&true) {
            return Lanes::ZERO;
        }
        let kernel = FindVisibility { map: self, receiver, wanted };
        // Eight receivers are always inside a wide kernel already; a single receiver might not be.
        if const { N == 1 } {
            SimdLevel::best().run_kernel(kernel)
        } else {
            SimdLevel::run_part(
                #[inline(always)]
                || kernel.run(),
            )
        }
    }
}

/// The kernel of [`ShadowMap::visibility`].
struct FindVisibility<'a, const N: usize> {
    map: &'a ShadowMap,
    receiver: &'a ShadowReceiver<N>,
    wanted: Mask<N>,
}

impl<const N: usize> Kernel for FindVisibility<'_, N> {
    type Output = Lanes<N>;

    #[inline(always)]
    fn run(self) -> Lanes<N> {
        let Self { map, receiver, wanted } = self;
        let planes = map.project_receivers(receiver.positions, receiver.normals);
        let mut visibility = map.filter_bilinear(&planes).select(&planes.is_on_map, Lanes::ONE);
        visibility = visibility.select(&wanted, Lanes::ZERO);
        if map.penumbra_scale <= 0.0 {
            return visibility;
        }
        for lane in 0..N {
            if wanted[lane] & planes.is_on_map[lane] {
                let soft = map.soft_visibility(&planes.lane(lane));
                visibility[lane] = soft.unwrap_or(visibility[lane]);
            }
        }
        visibility
    }
}

impl ShadowMap {
    /// Computes the visibility with soft shadow edges. Returns `None` if there is no visible
    /// penumbra.
    #[inline(always)]
    fn soft_visibility(&self, receiver: &ReceiverPlane) -> Option<f32> {
        let search_radius = self.search_radius(receiver)?;
        let disc = search_disc(search_radius);
        let found = self.count_blockers(receiver, search_radius, disc);
        if found.count == 0.0 {
            return None;
        }
        // The penumbra of the mean blocker, by similar triangles (PCSS, Fernando 2005).
        let mean_depth = found.depth_sum / found.count;
        let radius = self.penumbra_radius(receiver.depth, mean_depth).min(search_radius);
        if radius <= 1.0 {
            return None;
        }
        // If everything in the wider disc is blocked, the narrower disc is also blocked.
        if found.count == disc.position_count() {
            return Some(0.0);
        }
        // Percentage-closer filtering over the penumbra.
        let disc = filter_disc(radius);
        let blocked = self.count_blockers(receiver, radius, disc).count;
        let positions = disc.position_count();
        Some((positions - blocked) / positions)
    }

    /// Computes the radius of the blocker search: the penumbra radius of the nearest possible
    /// blocker. Returns `None` if nothing can cast a shadow on the receiver.
    #[inline(always)]
    fn search_radius(&self, receiver: &ReceiverPlane) -> Option<f32> {
        let widest = self.penumbra_radius(receiver.depth, 1.0).clamp(1.5, MAX_FILTER_RADIUS);
        // Texels are compared at their centers, up to a texel beyond the radius.
        let reach = widest + 1.0;
        let nearest = self.nearest_depths.depth_around([receiver.x, receiver.y], reach);
        let least = receiver.depth - (receiver.slope[0].abs() + receiver.slope[1].abs()) * reach;
        let radius = self.penumbra_radius(receiver.depth, nearest).clamp(1.5, widest);
        (nearest > least).then_some(radius)
    }

    /// Computes the penumbra radius in texels at one depth for a caster at another depth.
    ///
    /// By similar triangles, this is the size of the light times the distance between receiver and
    /// caster, divided by the distance between caster and light. In parallel light it grows only
    /// with the depth difference.
    #[inline(always)]
    fn penumbra_radius(&self, receiver: f32, caster: f32) -> f32 {
        let distance = match self.depth_at_infinity {
            None => caster - receiver,
            Some(infinity) => (caster - infinity) / (receiver - infinity).max(1e-12) - 1.0,
        };
        self.penumbra_scale * distance
    }

    /// Applies percentage-closer filtering over the four nearest texels with bilinear weights. The
    /// plane of each texel is extended to the receiver.
    #[inline(always)]
    pub(crate) fn filter_bilinear<const N: usize>(
        &self,
        receivers: &ReceiverPlanes<N>,
    ) -> Lanes<N> {
        let (left, top) = (receivers.x - 0.5, receivers.y - 0.5);
        let (columns, rows) = (floor_lanes(left), floor_lanes(top));
        let whole = |integers: [i32; N]| Lanes::from_fn(|lane| integers[lane] as f32);
        let (fx, fy) = (left - whole(columns), top - whole(rows));
        let mut visible = Lanes::ZERO;
        // Four comparisons, each with its bilinear weight.
        for (right, column_weights) in [(0, 1.0 - fx), (1, fx)] {
            for (down, row_weights) in [(0, 1.0 - fy), (1, fy)] {
                let mut indices = [0; N];
                for lane in 0..N {
                    indices[lane] = self.texel_index(columns[lane] + right, rows[lane] + down);
                }
                let [depths, texel_dx, texel_dy] = self.fetch_texels(indices);
                let (dx, dy) = (fx - right as f32, fy - down as f32);
                let bias = receivers.bias + SLOPE_BIAS * (texel_dx.abs() + texel_dy.abs());
                let above = depths - receivers.depth;
                let at_center = above + receivers.slope[0] * dx + receivers.slope[1] * dy;
                let here = above + texel_dx * dx + texel_dy * dy;
                let weights = column_weights * row_weights;
                let is_blocked = (at_center.min_lanes(here) - bias).is_above(0.0);
                visible += Lanes::ZERO.select(&is_blocked, weights);
            }
        }
        visible
    }

    /// Fetches the depths and slopes of texels. Beyond the last texel, returns the values of an
    /// empty texel.
    #[inline(always)]
    fn fetch_texels<const N: usize>(&self, indices: [usize; N]) -> [Lanes<N>; 3] {
        let mut texels = [Lanes::ZERO; 3];
        for lane in 0..N {
            let texel = self.texels.get(indices[lane]).unwrap_or(&SurfaceDepth::EMPTY);
            texels[0][lane] = texel.depth;
            texels[1][lane] = texel.dx;
            texels[2][lane] = texel.dy;
        }
        texels
    }
}

/// Rounds numbers down to integers.
#[inline(always)]
pub(super) fn floor_lanes<const N: usize>(numbers: Lanes<N>) -> [i32; N] {
    let mut integers = [0; N];
    for (integer, number) in integers.iter_mut().zip(numbers.0) {
        *integer = floor_to_int(number);
    }
    integers
}
