//! Transmission through tinted glass, and absorption in a volume by Beer's law
//! (KHR_materials_transmission, KHR_materials_volume).
//!
//! ```text
//!   behind ──►│░░░░░│──► behind · transmittance · tint
//!              glass      tint = base color · attenuation color ^ (thickness / distance)
//! ```
//!
//! Smooth thin sheets let light pass straight through, and any number of them can be blended over
//! the objects behind. If thickness refracts the light or roughness scatters it, a surface hides
//! the objects behind it and shows the [`TransmissionFramebuffer`] instead. Opaque surfaces are
//! visible through such glass; other glass and blended surfaces are not.
//!
//! Red, green and blue have separate transmittances. A fragment still has a single alpha, mainly
//! for transparent backgrounds, which corresponds to a gray with the luminance of the tint. In a
//! transparent picture composited over another, tinted glass therefore shows that gray, but objects
//! drawn together with the glass are tinted.

mod framebuffer;
mod mip_levels;
mod refraction;

pub use framebuffer::{ScreenProjection, TransmissionFramebuffer};

use super::Draw;
use super::lanes::{Lanes, Rgb, map_to_lanes};
use super::material_inputs::MaterialInputs;
use model::MaterialExtensions;

/// The share of light that passes through the surface of a draw, regardless of the light's origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct TransmittedShare<const N: usize> {
    /// The fraction of light that neither the interface nor the material blocks.
    fraction: Lanes<N>,
    /// The color of white light after passing through.
    tint: Rgb<N>,
}

impl<const N: usize> TransmittedShare<N> {
    /// Creates the share for a surface that lets through this fraction of the light, tinted by the
    /// material.
    #[inline(always)]
    pub(super) fn new(draw: &Draw<'_>, inputs: &MaterialInputs<N>, fraction: Lanes<N>) -> Self {
        let tint = transmission_tint(&draw.material.extensions, inputs, draw.world_scale);
        Self { fraction, tint }
    }

    /// Returns the factor for light from behind in each channel.
    #[inline(always)]
    pub(super) fn color(&self) -> Rgb<N> {
        self.tint * self.fraction
    }

    /// Returns the factor for the luminance of white light from behind.
    #[inline(always)]
    pub(super) fn gray(&self) -> Lanes<N> {
        (self.fraction * luminance(self.tint)).clamp(0.0, 1.0)
    }

    /// Computes the transmittances for red, green and blue from an alpha that assumes a gray as
    /// bright as the tint.
    #[inline(always)]
    pub(super) fn channel_transmittances(
        &self,
        coverage: Lanes<N>,
        alpha: Lanes<N>,
    ) -> [Lanes<N>; 3] {
        let mut transmittance = [1.0 - alpha; 3];
        // Remove the gray tint from alpha, then tint each channel.
        let white = (coverage - alpha) / luminance(self.tint);
        for lane in 0..N {
            let [r, g, b] = self.tint.lane(lane);
            // Alpha is already exact for a gray tint, and black transmits nothing to tint.
            if white[lane].is_finite() && (r != g || g != b) {
                for (channel, tint) in transmittance.iter_mut().zip([r, g, b]) {
                    channel[lane] = (1.0 - coverage[lane] + white[lane] * tint).clamp(0.0, 1.0);
                }
            }
        }
        transmittance
    }
}

/// Computes the color that white light has after the base color and absorption in the volume.
///
/// `world_scale` is the scale from the mesh, whose units the thickness uses, to the world.
///
/// By the Beer-Lambert law, the transmittance over a length d is attenuation color ^ (d /
/// attenuation distance), so white light has the attenuation color after one attenuation distance.
#[inline(always)]
fn transmission_tint<const N: usize>(
    extensions: &MaterialExtensions,
    inputs: &MaterialInputs<N>,
    world_scale: f32,
) -> Rgb<N> {
    let volume = extensions.volume.as_deref().copied().unwrap_or_default();
    let length = inputs.layers.thickness * world_scale / volume.attenuation_distance;
    // Beer's law. A surface without thickness absorbs nothing.
    let [r, g, b] = map_to_lanes(&volume.attenuation_color, |color| {
        length.map_expensive(|length| if length > 0.0 { libm::powf(color, length) } else { 1.0 })
    });
    inputs.base_color * Rgb { r, g, b }
}

/// Computes the relative luminance of linear sRGB (Rec. 709).
#[inline(always)]
pub(super) fn luminance<const N: usize>(color: Rgb<N>) -> Lanes<N> {
    0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b
}
