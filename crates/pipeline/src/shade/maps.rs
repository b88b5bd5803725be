//! Maps: the textures of a draw's material, each with the place where it counts.

use super::MipChain;
use crate::model::{Material, TextureSlot, TextureUse};

/// A texture of a material.
#[derive(Clone, Copy, Debug)]
pub struct Map<'a> {
    /// What it changes.
    pub slot: TextureSlot,
    /// By which coordinates it is read.
    pub used: TextureUse,
    /// Its texels.
    pub chain: &'a MipChain<'a>,
}

/// The textures of a material.
#[derive(Clone, Debug, Default)]
pub struct Maps<'a> {
    /// All of them; those that are read alike stand side by side, so that texels are fetched once for both.
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
        let map = |(slot, used)| Some(Map { slot, used, chain: chain(slot, used)? });
        let mut maps: Vec<Map<'a>> = material.textures().filter_map(map).collect();
        maps.sort_by_key(|map| (map.used.texture, map.used.uv_set, map.slot));
        Self { maps, anisotropy }
    }

    /// All maps in the order in which they are best read.
    #[inline(always)]
    pub(super) fn list(&self) -> &[Map<'a>] {
        &self.maps
    }

    /// The map that alpha is read from.
    pub(super) fn of_base_color(&self) -> Option<&Map<'a>> {
        self.maps
            .iter()
            .find(|map| matches!(map.slot, TextureSlot::BaseColor | TextureSlot::Diffuse))
    }
}

impl Map<'_> {
    /// Whether two maps have the same texels everywhere.
    #[inline(always)]
    pub(super) fn reads_like(&self, other: &Self) -> bool {
        std::ptr::eq(self.chain, other.chain) && self.used == other.used
    }
}
