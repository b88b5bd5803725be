//! Numbers of scene files: each type admits what makes sense and names the rest.
//!
//! RON itself accepts `NaN`, `inf` and `1e400`; none of these types does.

use core::fmt;
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};

macro_rules! checked_number {
    ($(#[$doc:meta])* $name:ident, $expected:literal, $allowed:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Debug)]
        pub struct $name(f64);

        impl $name {
            /// The number itself.
            #[must_use]
            pub const fn value(self) -> f64 {
                self.0
            }

            /// The number as one of this kind; `None` if it is none.
            #[must_use]
            pub fn new(value: f64) -> Option<Self> {
                let allowed: fn(f64) -> bool = $allowed;
                (value.is_finite() && allowed(value)).then_some(Self(value))
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let value = f64::deserialize(deserializer)?;
                Self::new(value).ok_or_else(|| {
                    D::Error::custom(format_args!("expected {}, found {value}", $expected))
                })
            }
        }
    };
}

checked_number! {
    /// Any number that is neither infinite nor NaN.
    Finite, "a finite number", |_| true
}
checked_number! {
    /// A number greater than 0.
    Positive, "a number greater than 0", |x| x > 0.0
}
checked_number! {
    /// 0 or a number greater than 0.
    NonNegative, "0 or a greater number", |x| x >= 0.0
}
checked_number! {
    /// An opening angle in degrees, between 0 and 180, both excluded.
    FieldOfView, "an angle between 0 and 180 degrees", |x| x > 0.0 && x < 180.0
}

checked_number! {
    /// A part of a whole in per cent, from 0 to 100.
    Percent, "a number from 0 to 100", |x| (0.0..=100.0).contains(&x)
}
checked_number! {
    /// A part of a whole, from 0 to 1.
    Share, "a number from 0 to 1", |x| (0.0..=1.0).contains(&x)
}
checked_number! {
    /// How large a light looks, in degrees across, from 0 to 30.
    Softness, "an angle from 0 to 30 degrees", |x| (0.0..=30.0).contains(&x)
}

checked_number! {
    /// An angle between two faces in degrees, from 0 to 180.
    Crease, "an angle from 0 to 180 degrees", |x| (0.0..=180.0).contains(&x)
}

checked_number! {
    /// The distance between lines of hatching in millimetres, from 0.1 to 1000.
    Spacing, "a distance from 0.1 to 1000 millimetres", |x| (0.1..=1000.0).contains(&x)
}

impl Spacing {
    /// 2 millimetres.
    pub const USUAL: Self = Self(2.0);
}

impl Share {
    /// A half.
    pub const HALF: Self = Self(0.5);
}

impl Percent {
    /// Nothing.
    pub const ZERO: Self = Self(0.0);
    /// Eighty.
    pub const EIGHTY: Self = Self(80.0);
}

impl Crease {
    /// 30 degrees: a cylinder of twelve sides is still round.
    pub const USUAL: Self = Self(30.0);
}

impl Positive {
    /// A number that is known to be greater than 0.
    pub(super) const fn known(value: f64) -> Self {
        debug_assert!(value > 0.0, "a positive number is greater than 0");
        Self(value)
    }
}

impl Default for Finite {
    fn default() -> Self {
        Self(0.0)
    }
}

impl Finite {
    /// A number that is known to be finite.
    pub(super) const fn known(value: f64) -> Self {
        debug_assert!(value.is_finite(), "a finite number is finite");
        Self(value)
    }
}

impl NonNegative {
    /// 1.
    pub const ONE: Self = Self(1.0);

    /// 0.6, the studio's strength for bare models.
    pub const SIX_TENTHS: Self = Self(0.6);

    /// 5, the usual margin in per cent.
    pub const FIVE: Self = Self(5.0);
}

impl FieldOfView {
    /// 35 degrees: about what a picture covers that is held at arm's length and a half.
    pub const USUAL: Self = Self(35.0);
}

impl Default for FieldOfView {
    fn default() -> Self {
        Self::USUAL
    }
}

/// Three finite numbers: a point, a vector, angles or a colour. Written `(1, 2, 3)` or `[1, 2, 3]`.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Triple(pub [f64; 3]);

impl Triple {
    pub(super) fn y_axis() -> Self {
        Self([0.0, 1.0, 0.0])
    }

    pub(super) fn ones() -> Self {
        Self([1.0; 3])
    }
}

impl<'de> Deserialize<'de> for Triple {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TripleVisitor).map(Self)
    }
}

struct TripleVisitor;

impl<'de> Visitor<'de> for TripleVisitor {
    type Value = [f64; 3];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("three numbers, such as (1, 2, 3)")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<[f64; 3], A::Error> {
        let mut numbers = [0.0; 3];
        let mut found = 0;
        while let Some(number) = seq.next_element::<Finite>()? {
            if let Some(place) = numbers.get_mut(found) {
                *place = number.value();
            }
            found += 1;
        }
        if found == 3 {
            return Ok(numbers);
        }
        Err(A::Error::custom(format_args!("expected three numbers, found {found}")))
    }
}

/// A factor for each axis. Written as one number or as three.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Scale(pub [f64; 3]);

impl Default for Scale {
    fn default() -> Self {
        Self([1.0; 3])
    }
}

impl<'de> Deserialize<'de> for Scale {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let factors = deserializer.deserialize_any(ScaleVisitor)?;
        if factors.iter().all(|f| f.is_finite() && *f != 0.0) {
            return Ok(Self(factors));
        }
        Err(D::Error::custom("expected finite factors other than 0"))
    }
}

struct ScaleVisitor;

impl<'de> Visitor<'de> for ScaleVisitor {
    type Value = [f64; 3];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("one factor, such as 2, or three, such as (1, 2, 1)")
    }

    fn visit_f64<E: Error>(self, factor: f64) -> Result<[f64; 3], E> {
        Ok([factor; 3])
    }

    fn visit_f32<E: Error>(self, factor: f32) -> Result<[f64; 3], E> {
        Ok([f64::from(factor); 3])
    }

    fn visit_u64<E: Error>(self, factor: u64) -> Result<[f64; 3], E> {
        Ok([factor as f64; 3])
    }

    fn visit_i64<E: Error>(self, factor: i64) -> Result<[f64; 3], E> {
        Ok([factor as f64; 3])
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<[f64; 3], A::Error> {
        TripleVisitor.visit_seq(seq)
    }
}
