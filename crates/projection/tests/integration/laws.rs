//! The laws of projections, checked on random parameters, and parity with other builders.
// Test names say what they check.
#![allow(missing_docs)]

mod builders;
mod classical;
mod decomposition;
mod depth;
mod exercises;
mod extremes;
mod intrinsics;
mod parity;
mod samples;
mod vanishing;
mod window;
