//! The alpha test: whether a fragment of a masked primitive is opaque (glTF 2.0 §3.9.4).
//!
//! The rasterizer runs it before depth is written, for eight fragments of a primitive at once.
//! Fragments that fail the test thus hide nothing.
//!
//! Styles with one color per fragment, such as normals and ids, also apply it to blended
//! primitives. These then get holes where textures and vertex colors make them less than half as
//! opaque as their material.

use super::attributes::{PrimitiveIndices, interpolate};
use super::fragment_lanes::{FragmentLanes, FragmentPacket};
use super::lanes::{Lanes, Mask};
use super::{Draw, DrawList};
use model::AlphaMode;
use raster::{Fragment, Fragments, Kernel, LANES, SimdLevel};

/// The kernel for the alpha test of eight fragments of a masked primitive.
struct AlphaTestEight<'a> {
    draws: &'a DrawList<'a>,
    fragments: &'a Fragments<'a>,
}

impl Kernel for AlphaTestEight<'_> {
    type Output = [bool; LANES];

    #[inline(always)]
    fn run(self) -> [bool; LANES] {
        let id = self.fragments.id(0);
        let (draw, _) = self.draws.find_draw(id);
        let primitive = draw.primitive_indices(&[id; LANES], true);
        draw.passes_alpha_test(&primitive, &FragmentPacket::new(self.fragments))
    }
}

impl DrawList<'_> {
    /// Returns whether a fragment of a masked primitive passes the alpha test (glTF 2.0 §3.9.4).
    pub fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        let (draw, _) = self.find_draw(fragment.id);
        let primitive = draw.primitive_indices(&[fragment.id], true);
        let [passes] = draw.passes_alpha_test(&primitive, fragment);
        passes
    }

    /// Runs the alpha test for eight fragments of a primitive, with the vector instructions of this
    /// SIMD level.
    ///
    /// The rasterizer calls it before depth is written, so that fragments that fail the test hide
    /// nothing.
    pub fn passes_alpha_test_eight(
        &self,
        fragments: &Fragments<'_>,
        simd_level: SimdLevel,
    ) -> [bool; LANES] {
        let passes = simd_level.run_wide_kernel(AlphaTestEight { draws: self, fragments });
        passes.unwrap_or_else(|| {
            let weights = fragments.weights();
            let mut passes = [false; LANES];
            for (lane, passes) in passes.iter_mut().enumerate() {
                *passes = self.passes_alpha_test(&fragments.fragment(lane, &weights));
            }
            passes
        })
    }
}

impl Draw<'_> {
    /// Runs the alpha test for fragments. Fragments of opaque materials always pass.
    #[inline(always)]
    fn passes_alpha_test<const N: usize>(
        &self,
        primitives: &PrimitiveIndices<N>,
        fragments: &impl FragmentLanes<N>,
    ) -> Mask<N> {
        let cutoff = match self.material.alpha_mode {
            AlphaMode::Opaque => return [true; N],
            AlphaMode::Mask { cutoff } => cutoff,
            // Faint glass counts as a surface; the empty part of a leaf texture does not.
            AlphaMode::Blend => (0.5 * self.material.base_color[3]).max(f32::MIN_POSITIVE),
        };
        let alpha = self.sample_alpha(primitives, fragments);
        let mut passes = [true; N];
        for (passes, alpha) in passes.iter_mut().zip(&alpha.0) {
            *passes = *alpha >= cutoff;
        }
        passes
    }

    /// Computes the alpha of fragments: factor × vertex color × texture (glTF 2.0 §3.9.4).
    #[inline(always)]
    fn sample_alpha<const N: usize>(
        &self,
        primitives: &PrimitiveIndices<N>,
        fragments: &impl FragmentLanes<N>,
    ) -> Lanes<N> {
        let vertices = self.vertex_indices(primitives);
        let mut alpha = Lanes::splat(self.material.base_color[3]);
        if let Some(colors) = &self.colors {
            let [vertex_alpha] =
                interpolate::<N, 1>(&vertices.fetch_attributes(colors, 3), &fragments.weights());
            alpha *= vertex_alpha;
        }
        if let Some(texture) = self.textures.base_color() {
            let uvs = self.texture_coordinates(&vertices, fragments, &texture.info);
            alpha *= texture.mip_chain.sample(&uvs, true, self.textures.anisotropy).alpha;
        }
        alpha
    }
}
