//! Conversions to and from the types of other libraries, one feature per library.
//!
//! Arrays need no feature; examples are `Point::from([x, y, z])`, `<[f64; 3]>::from(point)` and
//! [`Projective::from_column_major`](crate::Projective::from_column_major). They connect any
//! versions of libraries that convert to and from arrays.

#[cfg(feature = "glam")]
mod glam;
#[cfg(feature = "mint")]
mod mint;
#[cfg(feature = "nalgebra")]
mod nalgebra;
#[cfg(feature = "serde")]
mod serde;
