//! From a document to a model: one step for each part, in an order in which each finds what it needs.

use super::accessor::Source;
use super::animation::{self, Targets};
use super::decoding::decode_beside;
use super::error::Fault;
use super::image::Found;
use super::json::Document;
use super::warnings::Warnings;
use super::{
    Images, ImportOptions, camera, choice, image, instancing, lights, material, primitive, scene,
    skin, texture,
};
use crate::{Model, Node};

/// Builds the model of a document. The images are decoded while the meshes are read.
pub(super) fn build(
    document: &Document,
    source: &Source<'_>,
    options: &ImportOptions,
    warnings: &mut Warnings,
) -> Result<Model, Fault> {
    let timings = &options.timings;
    let outline = || outline(document, source, options, warnings);
    let mut model = timings.measure("geometry", outline)?;
    let early = timings.measure("images", || early_images(source, &model, options.images));
    let geometry = || timings.measure("geometry", || shape(document, source, &mut model, warnings));
    let ((), decoded) = decode_beside(&early.encoded, timings, geometry)?;
    let early = (early, decoded);
    let place = || image::images(source, &mut model, early, options.images, warnings);
    timings.measure("images", place);
    Ok(model)
}

fn early_images<'a>(source: &'a Source<'_>, model: &Model, what: Images) -> Found<'a> {
    match what {
        Images::Decode => Found::read(source, image::announced(source.root, model, model.variant)),
        Images::Headers => Found::default(),
    }
}

/// Everything but the meshes and the images.
fn outline(
    document: &Document,
    source: &Source<'_>,
    options: &ImportOptions,
    warnings: &mut Warnings,
) -> Result<Model, Fault> {
    let root = &document.root;
    let mut nodes = scene::nodes(document, source.limits, warnings)?;
    let shown = choice::scene(root, options.scene.as_ref(), warnings)?;
    let (cameras, usable) = camera::cameras(root, warnings);
    let mut model = Model {
        roots: scene::roots(root, shown, &nodes, warnings)?,
        scenes: scene::scenes(root),
        scene: (shown < root.scenes.len()).then_some(shown),
        lights: lights::lights(root, &mut nodes, warnings),
        nodes,
        materials: material::materials(root, warnings),
        textures: texture::textures(root, warnings),
        cameras,
        skins: skin::skins(source, warnings)?,
        variants: choice::variants(root),
        extensions_used: sorted(&root.extensions_used),
        extensions_required: sorted(&root.extensions_required),
        ..Model::default()
    };
    animate(document, source, &mut model, warnings)?;
    drop_lost_references(&mut model, &usable);
    let chosen = options.variant.as_ref().map(|choice| choice::variant(&model.variants, choice));
    model.variant = chosen.transpose()?;
    Ok(model)
}

fn animate(
    document: &Document,
    source: &Source<'_>,
    model: &mut Model,
    warnings: &mut Warnings,
) -> Result<(), Fault> {
    let mut targets = Targets {
        nodes: &model.nodes,
        materials: &mut model.materials,
        lights: &model.lights,
        cameras: &model.cameras,
        uv_transforms: &mut model.uv_transforms,
    };
    let pointers = &document.untyped.pointers;
    model.animations = animation::animations(source, pointers, &mut targets, warnings)?;
    Ok(())
}

/// The meshes, in the materials of the chosen variant, and where they stand.
fn shape(
    document: &Document,
    source: &Source<'_>,
    model: &mut Model,
    warnings: &mut Warnings,
) -> Result<(), Fault> {
    let context = primitive::Context {
        materials: &model.materials,
        variants: model.variants.len(),
        untyped: &document.untyped,
    };
    model.meshes = primitive::meshes(source, context, warnings)?;
    if let Some(variant) = model.variant {
        choice::dress(&mut model.meshes, variant);
    }
    material::warn_of_missing_texcoords(model, warnings);
    instancing::read(source, &mut model.nodes, warnings)?;
    scene::check_items(model, source.limits)
}

/// Nodes do not name skins and cameras that have been left out.
fn drop_lost_references(model: &mut Model, usable_cameras: &[bool]) {
    let Model { nodes, skins, .. } = model;
    for Node { skin, camera, .. } in nodes {
        *skin = skin.filter(|&at| !skins[at].joints.is_empty());
        *camera = camera.filter(|&at| usable_cameras[at]);
    }
}

fn sorted(names: &[String]) -> Vec<String> {
    let mut names = names.to_vec();
    names.sort();
    names.dedup();
    names
}
