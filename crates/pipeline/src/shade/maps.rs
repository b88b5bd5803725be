//! Maps: the textures of a draw's material, each with the place where it counts.

use super::MipChain;
use crate::model::{AlphaMode, Material, TextureSlot, TextureUse};

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
                    let repeats =
                        before.is_some_and(|before| std::ptr::eq(before.chain, map.chain));
                    let repeats = repeats && !reads_alpha(map.slot);
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
