//! Transmission: what light that passes through a surface becomes of (KHR_materials_transmission, KHR_materials_volume).
//!
//! ```text
//!   behind ──►│░░░░░│──► behind × passing × tint        tint = base colour × attenuation colour ^ (thickness / attenuation distance)
//!              glass
//! ```
//! Surfaces are thin: light is neither bent nor blurred by roughness, and goes straight through the thickness that the material tells
//! (Beer's law). Red, green and blue pass in their own shares. A fragment has one alpha all the same, for what picks up alpha, a
//! transparent background above all: that of a grey as bright as the tint. A transparent picture of tinted glass therefore
//! shows, laid over something, that grey; where Alberti draws what is behind, it has the tint.

use super::Shading;
use super::fragment_lanes::FragmentPacket;
use super::material_inputs::MaterialInputs;
use model::{AlphaMode, MaterialExtensions};
use raster::{F32x8, Fragments, Kernel, LANES};

/// What of white light a body leaves; `scale` is how much longer things are in the world than in its mesh.
#[inline(always)]
pub(super) fn transmission_tint<const N: usize>(
    extensions: &MaterialExtensions,
    inputs: &MaterialInputs<N>,
    scale: f32,
    lane: usize,
) -> [f32; 3] {
    let volume = extensions.volume.as_deref().copied().unwrap_or_default();
    let way = inputs.layers.thickness[lane] * scale / volume.attenuation_distance;
    let mut tint = [0.0; 3];
    for channel in 0..3 {
        let left = if way > 0.0 { libm::powf(volume.attenuation_color[channel], way) } else { 1.0 };
        tint[channel] = inputs.base[channel][lane] * left;
    }
    tint
}

/// The grey that is as bright as a colour (Rec. 709).
#[inline(always)]
pub(super) fn luminance([r, g, b]: [f32; 3]) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// What eight translucent fragments with these alphas let through.
pub(super) struct TransmitEight<'a> {
    pub(super) shading: &'a Shading<'a>,
    pub(super) fragments: &'a Fragments<'a>,
    pub(super) alphas: &'a F32x8,
}

impl Kernel for TransmitEight<'_> {
    type Output = [F32x8; 3];

    #[inline(always)]
    fn run(self) -> [F32x8; 3] {
        let Self { shading, fragments, alphas } = self;
        let mut through = [alphas.map(|alpha| 1.0 - alpha); 3];
        let mut done = [false; LANES];
        while let Some(first) = done.iter().position(|&is_done| !is_done) {
            let (draw, ids, own) = shading.draws.select_draw_lanes(fragments, first);
            for lane in 0..LANES {
                done[lane] |= own[lane];
            }
            if !draw.material.is_transmissive() {
                continue;
            }
            let items = draw.primitive_indices(&ids, fragments.is_single_primitive());
            let is_blended = draw.material.alpha_mode == AlphaMode::Blend;
            let corners = draw.vertex_indices(&items);
            let inputs = MaterialInputs::evaluate(draw, &corners, &FragmentPacket::new(fragments));
            for lane in (0..LANES).filter(|&lane| own[lane]) {
                let there = if is_blended { inputs.base[3][lane] } else { 1.0 };
                let tint =
                    transmission_tint(&draw.material.extensions, &inputs, draw.world_scale, lane);
                let passing = (there - alphas[lane]) / luminance(tint);
                // Grey passes as it is, and so does what no number tells.
                if passing.is_finite() && (tint[0] != tint[1] || tint[1] != tint[2]) {
                    for channel in 0..3 {
                        let share = 1.0 - there + passing * tint[channel];
                        through[channel][lane] = share.clamp(0.0, 1.0);
                    }
                }
            }
        }
        through
    }
}
