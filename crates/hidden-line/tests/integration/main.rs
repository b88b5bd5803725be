//! Line drawings of scenes with lines that can be computed by hand.
//!
//! All pictures have 800 × 800 pixels. In picture units of 100 pixels, the origin is in the middle
//! and y points up; X and Y in the comments are in these units.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests fail by panics")]
#![allow(unreachable_pub, reason = "the modules of a program have no other outside")]

mod edges;
mod nearly_touching;
mod sections;
mod smoothness;
mod solids;
mod stage;
mod work;
