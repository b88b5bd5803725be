//! Tests of the public interface of `drawing`, linked once.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests fail by panics")]
#![allow(unreachable_pub, reason = "the modules of a program have no other outside")]

mod fills;
#[allow(dead_code, reason = "the other tests of hidden lines need the rest")]
#[path = "../../../hidden-line/tests/integration/stage.rs"]
mod stage;
mod styles;
