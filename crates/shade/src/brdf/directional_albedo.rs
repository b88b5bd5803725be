//! The directional albedo of the GGX microfacet BRDF: the second sum of the split-sum
//! approximation, and energy compensation.
//!
//! The directional albedo is the fraction of the light from a uniform white environment that a
//! rough surface reflects to the viewer, by roughness and viewing angle:
//!
//! ```text
//!  E(F0, F90) = F0 · A + F90 · B        A = ∫ (1 − (1 − v·h)⁵) D V cosθ dω
//!                                       B = ∫ (1 − v·h)⁵ D V cosθ dω
//! ```
//!
//! `A` and `B` are the scale and bias of Karis (*Real shading in Unreal Engine 4*, 2013), often
//! stored as a DFG or BRDF integration texture. They have three uses here: the weight of an
//! environment's prefiltered radiance, the light left for the layers below, and the energy that the
//! single-bounce model loses. If everything were reflected, `A + B` would be 1; the missing part,
//! up to 60%, is multiple scattering between facets. A factor restores this energy (Turquin,
//! *Practical multiple scattering compensation for microfacet models*, 2019), so that rough metals
//! are not too dark:
//!
//! ```text
//!  energy compensation = 1 + F0 · (1 / (A + B) − 1)
//! ```

mod table;

use crate::approximations::floor_to_int;
use crate::lanes::Lanes;
use table::TABLE;

/// `A` and `B` of the split sum at `N` fragments.
///
/// `A + B` is the albedo of a white metal with this roughness.
#[derive(Clone, Copy, Debug)]
pub(super) struct DirectionalAlbedo<const N: usize> {
    /// `A`, the factor of F0.
    pub(super) f0_scale: Lanes<N>,
    /// `B`, the factor of F90.
    pub(super) f90_scale: Lanes<N>,
}

impl<const N: usize> DirectionalAlbedo<N> {
    /// Looks up a perceptual roughness and a cosine n·v, both from 0 to 1, with bilinear
    /// interpolation.
    ///
    /// The table's columns are equal steps of the square root of the cosine, and its rows are the
    /// midpoints of sixteenths of the roughness. Beyond the first and last rows the value is
    /// clamped, as in the textures of other renderers. Rows at both ends would be exact, but would
    /// push three of the reference pictures beyond their limits.
    #[cfg_attr(not(any(target_family = "wasm", debug_assertions)), inline(always))]
    #[cfg_attr(any(target_family = "wasm", debug_assertions), inline(never))]
    pub(super) fn lookup(roughness: Lanes<N>, n_dot_v: Lanes<N>) -> Self {
        let (rows, s) = locate_entries(roughness * 16.0 - 0.5);
        let (columns, t) = locate_entries(n_dot_v.sqrt() * 15.0);
        // Gather `A` and `B` of the four entries around each position: upper left and right, then
        // lower left and right. Each quad takes one index and one bounds check.
        let mut entries = [[Lanes::ZERO; 2]; 4];
        for lane in 0..N {
            let quad = &QUADS[(rows[lane] * 15 + columns[lane]) as usize & 255];
            for (entry, value) in entries.iter_mut().zip(quad) {
                entry[0][lane] = value[0];
                entry[1][lane] = value[1];
            }
        }
        let [a, b, c, d] = entries;
        // Bilinear interpolation, first between rows, then between columns.
        let mut scales = [Lanes::ZERO; 2];
        for (k, scale) in scales.iter_mut().enumerate() {
            let left = a[k].lerp(c[k], s);
            let right = b[k].lerp(d[k], s);
            *scale = left.lerp(right, t);
        }
        let [f0_scale, f90_scale] = scales;
        Self { f0_scale, f90_scale }
    }
}

/// The four entries around each position of the table: upper left and right, then lower left and
/// right. There are 15 × 15 such quads, padded so that any byte is a valid index.
static QUADS: [[[f32; 2]; 4]; 256] = quads();

const fn quads() -> [[[f32; 2]; 4]; 256] {
    let mut quads = [[[0.0; 2]; 4]; 256];
    let mut index = 0;
    while index < 15 * 15 {
        let (row, column) = (index / 15, index % 15);
        let (upper, lower) = (&TABLE[row], &TABLE[row + 1]);
        quads[index] = [upper[column], upper[column + 1], lower[column], lower[column + 1]];
        index += 1;
    }
    quads
}

/// Splits positions in a table of 16 entries into the preceding entry and the fraction to the next
/// entry. Positions beyond the ends are clamped.
///
/// The preceding entry is at most 14, so that the next entry exists.
#[inline(always)]
pub(super) fn locate_entries<const N: usize>(positions: Lanes<N>) -> ([i32; N], Lanes<N>) {
    let positions = positions.clamp(0.0, 15.0);
    let mut entries = [0; N];
    for (entry, position) in entries.iter_mut().zip(&positions.0) {
        *entry = floor_to_int(*position).min(14);
    }
    let fractions = Lanes::from_fn(|lane| positions[lane] - entries[lane] as f32);
    (entries, fractions)
}

/// Computes the energy compensation, a factor that restores the energy lost by single scattering.
/// `f0` is the surface's reflectance at normal incidence; `white_albedo`, `A + B`, is its albedo if
/// it were a white metal.
///
/// For F0 = 1, the factor makes the albedo exactly 1 (white furnace test); for F0 = 0, it is 1.
/// Kulla and Conty (2017) add a lobe for the lost energy; Turquin's factor scales the existing
/// lobe.
#[inline(always)]
pub(super) fn energy_compensation<const N: usize>(
    f0: Lanes<N>,
    white_albedo: Lanes<N>,
) -> Lanes<N> {
    1.0 + f0 * (1.0 / white_albedo - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Integrates `A` and `B` over half vectors importance sampled from the GGX distribution
    /// (Walter et al. 2007), which eliminates D from the sum.
    fn integrate_albedo(roughness: f64, cosine: f64) -> [f64; 2] {
        let square = {
            let alpha = roughness.max(0.045) * roughness.max(0.045);
            alpha * alpha
        };
        let n_dot_v = cosine.max(1e-4);
        let v = [(1.0 - n_dot_v * n_dot_v).sqrt(), n_dot_v];
        let (rings, spokes) = (1024, 256);
        let mut sums = [0.0; 2];
        for ring in 0..rings {
            let u = (f64::from(ring) + 0.5) / f64::from(rings);
            let n_dot_h = ((1.0 - u) / (1.0 + (square - 1.0) * u)).sqrt();
            for spoke in 0..spokes {
                let angle = (f64::from(spoke) + 0.5) / f64::from(spokes) * PI;
                let v_dot_h = v[0] * (1.0 - n_dot_h * n_dot_h).max(0.0).sqrt() * libm::cos(angle)
                    + v[1] * n_dot_h;
                let n_dot_l = 2.0 * v_dot_h * n_dot_h - n_dot_v;
                if n_dot_l <= 0.0 || v_dot_h <= 0.0 {
                    continue;
                }
                let lambda = |c: f64| (square + (1.0 - square) * c * c).sqrt();
                let visibility = 0.5 / (n_dot_l * lambda(n_dot_v) + n_dot_v * lambda(n_dot_l));
                let weight = visibility * n_dot_l * 4.0 * v_dot_h / n_dot_h;
                let schlick = libm::pow(1.0 - v_dot_h.min(1.0), 5.0);
                sums = [sums[0] + (1.0 - schlick) * weight, sums[1] + schlick * weight];
            }
        }
        sums.map(|sum| sum / f64::from(rings * spokes))
    }

    #[test]
    fn the_table_contains_the_integrals() {
        for row in (0..16).step_by(3) {
            for column in (1..16).step_by(2) {
                let root = column as f64 / 15.0;
                let expected = integrate_albedo((row as f64 + 0.5) / 16.0, root * root);
                for k in 0..2 {
                    let actual = f64::from(TABLE[row][column][k]);
                    let error = (actual - expected[k]).abs();
                    assert!(error < 0.002, "{row} {column}: {actual} {expected:?}");
                }
            }
        }
    }

    #[test]
    fn reflected_energy_does_not_exceed_incoming_energy() {
        for (row, column) in (0..16).flat_map(|row| (0..16).map(move |column| (row, column))) {
            let [a, b] = TABLE[row][column];
            assert!(a >= 0.0 && b >= 0.0 && a + b <= 1.0 && a + b > 0.3);
            for f0 in [0.0, 0.04, 0.5, 0.9, 1.0] {
                let [compensation] = energy_compensation(Lanes([f0]), Lanes([a + b])).0;
                let albedo = (f0 * a + b) * compensation;
                assert!(albedo <= 1.0 + 1e-6, "{row} {column} {f0}: {albedo}");
            }
        }
    }
}
