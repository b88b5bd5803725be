//! Fibres: the lobe of cloth (KHR_materials_sheen), by Estevez and Kulla, *Production friendly microfacet sheen BRDF*, 2017.

mod table;

use super::directional_albedo::locate_entry;
use super::microfacet::ShadingAngles;
use std::f32::consts::FRAC_1_PI;
use table::TABLE;

/// The lobe of fibres, times the cosine to the light.
pub(super) fn charlie_lobe(roughness: f32, meeting: &ShadingAngles) -> f32 {
    let per_alpha = 1.0 / (roughness * roughness);
    let sine_squared = meeting.sin_squared.clamp(0.0, 1.0);
    let spread = libm::powf(sine_squared, 0.5 * per_alpha);
    let distribution = (2.0 + per_alpha) * spread * (0.5 * FRAC_1_PI);
    let (nl, nv) = (meeting.nl, meeting.nv);
    let shadows = 1.0 + charlie_lambda(nv, 1.0 / per_alpha) + charlie_lambda(nl, 1.0 / per_alpha);
    let visibility = (0.25 / (shadows * nv * nl).max(1e-6)).min(1.0);
    distribution * visibility * nl
}

/// How fibres of this α shade each other from a direction: a fit of the lobe's Λ (Estevez and Kulla 2017, table 1).
fn charlie_lambda(cosine: f32, alpha: f32) -> f32 {
    let smooth = (1.0 - alpha) * (1.0 - alpha);
    let mix = |rough: f32, fine: f32| rough + (fine - rough) * smooth;
    let [a, b, c] = [mix(21.5473, 25.3245), mix(3.82987, 3.32435), mix(0.198_23, 0.168_01)];
    let [d, e] = [mix(-1.977_6, -1.273_93), mix(-4.320_54, -4.859_67)];
    let line = |x: f32| a / (1.0 + b * libm::powf(x, c)) + d * x + e;
    let exponent = if cosine < 0.5 { line(cosine) } else { 2.0 * line(0.5) - line(1.0 - cosine) };
    libm::expf(exponent)
}

/// The integral of the lobe over the hemisphere, cut off at 1: between the four nearest entries of the table.
pub(super) fn sheen_albedo(cosine: f32, roughness: f32) -> f32 {
    let (row, s) = locate_entry(roughness * 15.0);
    let (column, t) = locate_entry(cosine.sqrt() * 15.0);
    let (row, column) = (row as usize, column as usize);
    let (upper, lower) = (&TABLE[row], &TABLE[row + 1]);
    let across = |row: &[f32; 16]| row[column] + (row[column + 1] - row[column]) * t;
    across(upper) + (across(lower) - across(upper)) * s
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::PI;

    #[test]
    fn the_table_holds_the_integrals_of_the_lobe() {
        let n = [0.0, 0.0, 1.0];
        for roughness in [0.2, 0.37, 0.6, 1.0] {
            for degrees in [5.0_f32, 40.0, 80.0] {
                let angle = degrees.to_radians();
                let v = [libm::sinf(angle), 0.0, libm::cosf(angle)];
                let (rings, spokes) = (400, 128);
                let mut sum = 0.0;
                for (ring, spoke) in (0..rings).flat_map(|r| (0..spokes).map(move |s| (r, s))) {
                    let height = (ring as f32 + 0.5) / rings as f32;
                    let turn = (spoke as f32 + 0.5) / spokes as f32 * 2.0 * PI;
                    let flat = (1.0 - height * height).sqrt();
                    let l = [flat * libm::cosf(turn), flat * libm::sinf(turn), height];
                    sum += charlie_lobe(roughness, &ShadingAngles::new(n, v, l));
                }
                let whole = sum * 2.0 * PI / (rings * spokes) as f32;
                let fitted = sheen_albedo(v[2], roughness);
                assert!(
                    (whole.min(1.0) - fitted).abs() < 0.02,
                    "{roughness} {degrees}: {whole} {fitted}"
                );
            }
        }
    }
}
