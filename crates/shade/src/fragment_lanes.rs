//! Fragment lanes: the barycentric weights of one or eight fragments that are shaded together.
//!
//! Shading is generic over the number of lanes and needs only the weights of a fragment's vertices
//! and their screen-space derivatives. The derivatives (`dFdx` and `dFdy` in GLSL) are exact: they
//! come from the triangle's plane equations, not from differences between neighboring fragments.

use super::lanes::{Lanes, map_to_lanes};
use raster::{Fragment, Fragments, LANES};

/// The vertex weights of the primitives of `N` fragments.
///
/// This is implemented for single fragments, packets of eight, and the vertex fragments of shading
/// styles. Weights and derivatives always refer to the whole triangle, even if it was clipped.
pub(super) trait FragmentLanes<const N: usize> {
    /// Returns the perspective-correct barycentric weights of the three vertices.
    fn weights(&self) -> [Lanes<N>; 3];
    /// Returns the derivatives of the weights with respect to the pixel's column.
    fn weights_dx(&self) -> [Lanes<N>; 3];
    /// Returns the derivatives of the weights with respect to the pixel's row, downward.
    fn weights_dy(&self) -> [Lanes<N>; 3];
}

impl FragmentLanes<1> for Fragment<'_> {
    fn weights(&self) -> [Lanes<1>; 3] {
        self.weights.map(Lanes::splat)
    }

    fn weights_dx(&self) -> [Lanes<1>; 3] {
        self.weights_dx().map(Lanes::splat)
    }

    fn weights_dy(&self) -> [Lanes<1>; 3] {
        self.weights_dy().map(Lanes::splat)
    }
}

/// Eight fragments with their weights. The derivatives are computed once, because both textures and
/// normals need them.
#[derive(Debug)]
pub(super) struct FragmentPacket {
    /// Perspective-correct barycentric weights.
    weights: [Lanes<LANES>; 3],
    /// Derivatives of the weights with respect to the pixel's column.
    weights_dx: [Lanes<LANES>; 3],
    /// Derivatives of the weights with respect to the pixel's row.
    weights_dy: [Lanes<LANES>; 3],
}

impl FragmentPacket {
    /// Computes the weights of eight fragments from the rasterizer.
    #[inline(always)]
    pub(super) fn new(fragments: &Fragments<'_>) -> Self {
        // One set of barycentrics, even for clipped triangles, with derivatives by the quotient
        // rule.
        let weights = fragments.weights();
        Self {
            weights: map_to_lanes(&weights.values, Lanes),
            weights_dx: map_to_lanes(&weights.dx(), Lanes),
            weights_dy: map_to_lanes(&weights.dy(), Lanes),
        }
    }
}

impl FragmentLanes<LANES> for FragmentPacket {
    #[inline(always)]
    fn weights(&self) -> [Lanes<LANES>; 3] {
        self.weights
    }

    #[inline(always)]
    fn weights_dx(&self) -> [Lanes<LANES>; 3] {
        self.weights_dx
    }

    #[inline(always)]
    fn weights_dy(&self) -> [Lanes<LANES>; 3] {
        self.weights_dy
    }
}
