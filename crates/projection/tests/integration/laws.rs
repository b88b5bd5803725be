//! The laws of projections, tested with random parameters, and parity with other builders.
// Test names state what they check.
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
