//! The chain of an environment: what surfaces of growing roughness mirror of it.
//!
//! For each direction, taken for normal and view alike, the light that half vectors spread as GGX spreads them mirror, weighted
//! by the cosine (Karis 2013). Few half vectors do, for each reads the surroundings as blurred as the gap to the next is wide
//! (Křivánek and Colbert 2008).

use super::octahedron::{Octahedron, unit};
use crate::shade::seen::{cross, dot};
use std::f32::consts::PI;

/// How many pictures there are: of roughness 0, 0.2 and so on to 1.
pub(super) const LEVELS: usize = 6;
/// Nodes along the sides of the blurred ones.
const SIDES: [usize; LEVELS - 1] = [129, 65, 33, 33, 17];
/// How many half vectors.
const COUNT: u32 = 64;

/// The pictures, from sharp to blurred.
pub(super) fn levels(sharp: Octahedron) -> Vec<Octahedron> {
    let mut chain = vec![sharp];
    while chain.len() < 7 {
        chain.push(chain[chain.len() - 1].half());
    }
    let blur = |(n, &side): (usize, &usize)| {
        let roughness = (n + 1) as f32 / (LEVELS - 1) as f32;
        let ways = ways(roughness * roughness, chain[0].side);
        Octahedron::of(side, |normal| blurred(&chain, normal, &ways))
    };
    let mut levels: Vec<Octahedron> = SIDES.iter().enumerate().map(blur).collect();
    levels.insert(0, chain.swap_remove(0));
    levels
}

/// A direction around the normal, which is z: its weight and how blurred it reads the surroundings.
struct Way {
    direction: [f32; 3],
    level: f32,
}

/// Directions in which a surface of this α mirrors somebody who looks straight at it.
fn ways(alpha: f32, side: usize) -> Vec<Way> {
    let square = alpha * alpha;
    let texel = 4.0 * PI / (side * side) as f32;
    let way = |n: u32| {
        // The points of Hammersley: even steps, and their numbers with the bits reversed.
        let u = (n as f32 + 0.5) / COUNT as f32;
        let turn = (n.reverse_bits() >> 8) as f32 / (1 << 24) as f32 * 2.0 * PI;
        let nh = ((1.0 - u) / (1.0 + (square - 1.0) * u)).sqrt();
        let flat = (1.0 - nh * nh).max(0.0).sqrt();
        let h = [flat * libm::cosf(turn), flat * libm::sinf(turn), nh];
        let direction = [2.0 * nh * h[0], 2.0 * nh * h[1], 2.0 * nh * nh - 1.0];
        let width = nh * nh * (square - 1.0) + 1.0;
        // The density of directions: that of half vectors, D n·h, over four times v·h.
        let density = square / (PI * width * width) / 4.0;
        let gap = 1.0 / (COUNT as f32 * density.max(1e-9));
        Way { direction, level: (0.5 * libm::log2f(gap / texel) + 1.0).max(0.0) }
    };
    (0..COUNT).map(way).filter(|way| way.direction[2] > 0.0).collect()
}

fn blurred(chain: &[Octahedron], normal: [f32; 3], ways: &[Way]) -> [f32; 3] {
    let aside = if normal[1].abs() < 0.9 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
    let right = unit(cross(aside, normal));
    let ahead = cross(normal, right);
    let (mut sum, mut whole) = ([0.0; 3], 0.0);
    for Way { direction: [x, y, z], level } in ways {
        let way = [0, 1, 2].map(|k: usize| right[k] * x + ahead[k] * y + normal[k] * z);
        let place = level.min((chain.len() - 1) as f32);
        let near = (place as usize).min(chain.len() - 2);
        let (a, b) = (chain[near].at(way), chain[near + 1].at(way));
        let share = place - near as f32;
        let weight = dot(way, normal).max(0.0);
        sum = [0, 1, 2].map(|k: usize| sum[k] + (a[k] + (b[k] - a[k]) * share) * weight);
        whole += weight;
    }
    sum.map(|sum: f32| sum / whole)
}
