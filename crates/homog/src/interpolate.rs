//! Interpolation of vertex attributes (colors, texture coordinates, normals and so on) when a
//! triangle is clipped or filled.

use crate::{HPoint, Point, Space, Vector};
use glam::{DVec3, DVec4};

/// A value that can be blended with others of its type: a vertex attribute.
///
/// Numbers, points and vectors are attributes, and so are arrays and tuples of attributes. For a
/// struct, blend the fields:
///
/// ```
/// use homog::Interpolate;
///
/// #[derive(Clone, Copy)]
/// struct Vertex {
///     uv: [f32; 2],
///     color: [f32; 3],
/// }
///
/// impl Interpolate for Vertex {
///     fn weighted_sum<const N: usize>(values: [Self; N], weights: [f64; N]) -> Self {
///         Self {
///             uv: Interpolate::weighted_sum(values.map(|vertex| vertex.uv), weights),
///             color: Interpolate::weighted_sum(values.map(|vertex| vertex.color), weights),
///         }
///     }
/// }
///
/// let red = Vertex { uv: [0.0, 0.0], color: [1.0, 0.0, 0.0] };
/// let blue = Vertex { uv: [1.0, 0.5], color: [0.0, 0.0, 1.0] };
/// assert_eq!(red.lerp(blue, 0.5).uv, [0.5, 0.25]);
/// ```
pub trait Interpolate: Copy {
    /// Returns the weighted sum of the values. The weights add up to 1, or to 0 for derivatives.
    #[must_use]
    fn weighted_sum<const N: usize>(values: [Self; N], weights: [f64; N]) -> Self;

    /// Computes [`weighted_sum`](Self::weighted_sum) with single-precision weights, which
    /// rasterizers use. Single-precision values then need no conversion.
    #[must_use]
    #[inline(always)]
    fn weighted_sum_f32<const N: usize>(values: [Self; N], weights: [f32; N]) -> Self {
        Self::weighted_sum(values, weights.map(f64::from))
    }

    /// Returns the value at fraction `t` of the way to `end`: exactly this value at 0, and exactly
    /// `end` at 1.
    #[must_use]
    #[inline(always)]
    fn lerp(self, end: Self, t: f64) -> Self {
        Self::weighted_sum([self, end], [1.0 - t, t])
    }
}

impl Interpolate for f64 {
    #[inline(always)]
    fn weighted_sum<const N: usize>(values: [Self; N], weights: [f64; N]) -> Self {
        let mut sum = 0.0;
        for (value, weight) in values.into_iter().zip(weights) {
            sum += value * weight;
        }
        sum
    }
}

impl Interpolate for f32 {
    #[inline(always)]
    fn weighted_sum<const N: usize>(values: [Self; N], weights: [f64; N]) -> Self {
        let mut sum = 0.0;
        for (value, weight) in values.into_iter().zip(weights) {
            sum += value * weight as Self;
        }
        sum
    }

    #[inline(always)]
    fn weighted_sum_f32<const N: usize>(values: [Self; N], weights: [f32; N]) -> Self {
        let mut sum = 0.0;
        for (value, weight) in values.into_iter().zip(weights) {
            sum += value * weight;
        }
        sum
    }
}

impl<T: Interpolate, const M: usize> Interpolate for [T; M] {
    #[inline(always)]
    fn weighted_sum<const N: usize>(values: [Self; N], weights: [f64; N]) -> Self {
        core::array::from_fn(|i| T::weighted_sum(values.map(|value| value[i]), weights))
    }

    #[inline(always)]
    fn weighted_sum_f32<const N: usize>(values: [Self; N], weights: [f32; N]) -> Self {
        core::array::from_fn(|i| T::weighted_sum_f32(values.map(|value| value[i]), weights))
    }
}

/// The attributes of a vertex that has none.
impl Interpolate for () {
    #[inline(always)]
    fn weighted_sum<const N: usize>(_: [Self; N], _: [f64; N]) -> Self {}
}

macro_rules! interpolate_tuple {
    ($($name:ident $index:tt),+) => {
        impl<$($name: Interpolate),+> Interpolate for ($($name,)+) {
            #[inline(always)]
            fn weighted_sum<const N: usize>(values: [Self; N], weights: [f64; N]) -> Self {
                ($($name::weighted_sum(values.map(|value| value.$index), weights),)+)
            }

            #[inline(always)]
            fn weighted_sum_f32<const N: usize>(values: [Self; N], weights: [f32; N]) -> Self {
                ($($name::weighted_sum_f32(values.map(|value| value.$index), weights),)+)
            }
        }
    };
}
interpolate_tuple!(A 0, B 1);
interpolate_tuple!(A 0, B 1, C 2);
interpolate_tuple!(A 0, B 1, C 2, D 3);

macro_rules! interpolate_coordinates {
    ($name:ident, $zero:expr) => {
        impl<S: Space> Interpolate for $name<S> {
            #[inline(always)]
            fn weighted_sum<const N: usize>(values: [Self; N], weights: [f64; N]) -> Self {
                let mut sum = $zero;
                for (value, weight) in values.into_iter().zip(weights) {
                    sum += value.raw * weight;
                }
                Self::tagged(sum)
            }
        }
    };
}
interpolate_coordinates!(Point, DVec3::ZERO);
interpolate_coordinates!(Vector, DVec3::ZERO);
interpolate_coordinates!(HPoint, DVec4::ZERO);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::World;

    #[test]
    fn endpoints_are_exact_and_every_component_is_blended() {
        let (a, b) = ((0.1_f32, [0.3_f64, 7.0]), (0.7, [1e9, -2.0]));
        assert_eq!((a.lerp(b, 0.0), a.lerp(b, 1.0)), (a, b));
        let corners = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 8.0, 0.0]].map(Point::<World>::from);
        let center = Interpolate::weighted_sum(corners, [0.5, 0.25, 0.25]);
        assert_eq!(center, Point::new(1.0, 2.0, 0.0));
    }
}
