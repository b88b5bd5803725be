//! Mip chains: the textures of a scene's models, prefiltered at all levels. They are built once and
//! shared by all renderings.
//!
//! ```text
//!  level 0  64 × 64   the image, decoded
//!  level 1  32 × 32   each texel is the mean of 2 × 2 texels, in linear light for colors
//!  …
//!  level 6   1 × 1
//! ```
//! A chain adds a third to the image's memory. An image may need two chains: texels of a color
//! texture are decoded from sRGB before they are averaged, while data is averaged directly.

use model::{Image, Material, Model, ModelInstance, Texture, TextureSlot};
use scene::Scene;
use shade::{MipChain, TexelEncoding};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The two chains of a texture: decoded from sRGB for colors, and linear for data such as normals
/// and roughness. Each is `None` if no material needs it.
type ColorAndData<'a> = [Option<MipChain<'a>>; 2];

/// The mip chains of all textures of a scene's models.
///
/// They belong to the models, not to a picture, so several renderings of the same models can share
/// them. Building them takes about as long as rendering a small picture.
#[derive(Debug)]
pub struct Textures<'a> {
    /// The chains of each distinct model, by texture index.
    mip_chains: Vec<Vec<ColorAndData<'a>>>,
    /// For each model instance of the scene, the index of its model's chains in `mip_chains`.
    chain_indices: Vec<usize>,
}

impl<'a> Textures<'a> {
    /// Builds the chains needed to render a scene. Line drawings need none, unless an inset shows
    /// surfaces.
    #[must_use]
    pub fn for_scene(scene: &'a Scene) -> Self {
        let insets = scene.insets.iter().map(|inset| &inset.scene);
        let draws_surfaces = |scene: &Scene| scene.style.draws_surfaces();
        let is_needed = std::iter::once(scene).chain(insets).any(draws_surfaces);
        Self::for_models(if is_needed { &scene.models } else { &[] })
    }

    /// Builds the chains of all textures that the models' materials use.
    #[must_use]
    pub fn for_models(models: &'a [ModelInstance]) -> Self {
        let mut known: BTreeMap<*const Model, usize> = BTreeMap::new();
        let mut mip_chains = Vec::new();
        let chain_index = |instance: &'a ModelInstance| {
            *known.entry(Arc::as_ptr(&instance.model)).or_insert_with(|| {
                mip_chains.push(build_mip_chains(&instance.model));
                mip_chains.len() - 1
            })
        };
        let chain_indices = models.iter().map(chain_index).collect();
        Self { mip_chains, chain_indices }
    }

    /// Copies the full images into the chains, so that a program can store the chains together with
    /// the models.
    #[must_use]
    pub fn into_owned(self) -> Textures<'static> {
        let own = |chains: ColorAndData<'_>| chains.map(|chain| chain.map(MipChain::into_owned));
        let own_model = |chains: Vec<ColorAndData<'_>>| chains.into_iter().map(own).collect();
        let mip_chains = self.mip_chains.into_iter().map(own_model).collect();
        Textures { mip_chains, chain_indices: self.chain_indices }
    }

    /// Returns the chain of a model's texture for a material slot. The model is identified by its
    /// index in the scene.
    pub(super) fn mip_chain(
        &self,
        model: usize,
        slot: TextureSlot,
        texture: usize,
    ) -> Option<&MipChain<'a>> {
        let chains = self.mip_chains.get(*self.chain_indices.get(model)?)?.get(texture)?;
        chains[usize::from(!slot.is_srgb())].as_ref()
    }
}

/// Builds the chains of one model's textures, as colors or data depending on the material slots
/// that use them.
fn build_mip_chains(model: &Model) -> Vec<ColorAndData<'_>> {
    let mut used = vec![[false; 2]; model.textures.len()];
    for (slot, texture) in model.materials.iter().flat_map(Material::visible_textures) {
        used[texture.texture][usize::from(!slot.is_srgb())] = true;
    }
    let image =
        |texture: &Texture| -> Option<&Image> { model.images.get(texture.image?)?.as_ref() };
    let chain = |texture: &Texture, encoding: TexelEncoding, is_used: bool| {
        let image = is_used.then(|| image(texture)).flatten();
        image.map(|image| MipChain::new(image, texture.sampler, encoding))
    };
    let color_and_data = |(texture, [color, data]): (&Texture, [bool; 2])| {
        [chain(texture, TexelEncoding::Srgb, color), chain(texture, TexelEncoding::Linear, data)]
    };
    model.textures.iter().zip(used).map(color_and_data).collect()
}
