//! Random scene files, generated from the declarations of the scene language.
//!
//! ```text
//!  reference::all_types() ─► for each field: omitted, or a value of its type ─► Scene(…)
//! ```
//!
//! A new field in the language appears in these scenes automatically. Most values are reasonable,
//! so that few scenes are rejected because of a single value. Incompatible combinations must be
//! rejected with a message.

use super::bits::Bits;
use scene_file::reference::{FieldEntry, Shape, TypeEntry, ValueType, VariantEntry, all_types};

/// The files next to the scenes.
pub struct SceneFiles {
    /// Models, by name.
    pub models: Vec<String>,
    /// An environment.
    pub environment: &'static str,
    /// An image for the background.
    pub image: &'static str,
    /// A scene to include.
    pub include: &'static str,
}

/// Returns the scene with this number.
pub fn random_scene_text(number: u64, files: &SceneFiles) -> String {
    let mut writer = SceneWriter { bits: Bits::new(number), files };
    let scene = all_types()[0];
    let Shape::Fields(fields) = scene.shape else { return String::new() };
    // A scene needs a model, and small pictures allow more scenes per minute.
    let required = ["models", "image"];
    let mut written = String::new();
    for field in fields {
        if required.contains(&field.name) || writer.is_chosen(field) {
            written += &format!("  {}: {},\n", field.name, writer.value("Scene", field));
        }
    }
    format!("Scene(\n{written})\n")
}

/// Returns the fields of a struct.
fn fields_of(value_type: &ValueType) -> Option<&'static [FieldEntry]> {
    match value_type {
        ValueType::Declared(TypeEntry { shape: Shape::Fields(fields), .. }) => Some(fields),
        _ => None,
    }
}

/// Writes values from a source of bits.
struct SceneWriter<'a> {
    bits: Bits,
    files: &'a SceneFiles,
}

impl SceneWriter<'_> {
    /// Returns whether a field is written: always if it is required, otherwise in a third of cases.
    fn is_chosen(&mut self, field: &FieldEntry) -> bool {
        !field.is_optional || self.below(3) == 0
    }

    /// Returns the value of a field of the type or variant `owner`.
    fn value(&mut self, owner: &str, field: &FieldEntry) -> String {
        self.value_of_type(owner, field.name, &(field.value_type)())
    }

    fn value_of_type(&mut self, owner: &str, field: &str, value_type: &ValueType) -> String {
        match value_type {
            ValueType::Plain(words, _) => self.plain_value(owner, field, words),
            ValueType::Declared(entry) => self.declared_value(field, entry),
            ValueType::List(element) => {
                let values = (0..=self.below(2)).map(|_| self.value_of_type(owner, field, element));
                format!("[{}]", values.collect::<Vec<_>>().join(", "))
            }
            ValueType::Tuple(parts) => {
                let values = parts.iter().map(|part| self.value_of_type(owner, field, part));
                format!("({})", values.collect::<Vec<_>>().join(", "))
            }
        }
    }

    fn declared_value(&mut self, field: &str, entry: &TypeEntry) -> String {
        match entry.shape {
            Shape::Plain(_) => self.number_or_color(field, entry.name),
            Shape::Fields(fields) => self.fields(entry.name, fields),
            Shape::Variants(variants) => {
                let variant = &variants[self.below(variants.len())];
                self.variant(variant)
            }
        }
    }

    /// Returns a struct in parentheses, preceded by its name.
    fn fields(&mut self, name: &str, fields: &[FieldEntry]) -> String {
        let mut written = Vec::new();
        for field in fields {
            // The pictures must be small.
            if self.is_chosen(field) || (name, field.name) == ("Image", "size") {
                written.push(format!("{}: {}", field.name, self.value(name, field)));
            }
        }
        format!("{name}({})", written.join(", "))
    }

    fn variant(&mut self, variant: &VariantEntry) -> String {
        match variant.value_type {
            // The parentheses of the variant also enclose the struct.
            Some(value_type) if fields_of(&value_type()).is_some() => {
                let fields = fields_of(&value_type()).unwrap_or_default();
                self.fields(variant.name, fields)
            }
            Some(value_type) => {
                let value = self.value_of_type(variant.name, variant.name, &value_type());
                format!("{}({value})", variant.name)
            }
            None if variant.fields.is_empty() => variant.name.to_owned(),
            None => self.fields(variant.name, variant.fields),
        }
    }

    /// Returns a value for a type described in words: a boolean, a string or a whole number.
    fn plain_value(&mut self, owner: &str, field: &str, words: &str) -> String {
        match words {
            "true or false" => (self.below(2) == 0).to_string(),
            "string" => format!("{:?}", self.string(owner, field)),
            "whole number" => self.whole_number(owner, field).to_string(),
            other => unreachable!("no random value for {owner}.{field}: {other}"),
        }
    }

    fn whole_number(&mut self, owner: &str, field: &str) -> usize {
        match field {
            "size" => 24 + self.below(40),
            "samples" => [1, 4, 8, 16][self.below(4)],
            "bits" => [8, 16][self.below(2)],
            _ if owner == "Index" => self.below(2),
            _ => 1 + self.below(4),
        }
    }

    fn string(&mut self, owner: &str, field: &str) -> String {
        match (owner, field) {
            ("Model", "path") => self.files.models[self.below(self.files.models.len())].clone(),
            ("File", "path") => self.files.environment.to_owned(),
            (_, "path") => self.files.image.to_owned(),
            _ => ["A", "Ø 12 ± 0.1", "视锥体", ""][self.below(4)].to_owned(),
        }
    }

    /// Returns a value of a declared type that has neither fields nor variants.
    fn number_or_color(&mut self, field: &str, name: &str) -> String {
        let [low, high] = match name {
            "Finite" if field.ends_with("_degrees") => [-180.0, 180.0],
            "Finite" => [-3.0, 3.0],
            "Positive" => [0.05, 5.0],
            "NonNegative" => [0.0, 5.0],
            "FieldOfView" => [5.0, 120.0],
            "Percent" => [0.0, 40.0],
            "Fraction" | "HandDrawn" => [0.0, 1.0],
            "Softness" => [0.0, 10.0],
            "CreaseAngle" => [0.0, 180.0],
            "HatchSpacing" => [0.5, 20.0],
            "PointSize" => [1.0, 20.0],
            "LabelSize" => [4.0, 30.0],
            "Scale" => [0.3, 2.0],
            "Triple" => {
                let [x, y, z] = [0; 3].map(|_| self.between(-3.0, 3.0));
                return format!("({x}, {y}, {z})");
            }
            "Color" => return ["\"#345\"", "\"white\"", "\"#a0c8ff\""][self.below(3)].to_owned(),
            "LightColor" => return ["\"#ffe0c0\"", "(0.2, 1, 3)"][self.below(2)].to_owned(),
            "Paths" => return format!("[{:?}]", self.files.include),
            other => unreachable!("no random value for {field}: {other}"),
        };
        self.between(low, high).to_string()
    }

    fn below(&mut self, count: usize) -> usize {
        (self.bits.next() >> 32) as usize % count
    }

    /// Returns a number with three decimals, so that it is readable.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.bits.next() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0);
        ((low + (high - low) * unit) * 1000.0).round() / 1000.0
    }
}
