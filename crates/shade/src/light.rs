//! Lights, resolved: in the world, in the units of photometry.

use super::fragment_lanes::{dot, lane_vector, splat};
use super::shadow_map::{Shadow, ShadowMap};
use super::shadow_receiver::ShadowReceiver;

/// A light of the resolved scene. Colours are linear and already multiplied by the light's strength.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Light {
    /// Parallel light from very far away.
    Sun {
        /// The unit direction towards the light.
        to_light: [f32; 3],
        /// The illuminance of a surface that faces it, in lux.
        lux: [f32; 3],
        /// Its shadows, if it casts any.
        shadow: Option<Shadow>,
    },
    /// Light from a point.
    Point {
        /// Where it is.
        position: [f32; 3],
        /// The luminous intensity in candela: lux at distance 1.
        candela: [f32; 3],
        /// The distance at which nothing arrives any more; infinite if the light goes on for ever.
        range: f32,
    },
    /// Light from a point into a cone.
    Spot {
        /// Where it is.
        position: [f32; 3],
        /// The unit direction of the cone's axis, away from the light.
        axis: [f32; 3],
        /// The luminous intensity along the axis in candela.
        candela: [f32; 3],
        /// As for a point.
        range: f32,
        /// The cosines of the angles from the axis up to which the light is full, and at which it ends.
        cosines: [f32; 2],
        /// Its shadows, if it casts any.
        shadow: Option<Shadow>,
    },
    /// The same light from everywhere. It scatters and makes no highlights.
    Ambient {
        /// The illuminance of every surface, in lux.
        lux: [f32; 3],
    },
}

/// Light that arrives at some fragments.
#[derive(Clone, Copy, Debug)]
pub(super) struct IncidentLight<const N: usize> {
    /// The unit vectors to where it comes from.
    pub(super) to_light: [[f32; N]; 3],
    /// The illuminance of surfaces that face it, in lux.
    pub(super) lux: [[f32; N]; 3],
}

impl Light {
    /// The illuminance that it gives every surface alike.
    pub(crate) const fn ambient_lux(&self) -> Option<[f32; 3]> {
        match self {
            Self::Ambient { lux } => Some(*lux),
            _ => None,
        }
    }

    /// The shadows that it casts.
    #[must_use]
    pub const fn shadow(&self) -> Option<Shadow> {
        match self {
            Self::Sun { shadow, .. } | Self::Spot { shadow, .. } => *shadow,
            Self::Point { .. } | Self::Ambient { .. } => None,
        }
    }

    /// What of a light with a direction arrives at places in the world.
    #[inline(always)]
    pub(super) fn incident_at<const N: usize>(&self, places: &[[f32; N]; 3]) -> IncidentLight<N> {
        match *self {
            Self::Sun { to_light: towards, lux, .. } => {
                IncidentLight { to_light: splat(towards), lux: splat(lux) }
            }
            Self::Point { position, candela, range } => {
                light_from_point(position, places, candela, range, |_| 1.0)
            }
            Self::Spot { position, axis, candela, range, cosines: [full, end], .. } => {
                // The share between the two angles is the square of a line over the cosine (KHR_lights_punctual).
                let per = 1.0 / (full - end).max(0.001);
                light_from_point(position, places, candela, range, |towards| {
                    let share = ((-dot(axis, towards) - end) * per).clamp(0.0, 1.0);
                    share * share
                })
            }
            Self::Ambient { .. } => {
                IncidentLight { to_light: splat([0.0; 3]), lux: splat([0.0; 3]) }
            }
        }
    }
}

impl<const N: usize> IncidentLight<N> {
    /// Takes away what does not arrive because something is in the way.
    #[inline(always)]
    pub(super) fn apply_shadow(&mut self, map: &ShadowMap, receivers: &ShadowReceiver<N>) {
        for lane in 0..N {
            let normal = lane_vector(&receivers.normals, lane);
            // From behind nothing arrives that a shadow could take away, but where slopes pretend otherwise.
            let faces = dot(normal, lane_vector(&self.to_light, lane)) > 0.0;
            let lit = if faces {
                map.visibility(lane_vector(&receivers.positions, lane), normal)
            } else {
                0.0
            };
            for channel in &mut self.lux {
                channel[lane] *= lit;
            }
        }
    }
}

/// What arrives from a point: less with the square of the distance, and nothing from the range on, to which it falls off smoothly
/// (KHR_lights_punctual). `share` is how much goes this way.
#[inline(always)]
fn light_from_point<const N: usize>(
    position: [f32; 3],
    places: &[[f32; N]; 3],
    candela: [f32; 3],
    range: f32,
    share: impl Fn([f32; 3]) -> f32,
) -> IncidentLight<N> {
    let mut arriving = IncidentLight { to_light: splat([0.0; 3]), lux: splat([0.0; 3]) };
    let per_range = 1.0 / range;
    for lane in 0..N {
        let place = lane_vector(places, lane);
        let way = [position[0] - place[0], position[1] - place[1], position[2] - place[2]];
        let square = dot(way, way);
        let per = if square > 0.0 { 1.0 / square.sqrt() } else { 0.0 };
        let towards = [way[0] * per, way[1] * per, way[2] * per];
        let reach = square * per_range * per_range;
        let window = (1.0 - reach * reach).clamp(0.0, 1.0);
        let strength = window * per * per * share(towards);
        for axis in 0..3 {
            arriving.to_light[axis][lane] = towards[axis];
            arriving.lux[axis][lane] = candela[axis] * strength;
        }
    }
    arriving
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(light: &Light, place: [f32; 3]) -> f32 {
        light.incident_at(&place.map(|c| [c])).lux[0][0]
    }

    #[test]
    fn points_weaken_with_the_square_of_the_distance_and_end_at_their_range() {
        let light =
            |range| Light::Point { position: [0.0, 2.0, 0.0], candela: [8.0, 0.0, 0.0], range };
        assert_eq!(at(&light(f32::INFINITY), [0.0; 3]), 2.0);
        assert_eq!(at(&light(f32::INFINITY), [0.0, 2.0, 4.0]), 0.5);
        // 1 − (d / range)⁴ times 1 / d².
        assert_eq!(at(&light(4.0), [0.0; 3]), 2.0 * (1.0 - 1.0 / 16.0));
        assert_eq!(at(&light(2.0), [0.0; 3]), 0.0);
        assert_eq!(at(&light(1.0), [0.0; 3]), 0.0);
        assert_eq!(at(&light(4.0), [0.0, 2.0, 0.0]), 0.0, "nothing is lit at the light itself");
    }

    #[test]
    fn spots_fall_off_between_their_two_angles() {
        let cosines = [0.8, 0.6];
        let (position, candela) = ([0.0; 3], [1.0; 3]);
        let axis = [0.0, 0.0, -1.0];
        let light =
            Light::Spot { position, axis, candela, range: f32::INFINITY, cosines, shadow: None };
        let along = |cosine: f32| at(&light, [(1.0 - cosine * cosine).sqrt(), 0.0, -cosine]);
        for (cosine, due) in [(1.0, 1.0), (0.8, 1.0), (0.7, 0.25), (0.6, 0.0), (-1.0, 0.0)] {
            assert!((along(cosine) - due).abs() < 1e-5, "{cosine}: {}", along(cosine));
        }
    }
}
