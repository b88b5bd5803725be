//! The laws of projections, checked on random parameters, and parity with other builders.
// Test names say what they check.
#![allow(missing_docs)]

mod builders;
mod decomposition;
mod doctor;
mod parity;
mod samples;
