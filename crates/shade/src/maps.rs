//! Maps: the textures of a draw's material, each with the place where it counts.

use super::MipChain;
use model::{AlphaMode, Material, TextureSlot, TextureUse};

/// How many maps are read at once, at most.
const TOGETHER: usize = 4;

/// A texture of a material.
#[derive(Clone, Copy, Debug)]
pub struct Map<'a> {
    /// What it changes.
    pub slot: TextureSlot,
    /// By which coordinates it is read.
    pub used: TextureUse,
    /// Its texels.
    pub chain: &'a MipChain<'a>,
    /// Whether their alpha counts where surfaces are shaded.
    alpha_counts: bool,
    /// Whether it is read together with the map before it, at the same places.
    joins: bool,
    /// Whether it has the same texels as the map before it, too.
    repeats: bool,
}

/// The textures of a material.
#[derive(Clone, Debug, Default)]
pub struct Maps<'a> {
    /// All of them; those that are read alike stand side by side, so that places are found, and texels fetched, once for all.
    maps: Vec<Map<'a>>,
    /// How many places along a pixel's longer side textures are read at, at most.
    pub(super) anisotropy: u32,
}

impl<'a> Maps<'a> {
    /// Those textures of a material for which `chain` has texels. An unlit material shows nothing but its base colour.
    pub fn of(
        material: &Material,
        anisotropy: u32,
        chain: impl Fn(TextureSlot, TextureUse) -> Option<&'a MipChain<'a>>,
    ) -> Self {
        let is_blended = material.alpha_mode == AlphaMode::Blend;
        let map = |(slot, used)| {
            let chain = chain(slot, used)?;
            let alpha_counts = reads_alpha(slot) || (is_blended && is_base_color(slot));
            Some(Map { slot, used, chain, alpha_counts, joins: false, repeats: false })
        };
        let mut rest: Vec<Map<'a>> = material.textures().filter_map(map).collect();
        rest.sort_by_key(|map| (map.used.texture, map.slot));
        let mut maps: Vec<Map<'a>> = Vec::with_capacity(rest.len());
        while let Some(&first) = rest.first() {
            let start = maps.len();
            rest.retain(|map| {
                let is_taken = first.lies_like(map) && maps.len() < start + TOGETHER;
                if is_taken {
                    let before = maps[start..].last();
                    let repeats = before.is_some_and(|before| before.tells(map));
                    maps.push(Map { joins: before.is_some(), repeats, ..*map });
                }
                !is_taken
            });
        }
        Self { maps, anisotropy }
    }

    /// All maps, those together that are read at the same places.
    #[inline(always)]
    pub(super) fn together(&self) -> impl Iterator<Item = &[Map<'a>]> {
        self.maps.chunk_by(|_, next| next.joins)
    }

    /// The texels of maps that are read together, at the same coordinates: see [`MipChain::sample`].
    #[inline(always)]
    pub(super) fn read<const N: usize>(
        &self,
        maps: &[Map<'a>],
        uvs: &[[[f32; N]; 2]; 3],
    ) -> [[[f32; N]; 4]; TOGETHER] {
        let mut texels = [[[0.0; N]; 4]; TOGETHER];
        let layout = maps[0].chain.layout();
        let footprint = layout.footprint(uvs, self.anisotropy);
        for number in 0..footprint.count() {
            let tap = footprint.tap(layout, number);
            for (map, texels) in maps.iter().zip(&mut texels) {
                if !map.repeats {
                    map.chain.add(&tap, map.alpha_counts, texels);
                }
            }
        }
        for (number, map) in maps.iter().enumerate() {
            if map.repeats {
                texels[number] = texels[number - 1];
            }
        }
        texels
    }

    /// The map that alpha is read from.
    pub(super) fn of_base_color(&self) -> Option<&Map<'a>> {
        self.maps.iter().find(|map| is_base_color(map.slot))
    }
}

impl Map<'_> {
    /// Whether the texels of this map are all that another one needs, where both are read at the same places.
    fn tells(&self, other: &Self) -> bool {
        std::ptr::eq(self.chain, other.chain) && (self.alpha_counts || !other.alpha_counts)
    }

    /// Whether two maps are read at the same places wherever they are.
    fn lies_like(&self, other: &Self) -> bool {
        let (used, others) = (&self.used, &other.used);
        let layouts = self.chain.layout() == other.chain.layout();
        layouts && used.uv_set == others.uv_set && used.uv_map == others.uv_map
    }
}

const fn is_base_color(slot: TextureSlot) -> bool {
    matches!(slot, TextureSlot::BaseColor | TextureSlot::Diffuse)
}

/// Whether the alpha of a texture counts that is no base colour.
const fn reads_alpha(slot: TextureSlot) -> bool {
    matches!(
        slot,
        TextureSlot::Specular | TextureSlot::SheenRoughness | TextureSlot::SpecularGlossiness
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Texels;
    use model::{Image, NormalTexture, OcclusionTexture, Sampler};

    #[test]
    fn maps_read_together_have_the_bits_of_maps_read_alone() {
        let used = |texture| TextureUse { texture, uv_set: 0, uv_map: TextureUse::KEEP_UV };
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
        let kinds = [Texels::Srgb, Texels::Linear, Texels::Linear, Texels::Srgb];
        let chain = |n: usize| MipChain::new(&images[n], Sampler::default(), kinds[n]);
        let chains = [0, 1, 2, 3].map(chain);
        let maps = Maps::of(&material, 4, |_, used| chains.get(used.texture));
        let counts: Vec<usize> = maps.together().map(<[Map<'_>]>::len).collect();
        assert_eq!(counts, [4, 1]);
        let uvs = [[[0.3], [0.7]], [[0.4], [0.1]], [[0.05], [0.02]]];
        for together in maps.together() {
            for (map, texels) in together.iter().zip(maps.read(together, &uvs)) {
                assert_eq!(texels, map.chain.sample(&uvs, false, 4), "{:?}", map.slot);
            }
        }
    }
}
