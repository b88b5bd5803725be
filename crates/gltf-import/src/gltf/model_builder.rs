//! Model assembly: reads the parts of a document in this order:
//!
//! ```text
//!  1. scene graph    nodes, scenes, cameras, lights, materials, textures, skins, animations
//!  2. images         images that the JSON appears to need: read, then decoded by other threads
//!  3. geometry       meshes, variants, instances, while the images are decoded
//!  4. images         stored, or read again if the meshes turn out to need others
//! ```
//!
//! Each step needs only the results of earlier steps. Images come early because decoding takes
//! longest and is independent of everything else.

use super::accessor::AccessorReader;
use super::animation::{self, AnimatedObjects};
use super::document::GltfDocument;
use super::images::EncodedImages;
use super::{
    camera, gpu_instancing, images, lights, material, primitive, scalars, scene_graph, selection,
    skin, texture,
};
use crate::parallel_decoding::decode_images_alongside;
use crate::warnings::ImportWarnings;
use crate::{ImageLoading, ImportOptions};
use model::{Diagnostic, Model, Node};

/// Builds the model of a document. Images are decoded while the meshes are read.
///
/// The time of each step is added to the timings in the options, as `geometry` or `images`.
///
/// # Errors
/// Returns the first error that stops the import.
pub(super) fn build_model(
    document: &GltfDocument,
    source: &AccessorReader<'_>,
    options: &ImportOptions,
    warnings: &mut ImportWarnings,
) -> Result<Model, Diagnostic> {
    let timings = &options.timings;
    let build_graph = || build_scene_graph(document, source, options, warnings);
    let mut model = timings.measure("geometry", build_graph)?;
    let announced =
        timings.measure("images", || collect_announced_images(source, &model, options.images));
    let meshes = || build_meshes(document, source, options, &mut model, warnings);
    let geometry = || timings.measure("geometry", meshes);
    let ((), decoded) = decode_images_alongside(&announced.encoded, timings, geometry)?;
    let store = || {
        let loading = options.images;
        images::import_images(source, &mut model, announced, decoded, loading, warnings);
    };
    timings.measure("images", store);
    Ok(model)
}

/// Reads the images that will be visible according to the JSON.
fn collect_announced_images<'a>(
    source: &'a AccessorReader<'_>,
    model: &Model,
    image_loading: ImageLoading,
) -> EncodedImages<'a> {
    match image_loading {
        ImageLoading::Decode => EncodedImages::read_needed(
            source,
            images::announced_images(source.root, model, model.active_variant),
        ),
        ImageLoading::Headers => EncodedImages::default(),
    }
}

/// Reads everything except meshes and images.
///
/// References to invalid skins and cameras are cleared, so that every index in the nodes is valid.
/// The order follows the dependencies: lights are attached to nodes, and animations check their
/// targets against nodes, materials, lights and cameras.
fn build_scene_graph(
    document: &GltfDocument,
    source: &AccessorReader<'_>,
    options: &ImportOptions,
    warnings: &mut ImportWarnings,
) -> Result<Model, Diagnostic> {
    let root = &document.root;
    let mut nodes = scene_graph::import_nodes(document, source.limits, warnings)?;
    let active_scene = selection::select_scene(root, options.scene.as_ref(), warnings)?;
    let (cameras, usable) = camera::import_cameras(root, warnings);
    let mut model = Model {
        roots: scene_graph::scene_roots(root, active_scene, &nodes, warnings)?,
        scenes: scene_graph::import_scenes(root),
        active_scene: (active_scene < root.scenes.len()).then_some(active_scene),
        lights: lights::import_lights(root, &mut nodes, warnings),
        nodes,
        materials: material::import_materials(root, warnings),
        textures: texture::import_textures(root, warnings),
        cameras,
        skins: skin::import_skins(source, warnings)?,
        variants: selection::variant_names(root),
        scalar_attributes: scalars::scalar_attributes(root),
        extensions_used: sorted_names(&root.extensions_used),
        extensions_required: sorted_names(&root.extensions_required),
        ..Model::default()
    };
    build_animations(document, source, &mut model, warnings)?;
    drop_dangling_references(&mut model, &usable);
    let chosen =
        options.variant.as_ref().map(|choice| selection::select_variant(&model.variants, choice));
    model.active_variant = chosen.transpose()?;
    Ok(model)
}

/// Reads the animations. KHR_animation_pointer may add texture transforms to the model.
///
/// This borrows disjoint fields of the model, some of them mutably, which a method on the model
/// could not do.
fn build_animations(
    document: &GltfDocument,
    source: &AccessorReader<'_>,
    model: &mut Model,
    warnings: &mut ImportWarnings,
) -> Result<(), Diagnostic> {
    let mut targets = AnimatedObjects {
        nodes: &model.nodes,
        materials: &mut model.materials,
        lights: &model.lights,
        cameras: &model.cameras,
        uv_transforms: &mut model.uv_transforms,
    };
    let pointers = &document.untyped.pointer_channels;
    model.animations = animation::import_animations(source, pointers, &mut targets, warnings)?;
    Ok(())
}

/// Reads the meshes, with the materials of the active variant or the colors of a scalar attribute,
/// and their instances.
///
/// The limit on scene items is checked at the end, when the number of instances is known.
fn build_meshes(
    document: &GltfDocument,
    source: &AccessorReader<'_>,
    options: &ImportOptions,
    model: &mut Model,
    warnings: &mut ImportWarnings,
) -> Result<(), Diagnostic> {
    let mut values = scalars::CollectedScalars::new(options.scalars.as_ref(), model)?;
    let context = primitive::PrimitiveContext {
        materials: &model.materials,
        variants: model.variants.len(),
        untyped: &document.untyped,
    };
    model.meshes = primitive::import_meshes(source, context, &mut values, warnings)?;
    if let Some(variant) = model.active_variant {
        selection::apply_variant(&mut model.meshes, variant);
    }
    if let Some(colors) = &options.scalars {
        values.color_primitives(colors, model, warnings);
    }
    material::warn_of_missing_texcoords(model, warnings);
    gpu_instancing::import_instances(source, &mut model.nodes, warnings)?;
    scene_graph::check_scene_items(model, source.limits)
}

/// Clears references from nodes to skipped skins and cameras.
///
/// Lights do not need this, because they are attached only if they are valid.
fn drop_dangling_references(model: &mut Model, usable_cameras: &[bool]) {
    let Model { nodes, skins, .. } = model;
    for Node { skin, camera, .. } in nodes {
        *skin = skin.filter(|&at| !skins[at].joints.is_empty());
        *camera = camera.filter(|&at| usable_cameras[at]);
    }
}

/// Returns the extension names in alphabetical order, without duplicates.
fn sorted_names(names: &[String]) -> Vec<String> {
    let mut names = names.to_vec();
    names.sort();
    names.dedup();
    names
}
