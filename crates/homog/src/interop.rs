//! Conversions to and from the types of other libraries, one feature per library.
//!
//! Arrays need no feature: `Point::from([x, y, z])`, `<[f64; 3]>::from(point)`, `point.to_f32()`,
//! [`Projective::from_column_major`](crate::Projective::from_column_major). They work with every
//! version of every library, because all libraries convert to and from arrays.

#[cfg(feature = "glam")]
mod glam;
#[cfg(feature = "mint")]
mod mint;
#[cfg(feature = "nalgebra")]
mod nalgebra;
#[cfg(feature = "serde")]
mod serde;
