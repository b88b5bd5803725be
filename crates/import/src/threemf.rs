//! The 3MF importer (3D Manufacturing Format, core specification 1.3): packages of printable
//! objects.
//!
//! ```text
//!  bytes ──archive──► entries ──package──► model part ──model_part──► objects, properties, items
//!                                          other parts (production)          │
//!                                          textures                  assembly ▼
//!                                                                        nodes, meshes
//! ```
//!
//! Our own zip and XML readers support only what 3MF needs, which excludes encryption, custom
//! entities and file paths. The core specification and the extensions for materials and production
//! are supported; `namespaces` lists the extensions that are skipped.

mod archive;
mod assembly;
mod model_part;
mod namespaces;
mod object;
mod package;
mod properties;
#[cfg(test)]
mod tests;
mod xml;

use super::text::decode_text;
use assembly::{Assembly, Placement};
use gltf_import::ImportOptions;
use gltf_import::ImportWarnings;
use gltf_import::UriResolver;
use gltf_import::{TextureImage, store_images};
use model::{Diagnostic, Model, TextureInfo, UpAxis};
use model_part::{ModelPart, ObjectReference, PartReader};
use package::Package;
use properties::Palette;
use std::collections::BTreeMap;
use std::path::Path;

/// The referenced model parts of a package, starting with the main part.
#[derive(Debug, Default)]
struct Parts {
    parts: Vec<ModelPart>,
    /// The index of each part by entry name.
    by_name: BTreeMap<String, usize>,
}

/// Imports a 3MF file from its bytes.
pub(super) fn import_threemf(
    _path: &Path,
    bytes: &[u8],
    resolver: &UriResolver<'_>,
    options: &ImportOptions,
) -> Result<Model, Diagnostic> {
    let mut warnings = ImportWarnings::new(options.lenient);
    let package = Package::from_bytes(bytes, resolver.limits, &mut warnings)?;
    let mut palette = Palette::default();
    let timings = &options.timings;
    let read = || read_parts(&package, &mut palette, &mut warnings);
    let mut parts = timings.measure("parse", read)?;
    let mut model =
        Model { length_unit: parts.parts[0].unit, up_axis: UpAxis::Z, ..Model::default() };
    let (mut assembly, items) = assemble(&package, &parts, &mut warnings)?;
    // Counted before anything is built: a few components can multiply to millions of nodes.
    assembly.count_nodes(&items, &package, resolver.limits, &mut warnings)?;
    timings.measure("geometry", || {
        let crease_angle = options.crease_degrees();
        let mut index = 0;
        for part in &mut parts.parts {
            for object in &mut part.objects {
                let mesh = object.content.mesh.take();
                if let Some(mesh) = mesh.filter(|_| assembly.is_built(index)) {
                    package.charge_bytes(&object.location, mesh.array_bytes())?;
                    assembly.set_mesh(index, model.meshes.len());
                    let properties = &part.properties;
                    let mesh = mesh.into_mesh(
                        object,
                        properties,
                        &mut palette,
                        crease_angle,
                        &mut warnings,
                    );
                    model.meshes.push(mesh);
                }
                index += 1;
            }
        }
        assembly.build_nodes(&items, &mut model, &mut warnings)
    })?;
    store_palette(&mut model, palette, &package, options, &mut warnings);
    model.warnings = warnings.into_list();
    Ok(model)
}

/// Reads the model part and the parts it refers to, directly or indirectly.
fn read_parts(
    package: &Package<'_>,
    palette: &mut Palette,
    warnings: &mut ImportWarnings,
) -> Result<Parts, Diagnostic> {
    let mut parts = Parts::default();
    let main = package.model_part(warnings)?;
    let mut queue = vec![(main, "_rels/.rels".to_owned())];
    let mut next = 0;
    while let Some((name, location)) = queue.get(next).cloned() {
        next += 1;
        let entry = package.part_name(&name).unwrap_or(&name).to_owned();
        if parts.by_name.contains_key(&entry) {
            continue;
        }
        let content = match package.read_part(&name, &location) {
            Ok(content) => content,
            // Without the main part there is nothing to show.
            Err(fault) if parts.parts.is_empty() => return Err(fault),
            Err(fault) => {
                warnings.downgrade_if_lenient(fault, "it is skipped")?;
                continue;
            }
        };
        let text = decode_text(&content);
        let part = PartReader::new(&text, &entry, package, palette, warnings).read_part()?;
        let references = || {
            let components = part.objects.iter().flat_map(|object| &object.content.components);
            part.items.iter().chain(components)
        };
        for reference in references() {
            // References to the same part are usually adjacent; each part is read only once in any
            // case.
            if let Some(path) = &reference.path
                && queue.last().is_none_or(|(last, _)| last != path)
            {
                queue.push((path.clone(), reference.location.clone()));
            }
        }
        if parts.parts.first().is_some_and(|main| main.unit != part.unit) {
            let message = "the part's unit differs from the model's; the model's unit is used";
            warnings.push_warning(&entry, message);
        }
        parts.by_name.insert(entry, parts.parts.len());
        parts.parts.push(part);
    }
    Ok(parts)
}

/// Resolves the references between objects. The second result lists the items to build.
fn assemble(
    package: &Package<'_>,
    parts: &Parts,
    warnings: &mut ImportWarnings,
) -> Result<(Assembly, Vec<Placement>), Diagnostic> {
    let mut assembly = Assembly::default();
    // All objects are added first, because components may refer to later parts.
    for (at, part) in parts.parts.iter().enumerate() {
        for object in &part.objects {
            assembly.push_object(at, object);
        }
    }
    let part_of = |own: usize| {
        move |reference: &ObjectReference| match &reference.path {
            Some(path) => parts.by_name.get(package.part_name(path)?).copied(),
            None => Some(own),
        }
    };
    let mut index = 0;
    for (at, part) in parts.parts.iter().enumerate() {
        for object in &part.objects {
            let references = &object.content.components;
            let components = assembly.resolve(references, part_of(at), warnings)?;
            assembly.set_components(index, components);
            index += 1;
        }
    }
    let build = &parts.parts[0].items;
    let mut items = assembly.resolve(build, part_of(0), warnings)?;
    if build.is_empty() && index > 0 {
        warnings.push_warning("", "the build section is empty; all objects are shown");
        items = assembly.top_objects();
    }
    Ok((assembly, items))
}

/// Adds the materials, textures and visible images to the model.
fn store_palette(
    model: &mut Model,
    palette: Palette,
    package: &Package<'_>,
    options: &ImportOptions,
    warnings: &mut ImportWarnings,
) {
    model.materials = palette.materials;
    model.textures = palette.textures;
    let image_of = |info: &TextureInfo| model.textures[info.texture].image;
    let mut is_needed = vec![false; palette.images.len()];
    for primitive in model.meshes.iter().flat_map(|mesh| &mesh.primitives) {
        let material = primitive.material.and_then(|at| model.materials.get(at));
        let texture = material.and_then(|material| material.base_color_texture);
        if let Some(image) = texture.as_ref().and_then(image_of) {
            is_needed[image] = true;
        }
    }
    let image = |((path, location), is_needed): ((String, String), bool)| {
        let bytes = is_needed.then(|| package.read_part(&path, &location));
        TextureImage { name: path, location, bytes }
    };
    let images = palette.images.into_iter().zip(is_needed).map(image).collect();
    store_images(model, images, options, warnings);
    let Model { materials, textures, image_infos, .. } = model;
    for material in materials {
        // Textures without a readable image are removed, which leaves their materials white.
        let is_readable = |info: &TextureInfo| {
            let image = textures[info.texture].image.and_then(|image| image_infos.get(image));
            image.is_some_and(|image| image.header.is_some())
        };
        material.base_color_texture = material.base_color_texture.filter(is_readable);
    }
}
