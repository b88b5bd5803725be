//! The ground: how much of its light shadows take away.

use super::attributes::{PrimitiveIndices, interpolate};
use super::fragment_lanes::{FragmentLanes, dot, lane_vector, splat};
use super::light::Light;
use super::shadow_receiver::ShadowReceiver;
use super::surface_geometry::view_directions;
use super::{Draw, Shading};
use std::f32::consts::PI;

/// Straight up.
const UP: [f32; 3] = [0.0, 1.0, 0.0];

impl Shading<'_> {
    /// Black with the alpha that makes a white matt ground below it as dark as its shadows do: the share that they take of all the
    /// light that would fall on it, sums of the three channels.
    #[inline(always)]
    pub(super) fn shade_shadow_catcher<const N: usize>(
        &self,
        draw: &Draw<'_>,
        items: &PrimitiveIndices<N>,
        seen: &impl FragmentLanes<N>,
    ) -> [[f32; N]; 4] {
        let places =
            interpolate(&draw.vertex_positions(&draw.vertex_indices(items)), &seen.weights());
        let receivers = ShadowReceiver { positions: places, normals: splat(UP) };
        let (mut all, mut left) = ([0.0; N], [0.0; N]);
        let everywhere = self.total_ambient_lux();
        let mut open = [1.0; N];
        if let Some(occlusion) = self.occlusion {
            let views = view_directions(&places, <[f64; 4]>::from(self.viewer).map(|c| c as f32));
            open = occlusion.visibility(&places, &receivers.normals, &views);
        }
        for lane in 0..N {
            (all[lane], left[lane]) = (everywhere, everywhere * open[lane]);
        }
        for (number, light) in self.lights.iter().enumerate() {
            let mut arriving = light.incident_at(&places);
            let mut cosines = [0.0; N];
            for lane in 0..N {
                cosines[lane] = dot(UP, lane_vector(&arriving.to_light, lane)).max(0.0);
                let [r, g, b] = lane_vector(&arriving.lux, lane);
                all[lane] += (r + g + b) * cosines[lane];
            }
            if let Some(Some(map)) = self.shadows.get(number) {
                arriving.apply_shadow(map, &receivers);
            }
            for lane in 0..N {
                let [r, g, b] = lane_vector(&arriving.lux, lane);
                left[lane] += (r + g + b) * cosines[lane];
            }
        }
        let mut alpha = [0.0; N];
        for lane in 0..N {
            let share = 1.0 - left[lane] / all[lane];
            // Without any light there is no shadow either.
            alpha[lane] = if share > 0.0 { share.min(1.0) } else { 0.0 };
        }
        [[0.0; N], [0.0; N], [0.0; N], alpha]
    }

    /// The illuminance from all around, by light and environment.
    fn total_ambient_lux(&self) -> f32 {
        let mut lux = 0.0;
        for [r, g, b] in self.lights.iter().filter_map(Light::ambient_lux) {
            lux += r + g + b;
        }
        if let Some(environment) = self.environment {
            let [[r], [g], [b]] = environment.irradiance_over_pi(&UP.map(|c| [c]));
            lux += PI * (r + g + b);
        }
        lux
    }
}
