//! The textures of a scene, each with its mip chain, built once before drawing.

use model::ModelInstance;
use model::{Image, Material, Model, Texture, TextureSlot};
use shade::{MipChain, TexelEncoding};
use std::collections::BTreeMap;
use std::sync::Arc;

/// For each model of a scene, the mip chains of its textures, as colours and as numbers; `None` for those that no material
/// reads so.
///
/// They belong to the models, not to a picture: whoever renders several of the same models builds them once.
#[derive(Debug)]
pub struct Textures<'a> {
    mip_chains: Vec<Vec<[Option<MipChain<'a>>; 2]>>,
    /// For each model of the scene whose chains are its: models that are there several times share them.
    chain_indices: Vec<usize>,
}

impl<'a> Textures<'a> {
    /// Builds the chains.
    #[must_use]
    pub fn for_models(models: &'a [ModelInstance]) -> Self {
        let mut model_indices: BTreeMap<*const Model, usize> = BTreeMap::new();
        let mut all = Vec::new();
        let chain_index = |placed: &'a ModelInstance| {
            *model_indices.entry(Arc::as_ptr(&placed.model)).or_insert_with(|| {
                all.push(build_mip_chains(&placed.model));
                all.len() - 1
            })
        };
        let chain_indices = models.iter().map(chain_index).collect();
        Self { mip_chains: all, chain_indices }
    }

    /// The chain of a texture of the scene's n-th model, for a slot of a material.
    pub(super) fn mip_chain(
        &self,
        model: usize,
        slot: TextureSlot,
        texture: usize,
    ) -> Option<&MipChain<'a>> {
        self.mip_chains.get(*self.chain_indices.get(model)?)?.get(texture)?
            [usize::from(!slot.is_srgb())]
        .as_ref()
    }
}

fn build_mip_chains(model: &Model) -> Vec<[Option<MipChain<'_>>; 2]> {
    let mut used = vec![[false; 2]; model.textures.len()];
    for (slot, texture) in model.materials.iter().flat_map(Material::visible_textures) {
        used[texture.texture][usize::from(!slot.is_srgb())] = true;
    }
    let image =
        |texture: &Texture| -> Option<&Image> { model.images.get(texture.image?)?.as_ref() };
    let chain = |texture: &Texture, texels: TexelEncoding, used: bool| {
        let image = used.then(|| image(texture)).flatten();
        image.map(|image| MipChain::new(image, texture.sampler, texels))
    };
    let color_and_data_chains = |(texture, [color, number]): (&Texture, [bool; 2])| {
        [chain(texture, TexelEncoding::Srgb, color), chain(texture, TexelEncoding::Linear, number)]
    };
    model.textures.iter().zip(used).map(color_and_data_chains).collect()
}
