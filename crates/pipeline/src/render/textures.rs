//! The textures of a scene, each with its mip chain, built once before drawing.

use crate::model::{Image, Model, Texture};
use crate::scene::Placed;
use crate::shade::MipChain;

/// For each model of a scene, the mip chains of its textures; `None` for those that no material reads.
///
/// They belong to the models, not to a picture: whoever renders several of the same models builds them once.
#[derive(Debug)]
pub struct Textures<'a> {
    chains: Vec<Vec<Option<MipChain<'a>>>>,
}

impl<'a> Textures<'a> {
    /// Builds the chains.
    #[must_use]
    pub fn of(models: &'a [Placed]) -> Self {
        Self { chains: models.iter().map(|placed| chains(&placed.model)).collect() }
    }

    /// The chain of a texture of the scene's n-th model.
    pub(super) fn chain(&self, model: usize, texture: usize) -> Option<&MipChain<'a>> {
        self.chains.get(model)?.get(texture)?.as_ref()
    }
}

fn chains(model: &Model) -> Vec<Option<MipChain<'_>>> {
    let mut used = vec![false; model.textures.len()];
    for material in &model.materials {
        for texture in material.textures() {
            used[texture.texture] = true;
        }
    }
    let image =
        |texture: &Texture| -> Option<&Image> { model.images.get(texture.image?)?.as_ref() };
    let chain = |(texture, used): (&Texture, bool)| {
        used.then(|| image(texture)).flatten().map(|image| MipChain::new(image, texture.sampler))
    };
    model.textures.iter().zip(used).map(chain).collect()
}
