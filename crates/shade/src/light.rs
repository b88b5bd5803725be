//! Punctual lights in world space, with photometric units (KHR_lights_punctual).
//!
//! ```text
//!   Sun    E = lux                                            parallel light
//!   Point  E = candela · window(d / range) / d²               inverse-square falloff
//!   Spot   E = Point · (angle attenuation)²                   between the cosines of two angles
//!   Legacy E = lux · cosⁿ / (k₀ + k₁ d + k₂ d²)               spot light of OpenGL 1, and of MuJoCo
//! ```

use super::lanes::{Lanes, Rgb, Vec3Lanes};
use super::light_shadow::LightShadow;
use super::shadow_map::Shadow;
use super::shadow_receiver::ShadowReceiver;

/// A light in the resolved scene. Colors are linear and already multiplied by the light's strength.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Light {
    /// A directional light: parallel light from infinity.
    Sun {
        /// The unit direction toward the light.
        to_light: [f32; 3],
        /// The illuminance of a surface that faces the light, in lux.
        lux: [f32; 3],
        /// Its shadow settings, if it casts shadows.
        shadow: Option<Shadow>,
    },
    /// Light from a point, equal in all directions.
    Point {
        /// The position in the world.
        position: [f32; 3],
        /// The luminous intensity in candela: lux at distance 1.
        candela: [f32; 3],
        /// The distance beyond which no light arrives; infinite for a light without a limit.
        range: f32,
        /// Its shadow settings, if it casts shadows.
        shadow: Option<Shadow>,
    },
    /// Light from a point into a cone.
    Spot {
        /// The position in the world.
        position: [f32; 3],
        /// The unit direction of the cone's axis, away from the light.
        axis: [f32; 3],
        /// The luminous intensity along the axis in candela.
        candela: [f32; 3],
        /// The distance beyond which no light arrives; infinite for a light without a limit.
        range: f32,
        /// The cosines of the inner cone angle, within which the light has full strength, and of
        /// the outer cone angle, at which it ends.
        cosines: [f32; 2],
        /// Its shadow settings, if it casts shadows.
        shadow: Option<Shadow>,
    },
    /// A spot light of OpenGL's fixed pipeline, for scenes of programs that use it. Scene files and
    /// models do not have such lights.
    Legacy {
        /// The position in the world.
        position: [f32; 3],
        /// The unit direction of the cone's axis, away from the light.
        axis: [f32; 3],
        /// The illuminance along the axis where the falloff is 1.
        lux: [f32; 3],
        /// The coefficients of 1, d and d² in the polynomial that divides the illuminance.
        falloff: [f32; 3],
        /// The power of the cosine of the angle from the axis.
        exponent: f32,
        /// The cosine of the angle at which the light ends; −1 for light in all directions.
        cutoff: f32,
        /// Its shadow settings, if it casts shadows.
        shadow: Option<Shadow>,
    },
    /// Ambient light: uniform from all directions, and reflected diffusely, without highlights.
    Ambient {
        /// The illuminance of every surface, in lux.
        lux: [f32; 3],
    },
}

/// The light from one source at `N` fragments.
///
/// The BRDF needs only this direction and illuminance, not the light's kind or position. Shadows
/// reduce the illuminance, and so does sheen for the layers below.
///
/// `lux` does not include the cosine of Lambert's law, because each layer has different normals.
#[derive(Clone, Copy, Debug)]
pub(super) struct IncidentLight<const N: usize> {
    /// The unit vectors toward the light.
    pub(super) to_light: Vec3Lanes<N>,
    /// The illuminance of surfaces that face the light, in lux.
    pub(super) lux: Rgb<N>,
}

impl Light {
    /// Returns the illuminance of every surface if this is an ambient light.
    pub(crate) const fn ambient_lux(&self) -> Option<[f32; 3]> {
        match self {
            Self::Ambient { lux } => Some(*lux),
            _ => None,
        }
    }

    /// Returns the shadow settings of the light, if it casts shadows.
    #[must_use]
    pub const fn shadow(&self) -> Option<Shadow> {
        match self {
            Self::Sun { shadow, .. }
            | Self::Point { shadow, .. }
            | Self::Spot { shadow, .. }
            | Self::Legacy { shadow, .. } => *shadow,
            Self::Ambient { .. } => None,
        }
    }

    /// Computes the light that arrives at positions in the world, ignoring shadows. Returns zeros
    /// for ambient light, which has no direction.
    #[cfg_attr(not(any(target_family = "wasm", debug_assertions)), inline(always))]
    #[cfg_attr(any(target_family = "wasm", debug_assertions), inline(never))]
    pub(super) fn incident_at<const N: usize>(&self, positions: Vec3Lanes<N>) -> IncidentLight<N> {
        match *self {
            Self::Sun { to_light, lux, .. } => {
                IncidentLight { to_light: Vec3Lanes::splat(to_light), lux: Rgb::splat(lux) }
            }
            Self::Point { position, candela, range, .. } => {
                light_from_point(position, positions, candela, range, |_| Lanes::ONE)
            }
            Self::Spot { position, axis, candela, range, cosines: [inner, outer], .. } => {
                // Angular attenuation is the square of a linear ramp over the cosine.
                let slope = 1.0 / (inner - outer).max(0.001);
                light_from_point(position, positions, candela, range, |to_light| {
                    let cosine = -Vec3Lanes::splat(axis).dot(to_light);
                    let ramp = ((cosine - outer) * slope).clamp(0.0, 1.0);
                    ramp * ramp
                })
            }
            Self::Legacy { .. } => self.legacy_light(positions),
            Self::Ambient { .. } => IncidentLight { to_light: Vec3Lanes::ZERO, lux: Rgb::ZERO },
        }
    }

    /// Computes the light of a `Legacy` light. This function is separate because such lights are
    /// rare.
    #[inline(never)]
    fn legacy_light<const N: usize>(&self, positions: Vec3Lanes<N>) -> IncidentLight<N> {
        let Self::Legacy { position, axis, lux, falloff, exponent, cutoff, .. } = *self else {
            return IncidentLight { to_light: Vec3Lanes::ZERO, lux: Rgb::ZERO };
        };
        let to_light = Vec3Lanes::splat(position) - positions;
        let square = to_light.dot(to_light);
        let distance = square.map(f32::sqrt);
        // At the light itself there is no direction, and thus no light.
        let inverse = distance.map(|distance| if distance > 0.0 { 1.0 / distance } else { 0.0 });
        let to_light = to_light * inverse;
        let [constant, linear, quadratic] = falloff;
        let divisor = square * quadratic + distance * linear + constant;
        let strength = divisor.map(|divisor| if divisor > 0.0 { 1.0 / divisor } else { 0.0 });
        let cosine = -Vec3Lanes::splat(axis).dot(to_light);
        let angular = cosine.map(|cosine| match cosine >= cutoff {
            true if exponent == 0.0 => 1.0,
            true => power(cosine.max(0.0), exponent),
            false => 0.0,
        });
        IncidentLight { to_light, lux: Rgb::splat(lux) * (strength * angular) }
    }
}

/// Returns a power, by multiplication if the exponent is a small whole number.
fn power(base: f32, exponent: f32) -> f32 {
    if exponent != exponent.trunc() || !(0.0..=128.0).contains(&exponent) {
        return libm::powf(base, exponent);
    }
    let (mut result, mut square, mut rest) = (1.0, base, exponent as u32);
    while rest > 0 {
        if rest % 2 == 1 {
            result *= square;
        }
        square *= square;
        rest /= 2;
    }
    result
}

impl<const N: usize> IncidentLight<N> {
    /// Multiplies the illuminance by the light's visibility according to its shadow maps.
    #[inline(always)]
    pub(super) fn apply_shadow(&mut self, shadow: &LightShadow, receiver: &ShadowReceiver<N>) {
        // Light from behind does not arrive, even where a normal map suggests it, so no lookup is
        // needed.
        let is_facing = receiver.normals.dot(self.to_light).is_above(0.0);
        let visibility = shadow.visibility(receiver, is_facing);
        self.lux = self.lux * visibility;
    }
}

/// Computes the light from a point: inverse-square falloff with a smooth window up to the range, 1
/// − (d / range)⁴ (KHR_lights_punctual). `attenuation` returns the fraction of the intensity
/// emitted in a direction.
#[inline(always)]
fn light_from_point<const N: usize>(
    position: [f32; 3],
    positions: Vec3Lanes<N>,
    candela: [f32; 3],
    range: f32,
    attenuation: impl Fn(Vec3Lanes<N>) -> Lanes<N>,
) -> IncidentLight<N> {
    // This is 0 for a light of infinite range, so its window is 1 everywhere.
    let inv_range = 1.0 / range;
    let to_light = Vec3Lanes::splat(position) - positions;
    let square = to_light.dot(to_light);
    // At the light itself there is no direction, and thus no light.
    let inv_distance = square.map(|square| if square > 0.0 { 1.0 / square.sqrt() } else { 0.0 });
    let to_light = to_light * inv_distance;
    // The windowing function of the range, then the inverse-square law.
    let relative = square * inv_range * inv_range;
    let window = (1.0 - relative * relative).clamp(0.0, 1.0);
    // E = I · window / d², times the angular attenuation of the spot light.
    let strength = window * inv_distance * inv_distance * attenuation(to_light);
    IncidentLight { to_light, lux: Rgb::splat(candela) * strength }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lux_at(light: &Light, position: [f32; 3]) -> f32 {
        light.incident_at(Vec3Lanes::<1>::splat(position)).lux.r[0]
    }

    #[test]
    fn point_lights_follow_the_inverse_square_law_up_to_their_range() {
        let (position, candela) = ([0.0, 2.0, 0.0], [8.0, 0.0, 0.0]);
        let light = |range| Light::Point { position, candela, range, shadow: None };
        assert_eq!(lux_at(&light(f32::INFINITY), [0.0; 3]), 2.0);
        assert_eq!(lux_at(&light(f32::INFINITY), [0.0, 2.0, 4.0]), 0.5);
        // 1 − (d / range)⁴ times 1 / d².
        assert_eq!(lux_at(&light(4.0), [0.0; 3]), 2.0 * (1.0 - 1.0 / 16.0));
        assert_eq!(lux_at(&light(2.0), [0.0; 3]), 0.0);
        assert_eq!(lux_at(&light(1.0), [0.0; 3]), 0.0);
        assert_eq!(lux_at(&light(4.0), [0.0, 2.0, 0.0]), 0.0, "at the light itself");
    }

    #[test]
    fn legacy_lights_follow_the_polynomial_and_the_power_of_the_cosine() {
        let (position, axis) = ([0.0, 2.0, 0.0], [0.0, -1.0, 0.0]);
        let light = |falloff, exponent| {
            let (lux, cutoff) = ([8.0, 0.0, 0.0], 0.5);
            Light::Legacy { position, axis, lux, falloff, exponent, cutoff, shadow: None }
        };
        assert_eq!(lux_at(&light([1.0, 0.0, 0.0], 10.0), [0.0; 3]), 8.0);
        assert_eq!(lux_at(&light([1.0, 0.5, 0.5], 10.0), [0.0; 3]), 2.0);
        // At a cosine of 0.8, inside the cutoff, and then outside.
        let beside = lux_at(&light([1.0, 0.0, 0.0], 10.0), [1.5, 0.0, 0.0]);
        assert!((beside - 8.0 * 0.107_374_18).abs() < 1e-5, "{beside}");
        let odd = lux_at(&light([1.0, 0.0, 0.0], 2.5), [1.5, 0.0, 0.0]);
        assert!((odd - 8.0 * 0.572_433_4).abs() < 1e-5, "{odd}");
        assert_eq!(lux_at(&light([1.0, 0.0, 0.0], 0.0), [1.5, 0.0, 0.0]), 8.0);
        assert_eq!(lux_at(&light([1.0, 0.0, 0.0], 0.0), [4.0, 0.0, 0.0]), 0.0);
    }

    #[test]
    fn spot_lights_fall_off_between_their_two_angles() {
        let cosines = [0.8, 0.6];
        let (position, candela) = ([0.0; 3], [1.0; 3]);
        let axis = [0.0, 0.0, -1.0];
        let light =
            Light::Spot { position, axis, candela, range: f32::INFINITY, cosines, shadow: None };
        let along = |cosine: f32| lux_at(&light, [(1.0 - cosine * cosine).sqrt(), 0.0, -cosine]);
        for (cosine, expected) in [(1.0, 1.0), (0.8, 1.0), (0.7, 0.25), (0.6, 0.0), (-1.0, 0.0)] {
            let actual = along(cosine);
            assert!((actual - expected).abs() < 1e-5, "{cosine}: {actual}");
        }
    }
}
