//! The textures of a material, grouped by footprint.
//!
//! Textures with the same size, sampler and coordinates are read at the same texels. They are
//! sampled as a group: the footprint, mip levels and texel indices are computed once for the group.
//! Packed glTF textures, such as occlusion, roughness and metalness in one image, are also fetched
//! only once.

use super::MipChain;
use super::texture::{GroupedTexture, MAX_GROUP, TexelLanes, UvLanes, sample_textures};
use model::{AlphaMode, Material, TextureInfo, TextureSlot};

/// A texture of a material.
#[derive(Clone, Copy, Debug)]
pub struct MaterialTexture<'a> {
    /// The parameter that the texture multiplies.
    pub slot: TextureSlot,
    /// The coordinates at which the texture is sampled.
    pub info: TextureInfo,
    /// The texels.
    pub mip_chain: &'a MipChain<'a>,
    /// Whether shading reads the texture's alpha.
    needs_alpha: bool,
    /// Whether the texture is in the same group as the previous texture.
    joins_previous: bool,
    /// Whether the texture also has the same texels as the previous texture.
    repeats_previous: bool,
}

/// The textures of a material.
#[derive(Clone, Debug, Default)]
pub struct MaterialTextures<'a> {
    /// The textures, group by group.
    textures: Vec<MaterialTexture<'a>>,
    /// The maximum number of taps along the longer axis of a footprint.
    pub(super) anisotropy: u32,
}

impl<'a> MaterialTextures<'a> {
    /// Collects the textures of a material for which `mip_chain` returns texels. For an unlit
    /// material, only the base color is used.
    ///
    /// `anisotropy` is the maximum number of taps along the longer axis of a pixel's footprint.
    pub fn new(
        material: &Material,
        anisotropy: u32,
        mip_chain: impl Fn(TextureSlot, TextureInfo) -> Option<&'a MipChain<'a>>,
    ) -> Self {
        let is_blended = material.alpha_mode == AlphaMode::Blend;
        let texture = |(slot, info)| {
            Some(MaterialTexture {
                slot,
                info,
                mip_chain: mip_chain(slot, info)?,
                needs_alpha: slot_reads_alpha(slot) || (is_blended && is_base_color_slot(slot)),
                joins_previous: false,
                repeats_previous: false,
            })
        };
        let mut rest: Vec<_> = material.visible_textures().filter_map(texture).collect();
        // Slots that share an image are adjacent, so that a repeated image directly follows its
        // original.
        rest.sort_by_key(|texture| (texture.info.texture, texture.slot));
        let mut textures: Vec<MaterialTexture<'a>> = Vec::with_capacity(rest.len());
        while let Some(&first) = rest.first() {
            let start = textures.len();
            // Move the textures that share the footprint of the first texture, as one group.
            rest.retain(|texture| {
                let is_taken =
                    first.has_same_footprint(texture) && textures.len() < start + MAX_GROUP;
                if is_taken {
                    let previous = textures[start..].last();
                    let repeats_previous =
                        previous.is_some_and(|previous| previous.covers_texels_of(texture));
                    let joins_previous = previous.is_some();
                    textures.push(MaterialTexture { joins_previous, repeats_previous, ..*texture });
                }
                !is_taken
            });
        }
        Self { textures, anisotropy }
    }

    /// Returns the groups of textures that are read at the same texels. No group is empty.
    #[inline(always)]
    pub(super) fn groups(&self) -> impl Iterator<Item = &[MaterialTexture<'a>]> {
        self.textures.chunk_by(|_, next| next.joins_previous)
    }

    /// Samples the textures of one group at its coordinates; see [`MipChain::sample`].
    ///
    /// The result has one entry for each texture of the group, in order; other entries are zero.
    #[inline(always)]
    pub(super) fn sample_group<const N: usize>(
        &self,
        group: &[MaterialTexture<'a>],
        uvs: &UvLanes<N>,
    ) -> [TexelLanes<N>; MAX_GROUP] {
        // The distinct textures of the group, and the entry of each texture among them.
        let grouped = |texture: &MaterialTexture<'a>| {
            let MaterialTexture { mip_chain, needs_alpha, .. } = *texture;
            GroupedTexture { mip_chain, needs_alpha }
        };
        let (mut distinct, mut entries) = ([grouped(&group[0]); MAX_GROUP], [0; MAX_GROUP]);
        let mut count = 0;
        for (texture, entry) in group.iter().zip(&mut entries) {
            if !texture.repeats_previous {
                distinct[count] = grouped(texture);
                count += 1;
            }
            *entry = count - 1;
        }
        let sampled = sample_textures(&distinct[..count], uvs, self.anisotropy);
        let mut texels = [TexelLanes::ZERO; MAX_GROUP];
        for (texel, entry) in texels.iter_mut().zip(entries).take(group.len()) {
            *texel = sampled[entry];
        }
        texels
    }

    /// Returns the texture that provides the alpha of the surface.
    pub(super) fn base_color(&self) -> Option<&MaterialTexture<'a>> {
        self.textures.iter().find(|texture| is_base_color_slot(texture.slot))
    }
}

impl MaterialTexture<'_> {
    /// Returns whether the sampled texels of this texture include everything that another texture
    /// in the group needs.
    fn covers_texels_of(&self, other: &Self) -> bool {
        std::ptr::eq(self.mip_chain, other.mip_chain) && (self.needs_alpha || !other.needs_alpha)
    }

    /// Returns whether two textures are read at the same texels by every fragment.
    fn has_same_footprint(&self, other: &Self) -> bool {
        let (info, others) = (&self.info, &other.info);
        let is_same_addressing = self.mip_chain.addressing() == other.mip_chain.addressing();
        is_same_addressing && info.uv_set == others.uv_set && info.uv_matrix == others.uv_matrix
    }
}

/// Returns whether a slot holds the base color, in either workflow.
const fn is_base_color_slot(slot: TextureSlot) -> bool {
    matches!(slot, TextureSlot::BaseColor | TextureSlot::Diffuse)
}

/// Returns whether the alpha of a texture is a separate parameter, other than the alpha of the base
/// color.
const fn slot_reads_alpha(slot: TextureSlot) -> bool {
    matches!(
        slot,
        TextureSlot::Specular | TextureSlot::SheenRoughness | TextureSlot::SpecularGlossiness
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TexelEncoding;
    use crate::lanes::Lanes;
    use model::{Image, NormalTexture, OcclusionTexture, Sampler};

    #[test]
    fn a_group_matches_separately_sampled_textures_bit_for_bit() {
        let info =
            |texture| TextureInfo { texture, uv_set: 0, uv_matrix: TextureInfo::IDENTITY_UV };
        let material = Material {
            base_color_texture: Some(info(0)),
            metallic_roughness_texture: Some(info(1)),
            normal_texture: Some(NormalTexture { texture: info(2), scale: 1.0 }),
            occlusion_texture: Some(OcclusionTexture { texture: info(1), strength: 1.0 }),
            emissive_texture: Some(info(3)),
            ..Material::default()
        };
        // The last texture has a different size, and forms a separate group.
        let image = |side: u32, factor: u32| {
            let texel = |n: u32| [n * factor, n * 31, n * 101, n * 59].map(|code| code as u8);
            Image { width: side, height: side, rgba: (0..side * side).map(texel).collect() }
        };
        let images = [image(16, 7), image(16, 11), image(16, 13), image(8, 17)];
        let encodings = [
            TexelEncoding::Srgb,
            TexelEncoding::Linear,
            TexelEncoding::Linear,
            TexelEncoding::Srgb,
        ];
        let mip_chain = |n: usize| MipChain::new(&images[n], Sampler::default(), encodings[n]);
        let mip_chains = [0, 1, 2, 3].map(mip_chain);
        let textures = MaterialTextures::new(&material, 4, |_, info| mip_chains.get(info.texture));
        let counts: Vec<usize> = textures.groups().map(<[MaterialTexture<'_>]>::len).collect();
        assert_eq!(counts, [4, 1]);
        let [uv, dx, dy] = [[0.3, 0.7], [0.4, 0.1], [0.05, 0.02]].map(|uv| uv.map(Lanes::splat));
        let uvs = UvLanes::<1> { uv, dx, dy };
        for group in textures.groups() {
            for (texture, texel) in group.iter().zip(textures.sample_group(group, &uvs)) {
                let alone = texture.mip_chain.sample(&uvs, false, 4);
                assert_eq!(texel, alone, "{:?}", texture.slot);
            }
        }
    }
}
