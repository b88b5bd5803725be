//! Depth functions: which depth replaces which.
//!
//! Depth is 1 at the near and 0 at the far plane, so that the usual function is "greater". The
//! functions of the other direction negate every depth on its way in and out, which costs no bit,
//! so that the rasterizer itself knows one direction only.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, mask32x8};

/// The depth function of a frame, as Vulkan's `VkCompareOp` and WebGPU's `depthCompare` name them:
/// a fragment passes if its depth compares so with the one that is there, and replaces it.
///
/// Drawing is fastest with `Greater`, which every scene with depth 1 at the near plane wants. With
/// the others hidden surfaces are found sample by sample.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[non_exhaustive]
pub enum DepthCompare {
    /// Nearer fragments pass. At equal depth the primitive that was added first stays.
    #[default]
    Greater,
    /// As `Greater`, but at equal depth the primitive that was added last stays: decals.
    GreaterEqual,
    /// Farther fragments pass: the backs of things, or depth that runs from 0 at the near plane.
    Less,
    /// As `Less`, with the last primitive at equal depth.
    LessEqual,
    /// Fragments at the very depth that is there pass: a second pass over a
    /// [depth buffer](crate::Frame::with_depth_buffer) of the same primitives.
    Equal,
    /// All fragments pass, so that primitives cover each other in the order of their submission
    /// (the painter's algorithm).
    Always,
}

impl DepthCompare {
    /// Whether depths are negated.
    pub(crate) const fn negates(self) -> bool {
        matches!(self, Self::Less | Self::LessEqual)
    }

    /// A depth as the rasterizer has it, and back.
    #[inline(always)]
    pub(crate) fn to_internal(self, depth: f32) -> f32 {
        if self.negates() { -depth } else { depth }
    }

    /// Whether hidden surfaces are found the fast way: strictly greater wins.
    pub(crate) const fn is_strict(self) -> bool {
        matches!(self, Self::Greater | Self::Less)
    }

    /// Which of eight depths, negated where that is due, pass against those that are there.
    #[inline(always)]
    pub(crate) fn passes<S: Simd>(self, depth: f32x8<S>, there: f32x8<S>) -> mask32x8<S> {
        match self {
            Self::Greater | Self::Less => depth.simd_gt(there),
            Self::GreaterEqual | Self::LessEqual => depth.simd_ge(there),
            Self::Equal => depth.simd_eq(there),
            // Depths are finite.
            Self::Always => depth.simd_eq(depth),
        }
    }
}
