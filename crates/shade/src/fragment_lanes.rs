//! What shading asks of fragments, of one as of eight: it is written once, for any number of lanes.
//!
//! Everything on this way is a plain loop over the lanes and is made part of the function that calls it, which is compiled
//! for the processor's vector instructions. The bits do not depend on the number of lanes.

use raster::{F32x8, Fragment, Fragments, LANES};

/// Some fragments that are shaded at once.
pub(super) trait FragmentLanes<const N: usize> {
    /// The corners' shares at the fragments.
    fn weights(&self) -> [[f32; N]; 3];
    /// Their derivatives by the pixel's column.
    fn weights_dx(&self) -> [[f32; N]; 3];
    /// Their derivatives by the pixel's row, downwards.
    fn weights_dy(&self) -> [[f32; N]; 3];
}

impl FragmentLanes<1> for Fragment<'_> {
    fn weights(&self) -> [[f32; 1]; 3] {
        self.weights.map(|weight| [weight])
    }

    fn weights_dx(&self) -> [[f32; 1]; 3] {
        self.weights_dx().map(|weight| [weight])
    }

    fn weights_dy(&self) -> [[f32; 1]; 3] {
        self.weights_dy().map(|weight| [weight])
    }
}

/// Eight fragments with their weights. Textures and normals alike ask for the derivatives, which are worked out once.
#[derive(Debug)]
pub(super) struct FragmentPacket {
    weights: [F32x8; 3],
    dx: [F32x8; 3],
    dy: [F32x8; 3],
}

impl FragmentPacket {
    #[inline(always)]
    pub(super) fn new(fragments: &Fragments<'_>) -> Self {
        let weights = fragments.weights();
        Self { weights: weights.values, dx: weights.dx(), dy: weights.dy() }
    }
}

impl FragmentLanes<LANES> for FragmentPacket {
    #[inline(always)]
    fn weights(&self) -> [F32x8; 3] {
        self.weights
    }

    #[inline(always)]
    fn weights_dx(&self) -> [F32x8; 3] {
        self.dx
    }

    #[inline(always)]
    fn weights_dy(&self) -> [F32x8; 3] {
        self.dy
    }
}

/// The same numbers in all lanes.
#[inline(always)]
pub(super) fn splat<const N: usize, const K: usize>(values: [f32; K]) -> [[f32; N]; K] {
    let mut lanes = [[0.0; N]; K];
    for k in 0..K {
        lanes[k] = [values[k]; N];
    }
    lanes
}

/// Multiplies each of the first channels by a factor of its own.
#[inline(always)]
pub(super) fn scale_channels<const N: usize>(channels: &mut [[f32; N]], factors: &[[f32; N]]) {
    for (channel, factor) in channels.iter_mut().zip(factors) {
        for lane in 0..N {
            channel[lane] *= factor[lane];
        }
    }
}

#[inline(always)]
pub(super) fn dot_lanes<const N: usize>(a: &[[f32; N]; 3], b: &[[f32; N]; 3]) -> [f32; N] {
    let mut dots = [0.0; N];
    for lane in 0..N {
        dots[lane] = a[0][lane] * b[0][lane] + a[1][lane] * b[1][lane] + a[2][lane] * b[2][lane];
    }
    dots
}

/// The vector of one lane.
#[inline(always)]
pub(super) fn lane_vector<const N: usize>(vectors: &[[f32; N]; 3], lane: usize) -> [f32; 3] {
    [vectors[0][lane], vectors[1][lane], vectors[2][lane]]
}

#[inline(always)]
pub(super) fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(super) fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
