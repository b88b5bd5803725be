//! 3MF properties: the colors and materials that triangles refer to by group and index.
//!
//! ```text
//!  basematerials         a material for each base, with its display color
//!  colorgroup            corner colors
//!  texture2dgroup        corner texture coordinates
//!  compositematerials    the mean of base colors, weighted by their proportions
//!  multiproperties       layers: the last texture, or the mixture of colors
//! ```
//!
//! Groups are resolved when they are read, because each may refer only to earlier groups; a
//! triangle then needs a single lookup. Colors are sRGB in the file and linear here.

use super::xml::Element;
use crate::text::{TextScanner, parse_f32, parse_integer};
use gltf_import::linear_table;
use model::{AlphaMode, Material, Sampler, Texture, TextureFilter, TextureInfo, WrapMode};
use std::collections::BTreeMap;

/// The maximum number of layers in multiproperties. Each entry of a group is mixed from all layers.
const MAX_LAYERS: usize = 64;

/// The property at a corner of a triangle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Property {
    /// Index of the material in the model.
    pub(super) material: u32,
    /// Linear color that multiplies the material's color.
    pub(super) color: [f32; 4],
    /// Texture coordinates with (0, 0) at the upper left.
    pub(super) uv: [f32; 2],
}

/// The kind of a group, for groups that refer to it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum GroupKind {
    Base,
    Color,
    Texture,
    Composite,
    Multi,
}

/// A group of properties.
#[derive(Debug)]
pub(super) struct PropertyGroup {
    pub(super) kind: GroupKind,
    pub(super) entries: Vec<Property>,
}

/// The groups and textures of one model part, by id.
#[derive(Debug, Default)]
pub(super) struct PartProperties {
    groups: Vec<PropertyGroup>,
    /// The index of each group, by id.
    group_of: BTreeMap<u32, u32>,
    /// The material that shows each texture, by texture id.
    textures: BTreeMap<u32, u32>,
    /// Lists of (metalness, roughness) pairs.
    metallic: Vec<Vec<[f32; 2]>>,
    /// The index of each list, by id.
    metallic_of: BTreeMap<u32, u32>,
}

/// The materials and textures of all parts.
#[derive(Debug, Default)]
pub(super) struct Palette {
    pub(super) materials: Vec<Material>,
    pub(super) textures: Vec<Texture>,
    /// The texture images: the part name, and the location of its first reference.
    pub(super) images: Vec<(String, String)>,
    /// The index of each image, by part name.
    image_of: BTreeMap<String, usize>,
    /// The material for surfaces without properties, if there are any.
    plain: Option<u32>,
    /// The materials for colored corners: opaque and blended.
    colored: [Option<u32>; 2],
}

impl Palette {
    /// Adds a material and returns its index.
    pub(super) fn push_material(&mut self, material: Material) -> u32 {
        self.materials.push(material);
        self.materials.len() as u32 - 1
    }

    /// Adds an image, unless it has already been added, and returns its index.
    fn push_image(&mut self, path: String, location: String) -> usize {
        *self.image_of.entry(path).or_insert_with_key(|path| {
            self.images.push((path.clone(), location));
            self.images.len() - 1
        })
    }

    /// Returns the material for surfaces without properties.
    pub(super) fn plain_material(&mut self) -> u32 {
        let material = self.plain.unwrap_or_else(|| self.push_material(Material::plain()));
        *self.plain.insert(material)
    }

    /// Returns whether a material has a texture.
    pub(super) fn has_texture(&self, material: u32) -> bool {
        let material = self.materials.get(material as usize);
        material.is_some_and(|material| material.base_color_texture.is_some())
    }

    /// Returns the material that shows corner colors.
    fn colored_material(&mut self, is_blended: bool) -> u32 {
        if let Some(material) = self.colored[usize::from(is_blended)] {
            return material;
        }
        let alpha_mode = if is_blended { AlphaMode::Blend } else { AlphaMode::Opaque };
        let material = self.push_material(Material { alpha_mode, ..white() });
        self.colored[usize::from(is_blended)] = Some(material);
        material
    }

    /// Returns the color of a property without its texture.
    fn color_of(&self, property: &Property) -> [f32; 4] {
        let base =
            self.materials.get(property.material as usize).map_or([1.0; 4], |m| m.base_color);
        std::array::from_fn(|at| base[at] * property.color[at])
    }
}

/// Returns the material for surfaces colored by corners or a texture.
fn white() -> Material {
    Material { base_color: [1.0; 4], ..Material::plain() }
}

/// Parses `#RRGGBB` or `#RRGGBBAA`. An alpha of 0 is read as 1: programs that write it mean opaque,
/// because invisible parts are never printed.
pub(super) fn parse_color(text: &[u8]) -> Option<[f32; 4]> {
    let digits = text.strip_prefix(b"#")?;
    if !matches!(digits.len(), 6 | 8) {
        return None;
    }
    let mut rgba = [255; 4];
    for (channel, pair) in rgba.iter_mut().zip(digits.as_chunks::<2>().0) {
        let digit = |byte: u8| char::from(byte).to_digit(16);
        *channel = (digit(pair[0])? * 16 + digit(pair[1])?) as u8;
    }
    if rgba[3] == 0 {
        rgba[3] = 255;
    }
    let linear = |channel: usize| linear_table()[usize::from(rgba[channel])];
    Some([linear(0), linear(1), linear(2), f32::from(rgba[3]) / 255.0])
}

/// Parses the id in an attribute.
pub(super) fn parse_id(element: &Element<'_>, name: &str) -> Option<u32> {
    parse_integer(element.attribute(name)?).and_then(|id| id.try_into().ok())
}

/// Parses the number in an attribute, if it is finite.
pub(super) fn parse_number(element: &Element<'_>, name: &str) -> Option<f32> {
    element.attribute(name).and_then(parse_f32).filter(|number| number.is_finite())
}

/// Parses a list of numbers.
fn parse_list<T>(text: &[u8], parse: impl Fn(&[u8]) -> Option<T>) -> Option<Vec<T>> {
    let mut scanner = TextScanner::new(text);
    std::iter::from_fn(|| scanner.next_token()).map(|token| parse(token.bytes)).collect()
}

/// Parses a list of indices.
fn parse_indices(text: &[u8]) -> Option<Vec<u32>> {
    parse_list(text, |token| parse_integer(token)?.try_into().ok())
}

/// A group that is being read, with the data from its start tag.
#[derive(Debug)]
pub(super) enum OpenGroup {
    Base { metallic: Option<u32> },
    Color,
    Texture { material: u32 },
    Composite { bases: Vec<[f32; 4]> },
    Multi { layers: Vec<Layer> },
    Metallic,
}

/// A layer of multiproperties.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layer {
    /// Id of the layer's group.
    id: u32,
    /// Whether the layer multiplies the layers below instead of covering them.
    multiplies: bool,
}

impl PartProperties {
    /// Returns the group with an id.
    pub(super) fn group(&self, id: u32) -> Option<&PropertyGroup> {
        self.group_of.get(&id).and_then(|&at| self.groups.get(at as usize))
    }

    /// Adds a texture.
    pub(super) fn add_texture(
        &mut self,
        element: &Element<'_>,
        location: String,
        palette: &mut Palette,
    ) {
        let (Some(id), Some(path)) = (parse_id(element, "id"), element.text_attribute("path"))
        else {
            return;
        };
        let wrap = |name: &str| match element.attribute(name) {
            Some(b"mirror") => WrapMode::MirroredRepeat,
            Some(b"clamp" | b"none") => WrapMode::ClampToEdge,
            _ => WrapMode::Repeat,
        };
        let mut sampler = Sampler {
            wrap_u: wrap("tilestyleu"),
            wrap_v: wrap("tilestylev"),
            ..Sampler::default()
        };
        if element.attribute("filter") == Some(b"nearest") {
            sampler.mag_filter = TextureFilter::Nearest;
        }
        let texture = palette.textures.len();
        let image = palette.push_image(path, location);
        palette.textures.push(Texture { image: Some(image), sampler });
        let info = TextureInfo { texture, uv_set: 0, uv_matrix: TextureInfo::IDENTITY_UV };
        let material =
            palette.push_material(Material { base_color_texture: Some(info), ..white() });
        self.textures.insert(id, material);
    }

    /// Opens the group that a start tag begins. Returns an error message if its references are
    /// invalid.
    pub(super) fn open_group(
        &self,
        element: &Element<'_>,
        palette: &Palette,
    ) -> Result<Option<OpenGroup>, String> {
        let no_group = |id: u32| format!("there is no group {id} before this one");
        Ok(Some(match element.local_name() {
            "basematerials" => {
                OpenGroup::Base { metallic: parse_id(element, "displaypropertiesid") }
            }
            "colorgroup" => OpenGroup::Color,
            "pbmetallicdisplayproperties" => OpenGroup::Metallic,
            "texture2dgroup" => {
                let id = parse_id(element, "texid").ok_or("the group has no texid")?;
                let texture = self.textures.get(&id);
                let texture =
                    texture.ok_or_else(|| format!("there is no texture {id} before this group"))?;
                OpenGroup::Texture { material: *texture }
            }
            "compositematerials" => {
                let id = parse_id(element, "matid").ok_or("the group has no matid")?;
                let group = self.group(id).filter(|group| group.kind == GroupKind::Base);
                let group = group.ok_or_else(|| no_group(id))?;
                let indices = element.attribute("matindices").and_then(parse_indices);
                let indices = indices.ok_or("matindices is not a list of numbers")?;
                let base =
                    |&index: &u32| group.entries.get(index as usize).map(|p| palette.color_of(p));
                let bases: Option<Vec<_>> = indices.iter().map(base).collect();
                let bases = bases.ok_or("matindices refers to a material that does not exist")?;
                OpenGroup::Composite { bases }
            }
            "multiproperties" => {
                let ids = element.attribute("pids").and_then(parse_indices);
                let ids = ids.ok_or("pids is not a list of numbers")?;
                let methods = element.text_attribute("blendmethods").unwrap_or_default();
                // The first layer has no method.
                let mut methods = std::iter::once("mix").chain(methods.split_ascii_whitespace());
                let layer = |id| Layer { id, multiplies: methods.next() == Some("multiply") };
                if ids.len() > MAX_LAYERS {
                    let count = ids.len();
                    return Err(format!(
                        "there are {count} layers; at most {MAX_LAYERS} are allowed"
                    ));
                }
                let layers: Vec<_> = ids.into_iter().map(layer).collect();
                let is_below = |layer: &&Layer| {
                    self.group(layer.id).is_none_or(|g| g.kind == GroupKind::Multi)
                };
                if let Some(layer) = layers.iter().find(is_below) {
                    return Err(no_group(layer.id));
                }
                OpenGroup::Multi { layers }
            }
            _ => return Ok(None),
        }))
    }

    /// Adds a group whose entries have been read.
    pub(super) fn close_group(&mut self, id: u32, kind: GroupKind, entries: Vec<Property>) {
        self.group_of.entry(id).or_insert(self.groups.len() as u32);
        self.groups.push(PropertyGroup { kind, entries });
    }

    /// Adds a list of (metalness, roughness) pairs.
    pub(super) fn close_metallic(&mut self, id: u32, entries: Vec<[f32; 2]>) {
        self.metallic_of.entry(id).or_insert(self.metallic.len() as u32);
        self.metallic.push(entries);
    }

    /// Mixes the properties that an entry of multiproperties refers to.
    fn blend_layers(&self, layers: &[Layer], indices: &[u32], palette: &mut Palette) -> Property {
        let mut mixed: Option<Property> = None;
        let mut color = [1.0; 4];
        for (at, layer) in layers.iter().enumerate() {
            let index = indices.get(at).copied().unwrap_or(0) as usize;
            let Some(group) = self.group(layer.id) else { continue };
            let Some(property) = group.entries.get(index) else { continue };
            let own = palette.color_of(property);
            if group.kind == GroupKind::Texture {
                mixed = Some(*property);
                color = if layer.multiplies && at > 0 { color } else { [1.0; 4] };
            } else if at == 0 {
                color = own;
            } else if layer.multiplies {
                color = std::array::from_fn(|c| color[c] * own[c]);
            } else {
                // Blend over the layers below. Over a texture, a factor can only approximate this.
                let below = color;
                color = std::array::from_fn(|c| below[c] + (own[c] - below[c]) * own[3]);
                color[3] = own[3] + below[3] * (1.0 - own[3]);
                if own[3] >= 1.0 {
                    mixed = None;
                }
            }
        }
        match mixed {
            Some(property) => Property { color, ..property },
            None => {
                let material = palette.colored_material(color[3] < 1.0);
                Property { material, color, uv: [0.0; 2] }
            }
        }
    }
}

impl OpenGroup {
    /// Returns the kind of the group, or `None` if it is not a property group.
    pub(super) const fn kind(&self) -> Option<GroupKind> {
        Some(match self {
            Self::Base { .. } => GroupKind::Base,
            Self::Color => GroupKind::Color,
            Self::Texture { .. } => GroupKind::Texture,
            Self::Composite { .. } => GroupKind::Composite,
            Self::Multi { .. } => GroupKind::Multi,
            Self::Metallic => return None,
        })
    }

    /// Reads the property in a child element; `at` is its index. Returns `None` if it is malformed.
    pub(super) fn read_entry(
        &self,
        element: &Element<'_>,
        at: usize,
        part: &PartProperties,
        palette: &mut Palette,
    ) -> Option<Property> {
        let uv = [0.0; 2];
        let colored = |color: [f32; 4], palette: &mut Palette| {
            let material = palette.colored_material(color[3] < 1.0);
            Property { material, color, uv }
        };
        match self {
            Self::Base { metallic } => {
                let color =
                    element.attribute("displaycolor").map_or(Some([1.0; 4]), parse_color)?;
                let plain = Material::plain();
                let list = metallic.and_then(|id| part.metallic_of.get(&id));
                let metallic = list.and_then(|&list| part.metallic.get(list as usize)?.get(at));
                let [metallic, roughness] = *metallic.unwrap_or(&[plain.metallic, plain.roughness]);
                let is_blended = color[3] < 1.0;
                let material = palette.push_material(Material {
                    name: element.text_attribute("name"),
                    base_color: color,
                    metallic,
                    roughness,
                    alpha_mode: if is_blended { AlphaMode::Blend } else { AlphaMode::Opaque },
                    ..plain
                });
                Some(Property { material, color: [1.0; 4], uv })
            }
            Self::Color => Some(colored(parse_color(element.attribute("color")?)?, palette)),
            Self::Texture { material } => {
                let [u, v] = [parse_number(element, "u")?, parse_number(element, "v")?];
                // v = 0 is at the bottom in 3MF, but at the top in glTF.
                Some(Property { material: *material, color: [1.0; 4], uv: [u, 1.0 - v] })
            }
            Self::Composite { bases } => {
                let values = parse_list(element.attribute("values")?, parse_f32)?;
                Some(colored(mixture(bases, &values)?, palette))
            }
            Self::Multi { layers } => {
                let indices = parse_indices(element.attribute("pindices")?)?;
                Some(part.blend_layers(layers, &indices, palette))
            }
            Self::Metallic => None,
        }
    }
}

/// Returns the mean of colors, weighted by the proportions of their materials.
fn mixture(colors: &[[f32; 4]], weights: &[f32]) -> Option<[f32; 4]> {
    let sum: f32 = weights.iter().take(colors.len()).sum();
    let is_valid = weights.iter().all(|&weight| weight >= 0.0) && sum > 0.0 && sum.is_finite();
    is_valid.then(|| {
        let mut mean = [0.0; 4];
        for (color, weight) in colors.iter().zip(weights) {
            mean = std::array::from_fn(|at| mean[at] + color[at] * (weight / sum));
        }
        mean
    })
}
