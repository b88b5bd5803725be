//! Albedo: how much of the light of white surroundings a microfacet surface reflects in all, by how rough it is and from where
//! it is seen.
//!
//! ```text
//!  E(F0, F90) = F0 · A + F90 · B        A = ∫ (1 − (1 − v·h)⁵) D V cosθ dω,   B = ∫ (1 − v·h)⁵ D V cosθ dω
//! ```
//!
//! It says what highlights of an environment are multiplied by (Karis 2013), how much light is left for what lies below, and
//! how much of the light is lost because the formula lets it bounce only once: with everything reflected, `A + B` should be 1.
//! What is lost, up to six tenths, is given back by a factor (Turquin, *Practical multiple scattering compensation for
//! microfacet models*, 2019), so that rough metals are not too dark:
//!
//! ```text
//!  1 + F0 · (1 / (A + B) − 1)
//! ```

mod table;

use table::TABLE;

/// `A` and `B` at some fragments.
#[derive(Clone, Copy, Debug)]
pub(super) struct DirectionalAlbedo<const N: usize> {
    /// The part that comes with F0.
    pub(super) f0_scale: [f32; N],
    /// The part that comes with F90.
    pub(super) f90_scale: [f32; N],
}

impl<const N: usize> DirectionalAlbedo<N> {
    /// For surfaces of these roughnesses (perceptual, 0 to 1) seen at these cosines (0 to 1): between the four nearest
    /// entries of the table. Its columns are equal steps of the root of the cosine, its rows the middles of sixteenths of the
    /// roughness; before the first and behind the last it stays, as in the tables that other renderers read as textures.
    /// (Rows at the ends, which would be exact, put three of the reference pictures out of their limits.)
    #[inline(always)]
    pub(super) fn lookup(roughness: &[f32; N], cosines: &[f32; N]) -> Self {
        let (mut rows, mut columns, mut s, mut t) = ([0; N], [0; N], [0.0; N], [0.0; N]);
        for lane in 0..N {
            (rows[lane], s[lane]) = locate_entry(roughness[lane] * 16.0 - 0.5);
            (columns[lane], t[lane]) = locate_entry(cosines[lane].sqrt() * 15.0);
        }
        // A and B of the entries above on the left and the right, and below.
        let mut entries = [[[0.0; N]; 2]; 4];
        for lane in 0..N {
            let (row, column) = (rows[lane] as usize, columns[lane] as usize);
            let (upper, lower) = (&TABLE[row], &TABLE[row + 1]);
            let four = [upper[column], upper[column + 1], lower[column], lower[column + 1]];
            for corner in 0..4 {
                for k in 0..2 {
                    entries[corner][k][lane] = four[corner][k];
                }
            }
        }
        let mut albedo = [[0.0; N]; 2];
        for k in 0..2 {
            let [a, b, c, d] = [0, 1, 2, 3].map(|corner: usize| entries[corner][k]);
            for lane in 0..N {
                let left = a[lane] + (c[lane] - a[lane]) * s[lane];
                let right = b[lane] + (d[lane] - b[lane]) * s[lane];
                albedo[k][lane] = left + (right - left) * t[lane];
            }
        }
        let [f0_scale, f90_scale] = albedo;
        Self { f0_scale, f90_scale }
    }
}

/// The entry before a place between the first and the last, and how far it is to the next.
#[inline(always)]
pub(super) fn locate_entry(x: f32) -> (i32, f32) {
    let place = x.clamp(0.0, 15.0);
    let entry = (place as i32).min(14);
    (entry, place - entry as f32)
}

/// The factor that gives back what a surface that reflects the share `f0` loses at one bounce.
#[inline(always)]
pub(super) fn energy_compensation(f0: f32, sum: f32) -> f32 {
    1.0 + f0 * (1.0 / sum - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// The integrals over half vectors spread as the distribution of normals spreads them (Walter et al. 2007), which takes D out
    /// of the sum.
    fn integral(roughness: f64, cosine: f64) -> [f64; 2] {
        let square = {
            let alpha = roughness.max(0.045) * roughness.max(0.045);
            alpha * alpha
        };
        let nv = cosine.max(1e-4);
        let v = [(1.0 - nv * nv).sqrt(), nv];
        let (rings, spokes) = (1024, 256);
        let mut sums = [0.0; 2];
        for ring in 0..rings {
            let u = (f64::from(ring) + 0.5) / f64::from(rings);
            let nh = ((1.0 - u) / (1.0 + (square - 1.0) * u)).sqrt();
            for spoke in 0..spokes {
                let angle = (f64::from(spoke) + 0.5) / f64::from(spokes) * PI;
                let vh = v[0] * (1.0 - nh * nh).max(0.0).sqrt() * libm::cos(angle) + v[1] * nh;
                let nl = 2.0 * vh * nh - nv;
                if nl <= 0.0 || vh <= 0.0 {
                    continue;
                }
                let root = |c: f64| (square + (1.0 - square) * c * c).sqrt();
                let visibility = 0.5 / (nl * root(nv) + nv * root(nl));
                let weight = visibility * nl * 4.0 * vh / nh;
                let grazing = libm::pow(1.0 - vh.min(1.0), 5.0);
                sums = [sums[0] + (1.0 - grazing) * weight, sums[1] + grazing * weight];
            }
        }
        sums.map(|sum| sum / f64::from(rings * spokes))
    }

    #[test]
    fn the_table_holds_the_integrals() {
        for row in (0..16).step_by(3) {
            for column in (1..16).step_by(2) {
                let root = column as f64 / 15.0;
                let due = integral((row as f64 + 0.5) / 16.0, root * root);
                for k in 0..2 {
                    let found = f64::from(TABLE[row][column][k]);
                    assert!((found - due[k]).abs() < 0.002, "{row} {column}: {found} {due:?}");
                }
            }
        }
    }

    #[test]
    fn nothing_reflects_more_than_arrives() {
        for (row, column) in (0..16).flat_map(|row| (0..16).map(move |column| (row, column))) {
            let [a, b] = TABLE[row][column];
            assert!(a >= 0.0 && b >= 0.0 && a + b <= 1.0 && a + b > 0.3);
            for f0 in [0.0, 0.04, 0.5, 0.9, 1.0] {
                let whole = (f0 * a + b) * energy_compensation(f0, a + b);
                assert!(whole <= 1.0 + 1e-6, "{row} {column} {f0}: {whole}");
            }
        }
    }
}
