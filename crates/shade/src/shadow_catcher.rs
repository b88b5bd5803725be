//! The shadow catcher: a ground plane that is transparent except for the shadows on it and the
//! occlusion of light from all directions.
//!
//! ```text
//!   alpha = 1 − E with shadows / E without        E: illuminance of the ground, all lights summed
//! ```
//!
//! Composited over a picture of white ground, black with this alpha makes the ground as dark as the
//! shadows would. Colored lights are summed over their channels, so shadows have no color.

use super::attributes::PrimitiveIndices;
use super::fragment_lanes::FragmentLanes;
use super::lanes::{Lanes, Rgb, Vec3Lanes};
use super::light::Light;
use super::shadow_receiver::ShadowReceiver;
use super::{Draw, Shading};
use std::f32::consts::PI;

/// The normal of the ground.
const UP: [f32; 3] = [0.0, 1.0, 0.0];

impl Shading<'_> {
    /// Returns black with the alpha that makes white matte ground below it as dark as the shadows
    /// would.
    #[inline(always)]
    pub(super) fn shade_shadow_catcher<const N: usize>(
        &self,
        draw: &Draw<'_>,
        primitives: &PrimitiveIndices<N>,
        fragments: &impl FragmentLanes<N>,
    ) -> [Lanes<N>; 4] {
        let vertices = draw.vertex_indices(primitives);
        let positions = draw.interpolate_positions(&vertices, fragments);
        let normals = Vec3Lanes::splat(UP);
        let receiver = ShadowReceiver { positions, normals };
        let mut visibility = Lanes::ONE;
        if let Some(occlusion) = self.occlusion {
            visibility = occlusion.visibility(positions, normals);
        }
        // Both kinds of occlusion detect nearby objects, so use the minimum instead of the product.
        if let Some(occlusion) = self.ground_occlusion {
            let contact = Lanes::from_fn(|lane| occlusion.visibility_at(positions.lane(lane)));
            visibility = visibility.min_lanes(contact);
        }
        // The illuminance with and without shadows, summed over the three channels. Occlusion
        // affects only light from all directions.
        let mut unshadowed = Lanes::splat(self.total_ambient_lux());
        let mut shadowed = unshadowed * visibility;
        for (index, light) in self.lights.iter().enumerate() {
            let mut incident = light.incident_at(positions);
            let n_dot_l = normals.dot(incident.to_light).max(0.0);
            unshadowed += channel_sum(incident.lux) * n_dot_l;
            // The percentage-closer filtered visibility of the light.
            if let Some(Some(shadow)) = self.shadows.get(index) {
                incident.apply_shadow(shadow, &receiver);
            }
            shadowed += channel_sum(incident.lux) * n_dot_l;
        }
        // Without any light, this is NaN, and alpha becomes 0.
        let alpha = (1.0 - shadowed / unshadowed)
            .map(|alpha| if alpha > 0.0 { alpha.min(1.0) } else { 0.0 });
        [Lanes::ZERO, Lanes::ZERO, Lanes::ZERO, alpha]
    }

    /// Computes the illuminance of the ground from ambient lights and the environment, summed over
    /// the channels.
    fn total_ambient_lux(&self) -> f32 {
        let mut lux = 0.0;
        for [r, g, b] in self.lights.iter().filter_map(Light::ambient_lux) {
            lux += r + g + b;
        }
        if let Some(environment) = self.environment {
            let [r, g, b] = environment.irradiance_over_pi(Vec3Lanes::<1>::splat(UP)).lane(0);
            lux += PI * (r + g + b);
        }
        lux
    }
}

/// Returns the sum of red, green and blue.
#[inline(always)]
fn channel_sum<const N: usize>(color: Rgb<N>) -> Lanes<N> {
    color.r + color.g + color.b
}
