//! The PLY importer (Stanford polygon format): text, and binary in both byte orders.
//!
//! ```text
//!  header ──► elements and properties ─┬─ vertex      positions, normals, uvs, colors
//!                                      ├─ face        polygons, uvs of corners, colors
//!                                      ├─ tristrips   triangles
//!                                      ├─ edge        lines
//!                                      └─ others      skipped
//! ```
//!
//! A file without faces, strips or edges is a point cloud. Colors of every type are sRGB and are
//! converted to linear light. Texture coordinates have their origin at the lower left, and are
//! flipped. A property without a predefined meaning, such as `quality`, can be shown as colors.
//! Vertices are split where faces or corners have different attributes.

mod body;
mod faces;
mod header;
mod primitives;
#[cfg(test)]
mod tests;
mod vertices;

use body::Body;
pub(super) use faces::Faces;
use gltf_import::ImportWarnings;
use gltf_import::MemoryBudget;
use gltf_import::UriResolver;
use gltf_import::{ImportOptions, ScalarColors};
use gltf_import::{TextureImage, store_images};
use header::Header;
use model::{AlphaMode, Diagnostic, Material, Mesh, Model, Node, Sampler, Texture, TextureInfo};
pub(super) use primitives::{array_bytes, build_primitives};
use std::path::Path;
pub(super) use vertices::Vertices;

/// The content of a file's body.
#[derive(Default, Debug)]
pub(super) struct Contents {
    pub(super) vertices: Vertices,
    pub(super) faces: Faces,
    pub(super) strips: Faces,
    pub(super) edges: Vec<u32>,
}

impl Contents {
    /// Returns the material for untextured parts, which leaves vertex and face colors unchanged.
    fn untextured_material(&self) -> Material {
        let plain = Material::plain();
        let Some(colors) = self.vertices.colors.as_ref().or(self.faces.colors.as_ref()) else {
            return plain;
        };
        let is_translucent = colors.iter().any(|color| color[3] < 1.0);
        let alpha_mode = if is_translucent { AlphaMode::Blend } else { AlphaMode::Opaque };
        Material { alpha_mode, ..Material::white() }
    }

    /// Colors the vertices by their scalars. Textures and the colors in the file are then ignored.
    fn color_by_scalars(&mut self, colors: &ScalarColors, warnings: &mut ImportWarnings) {
        let values = self.vertices.scalars.take().unwrap_or_default();
        let colored = colors.color_arrays(&[&values[..]], "element vertex", warnings);
        self.vertices.colors = Some(colored.concat());
        (self.vertices.uvs, self.faces.uvs) = (None, None);
    }
}

/// Imports a PLY file from its bytes.
pub(super) fn import_ply(
    _path: &Path,
    bytes: &[u8],
    resolver: &UriResolver<'_>,
    options: &ImportOptions,
) -> Result<Model, Diagnostic> {
    let mut warnings = ImportWarnings::new(options.lenient);
    let header = Header::from_bytes(bytes)?;
    for (line, text) in &header.stray_lines {
        let message = format!("`{text}` is not a line of a PLY header; it is treated as a comment");
        warnings.push_warning(&format!("line {line}"), message);
    }
    let scalar_attributes = vertices::scalar_attributes(&header);
    let chosen = options.scalars.as_ref();
    let chosen = chosen.map(|colors| colors.find_among(&scalar_attributes, "element vertex"));
    let scalar = chosen.transpose()?.map(|index| scalar_attributes[index].as_str());
    let read = || read_body(bytes, &header, scalar, &mut warnings);
    let mut contents = options.timings.measure("parse", read)?;
    if let Some(colors) = &options.scalars {
        contents.color_by_scalars(colors, &mut warnings);
    }
    let mut model = Model { scalar_attributes, ..Model::default() };
    let textures = read_textures(&header, &contents, resolver);
    build_materials(&mut model, textures, &contents, options, &mut warnings);
    let budget = MemoryBudget::new(resolver.limits);
    let charge = |bytes: u64| budget.charge_bytes("", bytes, resolver.total_bytes());
    // Charge the budget now: building the primitives multiplies the memory that the arrays take.
    charge(array_bytes(&contents))?;
    let build = || build_primitives(contents, &model, options, &mut warnings);
    let primitives = options.timings.measure("geometry", build);
    let primitives = primitives.into_iter().filter(|primitive| primitive.item_count() > 0);
    let primitives: Vec<_> = primitives.collect();
    model.meshes.push(Mesh { primitives, ..Mesh::default() });
    model.nodes.push(Node { mesh: Some(0), ..Node::default() });
    model.roots.push(0);
    model.warnings = warnings.into_list();
    Ok(model)
}

/// Reads all elements in order. Unknown elements are skipped. `scalar` is the property that is read
/// as the scalar of each vertex.
fn read_body(
    bytes: &[u8],
    header: &Header,
    scalar: Option<&str>,
    warnings: &mut ImportWarnings,
) -> Result<Contents, Diagnostic> {
    // Counts come from the file, and their sum may overflow.
    let records = header.elements.iter().fold(0, |sum: u64, it| sum.saturating_add(it.count));
    let body = Body::new(bytes, header.body, header.encoding);
    let mut body = body.with_records(records);
    let count = header.elements.iter().find(|element| element.name == "vertex");
    let count = count.map_or(0, |element| element.count);
    let mut contents = Contents::default();
    for element in &header.elements {
        let read = match element.name.as_str() {
            // A second vertex element must not replace the first.
            "vertex" if contents.vertices.positions.is_empty() => {
                vertices::read_vertices(&mut body, element, scalar, warnings)
                    .map(|vertices| contents.vertices = vertices)
            }
            "face" => faces::read_faces(&mut body, element, count, warnings)
                .map(|faces| contents.faces = faces),
            "tristrips" => faces::read_strips(&mut body, element, count, warnings)
                .map(|strips| contents.strips = strips),
            "edge" => faces::read_edges(&mut body, element, count, warnings)
                .map(|edges| contents.edges = edges),
            _ => body.skip_element(element),
        };
        if let Err(fault) = read {
            warnings.downgrade_if_lenient(fault, "the rest of the file is skipped")?;
            break;
        }
    }
    if let Some((place, message)) = body.longer_records() {
        warnings.push_warning(place, message);
    }
    let without_area = contents.faces.without_area;
    if without_area > 0 {
        let message = match without_area {
            1 => "a face with fewer than three corners is skipped".to_owned(),
            _ => format!("{without_area} faces with fewer than three corners are skipped"),
        };
        warnings.push_warning("element face", message);
    }
    Ok(contents)
}

/// Reads the texture files that the header names if there are texture coordinates for them.
fn read_textures<'a>(
    header: &Header,
    contents: &Contents,
    resolver: &UriResolver<'_>,
) -> Vec<TextureImage<'a>> {
    if contents.vertices.uvs.is_none() && contents.faces.uvs.is_none() {
        return Vec::new();
    }
    let read = |name: &String| {
        let location = "comment TextureFile".to_owned();
        let bytes = Some(resolver.read_uri(name, &location).map(Into::into));
        TextureImage { name: name.clone(), location, bytes }
    };
    header.texture_files.iter().map(read).collect()
}

/// Adds a material for each texture to the model, or an untextured material if there are none.
///
/// Vertex and face colors multiply the material color. A surface whose texture was loaded shows
/// only the texture colors, as in the programs that write such files.
fn build_materials(
    model: &mut Model,
    textures: Vec<TextureImage<'_>>,
    contents: &Contents,
    options: &ImportOptions,
    warnings: &mut ImportWarnings,
) {
    let count = textures.len();
    store_images(model, textures, options, warnings);
    let untextured = contents.untextured_material();
    for image in 0..count {
        model.textures.push(Texture { image: Some(image), sampler: Sampler::default() });
        let info = &model.image_infos[image];
        let textured = || Material {
            base_color: [1.0; 4],
            base_color_texture: Some(TextureInfo {
                texture: image,
                uv_set: 0,
                uv_matrix: TextureInfo::IDENTITY_UV,
            }),
            ..Material::plain()
        };
        let material = info.header.map_or_else(|| untextured.clone(), |_| textured());
        model.materials.push(Material { name: info.uri.clone(), ..material });
    }
    if count == 0 {
        model.materials.push(untextured);
    }
}
