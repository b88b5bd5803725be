//! The ground: how much of its light shadows take away.

use super::corners::{Items, blend};
use super::light::Light;
use super::normal::views;
use super::receiver::Receivers;
use super::seen::{Seen, dot, in_all, lane_of};
use super::{Draw, Shading};
use std::f32::consts::PI;

/// Straight up.
const UP: [f32; 3] = [0.0, 1.0, 0.0];

impl Shading<'_> {
    /// Black with the alpha that makes a white matt ground below it as dark as its shadows do: the share that they take of all the
    /// light that would fall on it, sums of the three channels.
    #[inline(always)]
    pub(super) fn ground<const N: usize>(
        &self,
        draw: &Draw<'_>,
        items: &Items<N>,
        seen: &impl Seen<N>,
    ) -> [[f32; N]; 4] {
        let places = blend(&draw.places(&draw.corners(items)), &seen.weights());
        let receivers = Receivers { places, normals: in_all(UP) };
        let (mut all, mut left) = ([0.0; N], [0.0; N]);
        let everywhere = self.ambient_lux();
        let mut open = [1.0; N];
        if let Some(occlusion) = self.occlusion {
            let views = views(&places, <[f64; 4]>::from(self.viewer).map(|c| c as f32));
            open = occlusion.open(&places, &receivers.normals, &views);
        }
        for lane in 0..N {
            (all[lane], left[lane]) = (everywhere, everywhere * open[lane]);
        }
        for (number, light) in self.lights.iter().enumerate() {
            let mut arriving = light.at(&places);
            let mut cosines = [0.0; N];
            for lane in 0..N {
                cosines[lane] = dot(UP, lane_of(&arriving.towards, lane)).max(0.0);
                let [r, g, b] = lane_of(&arriving.lux, lane);
                all[lane] += (r + g + b) * cosines[lane];
            }
            if let Some(Some(map)) = self.shadows.get(number) {
                arriving.shade(map, &receivers);
            }
            for lane in 0..N {
                let [r, g, b] = lane_of(&arriving.lux, lane);
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
    fn ambient_lux(&self) -> f32 {
        let mut lux = 0.0;
        for [r, g, b] in self.lights.iter().filter_map(Light::ambient) {
            lux += r + g + b;
        }
        if let Some(environment) = self.environment {
            let [[r], [g], [b]] = environment.scattered(&UP.map(|c| [c]));
            lux += PI * (r + g + b);
        }
        lux
    }
}
