//! Tests of the public interface of `camera`, linked once.

mod extrinsics;
mod framing;
mod look;
mod rigs;
