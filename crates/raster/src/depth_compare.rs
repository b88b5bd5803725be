//! Depth functions: the conditions under which one depth replaces another.
//!
//! Depth is 1 at the near plane and 0 at the far plane, so the usual function is "greater".
//! Functions in the other direction negate every depth on input and output, which is exact, so the
//! rasterizer itself handles only one direction.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, mask32x8};

/// The depth function of a frame, named as in Vulkan's `VkCompareOp` and WebGPU's `depthCompare`. A
/// fragment passes and replaces the stored depth if the comparison of its depth with the stored
/// depth is true.
///
/// Drawing is fastest with `Greater`, the right choice for every scene with depth 1 at the near
/// plane. The other functions resolve hidden surfaces sample by sample.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[non_exhaustive]
pub enum DepthCompare {
    /// Nearer fragments pass. At equal depth, the primitive added first wins.
    #[default]
    Greater,
    /// Like `Greater`, but at equal depth, the primitive added last wins. Use it for decals.
    GreaterEqual,
    /// Farther fragments pass. Use it for back faces, or if depth is 0 at the near plane.
    Less,
    /// Like `Less`, but at equal depth, the primitive added last wins.
    LessEqual,
    /// Fragments at exactly the stored depth pass. Use it for a second pass over a [depth
    /// buffer](crate::Frame::with_depth_buffer) of the same primitives.
    Equal,
    /// All fragments pass, so primitives cover each other in submission order (the painter's
    /// algorithm).
    Always,
}

impl DepthCompare {
    /// Returns whether depths are negated.
    pub(crate) const fn negates(self) -> bool {
        matches!(self, Self::Less | Self::LessEqual)
    }

    /// Converts a depth to or from the rasterizer's direction.
    #[inline(always)]
    pub(crate) fn to_internal(self, depth: f32) -> f32 {
        if self.negates() { -depth } else { depth }
    }

    /// Returns whether hidden surfaces can be resolved on the fast path, where a strictly greater
    /// depth wins.
    pub(crate) const fn is_strict(self) -> bool {
        matches!(self, Self::Greater | Self::Less)
    }

    /// Compares eight depths, negated if necessary, with the stored depths.
    #[inline(always)]
    pub(crate) fn passes<S: Simd>(self, depth: f32x8<S>, there: f32x8<S>) -> mask32x8<S> {
        match self {
            Self::Greater | Self::Less => depth.simd_gt(there),
            Self::GreaterEqual | Self::LessEqual => depth.simd_ge(there),
            Self::Equal => depth.simd_eq(there),
            // Always true, because depths are never NaN.
            Self::Always => depth.simd_eq(depth),
        }
    }
}
