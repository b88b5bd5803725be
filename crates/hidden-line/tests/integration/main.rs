//! Line drawings of scenes with lines that can be computed by hand.
//!
//! All are drawn on 800 × 800 pixels, with 100 pixels per unit of the picture, the origin in the
//! middle and y up; X and Y below are in those units.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests fail by panics")]
#![allow(unreachable_pub, reason = "the modules of a program have no other outside")]

mod edges;
mod nearly_touching;
mod sections;
mod smoothness;
mod solids;
mod stage;
mod work;
