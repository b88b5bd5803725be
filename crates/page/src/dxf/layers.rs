//! DXF layers and line types. A file has one layer for each combination of page layer and object.
//!
//! ```text
//!   page layer          object        file layer
//!   visible-crease      shaft         visible-crease.shaft
//!   visible-crease      shaft         visible-crease.shaft      shared by objects of that name
//!   dimensions                        dimensions
//! ```
//!
//! Layer names ignore case and exclude some characters, which become underscores.

use super::color_index::color_index;
use super::tags::TagWriter;
use crate::page::{PageContent, Pen};
use std::collections::BTreeMap;

/// The line widths that the format supports, in hundredths of a millimeter.
const LINE_WEIGHTS: [u16; 24] = [
    0, 5, 9, 13, 15, 18, 20, 25, 30, 35, 40, 50, 53, 60, 70, 80, 90, 100, 106, 120, 140, 158, 200,
    211,
];

/// The maximum number of characters in a name.
const MAX_NAME: usize = 200;

/// The line type of continuous lines.
const CONTINUOUS: &str = "Continuous";

/// The dashed line types of ISO 128 under the names used by CAD programs, for lines 1 mm wide.
const ISO_LINE_TYPES: [(&str, &[f64]); 3] = [
    ("ACAD_ISO02W100", &[12.0, 3.0]),
    ("ACAD_ISO04W100", &[24.0, 3.0, 0.5, 3.0]),
    ("ACAD_ISO05W100", &[24.0, 3.0, 0.5, 3.0, 0.5, 3.0]),
];

/// A layer of the file.
#[derive(Debug)]
struct FileLayer {
    name: String,
    color: u8,
    /// The index of the line type and the factor for its lengths, or `None` for continuous lines.
    line_type: Option<(usize, f64)>,
    /// The line width in hundredths of a millimeter.
    weight: u16,
}

/// A dashed line type: dashes and gaps in drawing units, scaled by each entity.
#[derive(Debug)]
struct DashedType {
    name: String,
    dashes: Vec<f64>,
}

/// The layers and line types of a page.
#[derive(Debug)]
pub(super) struct LayerTable {
    layers: Vec<FileLayer>,
    dashed: Vec<DashedType>,
    /// The index of the file layer for each group of each page layer.
    of_groups: Vec<Vec<usize>>,
}

impl LayerTable {
    /// Collects the layers and line types of a page.
    pub(super) fn new(page: PageContent<'_>, units_per_millimeter: f64) -> Self {
        let mut table = Self { layers: Vec::new(), dashed: Vec::new(), of_groups: Vec::new() };
        let mut indices = BTreeMap::new();
        for layer in page.layers {
            let line_type = table.line_type_of(&layer.pen);
            let line_type = line_type.map(|(index, factor)| (index, factor * units_per_millimeter));
            let in_layer = layer.groups.iter().map(|group| {
                let name = layer_name(&layer.id, &group.title);
                *indices.entry(name.to_lowercase()).or_insert_with(|| {
                    let (color, weight) =
                        (color_index(layer.pen.ink), line_weight(layer.pen.width));
                    table.layers.push(FileLayer { name, color, line_type, weight });
                    table.layers.len() - 1
                })
            });
            let in_layer = in_layer.collect();
            table.of_groups.push(in_layer);
        }
        table
    }

    /// Returns the name of the file layer for a group in a page layer.
    pub(super) fn name(&self, layer: usize, group: usize) -> &str {
        &self.layers[self.of_groups[layer][group]].name
    }

    /// Returns the line type factor of the layer that contains a group.
    pub(super) fn line_type_scale(&self, layer: usize, group: usize) -> f64 {
        self.layers[self.of_groups[layer][group]].line_type.map_or(1.0, |(_, factor)| factor)
    }

    /// Returns how many layers and dashed line types there are.
    pub(super) fn counts(&self) -> [usize; 2] {
        [self.layers.len(), self.dashed.len()]
    }

    /// Returns the index of a pen's line type and the factor for its lengths, or `None` for
    /// continuous lines. Adds the line type if it is new.
    fn line_type_of(&mut self, pen: &Pen) -> Option<(usize, f64)> {
        let first = *pen.dashes.first()?;
        let fits = |pattern: &[f64]| {
            let near = |(a, b): (&f64, &f64)| (a * pattern[0] - b * first).abs() < 1e-9;
            pattern.len() == pen.dashes.len() && pen.dashes.iter().zip(pattern).all(near)
        };
        let known = ISO_LINE_TYPES.iter().find(|(_, pattern)| fits(pattern));
        let (name, dashes, factor) = match known {
            Some((name, pattern)) => ((*name).to_owned(), pattern.to_vec(), first / pattern[0]),
            None => (format!("DASHES-{}", self.dashed.len() + 1), pen.dashes.clone(), 1.0),
        };
        let index = self.dashed.iter().position(|other| other.dashes == dashes);
        let index = index.unwrap_or_else(|| {
            self.dashed.push(DashedType { name, dashes });
            self.dashed.len() - 1
        });
        Some((index, factor))
    }

    /// Writes the records of the dashed line types, with handles starting at `first`.
    pub(super) fn write_line_types(&self, tags: &mut TagWriter, owner: u32, first: u32) {
        for (handle, line_type) in (first..).zip(&self.dashed) {
            tags.tag(0, "LTYPE");
            tags.handle(5, handle);
            tags.handle(330, owner);
            tags.tags("100=AcDbSymbolTableRecord|100=AcDbLinetypeTableRecord");
            tags.tag(2, &line_type.name);
            tags.tags("70=0|3=dashes and gaps|72=65");
            tags.tag(73, line_type.dashes.len());
            tags.number(40, line_type.dashes.iter().sum());
            for (index, length) in line_type.dashes.iter().enumerate() {
                tags.number(49, if index % 2 == 0 { *length } else { -length });
                tags.tag(74, 0);
            }
        }
    }

    /// Writes the records of the layers, with handles starting at `first`.
    pub(super) fn write_layers(&self, tags: &mut TagWriter, owner: u32, first: u32) {
        for (handle, layer) in (first..).zip(&self.layers) {
            tags.tag(0, "LAYER");
            tags.handle(5, handle);
            tags.handle(330, owner);
            tags.tags("100=AcDbSymbolTableRecord|100=AcDbLayerTableRecord");
            tags.tag(2, &layer.name);
            tags.tag(70, 0);
            tags.tag(62, layer.color);
            let dashed = layer.line_type.map(|(index, _)| self.dashed[index].name.as_str());
            tags.tag(6, dashed.unwrap_or(CONTINUOUS));
            tags.tag(370, layer.weight);
            tags.tags("390=13");
        }
    }
}

/// Returns the file layer name for a page layer and an object name.
fn layer_name(id: &str, object: &str) -> String {
    let whole = if object.is_empty() { id.to_owned() } else { format!("{id}.{object}") };
    let allowed = |c: char| match c {
        '<' | '>' | '/' | '\\' | '"' | ':' | ';' | '?' | '*' | '|' | '=' | ',' | '`' => '_',
        c if c.is_control() => '_',
        c => c,
    };
    let name: String = whole.trim().chars().take(MAX_NAME).map(allowed).collect();
    escape_unicode(name.trim_end())
}

/// Escapes a string to ASCII. Other characters are written as codes: Ø is `\U+00D8`. Control
/// characters and codes with more than four digits become `?`.
pub(super) fn escape_unicode(text: &str) -> String {
    let escaped = |c: char| match u32::from(c) {
        0x20..=0x7e => c.to_string(),
        code @ 0xa0..=0xffff => format!("\\U+{code:04X}"),
        _ => "?".to_owned(),
    };
    text.chars().map(escaped).collect()
}

/// Returns the supported line width nearest to a width in millimeters.
fn line_weight(millimeters: f64) -> u16 {
    let hundredths = millimeters * 100.0;
    let nearer = |a: &u16, b: &u16| {
        let distance = |weight: u16| (f64::from(weight) - hundredths).abs();
        distance(*a).total_cmp(&distance(*b))
    };
    LINE_WEIGHTS.into_iter().min_by(nearer).unwrap_or(25)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Page;
    use crate::page::{Group, Layer};
    use glam::DVec2;

    #[test]
    fn layer_names_fit_the_format() {
        assert_eq!(layer_name("cut-lines", ""), "cut-lines");
        assert_eq!(layer_name("a", "Welle Ø 12/3"), "a.Welle \\U+00D8 12_3");
        assert_eq!(layer_name("a", "x\n<y>\u{1f600} "), "a.x__y_?");
        assert!(layer_name("a", &"long ".repeat(99)).len() <= MAX_NAME);
    }

    #[test]
    fn objects_whose_names_differ_only_in_case_share_a_layer() {
        let mut page: Page = Page::new(DVec2::ONE, "", None);
        let mut layer = Layer::new("a", "a", Pen::solid(0.36, [255, 0, 0]));
        for title in ["Bolt", "nut", "BOLT"] {
            layer.groups.push(Group { title: title.to_owned(), ..Group::default() });
        }
        page.layers.push(layer);
        let table = LayerTable::new(page.content(), 1.0);
        assert_eq!([0, 1, 2].map(|group| table.name(0, group)), ["a.Bolt", "a.nut", "a.Bolt"]);
        assert_eq!((table.layers[0].weight, table.layers[0].color), (35, 1));
    }

    #[test]
    fn dashes_of_all_widths_share_a_line_type() {
        let mut table =
            LayerTable { layers: Vec::new(), dashed: Vec::new(), of_groups: Vec::new() };
        let pen = |dashes: &[f64]| Pen { dashes: dashes.to_vec(), ..Pen::solid(0.25, [0; 3]) };
        assert_eq!(table.line_type_of(&pen(&[3.0, 0.75])), Some((0, 0.25)));
        assert_eq!(table.line_type_of(&pen(&[6.0, 1.5])), Some((0, 0.5)));
        assert_eq!(table.line_type_of(&pen(&[6.0, 0.75, 0.125, 0.75])), Some((1, 0.25)));
        assert_eq!(table.line_type_of(&pen(&[1.0, 1.0])), Some((2, 1.0)));
        assert_eq!(table.line_type_of(&pen(&[])), None);
        let names: Vec<&str> = table.dashed.iter().map(|dashed| dashed.name.as_str()).collect();
        assert_eq!(names, ["ACAD_ISO02W100", "ACAD_ISO04W100", "DASHES-3"]);
    }

    #[test]
    fn widths_are_rounded_to_the_nearest_supported_width() {
        for (width, weight) in [(0.25, 25), (0.33, 35), (0.0, 0), (5.0, 211), (0.01, 0)] {
            assert_eq!(line_weight(width), weight);
        }
    }
}
