//! Tests of the public interface of `camera`, linked as one program.

mod extrinsics;
mod framing;
mod look;
mod rigs;
