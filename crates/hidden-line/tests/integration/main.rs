//! Line drawings of scenes whose lines can be computed by hand.
//!
//! All pictures are 800 × 800 pixels. In picture units of 100 pixels, the origin is in the middle
//! and y points up; X and Y in the comments are in these units.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests fail by panicking")]
#![allow(unreachable_pub, reason = "no other crate can use the modules of a test program")]

mod edges;
mod false_lines;
mod nearly_touching;
mod section_rounding;
mod sections;
mod smoothness;
mod solids;
mod stage;
mod work;
