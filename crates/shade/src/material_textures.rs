//! Maps: the textures of a draw's material, each with the place where it counts.

use super::MipChain;
use model::{AlphaMode, Material, TextureInfo, TextureSlot};

/// How many maps are read at once, at most.
const MAX_GROUP: usize = 4;

/// A texture of a material.
#[derive(Clone, Copy, Debug)]
pub struct MaterialTexture<'a> {
    /// What it changes.
    pub slot: TextureSlot,
    /// By which coordinates it is read.
    pub usage: TextureInfo,
    /// Its texels.
    pub mip_chain: &'a MipChain<'a>,
    /// Whether their alpha counts where surfaces are shaded.
    needs_alpha: bool,
    /// Whether it is read together with the map before it, at the same places.
    joins_previous: bool,
    /// Whether it has the same texels as the map before it, too.
    repeats_previous: bool,
}

/// The textures of a material.
#[derive(Clone, Debug, Default)]
pub struct MaterialTextures<'a> {
    /// All of them; those that are read alike stand side by side, so that places are found, and texels fetched, once for all.
    textures: Vec<MaterialTexture<'a>>,
    /// How many places along a pixel's longer side textures are read at, at most.
    pub(super) anisotropy: u32,
}

impl<'a> MaterialTextures<'a> {
    /// Those textures of a material for which `chain` has texels. An unlit material shows nothing but its base colour.
    pub fn new(
        material: &Material,
        anisotropy: u32,
        chain: impl Fn(TextureSlot, TextureInfo) -> Option<&'a MipChain<'a>>,
    ) -> Self {
        let is_blended = material.alpha_mode == AlphaMode::Blend;
        let map = |(slot, used)| {
            let chain = chain(slot, used)?;
            let alpha_counts = slot_reads_alpha(slot) || (is_blended && is_base_color_slot(slot));
            Some(MaterialTexture {
                slot,
                usage: used,
                mip_chain: chain,
                needs_alpha: alpha_counts,
                joins_previous: false,
                repeats_previous: false,
            })
        };
        let mut rest: Vec<MaterialTexture<'a>> =
            material.visible_textures().filter_map(map).collect();
        rest.sort_by_key(|map| (map.usage.texture, map.slot));
        let mut textures: Vec<MaterialTexture<'a>> = Vec::with_capacity(rest.len());
        while let Some(&first) = rest.first() {
            let start = textures.len();
            rest.retain(|map| {
                let is_taken = first.has_same_footprint(map) && textures.len() < start + MAX_GROUP;
                if is_taken {
                    let before = textures[start..].last();
                    let repeats = before.is_some_and(|before| before.covers_texels_of(map));
                    textures.push(MaterialTexture {
                        joins_previous: before.is_some(),
                        repeats_previous: repeats,
                        ..*map
                    });
                }
                !is_taken
            });
        }
        Self { textures, anisotropy }
    }

    /// All maps, those together that are read at the same places.
    #[inline(always)]
    pub(super) fn groups(&self) -> impl Iterator<Item = &[MaterialTexture<'a>]> {
        self.textures.chunk_by(|_, next| next.joins_previous)
    }

    /// The texels of maps that are read together, at the same coordinates: see [`MipChain::sample`].
    #[inline(always)]
    pub(super) fn sample_group<const N: usize>(
        &self,
        maps: &[MaterialTexture<'a>],
        uvs: &[[[f32; N]; 2]; 3],
    ) -> [[[f32; N]; 4]; MAX_GROUP] {
        let mut texels = [[[0.0; N]; 4]; MAX_GROUP];
        let layout = maps[0].mip_chain.addressing();
        let footprint = layout.footprint(uvs, self.anisotropy);
        for number in 0..footprint.max_tap_count() {
            let tap = footprint.tap(layout, number);
            for (map, texels) in maps.iter().zip(&mut texels) {
                if !map.repeats_previous {
                    map.mip_chain.accumulate_tap(&tap, map.needs_alpha, texels);
                }
            }
        }
        for (number, map) in maps.iter().enumerate() {
            if map.repeats_previous {
                texels[number] = texels[number - 1];
            }
        }
        texels
    }

    /// The map that alpha is read from.
    pub(super) fn base_color(&self) -> Option<&MaterialTexture<'a>> {
        self.textures.iter().find(|map| is_base_color_slot(map.slot))
    }
}

impl MaterialTexture<'_> {
    /// Whether the texels of this map are all that another one needs, where both are read at the same places.
    fn covers_texels_of(&self, other: &Self) -> bool {
        std::ptr::eq(self.mip_chain, other.mip_chain) && (self.needs_alpha || !other.needs_alpha)
    }

    /// Whether two maps are read at the same places wherever they are.
    fn has_same_footprint(&self, other: &Self) -> bool {
        let (used, others) = (&self.usage, &other.usage);
        let layouts = self.mip_chain.addressing() == other.mip_chain.addressing();
        layouts && used.uv_set == others.uv_set && used.uv_matrix == others.uv_matrix
    }
}

const fn is_base_color_slot(slot: TextureSlot) -> bool {
    matches!(slot, TextureSlot::BaseColor | TextureSlot::Diffuse)
}

/// Whether the alpha of a texture counts that is no base colour.
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
    use model::{Image, NormalTexture, OcclusionTexture, Sampler};

    #[test]
    fn maps_read_together_have_the_bits_of_maps_read_alone() {
        let used =
            |texture| TextureInfo { texture, uv_set: 0, uv_matrix: TextureInfo::IDENTITY_UV };
        let material = Material {
            base_color_texture: Some(used(0)),
            metallic_roughness_texture: Some(used(1)),
            normal_texture: Some(NormalTexture { texture: used(2), scale: 1.0 }),
            occlusion_texture: Some(OcclusionTexture { texture: used(1), strength: 1.0 }),
            emissive_texture: Some(used(3)),
            ..Material::default()
        };
        // The last is of another size, and stands alone.
        let image = |side: u32, factor: u32| {
            let texel = |n: u32| [n * factor, n * 31, n * 101, n * 59].map(|code| code as u8);
            Image { width: side, height: side, rgba: (0..side * side).map(texel).collect() }
        };
        let images = [image(16, 7), image(16, 11), image(16, 13), image(8, 17)];
        let kinds = [
            TexelEncoding::Srgb,
            TexelEncoding::Linear,
            TexelEncoding::Linear,
            TexelEncoding::Srgb,
        ];
        let chain = |n: usize| MipChain::new(&images[n], Sampler::default(), kinds[n]);
        let chains = [0, 1, 2, 3].map(chain);
        let maps = MaterialTextures::new(&material, 4, |_, used| chains.get(used.texture));
        let counts: Vec<usize> = maps.groups().map(<[MaterialTexture<'_>]>::len).collect();
        assert_eq!(counts, [4, 1]);
        let uvs = [[[0.3], [0.7]], [[0.4], [0.1]], [[0.05], [0.02]]];
        for together in maps.groups() {
            for (map, texels) in together.iter().zip(maps.sample_group(together, &uvs)) {
                assert_eq!(texels, map.mip_chain.sample(&uvs, false, 4), "{:?}", map.slot);
            }
        }
    }
}
