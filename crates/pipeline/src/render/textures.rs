//! The textures of a scene, each with its mip chain, built once before drawing.

use model::ModelInstance;
use model::{Image, Material, Model, Texture, TextureSlot};
use shade::{MipChain, Texels};
use std::collections::BTreeMap;
use std::sync::Arc;

/// For each model of a scene, the mip chains of its textures, as colours and as numbers; `None` for those that no material
/// reads so.
///
/// They belong to the models, not to a picture: whoever renders several of the same models builds them once.
#[derive(Debug)]
pub struct Textures<'a> {
    chains: Vec<Vec<[Option<MipChain<'a>>; 2]>>,
    /// For each model of the scene whose chains are its: models that are there several times share them.
    of_models: Vec<usize>,
}

impl<'a> Textures<'a> {
    /// Builds the chains.
    #[must_use]
    pub fn of(models: &'a [ModelInstance]) -> Self {
        let mut known: BTreeMap<*const Model, usize> = BTreeMap::new();
        let mut all = Vec::new();
        let number = |placed: &'a ModelInstance| {
            *known.entry(Arc::as_ptr(&placed.model)).or_insert_with(|| {
                all.push(chains(&placed.model));
                all.len() - 1
            })
        };
        let of_models = models.iter().map(number).collect();
        Self { chains: all, of_models }
    }

    /// The chain of a texture of the scene's n-th model, for a slot of a material.
    pub(super) fn chain(
        &self,
        model: usize,
        slot: TextureSlot,
        texture: usize,
    ) -> Option<&MipChain<'a>> {
        self.chains.get(*self.of_models.get(model)?)?.get(texture)?[usize::from(!slot.is_color())]
            .as_ref()
    }
}

fn chains(model: &Model) -> Vec<[Option<MipChain<'_>>; 2]> {
    let mut used = vec![[false; 2]; model.textures.len()];
    for (slot, texture) in model.materials.iter().flat_map(Material::textures) {
        used[texture.texture][usize::from(!slot.is_color())] = true;
    }
    let image =
        |texture: &Texture| -> Option<&Image> { model.images.get(texture.image?)?.as_ref() };
    let chain = |texture: &Texture, texels: Texels, used: bool| {
        let image = used.then(|| image(texture)).flatten();
        image.map(|image| MipChain::new(image, texture.sampler, texels))
    };
    let both = |(texture, [color, number]): (&Texture, [bool; 2])| {
        [chain(texture, Texels::Srgb, color), chain(texture, Texels::Linear, number)]
    };
    model.textures.iter().zip(used).map(both).collect()
}
