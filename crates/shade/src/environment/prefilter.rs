//! The chain of an environment: what surfaces of growing roughness mirror of it.
//!
//! For each direction, taken for normal and view alike, the light that half vectors spread as GGX spreads them mirror, weighted
//! by the cosine (Karis 2013). Few half vectors do, for each reads the surroundings as blurred as the gap to the next is wide
//! (Křivánek and Colbert 2008).

use super::octahedral_map::{OctahedralMap, normalize, sample_trilinear};
use crate::fragment_lanes::{cross, dot};
use raster::{Kernel, SimdLevel};
use std::f32::consts::PI;
use std::sync::OnceLock;

/// How many pictures there are: of roughness 0, 0.2 and so on to 1.
pub(super) const LEVEL_COUNT: usize = 6;
/// Nodes along the sides of the blurred ones.
const LEVEL_SIDES: [usize; LEVEL_COUNT - 1] = [129, 65, 33, 33, 17];
/// How many half vectors.
const SAMPLE_COUNT: u32 = 64;

/// The pictures, from sharp to blurred.
///
/// Each is made when a surface asks for it first: most models are of few roughnesses, and the sharpest of the blurred ones takes
/// longer than all the others.
#[derive(Clone, Debug)]
pub(super) struct PrefilteredLevels {
    /// The surroundings, with all sides halved from one to the next.
    mip_chain: Vec<OctahedralMap>,
    filtered: [OnceLock<OctahedralMap>; LEVEL_COUNT - 1],
}

/// The same surroundings have the same pictures, made or not.
impl PartialEq for PrefilteredLevels {
    fn eq(&self, other: &Self) -> bool {
        self.mip_chain == other.mip_chain
    }
}

impl PrefilteredLevels {
    pub(super) fn new(sharp: OctahedralMap) -> Self {
        let mut mip_chain = vec![sharp];
        while mip_chain.len() < 7 {
            mip_chain.push(mip_chain[mip_chain.len() - 1].downsample());
        }
        Self { mip_chain, filtered: Default::default() }
    }

    /// The picture with a number, from 0 for mirrors on.
    #[inline(always)]
    pub(super) fn level(&self, number: usize) -> &OctahedralMap {
        match number.checked_sub(1) {
            Some(behind) => self.filtered[behind].get_or_init(|| self.prefilter_level(number)),
            None => &self.mip_chain[0],
        }
    }

    #[cold]
    fn prefilter_level(&self, number: usize) -> OctahedralMap {
        let roughness = number as f32 / (LEVEL_COUNT - 1) as f32;
        let (chain, instructions) = (&self.mip_chain, SimdLevel::best());
        let ways = importance_sample_ggx(roughness * roughness, chain);
        let color =
            |normal| instructions.run_kernel(PrefilterKernel { chain, normal, samples: &ways });
        OctahedralMap::from_function(LEVEL_SIDES[number - 1], color)
    }
}

/// How many directions are read at once.
const SAMPLE_LANES: usize = 8;

/// Directions around the normal, which is z, and between which pictures of the chain they read the surroundings.
struct SamplePacket {
    count: usize,
    directions: [[f32; SAMPLE_LANES]; 3],
    near_levels: [usize; SAMPLE_LANES],
    level_fractions: [f32; SAMPLE_LANES],
}

impl SamplePacket {
    /// Some directions, each with how blurred it reads a chain whose last picture has a number.
    fn new(some: &[([f32; 3], f32)], last: usize) -> Self {
        let (near, share) = ([0; SAMPLE_LANES], [0.0; SAMPLE_LANES]);
        let mut ways = Self {
            count: some.len(),
            directions: [[0.0; SAMPLE_LANES]; 3],
            near_levels: near,
            level_fractions: share,
        };
        for (lane, (direction, level)) in some.iter().enumerate() {
            let place = level.min(last as f32);
            ways.near_levels[lane] = (place as usize).min(last - 1);
            ways.level_fractions[lane] = place - ways.near_levels[lane] as f32;
            for axis in 0..3 {
                ways.directions[axis][lane] = direction[axis];
            }
        }
        ways
    }
}

/// Directions in which a surface of this α mirrors somebody who looks straight at it.
fn importance_sample_ggx(alpha: f32, chain: &[OctahedralMap]) -> Vec<SamplePacket> {
    let square = alpha * alpha;
    let texel = 4.0 * PI / (chain[0].side * chain[0].side) as f32;
    let way = |n: u32| {
        // The points of Hammersley: even steps, and their numbers with the bits reversed.
        let u = (n as f32 + 0.5) / SAMPLE_COUNT as f32;
        let turn = (n.reverse_bits() >> 8) as f32 / (1 << 24) as f32 * 2.0 * PI;
        let nh = ((1.0 - u) / (1.0 + (square - 1.0) * u)).sqrt();
        let flat = (1.0 - nh * nh).max(0.0).sqrt();
        let h = [flat * libm::cosf(turn), flat * libm::sinf(turn), nh];
        let direction = [2.0 * nh * h[0], 2.0 * nh * h[1], 2.0 * nh * nh - 1.0];
        let width = nh * nh * (square - 1.0) + 1.0;
        // The density of directions: that of half vectors, D n·h, over four times v·h.
        let density = square / (PI * width * width) / 4.0;
        let gap = 1.0 / (SAMPLE_COUNT as f32 * density.max(1e-9));
        (direction, (0.5 * libm::log2f(gap / texel) + 1.0).max(0.0))
    };
    let all: Vec<_> = (0..SAMPLE_COUNT).map(way).filter(|([_, _, z], _)| *z > 0.0).collect();
    all.chunks(SAMPLE_LANES).map(|some| SamplePacket::new(some, chain.len() - 1)).collect()
}

/// The light around a normal.
struct PrefilterKernel<'a> {
    chain: &'a [OctahedralMap],
    normal: [f32; 3],
    samples: &'a [SamplePacket],
}

impl Kernel for PrefilterKernel<'_> {
    type Output = [f32; 3];

    #[inline(always)]
    fn run(self) -> [f32; 3] {
        prefilter_direction(self.chain, self.normal, self.samples)
    }
}

#[inline(always)]
fn prefilter_direction(
    chain: &[OctahedralMap],
    normal: [f32; 3],
    ways: &[SamplePacket],
) -> [f32; 3] {
    let aside = if normal[1].abs() < 0.9 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
    let right = normalize(cross(aside, normal));
    let ahead = cross(normal, right);
    let (mut sum, mut whole) = ([0.0; 4], 0.0);
    for SamplePacket { count, directions: [x, y, z], near_levels: near, level_fractions: share } in
        ways
    {
        let mut turned = [[0.0; SAMPLE_LANES]; 3];
        let mut weights = [0.0; SAMPLE_LANES];
        for lane in 0..SAMPLE_LANES {
            let way = [0, 1, 2]
                .map(|k: usize| right[k] * x[lane] + ahead[k] * y[lane] + normal[k] * z[lane]);
            weights[lane] = dot(way, normal).max(0.0);
            for axis in 0..3 {
                turned[axis][lane] = way[axis];
            }
        }
        let colors = sample_trilinear(|level| &chain[level], near, share, &turned);
        for (color, weight) in colors.iter().zip(weights).take(*count) {
            for k in 0..4 {
                sum[k] += color[k] * weight;
            }
            whole += weight;
        }
    }
    [0, 1, 2].map(|k: usize| sum[k] / whole)
}
