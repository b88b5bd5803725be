//! Lanes: values of `N` fragments side by side, with the operators of a single value (structure of
//! arrays).
//!
//! ```text
//!             lane   0    1    2    3    4    5    6    7
//!  Lanes<8>        [ x    x    x    x    x    x    x    x ]     one number per fragment
//!  Vec3Lanes<8>    [ x … ] [ y … ] [ z … ]                      one vector per fragment
//!  Rgb<8>          [ r … ] [ g … ] [ b … ]                      one linear color per fragment
//! ```
//!
//! A BRDF term therefore reads like its formula. Schlick's Fresnel, for all fragments and channels:
//!
//! ```text
//!  let schlick = pow5(1.0 - v_dot_h);                      // Lanes<N>
//!  let fresnel = f0.map(|f0| f0.lerp(f90, schlick));       // Rgb<N>
//! ```
//!
//! Shading is written once for any `N`: one lane for the scalar path and eight for the rasterizer's
//! packets. Each operator is a loop of constant length over the lanes. It is inlined into a kernel
//! compiled for the processor's vector instructions, where it becomes one instruction. LLVM and
//! browsers compile large functions slowly, so a kernel is split into parts
//! ([`kernel_part`](crate::kernel_part)), and into more parts for WebAssembly and debug builds.
//!
//! The inner `[f32; N]` is the rasterizer's `F32x8`, so conversions are free. Loops use array
//! iterators instead of indices, which avoids bounds checks.
//!
//! The bits of a lane depend neither on `N` nor on the instruction set. Every operator rounds like
//! its scalar counterpart, nothing is fused or reassociated, and [`Lanes::lerp`] is `a + (b − a)·t`
//! in this order. When a formula is rewritten, the order of its operations must not change, or the
//! goldens will.

use std::ops::{Add, AddAssign, Div, Index, IndexMut, Mul, MulAssign, Neg, Sub};

/// The lanes for which a condition holds. Both alternatives are computed, and the mask selects one.
pub(crate) type Mask<const N: usize> = [bool; N];

/// One `f32` for each of `N` fragments.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Lanes<const N: usize>(pub(crate) [f32; N]);

impl<const N: usize> Lanes<N> {
    pub(crate) const ZERO: Self = Self([0.0; N]);
    pub(crate) const ONE: Self = Self([1.0; N]);

    /// Returns one number in all lanes.
    #[inline(always)]
    pub(crate) const fn splat(value: f32) -> Self {
        Self([value; N])
    }

    /// Creates the lanes from a function of their index, for table lookups and `libm` functions,
    /// which have no vector counterpart.
    #[inline(always)]
    pub(crate) fn from_fn(mut lane: impl FnMut(usize) -> f32) -> Self {
        let mut lanes = [0.0; N];
        for (index, value) in lanes.iter_mut().enumerate() {
            *value = lane(index);
        }
        Self(lanes)
    }

    /// Applies a function to each lane separately.
    #[inline(always)]
    pub(crate) fn map(mut self, function: impl Fn(f32) -> f32) -> Self {
        for value in &mut self.0 {
            *value = function(*value);
        }
        self
    }

    /// Applies a function that costs more than a branch to each lane. It is evaluated only once if
    /// all lanes are equal, as they are without a texture.
    #[inline(always)]
    pub(crate) fn map_expensive(self, function: impl Fn(f32) -> f32) -> Self {
        if self.0.iter().all(|lane| *lane == self.0[0]) {
            return Self::splat(function(self.0[0]));
        }
        self.map(function)
    }

    /// Computes the square roots, which are NaN for numbers below 0.
    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        self.map(f32::sqrt)
    }

    /// Returns the magnitudes.
    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        self.map(f32::abs)
    }

    /// Returns the smaller of each lane and a bound. NaN becomes the bound.
    #[inline(always)]
    pub(crate) fn min(self, bound: f32) -> Self {
        self.map(|value| value.min(bound))
    }

    /// Returns the larger of each lane and a bound. NaN becomes the bound.
    #[inline(always)]
    pub(crate) fn max(self, bound: f32) -> Self {
        self.map(|value| value.max(bound))
    }

    /// Returns the smaller of two values, lane by lane.
    #[inline(always)]
    pub(crate) fn min_lanes(mut self, other: Self) -> Self {
        for (value, other) in self.0.iter_mut().zip(&other.0) {
            *value = value.min(*other);
        }
        self
    }

    /// Returns the larger of two values, lane by lane.
    #[inline(always)]
    pub(crate) fn max_lanes(mut self, other: Self) -> Self {
        for (value, other) in self.0.iter_mut().zip(&other.0) {
            *value = value.max(*other);
        }
        self
    }

    /// Clamps each lane between two bounds. NaN stays NaN.
    #[inline(always)]
    pub(crate) fn clamp(self, least: f32, most: f32) -> Self {
        self.map(|value| value.clamp(least, most))
    }

    /// Interpolates linearly, `a + (b − a)·t`: the result is `self` at 0 and, up to rounding, `to`
    /// at 1.
    ///
    /// The alternative `a·(1 − t) + b·t` is exact at both ends but needs one more multiplication.
    #[inline(always)]
    pub(crate) fn lerp(self, to: Self, t: Self) -> Self {
        self + (to - self) * t
    }

    /// Returns the lanes that are below a bound.
    #[inline(always)]
    pub(crate) fn is_below(&self, bound: f32) -> Mask<N> {
        let mut mask = [false; N];
        for (is_below, value) in mask.iter_mut().zip(&self.0) {
            *is_below = *value < bound;
        }
        mask
    }

    /// Returns the lanes that are above a bound.
    #[inline(always)]
    pub(crate) fn is_above(&self, bound: f32) -> Mask<N> {
        let mut mask = [false; N];
        for (is_above, value) in mask.iter_mut().zip(&self.0) {
            *is_above = *value > bound;
        }
        mask
    }

    /// Returns `self` where the mask is set, and `otherwise` elsewhere.
    #[inline(always)]
    pub(crate) fn select(self, mask: &Mask<N>, otherwise: Self) -> Self {
        let mut lanes = otherwise;
        for ((lane, value), is_set) in lanes.0.iter_mut().zip(&self.0).zip(mask) {
            *lane = if *is_set { *value } else { *lane };
        }
        lanes
    }
}

impl<const N: usize> Index<usize> for Lanes<N> {
    type Output = f32;

    #[inline(always)]
    fn index(&self, lane: usize) -> &f32 {
        &self.0[lane]
    }
}

impl<const N: usize> IndexMut<usize> for Lanes<N> {
    #[inline(always)]
    fn index_mut(&mut self, lane: usize) -> &mut f32 {
        &mut self.0[lane]
    }
}

/// Implements an operator between lanes, and between lanes and a single number on either side.
macro_rules! lane_operator {
    ($Operator:ident, $operate:ident, $symbol:tt) => {
        impl<const N: usize> $Operator for Lanes<N> {
            type Output = Self;

            #[inline(always)]
            fn $operate(self, right: Self) -> Self {
                let mut lanes = [0.0; N];
                for ((lane, left), right) in lanes.iter_mut().zip(&self.0).zip(&right.0) {
                    *lane = *left $symbol *right;
                }
                Self(lanes)
            }
        }

        impl<const N: usize> $Operator<f32> for Lanes<N> {
            type Output = Self;

            #[inline(always)]
            fn $operate(self, right: f32) -> Self {
                let mut lanes = [0.0; N];
                for (lane, left) in lanes.iter_mut().zip(&self.0) {
                    *lane = *left $symbol right;
                }
                Self(lanes)
            }
        }

        impl<const N: usize> $Operator<Lanes<N>> for f32 {
            type Output = Lanes<N>;

            #[inline(always)]
            fn $operate(self, right: Lanes<N>) -> Lanes<N> {
                let mut lanes = [0.0; N];
                for (lane, right) in lanes.iter_mut().zip(&right.0) {
                    *lane = self $symbol *right;
                }
                Lanes(lanes)
            }
        }
    };
}

lane_operator!(Add, add, +);
lane_operator!(Sub, sub, -);
lane_operator!(Mul, mul, *);
lane_operator!(Div, div, /);

impl<const N: usize> Neg for Lanes<N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|value| -value)
    }
}

impl<const N: usize> AddAssign for Lanes<N> {
    #[inline(always)]
    fn add_assign(&mut self, right: Self) {
        *self = *self + right;
    }
}

impl<const N: usize, Right> MulAssign<Right> for Lanes<N>
where
    Self: Mul<Right, Output = Self>,
{
    #[inline(always)]
    fn mul_assign(&mut self, right: Right) {
        *self = *self * right;
    }
}

/// Maps the items of an array to lanes.
///
/// In kernels this replaces the `map` of arrays, which is sometimes too large to be inlined. It
/// would then be compiled without the kernel's vector instructions.
#[inline(always)]
pub(crate) fn map_to_lanes<T: Copy, const N: usize, const K: usize>(
    items: &[T; K],
    function: impl Fn(T) -> Lanes<N>,
) -> [Lanes<N>; K] {
    let mut lanes = [Lanes::ZERO; K];
    for (lanes, item) in lanes.iter_mut().zip(items) {
        *lanes = function(*item);
    }
    lanes
}

/// Declares a type with three numbers for each of `N` fragments, and the componentwise operations
/// that vectors and colors share.
macro_rules! three_components {
    ($(#[$doc:meta])* $Name:ident { $a:ident, $b:ident, $c:ident }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Debug)]
        pub(crate) struct $Name<const N: usize> {
            pub(crate) $a: Lanes<N>,
            pub(crate) $b: Lanes<N>,
            pub(crate) $c: Lanes<N>,
        }

        impl<const N: usize> $Name<N> {
            pub(crate) const ZERO: Self =
                Self { $a: Lanes::ZERO, $b: Lanes::ZERO, $c: Lanes::ZERO };

            /// Returns the same three numbers in all lanes.
            #[inline(always)]
            pub(crate) const fn splat([$a, $b, $c]: [f32; 3]) -> Self {
                Self { $a: Lanes::splat($a), $b: Lanes::splat($b), $c: Lanes::splat($c) }
            }

            /// Creates the components from a function that is called once per lane.
            #[inline(always)]
            pub(crate) fn from_fn(mut lane: impl FnMut(usize) -> [f32; 3]) -> Self {
                let mut lanes = Self::ZERO;
                for index in 0..N {
                    [lanes.$a[index], lanes.$b[index], lanes.$c[index]] = lane(index);
                }
                lanes
            }

            /// Returns the three components of one lane.
            #[inline(always)]
            pub(crate) fn lane(&self, lane: usize) -> [f32; 3] {
                [self.$a[lane], self.$b[lane], self.$c[lane]]
            }

            /// Applies a function to each component.
            #[inline(always)]
            pub(crate) fn map(self, function: impl Fn(Lanes<N>) -> Lanes<N>) -> Self {
                // A loop calls the function in a single place, where it is inlined.
                let mut components = [self.$a, self.$b, self.$c];
                for component in &mut components {
                    *component = function(*component);
                }
                Self::from(components)
            }

            /// Applies a function to each pair of components.
            #[inline(always)]
            pub(crate) fn zip(
                self,
                other: Self,
                function: impl Fn(Lanes<N>, Lanes<N>) -> Lanes<N>,
            ) -> Self {
                let mut components = [self.$a, self.$b, self.$c];
                let others = [other.$a, other.$b, other.$c];
                for (component, other) in components.iter_mut().zip(&others) {
                    *component = function(*component, *other);
                }
                Self::from(components)
            }
        }

        impl<const N: usize> From<[Lanes<N>; 3]> for $Name<N> {
            #[inline(always)]
            fn from([$a, $b, $c]: [Lanes<N>; 3]) -> Self {
                Self { $a, $b, $c }
            }
        }

        impl<const N: usize> Add for $Name<N> {
            type Output = Self;

            #[inline(always)]
            fn add(self, right: Self) -> Self {
                self.zip(right, Lanes::add)
            }
        }

        impl<const N: usize> AddAssign for $Name<N> {
            #[inline(always)]
            fn add_assign(&mut self, right: Self) {
                *self = *self + right;
            }
        }

        impl<const N: usize> Sub for $Name<N> {
            type Output = Self;

            #[inline(always)]
            fn sub(self, right: Self) -> Self {
                self.zip(right, Lanes::sub)
            }
        }

        impl<const N: usize> Neg for $Name<N> {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                self.map(Lanes::neg)
            }
        }

        impl<const N: usize> Mul<Lanes<N>> for $Name<N> {
            type Output = Self;

            #[inline(always)]
            fn mul(self, factor: Lanes<N>) -> Self {
                self.map(|value| value * factor)
            }
        }

        impl<const N: usize> Mul<f32> for $Name<N> {
            type Output = Self;

            #[inline(always)]
            fn mul(self, factor: f32) -> Self {
                self.map(|value| value * factor)
            }
        }
    };
}

three_components! {
    /// A position or vector in the world in each lane.
    Vec3Lanes { x, y, z }
}

three_components! {
    /// A linear color in each lane: light, or the fraction of light that a surface reflects.
    Rgb { r, g, b }
}

impl<const N: usize> Vec3Lanes<N> {
    /// Computes the dot products, lane by lane.
    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> Lanes<N> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Computes the cross products, lane by lane.
    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// Returns `self` in the lanes where the mask is set, and `otherwise` elsewhere.
    #[inline(always)]
    pub(crate) fn select(self, mask: &Mask<N>, otherwise: Self) -> Self {
        self.zip(otherwise, |value, otherwise| value.select(mask, otherwise))
    }
}

impl<const N: usize> Rgb<N> {
    /// A value of 1 in all channels and lanes.
    pub(crate) const WHITE: Self = Self { r: Lanes::ONE, g: Lanes::ONE, b: Lanes::ONE };

    /// Returns the largest channel of each lane.
    #[inline(always)]
    pub(crate) fn max_channel(self) -> Lanes<N> {
        self.r.max_lanes(self.g).max_lanes(self.b)
    }
}

/// Multiplies channel by channel: a reflectance times light, or times another reflectance.
impl<const N: usize> Mul for Rgb<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, right: Self) -> Self {
        self.zip(right, Lanes::mul)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [f32; 4] = [0.1, -3.0, 7.7, f32::NAN];
    const B: [f32; 4] = [0.7, 0.3, -1e-3, 2.0];

    /// Returns the bits of lanes for comparison, because NaN is not equal to itself.
    fn bits(lanes: Lanes<4>) -> [u32; 4] {
        lanes.0.map(f32::to_bits)
    }

    #[test]
    fn operators_match_scalar_operators_bit_for_bit() {
        let (a, b) = (Lanes(A), Lanes(B));
        let scalar =
            |operate: fn(f32, f32) -> f32| Lanes::from_fn(|lane| operate(A[lane], B[lane]));
        assert_eq!(bits(a + b), bits(scalar(|a, b| a + b)));
        assert_eq!(bits(a - b), bits(scalar(|a, b| a - b)));
        assert_eq!(bits(a * b), bits(scalar(|a, b| a * b)));
        assert_eq!(bits(a / b), bits(scalar(|a, b| a / b)));
        assert_eq!(bits(a.lerp(b, b)), bits(scalar(|a, b| a + (b - a) * b)));
        assert_eq!(bits(2.0 - a * 3.0), bits(scalar(|a, _| 2.0 - a * 3.0)));
        assert_eq!(bits(a.max_lanes(b)), bits(scalar(f32::max)));
        assert_eq!(bits(a.min_lanes(b)), bits(scalar(f32::min)));
    }

    #[test]
    fn masks_select_lanes_and_nan_is_neither_below_nor_above() {
        let (a, b) = (Lanes(A), Lanes(B));
        assert_eq!(a.is_below(0.0), [false, true, false, false]);
        assert_eq!(a.is_above(0.0), [true, false, true, false]);
        assert_eq!(b.select(&a.is_below(0.0), Lanes::ONE), Lanes([1.0, 0.3, 1.0, 1.0]));
    }

    #[test]
    fn vector_products_match_single_vectors() {
        let (a, b) = ([1.0, -2.0, 0.5], [0.3, 4.0, -1.0]);
        let (left, right) = (Vec3Lanes::<2>::splat(a), Vec3Lanes::splat(b));
        assert_eq!(left.dot(right), Lanes([crate::vector::dot(a, b); 2]));
        assert_eq!(left.cross(right).lane(1), crate::vector::cross(a, b));
    }
}
