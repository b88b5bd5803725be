//! Parts lists: counts of identical parts, with names, materials and masses (ISO 7573).

use super::geometry::PartClasses;
use super::part::{Part, drawn_primitives, gather_parts, one_line};
use super::volume::part_volume;
use crate::{AssemblyWarning, SheetWarning};
use model::ModelInstance;
use std::collections::BTreeMap;

/// The density of a material, or of the parts with a certain name.
#[derive(Clone, PartialEq, Debug)]
pub struct PartDensity {
    /// The name of a material or a part, or `*` for all parts without a more specific density.
    pub of: String,
    /// Grams per cubic centimeter (tonnes per cubic meter), about 7.85 for steel.
    pub grams_per_cubic_centimeter: f64,
}

/// A list of the parts in models.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct PartsList {
    /// The items, numbered from 1, in the order of their first nodes in the models.
    pub items: Vec<PartsListItem>,
    /// Whether densities were specified, so that items may have masses.
    pub has_masses: bool,
    /// Warnings about items that have a density but no computable mass.
    pub warnings: Vec<SheetWarning>,
}

/// An item of a parts list: a part and its quantity.
#[derive(Clone, PartialEq, Debug)]
pub struct PartsListItem {
    /// The item number, from 1.
    pub number: usize,
    /// The number of identical parts.
    pub quantity: usize,
    /// The name, on one line.
    pub name: String,
    /// The part's material names, joined by commas; empty if there are none.
    pub material: String,
    /// The mass of a single part in grams, if known.
    pub mass: Option<f64>,
    /// The object indices of the parts in drawings of the models.
    pub objects: Vec<u32>,
    /// The places of the parts in the models, in the order of `objects`.
    pub places: Vec<PartPlace>,
}

/// A part's place in the scene graph of its model.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PartPlace {
    /// The index of the model, from 0.
    pub model: usize,
    /// The index of the node in the model, from 0. Instances of one node share it.
    pub node: usize,
    /// The node names from the root to this node; `node 3` for the fourth node if it has no name.
    pub path: Vec<String>,
}

impl PartPlace {
    /// Returns the place of a part in the given models.
    fn from_part(part: &Part, models: &[ModelInstance]) -> Self {
        let nodes = &models[part.model].model.nodes;
        let name = |node: usize| {
            let own = nodes[node].name.as_deref().filter(|name| !name.is_empty());
            own.map_or_else(|| format!("node {node}"), str::to_owned)
        };
        let above = |node: &usize| nodes[*node].parent.filter(|parent| *parent < nodes.len());
        // The importer rejects cycles, but the node count bounds the loop in any case.
        let chain = core::iter::successors(Some(part.instance.node), above).take(nodes.len());
        let mut path: Vec<String> = chain.map(name).collect();
        path.reverse();
        Self { model: part.model, node: part.instance.node, path }
    }
}

impl PartsList {
    /// Creates the list of all parts in models with a given number of millimeters per scene unit.
    ///
    /// Parts share an item if their meshes have the same positions, indices and materials at the
    /// same size. Their names may differ only in a trailing number: `bolt.001` and `bolt.002` are
    /// one item with quantity 2.
    #[must_use]
    pub fn new(
        models: &[ModelInstance],
        densities: &[PartDensity],
        millimeters_per_unit: f64,
    ) -> Self {
        let parts = gather_parts(models);
        Self::from_parts(models, &parts, densities, millimeters_per_unit)
    }

    /// Creates the list of the given parts.
    pub(crate) fn from_parts(
        models: &[ModelInstance],
        parts: &[Part],
        densities: &[PartDensity],
        millimeters_per_unit: f64,
    ) -> Self {
        let mut classes = PartClasses::new(models);
        let mut known: BTreeMap<(usize, &str), usize> = BTreeMap::new();
        let mut groups: Vec<Vec<&Part>> = Vec::new();
        for part in parts {
            // Modeling programs number the copies of a part, as in `bolt.001`, but the copies are
            // one item.
            let key = (classes.class_of(part), without_number(&part.name));
            let group = *known.entry(key).or_insert(groups.len());
            if group == groups.len() {
                groups.push(Vec::new());
            }
            groups[group].push(part);
        }
        let centimeters = millimeters_per_unit / 10.0;
        let cubic_centimeters = centimeters * centimeters * centimeters;
        let (mut items, mut warnings) = (Vec::new(), Vec::new());
        for (group, number) in groups.iter().zip(1..) {
            let (name, materials) = (common_name(group), material_names(group[0], models));
            let density = find_density(densities, &name, &materials);
            // Computing the volume takes a pass over the mesh, so it is skipped if there is no
            // density.
            let volume = density.and_then(|_| part_volume(group[0], models));
            if density.is_some() && volume.is_none() {
                warnings.push(SheetWarning::Assembly(AssemblyWarning::MassUnknown {
                    part: name.clone(),
                }));
            }
            items.push(PartsListItem {
                number,
                quantity: group.len(),
                material: materials.join(", "),
                mass: density.zip(volume).map(|(density, volume)| {
                    density.grams_per_cubic_centimeter * volume * cubic_centimeters
                }),
                objects: group.iter().map(|part| part.object).collect(),
                places: group.iter().map(|part| PartPlace::from_part(part, models)).collect(),
                name,
            });
        }
        Self { items, has_masses: !densities.is_empty(), warnings }
    }

    /// Returns the list as comma-separated values (RFC 4180) with a header: item, quantity, name,
    /// material and, if densities were specified, the mass of one part in grams.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let mut text = String::from("item,quantity,name,material");
        text.push_str(if self.has_masses { ",mass_grams\r\n" } else { "\r\n" });
        for item in &self.items {
            let (name, material) = (csv_field(&item.name), csv_field(&item.material));
            text.push_str(&format!("{},{},{name},{material}", item.number, item.quantity));
            if self.has_masses {
                let mass = item.mass.map(|grams| format!("{grams:.3}")).unwrap_or_default();
                text.push_str(&format!(",{mass}"));
            }
            text.push_str("\r\n");
        }
        text
    }
}

/// Returns a CSV field, quoted if necessary.
///
/// Spreadsheets evaluate text that begins like a formula, even in untrusted files. A leading
/// apostrophe marks such a field as text.
fn csv_field(text: &str) -> String {
    if text.starts_with(['=', '+', '-', '@', '\t', '\r']) {
        return format!("\"'{}\"", text.replace('"', "\"\""));
    }
    let needs_quotes = text.contains([',', '"', '\r', '\n']) || text.trim() != text;
    if needs_quotes { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

/// Returns the density specified for a part's name, else for its only material, else for all parts.
fn find_density<'a>(
    densities: &'a [PartDensity],
    name: &str,
    materials: &[String],
) -> Option<&'a PartDensity> {
    let of = |wanted: &str| densities.iter().find(|density| density.of == wanted);
    let of_material = || if let [material] = materials { of(material) } else { None };
    of(name).or_else(of_material).or_else(|| of("*"))
}

/// Returns a part's material names, without duplicates.
fn material_names(part: &Part, models: &[ModelInstance]) -> Vec<String> {
    let model = &models[part.model].model;
    let mut names: Vec<String> = Vec::new();
    for primitive in drawn_primitives(model, part.instance) {
        let material = primitive.material.and_then(|index| model.materials.get(index));
        let name = material.and_then(|material| material.name.as_deref()).map(one_line);
        if let Some(name) = name.filter(|name| !name.is_empty() && !names.contains(name)) {
            names.push(name);
        }
    }
    names
}

/// Whether a character may separate a name from a copy number.
fn is_separator(character: char) -> bool {
    matches!(character, ' ' | '.' | '_' | '-' | ':' | '#')
}

/// Removes the copy number from the end of a name: `bolt.001` becomes `bolt`.
fn without_number(name: &str) -> &str {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    if stem.len() == name.len() { name } else { stem.trim_end_matches(is_separator) }
}

/// Returns the common name of parts: their name if all have the same one, otherwise the common
/// prefix of their names, without copy numbers.
fn common_name(parts: &[&Part]) -> String {
    let first = parts[0].name.as_str();
    if parts.iter().all(|part| part.name == first) {
        return first.to_owned();
    }
    let common = parts.iter().fold(first, |common, part| {
        let shared = common.char_indices().zip(part.name.chars()).find(|((_, a), b)| a != b);
        let length = common.len().min(part.name.len());
        shared.map_or(&common[..length], |((at, _), _)| &common[..at])
    });
    let ends_in_number = parts.iter().any(|part| {
        part.name[common.len()..].starts_with(|character: char| character.is_ascii_digit())
    });
    let common =
        if ends_in_number { common.trim_end_matches(|c: char| c.is_ascii_digit()) } else { common };
    let name = common.trim_end_matches(is_separator);
    if name.is_empty() { "part".to_owned() } else { name.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homog::{Affine, Bounds, Point};
    use model::MeshInstance;

    fn named(name: &str) -> Part {
        let bounds = Bounds::from_points([Point::new(0.0, 0.0, 0.0)]).expect("a point");
        let instance = MeshInstance { node: 0, node_to_model: Affine::IDENTITY };
        Part { name: name.to_owned(), object: 0, model: 0, instance, bounds }
    }

    #[test]
    fn copies_share_a_name_without_their_numbers() {
        for (names, stem, common) in [
            (["bolt.001", "bolt.002"], "bolt", "bolt"),
            (["bolt", "bolt.001"], "bolt", "bolt"),
            (["M8", "M8.001"], "M", "M8"),
            (["bolt_01", "bolt_02"], "bolt", "bolt"),
            (["bolt 9", "bolt 10"], "bolt", "bolt"),
            (["wheel", "wheel"], "wheel", "wheel"),
            (["1", "2"], "", "part"),
            (["roue é1", "roue é2"], "roue é", "roue é"),
        ] {
            assert_eq!(without_number(names[0]), stem);
            let parts = names.map(named);
            assert_eq!(common_name(&parts.each_ref()), common);
        }
    }

    #[test]
    fn csv_fields_are_quoted_if_necessary() {
        for (text, field) in [
            ("plain", "plain"),
            ("a, b", "\"a, b\""),
            ("3\" pipe", "\"3\"\" pipe\""),
            ("a=b", "a=b"),
        ] {
            assert_eq!(csv_field(text), field);
        }
    }

    #[test]
    fn csv_fields_are_never_formulas() {
        for text in ["=1+1", "+1", "-1", "@sum(a1)", "\tx", "\rx"] {
            assert_eq!(csv_field(text), format!("\"'{text}\""));
        }
        assert_eq!(csv_field("=a(\"b\")"), "\"'=a(\"\"b\"\")\"");
    }
}
