//! Prefiltered radiance: the mip levels of an environment for increasing roughness.
//!
//! This is the first sum of the split-sum approximation (Karis 2013). For each direction r, used as
//! both normal and view:
//!
//! ```text
//!  L(r) = Σ radiance(lᵢ) · (r·lᵢ) / Σ (r·lᵢ)        lᵢ = r reflected about half vectors hᵢ,
//!                                                   importance sampled from GGX
//! ```
//!
//! A few samples are enough, because each reads the environment from a mip level whose texels are
//! as large as the solid angle of the sample (filtered importance sampling: Křivánek and Colbert
//! 2008).

use super::octahedral_map::{BilinearNodes, OctahedralMap, encode_octahedral};
use crate::lanes::{Lanes, Vec3Lanes};
use crate::vector::{cross, normalize};
use raster::{Kernel, SimdLevel};
use std::f32::consts::PI;
use std::sync::OnceLock;

/// The number of prefiltered levels, for roughness 0, 0.2, …, 1.
pub(super) const LEVEL_COUNT: usize = 6;
/// Number of nodes per side of each level except the first, which is the environment itself. In the
/// sharpest of these levels, the distance between nodes is half the width of the level's lobe.
const LEVEL_SIDES: [usize; LEVEL_COUNT - 1] = [65, 65, 33, 33, 17];
/// Number of mip levels that samples are read from.
const MIP_COUNT: usize = 7;
/// Number of samples per texel of a level.
const SAMPLE_COUNT: u32 = 64;

/// The prefiltered levels of an environment, from sharp to blurred.
///
/// Each level is computed when a surface first needs it, because most models have few distinct
/// roughness values, and the sharpest of the blurred levels takes longer than all the others.
#[derive(Clone, Debug)]
pub(super) struct PrefilteredLevels {
    /// The mip chain of the environment, with sides halved from level to level.
    mip_chain: Vec<OctahedralMap>,
    /// The levels from 1 on, each computed on demand by the first thread that needs it.
    filtered: [OnceLock<OctahedralMap>; LEVEL_COUNT - 1],
}

/// Compares only the environments, because equal environments have equal levels.
impl PartialEq for PrefilteredLevels {
    fn eq(&self, other: &Self) -> bool {
        self.mip_chain == other.mip_chain
    }
}

impl PrefilteredLevels {
    /// Creates the levels of an environment. Only the first is computed immediately.
    pub(super) fn new(environment: OctahedralMap) -> Self {
        let mut mip_chain = vec![environment];
        while mip_chain.len() < MIP_COUNT {
            mip_chain.push(mip_chain[mip_chain.len() - 1].downsample());
        }
        Self { mip_chain, filtered: Default::default() }
    }

    /// Returns a level by index, starting at 0 for mirrors, and computes it on the first request.
    #[inline(always)]
    pub(super) fn level(&self, index: usize) -> &OctahedralMap {
        match index.checked_sub(1) {
            Some(filtered) => self.filtered[filtered].get_or_init(|| self.prefilter_level(index)),
            None => &self.mip_chain[0],
        }
    }

    /// Computes a level other than 0.
    #[cold]
    fn prefilter_level(&self, index: usize) -> OctahedralMap {
        let roughness = index as f32 / (LEVEL_COUNT - 1) as f32;
        let (mip_chain, simd_level) = (&self.mip_chain, SimdLevel::best());
        // α = roughness². All texels of the level share one set of samples.
        let samples = importance_sample_ggx(roughness * roughness, mip_chain);
        let color = |normal| {
            simd_level.run_kernel(PrefilterKernel { mip_chain, normal, samples: &samples })
        };
        OctahedralMap::from_function(LEVEL_SIDES[index - 1], color)
    }
}

/// The number of samples to read at once.
const SAMPLE_LANES: usize = 8;

/// Light directions around the normal, which is z, and the mip level of the environment to read for
/// each.
struct SamplePacket {
    /// The number of lanes in use.
    count: usize,
    directions: Vec3Lanes<SAMPLE_LANES>,
    /// The mip level of each sample.
    levels: [usize; SAMPLE_LANES],
    /// The index of the last column and row of each of these levels.
    last_nodes: Lanes<SAMPLE_LANES>,
}

impl SamplePacket {
    /// Creates up to eight directions, each with the nearest mip level in a chain; interpolation is
    /// not needed, because the samples of a lobe blend the levels anyway.
    fn new(samples: &[([f32; 3], f32)], mip_chain: &[OctahedralMap]) -> Self {
        let mut levels = [0; SAMPLE_LANES];
        for (lane, (_, level)) in samples.iter().enumerate() {
            levels[lane] = ((level + 0.5) as usize).min(mip_chain.len() - 1);
        }
        let last_nodes = Lanes::from_fn(|lane| (mip_chain[levels[lane]].side - 1) as f32);
        let direction = |lane: usize| samples.get(lane).map_or([0.0; 3], |sample| sample.0);
        let directions = Vec3Lanes::from_fn(direction);
        Self { count: samples.len(), directions, levels, last_nodes }
    }
}

/// Returns the directions in which a surface with this α reflects a view along its normal, with
/// their mip levels.
///
/// The level is half the base-2 logarithm of the ratio between the solid angles of the sample and a
/// texel, plus one. The added one reduces noise; the lost sharpness would not be visible at this
/// roughness.
///
/// The sample set is computed once per level, in the frame of the normal. With n = v = r the lobe
/// has no preferred azimuth, but highlights are not stretched at grazing angles.
fn importance_sample_ggx(alpha: f32, mip_chain: &[OctahedralMap]) -> Vec<SamplePacket> {
    let alpha_squared = alpha * alpha;
    let texel_solid_angle = 4.0 * PI / (mip_chain[0].side * mip_chain[0].side) as f32;
    let sample = |n: u32| {
        // Hammersley points: even steps and the radical inverse in base 2.
        let u = (n as f32 + 0.5) / SAMPLE_COUNT as f32;
        let azimuth = (n.reverse_bits() >> 8) as f32 / (1 << 24) as f32 * 2.0 * PI;
        // A half vector distributed as D · n·h (Walter et al. 2007).
        let n_dot_h = ((1.0 - u) / (1.0 + (alpha_squared - 1.0) * u)).sqrt();
        let sine = (1.0 - n_dot_h * n_dot_h).max(0.0).sqrt();
        let h = [sine * libm::cosf(azimuth), sine * libm::sinf(azimuth), n_dot_h];
        let direction = [2.0 * n_dot_h * h[0], 2.0 * n_dot_h * h[1], 2.0 * n_dot_h * n_dot_h - 1.0];
        // The density of directions is the half vector density D n·h, divided by four times v·h =
        // n·h.
        let width = n_dot_h * n_dot_h * (alpha_squared - 1.0) + 1.0;
        let density = alpha_squared / (PI * width * width) / 4.0;
        let solid_angle = 1.0 / (SAMPLE_COUNT as f32 * density.max(1e-9));
        let level = (0.5 * libm::log2f(solid_angle / texel_solid_angle) + 1.0).max(0.0);
        (direction, level)
    };
    let samples: Vec<_> = (0..SAMPLE_COUNT).map(sample).filter(|([_, _, z], _)| *z > 0.0).collect();
    samples.chunks(SAMPLE_LANES).map(|packet| SamplePacket::new(packet, mip_chain)).collect()
}

/// The kernel that computes one texel of a level: the light around a normal.
struct PrefilterKernel<'a> {
    mip_chain: &'a [OctahedralMap],
    normal: [f32; 3],
    samples: &'a [SamplePacket],
}

impl Kernel for PrefilterKernel<'_> {
    type Output = [f32; 3];

    #[inline(always)]
    fn run(self) -> [f32; 3] {
        let Self { mip_chain, normal, samples } = self;
        // Any frame around the normal will do, because the samples have no preferred azimuth.
        let aside = if normal[1].abs() < 0.9 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
        let tangent = normalize(cross(aside, normal));
        let bitangent = cross(normal, tangent);
        let [t, b, n] =
            [Vec3Lanes::splat(tangent), Vec3Lanes::splat(bitangent), Vec3Lanes::splat(normal)];
        let (mut sum, mut weight_sum) = ([0.0; 4], 0.0);
        for packet in samples {
            let Vec3Lanes { x, y, z } = packet.directions;
            let directions = t * x + b * y + n * z;
            let n_dot_l = directions.dot(n).max(0.0);
            let nodes = BilinearNodes::locate(encode_octahedral(directions), packet.last_nodes);
            for lane in 0..packet.count {
                let texel = mip_chain[packet.levels[lane]].sample_bilinear(&nodes, lane);
                let weight = n_dot_l[lane];
                for (sum, channel) in sum.iter_mut().zip(texel) {
                    *sum += channel * weight;
                }
                weight_sum += weight;
            }
        }
        [0, 1, 2].map(|k: usize| sum[k] / weight_sum)
    }
}
