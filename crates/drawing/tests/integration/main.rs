//! Tests of the public interface of `drawing`, linked once.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests fail by panicking")]
#![allow(unreachable_pub, reason = "modules of a test program have no outside users")]

mod fills;
#[allow(dead_code, reason = "the hidden-line tests use the rest")]
#[path = "../../../hidden-line/tests/integration/stage.rs"]
mod stage;
mod styles;
